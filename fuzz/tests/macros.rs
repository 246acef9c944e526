//! Custom macros: most programs are accepted, interpolations have the number of their closed form, and a call leaves
//! its caller what it had.

use gaugeblock_fuzz::generate::nct::{Counted, Pair, count, locals};
use gaugeblock_fuzz::generate::{Entropy, GeneratorConfig, from_seed};
use gaugeblock_vocabulary::{End, Language, Outcome, Scenario};

const PROGRAMS: u64 = 3000;

fn run(scenario: &Scenario) -> Outcome {
    gaugeblock_reference::run(scenario).0
}

#[test]
fn most_programs_are_accepted() {
    let config = GeneratorConfig { language: Language::Nct, ..GeneratorConfig::default() };
    let ends = (0..PROGRAMS).map(|number| run(&from_seed(1, number, &config)).end);
    let is_accepted = |end: &End| {
        !matches!(end, End::Fault(_) | End::Unspecified { .. } | End::Unsupported { .. })
    };
    let accepted = ends.filter(is_accepted).count();
    let percent = accepted * 100 / usize::try_from(PROGRAMS).unwrap();
    assert!((60..97).contains(&percent), "{percent} of a hundred are accepted");
}

#[test]
fn modal_calls_interpolate_as_often_as_the_closed_form_says() {
    for number in 0..PROGRAMS {
        let Counted { scenario, interpolations } = count(&mut Entropy::from_seed(3, number));
        let outcome = run(&scenario);
        let text = &scenario.program.main;
        assert_eq!(outcome.end, End::ProgramEnd, "{text}");
        assert_eq!(Counted::made(&outcome), interpolations, "{text}");
    }
}

#[test]
fn a_call_preserves_the_callers_parameters() {
    let mut compared = 0;
    for number in 0..PROGRAMS {
        let pair = locals(&mut Entropy::from_seed(4, number));
        let (one, other) = (run(&pair.one), run(&pair.other));
        assert_eq!(one.end, End::ProgramEnd, "{}", pair.one.program.main);
        if Pair::returns(&pair.other, &other) {
            compared += 1;
            assert_eq!(Pair::left(&one), Pair::left(&other), "{}", pair.other.program.main);
        }
    }
    assert!(compared * 2 > PROGRAMS, "{compared} of {PROGRAMS} are compared");
}
