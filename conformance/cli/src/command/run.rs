//! `gaugeblock run`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use clap::Args;
use gaugeblock_report::escape_line;
use gaugeblock_suite::Suite;
use gaugeblock_vocabulary::scenario::{Budget, Environment};
use gaugeblock_vocabulary::{
    BlockLocation, Bound, End, Language, Outcome, Program, Scenario, Span,
};

use super::{controller, user_files};
use crate::arguments::Format;
use crate::error::CliError;
use crate::streams::{write_error, write_error_in_colours, write_out};

/// File extension of the toolpath that drives a post-processor program.
const TOOLPATH: &str = "toolpath";

const EXAMPLES: &str = "Examples:
  gaugeblock run part.ngc
  gaugeblock run part.ngc --controller rs274
  gaugeblock run part.ngc --controller linuxcnc
  gaugeblock run part.ngc --scenario mill.toml --format json
  gaugeblock run part.ngc --option saved-state.motion-mode=restored
  gaugeblock run part.gpp --edition gpp-classic
  gaugeblock run part.nct

Subroutine files (*.ngc) in the folder of the program are found by name.
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

/// How programs are run.
#[derive(Debug, Args)]
pub(crate) struct RunSetup {
    /// Edition of the documents [default: linuxcnc-2.8; gpp2 for a program *.gpp, nct-99m for *.nct]
    #[arg(long, value_name = "EDITION")]
    edition: Option<String>,
    /// Set the option of a choice or quirk; may be repeated
    #[arg(long, value_name = "CHOICE=OPTION")]
    option: Vec<String>,
    /// TOML file with machine, environment, operator, budget, options and further files (`gaugeblock schema scenario`)
    #[arg(long, value_name = "FILE")]
    scenario: Option<PathBuf>,
    /// Skip blocks that begin with a slash
    #[arg(long)]
    block_delete: bool,
}

impl RunSetup {
    /// The scenario of a program file, with the subroutine files of its folder.
    pub(crate) fn scenario(&self, suite: &Suite, file: &Path) -> Result<Scenario, CliError> {
        let edition = crate::documents::edition(
            suite,
            self.edition.as_deref().unwrap_or(language_by_name(file)),
        )?;
        if edition.language != Language::Rs274 && self.edition.is_none() {
            write_error(&format!(
                "note: {}: using edition {} because of the file extension",
                file.display(),
                edition.id
            ));
        }
        let mut scenario = match &self.scenario {
            Some(path) => {
                let hint = "`gaugeblock schema scenario` prints the form";
                user_files::read_form(path, "scenario (--scenario)", hint, Scenario::from_text)?
            }
            None => Scenario::default(),
        };
        scenario.program = Program {
            main: user_files::read_program(file)?,
            language: edition.language,
            files: match edition.language {
                Language::Rs274 => {
                    let mut files = files_beside(file);
                    files.extend(std::mem::take(&mut scenario.program.files));
                    files
                }
                Language::Gpp => toolpath(file, &scenario.program)?,
                Language::Nct => BTreeMap::new(),
            },
            block_delete: self.block_delete || scenario.program.block_delete,
            ..scenario.program
        };
        // The command line overrides the scenario, which overrides the edition.
        let named = scenario.options.0.iter().map(|(id, option)| format!("{id}={option}"));
        let named: Vec<_> = named.chain(self.option.iter().cloned()).collect();
        scenario.options = crate::documents::options_with(suite, edition, &named)?;
        if scenario.environment == Environment::default() {
            scenario.environment.name.clone_from(&edition.environment);
        }
        Ok(scenario)
    }

    /// The files that a program's scenario is read from, without subroutine files.
    pub(crate) fn inputs(&self, file: &Path) -> Vec<PathBuf> {
        let named = [file.to_path_buf(), file.with_extension(TOOLPATH)];
        named.into_iter().chain(self.scenario.clone()).collect()
    }
}

/// The edition that a file's name stands for.
fn language_by_name(file: &Path) -> &'static str {
    match file.extension().and_then(|extension| extension.to_str()) {
        Some("gpp") => "gpp2",
        Some("nct") => "nct-99m",
        Some(_) | None => gaugeblock_suite::DEFAULT_EDITION,
    }
}

/// The toolpath next to a post-processor program, or else that of the scenario's file.
fn toolpath(file: &Path, program: &Program) -> Result<BTreeMap<String, String>, CliError> {
    let beside = file.with_extension(TOOLPATH);
    if !beside.exists() {
        return Ok(program.files.clone());
    }
    Ok(BTreeMap::from([(TOOLPATH.to_owned(), user_files::read_text(&beside, "toolpath")?)]))
}

/// The other programs of the same folder. Unreadable ones are left out, because they may never be called.
fn files_beside(file: &Path) -> BTreeMap<String, String> {
    let named = |path: PathBuf| {
        let name = path.file_name()?.to_str()?.to_owned();
        Some((name, user_files::read_program(&path).ok()?))
    };
    paths_beside(file).filter_map(named).collect()
}

/// Where the other programs of the same folder are.
pub(crate) fn paths_beside(file: &Path) -> impl Iterator<Item = PathBuf> {
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    let entries =
        std::fs::read_dir(folder.unwrap_or(Path::new("."))).into_iter().flatten().flatten();
    entries
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "ngc"))
        .filter(|path| path.file_name() != file.file_name())
}

pub(crate) fn run(arguments: &Arguments, suite: &Suite) -> Result<u8, CliError> {
    let scenario = arguments.how.scenario(suite, &arguments.file)?;
    let mut controller = controller::controller(&arguments.controller)?;
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
