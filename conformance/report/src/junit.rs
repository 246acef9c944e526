//! The report as `JUnit` XML, a test suite per chapter, for continuous integration.

use std::collections::BTreeMap;

use gaugeblock_runner::certify::{NotJudgedReason, Verdict};
use quick_junit::{NonSuccessKind, TestCase, TestCaseStatus, TestSuite};

use super::grouping::title;
use super::{Report, escape_line, escape_text};

/// The report as `JUnit` XML. The verdict is the type of a failure, an error, or what is skipped; what is known or
/// waived is skipped. A case with a side difference passes, and its output describes the difference. A finding without
/// a rule is a failed test of its own. The class of a case is its rule. The file has no times, so merged shards give
/// the same bytes as the whole run.
///
/// # Errors
/// A text that XML cannot hold.
pub fn junit(report: &Report<'_>) -> Result<String, String> {
    let controller = escape_line(&report.header.controller);
    let name = format!("{controller} against {}", report.edition_and_scope());
    let mut document = quick_junit::Report::new(name);
    let mut chapters: BTreeMap<&str, TestSuite> = BTreeMap::new();
    for result in &report.run.cases {
        let word = result.verdict.word();
        let status = match &result.verdict {
            Verdict::Pass | Verdict::SideDifference(_) => TestCaseStatus::success(),
            Verdict::Diverges(divergence) => {
                let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
                status.set_type(word).set_message(escape_text(&divergence.summary()).into_owned());
                status.set_description(result.program.to_owned());
                status
            }
            Verdict::Known(_, why) | Verdict::Waived(_, why) | Verdict::Unsupported(why) => {
                let mut status = TestCaseStatus::skipped();
                status.set_type(word).set_message(escape_text(why).into_owned());
                status
            }
            Verdict::Inconclusive(why) | Verdict::NotJudged(NotJudgedReason { why, .. }) => {
                let mut status = TestCaseStatus::non_success(NonSuccessKind::Error);
                status.set_type(word).set_message(escape_text(why).into_owned());
                status
            }
        };
        let chapter = result.rule.chapter();
        let suite = chapters.entry(chapter).or_insert_with(|| chapter_of(report, chapter));
        let name = format!("{} / {}", result.rule.id, result.name);
        let mut case = TestCase::new(name, status);
        case.set_classname(result.rule.id.as_str());
        if let Verdict::SideDifference(divergence) = &result.verdict {
            let said = escape_text(&divergence.summary()).into_owned();
            case.set_system_out(format!("{word}: {said}"));
        }
        suite.add_test_case(case);
    }
    let mut findings = TestSuite::new("findings without a rule");
    for finding in report.findings() {
        let (None, false, Some((result, divergence))) =
            (finding.rule, finding.is_known, finding.divergent().next())
        else {
            continue;
        };
        let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
        let said = escape_text(&divergence.summary()).into_owned();
        status.set_type("side difference").set_message(said);
        status.set_description(divergence.program(result).to_owned());
        let title = escape_line(&title(&report.header.controller, finding));
        findings.add_test_case(TestCase::new(title, status));
    }
    document.add_test_suites(chapters.into_values());
    if !findings.test_cases.is_empty() {
        document.add_test_suite(findings);
    }
    document.to_string().map_err(|error| error.to_string())
}

/// The suite of a chapter, with what the cases were compared with.
fn chapter_of(report: &Report<'_>, chapter: &str) -> TestSuite {
    let mut suite = TestSuite::new(chapter);
    for (name, value) in [
        ("controller", escape_line(&report.header.controller)),
        ("version", escape_line(&report.header.version)),
        ("edition", report.edition_and_scope()),
        ("suite", escape_line(&report.header.suite)),
        ("gaugeblock", env!("CARGO_PKG_VERSION").to_owned()),
    ] {
        suite.add_property((name, value.as_str()));
    }
    suite
}
