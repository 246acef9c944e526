//! `gaugeblock offline`: tests a control that cannot host a process.

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::PoisonError;
use std::sync::atomic::{AtomicUsize, Ordering};

use clap::{Args, Subcommand};
use gaugeblock_adapter::Adapter;
use gaugeblock_filesystem::PartialFolder;
use gaugeblock_offline::{
    Answer, BLOCKS, CONTROL, FORMAT, MANIFEST, Manifest, OPERATOR, Question, Requested, SAMPLES,
    SHEET, answer, blank_files, check_language, control_text, operator, questions, read_blocks,
    readme,
};
use gaugeblock_suite::{DEFAULT_EDITION, Edition, Suite};

use super::controller::not_a_campaign;
use super::{certify, controller, user_files};
use crate::error::CliError;
use crate::progress::Progress;
use crate::streams::{write_error, write_out};

const EXAMPLES: &str = "Examples:
  gaugeblock offline export --profile modal-save --edition linuxcnc-2.9 --out campaign
      write programs, instructions and answer sheets of a profile
  gaugeblock certify --controller offline:campaign --report report
      judge the sheets that are filled in, however few
  gaugeblock offline answer campaign --controller rs274
      fill the sheets in from a controller, to try the procedure";

/// Test a control that cannot host a process: export programs and answer sheets, import answers
#[derive(Debug, Subcommand)]
#[command(after_help = EXAMPLES)]
pub(crate) enum Offline {
    /// Write programs, instructions and answer sheets into a folder
    Export(Export),
    /// Fill in the answer sheets of a folder from a controller
    Answer(Filled),
}

const EXPORT_EXAMPLES: &str = "Examples:
  gaugeblock offline export --out campaign
      export every case of the default edition that can run offline
  gaugeblock offline export --profile rs274-core --profile modal-save --out campaign
      export the rules of two profiles
  gaugeblock offline export --only arcs.radius --only cycles.peck --out campaign
      export the rules whose ids begin so

The files contain no expectations.
The folder's README.md counts the cases that cannot run offline, by reason.

Exit status: 0 written; 2 wrong call or input.";

#[derive(Debug, Args)]
#[command(after_help = EXPORT_EXAMPLES)]
pub(crate) struct Export {
    /// Output folder; it must be empty or not exist
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Export only rules of this profile; may be repeated [default: all]
    #[arg(long, value_name = "PROFILE")]
    profile: Vec<String>,
    /// Export only these rules or cases, as --only of `certify` selects them; may be repeated [default: all]
    #[arg(long, value_name = "FILTER")]
    only: Vec<String>,
    /// Edition that the answers will be compared with
    #[arg(long, value_name = "EDITION", default_value = DEFAULT_EDITION)]
    edition: String,
}

const ANSWER_EXAMPLES: &str = "Examples:
  gaugeblock offline answer campaign --controller production
      fill the sheets in from the production interpreter
  gaugeblock offline answer campaign --controller rs274 --blocks
      record the position after each block, as in single-block mode

Sheets that are already filled in do not change.
Afterwards `certify --controller offline:campaign` and
`certify --controller CONTROLLER --restrict-to offline:campaign` give the same verdicts.

Exit status: 0 all open sheets are filled in; 2 wrong call or input;
3 the controller failed on a program, or is missing.";

#[derive(Debug, Args)]
#[command(after_help = ANSWER_EXAMPLES)]
pub(crate) struct Filled {
    /// Folder that `offline export` wrote
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// The controller: reference, production, rs274, linuxcnc, exec:COMMAND, tcp:HOST:PORT or offline:DIR
    #[arg(long, short, value_name = "CONTROLLER", default_value = "production", long_help = controller::NAMES)]
    controller: String,
    /// Record the position after each block instead of the modes at the end
    #[arg(long)]
    blocks: bool,
}

pub(crate) fn offline(command: &Offline, suite: &Suite) -> Result<u8, CliError> {
    match command {
        Offline::Export(arguments) => export(arguments, suite),
        Offline::Answer(arguments) => fill_in(arguments, suite),
    }
}

fn export(arguments: &Export, suite: &Suite) -> Result<u8, CliError> {
    let edition = crate::documents::edition(suite, &arguments.edition)?;
    certify::known_profiles(&arguments.profile, suite)?;
    check_language(edition)
        .map_err(|why| CliError::usage(why, "choose an edition of RS-274, such as linuxcnc-2.9"))?;
    // Without a slash at its end, so that something can be put beside it.
    let out: PathBuf = arguments.out.components().collect();
    check_folder_free(&out)?;
    certify::known_rules(&arguments.only, suite)?;
    let requested = Requested { profiles: arguments.profile.clone(), only: arguments.only.clone() };
    let (questions, left_out) = questions(suite, edition, &requested);
    let manifest = Manifest {
        format: FORMAT,
        gaugeblock_version: env!("CARGO_PKG_VERSION").to_owned(),
        suite: suite.digest.clone(),
        edition: edition.id.clone(),
        profiles: requested.profiles,
        only: requested.only,
        programs: questions.iter().map(|question| question.exported.clone()).collect(),
        left_out,
    };
    if questions.is_empty() {
        return Err(CliError::usage(
            "no case of these rules can run offline",
            "remove --profile or --only, or choose another edition",
        ));
    }
    write_campaign(&out, &manifest, &questions)?;
    let cases: usize = manifest.programs.iter().map(|exported| exported.cases).sum();
    let left_out: usize = manifest.left_out.values().sum();
    write_out(&format!(
        "{}: {} programs for {cases} cases of {}\n{left_out} cases cannot run offline\n",
        out.display(),
        manifest.programs.len(),
        edition.id
    ));
    for (why, count) in &manifest.left_out {
        write_out(&format!("  {count:5} {why}\n"));
    }
    Ok(0)
}

/// Refuses a folder that is not empty, and a path that is not a folder.
fn check_folder_free(folder: &Path) -> Result<(), CliError> {
    let name = folder.display();
    let mut entries = match std::fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(()),
        Err(error) => {
            return Err(CliError::usage(format!("{name}: {error}"), "--out expects a folder"));
        }
    };
    match entries.next() {
        None => Ok(()),
        Some(_) => Err(CliError::usage(
            format!("{name}: the folder is not empty"),
            "choose another folder with --out; existing files are never overwritten",
        )),
    }
}

/// Writes the whole folder: it is there whole or not at all.
fn write_campaign(
    folder: &Path,
    manifest: &Manifest,
    questions: &[Question],
) -> Result<(), CliError> {
    let refused = |error: std::io::Error| {
        let message = format!("{}: {error}", folder.display());
        CliError::usage(message, "check that the folder exists and is writable")
    };
    let json = serde_json::to_string_pretty(manifest).map_err(|error| {
        CliError::failure(error.to_string(), "this is a bug in gaugeblock; please report it")
    })?;
    let partial = PartialFolder::new(folder).map_err(refused)?;
    let write = |name: PathBuf, text: &str| partial.write(name, text).map_err(refused);
    write(MANIFEST.into(), &format!("{json}\n"))?;
    write("README.md".into(), &readme(manifest))?;
    write(CONTROL.into(), &control_text("", "", 0.001))?;
    for question in questions {
        let Question { exported, scenario, limits: _ } = question;
        let folder = Path::new(&exported.folder);
        write(folder.join(gaugeblock_vocabulary::Program::MAIN), &scenario.program.main)?;
        for (name, text) in &scenario.program.files {
            write(folder.join(name), text)?;
        }
        write(folder.join(OPERATOR), &operator(question))?;
        for (name, text) in blank_files(exported) {
            write(folder.join(name), &text)?;
        }
    }
    partial.finish().map_err(refused)
}

fn fill_in(arguments: &Filled, suite: &Suite) -> Result<u8, CliError> {
    let manifest = Manifest::read(&arguments.folder).map_err(not_a_campaign)?;
    let edition = crate::documents::edition(suite, &manifest.edition)?;
    if manifest.suite != suite.digest {
        return Err(CliError::usage(
            format!(
                "the sheets were exported from another suite (digest {}, this suite {})",
                manifest.suite, suite.digest
            ),
            "use the gaugeblock (and --suite) that exported them",
        ));
    }
    let controller = controller::controller(&arguments.controller)?;
    controller::check_options(controller.as_ref(), &suite.options(edition))?;
    let open = open(arguments, &manifest, suite, edition)?;
    let answered = run_all(&open, controller.as_ref(), arguments.blocks);
    let mut failed = 0;
    for (question, answered) in open.iter().zip(answered) {
        match answered {
            Some(Ok(files)) => {
                for (name, text) in files {
                    user_files::write_whole(
                        &arguments.folder.join(&question.exported.folder).join(name),
                        text,
                    )?;
                }
            }
            Some(Err(why)) => {
                failed += 1;
                write_error(&format!("{}: {why}", question.exported.folder));
            }
            None => failed += 1,
        }
    }
    let observables = controller.capabilities();
    let text = control_text(&observables.name, &observables.version, observables.resolution);
    user_files::write_whole(&arguments.folder.join(CONTROL), text)?;
    write_out(&format!(
        "{} sheets filled in, {} were filled in before, {failed} failed\n",
        open.len() - failed,
        manifest.programs.len() - open.len()
    ));
    Ok(if failed == 0 { 0 } else { 3 })
}

/// The programs whose sheets are still empty.
fn open(
    arguments: &Filled,
    manifest: &Manifest,
    suite: &Suite,
    edition: &Edition,
) -> Result<Vec<Question>, CliError> {
    let (questions, _) = questions(suite, edition, &manifest.requested());
    let mut open = Vec::new();
    for question in questions {
        let folder = arguments.folder.join(&question.exported.folder);
        let read = |name: &str| {
            let path = folder.join(name);
            gaugeblock_offline::read_file_if_there(&path).map_err(|error| {
                let message = format!("{}: {error}", path.display());
                CliError::usage(message, "remove it, or export the campaign again")
            })
        };
        let answer = Answer::read(&read(SHEET)?, &question.exported);
        let blocks = read_blocks(&read(BLOCKS)?, &question.exported.axes);
        let has_samples = folder.join(SAMPLES).exists();
        if answer == Ok(Answer::Blank) && blocks == Ok(None) && !has_samples {
            open.push(question);
        }
    }
    Ok(open)
}

type Files = Vec<(&'static str, String)>;

/// Runs them all, several at once.
fn run_all(
    questions: &[Question],
    controller: &dyn Adapter,
    by_block: bool,
) -> Vec<Option<Result<Files, gaugeblock_adapter::HarnessError>>> {
    let answered = Mutex::new((0..questions.len()).map(|_| None).collect::<Vec<_>>());
    let next = AtomicUsize::new(0);
    let jobs = crate::arguments::jobs(controller.best_jobs());
    let progress = Progress::of(questions.len(), "cases");
    std::thread::scope(|scope| {
        for _ in 0..jobs.get().min(questions.len()) {
            scope.spawn(|| {
                while let Some((place, question)) = {
                    let place = next.fetch_add(1, Ordering::Relaxed);
                    questions.get(place).map(|question| (place, question))
                } {
                    let done = answer(question, controller, by_block);
                    answered.lock().unwrap_or_else(PoisonError::into_inner)[place] = Some(done);
                    progress.add(1);
                }
            });
        }
    });
    progress.finish();
    answered.into_inner().unwrap_or_else(PoisonError::into_inner)
}
