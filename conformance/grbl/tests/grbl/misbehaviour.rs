//! Controllers that break the protocol: each ends as the right verdict, and the next program runs.

use gaugeblock_adapter::HarnessError;
use gaugeblock_vocabulary::{End, FaultKind};

use crate::simulator::{Controller, Member, Misbehaviour, Running};
use crate::{IMPATIENT, PATIENT, open, opened, run};

const PROGRAM: &str = "g18\ng1 f100 x1 (trip)\ng19\nm2\n";

/// Runs a program at which the controller misbehaves, and then a good one.
fn check(misbehaviour: Misbehaviour, expect: impl Fn(&HarnessError) -> bool) {
    let silent = matches!(misbehaviour, Misbehaviour::Silence | Misbehaviour::LostOk);
    for running in [
        Running::at_terminal(Controller::that(misbehaviour)),
        Running::at_socket(Controller::that(misbehaviour)),
    ] {
        let limits = if silent { IMPATIENT } else { PATIENT };
        let grbl = open(&running, "", limits).unwrap_or_else(|error| panic!("{error}"));
        match run(&grbl, PROGRAM) {
            Err(error) => assert!(expect(&error), "{misbehaviour:?}: {error:?}"),
            Ok(outcome) => panic!("{misbehaviour:?}: {:?}", outcome.end),
        }
        let next = run(&grbl, "g18\nm2\n");
        assert!(next.is_ok_and(|outcome| outcome.end == End::ProgramEnd), "{misbehaviour:?}");
    }
}

#[test]
fn silence_is_a_time_out() {
    check(Misbehaviour::Silence, |error| *error == HarnessError::TimedOut { seconds: 3 });
}

#[test]
fn lost_ok_is_a_time_out() {
    check(Misbehaviour::LostOk, |error| *error == HarnessError::TimedOut { seconds: 3 });
}

#[test]
fn garbage_is_unreadable() {
    check(Misbehaviour::Garbage, |error| matches!(error, HarnessError::Unreadable { .. }));
}

#[test]
fn restart_is_a_crash() {
    check(Misbehaviour::Restart, |error| {
        let HarnessError::Crashed { status, stderr } = error else { return false };
        status.contains("restarted") && stderr.contains("Grbl 1.1h")
    });
}

#[test]
fn endless_answer_is_a_flood() {
    check(Misbehaviour::Flood, |error| matches!(error, HarnessError::Flooded { .. }));
}

#[test]
fn alarm_is_a_fault_and_its_lock_stops_the_next_program() {
    for (options, goes_on) in [("", false), ("unlock", true)] {
        let running = Running::at_terminal(Controller::that(Misbehaviour::AlarmLock));
        let grbl = opened(&running, options);
        let Ok(outcome) = run(&grbl, PROGRAM) else { panic!("no outcome") };
        let End::Fault(fault) = outcome.end else { panic!("{:?}", outcome.end) };
        assert_eq!(fault.kind, Some(FaultKind::BeyondLimit));
        assert_eq!(fault.block.map(|block| block.line), Some(2));
        match run(&grbl, "g18\nm2\n") {
            Ok(outcome) => assert!(goes_on && outcome.end == End::ProgramEnd),
            Err(HarnessError::NotRun(why)) => assert!(!goes_on && why.contains("hint"), "{why}"),
            Err(error) => panic!("{error:?}"),
        }
    }
}

#[test]
fn lock_is_no_fault_of_the_block() {
    let running = Running::at_terminal(Controller::that(Misbehaviour::LockUnseen));
    match run(&opened(&running, ""), PROGRAM) {
        Err(HarnessError::NotRun(why)) => {
            assert!(why.contains("error:9 at main.ngc:2; hint:"), "{why}");
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn connection_that_ends_is_opened_again() {
    let running = Running::at_socket(Controller::new(Member::Grbl));
    let grbl = opened(&running, "");
    assert!(run(&grbl, "g18\nm2\n").is_ok());
    drop(running);
    let failed = run(&grbl, "g18\nm2\n");
    assert!(matches!(failed, Err(HarnessError::Crashed { .. })), "{failed:?}");
    let gone = run(&grbl, "g18\nm2\n");
    assert!(matches!(gone, Err(HarnessError::NotRun(_))), "{gone:?}");
}
