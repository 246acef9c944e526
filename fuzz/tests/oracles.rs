//! The oracles on generated programs, and on runs that break a property.

use gaugeblock_fuzz::generate::metamorphic::pair;
use gaugeblock_fuzz::generate::{Entropy, GeneratorConfig, from_seed};
use gaugeblock_fuzz::oracle;
use gaugeblock_reference::{RunCache, run, run_with};
use gaugeblock_vocabulary::{Effect, End, Event, Options, Outcome, Scenario};

fn reference(scenario: &Scenario) -> Option<Outcome> {
    Some(run(scenario).0)
}

#[test]
fn metamorphic_pairs_have_equal_effects() {
    for number in 0..400 {
        let pair = pair(&mut Entropy::from_seed(3, number));
        oracle::metamorphic(&pair, &mut reference)
            .unwrap_or_else(|broken| panic!("{number}: {broken}"));
    }
}

#[test]
fn a_pair_that_differs_is_reported() {
    let mut broken = 0;
    for number in 0..100 {
        let pair = pair(&mut Entropy::from_seed(3, number));
        let mut turn = 0;
        let mut one_dwell_less = |scenario: &Scenario| {
            turn += 1;
            let mut outcome = reference(scenario)?;
            for step in outcome.steps.iter_mut().filter(|_| turn == 2) {
                step.events.retain(|event| {
                    !matches!(event, Event::Do(Effect::Dwell { .. } | Effect::StraightFeed { .. }))
                });
            }
            Some(outcome)
        };
        broken += u32::from(oracle::metamorphic(&pair, &mut one_dwell_less).is_err());
    }
    assert!(broken > 30, "{broken} of 100");
}

#[test]
fn a_smaller_budget_gives_a_prefix() {
    for number in 0..200 {
        let scenario = from_seed(4, number, &GeneratorConfig::default());
        oracle::budget_prefix(&scenario, &mut reference).unwrap();
    }
    let mut ends = |scenario: &Scenario| {
        let mut outcome = reference(scenario)?;
        outcome.end = End::ProgramEnd;
        Some(outcome)
    };
    assert!(oracle::budget_prefix(&Scenario::of("g0\ng0\ng0\nm2\n"), &mut ends).is_err());
}

#[test]
fn chunked_input_changes_nothing() {
    for number in 0..300 {
        let mut entropy = Entropy::from_seed(5, number);
        let scenario = from_seed(5, number, &GeneratorConfig::default());
        oracle::chunked_input(&scenario, &mut entropy)
            .unwrap_or_else(|broken| panic!("{number}: {broken}"));
    }
}

/// A text that is cut between a carriage return and its line feed: M99 comes back to the line that it left.
#[test]
fn cut_line_end_after_m99_is_not_a_line() {
    let scenario = Scenario::of("m8\r\nm98 p101\r\nm2\r\no101\r\nm99\r\n");
    for number in 0..60 {
        let mut entropy = Entropy::from_seed(6, number);
        oracle::chunked_input(&scenario, &mut entropy)
            .unwrap_or_else(|broken| panic!("{number}: {broken}"));
    }
}

/// What a run of the model caches for the next one changes no outcome.
#[test]
fn the_cache_of_the_model_changes_no_outcome() {
    let mut cache = RunCache::default();
    let other: Options =
        Options([("units-planes.initial-unit".to_owned(), "machine".to_owned())].into());
    for number in 0..400 {
        let mut scenario = from_seed(11, number, &GeneratorConfig::default());
        if number % 3 == 0 {
            scenario.options = other.clone();
        }
        assert_eq!(run_with(&mut cache, &scenario), run(&scenario), "program {number}");
    }
    let none = Options([("no.such-choice".to_owned(), "each".to_owned())].into());
    let refused = Scenario { options: none, ..Scenario::of("m2\n") };
    assert_eq!(run_with(&mut cache, &refused), run(&refused));
}
