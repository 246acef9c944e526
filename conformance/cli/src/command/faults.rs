//! `gaugeblock suite faults`: which planted faults the suite catches, and which rules its findings name.

use std::collections::{BTreeMap, BTreeSet};
use std::num::NonZero;
use std::ops::ControlFlow;

use gaugeblock_adapter::Adapter as _;
use gaugeblock_controllers::faulty::Faulty;
use gaugeblock_interpreter::faults::PlantedFault;
use gaugeblock_report::grouping::explain;
use gaugeblock_runner::certify::{
    Plan, RepeatSampling, RuleDivergence, RunOptions, Scope, run_plan,
};
use gaugeblock_runner::findings::{Coverage, findings_by};
use gaugeblock_runner::fingerprint::shown_open_options;
use gaugeblock_runner::shard::Shard;
use gaugeblock_suite::{Edition, Suite, only_case};
use serde::Deserialize;
use serde_json::json;

use crate::arguments::Format;
use crate::error::CliError;
use crate::progress::Progress;
use crate::streams::write_out;

/// What each fault breaks.
const PLANTED_FAULTS: &str = include_str!("../../planted-faults.toml");

/// The editions of post-processors and of custom macros, by the begin of a fault's name.
const EDITIONS_BY_PREFIX: [(&str, &str); 2] = [("gpp.", "gpp2"), ("nct.", "nct-99m")];

/// What the faults break, by their names.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PlantedFaults {
    /// The rules that each fault breaks, by their sentences, or the open option that it looks like.
    breaks: BTreeMap<String, Vec<String>>,
    /// Why the first finding of a fault names another rule, where it cannot name its own.
    exceptions: BTreeMap<String, String>,
}

/// What the suite finds of a planted fault.
struct FaultResult<'a> {
    fault: PlantedFault,
    /// The rules that the fault breaks, or the option that it looks like.
    broken: &'a [String],
    /// How many cases differ.
    cases: usize,
    /// Rules with a failing assertion.
    failing: BTreeSet<&'a str>,
    /// Cases of the broken rules with a failing assertion, as `RULE / CASE`.
    own_cases: Vec<String>,
    /// Options of open choices that the fault looks like, `choice = option`.
    looks_like: Vec<String>,
    /// The rule of each finding, the worst first.
    attributed: Vec<&'a str>,
}

/// What catches a fault if nothing but assertions is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum CaughtBy {
    /// Assertions of several cases of its rules.
    OwnCases,
    /// Assertions of one case of its rules.
    OneCase,
    /// Assertions of other rules.
    OtherPages,
    /// It looks like an option that the documents leave open, and is reported as such.
    Option,
    /// Nothing.
    Nothing,
}

impl FaultResult<'_> {
    /// What catches it if nothing but assertions is judged.
    fn caught_by(&self) -> CaughtBy {
        match self.own_cases.len() {
            0 if !self.looks_like.is_empty() => CaughtBy::Option,
            0 if self.failing.is_empty() => CaughtBy::Nothing,
            0 => CaughtBy::OtherPages,
            1 => CaughtBy::OneCase,
            _ => CaughtBy::OwnCases,
        }
    }

    /// Whether the suite notices the fault.
    fn is_caught(&self) -> bool {
        self.cases > 0 || !self.looks_like.is_empty()
    }

    /// What `certify` reports first: the rule of the first finding, or an open option that the fault looks like.
    fn first(&self) -> Option<&str> {
        self.attributed.first().copied().or_else(|| self.looks_like.first().map(String::as_str))
    }

    /// Whether the first finding names a rule that the fault breaks, or the option that it looks like.
    fn is_named_first(&self) -> bool {
        self.first().is_some_and(|first| self.broken.iter().any(|broken| broken == first))
    }
}

/// Certifies production with each fault whose name begins with one of `prefixes`; with every fault if there are none.
/// Fails if a fault is not caught, or if its first finding names another rule and no exception lists the fault.
///
/// With assertions only, it fails if no assertion of a rule of a fault fails.
pub(crate) fn faults(
    suite: &Suite,
    edition: &str,
    prefixes: &[String],
    scope: Scope,
    format: Format,
) -> Result<u8, CliError> {
    let edition = crate::documents::edition(suite, edition)?;
    let PlantedFaults { breaks, exceptions } = planted_faults(suite)?;
    let chosen = chosen(prefixes)?;
    let progress = Progress::of(chosen.len(), "faults");
    let mut results = Vec::new();
    let mut coverages = BTreeMap::new();
    for fault in chosen {
        let own = EDITIONS_BY_PREFIX.iter().find(|(prefix, _)| fault.name().starts_with(prefix));
        let edition = match own {
            Some((_, own)) => crate::documents::edition(suite, own)?,
            None => edition,
        };
        let broken = breaks.get(fault.name()).map_or(&[][..], Vec::as_slice);
        let coverage =
            coverages.entry(edition.id.as_str()).or_insert_with(|| Coverage::new(suite, edition));
        if let Some(result) = result_of((suite, edition, coverage), scope, fault, broken) {
            if matches!(format, Format::Text) {
                let line = if scope == Scope::AssertionsOnly { assertions_line } else { line };
                progress.suspend(|| write_out(&line(&result)));
            }
            results.push(result);
        }
        progress.add(1);
    }
    progress.finish();
    write_out(&match format {
        Format::Json => format!("{:#}\n", document(&results)),
        Format::Text if scope == Scope::AssertionsOnly => assertions_summary(&results),
        Format::Text => summary(&results),
    });
    if scope == Scope::AssertionsOnly {
        let is_open = |result: &FaultResult<'_>| {
            matches!(result.caught_by(), CaughtBy::Nothing | CaughtBy::OtherPages)
        };
        return Ok(u8::from(results.iter().any(is_open)));
    }
    let is_wrong = |result: &FaultResult<'_>| {
        let is_excepted = exceptions.contains_key(result.fault.name());
        !result.is_caught() || result.is_named_first() == is_excepted
    };
    Ok(u8::from(results.iter().any(is_wrong)))
}

/// Selects the faults whose names begin with one of the prefixes.
///
/// # Errors
/// A prefix of no fault.
fn chosen(prefixes: &[String]) -> Result<Vec<PlantedFault>, CliError> {
    let all = PlantedFault::ALL.iter().copied();
    let is_named =
        |prefix: &String| all.clone().any(|fault| fault.name().starts_with(prefix.as_str()));
    if let Some(unknown) = prefixes.iter().find(|prefix| !is_named(prefix)) {
        return Err(CliError::usage(
            format!("unknown planted fault: {unknown}"),
            "`gaugeblock suite faults` prints the names of all faults",
        ));
    }
    let begins = |fault: &PlantedFault| {
        prefixes.is_empty()
            || prefixes.iter().any(|prefix| fault.name().starts_with(prefix.as_str()))
    };
    Ok(all.filter(begins).collect())
}

/// Reads what each fault breaks; every fault has an entry, and every rule and option exists.
fn planted_faults(suite: &Suite) -> Result<PlantedFaults, CliError> {
    let hint = "correct conformance/cli/planted-faults.toml";
    let planted: PlantedFaults = toml::from_str(PLANTED_FAULTS)
        .map_err(|error| CliError::failure(error.to_string(), hint))?;
    let is_known = |name: &str| match name.split_once(" = ") {
        Some((choice, option)) => suite
            .choices
            .iter()
            .any(|known| known.id == choice && known.options.iter().any(|one| one.name == option)),
        None => suite.rule(name).is_some(),
    };
    let unknown_rule = planted.breaks.values().flatten().find(|name| !is_known(name));
    let is_fault = |name: &str| PlantedFault::ALL.iter().any(|fault| fault.name() == name);
    let mut named = planted.breaks.keys().chain(planted.exceptions.keys());
    let unknown_fault = named.find(|name| !is_fault(name));
    let missing = PlantedFault::ALL.iter().find(|fault| !planted.breaks.contains_key(fault.name()));
    match (unknown_rule, unknown_fault, missing) {
        (Some(rule), _, _) => Err(CliError::failure(format!("unknown rule {rule}"), hint)),
        (None, Some(fault), _) => Err(CliError::failure(format!("unknown fault {fault}"), hint)),
        (None, None, Some(fault)) => {
            Err(CliError::failure(format!("{} has no entry", fault.name()), hint))
        }
        (None, None, None) => Ok(planted),
    }
}

/// Certifies production with a fault, as `certify` does; nothing while another one is planted.
fn result_of<'a>(
    (suite, edition, coverage): (&'a Suite, &'a Edition, &mut Coverage<'a>),
    scope: Scope,
    fault: PlantedFault,
    broken: &'a [String],
) -> Option<FaultResult<'a>> {
    let jobs = std::thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN);
    let plan = Plan { suite, edition, only: &[], jobs, scope };
    let controller = Faulty::new(fault)?;
    let options = shown_open_options(suite, edition, &controller.options(), &controller);
    let run_options = RunOptions {
        shard: Shard::WHOLE,
        options: options.clone(),
        finished: Vec::new(),
        repeat: RepeatSampling::default(),
        shrink_attempts: 0,
        model: None,
        on_result: &mut |_| ControlFlow::Continue(()),
    };
    let run = run_plan(plan, &controller, run_options);
    let own = run.cases.iter().filter(|case| case.verdict.own_divergence().is_some());
    let failing = own.clone().map(|case| case.rule.id.as_str()).collect();
    let own_cases = own
        .filter(|case| broken.contains(&case.rule.id))
        .map(|case| only_case(&case.rule.id, case.name))
        .collect();
    let explains = |divergence: &RuleDivergence| {
        explain(&controller.capabilities().name, divergence)
            .is_some_and(|explanation| explanation.applies_to_controller)
    };
    let findings =
        findings_by(coverage, suite, &run, &explains, &|divergence| divergence.summary());
    let named = findings.iter().filter_map(|finding| finding.rule);
    let attributed = named.map(|rule| rule.id.as_str()).collect();
    let cases = run.cases.iter().filter(|case| case.verdict.divergence().is_some()).count();
    Some(FaultResult {
        fault,
        broken,
        cases,
        failing,
        own_cases,
        looks_like: options.0.iter().map(|(id, option)| format!("{id} = {option}")).collect(),
        attributed,
    })
}

fn document(results: &[FaultResult<'_>]) -> serde_json::Value {
    let faults: Vec<_> = results
        .iter()
        .map(|result| {
            json!({
                "fault": result.fault.name(), "about": result.fault.about(), "cases": result.cases,
                "broken": result.broken, "failing": result.failing, "looks_like": result.looks_like,
                "own_cases": result.own_cases, "attributed": result.attributed, "named_first": result.is_named_first(),
            })
        })
        .collect();
    json!({ "gaugeblock": "faults", "schema": gaugeblock_vocabulary::schema::VERSION, "faults": faults })
}

fn assertions_line(result: &FaultResult<'_>) -> String {
    let by = match (result.caught_by(), result.own_cases.as_slice()) {
        (CaughtBy::OwnCases, cases) => format!("{} cases of its rules", cases.len()),
        (CaughtBy::OneCase, cases) => format!("one case: {}", cases.join(", ")),
        (CaughtBy::OtherPages, _) => {
            let others: Vec<_> = result.failing.iter().copied().collect();
            format!("OTHER PAGES ALONE: {}", others.join(", "))
        }
        (CaughtBy::Option, _) => format!("looks like {}", result.looks_like.join(", ")),
        (CaughtBy::Nothing, _) => "NOT CAUGHT".to_owned(),
    };
    format!("{:<36} {by}\n", result.fault.name())
}

fn assertions_summary(results: &[FaultResult<'_>]) -> String {
    let count = |by| results.iter().filter(|result| result.caught_by() == by).count();
    let (several, one) = (count(CaughtBy::OwnCases), count(CaughtBy::OneCase));
    format!(
        "\n{} planted faults: an assertion of a rule of the fault catches {}, {one} of them by one case; \
         other pages alone catch {}, {} look like an option, {} are not caught\n",
        results.len(),
        several + one,
        count(CaughtBy::OtherPages),
        count(CaughtBy::Option),
        count(CaughtBy::Nothing),
    )
}

fn line(result: &FaultResult<'_>) -> String {
    let by = match result.first() {
        _ if !result.is_caught() => "NOT CAUGHT".to_owned(),
        None => format!("{} cases, no rule", result.cases),
        Some(first) => {
            let mark = if result.is_named_first() { "" } else { " (another rule)" };
            let looks_like = if result.attributed.is_empty() { "looks like " } else { "" };
            match result.attributed.len() {
                0 | 1 => format!("{looks_like}{first}{mark}"),
                all => format!("{first}{mark} and {} more", all - 1),
            }
        }
    };
    let (name, about) = (result.fault.name(), result.fault.about());
    format!("{name:<36} {by:<60} {about}\n")
}

fn summary(results: &[FaultResult<'_>]) -> String {
    let missed = results.iter().filter(|result| !result.is_caught()).count();
    let named = results.iter().filter(|result| result.is_named_first()).count();
    let mut attributed: Vec<_> = results.iter().map(|result| result.attributed.len()).collect();
    attributed.sort_unstable();
    let at =
        |percent: usize| attributed.get(attributed.len() * percent / 100).copied().unwrap_or(0);
    format!(
        "\n{} planted faults, {} caught, {missed} not; the first finding names a rule of the fault for {named}; \
         rules named: median {}, 90th percentile {}\n",
        results.len(),
        results.len() - missed,
        at(50),
        at(90),
    )
}
