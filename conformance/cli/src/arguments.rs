//! Arguments that several commands have.

use std::num::NonZero;

use clap::{Args, ValueEnum};
use gaugeblock_report::terminal::Detail;

/// Output format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// Plain text
    Text,
    /// One JSON document
    Json,
}

/// How much of a report is printed.
#[derive(Debug, Args)]
pub(crate) struct DetailArguments {
    /// Print the counts and the verdict alone
    #[arg(long, short, conflicts_with_all = ["all", "verbose"])]
    quiet: bool,
    /// Print all findings, not the ten worst alone
    #[arg(long, conflicts_with = "verbose")]
    all: bool,
    /// Also print every divergence, known ones among them, and how many values were not compared because the
    /// controller does not report them
    #[arg(long, short)]
    verbose: bool,
}

impl DetailArguments {
    /// What they say.
    pub(crate) fn detail(&self) -> Detail {
        match (self.quiet, self.all, self.verbose) {
            (true, _, _) => Detail::Verdict,
            (_, true, _) => Detail::Findings,
            (_, _, true) => Detail::Everything,
            _ => Detail::Worst,
        }
    }
}

/// The number of runs at once: as requested, else one more than there are processors.
pub(crate) fn jobs(asked: Option<NonZero<usize>>) -> NonZero<usize> {
    let processors = std::thread::available_parallelism();
    // While a controller starts or ends, its processor would be idle.
    let one_more = processors.ok().map(|processors| processors.saturating_add(1));
    asked.or(one_more).unwrap_or(NonZero::<usize>::MIN)
}
