//! What generated programs reach too rarely, so that splices of the suite's cases make up for it.

use std::collections::BTreeMap;

use gaugeblock_fuzz::generate::splice::Rare;
use gaugeblock_fuzz::generate::{self, Dice};
use gaugeblock_reference::{RuleOutcome, Tally, run};
use gaugeblock_trace::scenario::Bench;
use gaugeblock_trace::{End, Program, Scenario};

use super::Plan;

/// Programs of a rehearsal.
const PROGRAMS: u64 = 8000;
/// The seed of rehearsals: what is rare is the same for all seeds of a plan.
const SEED: u64 = 0;
/// Programs of a plan that are to reach each outcome: more than [`ENOUGH`](super::statistics::ENOUGH), since chance has a part in it.
const WANTED: u64 = 30;
/// An outcome stands among the rare ones once for so many programs that are missing.
const MISSING: u64 = 5;
/// Of a hundred splices that are to do something rare so many do it.
const DO_IT: u64 = 75;
/// The fewest and the most splices of a hundred programs.
const SPLICED: (u64, u64) = (10, 25);
/// Plans of up to so many programs, and those without an end, are held for ones of [`SHORT`], all others for ones of [`LONG`], so that a plan
/// may go on further than it was begun for.
const SHORT_UP_TO: u64 = 100_000;
const SHORT: u64 = 30_000;
const LONG: u64 = 1_000_000;

/// Whether a plan of so many programs counts as a long one: it has other programs than a short one.
pub fn is_long(programs: Option<u64>) -> bool {
    programs.is_some_and(|programs| programs > SHORT_UP_TO)
}

impl Plan<'_> {
    /// Runs some programs on the model, and puts down by which seeds those of some outcomes are reached that a plan of so many programs
    /// would rarely reach. Without it splices take all seeds alike. How many of a hundred programs should be splices.
    ///
    /// Costs about half a second.
    pub fn rehearse<'r>(
        &mut self,
        outcomes: impl IntoIterator<Item = (&'r str, RuleOutcome)>,
        programs: Option<u64>,
    ) -> u32 {
        let programs = if is_long(programs) { LONG } else { SHORT };
        let supported = |scenario: &Scenario| {
            [self.iut, self.against].iter().all(|side| side.supports(scenario).is_ok())
        };
        let mut reached = Tally::default();
        for number in 0..PROGRAMS {
            let mut scenario = generate::scenario(&mut Dice::of_seed(SEED, number), &self.recipe);
            scenario.options.clone_from(&self.options);
            if supported(&scenario) {
                reached.add(&run(&scenario).1);
            }
        }
        let reached: BTreeMap<_, _> =
            reached.iter().map(|(rule, outcome, programs)| ((rule, outcome), programs)).collect();
        let mut by_seed: BTreeMap<_, Vec<usize>> = BTreeMap::new();
        let mut runs_on = vec![false; self.seeds.all.len()];
        for (place, scenario) in self.seeds.all.iter().enumerate() {
            if !supported(scenario) {
                continue;
            }
            let (outcome, evidence) = run(scenario);
            runs_on[place] =
                may_precede(scenario, self.bench.as_ref()) && outcome.end == End::ProgramEnd;
            for reached in evidence.iter() {
                by_seed.entry(reached).or_default().push(place);
            }
        }
        let (mut rare, mut before, mut all_missing) = (Vec::new(), Vec::new(), 0_u64);
        for outcome in outcomes {
            let Some(does) = by_seed.get(&outcome) else { continue };
            let expected = reached.get(&outcome).copied().unwrap_or_default();
            let expected = expected.saturating_mul(programs) / PROGRAMS;
            let missing = WANTED.saturating_sub(expected);
            all_missing += missing;
            for _ in 0..missing.div_ceil(MISSING) {
                let ends = outcome.1 == RuleOutcome::Refused;
                rare.push(Rare { does: does.clone(), ends });
                before.extend(does.iter().copied().filter(|place| runs_on[*place]));
            }
        }
        self.seeds.rare = rare;
        self.seeds.before = before;
        let splices = (all_missing * 100 * 100 / DO_IT).div_ceil(programs);
        u32::try_from(splices.clamp(SPLICED.0, SPLICED.1)).unwrap_or_default()
    }
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
