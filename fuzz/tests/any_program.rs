//! Any bytes as a program give an outcome, without panic and within the budget.

use std::fmt::Write as _;

use gaugeblock_fuzz::generate::{self, malformed};
use gaugeblock_fuzz::oracle;
use gaugeblock_vocabulary::{End, Scenario};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

fn check(scenario: &Scenario) -> Result<(), TestCaseError> {
    let kept = oracle::model_invariants(scenario);
    kept.map(|_| ())
        .map_err(|broken| TestCaseError::fail(format!("{broken}\n{}", scenario.program.main)))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn malformed_program(bytes in vec(any::<u8>(), 0..400)) {
        check(&malformed::scenario(&bytes))?;
    }

    #[test]
    fn program_of_the_table(bytes in vec(any::<u8>(), 0..600)) {
        check(&generate::from_bytes(&bytes))?;
    }

    #[test]
    fn any_bytes(bytes in vec(any::<u8>(), 0..200)) {
        check(&generate::raw(&bytes))?;
    }
}

/// A generator whose programs all end at their first block tests nothing.
#[test]
fn generator_does_not_idle() {
    let mut runner = TestRunner::deterministic();
    let (mut ended, mut refused, mut steps) = (0, 0, 0);
    for _ in 0..500 {
        let bytes = vec(any::<u8>(), 0..150).new_tree(&mut runner).unwrap().current();
        let outcome = oracle::model_invariants(&malformed::scenario(&bytes)).unwrap();
        steps += outcome.steps.len();
        match outcome.end {
            End::Fault(_) => refused += 1,
            End::ProgramEnd => ended += 1,
            End::PercentEnd | End::StreamEnd | End::Endless | End::Paused | End::Aborted => {}
            End::BudgetExhausted { .. } | End::Unsupported { .. } | End::Unspecified { .. } => {}
        }
    }
    assert!(ended >= 150, "{ended} of 500 programs end");
    assert!(refused >= 50, "{refused} of 500 programs are refused");
    assert!(steps >= 5_000, "{steps} blocks are executed in 500 programs");
}

/// Programs that try to exhaust the stack or the memory.
#[test]
fn hostile_programs() {
    let deep = |open: &str, close: &str| {
        format!("#1 = {}1{}\nm2\n", open.repeat(50_000), close.repeat(50_000))
    };
    let mut structures = String::new();
    for label in 1..5_000 {
        let _infallible = writeln!(structures, "o{label} if [1]");
    }
    let programs = [
        deep("[", "]"),
        deep("sin[", "]"),
        format!("#1 = {}1\nm2\n", "#".repeat(50_000)),
        format!("#1 = {}1\nm2\n", "-".repeat(50_000)),
        format!("({}\nm2\n", "(".repeat(50_000)),
        "o1 sub\no1 call\no1 endsub\no1 call\nm2\n".to_owned(),
        "o1 sub\no1 call [#1 + 1]\no1 endsub [1]\no1 call [1]\nm2\n".to_owned(),
        "o1 while [1]\no1 endwhile\nm2\n".to_owned(),
        "o1 repeat [999999999]\no1 endrepeat\nm2\n".to_owned(),
        "o1 do\no1 while [1]\nm2\n".to_owned(),
        "o1\nm98 p1 l999999999\nm99\nm2\n".to_owned(),
        "#1 = 1\no1 while [1]\n#1 = [#1 * 10]\n#<_x> = #1\no1 endwhile\nm2\n".to_owned(),
        "g4 p999999999999\n".repeat(20) + "m2\n",
        "\n".repeat(200_000),
        "m3 s1 ".repeat(50_000),
        structures,
    ];
    for program in programs {
        let mut scenario = generate::raw(program.as_bytes());
        scenario.budget.steps = 5_000;
        oracle::model_invariants(&scenario).unwrap();
    }
}
