//! Programs in check mode.

use std::collections::BTreeSet;

use gaugeblock_adapter::{Adapter as _, ControllerError, HarnessError};
use gaugeblock_grbl::BITS_PER_SECOND;
use gaugeblock_vocabulary::{
    End, FaultKind, FeedMode, Indexed, LengthUnit, Motion, Plane, Position, Scenario, SpindleTurn,
    State, Switch,
};

use crate::simulator::{Controller, Member, Running};
use crate::{PATIENT, last, open, opened, outcome, run};

/// Units, modes, spindle, coolant and a tool; the typical case of the suite has so many blocks.
const PROGRAM: &str = "g18 g20 g93\ng55 f10\n(nothing)\nm3 s1000 m8 t2\n\ng94 f1 g1 x1 z-1\nm2\n";

fn check(running: &Running, tool: Option<i32>) {
    let grbl = opened(running, "");
    let outcome = outcome(&grbl, PROGRAM);
    let lines: Vec<u32> = outcome.steps.iter().map(|step| step.block.line).collect();
    assert_eq!(lines, [1, 2, 4, 6, 7], "blank lines and comments are not blocks");
    assert_eq!(outcome.end, End::ProgramEnd);
    assert_eq!(outcome.start.plane, Some(Plane::Xy));
    let (settings, state) = last(&outcome);
    assert_eq!(settings.units, Some(LengthUnit::Inch));
    assert_eq!(settings.feed_mode, Some(FeedMode::PerMinute));
    assert_eq!((state.motion, state.tool, state.position), (Some(Motion::Feed), tool, None));
    assert!(outcome.steps.iter().all(|step| step.state.is_some()), "the end, too, leaves a state");
    // The end resets these.
    assert_eq!((settings.plane, settings.work_offset), (Some(Plane::Xy), Some(1)));
    assert_eq!(settings.spindle, Some(Indexed::one(0, SpindleTurn::Stopped)));
    assert_eq!(settings.flood, Some(Switch::Off));
}

#[test]
fn program_is_observed_block_by_block_at_a_terminal() {
    check(&Running::at_terminal(Controller::new(Member::Grbl)), None);
}

#[test]
fn program_is_observed_block_by_block_at_a_socket() {
    check(&Running::at_socket(Controller::new(Member::Grbl)), None);
    check(&Running::at_socket(Controller::new(Member::GrblHal)), Some(2));
}

#[test]
fn each_program_starts_from_a_reset() {
    let running = Running::at_terminal(Controller::new(Member::Grbl));
    let grbl = opened(&running, "");
    let first = outcome(&grbl, "g91 g20\n");
    assert_eq!(first.end, End::StreamEnd);
    let second = outcome(&grbl, "g91 g20\n");
    assert_eq!(first, second);
}

/// What the program has not set is compared, too.
#[test]
fn first_state_has_all_fields() {
    let running = Running::at_terminal(Controller::new(Member::Grbl));
    let found = outcome(&opened(&running, ""), "g18\ng19\n");
    let State::Rs274(first) = found.steps[0].state.as_ref().expect("a state") else { panic!() };
    assert_eq!((first.motion, first.tool), (Some(Motion::Traverse), None));
    let second = found.steps[1].state.as_ref().expect("a state");
    assert!(second.is_empty(), "{second:?}");
}

#[test]
fn refused_block_is_a_fault_with_its_kind() {
    let running = Running::at_terminal(Controller::new(Member::Grbl));
    let grbl = opened(&running, "");
    for (block, kind) in [
        ("g0 g1 x1", FaultKind::ModalConflict),
        ("g1 x1", FaultKind::ZeroFeed),
        ("g64", FaultKind::UnknownCode),
        ("g0 x1 x2", FaultKind::RepeatedWord),
        ("g0 x1..2", FaultKind::BadNumber),
        ("g0 x[1]", FaultKind::BadNumber),
        ("#1=2", FaultKind::BadCharacter),
    ] {
        let found = outcome(&grbl, &format!("g18\n{block}\nm2\n"));
        let End::Fault(fault) = &found.end else { panic!("{block}: {:?}", found.end) };
        assert_eq!(fault.kind, Some(kind), "{block}");
        assert_eq!(fault.block.as_ref().map(|block| block.line), Some(2), "{block}");
        assert_eq!(found.steps.len(), 1, "{block}");
    }
}

#[test]
fn only_what_is_reported_is_declared() {
    let fields = |member| {
        let running = Running::at_terminal(Controller::new(member));
        opened(&running, "").capabilities().clone()
    };
    let of_grbl = fields(Member::Grbl);
    let expected = "distance feed_mode feed_rate flood mist motion plane spindle spindle_speed units work_offset";
    let expected: BTreeSet<String> = expected.split(' ').map(str::to_owned).collect();
    assert_eq!(of_grbl.fields, expected);
    assert!(of_grbl.effects.is_empty() && of_grbl.pins.is_empty() && !of_grbl.final_parameters);
    assert!(of_grbl.blocks && of_grbl.refuses && of_grbl.faults_have_kinds);
    assert_eq!((of_grbl.name.as_str(), of_grbl.version.as_str()), ("Grbl", "1.1h.20190825"));
    // It reports offsets in check mode, too, and more modes.
    let of_hal = fields(Member::GrblHal);
    for field in ["g5x_offset", "g92_offset", "tool_offset", "tool_length", "retract", "tool"] {
        assert!(of_hal.fields.contains(field), "{field}");
    }
    assert_eq!(of_hal.name, "grblHAL");
}

#[test]
fn number_that_is_not_printed_exactly_is_not_compared() {
    let running = Running::at_terminal(Controller::new(Member::Grbl));
    let grbl = opened(&running, "");
    let has = |program: &str, field: &str| {
        grbl.observables(&Scenario::of(program)).fields.contains(field)
    };
    assert!(has("f100 s1000\n", "feed_rate") && has("f100 s1000\n", "spindle_speed"));
    assert!(has("g20\nf10\n", "feed_rate"), "254 mm/min");
    for program in ["f12.3456\n", "g20\nf1\n", "g93\nf1\n", "f[1]\n"] {
        assert!(!has(program, "feed_rate"), "{program}");
    }
    assert!(!has("s0.5\n", "spindle_speed"));
}

#[test]
fn offsets_are_not_compared_in_programs_that_go_beyond_a_metre() {
    let running = Running::at_terminal(Controller::new(Member::GrblHal));
    let grbl = opened(&running, "");
    let has = |program: &str| {
        let observables = grbl.observables(&Scenario::of(program));
        ["g5x_offset", "g92_offset", "tool_offset"].map(|field| observables.fields.contains(field))
    };
    for (near, far) in [("g92 x999\n", "g92 x1001\n"), ("g20\ng0 z-39\n", "g20\ng0 z-40\n")] {
        assert_eq!((has(near), has(far)), ([true; 3], [false; 3]), "{far}");
    }
}

#[test]
fn offsets_are_reported_in_the_active_unit() {
    let running = Running::at_terminal(Controller::new(Member::GrblHal));
    let grbl = opened(&running, "");
    let (settings, _) = last(&outcome(&grbl, "g43.1 z25.4\ng20\n"));
    let expected = Position { z: 1.0, ..Position::default() };
    assert_eq!(settings.tool_offset, Some(expected));
    assert_eq!(settings.tool_length, Some(Switch::On));
}

#[test]
fn coordinate_systems_are_restored_after_the_program_that_writes_them() {
    let controller = Controller::new(Member::GrblHal).with_system(2, -7.25);
    let running = Running::at_terminal(controller);
    let refused = run(&opened(&running, ""), "g10 l2 p2 x5\n");
    assert!(matches!(&refused, Err(HarnessError::NotRun(why)) if why.contains("eeprom=restore")));
    let grbl = opened(&running, "eeprom=restore");
    // Also where the program is refused after it has written.
    for program in ["g10 l2 p2 x5\ng10 l2 p1 z1\nm2\n", "g10 l2 p2 x5\ng1 x1\n"] {
        let _written = outcome(&grbl, program);
        let (settings, _) = last(&outcome(&grbl, "g55\n"));
        let expected = Position { x: -7.25, ..Position::default() };
        assert_eq!(settings.g5x_offset, Some(expected), "{program}");
    }
    assert!(!grbl.capabilities().fields.contains("g5x_offset"), "one is not zero");
    assert!(grbl.notes().iter().any(|note| note.contains("not zero")));
}

#[test]
fn locked_controller_is_unlocked_only_if_that_is_permitted() {
    let running = Running::at_terminal(Controller::locked());
    match open(&running, "", PATIENT) {
        Err(ControllerError::Broken(HarnessError::NotRun(why))) => {
            assert!(why.contains("locked") && why.contains("unlock"), "{why}");
        }
        other => panic!("{other:?}"),
    }
    let grbl = opened(&running, "unlock");
    assert_eq!(outcome(&grbl, "g18\nm2\n").end, End::ProgramEnd);
}

/// A case is short on the line: 8 data bits, a start and a stop bit are 10 bits a byte.
#[test]
fn link_carries_a_typical_case_in_a_tenth_of_a_second() {
    let running = Running::at_terminal(Controller::new(Member::Grbl));
    let grbl = opened(&running, "");
    let before = grbl.traffic();
    let _first = outcome(&grbl, PROGRAM);
    let after = grbl.traffic();
    let (sent, received) = (after.sent - before.sent, after.received - before.received);
    let milliseconds = (sent + received) * 10 * 1000 / u64::from(BITS_PER_SECOND);
    println!(
        "{sent} bytes sent, {received} received: {milliseconds} ms at {BITS_PER_SECOND} bit/s"
    );
    assert!(milliseconds < 100, "{milliseconds} ms");
}
