//! Arguments that several commands have.

use std::num::NonZero;

use clap::ValueEnum;

/// Output format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// Plain text
    Text,
    /// One JSON document
    Json,
}

/// The number of runs at once: as requested, else one more than there are processors.
pub(crate) fn jobs(asked: Option<NonZero<usize>>) -> NonZero<usize> {
    let processors = std::thread::available_parallelism();
    // While a controller starts or ends, its processor would be idle.
    let one_more = processors.ok().map(|processors| processors.saturating_add(1));
    asked.or(one_more).unwrap_or(NonZero::<usize>::MIN)
}
