//! `gaugeblock suite faults`: which planted faults the suite catches, and by which cases.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use gaugeblock_controllers::faulty::Faulty;
use gaugeblock_interpreter::faults::PlantedFault;
use gaugeblock_runner::certify::{CaseResult, Plan, certify};
use gaugeblock_runner::findings::findings;
use gaugeblock_suite::Suite;
use serde_json::json;

use super::certify::progress;
use crate::arguments::Format;
use crate::error::CliError;
use crate::streams::write_out;

/// The editions that notice what is wrong with post-processors and with custom macros.
const OWN: [(&str, &str); 2] = [("gpp.", "gpp2"), ("nct.", "nct-99m")];

/// A planted fault, and the cases that notice it.
struct Caught<'a> {
    fault: PlantedFault,
    /// How many cases differ.
    cases: usize,
    /// The cases of which an assertion fails.
    failing_cases: Vec<String>,
    /// The rules of which an assertion fails.
    rules: BTreeSet<&'a str>,
    /// The rule of each finding, the worst first.
    charged: Vec<&'a str>,
}

/// Certifies production once with each fault. Fails where one is not noticed.
pub(crate) fn faults(suite: &Suite, edition: &str, format: Format) -> Result<u8, CliError> {
    let edition = crate::documents::edition(suite, edition)?;
    let own = |fault: PlantedFault| OWN.iter().find(|(names, _)| fault.name().starts_with(names));
    let jobs = std::thread::available_parallelism().unwrap_or(std::num::NonZero::<usize>::MIN);
    let plan = Plan { suite, edition, only: &[], jobs };
    let bar = progress(PlantedFault::ALL.len());
    let caught: Vec<_> = PlantedFault::ALL
        .iter()
        .filter_map(|fault| {
            let edition = match own(*fault) {
                Some((_, own)) => crate::documents::edition(suite, own).ok()?,
                None => edition,
            };
            let run = certify(Plan { edition, ..plan }, &Faulty::new(*fault)?, &|| {});
            let diverges = |case: &&CaseResult<'_>| case.verdict.divergence().is_some();
            let failing: Vec<_> = run.cases.iter().filter(diverges).collect();
            let own = failing.iter().filter(|case| case.verdict.own_divergence().is_some());
            let rules = own.map(|case| case.rule.id.as_str()).collect();
            let findings = findings(suite, &run, &|_| false, &|divergence| divergence.summary());
            let charged: Vec<_> = findings.iter().filter_map(|finding| finding.rule).collect();
            let charged = charged.into_iter().map(|rule| rule.id.as_str()).collect();
            bar.inc(1);
            let failing_cases =
                failing.iter().filter(|case| case.verdict.own_divergence().is_some());
            let failing_cases =
                failing_cases.map(|case| format!("{} / {}", case.rule.id, case.name)).collect();
            Some(Caught { failing_cases, fault: *fault, cases: failing.len(), rules, charged })
        })
        .collect();
    bar.finish_and_clear();
    let missed = caught.iter().filter(|caught| caught.cases == 0).count();
    write_out(&match format {
        Format::Json => format!("{:#}\n", document(&caught)),
        Format::Text => text(&caught, missed),
    });
    Ok(u8::from(missed > 0))
}

fn document(caught: &[Caught<'_>]) -> serde_json::Value {
    let faults: Vec<_> = caught
        .iter()
        .map(|caught| {
            json!({
                "fault": caught.fault.name(), "about": caught.fault.about(), "cases": caught.cases,
                "rules": caught.rules, "charged": caught.charged,
                "failing": caught.failing_cases,
            })
        })
        .collect();
    json!({ "gaugeblock": "faults", "schema": gaugeblock_vocabulary::schema::VERSION, "faults": faults })
}

fn text(caught: &[Caught<'_>], missed: usize) -> String {
    let mut text = String::new();
    for Caught { fault, cases, rules, charged: _, failing_cases: _ } in caught {
        let by = match (cases, rules.first()) {
            (0, _) | (_, None) => "NOT CAUGHT".to_owned(),
            (cases, Some(rule)) if rules.len() == 1 => format!("{cases:>4} cases, only {rule}"),
            (cases, Some(_)) => format!("{cases:>4} cases of {} rules", rules.len()),
        };
        let _infallible = writeln!(text, "{:<36} {by:<44} {}", fault.name(), fault.about());
    }
    let _infallible = writeln!(
        text,
        "\n{} planted faults, {} caught, {missed} not",
        caught.len(),
        caught.len() - missed
    );
    text
}
