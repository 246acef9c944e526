//! What a declaration or an answer leaves open is masked, and nothing else is.

use gaugeblock_reference::run;
use gaugeblock_vocabulary::{
    Effect, End, Event, LengthUnit, Outcome, Position, Rs274State, Scenario, Settings, State,
};

use crate::judge::{Finding, judge};
use crate::observe::Observed;
use crate::{Capabilities, Comparison, compare};

/// The specified outcome of a program, compared with what becomes of it.
fn compared(
    program: &str,
    observables: &Capabilities,
    change: impl FnOnce(&mut Outcome),
) -> Comparison {
    let expected = run(&Scenario::of(program)).0;
    let mut found = expected.clone();
    change(&mut found);
    compare(&Observed::of(&expected), &Observed::of(&found), observables)
}

fn everything() -> Capabilities {
    Capabilities::everything("a controller", "1")
}

/// Moves the end of each straight move and each recorded position by a factor.
fn scale(outcome: &mut Outcome, factor: f64) {
    for step in &mut outcome.steps {
        for event in &mut step.events {
            if let Event::Do(Effect::StraightTraverse { end }) = event {
                end.x *= factor;
            }
        }
        if let Some(State::Rs274(Rs274State { position: Some(position), .. })) = &mut step.state {
            position.x *= factor;
        }
    }
    outcome.parameters = None;
}

#[test]
fn relative_error_hides_what_32_bits_lose() {
    let program = "g21 g0 x12345.678\nm2\n";
    let single =
        Capabilities { relative_resolution: 1.2e-7, reports_all_fields: false, ..everything() };
    let comparison = compared(program, &single, |found| scale(found, 1.0 + 6e-8));
    assert_eq!(comparison.divergence, None);
    let hidden = [
        "position within the declared resolution",
        "straight_traverse within the declared resolution",
    ];
    assert!(hidden.iter().all(|masked| comparison.masked.contains(*masked)), "{comparison:?}");
    assert!(compared(program, &single, |found| scale(found, 1.0 + 1e-6)).divergence.is_some());
    assert!(
        compared(program, &everything(), |found| scale(found, 1.0 + 6e-8)).divergence.is_some()
    );
}

#[test]
fn exact_number_is_compared_whatever_resolution_is_declared() {
    let coarse = Capabilities { resolution: 0.1, ..everything() };
    let comparison = compared("g21 g0 x1\nm2\n", &coarse, |_| {});
    assert_eq!((comparison.divergence, comparison.masked.len()), (None, 0));
}

#[test]
fn count_has_no_error() {
    let coarse = Capabilities { resolution: 0.1, ..everything() };
    let change = |found: &mut Outcome| {
        for step in &mut found.steps {
            if let Some(State::Rs274(state)) = &mut step.state {
                state.tool = state.tool.map(|tool| tool + 1);
            }
        }
    };
    let divergence = compared("g0 x1\nm2\n", &coarse, change).divergence.expect("another tool");
    assert_eq!(divergence.field, "tool");
}

#[test]
fn end_of_a_stream_is_no_program_end() {
    let ends = |found: &mut Outcome| found.end = End::StreamEnd;
    for (program, expected) in
        [("g0 x1\nm2\n", "program end"), ("g0 x1\n", "refused at main.ngc:2")]
    {
        let divergence = compared(program, &everything(), ends).divergence.expect(program);
        assert_eq!(divergence.found, "end of the stream without a program end");
        assert!(divergence.expected.starts_with(expected), "{divergence}");
    }
}

#[test]
fn unknown_field_is_masked_until_it_is_reported_again() {
    let some = Capabilities { reports_all_fields: false, ..everything() };
    let program = "g0 x1\ng0 x2\ng0 x3\nm2\n";
    // Left out, the position counts as unchanged.
    let leave_out = |found: &mut Outcome| {
        if let Some(State::Rs274(state)) = &mut found.steps[1].state {
            state.position = None;
        }
    };
    let divergence = compared(program, &some, leave_out).divergence.expect("it has changed");
    assert_eq!(divergence.field, "position");
    let not_known = |found: &mut Outcome| {
        leave_out(found);
        found.steps[1].events.push(Event::Unknown(vec!["position".to_owned()]));
    };
    let comparison = compared(program, &some, not_known);
    assert_eq!(comparison.divergence, None);
    assert!(comparison.masked.contains("position"), "{comparison:?}");
    let wrong_later = |found: &mut Outcome| {
        not_known(found);
        if let Some(State::Rs274(Rs274State { position: Some(position), .. })) =
            &mut found.steps[2].state
        {
            position.x = 4.0;
        }
    };
    assert!(compared(program, &some, wrong_later).divergence.is_some());
}

#[test]
fn repeated_setting_leaves_the_controlled_point_known() {
    let some = Capabilities { moves_in_place: false, ..everything() };
    let metric = Settings { units: Some(LengthUnit::Millimetre), ..Settings::default() };
    let offset = Settings { g92_offset: Some(Position::default()), ..Settings::default() };
    let inches = Settings { units: Some(LengthUnit::Inch), ..Settings::default() };
    let compared_after = |change: Settings| {
        compared("g21 g0 x1\ng90\nm2\n", &some, |found| {
            // The controller reports a move to the present position, which the declaration leaves out.
            let end = Position { x: 1.0, ..Position::default() };
            let traverse = Event::Do(Effect::StraightTraverse { end });
            found.steps[1].events = vec![Event::Set(Box::new(change)), traverse];
        })
    };
    for unchanged in [metric, offset] {
        assert_eq!(compared_after(unchanged.clone()).divergence, None, "{unchanged:?}");
    }
    assert!(compared_after(inches).divergence.is_some());
}

#[test]
fn move_to_the_same_place_in_another_unit_is_a_move_in_place() {
    let some = Capabilities { moves_in_place: false, ..everything() };
    for (program, place) in
        [("g21 g0 x0\ng20\ng0 x0\nm2\n", 0), ("g21 g0 x25.4\ng20\ng0 x1\nm2\n", 2)]
    {
        let leave_out = |found: &mut Outcome| {
            found.steps[place].events.retain(|event| !matches!(event, Event::Do(_)));
        };
        assert_eq!(compared(program, &some, leave_out).divergence, None, "{program}");
    }
}

#[test]
fn refusal_is_masked_for_a_controller_that_never_refuses() {
    let never = Capabilities { refuses: false, ..everything() };
    let goes_on = |found: &mut Outcome| {
        let end = Position { x: 9.0, ..Position::default() };
        let block = gaugeblock_vocabulary::BlockLocation::new("main.ngc", 2);
        let events = vec![Event::Do(Effect::StraightTraverse { end })];
        found.steps.push(gaugeblock_vocabulary::Step { block, events, state: None });
        found.end = End::ProgramEnd;
    };
    let comparison = compared("g0 x1\ng999\nm2\n", &never, goes_on);
    assert_eq!(comparison.divergence, None);
    assert!(comparison.masked.contains("refusals"), "{comparison:?}");
    assert!(compared("g0 x1\ng999\nm2\n", &everything(), goes_on).divergence.is_some());
    let refuses = |found: &mut Outcome| found.end = run(&Scenario::of("g999\n")).0.end;
    assert!(compared("g0 x1\nm2\n", &never, refuses).divergence.is_some());
}

#[test]
fn parameter_that_no_block_has_set_is_zero_after_it() {
    let run = Observed::of(&run(&Scenario::of("g21\n#31=5\no1 if [0]\no1 endif\nm2\n")).0);
    let judged = |text: &str| judge(&text.parse().expect("an assertion"), &run, &everything());
    assert_eq!(judged("after 1 #31 = 0, units = mm"), Finding::Holds);
    assert_eq!(judged("after 2 #31 = 5, #32 = 0"), Finding::Holds);
    assert_eq!(judged("after 1 #31 = 5"), Finding::Fails("parameter[31] = 0".to_owned()));
    // After an O-word no state is reported.
    assert_eq!(judged("after 3 #31 = 0"), Finding::Masked("parameter".to_owned()));
}

#[test]
fn frame_fails_by_a_field_that_changes_and_is_not_named() {
    let scenario = Scenario::of("g21 m8\n#31=1\ng20 g91 #31=2\nm2\n");
    let run = Observed::of(&run(&scenario).0);
    let judged = |text: &str, observables: &Capabilities| {
        judge(&text.parse().expect("an assertion"), &run, observables)
    };
    let fails = |text: &str| match judged(text, &everything()) {
        Finding::Fails(found) => found,
        holds @ (Finding::Holds | Finding::Masked(_)) => panic!("{text}: {holds:?}"),
    };
    assert_eq!(judged("unchanged at 3 but units, distance, #31", &everything()), Finding::Holds);
    assert_eq!(
        fails("unchanged at 3 but units, #31"),
        "distance = incremental; before the block it was absolute"
    );
    assert_eq!(
        fails("unchanged at 3 but units, distance"),
        "parameter[31] = 2; before the block it was 1"
    );
    // A parameter that no block has set before was zero.
    assert_eq!(fails("unchanged at 2"), "parameter[31] = 1");
    assert_eq!(fails("unchanged at 9"), "block 9 was not executed");

    let mut partial = everything();
    partial.fields.remove("flood");
    let hidden = judged("unchanged at 3 but units, distance, #31", &partial);
    assert_eq!(hidden, Finding::Masked("flood".to_owned()));
}

#[test]
fn effects_with_gaps_are_found_in_their_order_only() {
    let program = "g98 f100 g0 z3\ng81 x1 z-1 r1 l2\nm2\n";
    let run = Observed::of(&run(&Scenario::of(program)).0);
    let judged = |text: &str| judge(&text.parse().expect("an assertion"), &run, &everything());
    for holds in [
        "effects at 2: ...; straight_feed end=(x1 z-1); straight_traverse end=(x1 z3)",
        "effects at 2: straight_traverse end=(x1 z3); ...; straight_feed end=(x1 z-1); ...",
        "effects at 2: ...; straight_feed end=(x1 z-1); ...; straight_feed end=(x1 z-1); ...",
        "effects at 1: straight_traverse end=(z3); ...",
    ] {
        assert_eq!(judged(holds), Finding::Holds, "{holds}");
    }
    for fails in [
        "effects at 2: ...; straight_feed end=(x1 z-1)",
        "effects at 2: straight_feed end=(x1 z-1); ...",
        "effects at 2: ...; straight_feed end=(x1 z-1); straight_feed end=(x1 z-1); ...",
        "effects at 1: straight_traverse end=(z3); ...; straight_traverse end=(z3)",
    ] {
        assert!(matches!(judged(fails), Finding::Fails(_)), "{fails}");
    }
    let blind = Capabilities { effects: ["dwell".to_owned()].into(), ..everything() };
    let text = "effects at 2: ...; straight_feed end=(x1 z-1); ...";
    let masked = judge(&text.parse().expect("an assertion"), &run, &blind);
    assert_eq!(masked, Finding::Masked("straight_feed".to_owned()));
}
