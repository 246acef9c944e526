//! What PROTOCOL.md says of an outcome: what is masked, what is compared, and what an end is. `protocol_sentences.txt`
//! names the test of each sentence.

use std::collections::BTreeSet;

use gaugeblock_compare::judge::{Finding, judge};
use gaugeblock_compare::observe::Observed;
use gaugeblock_compare::{Capabilities, compare};
use gaugeblock_suite::assertion::Assertion;
use gaugeblock_vocabulary::motion::Samples;
use gaugeblock_vocabulary::{
    BlockLocation, Effect, End, Event, Language, LengthUnit, Outcome, Position, Scenario, Settings,
    State, Step,
};

fn specified(program: &str) -> Outcome {
    gaugeblock_reference::run(&Scenario::of(program)).0
}

/// What an adapter can declare, all of it.
fn declared() -> Capabilities {
    Capabilities { reports_all_fields: false, ..Capabilities::everything("a controller", "1") }
}

/// Whether an outcome that differs from the specified one diverges.
fn diverges(program: &str, observables: &Capabilities, change: impl FnOnce(&mut Outcome)) -> bool {
    let expected = specified(program);
    let mut found = expected.clone();
    change(&mut found);
    let (expected, found) = (Observed::of(&expected), Observed::of(&found));
    compare(&expected, &found, observables).divergence.is_some()
}

fn without(names: &BTreeSet<String>, name: &str) -> BTreeSet<String> {
    names.iter().filter(|known| *known != name).cloned().collect()
}

#[test]
fn undeclared_observable_is_masked() {
    let program = "f100 g1 x1\n#31=5\nm8\nm2\n";
    let all = declared();
    let moved: fn(&mut Outcome) = |found| {
        if let Event::Do(Effect::StraightFeed { end }) = &mut found.steps[0].events[1] {
            end.x = 7.0;
        }
    };
    let placed: fn(&mut Outcome) = |found| {
        if let Some(State::Rs274(state)) = &mut found.steps[0].state {
            state.position = Some(Position { x: 7.0, ..Position::default() });
        }
    };
    let parameter: fn(&mut Outcome) = |found| {
        if let Some(parameters) = &mut found.parameters {
            parameters.0.insert(31, 6.0);
        }
    };
    let pins: fn(&mut Outcome) = |found| found.pins.clear();
    let cases = [
        (
            "an effect",
            moved,
            Capabilities { effects: without(&all.effects, "straight_feed"), ..all.clone() },
        ),
        (
            "a field",
            placed,
            Capabilities { fields: without(&all.fields, "position"), ..all.clone() },
        ),
        ("parameters", parameter, Capabilities { final_parameters: false, ..all.clone() }),
        (
            "a parameter",
            parameter,
            Capabilities { hidden_parameters: vec![31..=31], ..all.clone() },
        ),
        ("a pin", pins, Capabilities { pins: without(&all.pins, "coolant_flood"), ..all.clone() }),
    ];
    for (what, change, less) in cases {
        assert!(diverges(program, &all, change), "{what} is declared");
        assert!(!diverges(program, &less, change), "{what} is not declared");
    }
}

#[test]
fn place_of_a_setting_counts_for_fields_at_effects_only() {
    let later = |found: &mut Outcome| found.steps[0].events.reverse();
    let program = "f100 g1 x1\nm2\n";
    let all = declared();
    assert!(diverges(program, &all, later));
    let after_blocks =
        Capabilities { fields_at_effects: without(&all.fields_at_effects, "feed_rate"), ..all };
    assert!(!diverges(program, &after_blocks, later));
}

#[test]
fn move_in_place_is_required_or_ignored() {
    let left_out = |found: &mut Outcome| found.steps[1].events.clear();
    let program = "g0 x1\ng0 x1\nm2\n";
    assert!(diverges(program, &declared(), left_out));
    let ignored = Capabilities { moves_in_place: false, ..declared() };
    assert!(!diverges(program, &ignored, left_out));
}

#[test]
fn block_of_a_fault_counts_unless_faults_name_none() {
    let elsewhere = |found: &mut Outcome| {
        if let End::Fault(fault) = &mut found.end {
            fault.block = Some(BlockLocation::new("main.ngc", 3));
        }
    };
    let program = "g0 x1\ng999\nm2\n";
    assert!(diverges(program, &declared(), elsewhere));
    let nowhere = Capabilities { faults_have_blocks: false, ..declared() };
    assert!(!diverges(program, &nowhere, elsewhere));
}

#[test]
fn field_that_was_never_reported_is_not_judged_and_then_counts_as_unchanged() {
    let program = "g0 x1\ng0 x2\ng0 x3\nm2\n";
    let forget = |step: &mut Step| {
        if let Some(State::Rs274(state)) = &mut step.state {
            state.position = None;
        }
    };
    let never = |found: &mut Outcome| found.steps.iter_mut().for_each(forget);
    assert!(!diverges(program, &declared(), never));
    let once = |found: &mut Outcome| found.steps[1..].iter_mut().for_each(forget);
    assert!(diverges(program, &declared(), once));
    let metric = Settings { units: Some(LengthUnit::Millimetre), ..Settings::default() };
    let repeated =
        |found: &mut Outcome| found.steps[1].events.insert(0, Event::Set(Box::new(metric)));
    assert!(!diverges(program, &declared(), repeated));
}

#[test]
fn step_is_an_executed_block_and_nothing_else() {
    let program = "o100 sub\ng0 x1\no100 endsub\no100 call\no100 call\n\n(a comment)\nm2\n";
    let with_state = |line: u32| {
        move |found: &mut Outcome| {
            let block = BlockLocation::new("main.ngc", line);
            let state = Some(State::empty(Language::Rs274));
            let place = found.steps.len() - 1;
            found.steps.insert(place, Step { block, events: Vec::new(), state });
        }
    };
    // A block that only controls the flow, an empty line, and a comment have no state.
    for line in [5, 6, 7] {
        assert!(diverges(program, &declared(), with_state(line)), "line {line}");
    }
    let of_sub = |step: &Step| step.block.line == 2;
    let executions = specified(program).steps.iter().filter(|step| of_sub(step)).count();
    assert_eq!(executions, 2);
    let once = |found: &mut Outcome| {
        let place = found.steps.iter().position(of_sub).expect("the block");
        found.steps.remove(place);
    };
    assert!(diverges(program, &declared(), once));
    let message = specified("(msg,done)\n(done)\nm2\n");
    let lines: Vec<u32> = message.steps.iter().map(|step| step.block.line).collect();
    assert_eq!(lines, [1, 3]);
}

#[test]
fn each_end_of_the_page_is_an_end_of_its_own() {
    let all = [
        ("m2\n", End::ProgramEnd),
        ("m30\n", End::ProgramEnd),
        ("%\ng0 x1\n%\n", End::PercentEnd),
        ("g0 x1\nm0\nm2\n", End::Paused),
    ];
    for (program, end) in &all {
        assert_eq!(specified(program).end, *end, "{program:?}");
    }
    assert_eq!(specified("g0 x1\nm99\n").end, End::Endless);
    let End::Fault(missing) = specified("g0 x1\ng0 x2\n").end else { panic!("it has no end") };
    assert_eq!(missing.block, Some(BlockLocation::new("main.ngc", 3)));
    let ends = [End::ProgramEnd, End::PercentEnd, End::StreamEnd, End::Endless, End::Paused];
    let ends = ends.into_iter().chain([End::Aborted]);
    for end in ends {
        let is_other = end != End::ProgramEnd;
        let ends_so = |found: &mut Outcome| found.end = end.clone();
        assert_eq!(diverges("g0 x1\nm2\n", &declared(), ends_so), is_other, "{end:?}");
    }
    let mut short = Scenario::of("o1 while [1]\ng0 x1\no1 endwhile\nm2\n");
    short.budget.steps = 10;
    let exhausted = gaugeblock_reference::run(&short).0.end;
    assert_eq!(serde_json::to_value(exhausted).expect("JSON")["bound"], "steps");
}

#[test]
fn position_is_in_the_active_unit_and_zero_where_nothing_is_said() {
    let inches = specified("g20 g0 x1\nm2\n");
    let end = Position { x: 1.0, ..Position::default() };
    assert!(inches.steps[0].events.contains(&Event::Do(Effect::StraightTraverse { end })));
    let read: Effect =
        serde_json::from_str("{\"effect\":\"straight_feed\",\"end\":{}}").expect("an effect");
    assert_eq!(read, Effect::StraightFeed { end: Position::default() });
}

#[test]
fn kinds_of_faults_count_where_they_are_declared() {
    let conflict = Observed::of(&specified("g0 g1 x1\n"));
    let other: Assertion = "kind repeated_word".parse().expect("an assertion");
    assert!(matches!(judge(&other, &conflict, &declared()), Finding::Fails(_)));
    let less = Capabilities { faults_have_kinds: false, ..declared() };
    assert_eq!(judge(&other, &conflict, &less), Finding::Masked("kind".to_owned()));
}

/// Puts all events into one step, with the state at the end.
fn join(outcome: &mut Outcome) {
    let block = BlockLocation::new("main.ngc", 1);
    let mut whole = Step { block, events: Vec::new(), state: Some(State::empty(Language::Rs274)) };
    for step in outcome.steps.drain(..) {
        whole.events.extend(step.events);
        if let (Some(state), Some(change)) = (&mut whole.state, &step.state) {
            state.overlay(change);
        }
    }
    outcome.steps.push(whole);
}

#[test]
fn outcome_without_blocks_is_judged_by_effects_and_its_end() {
    let whole = Capabilities { blocks: false, ..declared() };
    let program = "f100 g1 x1\ng0 x2\nm2\n";
    assert!(!diverges(program, &whole, join));
    assert!(diverges(program, &declared(), join));
    let moved = |found: &mut Outcome| {
        join(found);
        found.steps[0]
            .events
            .retain(|event| !matches!(event, Event::Do(Effect::StraightFeed { .. })));
    };
    assert!(diverges(program, &whole, moved));
    let elsewhere = |found: &mut Outcome| {
        join(found);
        if let Some(State::Rs274(state)) = &mut found.steps[0].state {
            state.position = Some(Position { x: 7.0, ..Position::default() });
        }
    };
    assert!(diverges(program, &whole, elsewhere));
    assert!(!diverges("g0 x1\ng999\nm2\n", &whole, elsewhere), "the state after a fault");
}

#[test]
fn failed_probe_is_in_the_parameters_at_the_end() {
    let failed = specified("g21 f100\ng38.2 x5\nm2\n");
    assert_eq!(failed.end.name(), "fault");
    assert!(failed.steps.iter().all(|step| step.block.line != 2), "a refused block is not a step");
    assert_eq!(failed.parameters.expect("parameters").0.get(&5061), Some(&5.0));
}

#[test]
fn binary_form_is_that_of_the_page() {
    let mut bytes = b"GBSAMPLE".to_vec();
    bytes.extend(0_u16.to_le_bytes());
    bytes.extend(2_u16.to_le_bytes());
    bytes.extend(0.001_f64.to_le_bytes());
    bytes.extend(0.0_f64.to_le_bytes());
    for name in ["x", "element"] {
        bytes.push(u8::try_from(name.len()).expect("a short name"));
        bytes.extend(name.as_bytes());
    }
    bytes.extend(1_u64.to_le_bytes());
    bytes.extend([0.5_f64, 3.0].iter().flat_map(|value| value.to_le_bytes()));
    let sum = bytes.iter().fold(0xcbf2_9ce4_8422_2325_u64, |sum, byte| {
        (sum ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    bytes.extend(sum.to_le_bytes());
    let samples = Samples::from_bytes(&bytes).expect("samples");
    assert_eq!((samples.period(), samples.resolution()), (0.001, 0.0));
    assert_eq!(samples.rows().collect::<Vec<_>>(), [&[0.5, 3.0]]);
}
