//! `gaugeblock run`.

use std::path::{Path, PathBuf};

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use clap::Args;
use gaugeblock_report::escape_line;
use gaugeblock_suite::Suite;
use gaugeblock_vocabulary::scenario::Budget;
use gaugeblock_vocabulary::{BlockLocation, Bound, End, Outcome, Program, Scenario, Span};

use super::controller;
use crate::arguments::Format;
use crate::error::CliError;
use crate::program::run_setup::{RunSetup, TOOLPATH};
use crate::streams::{write_error_in_colours, write_out};

const EXAMPLES: &str = "Examples:
  gaugeblock run part.ngc
  gaugeblock run part.ngc --controller rs274
  gaugeblock run part.ngc --controller linuxcnc
  gaugeblock run part.ngc --scenario mill.toml --format json
  gaugeblock run part.ngc --option saved-state.motion-mode=restored
  gaugeblock run part.gpp --edition gpp-classic
  gaugeblock run part.nct

A subroutine file (*.ngc) in the folder of the program belongs to it if a call can reach it.
A file *.gpp is a post-processor program; its toolpath is the file part.toolpath in the same folder.
A file *.nct holds NCT custom macros.
The output is an outcome. Its first line names the version of the form; `gaugeblock schema outcome`
prints the form of --format json, which has the same fields.

Exit status: 0 the program ran, even if it ended with a fault; 2 wrong call or input;
3 the controller could not run it.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The program
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    how: RunSetup,
    /// The controller: reference, production, rs274, linuxcnc, exec:COMMAND, tcp:HOST:PORT or offline:DIR
    #[arg(long, short, value_name = "CONTROLLER", default_value = "reference", long_help = controller::NAMES)]
    controller: String,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

pub(crate) fn run(arguments: &Arguments, suite: &Suite) -> Result<u8, CliError> {
    let mut controller = controller::controller(&arguments.controller)?;
    let scenario = arguments.how.scenario(suite, &arguments.file, &[controller.as_ref()])?;
    controller.check_observation();
    controller.supports(&scenario).map_err(|why| {
        CliError::failure(
            format!("{} cannot run this program: {why}", arguments.controller),
            "try --controller reference",
        )
    })?;
    let outcome = controller
        .run(&scenario)
        .map_err(|error| CliError::failure(error.to_string(), "try --controller reference"))?;
    match arguments.format {
        Format::Text => write_out(&outcome.to_text()),
        Format::Json => {
            let text = serde_json::to_string_pretty(&outcome).map_err(|error| {
                CliError::failure(
                    error.to_string(),
                    "this is a bug in gaugeblock; please report it",
                )
            })?;
            write_out(&format!("{text}\n"));
        }
    }
    if let Some(pointer) = point_at(&outcome, &scenario, &arguments.file) {
        write_error_in_colours(&pointer);
    }
    Ok(0)
}

/// Where a run did not go on, with the line of the program; where the file ends before the program does, its last line.
pub(crate) fn point_at(outcome: &Outcome, scenario: &Scenario, file: &Path) -> Option<String> {
    let (block, span, message) = stop_reason(outcome, scenario)?;
    let title = Level::ERROR.primary_title(escape_line(&message));
    let Some((block, source)) = block.and_then(|block| source_line(block, &scenario.program))
    else {
        return Some(Renderer::styled().render(&[Group::with_title(title)]));
    };
    let block = &block;
    let line = usize::try_from(block.line).ok()?;
    let whole = 0..source.len();
    let range = span.map_or(whole.clone(), |span| {
        let place = |at: u32| usize::try_from(at).unwrap_or(usize::MAX).min(source.len());
        place(span.start)..place(span.end).max(place(span.start))
    });
    let range = if source.get(range.clone()).is_some() { range } else { whole };
    let snippet = Snippet::source(source)
        .line_start(line)
        .path(location_name(block, file))
        .annotation(AnnotationKind::Primary.span(range));
    Some(Renderer::styled().render(&[title.element(snippet)]))
}

/// A block's line in its file. The block after the last line stands for the end of the file: its last line.
fn source_line<'a>(
    block: &BlockLocation,
    program: &'a Program,
) -> Option<(BlockLocation, &'a str)> {
    let last = BlockLocation::new(&*block.file, block.line.saturating_sub(1));
    let lines = [block.clone(), last].into_iter();
    let found = lines.filter_map(|block| program.line(&block).map(|line| (block, line))).next();
    found.or_else(|| {
        Some((block.clone(), "")).filter(|_| &*block.file == Program::MAIN && block.line == 1)
    })
}

/// The block at which a run did not go on, the part of it, and why.
fn stop_reason<'a>(
    outcome: &'a Outcome,
    scenario: &Scenario,
) -> Option<(Option<&'a BlockLocation>, Option<Span>, String)> {
    match &outcome.end {
        End::Fault(fault) => Some((fault.block.as_ref(), fault.span, fault.message.clone())),
        End::Unsupported { block, what } => {
            Some((Some(block), None, format!("not supported: {what}")))
        }
        End::Unspecified { block, why } => {
            Some((Some(block), None, format!("not specified: {why}")))
        }
        End::BudgetExhausted { bound } => {
            let last = outcome.steps.last().map(|step| &step.block);
            Some((last, None, budget_used_up(*bound, &scenario.budget)))
        }
        End::ProgramEnd | End::PercentEnd | End::Endless | End::Paused | End::Aborted => None,
    }
}

/// Which bound of the budget ended a run, and how to raise it.
fn budget_used_up(bound: Bound, budget: &Budget) -> String {
    let reached = match bound {
        Bound::Steps => format!("{} executed blocks", budget.steps),
        Bound::Effects => format!("{} effects", budget.effects),
        Bound::Time => format!("{} seconds of virtual time", budget.time),
    };
    format!(
        "stopped after {reached}: the budget is used up; `budget.{bound}` of --scenario raises it"
    )
}

/// A block's file, as the caller knows it.
pub(crate) fn location_name(block: &BlockLocation, file: &Path) -> String {
    match &*block.file {
        Program::MAIN => file.display().to_string(),
        TOOLPATH => file.with_extension(TOOLPATH).display().to_string(),
        other => escape_line(other),
    }
}
