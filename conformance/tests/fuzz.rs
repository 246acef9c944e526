//! Fuzzing finds a planted fault, shrinks it, covers every program once, and tells the same however it was interrupted.

use std::collections::BTreeSet;
use std::num::NonZero;
use std::sync::atomic::AtomicBool;

use gaugeblock::adapters::reference::Reference;
use gaugeblock::adapters::{Adapter, Capabilities, HarnessError};
use gaugeblock::fuzz::groups::{Find, Groups, merged, shrunk};
use gaugeblock::fuzz::journal::Chunk;
use gaugeblock::fuzz::statistics::Statistics;
use gaugeblock::fuzz::{Extent, Plan, Shard, run};
use gaugeblock_fuzz::generate::{Recipe, Setups};
use gaugeblock_trace::{Effect, Event, Options, Outcome, Scenario};

/// The model with a fault: dwells take twice as long.
#[derive(Debug)]
struct SlowDwell(Capabilities);

impl Adapter for SlowDwell {
    fn capabilities(&self) -> &Capabilities {
        &self.0
    }

    fn supports(&self, _scenario: &Scenario) -> Result<(), String> {
        Ok(())
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        let mut outcome = gaugeblock_reference::run(scenario).0;
        for event in outcome.steps.iter_mut().flat_map(|step| &mut step.events) {
            if let Event::Do(Effect::Dwell { seconds }) = event {
                *seconds *= 2.0;
            }
        }
        Ok(outcome)
    }
}

fn plan<'a>(iut: &'a dyn Adapter, against: &'a dyn Adapter) -> Plan<'a> {
    Plan {
        iut,
        against,
        recipe: Recipe { setups: Setups::Any, ..Recipe::default() },
        seed: 1,
        spliced: 0,
        seeds: Vec::new(),
        options: Options::default(),
        random: Vec::new(),
        bench: None,
    }
}

/// Runs chunks of a shard; those in `done` were done before.
fn chunks(plan: &Plan<'_>, shard: Shard, done: &BTreeSet<u64>) -> Vec<Chunk> {
    let stop = AtomicBool::new(false);
    let jobs = NonZero::new(3).expect("three");
    let mut all = Vec::new();
    run(plan, &Extent { shard, programs: 500, jobs, done, stop: &stop }, &mut |chunk| {
        all.push(chunk);
        true
    });
    all.sort_by_key(|chunk| chunk.chunk);
    all
}

fn together(chunks: Vec<Chunk>) -> (Statistics, Vec<Find>) {
    let (mut statistics, mut groups) = (Statistics::default(), Groups::default());
    for chunk in chunks {
        statistics.add(&chunk.statistics);
        chunk.found.into_iter().for_each(|find| groups.add(find));
    }
    (statistics, merged(groups.finds()))
}

const WHOLE: Shard = Shard { index: 1, of: 1 };

#[test]
fn a_planted_fault_is_found_and_shrunk() {
    let faulty = SlowDwell(Capabilities::everything("slow dwell", "1"));
    let reference = Reference::default();
    let plan = plan(&faulty, &reference);
    let (statistics, finds) = together(chunks(&plan, WHOLE, &BTreeSet::new()));
    assert_eq!(statistics.programs, 500);
    assert!(statistics.diverging > 20, "{statistics:?}");
    assert!(!finds.is_empty());
    for find in finds {
        let small = shrunk(&plan, &find, 5_000);
        assert_eq!(small.scenario.program.main.trim_end(), "g4 p1", "{find:?}");
        assert_eq!(small.scenario.machine, gaugeblock_trace::Machine::default());
        assert!(small.shrunk);
        assert!(small.rules.iter().any(|rule| rule.starts_with("dwell.")), "{:?}", small.rules);
    }
}

#[test]
fn shards_cover_every_program_once() {
    let (one, other) = (Reference::default(), Reference::default());
    let plan = plan(&one, &other);
    let whole = together(chunks(&plan, WHOLE, &BTreeSet::new()));
    let of = 3;
    let shards = (1..=of).flat_map(|index| chunks(&plan, Shard { index, of }, &BTreeSet::new()));
    assert_eq!(together(shards.collect()), whole);
    assert!(whole.1.is_empty(), "the model is equal to itself");
}

#[test]
fn an_interrupted_run_tells_the_same() {
    let faulty = SlowDwell(Capabilities::everything("slow dwell", "1"));
    let reference = Reference::default();
    let plan = plan(&faulty, &reference);
    let whole = chunks(&plan, WHOLE, &BTreeSet::new());
    let before: Vec<Chunk> = whole.iter().step_by(2).cloned().collect();
    let done = before.iter().map(|chunk| chunk.chunk).collect();
    let rest = chunks(&plan, WHOLE, &done);
    assert_eq!(rest.len() + before.len(), whole.len());
    assert_eq!(together([before, rest].concat()), together(whole));
}
