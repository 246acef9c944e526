//! Two controllers on generated programs: what differs, by signature, with the smallest program of each.
//!
//! Programs are numbered; a number under a seed is one scenario ([`Plan::scenario`]). Chunks of numbers run in any
//! order and on any machine, each is [journaled](journal) when it is done, and what they found is put together in the
//! order of numbers, so that the same plan gives the same report however often it was interrupted.

mod comparable;
pub mod coverage_pass;
mod fragile;
pub mod groups;
pub mod journal;
mod judge;
pub mod shown;
pub mod signature;
pub mod statistics;

use std::collections::BTreeSet;
use std::num::NonZero;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc;

use gaugeblock_adapter::Adapter;
use gaugeblock_fuzz::generate::splice::{self, Seeds};
use gaugeblock_fuzz::generate::{self, Entropy, GeneratorConfig};
use gaugeblock_suite::{Choice, ChoiceKind};
use gaugeblock_vocabulary::scenario::Environment;
use gaugeblock_vocabulary::{Options, Scenario};

pub use crate::shard::Shard;
pub use comparable::comparable;
pub use fragile::is_fragile;
use groups::{Finding, Groups};
use journal::{Chunk, NotJudged};
pub use judge::{Difference, FuzzResult};
use statistics::Statistics;

/// How many programs are run and journaled together.
pub const CHUNK: u64 = 64;
/// So many programs on end have the same options: to choose others for each would cost 6 % of a program.
pub const ALIKE: u64 = 8;
/// How many programs of a chunk that could not be judged are kept.
const KEPT: usize = 2;

/// What is run on what.
#[derive(Debug)]
pub struct Plan<'a> {
    /// The controller under test.
    pub iut: &'a dyn Adapter,
    /// The controller that it is compared with.
    pub against: &'a dyn Adapter,
    /// What is generated.
    pub config: GeneratorConfig,
    /// What all choices follow from.
    pub seed: u64,
    /// How many of a hundred programs are parts of other ones.
    pub spliced: u32,
    /// Those other ones: the suite's cases.
    pub seeds: Seeds,
    /// The options of the edition that applies, without those that are the default of their choice: each run reads
    /// what is listed.
    pub options: Options,
    /// Choices of which each program takes some at random; none where the edition's options stand.
    pub random: Vec<Random<'a>>,
    /// The environment that answers where a scenario has none.
    pub environment: Option<String>,
}

/// A choice of which programs take an option at random.
#[derive(Clone, Copy, Debug)]
pub struct Random<'a> {
    choice: &'a Choice,
    /// Whether the options of the plan list it.
    listed: bool,
}

impl<'a> Random<'a> {
    /// The choices among some; a quirk is none.
    pub fn all(choices: impl IntoIterator<Item = &'a Choice>, options: &Options) -> Vec<Self> {
        let choices = choices.into_iter().filter(|choice| choice.kind == ChoiceKind::Choice);
        let listed = |choice: &Choice| options.get(&choice.id).is_some();
        choices.map(|choice| Self { choice, listed: listed(choice) }).collect()
    }
}

impl Plan<'_> {
    /// The scenario of a number.
    pub fn scenario(&self, number: u64) -> Scenario {
        self.scenario_under(number, self.options_of(number / ALIKE))
    }

    /// The same; the options are those of its group.
    fn scenario_under(&self, number: u64, options: Options) -> Scenario {
        let mut entropy = Entropy::from_seed(self.seed, number);
        let mut scenario = match self.splice(number) {
            Some(splice) => splice::spliced(&mut entropy, &self.seeds, splice),
            None => generate::scenario(&mut entropy, &self.config),
        };
        scenario.options = options;
        if scenario.environment == Environment::default() {
            scenario.environment.name.clone_from(&self.environment);
        }
        scenario
    }

    /// The options of a group of programs: the edition's, some of them chosen at random.
    fn options_of(&self, group: u64) -> Options {
        let mut options = self.options.clone();
        let mut entropy = Entropy::from_seed(!self.seed, group);
        for Random { choice, listed } in &self.random {
            if !entropy.chance(25) {
                continue;
            }
            let option = &entropy.pick(&choice.options).name;
            if *listed || !choice.is_default(option) {
                options.0.insert(choice.id.clone(), option.clone());
            }
        }
        options
    }

    /// Where a number is that of a splice: which one it is. The first of each hundred are.
    fn splice(&self, number: u64) -> Option<u64> {
        let share = u64::from(self.spliced);
        let (hundred, place) = (number / 100, number % 100);
        (place < share && !self.seeds.all.is_empty()).then_some(hundred * share + place)
    }

    /// Runs a chunk of so many programs.
    fn chunk(&self, chunk: u64, programs: u64, stop: &AtomicBool) -> Option<Chunk> {
        let mut statistics = Statistics::default();
        let mut groups = Groups::default();
        let mut not_judged = Vec::new();
        let first = chunk * CHUNK;
        let numbers: Vec<_> = (first..(first + CHUNK).min(programs)).collect();
        // A side that does many programs on end has its own code at hand: that is a tenth faster than by turns.
        let both_within = self.iut.is_within() && self.against.is_within();
        let together = if both_within { numbers.len().max(1) } else { 1 };
        for numbers in numbers.chunks(together) {
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
            // Each time the one that was made last comes first: most of it is still at hand. What is counted are
            // sums, whatever the order.
            let last_first = scenarios.iter().rev();
            let expected = last_first.map(|(_, scenario)| self.expected(scenario, &mut statistics));
            let expected: Vec<_> = expected.collect();
            let first_last = expected.into_iter().rev();
            for ((number, scenario), expected) in scenarios.into_iter().zip(first_last) {
                let both =
                    expected.and_then(|expected| self.found(&scenario, expected, &mut statistics));
                let result = both.map(|both| self.compared(&scenario, both, &mut statistics));
                match result.unwrap_or_else(|result| result) {
                    FuzzResult::Differs(difference) => {
                        groups.add(Finding::of(number, scenario, *difference));
                    }
                    FuzzResult::NotJudged(why) if not_judged.len() < KEPT => {
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

/// How much is run.
#[derive(Debug)]
pub struct Extent<'a> {
    /// The part of all chunks.
    pub shard: Shard,
    /// Programs of all shards together; `u64::MAX` for no end.
    pub programs: u64,
    /// How many run at once.
    pub jobs: NonZero<usize>,
    /// Chunks that were done before.
    pub done: &'a BTreeSet<u64>,
    /// Set from outside when it is time to stop; a chunk that is not finished is not counted.
    pub stop: &'a AtomicBool,
}

/// Runs chunk after chunk; `each` is told of every one when it is done, on the caller's thread, and says whether to
/// go on.
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
