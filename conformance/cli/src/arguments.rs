//! Arguments that several commands have.

use std::hash::{BuildHasher as _, Hasher as _, RandomState};
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

/// A seed: a number, or `random` for one that no run has had yet. A report prints it.
///
/// # Errors
/// Neither of both.
pub(crate) fn seed(text: &str) -> Result<u64, String> {
    if text != "random" {
        return text
            .parse()
            .map_err(|_| "expected a whole number, 0 or more, or random".to_owned());
    }
    // The keys of a hasher are random, and few digits can be typed again.
    let random = RandomState::new().build_hasher().finish();
    Ok(random % 1_000_000_000)
}

#[cfg(test)]
mod tests {
    use super::seed;

    #[test]
    fn seed_is_a_number_or_random() {
        assert_eq!(seed("7"), Ok(7));
        assert!(seed("-1").is_err());
        assert!(seed("").is_err());
        let drawn: Vec<_> = (0..4).map(|_| seed("random").expect("a seed")).collect();
        assert!(drawn.iter().any(|seed| *seed != drawn[0]), "{drawn:?}");
    }
}
