//! Compares two controllers on generated programs. Divergences are grouped by signature, with the smallest program of
//! each.
//!
//! Programs are numbered; a number under a seed is one scenario ([`Plan::scenario`]). Chunks of numbers run in any
//! order and on any machine. Each finished chunk is written to a [journal]. The findings are merged in the order of
//! numbers, so that the same plan gives the same report, whether it was interrupted or not.

mod causes;
pub mod comparability;
mod comparable;
pub mod coverage_pass;
mod fragile;
pub mod groups;
pub mod journal;
mod judge;
mod plan;
pub mod signature;
pub mod statistics;

use std::collections::BTreeSet;
use std::num::NonZero;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc;

pub use crate::shard::Shard;
pub use comparable::comparable;
pub use fragile::is_fragile;
use groups::{Finding, Groups};
use journal::{Chunk, NotJudged};
pub use judge::{Difference, FuzzResult};
pub use plan::{ALIKE, Plan, Random};
use statistics::Statistics;

/// Programs of a chunk.
pub const CHUNK: u64 = 64;
/// Programs without a verdict that the report of a chunk lists; it counts the others.
const NOT_JUDGED_MAX: usize = 2;

impl Plan<'_> {
    /// Runs a chunk of programs. `None` if the run was stopped.
    fn chunk(&self, chunk: u64, programs: u64, stop: &AtomicBool) -> Option<Chunk> {
        let mut statistics = Statistics::default();
        let mut groups = Groups::default();
        let mut not_judged = Vec::new();
        let first = chunk * CHUNK;
        let numbers: Vec<_> = (first..(first + CHUNK).min(programs)).collect();
        // Controllers in this process run all programs of a chunk in a row: that keeps their code in the cache, and is
        // a tenth faster.
        let both_in_process = self.iut.is_in_process() && self.against.is_in_process();
        let programs_in_a_row = if both_in_process { numbers.len().max(1) } else { 1 };
        for numbers in numbers.chunks(programs_in_a_row) {
            if stop.load(Ordering::Relaxed) {
                return None;
            }
            let scenarios: Vec<_> = numbers
                .chunk_by(|one, next| one / ALIKE == next / ALIKE)
                .flat_map(|group| {
                    let options = self.options_of(group[0] / ALIKE);
                    group
                        .iter()
                        .map(move |number| (*number, self.scenario_under(*number, options.clone())))
                })
                .collect();
            // The last scenario runs first, while it is in the cache. The statistics are sums, so the order does not
            // matter.
            let last_first = scenarios.iter().rev();
            let expected =
                last_first.map(|(_, scenario)| self.run_expected(scenario, &mut statistics));
            let expected: Vec<_> = expected.collect();
            let first_first = expected.into_iter().rev();
            for ((number, scenario), expected) in scenarios.into_iter().zip(first_first) {
                let both = expected
                    .and_then(|expected| self.run_tested(&scenario, expected, &mut statistics));
                let result = both.map(|both| self.compare_pair(&scenario, both, &mut statistics));
                let (Ok(result) | Err(result)) = result;
                match result {
                    FuzzResult::Differs(difference) => {
                        groups.add(Finding::of(number, scenario, *difference));
                    }
                    FuzzResult::NotJudged(why) if not_judged.len() < NOT_JUDGED_MAX => {
                        not_judged.push(NotJudged { number, why, scenario });
                    }
                    FuzzResult::Same
                    | FuzzResult::Fragile
                    | FuzzResult::Unsupported
                    | FuzzResult::Unspecified
                    | FuzzResult::NotJudged(_) => {}
                }
            }
        }
        Some(Chunk { chunk, statistics, found: groups.findings(), not_judged })
    }
}

/// The part of a campaign that runs here.
#[derive(Debug)]
pub struct Extent<'a> {
    /// The shard of the chunks.
    pub shard: Shard,
    /// Programs of all shards together; `u64::MAX` for an endless run.
    pub programs: u64,
    /// Chunks that run at the same time.
    pub jobs: NonZero<usize>,
    /// Finished chunks of an earlier run.
    pub done: &'a BTreeSet<u64>,
    /// Set by the caller to stop; an unfinished chunk is not counted.
    pub stop: &'a AtomicBool,
}

/// Runs chunk after chunk. `each` receives every finished chunk on the caller's thread, and returns whether to
/// continue.
pub fn run(plan: &Plan<'_>, extent: &Extent<'_>, each: &mut dyn FnMut(Chunk) -> bool) {
    let next = AtomicU64::new(0);
    let (sender, receiver) = mpsc::sync_channel::<Chunk>(64);
    std::thread::scope(|scope| {
        for _ in 0..extent.jobs.get() {
            let (sender, next) = (sender.clone(), &next);
            scope.spawn(move || {
                loop {
                    let chunk = extent.shard.nth(next.fetch_add(1, Ordering::Relaxed));
                    if chunk.saturating_mul(CHUNK) >= extent.programs {
                        break;
                    }
                    if extent.done.contains(&chunk) {
                        continue;
                    }
                    let done = plan.chunk(chunk, extent.programs, extent.stop);
                    let Some(done) = done else { break };
                    if sender.send(done).is_err() {
                        break;
                    }
                }
            });
        }
        drop(sender);
        for chunk in &receiver {
            if !each(chunk) {
                extent.stop.store(true, Ordering::Relaxed);
            }
        }
    });
}
