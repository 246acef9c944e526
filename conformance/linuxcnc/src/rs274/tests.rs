//! Against the real binary. Where it is not installed these tests say so and pass.

use gaugeblock_vocabulary::{
    BlockLocation, Effect, End, Event, FaultKind, LengthUnit, Machine, Motion, Outcome, Position,
    Scenario, Sorted, State, Tool,
};

use super::*;

/// The controller, or a notice that it is absent.
fn controller() -> Option<Rs274> {
    match Rs274::find(None) {
        Ok(controller) => Some(controller),
        Err(error) => {
            eprintln!("skipped: {error}");
            None
        }
    }
}

fn run(program: &str) -> Option<Outcome> {
    Some(
        controller()?
            .run(&Scenario::of(program))
            .unwrap_or_else(|error| panic!("{error}\n{program}")),
    )
}

fn blocks(outcome: &Outcome) -> Vec<u32> {
    outcome.steps.iter().map(|step| step.block.line).collect()
}

fn effects(outcome: &Outcome) -> Vec<(u32, String)> {
    let of_step = |step: &gaugeblock_vocabulary::Step| -> Vec<(u32, String)> {
        let name = |event: &Event| match event {
            Event::Do(effect) => Some((step.block.line, effect.name().to_owned())),
            Event::Set(_) | Event::Unknown(_) => None,
        };
        step.events.iter().filter_map(name).collect()
    };
    outcome.steps.iter().flat_map(of_step).collect()
}

fn settings_at_end(outcome: &Outcome) -> Settings {
    let mut settings = outcome.start.clone();
    for event in outcome.steps.iter().flat_map(|step| &step.events) {
        if let Event::Set(change) = event {
            settings.overlay(change);
        }
    }
    settings
}

fn refusal(program: &str) -> Option<(Option<FaultKind>, Option<BlockLocation>)> {
    let End::Fault(fault) = run(program)?.end else { panic!("accepted: {program}") };
    Some((fault.kind, fault.block))
}

#[test]
fn a_move_is_an_effect_of_its_block() {
    let Some(outcome) = run("g20 f10\ng1 x1 y-2\nm2\n") else { return };
    assert_eq!(blocks(&outcome), [1, 2, 3]);
    assert_eq!(outcome.end, End::ProgramEnd);
    let end = Position { x: 1.0, y: -2.0, ..Position::default() };
    assert_eq!(outcome.steps[1].events, [Event::Do(Effect::StraightFeed { end })]);
    let Some(State::Rs274(state)) = &outcome.steps[1].state else { panic!("no state") };
    assert_eq!((state.motion, state.position), (Some(Motion::Feed), Some(end)));
    assert_eq!(state.tool, None);
}

#[test]
fn settings_change_at_their_calls() {
    let Some(outcome) = run("g91 g20 f5 g1 x1\ng4 p0.5 g90\nm2\n") else { return };
    let Event::Set(before) = &outcome.steps[0].events[0] else { panic!("settings first") };
    assert_eq!(before.units, Some(LengthUnit::Inch));
    assert!(matches!(outcome.steps[0].events[1], Event::Do(Effect::StraightFeed { .. })));
    assert_eq!(outcome.steps[0].events.len(), 2, "{:?}", outcome.steps[0]);
}

#[test]
fn settings_reset_at_the_end_are_reported() {
    let Some(outcome) = run("g91 g18 g99 f3\ng41.1 d1\n/ m2 (bye)\n") else { return };
    let end = settings_at_end(&outcome);
    assert_eq!(end.distance.map(|mode| mode.word()), Some("absolute"));
    assert_eq!(end.plane.map(|plane| plane.word()), Some("xy"));
    assert_eq!(end.compensation.map(|side| side.word()), Some("off"));
    assert_eq!(effects(&outcome).last(), Some(&(3, "program_end".to_owned())));
}

#[test]
fn pallets_are_exchanged_after_the_reset() {
    let Some(outcome) = run("g91\nm30\n") else { return };
    let names = |event: &Event| match event {
        Event::Set(_) | Event::Unknown(_) => "set".to_owned(),
        Event::Do(effect) => effect.name().to_owned(),
    };
    let events: Vec<_> = outcome.steps[1].events.iter().map(names).collect();
    assert_eq!(events, ["set", "pallet_shuttle", "program_end"]);
}

#[test]
fn loops_and_calls_show_every_execution() {
    let program = "o1 sub\ng0 x#1\no1 endsub\n#5=0\no2 while [#5 lt 2]\n#5=[#5+1]\no1 call [#5]\no2 endwhile\nm2\n";
    let Some(outcome) = run(program) else { return };
    assert_eq!(
        effects(&outcome)[..2],
        [(2, "straight_traverse".to_owned()), (2, "straight_traverse".to_owned())]
    );
    let calls = blocks(&outcome).into_iter().filter(|line| *line == 7).count();
    assert_eq!(calls, 2, "{outcome:?}");
    // A call counts when it returns, after its sub.
    let first_call = blocks(&outcome).iter().position(|line| *line == 7).unwrap();
    assert_eq!(blocks(&outcome)[first_call - 2..first_call], [2, 3]);
}

#[test]
fn sub_files_are_observed_too() {
    let Some(controller) = controller() else { return };
    let mut scenario = Scenario::of("o<cave> call [3]\nm2\n");
    scenario.program.files.insert(
        "cave.ngc".to_owned(),
        "o<cave> sub\ng0 x#1\nx[1/0]\no<cave> endsub\nm2\n".to_owned(),
    );
    let outcome = controller.run(&scenario).unwrap();
    assert_eq!(outcome.steps[0].block, BlockLocation::new("cave.ngc", 2));
    let End::Fault(fault) = outcome.end else { panic!("no fault") };
    assert_eq!(
        (fault.kind, fault.block),
        (Some(FaultKind::DivideByZero), Some(BlockLocation::new("cave.ngc", 3)))
    );
}

#[test]
fn refusals_have_a_block_and_a_kind() {
    for (program, kind, line) in [
        ("g0 x1\n\nx2 x3\nm2\n", FaultKind::RepeatedWord, Some(3)),
        ("o100 sub\nm72\no100 endsub\nm70\no100 call\nm2\n", FaultKind::NothingSaved, Some(2)),
        (
            "#1=2\no1 while [1/#1 gt 0]\n#1=[#1-1]\no1 endwhile\nm2\n",
            FaultKind::DivideByZero,
            Some(2),
        ),
        ("o1 if [0]\no1 elseif [1/0]\no1 endif\nm2\n", FaultKind::DivideByZero, Some(2)),
        ("o9 call\nm2\n", FaultKind::UnknownSub, Some(1)),
        ("m98 p5\nm2\n", FaultKind::UnknownSub, Some(1)),
        ("g0 x1\n", FaultKind::MissingEnd, None),
        ("", FaultKind::MissingEnd, None),
        ("%\ng0 x1\n", FaultKind::MissingEnd, None),
        ("g0 x1\n(abort,out of range)\nm2\n", FaultKind::AbortedByProgram, Some(2)),
        ("m3 $1\nm2\n", FaultKind::SpindleOutOfRange, Some(1)),
        ("g96 s10\nm70\ng97\nm72\nm2\n", FaultKind::MissingWord, Some(4)),
        ("% x\nm2\n%\n", FaultKind::BadCharacter, Some(1)),
    ] {
        let Some(refusal) = refusal(program) else { return };
        assert_eq!(
            refusal,
            (Some(kind), line.map(|line| BlockLocation::new("main.ngc", line))),
            "{program}"
        );
    }
}

#[test]
fn a_message_names_lines_of_the_program() {
    let Some(outcome) = run("g0 x1\n\no1 endif\nm2\n") else { return };
    let End::Fault(fault) = outcome.end else { panic!("accepted") };
    assert!(fault.message.starts_with("3: "), "{}", fault.message);
}

#[test]
fn percent_signs_end_a_program() {
    let Some(outcome) = run("\n%\ng4 p1\n%\nm2\n") else { return };
    assert_eq!((blocks(&outcome), outcome.end), (vec![3], End::PercentEnd));
}

#[test]
fn compensated_move_is_not_judged_that_waits_for_the_end() {
    let path = "f1\ng42.1 d1\ng1 x1\ny-2\n";
    let Some(outcome) = run(&format!("{path}m2 x0\n")) else { return };
    assert!(matches!(outcome.end, End::Unsupported { block, .. } if block.line == 5));
    for end in ["x0\nm2\n", "m2\n"] {
        let end = run(&format!("{path}{end}")).map(|outcome| outcome.end);
        assert_eq!(end, Some(End::ProgramEnd), "{path}");
    }
}

#[test]
fn messages_go_to_their_channels() {
    let Some(outcome) = run("(msg,a)\n#5599=0\n(debug,b)\n(print,c#31)\n(log,d)\nm2\n") else {
        return;
    };
    let message = |event: &Event| match event {
        Event::Do(Effect::Message { channel, text }) => Some(format!("{channel} {text}")),
        Event::Do(_) | Event::Set(_) | Event::Unknown(_) => None,
    };
    let messages: Vec<_> =
        outcome.steps.iter().flat_map(|step| &step.events).filter_map(message).collect();
    assert_eq!(messages, ["display a", "print c0.000000", "log d"]);
}

#[test]
fn parameters_are_reported_after_blocks_and_at_the_end() {
    let Some(outcome) = run("#31=2.5\n#[30+2]=7\n#<x>=1\nm2\n") else { return };
    let changed = |step: usize| match &outcome.steps[step].state {
        Some(State::Rs274(state)) => state.parameter.clone().unwrap_or_default().0,
        _ => panic!("no state"),
    };
    assert_eq!(
        changed(0),
        Sorted::from([("31".to_owned(), 2.5)]),
        "what is not named and does not change is left out"
    );
    assert_eq!(changed(1), Sorted::from([("32".to_owned(), 7.0)]));
    assert_eq!(changed(2), Sorted::from([("x".to_owned(), 1.0)]));
    let last = outcome.parameters.unwrap().0;
    assert_eq!((last.get(&31), last.get(&32), last.get(&33)), (Some(&2.5), Some(&7.0), None));
}

#[test]
fn tools_go_by_number() {
    let Some(controller) = controller() else { return };
    let tool = |number, z| Tool {
        number,
        offset: Position { z, ..Position::default() },
        ..Tool::default()
    };
    let mut scenario = Scenario::of("g20 t9 m6 g43\nm2\n");
    scenario.machine = Machine {
        length_unit: LengthUnit::Inch,
        tools: vec![tool(4, 1.0), tool(9, 0.5)],
        ..Machine::default()
    };
    let outcome = controller.run(&scenario).unwrap();
    let names: Vec<_> = effects(&outcome).into_iter().map(|(_, name)| name).collect();
    assert_eq!(names, ["prepare_tool", "change_tool", "program_end"]);
    assert!(outcome.steps[0].events.contains(&Event::Do(Effect::ChangeTool { tool: 9 })));
    assert_eq!(
        settings_at_end(&outcome).tool_offset.map(|offset| offset.to_string()),
        Some("(z0.5)".to_owned())
    );
}

#[test]
fn feed_under_inverse_time_is_had_back() {
    let Some(outcome) = run("g93 g1 x3 y4 f6\nx3 y4.5 f8\nm2\n") else { return };
    let feed = |step: usize| {
        outcome.steps[step].events.iter().find_map(|event| match event {
            Event::Set(settings) => settings.feed_rate,
            Event::Do(_) | Event::Unknown(_) => None,
        })
    };
    assert_eq!([feed(0), feed(1), feed(2)], [Some(6.0), Some(8.0), Some(0.0)]);
}

#[test]
fn deleted_block_is_not_a_step() {
    let Some(controller) = controller() else { return };
    let mut scenario = Scenario::of("/g0 x1\ng0 x2\nm2\n");
    assert_eq!(blocks(&controller.run(&scenario).unwrap()), [1, 2, 3]);
    scenario.program.block_delete = true;
    assert_eq!(blocks(&controller.run(&scenario).unwrap()), [2, 3]);
}

#[test]
fn an_endless_program_exhausts_its_budget() {
    let Some(mut controller) = controller() else { return };
    controller.limits.bytes = 4 << 20;
    let mut scenario = Scenario::of("o1 do\ng4 p1\no1 while [1]\nm2\n");
    scenario.budget.steps = 100;
    let outcome = controller.run(&scenario).unwrap();
    assert_eq!(outcome.steps.len(), 100);
    assert!(matches!(outcome.end, End::BudgetExhausted { .. }));
    scenario.budget.steps = u32::MAX;
    scenario.budget.effects = u32::MAX;
    assert_eq!(controller.run(&scenario), Err(HarnessError::Flooded { bytes: 4 << 20 }));
}

#[test]
fn what_the_number_of_a_line_decides_is_unsupported() {
    let Some(decided) = run("g4 p1\ng4 p1\no1 if [#<_line> eq 3]\ng0 x1\no1 endif\nm2\n") else {
        return;
    };
    let End::Unsupported { what, .. } = &decided.end else { panic!("{:?}", decided.end) };
    assert!(what.contains("#<_line>"), "{what}");
    let Some(only_told) = run("#31 = #<_line>\ng0 x1\nm2\n") else { return };
    assert_eq!(only_told.end, End::ProgramEnd);
}

#[test]
fn what_it_stubs_is_unsupported() {
    let Some(outcome) = run("m99\n") else { return };
    assert!(matches!(outcome.end, End::Unsupported { .. }), "{:?}", outcome.end);
    let Some(controller) = controller() else { return };
    let refused = |program: &str| controller.run(&Scenario::of(program)).is_err();
    assert!(refused("(py,x=1)\nm2\n") && refused("o<../x> call\nm2\n"));
}

#[test]
fn spline_without_a_checkpoint_at_its_end_is_unsupported() {
    let Some(outcome) = run("f9 g5.1 x1 y1 i1 j1 m2\n") else { return };
    let End::Unsupported { what, .. } = &outcome.end else { panic!("{:?}", outcome.end) };
    assert!(what.contains("where a spline ends"), "{what}");
}

#[test]
fn crash_gives_no_outcome() {
    let Some(controller) = controller() else { return };
    let result = controller.run(&Scenario::of("o<a(b)c> call\nm2\n"));
    assert!(matches!(result, Err(HarnessError::Crashed { .. })), "{result:?}");
}

#[test]
fn missing_binary_is_reported() {
    let error = Rs274::find(Some(Path::new("/nowhere/rs274"))).unwrap_err();
    assert!(matches!(error, ControllerError::Missing { .. }));
    let error = Rs274::find(Some(Path::new("/bin/true"))).unwrap_err();
    assert!(matches!(error, ControllerError::WrongVersion { .. }), "{error}");
}

#[test]
fn only_the_end_that_was_reached_is_executed() {
    let program = "#31=[1]\no1 if [#31 eq 2]\n  m30\no1 endif\ng55\nn7 M2 (done)\n";
    let Some(outcome) = run(program) else { return };
    assert_eq!(outcome.end, End::ProgramEnd);
    assert_eq!(outcome.steps.last().map(|step| step.block.line), Some(6));
    let shuttles = effects(&outcome).into_iter().filter(|(_, name)| name == "pallet_shuttle");
    assert_eq!(shuttles.count(), 0);
    assert_eq!(settings_at_end(&outcome).work_offset, Some(1));
}

#[test]
fn an_end_is_not_entered_where_an_error_stopped_the_program() {
    let long = format!("m2 ({})", "x".repeat(230));
    for end in ["m2", long.as_str()] {
        let Some(outcome) = run(&format!("g55\n#31=5\ng0 x1 x1\n{end}\n")) else { return };
        let End::Fault(fault) = &outcome.end else { panic!("accepted") };
        assert_eq!(fault.kind, Some(FaultKind::RepeatedWord));
        let parameters = outcome.parameters.expect("parameters at the end");
        assert_eq!(parameters.0.get(&31).map(|value| value.to_bits()), Some(5.0_f64.to_bits()));
        // G55 stays; an end would have brought back the first system.
        assert_eq!(parameters.0.get(&5220).map(|value| value.to_bits()), Some(2.0_f64.to_bits()));
    }
}

#[test]
fn an_end_that_is_refused_is_refused_where_it_stands() {
    let Some((kind, block)) = refusal("f5\ng80 x1 m2\n") else { return };
    assert_eq!(block, Some(BlockLocation::new("main.ngc", 2)));
    assert_eq!(kind, Some(FaultKind::AxisWords));
}

#[test]
fn long_end_has_its_state() {
    let Some(outcome) = run(&format!("g91\nm2 ({})\n", "x".repeat(230))) else { return };
    assert_eq!(outcome.end, End::ProgramEnd);
    assert_eq!(settings_at_end(&outcome).distance, Some(gaugeblock_vocabulary::Distance::Absolute));
}

#[test]
fn all_programs_run_unobserved_on_request() {
    let Some(mut controller) = controller() else { return };
    let scenario = Scenario::of("g20 f10\ng1 x1\nm2\n");
    let sampled = controller.run(&scenario);
    controller.check_observation();
    assert_eq!(sampled, controller.run(&scenario));
}

#[test]
fn programs_that_share_the_memory_of_hal_take_turns() {
    let Some(controller) = controller() else { return };
    let scenario = Scenario::of("#31=#<_ H A L [motion.on]>\nm2\n");
    let many = || (0..20).map(|_| controller.run(&scenario)).collect::<Vec<_>>();
    let runs: Vec<_> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..8).map(|_| scope.spawn(many)).collect();
        threads.into_iter().flat_map(|thread| thread.join().unwrap()).collect()
    });
    for run in runs {
        let end = run.map(|outcome| outcome.end);
        let Ok(End::Fault(fault)) = end else { panic!("{end:?}") };
        assert_eq!(fault.kind, Some(FaultKind::NoSuchParameter));
    }
}
