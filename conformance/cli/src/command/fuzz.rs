//! `gaugeblock fuzz`.

use std::collections::{BTreeMap, BTreeSet};
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use clap::Args;
use gaugeblock_adapter::Adapter;
use gaugeblock_adapter::clock::now;
use gaugeblock_fuzz::generate::splice::Seeds;
use gaugeblock_fuzz::generate::{GeneratorConfig, Setups};
use gaugeblock_runner::fuzz::coverage_pass::is_long;
use gaugeblock_runner::fuzz::groups::{Finding, Groups, merged, shrunk};
use gaugeblock_runner::fuzz::journal::{Header, NotJudged};
use gaugeblock_runner::fuzz::statistics::Statistics;
use gaugeblock_runner::fuzz::{ALIKE, Extent, Plan, Random, Shard, run};
use gaugeblock_runner::journal::Journal;
use gaugeblock_suite::{Choice, ChoiceKind, Edition, Suite, options_of};
use gaugeblock_vocabulary::{Language, Options};

use super::fuzz_cases::{outcomes, rarely_reached, seeds, void};
use super::{controller, fuzz_report, options, user_files};
use crate::arguments::{self, Format};
use crate::error::CliError;
use crate::progress::Progress;
use crate::streams::{write_error, write_out};

/// How many programs without a verdict are listed.
const NOT_JUDGED: usize = 10;

const EXAMPLES: &str = "Examples:
  gaugeblock fuzz
      compare production with the reference model for a minute
  gaugeblock fuzz --controller rs274 --edition rs274-2.9-observed --programs 30000
      find behaviour of LinuxCNC's interpreter that no quirk explains
  gaugeblock fuzz --options random --seconds 36000 --report nightly
      try every option of the documents; after an interruption, repeat the call with --resume
  gaugeblock fuzz --edition gpp2 --programs 300000
      generate programs of a post-processor
  gaugeblock fuzz --edition nct-99m --programs 300000 --verbose
      generate custom macros; print how often each rule was reached
  gaugeblock fuzz --controller rs274 --known nightly/report.json --report tonight
      report only divergences that are not in an earlier report
  gaugeblock fuzz --shard 3/8 --seed 20 --programs 1000000 --report shard-3
      run one of eight shards
  gaugeblock fuzz --only io. --programs 10000
      generate only statements of one kind
  gaugeblock fingerprint --controller rs274 --format json > options.json
  gaugeblock fuzz --controller rs274 --options from:options.json
      compare under the controller's options, so that known differences do not hide new ones

Exit status: 0 no divergence; 1 divergences; 2 wrong call or input;
3 a program could not be judged, or too little was compared.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The controller: reference, production, rs274, linuxcnc, exec:COMMAND, tcp:HOST:PORT or offline:DIR
    #[arg(long, short, value_name = "CONTROLLER", default_value = "production", long_help = controller::NAMES)]
    controller: String,
    /// The controller to compare it with
    #[arg(long, value_name = "CONTROLLER", default_value = "reference")]
    against: String,
    /// Edition of the documents [default: the controller's own]
    #[arg(long, value_name = "EDITION")]
    edition: Option<String>,
    /// Options of choices: `edition`, `random` (new options every eight programs), or `from:FILE` (the output of
    /// `gaugeblock fingerprint --format json`)
    #[arg(long, value_name = "HOW", default_value = "edition")]
    options: String,
    /// Random seed: a number, or `random` for another one each time, which is printed
    #[arg(long, value_name = "N", default_value = "1", value_parser = arguments::seed)]
    seed: u64,
    /// Run part I of N, counted from 1; all parts together run every program once
    #[arg(long, value_name = "I/N", default_value = "1/1")]
    shard: Shard,
    /// Number of programs of all shards together [default: until --seconds have passed]
    #[arg(long, value_name = "N")]
    programs: Option<u64>,
    /// Duration, seconds, with the time of shrinking [default: 60, or unlimited with --programs]
    #[arg(long, value_name = "SECONDS", value_parser = clap::value_parser!(u64).range(1..))]
    seconds: Option<u64>,
    /// Number of programs that run at once [default: number of processors, or what suits the controller]
    #[arg(long, short, value_name = "N")]
    jobs: Option<NonZero<usize>>,
    /// Generate only statements whose name begins with this, such as `io.` or `saved`; may be repeated
    #[arg(long, value_name = "PREFIX")]
    only: Vec<String>,
    /// Percentage of programs with a deliberate error
    #[arg(long, value_name = "PERCENT", default_value_t = GeneratorConfig::default().mutated_programs, value_parser = clap::value_parser!(u32).range(0..=100))]
    error_rate: u32,
    /// Percentage of programs that are spliced from cases of the suite [default: 10 to 32, enough to reach each outcome
    /// of each rule about 20 times]
    #[arg(long, value_name = "PERCENT", value_parser = clap::value_parser!(u32).range(0..=100))]
    spliced: Option<u32>,
    /// Write the journal, the report and each minimised program into this folder
    #[arg(long, value_name = "DIR")]
    report: Option<PathBuf>,
    /// Resume an interrupted run from the journal in --report
    #[arg(long, requires = "report")]
    resume: bool,
    /// Report of an earlier run (report.json); its divergences are known, and only new ones are reported
    #[arg(long, value_name = "FILE")]
    known: Option<PathBuf>,
    /// Attempts to minimise each divergence; 0 keeps the generated programs
    #[arg(long, value_name = "N", default_value_t = 2000)]
    shrink: u32,
    /// Percentage of the blocks that must be compared for exit status 0
    #[arg(long, value_name = "PERCENT", default_value_t = 10, value_parser = clap::value_parser!(u32).range(0..=100))]
    min_compared: u32,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Print how often each rule, code and fault was reached
    #[arg(long, short)]
    verbose: bool,
}

pub(crate) fn fuzz(arguments: &Arguments, suite: &Suite) -> Result<u8, CliError> {
    let iut = controller::controller(&arguments.controller)?;
    let own = controller::own_edition(iut.as_ref(), suite);
    let edition = crate::documents::edition(suite, arguments.edition.as_deref().unwrap_or(own))?;
    controller::declared_options(iut.as_ref(), suite)?;
    let declared = iut.options();
    let (options, random) = options(arguments, suite, edition, &declared)?;
    let known = arguments.known.as_deref().map(fuzz_report::read).transpose()?.unwrap_or_default();
    if let Some(folder) = &arguments.report {
        user_files::create_folder(folder)?;
    }
    let against = controller::controller(&arguments.against)?;
    for controller in [&iut, &against] {
        controller::check_language(controller.as_ref(), edition)?;
    }
    controller::check_options(iut.as_ref(), &options)?;
    controller::check_options(against.as_ref(), &options)?;
    let options = without_defaults(options, suite);
    let mut plan = Plan {
        config: GeneratorConfig {
            language: edition.language,
            old_words: options.is("gpp.old-words", "accepted"),
            ..config(arguments, edition)?
        },
        seed: arguments.seed,
        seeds: Seeds { all: seeds(suite, edition, &options), ..Seeds::default() },
        random: random
            .then(|| undeclared(suite, edition, &declared))
            .map_or_else(Vec::new, |all| Random::all(all, &options)),
        environment: edition.environment.clone(),
        language: edition.has.clone(),
        void: void(suite, edition),
        ..Plan::new(iut.as_ref(), against.as_ref(), options)
    };
    plan.leave_out_unreadable();
    if arguments.only.is_empty() && arguments.spliced != Some(0) {
        let share = plan.coverage_pass(outcomes(suite, edition), arguments.programs);
        plan.spliced = arguments.spliced.unwrap_or(share);
    }
    let header = header(arguments, &plan, edition);
    let mut so_far = FuzzProgress::default();
    let journal = journal(arguments, &header, &mut so_far)?;
    let begun = now();
    let duration = duration(arguments);
    generate(arguments, &plan, journal, &mut so_far, duration)?;
    let seconds = begun.elapsed().as_secs_f64();
    let is_over = || duration.is_some_and(|duration| begun.elapsed() >= duration);
    let choices = causes(suite, edition, iut.as_ref());
    let findings =
        shrink_all(&plan, so_far.groups.findings(), arguments.shrink, &choices, &is_over);
    let (findings, known): (Vec<Finding>, Vec<Finding>) =
        findings.into_iter().partition(|finding| !known.iter().any(|known| known.is_as(finding)));
    let (rare, not_shown) = rarely_reached(suite, edition, &plan, &so_far.statistics);
    let report = fuzz_report::Report {
        header: &header,
        statistics: &so_far.statistics,
        findings: &findings,
        known: &known,
        rare: &rare,
        not_shown: &not_shown,
        not_judged: &so_far.not_judged,
        seconds,
        least_compared: arguments.min_compared,
    };
    if let Some(folder) = &arguments.report {
        report.write(folder)?;
    }
    match arguments.format {
        Format::Text => write_out(&report.text(arguments.verbose)),
        Format::Json => write_out(&format!("{:#}\n", report.json())),
    }
    Ok(report.exit_status())
}

/// Opens the journal of the run. If the run is resumed, adds its finished chunks to `so_far`.
fn journal(
    arguments: &Arguments,
    header: &Header,
    so_far: &mut FuzzProgress,
) -> Result<Option<Journal>, CliError> {
    let Some(folder) = &arguments.report else { return Ok(None) };
    let journal = Journal::open(folder, header, arguments.resume, &mut |chunk| so_far.add(chunk));
    let opened = journal.map_err(|why| {
        CliError::usage(why, "--resume continues the same call; another run needs another folder")
    });
    opened.map(Some)
}

/// What was done so far, in this call and the ones before.
#[derive(Default)]
struct FuzzProgress {
    done: BTreeSet<u64>,
    statistics: Statistics,
    groups: Groups,
    not_judged: BTreeMap<u64, NotJudged>,
}

impl FuzzProgress {
    fn add(&mut self, chunk: gaugeblock_runner::fuzz::journal::Chunk) {
        if self.done.insert(chunk.chunk) {
            self.statistics.add(&chunk.statistics);
            chunk.found.into_iter().for_each(|finding| self.groups.add(finding));
            self.not_judged.extend(chunk.not_judged.into_iter().map(|kept| (kept.number, kept)));
            while self.not_judged.len() > NOT_JUDGED {
                self.not_judged.pop_last();
            }
        }
    }
}

/// How long the run may take, shrinking included.
fn duration(arguments: &Arguments) -> Option<Duration> {
    let seconds = match (arguments.seconds, arguments.programs) {
        (None, None) => Some(60),
        (seconds, _) => seconds,
    };
    seconds.map(Duration::from_secs)
}

/// Runs programs. After a divergence it leaves a quarter of the duration for shrinking.
fn generate(
    arguments: &Arguments,
    plan: &Plan<'_>,
    mut journal: Option<Journal>,
    so_far: &mut FuzzProgress,
    duration: Option<Duration>,
) -> Result<(), CliError> {
    let processors = std::thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN);
    let best = plan.iut.best_jobs().or(plan.against.best_jobs());
    let progress = Progress::endless("programs");
    let (begun, stop) = (now(), AtomicBool::new(false));
    let mut mismatch = None;
    let done = so_far.done.clone();
    let extent = Extent {
        shard: arguments.shard,
        programs: arguments.programs.unwrap_or(u64::MAX),
        jobs: arguments.jobs.or(best).unwrap_or(processors),
        done: &done,
        stop: &stop,
    };
    run(plan, &extent, &mut |mut chunk| {
        if let Some(journal) = &mut journal {
            chunk.statistics.settle();
            mismatch = journal.done(&chunk).err().or(mismatch.take());
        }
        so_far.add(chunk);
        let (programs, groups) = (so_far.statistics.programs, so_far.groups.len());
        progress.set(programs, &format!("{groups} kinds of divergences"));
        let share = if groups == 0 || arguments.shrink == 0 { 1.0 } else { 0.75 };
        let is_over = duration.is_some_and(|duration| begun.elapsed() >= duration.mul_f64(share));
        mismatch.is_none() && !is_over
    });
    progress.finish();
    so_far.statistics.settle();
    match mismatch {
        Some(why) => Err(CliError::failure(
            format!("the journal: {why}"),
            "free space on the disk, then repeat the call with --resume",
        )),
        None => Ok(()),
    }
}

/// Divergences beyond this number stay as they were generated.
const SHRUNK_AT_MOST: usize = 150;

/// Shrinks the findings and finds their causes until the time is over. The other findings stay as generated.
fn shrink_all(
    plan: &Plan<'_>,
    mut findings: Vec<Finding>,
    attempts: u32,
    choices: &[&Choice],
    is_over: &dyn Fn() -> bool,
) -> Vec<Finding> {
    if attempts == 0 {
        return merged(findings);
    }
    // What was met most often first: it has the best chance to be seen whole.
    findings.sort_by(|a, b| b.count.cmp(&a.count).then_with(|| a.number.cmp(&b.number)));
    let progress = Progress::of(findings.len().min(SHRUNK_AT_MOST), "divergences shrunk");
    for finding in findings.iter_mut().take(SHRUNK_AT_MOST) {
        if is_over() {
            break;
        }
        *finding = shrunk(plan, finding, attempts, is_over);
        finding.causes = plan.causes(&finding.scenario, choices);
        progress.add(1);
    }
    progress.finish();
    merged(findings)
}

fn config(arguments: &Arguments, edition: &Edition) -> Result<GeneratorConfig, CliError> {
    if edition.language != Language::Rs274 && !arguments.only.is_empty() {
        let message = format!("--only is not available for {}", edition.language);
        return Err(CliError::usage(message, "remove --only"));
    }
    let stand_alone = |name: &str| name.starts_with("rs274");
    let setups = if stand_alone(&arguments.controller) || stand_alone(&arguments.against) {
        Setups::StandAlone
    } else {
        Setups::Operated
    };
    let statements = || gaugeblock_fuzz::generate::TABLE.iter().copied().flatten();
    for only in &arguments.only {
        if !statements().any(|statement| statement.name.starts_with(only.as_str())) {
            let known: Vec<&str> = statements().map(|statement| statement.name).collect();
            return Err(CliError::usage(
                format!("invalid `--only {only}`: no statement of the generator begins with it"),
                format!("expected one of: {}", known.join(", ")),
            ));
        }
    }
    Ok(GeneratorConfig {
        mutated_programs: arguments.error_rate,
        only: arguments.only.clone(),
        setups,
        ..GeneratorConfig::default()
    })
}

/// The possible causes of a divergence: the choices in the language of an edition, and the quirks of a controller.
fn causes<'a>(suite: &'a Suite, edition: &Edition, iut: &dyn Adapter) -> Vec<&'a Choice> {
    let own = format!("{}.", iut.capabilities().name);
    let can_explain = |choice: &&Choice| {
        choice.language == edition.language
            && (choice.kind == ChoiceKind::Choice || choice.id.starts_with(&own))
    };
    suite.choices.iter().filter(can_explain).collect()
}

/// The options that apply, with those that the controller declares, and whether each program changes some of them.
fn options(
    arguments: &Arguments,
    suite: &Suite,
    edition: &Edition,
    declared: &Options,
) -> Result<(Options, bool), CliError> {
    let mut options = options_of(suite, edition, declared);
    match arguments.options.as_str() {
        "edition" => Ok((options, false)),
        "random" => Ok((options, true)),
        how => match how.strip_prefix("from:") {
            Some(file) => {
                options::read_into(Path::new(file), suite, &mut options)?;
                Ok((options, false))
            }
            None => Err(CliError::usage(
                format!("invalid `--options {how}`"),
                "expected edition, random or from:FILE",
            )),
        },
    }
}

/// The choices in the language of an edition, without those for which the controller declares an option.
fn undeclared<'a>(suite: &'a Suite, edition: &Edition, declared: &Options) -> Vec<&'a Choice> {
    let open = suite
        .choices
        .iter()
        .filter(|choice| choice.language == edition.language && declared.get(&choice.id).is_none());
    open.collect()
}

/// Options without those that hold where nothing is listed.
fn without_defaults(mut options: Options, suite: &Suite) -> Options {
    for choice in &suite.choices {
        if options.get(&choice.id).is_some_and(|option| choice.is_default(option)) {
            options.0.remove(&choice.id);
        }
    }
    options
}

fn header(arguments: &Arguments, plan: &Plan<'_>, edition: &Edition) -> Header {
    let named = |side: &dyn Adapter| {
        format!("{} {}", side.capabilities().name, side.capabilities().version)
    };
    if arguments.controller == arguments.against {
        write_error("note: the controller is compared with itself");
    }
    Header {
        journal: 0,
        version: env!("CARGO_PKG_VERSION").to_owned(),
        iut: named(plan.iut),
        against: named(plan.against),
        options: format!("{}, {}", edition.id, arguments.options),
        config: format!(
            "mutated {}, spliced {} for a {} run, only {:?}, options of {ALIKE}",
            arguments.error_rate,
            plan.spliced,
            if is_long(arguments.programs) { "long" } else { "short" },
            arguments.only
        ),
        seed: arguments.seed,
        shard: arguments.shard.to_string(),
    }
}
