//! What generated programs reach too rarely, so that splices of the suite's cases make up for it.

use std::collections::BTreeMap;
use std::ops::RangeFrom;

use gaugeblock_fuzz::generate::splice::{self, Rare};
use gaugeblock_fuzz::generate::{self, Dice};
use gaugeblock_reference::{RuleOutcome, Tally, run};
use gaugeblock_trace::scenario::Bench;
use gaugeblock_trace::{End, Program, Scenario};

use super::Plan;

/// Programs of a rehearsal.
const PROGRAMS: u64 = 8000;
/// Splices of a rehearsal that try to do the same rare thing.
const TRIALS: u64 = 16;
/// The seed of rehearsals: what is rare is the same for all seeds of a plan.
const SEED: u64 = 0;
/// Programs of a plan that are to reach each outcome: more than [`ENOUGH`](super::statistics::ENOUGH), since chance has a part in it.
const WANTED: u64 = 24;
/// An outcome has a turn in each round for so many splices that it needs.
const TURN: u64 = 3;
/// How many others run before a case at most: where it is refused, where not, and where they would hinder it.
const OTHERS: [u32; 3] = [2, 8, 0];
/// The fewest and the most splices of a hundred programs.
const SPLICED: (u64, u64) = (10, 26);
/// Plans of up to so many programs, and those without an end, are held for ones of [`SHORT`], all others for ones of [`LONG`], so that a plan
/// may go on further than it was begun for.
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
    /// Runs some programs on the model, and puts down by which seeds those of some outcomes are reached that a plan of so many programs
    /// would rarely reach. Without it splices take all seeds alike. How many of a hundred programs should be splices.
    ///
    /// Costs about a second.
    pub fn rehearse<'r>(
        &mut self,
        outcomes: impl IntoIterator<Item = Reached<'r>>,
        programs: Option<u64>,
    ) -> u32 {
        let programs = if is_long(programs) { LONG } else { SHORT };
        let reached = self.reached_without_splices();
        let (by_seed, runs_on) = self.reached_by_seeds();
        let mut missing = Vec::new();
        for outcome in outcomes {
            let Some(does) = by_seed.get(&outcome) else { continue };
            let seen = reached.get(&outcome).copied().unwrap_or_default();
            let more = WANTED.saturating_sub(expected(seen, programs));
            if more > 0 {
                let before = does.iter().copied().filter(|place| runs_on[*place]);
                self.seeds.before.extend(before);
                missing.push((outcome, does, more));
            }
        }
        // What few seeds do comes first: they do of what many do, too.
        missing.sort_by_key(|(_, does, _)| does.len());
        let (mut rare, mut done_by_others) = (Vec::new(), BTreeMap::new());
        let mut trials = PROGRAMS..;
        for (outcome, does, more) in missing {
            let done_already: u64 = done_by_others.get(&outcome).copied().unwrap_or_default();
            // A quarter less: a trial in which others did it may have been lucky.
            let more = more.saturating_sub(done_already * 3 / 4 / TRIALS);
            if more == 0 {
                continue;
            }
            let (found, done) = self.tried(outcome, does, &mut trials);
            let often = done.get(&outcome).copied().unwrap_or_default();
            // What does not always succeed may have been lucky; what never did is tried all the same.
            let surely = if often < TRIALS { often.saturating_sub(1).max(1) } else { often };
            let splices = (more * TRIALS).div_ceil(surely).min(more * 4);
            for (other, often) in done {
                *done_by_others.entry(other).or_default() += often * splices;
            }
            rare.push((found, splices));
        }
        let rounds = rare.iter().map(|(_, splices)| splices.div_ceil(TURN)).max().unwrap_or(0);
        for round in 0..rounds {
            let again = rare.iter().filter(|(_, splices)| splices.div_ceil(TURN) > round);
            self.seeds.rare.extend(again.map(|(rare, _)| rare.clone()));
        }
        let turns = u64::try_from(self.seeds.rare.len()).unwrap_or(u64::MAX);
        let splices = turns.saturating_mul(TURN * 100 * 100) / splice::rare_among(100);
        let share = splices.div_ceil(programs);
        u32::try_from(share.clamp(SPLICED.0, SPLICED.1)).unwrap_or_default()
    }

    /// In how many programs of a rehearsal each outcome was reached.
    fn reached_without_splices(&self) -> BTreeMap<Reached<'static>, u64> {
        let mut reached = Tally::default();
        for number in 0..PROGRAMS {
            let mut scenario = generate::scenario(&mut Dice::of_seed(SEED, number), &self.recipe);
            scenario.options.clone_from(&self.options);
            if self.is_run(&scenario) {
                reached.add(&run(&scenario).1);
            }
        }
        reached.iter().map(|(rule, outcome, programs)| ((rule, outcome), programs)).collect()
    }

    /// By which seeds that can be compared each outcome is reached, and which of all seeds may run before others.
    fn reached_by_seeds(&self) -> (BTreeMap<Reached<'static>, Vec<usize>>, Vec<bool>) {
        let mut by_seed: BTreeMap<_, Vec<usize>> = BTreeMap::new();
        let mut runs_on = vec![false; self.seeds.all.len()];
        for (place, scenario) in self.seeds.all.iter().enumerate() {
            let (outcome, evidence) = run(scenario);
            if self.left_out(scenario, &outcome).is_some() {
                continue;
            }
            runs_on[place] =
                may_precede(scenario, self.bench.as_ref()) && outcome.end == End::ProgramEnd;
            for reached in evidence.iter() {
                by_seed.entry(reached).or_default().push(place);
            }
        }
        (by_seed, runs_on)
    }

    /// How splices come to an outcome, and how many of some that tried came to each: with others before it, unless fewer than half of them do.
    fn tried(
        &self,
        outcome: Reached<'_>,
        does: &[usize],
        trials: &mut RangeFrom<u64>,
    ) -> (Rare, BTreeMap<Reached<'static>, u64>) {
        let [if_refused, if_accepted, alone] = OTHERS;
        let refused = outcome.1 == RuleOutcome::Refused;
        let others = if refused { if_refused } else { if_accepted };
        let behind = Rare { does: does.to_vec(), others };
        let done = self.done(&behind, trials);
        if done.get(&outcome).is_some_and(|often| *often >= TRIALS / 2) {
            return (behind, done);
        }
        let alone = Rare { others: alone, ..behind };
        let done = self.done(&alone, trials);
        (alone, done)
    }

    /// In how many splices each outcome is reached. Each has numbers of its own, or all would have the same programs before them.
    fn done(&self, rare: &Rare, trials: &mut RangeFrom<u64>) -> BTreeMap<Reached<'static>, u64> {
        let mut done = Tally::default();
        for _ in 0..TRIALS {
            let Some(number) = trials.next() else { break };
            let mut dice = Dice::of_seed(SEED, number);
            let scenario = splice::rare(&mut dice, &self.seeds, rare);
            let (outcome, evidence) = run(&scenario);
            if self.left_out(&scenario, &outcome).is_none() {
                done.add(&evidence);
            }
        }
        done.iter().map(|(rule, outcome, splices)| ((rule, outcome), splices)).collect()
    }

    /// Whether both sides run a scenario.
    fn is_run(&self, scenario: &Scenario) -> bool {
        [self.iut, self.against].iter().all(|side| side.supports(scenario).is_ok())
    }
}

/// How many programs of a plan reach at least what so many of a rehearsal reached, if chance was kind to those; splices take the place of some.
fn expected(seen: u64, programs: u64) -> u64 {
    let sure = seen.saturating_sub(seen.isqrt());
    sure.saturating_mul(programs) * (100 - SPLICED.1) / 100 / PROGRAMS
}

/// Whether a scenario may run before another one: it needs nothing but its program, in which no O-word and no percent sign stands.
fn may_precede(scenario: &Scenario, bench: Option<&String>) -> bool {
    let Program { main, .. } = &scenario.program;
    let answers = Bench { name: scenario.bench.name.clone(), ..Bench::default() };
    let plain = Scenario {
        options: scenario.options.clone(),
        bench: answers,
        budget: scenario.budget,
        ..Scenario::of(main.as_str())
    };
    let usual = scenario.bench.name.is_none() || scenario.bench.name.as_ref() == bench;
    usual && *scenario == plain && !main.contains(['o', 'O', '%'])
}
