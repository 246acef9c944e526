//! Programs that move the machine.

use gaugeblock_adapter::{Adapter as _, HarnessError};
use gaugeblock_vocabulary::{End, Position, State};

use crate::simulator::{Controller, Member, Running};
use crate::{opened, outcome, run};

#[test]
fn position_at_rest_is_reported_after_each_block() {
    let running = Running::at_terminal(Controller::new(Member::Grbl));
    let grbl = opened(&running, "motion=real");
    for field in ["position", "g5x_offset", "g92_offset", "tool_offset"] {
        assert!(grbl.capabilities().fields.contains(field), "{field}");
    }
    // The machine returns to where the program began: a second run is the same.
    for _ in 0..2 {
        let found = outcome(&grbl, "g0 x10 y-2.5\ng20 g91\ng1 f10 z1\ng92 x0\nm2\n");
        assert_eq!(found.end, End::ProgramEnd);
        let positions: Vec<Option<Position>> = found
            .steps
            .iter()
            .map(|step| match &step.state {
                Some(State::Rs274(state)) => state.position,
                _ => None,
            })
            .collect();
        assert_eq!(positions[0], Some(Position { x: 10.0, y: -2.5, ..Position::default() }));
        let in_inches = positions[1].expect("a position in the new unit");
        assert!((in_inches.x - 10.0 / 25.4).abs() < 1e-9 && in_inches.z.abs() < 1e-9);
        assert!((positions[2].expect("a position").z - 1.0).abs() < 1e-9);
        assert!(positions[3].expect("a position").x.abs() < 1e-9);
    }
}

#[test]
fn machine_returns_after_a_refused_block_too() {
    let running = Running::at_terminal(Controller::new(Member::Grbl));
    let grbl = opened(&running, "motion=real");
    for _ in 0..2 {
        let found = outcome(&grbl, "g0 x10\ng64\nm2\n");
        assert!(matches!(found.end, End::Fault(_)), "{:?}", found.end);
    }
}

#[test]
fn program_does_not_begin_away_from_zero() {
    let controller = Controller::new(Member::Grbl).with_system(1, 50.0);
    let running = Running::at_terminal(controller);
    let grbl = opened(&running, "motion=real");
    match run(&grbl, "g0 x1\nm2\n") {
        Err(HarnessError::NotRun(why)) => assert!(why.contains("hint: move it"), "{why}"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn in_check_mode_nothing_moves() {
    let running = Running::at_terminal(Controller::new(Member::Grbl));
    let found = outcome(&opened(&running, ""), "g0 x10\nm2\n");
    assert_eq!(found.end, End::ProgramEnd);
    let grbl = opened(&running, "motion=real");
    assert_eq!(outcome(&grbl, "g0 x1\nm2\n").end, End::ProgramEnd, "it is still at zero");
}
