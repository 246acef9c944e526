//! The report as `JUnit` XML, a test suite per chapter, for continuous integration.

use std::collections::BTreeMap;

use quick_junit::{NonSuccessKind, TestCase, TestCaseStatus, TestSuite};

use super::Report;
use crate::certify::Verdict;

/// The report as `JUnit` XML. A divergence that the expectations list is a success with a note.
///
/// # Errors
/// A text that XML cannot hold.
pub fn junit(report: &Report<'_>) -> Result<String, String> {
    let name = format!("{} held to {}", report.header.controller, report.run.edition.id);
    let mut document = quick_junit::Report::new(name);
    let mut chapters: BTreeMap<&str, TestSuite> = BTreeMap::new();
    for result in &report.run.cases {
        let status = match &result.verdict {
            Verdict::Pass | Verdict::ChargedElsewhere(_) => TestCaseStatus::success(),
            Verdict::Diverges(_) if is_known(report, &result.rule.id, result.name) => {
                TestCaseStatus::success()
            }
            Verdict::Diverges(departure) => {
                let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
                status.set_message(departure.line()).set_description(result.program.to_owned());
                status
            }
            Verdict::Unsupported(why) => {
                let mut status = TestCaseStatus::skipped();
                status.set_message(why.clone());
                status
            }
            Verdict::Inconclusive(why) | Verdict::NotJudged(why) => {
                let mut status = TestCaseStatus::non_success(NonSuccessKind::Error);
                status.set_message(why.clone());
                status
            }
        };
        let chapter = result.rule.chapter();
        let suite = chapters.entry(chapter).or_insert_with(|| TestSuite::new(chapter));
        let name = format!("{} / {}", result.rule.id, result.name);
        suite.add_test_case(TestCase::new(name, status));
    }
    document.add_test_suites(chapters.into_values());
    document.to_string().map_err(|error| error.to_string())
}

fn is_known(report: &Report<'_>, rule: &str, case: &str) -> bool {
    let troubles = report.troubles.as_ref();
    troubles.is_some_and(|all| !all.iter().any(|trouble| trouble.place() == (rule, case)))
}
