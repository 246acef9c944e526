//! The arguments of `gaugeblock certify`.

use std::num::NonZero;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use gaugeblock_runner::shard::Shard;

use crate::arguments::{DetailArguments, Format};
use crate::command::certificate::CertificateArguments;
use crate::command::comparison::ComparisonArguments;
use crate::command::controller;

const EXAMPLES: &str = "Examples:
  gaugeblock certify
      certify the production interpreter: about a second
  gaugeblock certify --controller rs274
      certify LinuxCNC's stand-alone interpreter against its own manual
  gaugeblock certify --controller rs274 --expectations conformance/expectations/rs274-2.9.toml
      fail only on divergences that are new or changed
  gaugeblock certify --controller rs274 --edition rs274-2.9-observed --report out
      certify it against its recorded behaviour; write out/report.html and the other report files
  gaugeblock certify --controller rs274 --baseline main/report.json --waivers waivers.toml
      in a pull request: fail only on what is new or changed and not waived
  gaugeblock certify --controller exec:./mill --certificate mill.json --key minisign.key
      write a certificate that `gaugeblock verify-certificate` and `minisign -V` check
  gaugeblock certify --controller linuxcnc --shard 3/8 --report shard-3
      run one of eight shards; after an interruption, repeat the call with --resume
  gaugeblock certify --controller rs274 --profile rs274-core --profile o-words
      fail unless every rule of these profiles passes
  gaugeblock certify --controller rs274 --only \"saved-state.feed / with decimals\"
      run one case, as a verdict prints it
  gaugeblock certify --controller rs274 --only 11.5.5 --only \"cycles.*-dwell\" --list
      list the cases of a section of the manual, and of all rules on a dwell of a cycle
  gaugeblock certify --controller exec:./mill --max-fail 1
      stop at the first case that diverges
  gaugeblock certify --controller reference --assertions-only
      judge the model by the assertions that people wrote, without a comparison with itself
  gaugeblock certify --controller exec:./mill --options options.json
      compare under the options that `fingerprint --format json` wrote
  gaugeblock certify --controller linuxcnc --only outputs --only inputs
      certify the whole LinuxCNC controller, with a simulated machine, on two chapters
  gaugeblock certify --controller \"exec:python3 adapter.py\" --profile modal-save
      certify a controller through an adapter (`gaugeblock adapter --help`)
  gaugeblock certify --controller rs274 --controller production --edition linuxcnc-2.9 --report both
      certify several controllers, one after the other; write both/comparison.html
  gaugeblock certify --controller rs274 --restrict-to offline:campaign
      judge rs274 only on what these answer sheets report, so that both verdicts can be compared

Exit status: 0 at least one case was judged, and every judged case passes, is known or is waived;
1 a divergence, a stale expectation, or a claimed profile that is not passed; 2 wrong call or input;
3 a case could not be judged, or every selected case is unsupported. Of several controllers: 1 if
one of them ends so, or else the greatest.";

const FILTER: &str = "Run only the rules or cases that this selects; may be repeated:
  saved-state, feed.zero     rules whose id begins with it
  cycles.*-dwell             rules whose whole id fits: `*` is any text, `?` any character
  11.5.5                     rules with a source in this section of the edition's documents
  feed.zero / at once        the case of exactly this name, as verdicts print it
  feed.zero/at*              cases whose name fits";

/// Options that need the results of all cases.
const WHOLE_RUN: [&str; 7] = [
    "report",
    "write_expectations",
    "profile",
    "expectations",
    "baseline",
    "waivers",
    "certificate",
];

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The controller: reference, production, rs274, linuxcnc, exec:COMMAND, tcp:HOST:PORT or offline:DIR; may be
    /// repeated, to compare several
    #[arg(long, short, value_name = "CONTROLLER", default_value = "production", long_help = controller::NAMES)]
    pub(super) controller: Vec<String>,
    /// Compare only the observables that this other controller also reports
    #[arg(long, value_name = "CONTROLLER", conflicts_with = "certificate")]
    pub(super) restrict_to: Option<String>,
    /// Edition of the documents [default: the controller's own]
    #[arg(long, value_name = "EDITION")]
    pub(super) edition: Option<String>,
    /// Run only these rules or cases: the beginning of an id (`saved-state`), a section (`11.5.5`), RULE/CASE; `*` and
    /// `?` are wildcards; may be repeated
    #[arg(long, value_name = "FILTER", long_help = FILTER)]
    pub(super) only: Vec<String>,
    /// Run only the case with exactly this name, of the rules of --only; may be repeated
    #[arg(long, value_name = "NAME", requires = "only")]
    pub(super) case: Vec<String>,
    /// Claim this profile: its unsupported and unjudged rules fail too; may be repeated
    #[arg(long, value_name = "PROFILE")]
    pub(super) profile: Vec<String>,
    /// Compare under the options of this file: the JSON output of `gaugeblock fingerprint`
    #[arg(long, value_name = "FILE")]
    pub(super) options: Option<PathBuf>,
    /// Judge the assertions of each case, which people wrote, and nothing else: no comparison with the model's outcome
    #[arg(long, conflicts_with_all = ["profile", "write_expectations", "shrink"])]
    pub(super) assertions_only: bool,
    #[command(flatten)]
    pub(super) against: ComparisonArguments,
    /// Write the divergences as a file for --expectations, and keep the reasons that the file has; read it before you
    /// use it
    #[arg(long, value_name = "FILE")]
    pub(super) write_expectations: Option<PathBuf>,
    /// Write report.html, report.json, junit.xml, report.txt, summary.md and cost.json into this folder; keep a journal
    /// there while the run lasts. Of several controllers, each has a folder there, next to comparison.html
    #[arg(long, value_name = "DIR")]
    pub(super) report: Option<PathBuf>,
    #[command(flatten)]
    pub(super) certificate: CertificateArguments,
    /// File that identifies the controller in reports and certificates, such as a firmware image; may be repeated
    /// [default: its binary, or the files that the command of exec: names]
    #[arg(long, value_name = "FILE")]
    pub(super) subject: Vec<PathBuf>,
    /// Resume an interrupted run from the journal in --report
    #[arg(long, requires = "report")]
    pub(super) resume: bool,
    /// Run part I of N, counted from 1; all parts together run every case once (`gaugeblock report merge`)
    #[arg(long, value_name = "I/N", default_value = "1/1")]
    pub(super) shard: Shard,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(super) format: Format,
    /// Percentage of cases that run a second time, to detect nondeterminism
    #[arg(long, value_name = "PERCENT", default_value_t = 1, value_parser = clap::value_parser!(u8).range(0..=100))]
    pub(super) repeat_percent: u8,
    /// Minimise the program of each divergence that no quirk explains, with at most ATTEMPTS runs each [without a
    /// value: 300]
    #[arg(long, value_name = "ATTEMPTS", num_args = 0..=1, default_value_t = 0, default_missing_value = "300", hide_default_value = true)]
    pub(super) shrink: u32,
    /// Whether to detect the option of each choice and quirk for the report [default: always with --report, unless the
    /// controller runs in real time]
    #[arg(long, value_name = "WHEN", value_enum)]
    pub(super) fingerprint: Option<FingerprintWhen>,
    /// Measure the controller's limits, too (`gaugeblock measure`), for the report
    #[arg(long, conflicts_with_all = ["list", "max_fail"])]
    pub(super) measure: bool,
    /// Run every program a second time without instrumentation, to check that it changes nothing [default: a sample]
    #[arg(long)]
    pub(super) check_observation: bool,
    /// Time limit of an adapter's answer, seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 10, value_parser = clap::value_parser!(u64).range(1..))]
    pub(super) time_limit: u64,
    /// Number of cases that run at once [default: number of processors + 1]
    #[arg(long, short, value_name = "N")]
    pub(super) jobs: Option<NonZero<usize>>,
    /// List the selected cases as RULE / CASE, and run none
    #[arg(long, conflicts_with_all = ["report", "write_expectations", "shrink", "certificate"])]
    pub(super) list: bool,
    /// Stop after so many cases that diverge; the rest is not run
    #[arg(long, value_name = "N", conflicts_with_all = WHOLE_RUN)]
    pub(super) max_fail: Option<NonZero<usize>>,
    #[command(flatten)]
    pub(super) detail: DetailArguments,
}

/// Whether the options of choices and quirks are detected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum FingerprintWhen {
    /// Detect them, also on a controller in real time
    Always,
    /// Do not detect them
    Never,
}
