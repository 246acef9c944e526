//! `gaugeblock compare`.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;
use gaugeblock_adapter::Adapter;
use gaugeblock_compare::differences::differences;
use gaugeblock_compare::observe::Observed;
use gaugeblock_compare::{Capabilities, Comparison, Divergence, compare as compare_runs};
use gaugeblock_reference::motion::path::{differ, programmed};
use gaugeblock_suite::{ChoiceKind, Suite};
use gaugeblock_vocabulary::{BlockLocation, End, Outcome, Position, Scenario, Undetermined};
use serde_json::{Value, json};

use super::{controller, user_files};
use crate::arguments::Format;
use crate::error::CliError;
use crate::program::causes::{Cause, Search};
use crate::program::own_name;
use crate::program::run_setup::RunSetup;
use crate::streams::write_out;

const EXAMPLES: &str = "Examples:
  gaugeblock compare part.ngc --controller rs274
  gaugeblock compare part.ngc --controller rs274 --tools tool.tbl
  gaugeblock compare *.ngc --controller rs274 --edition rs274-2.9-observed
  gaugeblock compare part.ngc --controller rs274 --against reference --format json
  post part.cl | gaugeblock compare - --controller linuxcnc

All differences are listed, each at its block; one that lasts is listed where it begins. Against the
reference, known quirks and other options of choices that explain a difference are named and
passed over.

Exit status: 0 no difference, or none that a quirk or a choice does not explain; 1 a difference;
2 wrong call or input; 3 a program could not be compared.";

/// The remark where effects differ and the commanded path does not.
const SAME_PATH: &str = "  the path is the same, divided into different moves\n";

/// How far points of the same path may be apart, millimetres.
const PATH_TOLERANCE: f64 = 1e-6;

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The programs; - is standard input
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// The controller: reference, production, rs274, linuxcnc, exec:COMMAND, tcp:HOST:PORT or offline:DIR
    #[arg(long, short, value_name = "CONTROLLER", default_value = "production", long_help = controller::NAMES)]
    controller: String,
    /// The controller to compare it with
    #[arg(long, value_name = "CONTROLLER", default_value = "reference")]
    against: String,
    #[command(flatten)]
    how: RunSetup,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

pub(crate) fn compare(arguments: &Arguments, suite: &Suite) -> Result<u8, CliError> {
    let from_input = arguments.files.iter().filter(|file| user_files::is_standard_input(file));
    if from_input.count() > 1 {
        return Err(CliError::usage("standard input (-) is named twice", "name it once"));
    }
    let mut found_by = controller::controller(&arguments.controller)?;
    found_by.check_observation();
    let mut expected_by = controller::controller(&arguments.against)?;
    expected_by.check_observation();
    let both_sides = [found_by.as_ref(), expected_by.as_ref()];
    let scenarios = arguments
        .files
        .iter()
        .map(|file| Ok((file, arguments.how.scenario(suite, file, &both_sides)?)))
        .collect::<Result<Vec<_>, CliError>>()?;
    let sides = Sides { suite, found_by: found_by.as_ref(), expected_by: expected_by.as_ref() };
    let names = (arguments.against.as_str(), arguments.controller.as_str());
    let mut status = 0;
    let mut text = String::new();
    let mut results = Vec::new();
    for (file, scenario) in scenarios {
        let place = Place { file, scenario: &scenario, names };
        match sides.compare(&scenario) {
            Ok(compared) => {
                status = status.max(u8::from(!compared.left.is_empty()));
                results.push(place.document(&compared));
                text.push_str(&place.text(&compared));
            }
            Err(why) => {
                status = 3;
                let (name, why) = (place.name(), own_name::in_text(&why, file));
                results.push(json!({ "file": name, "not_compared": why }));
                let _infallible = writeln!(text, "{name}: not compared: {why}");
            }
        }
    }
    match arguments.format {
        Format::Text => write_out(&text),
        Format::Json => {
            write_out(&format!("{:#}\n", json!({ "gaugeblock": "comparison", "files": results })));
        }
    }
    Ok(status)
}

/// Two controllers.
struct Sides<'a> {
    suite: &'a Suite,
    found_by: &'a dyn Adapter,
    expected_by: &'a dyn Adapter,
}

/// How two runs of a program compare.
struct Compared<'a> {
    comparison: Comparison,
    resolution: f64,
    /// What quirks and choices do not explain.
    left: Vec<Divergence>,
    causes: Vec<Cause<'a>>,
    /// The block that both sides refuse, and why.
    refused: Option<(Option<BlockLocation>, String)>,
    same_path: bool,
}

impl<'a> Sides<'a> {
    fn compare(&self, scenario: &Scenario) -> Result<Compared<'a>, String> {
        let (found, expected) = (run(self.found_by, scenario)?, run(self.expected_by, scenario)?);
        let observables =
            self.found_by.observables(scenario).and(&self.expected_by.observables(scenario));
        let observed = Observed::of(&found);
        let (comparison, all) = all_differences(&Observed::of(&expected), &observed, &observables);
        let is_model = self.expected_by.capabilities().name == "reference";
        let (causes, left) = if is_model && !all.is_empty() {
            let search = Search {
                suite: self.suite,
                scenario,
                observed_edition: self.found_by.observed_edition(),
                blocks: found.steps.len(),
                differences: |scenario: &Scenario| {
                    let outcome = gaugeblock_reference::run(scenario).0;
                    let has_answer = outcome.end.undetermined().is_none();
                    let differences =
                        || all_differences(&Observed::of(&outcome), &observed, &observables).1;
                    has_answer.then(differences)
                },
            };
            search.causes(all)
        } else {
            (Vec::new(), all)
        };
        let refused = match (&expected.end, &found.end) {
            (End::Fault(fault), End::Fault(_)) if left.is_empty() => {
                Some((fault.block.clone(), fault.message.clone()))
            }
            _ => None,
        };
        let effects_differ = left.iter().any(|difference| difference.field == "effect");
        Ok(Compared {
            comparison,
            resolution: observables.resolution,
            left,
            causes,
            refused,
            same_path: effects_differ && is_same_path(&expected, &found),
        })
    }
}

/// Runs a program on a controller, which has to have an answer.
fn run(controller: &dyn Adapter, scenario: &Scenario) -> Result<Outcome, String> {
    let name = controller.capabilities().name.clone();
    controller.supports(scenario).map_err(|why| format!("{name} cannot run this: {why}"))?;
    let outcome = controller.run(scenario).map_err(|error| format!("{name}: {error}"))?;
    match outcome.end.undetermined() {
        Some(Undetermined::Unsupported(what)) => {
            Err(format!("{name} does not support this: {what}"))
        }
        Some(Undetermined::Unspecified(why)) => Err(format!("{name}: not specified: {why}")),
        None => Ok(outcome),
    }
}

/// How two runs compare, and each of their differences; none if they are equal.
fn all_differences(
    expected: &Observed,
    found: &Observed,
    observables: &Capabilities,
) -> (Comparison, Vec<Divergence>) {
    let comparison = compare_runs(expected, found, observables);
    let Some(first) = comparison.divergence.clone() else { return (comparison, Vec::new()) };
    let all = differences(expected, found, observables);
    (comparison, if all.is_empty() { vec![first] } else { all })
}

/// Whether two finished runs command the same path, however it is divided into moves.
///
/// The result is a remark, not a verdict: the documents say which move each block makes. A controller that reports
/// only its path declares so.
fn is_same_path(expected: &Outcome, found: &Outcome) -> bool {
    let path = |outcome: &Outcome| {
        let ended = matches!(outcome.end, End::ProgramEnd | End::PercentEnd);
        ended.then(|| programmed(outcome, Position::default()))
    };
    let (Some(expected), Some(found)) = (path(expected), path(found)) else { return false };
    differ(&expected, &found, PATH_TOLERANCE).is_none()
}

/// A program, and the names of the controllers: the one that is compared with, and the one that is compared.
struct Place<'a> {
    file: &'a Path,
    scenario: &'a Scenario,
    names: (&'a str, &'a str),
}

impl Place<'_> {
    fn name(&self) -> String {
        user_files::program_name(self.file)
    }

    fn text(&self, compared: &Compared<'_>) -> String {
        let mut text = self.headline(compared);
        for cause in &compared.causes {
            let kind = match cause.choice.kind {
                ChoiceKind::Quirk => "quirk",
                ChoiceKind::Choice => "choice",
            };
            let from = self.block(cause.block.as_ref());
            let _infallible = writeln!(
                text,
                "  {kind} {}, first at {from}\n    {}",
                cause.name(),
                cause.choice.sentence
            );
        }
        for difference in &compared.left {
            text.push_str(&self.difference(difference));
        }
        if compared.same_path {
            text.push_str(SAME_PATH);
        }
        text
    }

    fn headline(&self, compared: &Compared<'_>) -> String {
        let name = self.name();
        let values = compared.comparison.compared.total();
        let resolution = match compared.resolution {
            exact if exact <= 0.0 => String::new(),
            resolution => format!(", to {resolution}"),
        };
        let explained = match compared.causes.len() {
            0 => String::new(),
            1 => "; 1 quirk or choice explains another".to_owned(),
            count => format!("; {count} quirks or choices explain others"),
        };
        if let Some((block, why)) = &compared.refused {
            let place = self.block(block.as_ref());
            return format!(
                "{place}: both refuse: {why} ({values} values compared{resolution}{explained})\n"
            );
        }
        match compared.left.len() {
            0 if compared.causes.is_empty() => {
                format!("{name}: no difference ({values} values compared{resolution})\n")
            }
            0 => format!("{name}: no difference that a quirk or a choice does not explain\n"),
            1 => format!("{name}: 1 difference{explained}\n"),
            count => format!("{name}: {count} differences{explained}\n"),
        }
    }

    /// A difference with the source of its block.
    fn difference(&self, difference: &Divergence) -> String {
        let (against, controller) = self.names;
        let width = against.len().max(controller.len());
        let Divergence { block, field, expected, found } = difference;
        let source = self.source(block.as_ref());
        let [expected, found] = [expected, found].map(|text| own_name::in_text(text, self.file));
        format!(
            "{}: {field}\n      | {}\n  {against:width$}  {expected}\n  {controller:width$}  {found}\n",
            self.block(block.as_ref()),
            source.unwrap_or("(the end)"),
        )
    }

    fn source(&self, block: Option<&BlockLocation>) -> Option<&str> {
        block.and_then(|block| self.scenario.program.line(block))
    }

    /// A block as the caller knows it, or the program.
    fn block(&self, block: Option<&BlockLocation>) -> String {
        match block {
            Some(block) => {
                format!("{}:{}", own_name::location_name(block, self.file), block.line)
            }
            None => self.name(),
        }
    }

    fn document(&self, compared: &Compared<'_>) -> Value {
        let difference = |difference: &Divergence| {
            let block = difference.block.clone().map(|block| own_name::of_block(block, self.file));
            let [expected, found] = [&difference.expected, &difference.found]
                .map(|text| own_name::in_text(text, self.file));
            json!({
                "block": block, "source": self.source(difference.block.as_ref()),
                "field": difference.field, "expected": expected, "found": found,
            })
        };
        let differences: Vec<Value> = compared.left.iter().map(difference).collect();
        let causes = compared.causes.iter().map(|cause| {
            json!({
                "id": cause.choice.id, "kind": cause.choice.kind, "option": cause.option,
                "first_at": self.block(cause.block.as_ref()),
            })
        });
        let refused = compared.refused.as_ref().map(|(block, why)| {
            json!({ "block": block.clone().map(|block| own_name::of_block(block, self.file)), "why": why })
        });
        let mut document = json!({
            "file": self.name(), "equal": compared.left.is_empty() && compared.causes.is_empty(),
            "compared": compared.comparison.compared, "masked": compared.comparison.masked,
            "resolution": compared.resolution, "both_refuse": refused,
            "explained_by": causes.collect::<Vec<_>>(), "differences": differences,
        });
        // The first difference is also a member of its own.
        if let Some(Value::Object(first)) = differences.into_iter().next()
            && let Value::Object(members) = &mut document
        {
            members.extend(first);
            members.insert("same_path".to_owned(), json!(compared.same_path));
        }
        document
    }
}
