//! What generated programs reach too rarely, so that splices of the suite's cases make up for it.

use std::collections::BTreeMap;
use std::ops::RangeFrom;

use gaugeblock_fuzz::generate::Entropy;
use gaugeblock_fuzz::generate::splice::{self, Rare};
use gaugeblock_reference::{RuleOutcome, Tally, run};
use gaugeblock_vocabulary::scenario::Environment;
use gaugeblock_vocabulary::{End, Program, Scenario};

use super::Plan;

/// Programs of a coverage pass.
const PROGRAMS: u64 = 16_000;
/// Programs of a coverage pass that checks each statement against the controllers, which takes longer.
const CHECKED_PROGRAMS: u64 = 2_000;
/// After so many splices it is judged whether those before a case hinder it.
const TRIALS: u64 = 16;
/// So many splices are made for the same rare thing at most.
const MOST: u64 = 96;
/// The seed of coverage passes: what is rare is the same for all seeds of a plan.
const SEED: u64 = 0;
/// Programs of a plan that are to reach each outcome: more than [`ENOUGH`](super::statistics::ENOUGH), since a few
/// are not judged in the end.
const WANTED: f64 = 24.0;
/// By how many standard deviations chance may be unkind.
const UNKIND: f64 = 3.0;
/// How many others run before a case at most: where it is refused, where not, and where they would hinder it.
const OTHERS: [u32; 3] = [2, 8, 0];
/// The fewest and the most splices of a hundred programs.
const SPLICED: (u64, u64) = (10, 32);
/// Plans of up to so many programs, and those without an end, are held for ones of [`SHORT`], all others for ones of
/// [`LONG`], so that a plan may go on further than it was begun for.
const SHORT_UP_TO: u64 = 100_000;
const SHORT: u64 = 30_000;
const LONG: u64 = 1_000_000;

/// Whether a plan of so many programs counts as a long one: it has other programs than a short one.
pub fn is_long(programs: Option<u64>) -> bool {
    programs.is_some_and(|programs| programs > SHORT_UP_TO)
}

/// An outcome of a rule.
type Reached<'r> = (&'r str, RuleOutcome);

impl Plan<'_> {
    /// Runs some programs on the model, and puts down by which seeds those of some outcomes are reached that a plan
    /// of so many programs would rarely reach. Without it splices take all seeds alike. How many of a hundred
    /// programs should be splices.
    ///
    /// Costs a second or two.
    pub fn coverage_pass<'r>(
        &mut self,
        outcomes: impl IntoIterator<Item = Reached<'r>>,
        programs: Option<u64>,
    ) -> u32 {
        let programs = if is_long(programs) { LONG } else { SHORT };
        let mut chances = self.chances_without_splices(programs);
        let (by_seed, runs_on) = self.reached_by_seeds();
        let mut missing = Vec::new();
        for outcome in outcomes {
            let Some(does) = by_seed.get(&outcome) else { continue };
            if chances.get(&outcome).is_none_or(|chance| chance.surely() < WANTED) {
                let before = does.iter().copied().filter(|place| runs_on[*place]);
                self.seeds.before.extend(before);
                missing.push((outcome, does));
            }
        }
        // What few seeds do comes first: they do of what many do, too.
        missing.sort_by_key(|(_, does)| does.len());
        let mut numbers = PROGRAMS..;
        let mut splices = Vec::new();
        for (outcome, does) in missing {
            let chance = chances.get(&outcome).copied().unwrap_or_default();
            if chance.surely() >= WANTED {
                continue;
            }
            let (rare, made) = self.made_for(outcome, does, chance, &mut numbers);
            for (outcome, chance) in made.chances() {
                let before = chances.entry(outcome).or_default();
                *before = before.plus(chance);
            }
            self.seeds.rare.push(rare);
            splices.push(made.splices);
        }
        for turn in 0..splices.iter().copied().max().unwrap_or(0) {
            let again = splices.iter().enumerate().filter(|(_, splices)| **splices > turn);
            self.seeds.turns.extend(again.map(|(place, _)| place));
        }
        let turns = u64::try_from(self.seeds.turns.len()).unwrap_or(u64::MAX);
        let splices = turns.saturating_mul(100 * 100) / splice::rare_among(100);
        let share = splices.div_ceil(programs);
        u32::try_from(share.clamp(SPLICED.0, SPLICED.1)).unwrap_or_default()
    }

    /// How many of so many programs are likely to reach each outcome, by what those of a coverage pass reach.
    fn chances_without_splices(&self, programs: u64) -> BTreeMap<Reached<'static>, Chance> {
        let mut reached = Tally::default();
        let sample = if self.readable.is_some() { CHECKED_PROGRAMS } else { PROGRAMS };
        for number in 0..sample {
            let mut scenario = self.generated(SEED, number);
            scenario.options.clone_from(&self.options);
            if self.is_run(&scenario) {
                reached.add(&run(&scenario).1);
            }
        }
        let times = number(programs * (100 - SPLICED.1)) / number(100 * sample);
        let chances = reached.iter().map(|(rule, outcome, programs)| {
            let mean = number(programs) * times;
            // Both the coverage pass and the plan are random.
            ((rule, outcome), Chance { mean, variance: mean * times + mean })
        });
        chances.collect()
    }

    /// By which seeds that can be compared each outcome is reached, and which of all seeds may run before others.
    fn reached_by_seeds(&self) -> (BTreeMap<Reached<'static>, Vec<usize>>, Vec<bool>) {
        let mut by_seed: BTreeMap<_, Vec<usize>> = BTreeMap::new();
        let mut runs_on = vec![false; self.seeds.all.len()];
        for (place, scenario) in self.seeds.all.iter().enumerate() {
            let (outcome, coverage) = run(scenario);
            if self.reason_not_compared(scenario, &outcome).is_some() {
                continue;
            }
            runs_on[place] =
                may_precede(scenario, self.environment.as_ref()) && outcome.end == End::ProgramEnd;
            for reached in coverage.iter() {
                by_seed.entry(reached).or_default().push(place);
            }
        }
        (by_seed, runs_on)
    }

    /// Splices until an outcome is reached often enough: with others before it, unless fewer than half of them reach
    /// it.
    fn made_for(
        &self,
        outcome: Reached<'_>,
        does: &[usize],
        chance: Chance,
        numbers: &mut RangeFrom<u64>,
    ) -> (Rare, Made) {
        let [if_refused, if_accepted, alone] = OTHERS;
        let refused = outcome.1 == RuleOutcome::Refused;
        let mut rare =
            Rare { does: does.to_vec(), others: if refused { if_refused } else { if_accepted } };
        let mut made = Made::default();
        while made.splices < MOST && chance.plus(made.chance_of(outcome)).surely() < WANTED {
            // Each has a number of its own, or all would have the same programs before them.
            let Some(number) = numbers.next() else { break };
            let scenario = splice::rare(&mut Entropy::from_seed(SEED, number), &self.seeds, &rare);
            let (ended, coverage) = run(&scenario);
            made.splices += 1;
            if self.reason_not_compared(&scenario, &ended).is_none() {
                made.reached.add(&coverage);
            }
            if made.splices == TRIALS
                && rare.others != alone
                && made.programs_with(outcome) < TRIALS / 2
            {
                rare.others = alone;
                made = Made::default();
            }
        }
        (rare, made)
    }
}

/// How many programs of a plan are likely to reach an outcome.
#[derive(Clone, Copy, Debug, Default)]
struct Chance {
    mean: f64,
    variance: f64,
}

impl Chance {
    /// What it comes to if chance is as unkind as it well may be.
    fn surely(self) -> f64 {
        self.mean - UNKIND * self.variance.sqrt()
    }

    fn plus(self, other: Self) -> Self {
        Self { mean: self.mean + other.mean, variance: self.variance + other.variance }
    }
}

/// Splices of a coverage pass for one outcome. A plan has as many again.
#[derive(Debug, Default)]
struct Made {
    splices: u64,
    reached: Tally,
}

impl Made {
    /// How many of as many again are likely to reach each outcome.
    fn chances(&self) -> impl Iterator<Item = (Reached<'static>, Chance)> {
        let reached = self.reached.iter();
        reached.map(|(rule, outcome, programs)| ((rule, outcome), self.chance(programs)))
    }

    fn chance_of(&self, outcome: Reached<'_>) -> Chance {
        self.chance(self.programs_with(outcome))
    }

    fn chance(&self, programs: u64) -> Chance {
        let (mean, splices) = (number(programs), number(self.splices.max(1)));
        Chance { mean, variance: mean * (1.0 - mean / splices) }
    }

    fn programs_with(&self, outcome: Reached<'_>) -> u64 {
        self.reached.runs_with(outcome.0, outcome.1)
    }
}

/// A count of programs.
fn number(count: u64) -> f64 {
    f64::from(u32::try_from(count).unwrap_or(u32::MAX))
}

/// Whether a scenario may run before another one: it needs nothing but its program, in which no O-word and no percent
/// sign stands.
fn may_precede(scenario: &Scenario, environment: Option<&String>) -> bool {
    let Program { main, .. } = &scenario.program;
    let answers = Environment { name: scenario.environment.name.clone(), ..Environment::default() };
    let plain = Scenario {
        options: scenario.options.clone(),
        environment: answers,
        budget: scenario.budget,
        ..Scenario::of(main.as_str())
    };
    let usual =
        scenario.environment.name.is_none() || scenario.environment.name.as_ref() == environment;
    usual && *scenario == plain && !main.contains(['o', 'O', '%'])
}
