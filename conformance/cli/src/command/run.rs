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
use crate::program::own_name;
use crate::program::remarks::remarks;
use crate::program::run_setup::RunSetup;
use crate::program::run_text::run_text;
use crate::streams::{write_error, write_error_in_colours, write_json, write_out};

const EXAMPLES: &str = "Examples:
  gaugeblock run part.ngc
  gaugeblock run part.ngc --controller rs274
  gaugeblock run part.ngc --controller linuxcnc
  gaugeblock run part.ngc --tools tool.tbl --parameters mill.var --ini mill.ini
  gaugeblock run part.ngc --check
  post part.cl | gaugeblock run - --format json
  gaugeblock run part.ngc --scenario mill.toml
  gaugeblock run part.ngc --option saved-state.motion-mode=restored
  gaugeblock run part.gpp --edition gpp-classic
  gaugeblock run part.nct

A subroutine file (*.ngc) in the folder of the program belongs to it if a call can reach it.
A file *.gpp is a post-processor program; its toolpath is the file part.toolpath in the same folder.
A file *.nct holds NCT custom macros.
The output is an outcome for people: after each block comes its text. `gaugeblock schema outcome`
prints the form of --format json, which has the same fields.

Exit status: 0 the program ran, even if it ended with a fault; 2 wrong call or input;
3 the controller could not run it. With --check: 1 the program does not reach its end;
3 the program has something that is not supported or not specified.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The program; - is standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    how: RunSetup,
    /// The controller: reference, production, rs274, linuxcnc, exec:COMMAND, tcp:HOST:PORT or offline:DIR
    #[arg(long, short, value_name = "CONTROLLER", default_value = "reference", long_help = controller::NAMES)]
    controller: String,
    /// End with status 1 if the program does not reach its end, for scripts
    #[arg(long)]
    check: bool,
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
            format!(
                "{} cannot run this program: {}",
                arguments.controller,
                own_name::in_text(&why, &arguments.file)
            ),
            "try --controller reference",
        )
    })?;
    let outcome = controller
        .run(&scenario)
        .map_err(|error| CliError::failure(error.to_string(), "try --controller reference"))?;
    let is_taken = scenario.program.files.contains_key(&own_name::own_name(&arguments.file));
    let named =
        if is_taken { outcome.clone() } else { own_name::of_outcome(&outcome, &arguments.file) };
    match arguments.format {
        Format::Text => write_out(&run_text(&outcome, &named, &scenario)),
        Format::Json => write_json(&named)?,
    }
    if let Some(pointer) = point_at(&outcome, &scenario, &arguments.file) {
        write_error_in_colours(&pointer);
    }
    for remark in remarks(&outcome, &scenario, &arguments.file) {
        write_error(&format!("note: {remark}"));
    }
    Ok(if arguments.check { status(&outcome.end) } else { 0 })
}

/// The exit status of --check. A program that begins again without end is lawful.
fn status(end: &End) -> u8 {
    match end {
        End::ProgramEnd | End::PercentEnd | End::StreamEnd | End::Endless => 0,
        End::Fault(_) | End::Paused | End::Aborted | End::BudgetExhausted { .. } => 1,
        End::Unsupported { .. } | End::Unspecified { .. } => 3,
    }
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
        .path(own_name::location_name(block, file))
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
        End::ProgramEnd
        | End::PercentEnd
        | End::StreamEnd
        | End::Endless
        | End::Paused
        | End::Aborted => None,
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
