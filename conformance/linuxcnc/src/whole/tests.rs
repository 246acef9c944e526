//! The adapter with the installed controller; where there is none, each test says what it left out.

use std::io::Write as _;
use std::sync::OnceLock;

use gaugeblock_vocabulary::scenario::{Action, InputChange, OperatorEvent, OrientAnswer, RunPoint};
use gaugeblock_vocabulary::{BlockLocation, ControllerMode, End, Event, Machine, State};

use super::*;

/// One for all tests, so that they share its running controllers.
fn controller() -> Option<&'static LinuxCnc> {
    static CONTROLLER: OnceLock<Result<LinuxCnc, ControllerError>> = OnceLock::new();
    match CONTROLLER.get_or_init(LinuxCnc::find) {
        Ok(controller) => Some(controller),
        Err(error) => {
            // Written past the test runner, which keeps what passing tests print to itself.
            let notice = format!("left out: a test of the whole controller ({error})\n");
            std::io::stderr().write_all(notice.as_bytes()).expect("standard error can be written");
            None
        }
    }
}

fn run(scenario: &Scenario) -> Option<Outcome> {
    Some(controller()?.run(scenario).expect("a run"))
}

fn effects(outcome: &Outcome) -> Vec<(u32, &'static str)> {
    let of_step = |step: &gaugeblock_vocabulary::Step| {
        let names = step.events.iter().filter_map(|event| match event {
            Event::Do(effect) => Some(effect.name()),
            Event::Set(_) | Event::Unknown(_) => None,
        });
        names.map(|name| (step.block.line, name)).collect::<Vec<_>>()
    };
    outcome.steps.iter().flat_map(of_step).collect()
}

fn pins(outcome: &Outcome, name: &str) -> Vec<f64> {
    let changes = outcome.pins.iter().filter(|change| change.pin.to_string() == name);
    changes.map(|change| change.value).collect()
}

fn event(line: u32, action: Action) -> OperatorEvent {
    let when = RunPoint { block: BlockLocation::new("main.ngc", line), execution: 1, offset: 0.0 };
    OperatorEvent { when, action }
}

#[test]
fn outputs_switch_and_inputs_are_read() {
    let mut scenario = Scenario::of("m64 p1\ng4 p0.1\nm66 p2 l0\n#31=#5399\nm65 p1\nm2\n");
    scenario.environment.wires.insert("1".to_owned(), 2);
    let Some(outcome) = run(&scenario) else { return };
    assert_eq!(
        effects(&outcome),
        [
            (1, "set_digital_output"),
            (2, "dwell"),
            (3, "wait_input"),
            (5, "set_digital_output"),
            (6, "program_end")
        ]
    );
    assert_eq!(pins(&outcome, "digital_out[1]").len(), 2);
    let parameters = outcome.parameters.expect("parameters").0;
    assert_eq!(parameters.get(&31).map(|value| value.to_bits()), Some(1.0_f64.to_bits()));
}

#[test]
fn resolution_is_that_of_six_decimals_of_an_inch_on_a_machine_in_inches() {
    let Some(controller) = controller() else { return };
    let resolution = |unit| {
        let mut scenario = Scenario::of("g21 g0 x5\nm2\n");
        scenario.machine.length_unit = unit;
        controller.observables(&scenario).resolution
    };
    assert!(resolution(LengthUnit::Inch) > 1.27e-5);
    assert!(resolution(LengthUnit::Millimetre) < 1e-5);
}

#[test]
fn blocks_before_a_refused_one_are_executed() {
    let Some(outcome) = run(&Scenario::of("g0 x1\nm7\ng1 x2\nm2\n")) else { return };
    assert_eq!(effects(&outcome), [(1, "straight_traverse")]);
    let End::Fault(fault) = &outcome.end else { panic!("{:?}", outcome.end) };
    assert_eq!(fault.block, Some(BlockLocation::new("main.ngc", 3)));
    assert_eq!(fault.kind, Some(gaugeblock_vocabulary::FaultKind::ZeroFeed));
}

#[test]
fn runs_do_not_leak_state() {
    let Some(before) = run(&Scenario::of("m2\n")) else { return };
    let all = "g20 g91 g18 g93 g55 g92 x1\nm50 p0\nm70\ng0 y1\n#31=5\nm64 p0\nt1 m6\nm0\n";
    let mut scenario = Scenario::of(all);
    scenario.machine = Machine {
        tools: vec![gaugeblock_vocabulary::Tool { number: 1, ..Default::default() }],
        ..Machine::default()
    };
    let outcome = run(&scenario).expect("a run");
    assert_eq!(outcome.end, End::Paused, "{}", outcome.to_text());
    let after = run(&Scenario::of("m72\n#32=#31\nm2\n")).expect("a run");
    assert_eq!(before.start, after.start);
    assert!(matches!(after.end, End::Fault(_)), "nothing is saved: {:?}", after.end);
}

#[test]
fn files_of_subs_are_found() {
    let mut scenario = Scenario::of("o<cave> call [2]\nm2\n");
    scenario
        .program
        .files
        .insert("cave.ngc".to_owned(), "o<cave> sub\ng0 x#1\no<cave> endsub\nm2\n".to_owned());
    let Some(outcome) = run(&scenario) else { return };
    let blocks: Vec<_> = outcome.steps.iter().map(|step| step.block.to_string()).collect();
    assert_eq!(blocks, ["cave.ngc:2", "cave.ngc:3", "main.ngc:1", "main.ngc:2"]);
}

#[test]
fn a_person_resumes_a_paused_program() {
    let mut scenario = Scenario::of("m0\ng0 x1\nm1\ng0 x2\nm2\n");
    scenario.operator = vec![event(1, Action::Resume)];
    let Some(outcome) = run(&scenario) else { return };
    assert_eq!(outcome.end, End::ProgramEnd, "{}", outcome.to_text());
    scenario.operator.push(event(2, Action::OptionalStop(true)));
    let outcome = run(&scenario).expect("a run");
    assert_eq!(outcome.end, End::Paused, "{}", outcome.to_text());
}

#[test]
fn a_person_aborts_a_wait() {
    let mut scenario = Scenario::of("g0 x1\nm66 p0 l3 q20\ng0 x2\nm2\n");
    scenario.operator = vec![event(2, Action::Abort)];
    let Some(outcome) = run(&scenario) else { return };
    assert_eq!(outcome.end, End::Aborted, "{}", outcome.to_text());
    assert_eq!(effects(&outcome).first(), Some(&(1, "straight_traverse")));
}

#[test]
fn inputs_change_in_time() {
    let mut scenario = Scenario::of("m66 p0 l3 q5\n#31=#5399\nm2\n");
    let input = "digital_in[0]".to_owned();
    scenario.environment.inputs = vec![InputChange { time: 0.3, input, value: 1.0 }];
    let Some(outcome) = run(&scenario) else { return };
    let parameters = outcome.parameters.expect("parameters").0;
    assert_eq!(parameters.get(&31).map(|value| value.to_bits()), Some(1.0_f64.to_bits()));
}

#[test]
fn an_encoder_answers_or_does_not() {
    let mut scenario = Scenario::of("m19 r90 q0.5\nm2\n");
    scenario.environment.orient = vec![OrientAnswer::After(0.1)];
    let Some(outcome) = run(&scenario) else { return };
    assert_eq!(outcome.end, End::ProgramEnd, "{}", outcome.to_text());
    assert_eq!(
        pins(&outcome, "spindle_orient_angle[0]").first().map(|at| at.to_bits()),
        Some(90.0_f64.to_bits())
    );
    scenario.environment.orient = vec![OrientAnswer::Never];
    let outcome = run(&scenario).expect("a run");
    let End::Fault(fault) = &outcome.end else { panic!("{}", outcome.to_text()) };
    assert_eq!(fault.kind, Some(gaugeblock_vocabulary::FaultKind::Orient));
}

#[test]
fn user_programs_take_their_arguments_and_may_fail() {
    let program = |exit_status| gaugeblock_vocabulary::scenario::UserProgram {
        file: "M101".to_owned(),
        exit_status,
        ..Default::default()
    };
    let mut scenario = Scenario::of("m101 p1.5\ng0 x1\nm2\n");
    scenario.environment.user_programs = vec![program(0)];
    let Some(outcome) = run(&scenario) else { return };
    let call = Effect::UserCode { code: 101, p: "1.500000".to_owned(), q: "-1.000000".to_owned() };
    assert!(outcome.steps[0].events.contains(&Event::Do(call)), "{}", outcome.to_text());
    scenario.environment.user_programs = vec![program(3)];
    let outcome = run(&scenario).expect("a run");
    assert!(matches!(outcome.end, End::Fault(_)), "{}", outcome.to_text());
}

#[test]
fn controller_mode_is_reported() {
    let Some(outcome) = run(&Scenario::of("g0 x1\nm2\n")) else { return };
    let Some(State::Rs274(state)) = &outcome.steps[0].state else { panic!("no state") };
    assert_eq!(state.controller_mode, Some(ControllerMode::Auto));
}

#[test]
fn endless_program_is_killed_and_reported() {
    let Ok(mut controller) = LinuxCnc::find() else { return };
    controller.longest = Duration::from_secs(1);
    let waits = Scenario::of("m66 p0 l3 q100\nm2\n");
    assert!(matches!(controller.run(&waits), Err(HarnessError::TimedOut { .. })));
    assert_eq!(controller.run(&Scenario::of("m2\n")).expect("a run").end, End::ProgramEnd);
    let mut endless = Scenario::of("o1 do\n#1=[#1+1]\no1 while [1]\nm2\n");
    endless.budget.steps = 50;
    controller.longest = Duration::from_secs(20);
    // On a busy machine it prints more than it may before it can be stopped.
    match controller.run(&endless) {
        Ok(outcome) => assert!(matches!(outcome.end, End::BudgetExhausted { .. })),
        Err(error) => assert!(matches!(error, HarnessError::Flooded { .. }), "{error}"),
    }
    let repeated = controller.run(&Scenario::of("#31=[#31+1]\nm99\n")).expect("a run");
    assert_eq!((repeated.end, repeated.steps.len()), (End::Endless, 20));
}

#[test]
fn program_that_reaches_the_host_is_not_run() {
    let Some(controller) = controller() else { return };
    let outside = std::env::temp_dir().join(format!("gaugeblock-log-{}", std::process::id()));
    let logs = ["LOGOPEN", "LOGAPPEND"]
        .map(|word| format!("({word},{})\n(LOG,text)\n(LOGCLOSE)\nm2\n", outside.display()));
    let programs = ["(py,x=1)\nm2\n", "o<../x> call\nm2\n"].map(str::to_owned);
    for program in programs.into_iter().chain(logs) {
        let scenario = Scenario::of(&program);
        assert!(controller.supports(&scenario).is_err(), "{program}");
        assert!(controller.run(&scenario).is_err(), "{program}");
    }
    assert!(!outside.exists());
    let mut by_hand = Scenario::of("m0\nm2\n");
    by_hand.operator = vec![event(1, Action::Mdi("(logopen,/x)".to_owned()))];
    assert!(controller.supports(&by_hand).is_err());
    let mut injected = Scenario::of("m2\n");
    injected.machine.ini.insert("[RS274NGC]PARAMETER_FILE=/x #".to_owned(), 0.0);
    assert!(controller.supports(&injected).is_err());
    let mut scenario = Scenario::of("m2\n");
    let file = "../M101".to_owned();
    let program = gaugeblock_vocabulary::scenario::UserProgram { file, ..Default::default() };
    scenario.environment.user_programs = vec![program];
    assert!(controller.supports(&scenario).is_err());
}
