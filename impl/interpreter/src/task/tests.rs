//! The task on a machine that follows a script: what is asked and what changes, at which time.
#![expect(
    clippy::float_cmp,
    clippy::wildcard_enum_match_arm,
    reason = "the script's times are exact, and other effects and activities are not looked at"
)]

use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;

use gaugeblock_vocabulary::scenario::Action;
use gaugeblock_vocabulary::{
    ControllerMode, Effect, End, Machine as Kind, Options, Pin, Request, Settings,
};

use super::{
    Deadlock, ExternalOperation, IdleRequest, Input, Machine, OperationState, StepResult, Task,
    WaitEvent,
};
use crate::{Interpreter, Limits, Memory, Reply, Sink};

/// A machine whose inputs and whose operator follow a script.
#[derive(Default)]
struct Script {
    now: f64,
    /// What is asked, in order of time.
    asked: Vec<(f64, Action)>,
    /// Digital input 0, in order of time.
    input: Vec<(f64, f64)>,
    /// The feed stop's input.
    feed_hold: Vec<(f64, f64)>,
    effects: Vec<String>,
    pins: BTreeMap<Pin, Vec<f64>>,
}

impl Script {
    fn asks(asked: &[(f64, Action)]) -> Self {
        Self { asked: asked.to_vec(), ..Self::default() }
    }

    fn pin_values(&self, pin: Pin) -> &[f64] {
        self.pins.get(&pin).map_or(&[], Vec::as_slice)
    }
}

impl Sink for Script {
    fn set(&mut self, _line: u32, _changed: &Settings) {}

    fn perform(&mut self, _line: u32, effect: &Effect) -> Reply {
        self.effects.push(match effect {
            Effect::RequestRefused { request } => alloc::format!("refused {request}"),
            effect => effect.name().into(),
        });
        Reply::Done
    }
}

impl Machine for Script {
    fn time(&self) -> f64 {
        self.now
    }

    fn wait(&mut self, until: Option<f64>) -> WaitEvent {
        let until = until.unwrap_or(f64::INFINITY);
        let changes = self.input.iter().chain(&self.feed_hold).map(|(time, _)| *time);
        let change = changes.filter(|time| *time > self.now).fold(f64::INFINITY, f64::min);
        let asked = self.asked.first().map_or(f64::INFINITY, |(time, _)| time.max(self.now));
        if change.is_finite() && change <= until.min(asked) {
            self.now = change;
            return WaitEvent::Changed;
        }
        if asked.is_finite() && asked <= until {
            self.now = asked;
            return WaitEvent::Requested(self.asked.remove(0).1);
        }
        if until.is_infinite() {
            return WaitEvent::Never;
        }
        self.now = until;
        WaitEvent::Time
    }

    fn poll_request(&mut self) -> Option<Action> {
        let is_due = self.asked.first().is_some_and(|(time, _)| *time <= self.now);
        is_due.then(|| self.asked.remove(0).1)
    }

    fn input(&self, input: Input) -> f64 {
        let script = match input {
            Input::Digital(0) => &self.input,
            Input::FeedHold => &self.feed_hold,
            Input::Digital(_) | Input::Analog(_) | Input::AdaptiveFeed => return 0.0,
        };
        let past = script.iter().filter(|(time, _)| *time <= self.now);
        past.map(|(_, value)| *value).next_back().unwrap_or(0.0)
    }

    fn operation_state(&mut self, _operation: ExternalOperation) -> OperationState {
        OperationState::Done
    }

    fn set_pin(&mut self, pin: Pin, value: f64) {
        self.pins.entry(pin).or_default().push(value);
    }
}

fn task(script: Script, options: &[(&str, &str)]) -> Task<Script> {
    let options = options.iter().map(|(id, option)| ((*id).into(), (*option).into())).collect();
    let interpreter = Interpreter::new(Kind::default(), Options(options), Limits::default());
    Task::new(interpreter.unwrap(), script)
}

/// Runs a program to its end, or until nothing will happen any more.
fn run(task: &mut Task<Script>, program: &str) -> StepResult {
    let mut source = Memory::new(program);
    task.start();
    loop {
        match task.step(&mut source).unwrap() {
            StepResult::More => {}
            over => return over,
        }
    }
}

#[test]
fn a_pause_waits_for_resume() {
    let mut paused = task(Script::default(), &[]);
    assert_eq!(run(&mut paused, "m0\nm2\n"), StepResult::Deadlock(Deadlock::Paused));
    let mut resumed = task(Script::asks(&[(3.0, Action::Resume)]), &[]);
    assert_eq!(run(&mut resumed, "m0\nm2\n"), StepResult::Ended(End::ProgramEnd));
    assert_eq!(resumed.machine().now, 3.0);
    assert_eq!(resumed.mode(), ControllerMode::Mdi);
}

#[test]
fn modes_are_kept_while_a_program_runs() {
    let asks = [
        (0.1, Action::Mode(ControllerMode::Manual)),
        (0.2, Action::Mdi("g0 x1".into())),
        (0.3, Action::Mode(ControllerMode::Auto)),
    ];
    let mut task = task(Script::asks(&asks), &[]);
    assert_eq!(run(&mut task, "g4 p1\nm2\n"), StepResult::Ended(End::ProgramEnd));
    let refused = [Request::Mode, Request::Mdi].map(|request| alloc::format!("refused {request}"));
    assert!(refused.iter().all(|refused| task.machine().effects.contains(refused)));
    assert_eq!(task.machine().effects.len(), 5);
}

#[test]
fn abort_keeps_what_was_done() {
    let mut task = task(Script::asks(&[(0.5, Action::Abort)]), &[]);
    let program = "s100 m3\nf7 g4 p1 g1 x5\nm2\n";
    assert_eq!(run(&mut task, program), StepResult::Ended(End::Aborted));
    assert_eq!(task.machine().now, 0.5);
    assert_eq!(task.machine().effects, ["dwell"]);
    let state = task.interpreter().state();
    assert_eq!(state.position.unwrap().x, 0.0);
    assert_eq!(task.interpreter().settings().feed_rate, Some(7.0));
    assert_eq!(task.machine().pin_values(Pin::SpindleOn(0)), [1.0, 0.0]);
    assert_eq!(task.mode(), ControllerMode::Auto);
}

#[test]
fn aborted_held_move_is_not_made() {
    for program in [
        "f100 g1 x5\nm2\n",
        "f100 g91 g1 x5\nm2\n",
        "f100 g2 x2 i1\nm2\n",
        "f100 g5.1 i1 j1 x2\nm2\n",
    ] {
        let mut held = task(Script::asks(&[(0.5, Action::Abort)]), &[]);
        held.state.panel.feed_override = 0.0;
        assert_eq!(run(&mut held, program), StepResult::Ended(End::Aborted), "{program}");
        let state = held.interpreter().state();
        assert_eq!(state.position.unwrap().x, 0.0, "{program}");
        assert_eq!(state.motion, Some(gaugeblock_vocabulary::Motion::None), "{program}");
    }
}

#[test]
fn read_ahead_survives_an_abort_by_option() {
    let run_to = |options: &[(&str, &str)]| {
        let mut task = task(Script::asks(&[(0.5, Action::Abort)]), options);
        let program = "#31=1\ng0 x3\ng4 p1\n#31=2 g0 x4\nm66 p0 l3 q1\n#31=3\nm2\n";
        assert_eq!(run(&mut task, program), StepResult::Ended(End::Aborted));
        let value =
            task.interpreter_mut().parameters().iter().find(|(number, _)| *number == 31).copied();
        (value, task.interpreter().state().position.unwrap().x, task.machine().effects.len())
    };
    assert_eq!(run_to(&[]), (Some((31, 1.0)), 3.0, 2));
    assert_eq!(run_to(&[("abort.read-ahead", "read-on")]), (Some((31, 2.0)), 3.0, 2));
}

#[test]
fn every_item_of_a_large_machine_is_found() {
    let machine = Kind { digital_io: u16::MAX, analog_io: u16::MAX, ..Kind::default() };
    let interpreter = Interpreter::new(machine, Options::default(), Limits::default());
    let mut task = Task::new(interpreter.unwrap(), Script::default());
    let program = "m64 p10\nm66 e0 l0\n#31=#<_hal[motion.digital-out-10]>\nm2\n";
    assert_eq!(run(&mut task, program), StepResult::Ended(End::ProgramEnd));
    assert!(task.interpreter_mut().parameters().contains(&(31, 1.0)));
}

#[test]
fn edges_of_inputs_are_awaited() {
    let read = |program: &str| {
        let script = Script { input: [(1.0, 1.0), (2.0, 0.0)].into(), ..Script::default() };
        let mut task = task(script, &[]);
        assert_eq!(run(&mut task, program), StepResult::Ended(End::ProgramEnd), "{program}");
        let parameters = task.interpreter_mut().parameters();
        let read =
            parameters.iter().find(|(number, _)| *number == 5399).map_or(0.0, |(_, read)| *read);
        (read, task.machine().now)
    };
    assert_eq!(read("m66 p0 l0\nm2\n"), (0.0, 0.0));
    assert_eq!(read("m66 p0 l1 q5\nm2\n"), (1.0, 1.0));
    assert_eq!(read("m66 p0 l2 q5\nm2\n"), (0.0, 2.0));
    assert_eq!(read("m66 p0 l3 q0.5\nm2\n"), (-1.0, 0.5));
    assert_eq!(read("g4 p1.5\nm66 p0 l3 q1\nm2\n"), (1.0, 1.5));
    assert_eq!(read("g4 p1.5\nm66 p0 l1 q1\nm2\n"), (-1.0, 2.5));
}

#[test]
fn outputs_wait_for_the_motion_that_begins() {
    let script = Script { feed_hold: [(0.0, 1.0), (2.0, 0.0)].into(), ..Script::default() };
    let mut task = task(script, &[]);
    let program = "m53 p0\nm62 p0\nm64 p1\ng4 p1\nm53 p1\ng0 x1\nm2\n";
    assert_eq!(run(&mut task, program), StepResult::Ended(End::ProgramEnd));
    assert_eq!(task.machine().now, 2.0);
    assert_eq!(task.machine().pin_values(Pin::DigitalOut(0)), [1.0]);
    assert_eq!(task.machine().pin_values(Pin::DigitalOut(1)), [1.0]);
}

#[test]
fn mdi_blocks_are_executed() {
    let asks = [
        (1.0, Action::Mdi("g0 x5".into())),
        (2.0, Action::Mode(ControllerMode::Manual)),
        (3.0, Action::Mdi("g0 x6".into())),
    ];
    let mut task = task(Script::asks(&asks), &[]);
    assert_eq!(run(&mut task, "m2\n"), StepResult::Ended(End::ProgramEnd));
    assert_eq!(task.idle(), IdleRequest::Mdi("g0 x5".into()));
    let mut source = Memory::new("").with_file("go.ngc", "o<go> sub\ng0 x9\no<go> endsub\nm2\n");
    assert_eq!(task.execute_mdi("g0 x5", 1, &mut source), Ok(StepResult::MdiDone));
    assert_eq!(task.execute_mdi("o<go> call", 2, &mut source), Ok(StepResult::MdiDone));
    assert_eq!(task.execute_mdi("(nothing)", 3, &mut source), Ok(StepResult::MdiDone));
    assert_eq!(task.interpreter().state().position.unwrap().x, 9.0);
    let refused = task.execute_mdi("g0 g1 x1", 4, &mut source);
    assert!(
        matches!(refused, Err(crate::Error::Fault(fault)) if fault.block.as_ref().is_some_and(|block| block.file == "mdi" && block.line == 4))
    );
    assert_eq!(task.execute_mdi("m2", 5, &mut source), Ok(StepResult::Ended(End::ProgramEnd)));
    assert_eq!(task.idle(), IdleRequest::None);
    assert!(task.machine().effects.ends_with(&["refused mdi".into()]));
}

#[test]
fn blank_mdi_line_is_not_a_block() {
    let asks = [(1.0, Action::Mdi(" \t".into())), (1.0, Action::Mdi("#31=1".into()))];
    let mut task = task(Script::asks(&asks), &[]);
    task.set_mode(ControllerMode::Mdi);
    assert_eq!(task.idle(), IdleRequest::Mdi("#31=1".into()));
}

#[test]
fn saved_state_outlives_an_abort_while_idle() {
    let asks =
        [(1.0, Action::Mdi("m70".into())), (2.0, Action::Abort), (3.0, Action::Mdi("m72".into()))];
    let mut task = task(Script::asks(&asks), &[("saved-state.after-run", "forgotten")]);
    assert_eq!(run(&mut task, "m2\n"), StepResult::Ended(End::ProgramEnd));
    for number in 1..=2 {
        let IdleRequest::Mdi(text) = task.idle() else { panic!("a block by hand") };
        assert_eq!(
            task.execute_mdi(&text, number, &mut Memory::new("")),
            Ok(StepResult::MdiDone),
            "{text}"
        );
    }
    assert_eq!(task.idle(), IdleRequest::None);
}

#[test]
fn mdi_call_of_an_ended_programs_sub_is_unspecified() {
    let is_open = |task: &mut Task<Script>, block: &str, files: &[(&str, &str)]| {
        let mut source = Memory::new("");
        for (name, text) in files {
            source = source.with_file(*name, *text);
        }
        matches!(
            task.execute_mdi(block, 1, &mut source),
            Ok(StepResult::Ended(End::Unspecified { .. }))
        )
    };
    let mut task = task(Script::default(), &[]);
    let program =
        "o9 sub\n#31=[#31+1]\no9 endsub\no1 repeat [1]\no8 sub\no8 endsub\no1 endrepeat\nm2\n";
    assert_eq!(run(&mut task, program), StepResult::Ended(End::ProgramEnd));
    assert!(is_open(&mut task, "o9 call", &[]));
    assert!(is_open(&mut task, "o9 call", &[]));
    assert!(is_open(&mut task, "o8 call", &[]));
    assert!(is_open(&mut task, "o<x> call", &[("x.ngc", "o<x> sub\no9 call\no<x> endsub\n")]));
    assert!(!is_open(&mut task, "o7 call", &[]));
    assert!(is_open(&mut task, "o9 call", &[("9.ngc", "o9 sub\no9 endsub\n")]));
    assert_eq!(run(&mut task, "m2\n"), StepResult::Ended(End::ProgramEnd));
    assert!(!is_open(&mut task, "o9 call", &[]));
}

#[test]
fn refused_percent_line_is_the_next_block() {
    for program in ["#31=1\n%\nm2\n", "o1 repeat [1]\n%\no1 endrepeat\nm2\n"] {
        for aborts in [false, true] {
            let mut task = task(Script::default(), &[]);
            let mut source = Memory::new(program);
            task.start();
            assert_eq!(task.next_block(&mut source), Some(("main.ngc", 1)));
            assert_eq!(task.step(&mut source), Ok(StepResult::More));
            assert_eq!(task.next_block(&mut source), Some(("main.ngc", 2)), "{program}");
            if aborts {
                task.machine_mut().asked.push((0.0, Action::Abort));
                assert_eq!(
                    task.step(&mut source),
                    Ok(StepResult::Ended(End::Aborted)),
                    "{program}"
                );
            } else {
                let Err(crate::Error::Fault(fault)) = task.step(&mut source) else {
                    panic!("{program}")
                };
                assert!(fault.block.is_some_and(|block| block.line == 2), "{program}");
            }
        }
    }
}

#[test]
fn read_ahead_after_an_abort_is_bounded_by_the_limits() {
    let read = |program: &str, blocks_ahead: u32| {
        let options = Options([("abort.read-ahead".into(), "read-on".into())].into());
        let limits = Limits { blocks_ahead, ..Limits::default() };
        let interpreter = Interpreter::new(Kind::default(), options, limits).unwrap();
        let mut task = Task::new(interpreter, Script::asks(&[(0.5, Action::Abort)]));
        let mut source = Memory::new(program);
        task.start();
        let end = loop {
            match task.step(&mut source) {
                Ok(StepResult::More) => {}
                over => break over,
            }
        };
        (end, task.interpreter_mut().parameters().first().copied())
    };
    let blocks = "#31=[#31+1]\n".repeat(1500);
    let (end, counted) = read(&alloc::format!("g4 p1\n{blocks}m2\n"), 100_000);
    assert_eq!((end, counted), (Ok(StepResult::Ended(End::Aborted)), Some((31, 1500.0))));
    let (end, _) = read("g4 p1\no1 while [1]\no1 endwhile\nm2\n", 100_000);
    assert!(matches!(end, Err(crate::Error::LimitExceeded { .. })), "{end:?}");
}

#[test]
fn undocumented_requests_are_unspecified() {
    for pauses in [false, true] {
        let asks = [(0.2, Action::Pause), (0.5, Action::CycleStart)];
        let mut task = task(Script::asks(&asks[usize::from(!pauses)..]), &[]);
        let over = run(&mut task, "g4 p1\nm2\n");
        assert!(matches!(over, StepResult::Ended(End::Unspecified { .. })), "{over:?}");
    }
    let mut task = task(Script::asks(&[(0.5, Action::Mode(ControllerMode::Mdi))]), &[]);
    task.set_mode(ControllerMode::Mdi);
    let over = task.execute_mdi("g4 p1", 1, &mut Memory::new(""));
    assert!(matches!(over, Ok(StepResult::Ended(End::Unspecified { .. }))), "{over:?}");
}
