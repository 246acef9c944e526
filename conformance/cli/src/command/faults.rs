//! `gaugeblock suite faults`: which planted faults the suite catches, and which rules its findings name.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use gaugeblock_controllers::faulty::Faulty;
use gaugeblock_interpreter::faults::PlantedFault;
use gaugeblock_runner::certify::{Plan, certify};
use gaugeblock_runner::findings::findings;
use gaugeblock_suite::{Edition, Suite};
use serde_json::json;

use super::certify::progress;
use crate::arguments::Format;
use crate::error::CliError;
use crate::streams::write_out;

/// The rules that each fault breaks, by their sentences.
const BROKEN_RULES: &str = include_str!("../../planted-faults.toml");

/// The editions of post-processors and of custom macros, by the begin of a fault's name.
const EDITIONS_BY_PREFIX: [(&str, &str); 2] = [("gpp.", "gpp2"), ("nct.", "nct-99m")];

/// What the suite finds of a planted fault.
struct FaultResult<'a> {
    fault: PlantedFault,
    /// The rules that the fault breaks.
    broken: &'a [String],
    /// How many cases differ.
    cases: usize,
    /// Rules with a failing assertion.
    failing: BTreeSet<&'a str>,
    /// The rule of each finding, the worst first.
    charged: Vec<&'a str>,
}

impl FaultResult<'_> {
    /// Whether the first finding names a rule that the fault breaks.
    fn is_named_first(&self) -> bool {
        self.charged.first().is_some_and(|rule| self.broken.iter().any(|broken| broken == rule))
    }
}

/// Certifies production once with each fault. Fails if one is not noticed.
pub(crate) fn faults(suite: &Suite, edition: &str, format: Format) -> Result<u8, CliError> {
    let edition = crate::documents::edition(suite, edition)?;
    let broken = broken_rules(suite)?;
    let bar = progress(PlantedFault::ALL.len());
    let mut results = Vec::new();
    for fault in PlantedFault::ALL {
        let own = EDITIONS_BY_PREFIX.iter().find(|(prefix, _)| fault.name().starts_with(prefix));
        let edition = match own {
            Some((_, own)) => crate::documents::edition(suite, own)?,
            None => edition,
        };
        let broken = broken.get(fault.name()).map_or(&[][..], Vec::as_slice);
        results.extend(result_of(suite, edition, *fault, broken));
        bar.inc(1);
    }
    bar.finish_and_clear();
    write_out(&match format {
        Format::Json => format!("{:#}\n", document(&results)),
        Format::Text => text(&results),
    });
    Ok(u8::from(results.iter().any(|result| result.cases == 0)))
}

/// The rules that each fault breaks.
fn broken_rules(suite: &Suite) -> Result<BTreeMap<String, Vec<String>>, CliError> {
    let hint = "correct conformance/cli/planted-faults.toml";
    let broken: BTreeMap<String, Vec<String>> =
        toml::from_str(BROKEN_RULES).map_err(|error| CliError::failure(error.to_string(), hint))?;
    let rules = broken.values().flatten();
    let unknown = rules.into_iter().find(|rule| suite.rule(rule).is_none());
    let missing = PlantedFault::ALL.iter().find(|fault| !broken.contains_key(fault.name()));
    match (unknown, missing) {
        (Some(rule), _) => Err(CliError::failure(format!("unknown rule {rule}"), hint)),
        (None, Some(fault)) => {
            Err(CliError::failure(format!("{} has no entry", fault.name()), hint))
        }
        (None, None) => Ok(broken),
    }
}

/// Certifies production with a fault; nothing while another one is planted.
fn result_of<'a>(
    suite: &'a Suite,
    edition: &'a Edition,
    fault: PlantedFault,
    broken: &'a [String],
) -> Option<FaultResult<'a>> {
    let jobs = std::thread::available_parallelism().unwrap_or(std::num::NonZero::<usize>::MIN);
    let plan = Plan { suite, edition, only: &[], jobs };
    let run = certify(plan, &Faulty::new(fault)?, &|| {});
    let own = run.cases.iter().filter(|case| case.verdict.own_divergence().is_some());
    let failing = own.map(|case| case.rule.id.as_str()).collect();
    let findings = findings(suite, &run, &|_| false, &|divergence| divergence.summary());
    let charged = findings.iter().filter_map(|finding| finding.rule);
    let cases = run.cases.iter().filter(|case| case.verdict.divergence().is_some()).count();
    Some(FaultResult {
        fault,
        broken,
        cases,
        failing,
        charged: charged.map(|rule| rule.id.as_str()).collect(),
    })
}

fn document(results: &[FaultResult<'_>]) -> serde_json::Value {
    let faults: Vec<_> = results
        .iter()
        .map(|result| {
            json!({
                "fault": result.fault.name(), "about": result.fault.about(), "cases": result.cases,
                "broken": result.broken, "failing": result.failing, "charged": result.charged,
                "named_first": result.is_named_first(),
            })
        })
        .collect();
    json!({ "gaugeblock": "faults", "schema": gaugeblock_vocabulary::schema::VERSION, "faults": faults })
}

fn text(results: &[FaultResult<'_>]) -> String {
    let mut text = String::new();
    for result in results {
        let by = match result.charged.as_slice() {
            _ if result.cases == 0 => "NOT CAUGHT".to_owned(),
            [] => format!("{} cases, no rule", result.cases),
            [first, others @ ..] => {
                let mark = if result.is_named_first() { "" } else { " (another rule)" };
                match others.len() {
                    0 => format!("{first}{mark}"),
                    more => format!("{first}{mark} and {more} more"),
                }
            }
        };
        let (name, about) = (result.fault.name(), result.fault.about());
        let _infallible = writeln!(text, "{name:<36} {by:<60} {about}");
    }
    let missed = results.iter().filter(|result| result.cases == 0).count();
    let named = results.iter().filter(|result| result.is_named_first()).count();
    let mut charged: Vec<_> = results.iter().map(|result| result.charged.len()).collect();
    charged.sort_unstable();
    let at = |percent: usize| charged.get(charged.len() * percent / 100).copied().unwrap_or(0);
    let _infallible = writeln!(
        text,
        "\n{} planted faults, {} caught, {missed} not; the first finding names a rule of the fault for {named}; \
         rules named: median {}, 90th percentile {}",
        results.len(),
        results.len() - missed,
        at(50),
        at(90),
    );
    text
}
