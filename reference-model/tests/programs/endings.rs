//! How runs end.

use gaugeblock_reference::run;
use gaugeblock_vocabulary::scenario::{Action, OperatorEvent, RunPoint, Start};
use gaugeblock_vocabulary::{BlockLocation, ControllerMode, Program, Scenario};

use super::{ending, gives, outcome, outcome_under, parameter, refuses};

#[test]
fn a_program_ends_once() {
    gives("#31 = 1\nm2\n#31 = 2\nno block ?!\n", &[(31, 1.0)]);
    gives("o1 sub\n#31 = 1\nm2\n#31 = 2\no1 endsub\no1 call\n", &[(31, 1.0)]);
}

#[test]
fn a_file_ends_by_a_program_end_or_between_percent_signs() {
    assert_eq!(ending(&outcome("%\n#31 = 1\n%\n#31 = 2\n")), "percent_end");
    refuses("#31 = 1\n", "missing_end at main.ngc:2");
    refuses("", "missing_end at main.ngc:1");
    refuses("%\n#31 = 1\n", "missing_end at main.ngc:3");
    gives("%\n#31 = 1\nm2\n", &[(31, 1.0)]);
}

#[test]
fn a_budget_ends_what_does_not_end() {
    assert_eq!(ending(&outcome("o1 while [1]\no1 endwhile\nm2\n")), "budget of steps");
    let mut scenario = Scenario::of("o1 while [1]\ng4 p1\no1 endwhile\nm2\n");
    scenario.budget.time = 10.0;
    assert_eq!(ending(&run(&scenario).0), "budget of time");
    scenario.budget.effects = 5;
    assert_eq!(ending(&run(&scenario).0), "budget of effects");
}

#[test]
fn repeats_of_a_cycle_are_bounded_by_the_budget_alone() {
    for repeats in ["2147483648", "4294967296", "1000000000000000000000"] {
        let cycle = outcome(&format!("g81 x1 z-1 r1 l{repeats} f1\nm2\n"));
        assert_eq!(ending(&cycle), "budget of effects");
    }
    refuses("g81 x1 z-1 r1 l-2147483649 f1\nm2\n", "word_out_of_range at main.ngc:1");
}

/// What is finite in the end does not overflow on the way there.
#[test]
fn an_arc_has_a_centre_and_a_radius_that_are_numbers() {
    let zeros = "0".repeat(155);
    gives(&format!("g2 x1 i1{zeros} f1\nm2\n"), &[(5420, 1.0)]);
    let zeros = "0".repeat(200);
    gives(&format!("g2 x1 y1 r1{zeros} f1\nm2\n"), &[(5420, 1.0), (5421, 1.0)]);
    let zeros = "0".repeat(154);
    let far = format!("#1=1{zeros} #1=[#1*#1] #2=1.7 #3=[#1*#2]\n");
    let far = far.replace(" #", "\n#");
    gives(&format!("{far}f1 g0 x-#1\ng2 x#1 r#3\nm2\n"), &[]);
    for arc in ["g2 y1 i#3", "g2 y#3 i#3 j#3", "g90.1 g2 x1 i-#3 j0", "g91 g2 x#3 r#3"] {
        refuses(&format!("{far}f1 g0 x#3\n{arc}\nm2\n"), "bad_arc at main.ngc:6");
    }
    let options = [("arcs.radius-just-too-small", "half-circle")];
    let ending = |program| ending(&outcome_under(&options, program));
    assert_eq!(ending("g2 x0.001 r0.0001 f1\nm2\n"), "program_end");
    assert_eq!(ending("g2 x0.001 r0 f1\nm2\n"), "bad_arc at main.ngc:1");
}

#[test]
fn a_short_run_is_a_prefix_of_a_longer_one() {
    let mut scenario = Scenario::of("o1 while [1]\n#31 = [#31 + 1]\ng0 x#31\no1 endwhile\nm2\n");
    scenario.budget.steps = 50;
    let short = run(&scenario).0;
    scenario.budget.steps = 90;
    let long = run(&scenario).0;
    assert_eq!(short.steps.len(), 50);
    assert_eq!(short.steps[..], long.steps[..50]);
}

/// The system, the tool and the point are those before it, with an operator too; only a probe that finds nothing has
/// made its way.
#[test]
fn a_refused_block_has_done_nothing() {
    let before = [(5220, 1.0), (5400, 0.0), (5420, 7.0)];
    let last = "f100 g90 g0 x7\nt1 m6 g55 g2 x1 i9\nm2\n";
    let probe = "f100 g90 g0 x1\ng38.2 x5\nm2\n";
    let event = OperatorEvent {
        when: RunPoint { block: BlockLocation::new(Program::MAIN, 1), execution: 1, offset: 0.0 },
        action: Action::Mode(ControllerMode::Auto),
    };
    for operator in [vec![], vec![event]] {
        let run = |text| run(&Scenario { operator: operator.clone(), ..Scenario::of(text) }).0;
        let refused = run(last);
        assert_eq!(ending(&refused), "bad_arc at main.ngc:2");
        for (number, value) in before {
            assert_eq!(parameter(&refused, number).to_bits(), f64::to_bits(value), "#{number}");
        }
        let failed = run(probe);
        assert_eq!(ending(&failed), "probe at main.ngc:2");
        assert!((parameter(&failed, 5061) - 5.0).abs() < 1e-9);
    }
}

#[test]
fn a_block_with_more_effects_than_the_budget_has_is_not_recorded() {
    let mut scenario = Scenario::of("f100 g0 x1\n#31=7 g73 q1 x9 z-60 r2\nm2\n");
    for effects in [3, 40, 120] {
        scenario.budget.effects = effects;
        let outcome = run(&scenario).0;
        assert_eq!(ending(&outcome), "budget of effects");
        assert_eq!(outcome.steps.len(), 1);
        assert_eq!((parameter(&outcome, 5420), parameter(&outcome, 31)), (1.0, 0.0));
    }
}

#[test]
fn an_option_that_nobody_knows_ends_the_run_before_it_begins() {
    for options in [
        [("control.colour", "red")],
        [("control.ended-label", "red")],
        [("rs274.nine-levels", "red")],
    ] {
        let outcome = outcome_under(&options, "m2\n");
        assert_eq!(ending(&outcome), "unsupported at main.ngc:1");
        assert!(outcome.steps.is_empty());
    }
}

#[test]
fn nobody_says_whose_p_it_is_when_two_codes_use_it() {
    for program in ["g64 g4 p1\nm2\n", "g4 p1 m50\nm2\n", "g10 l2 p1 x1 g64\nm2\n"] {
        assert_eq!(ending(&outcome(program)), "unspecified at main.ngc:1", "{program}");
    }
    refuses("g64 g4 p1 q0.1 h1\nm2\n", "unused_word at main.ngc:1");
}

#[test]
fn a_row_of_cycles_over_another_plane_has_no_initial_level() {
    let row = "f1 g0 z1\ng81 z0 r0\ng18 y0 r0\ng98 x0\nm2\n";
    assert_eq!(ending(&outcome(row)), "unspecified at main.ngc:4");
    let back = "f1 g0 z1\ng81 z0 r0\ng18 y0 r0\ng17 g98 z0 r0\nm2\n";
    assert_eq!(ending(&outcome(back)), "program_end");
}

/// On a clock that is not at zero the sum of both times is rounded.
#[test]
fn a_spindle_that_comes_to_its_angle_in_the_last_moment_is_in_time() {
    let mut scenario = Scenario::of("g4 p2\nm19 r0 q0.2\nm2\n");
    scenario.environment.orient = vec![gaugeblock_vocabulary::scenario::OrientAnswer::After(0.2)];
    assert_eq!(ending(&run(&scenario).0), "program_end");
}

/// What a program has defined is its own; that of a file is there for everybody.
#[test]
fn whether_the_subs_of_an_ended_program_can_be_called_by_hand_is_left_open() {
    let program = "o9 sub\n#31=[#31+1]\no9 endsub\no9 call\nm2\no8 sub\no8 endsub\n";
    let ending = |by_hand: &str| {
        let mut scenario = Scenario::of(program);
        let file = |body: &str| format!("o<cave> sub\n{body}\no<cave> endsub\n");
        let files = &mut scenario.program.files;
        files.insert("cave.ngc".to_owned(), file("#31=7"));
        files.insert("den.ngc".to_owned(), file("o9 call").replace("cave", "den"));
        let when =
            RunPoint { block: BlockLocation::new(Program::MAIN, 5), execution: 1, offset: 1.0 };
        let action = Action::Mdi(by_hand.to_owned());
        scenario.operator.push(OperatorEvent { when, action });
        ending(&run(&scenario).0)
    };
    assert_eq!(ending("o9 call"), "unspecified at mdi:1");
    assert_eq!(ending("o<den> call"), "unspecified at den.ngc:2");
    assert_eq!(ending("o<cave> call"), "program_end");
    assert_eq!(ending("o8 call"), "unknown_sub at mdi:1");
    assert_eq!(ending("#32=[100/#31]"), "program_end");
}

/// Of a word that is missing the block alone tells, before it waits; of other faults nobody says whether it waits
/// before.
#[test]
fn a_block_without_a_word_that_it_needs_waits_for_nothing() {
    let options = [("inputs.without-timeout", "accepted")];
    let ending = |code: &str| {
        let program = format!("m66 p0 l1 {code}\nm2\n");
        ending(&outcome_under(&options, &program))
    };
    for code in ["g43.1", "g52", "g92"] {
        assert_eq!(ending(code), "missing_word at main.ngc:1", "{code}");
    }
    assert_eq!(ending("g43.1 x1"), "budget of time");
    for code in ["g43.2", "m61", "m19", "g38.2", "g28.1 x1", "x1"] {
        assert_eq!(ending(code), "unspecified at main.ngc:1", "{code}");
    }
    refuses("m6 g4\nm2\n", "missing_word at main.ngc:1");
}

#[test]
fn what_the_operator_may_not_ask_for_now_is_left_open() {
    let ending = |start, asked: &[(f64, Action)]| {
        let event = |(offset, action): &(f64, Action)| OperatorEvent {
            when: RunPoint {
                block: BlockLocation::new(Program::MAIN, 1),
                execution: 1,
                offset: *offset,
            },
            action: action.clone(),
        };
        let mut scenario = Scenario::of("g4 p1\nm2\n");
        scenario.program.start = start;
        scenario.operator = asked.iter().map(event).collect();
        ending(&run(&scenario).0)
    };
    let open = "unspecified at main.ngc:1";
    let paused = [(0.2, Action::Pause), (0.4, Action::CycleStart)];
    assert_eq!(ending(Start::Program, &paused), open);
    assert_eq!(ending(Start::Program, &paused[1..]), open);
    for mode in [ControllerMode::Mdi, ControllerMode::Manual] {
        assert_eq!(ending(Start::Mdi, &[(0.5, Action::Mode(mode))]), open);
    }
    assert_eq!(ending(Start::Mdi, &[(0.5, Action::Resume)]), open);
    assert_eq!(ending(Start::Program, &[(0.5, Action::Resume)]), "program_end");
    assert_eq!(ending(Start::Program, &[(0.5, Action::Mode(ControllerMode::Auto))]), "program_end");
}

#[test]
fn a_percent_sign_that_the_operator_enters_is_left_open() {
    let mut scenario = Scenario::of("m2\n");
    scenario.operator = vec![OperatorEvent {
        when: RunPoint { block: BlockLocation::new(Program::MAIN, 1), execution: 1, offset: 0.1 },
        action: Action::Mdi("%".to_owned()),
    }];
    let ending = ending(&run(&scenario).0);
    assert!(ending.starts_with("unspecified"), "{ending}");
}
