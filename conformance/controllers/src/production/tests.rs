//! What the adapter itself decides: the outside's answers, pauses, and bounds.

use gaugeblock_vocabulary::scenario::{Budget, InputChange, OrientAnswer, Start, UserProgram};
use gaugeblock_vocabulary::{Bound, End, Event, FaultKind, Options, Step};

use super::*;

fn outcome(scenario: &Scenario) -> Outcome {
    Production::default().run(scenario).expect("it runs")
}

/// The end of a run in a word: its name, or the kind of its fault.
fn ends(scenario: &Scenario) -> String {
    let end = outcome(scenario).end;
    let End::Fault(fault) = &end else { return end.name().to_owned() };
    fault.kind.map_or_else(String::new, |kind| kind.to_string())
}

#[test]
fn a_quirk_is_refused_by_name() {
    let quirk = Options([("rs274.feed-unit".to_owned(), "observed".to_owned())].into());
    let why = Production::default().accepts_options(&quirk).unwrap_err();
    assert!(why.contains("rs274.feed-unit"), "{why}");
    let documented = Options([("rs274.feed-unit".to_owned(), "documented".to_owned())].into());
    assert_eq!(Production::default().accepts_options(&documented), Ok(()));
}

#[test]
fn pause_without_resume_ends_the_run() {
    let run = outcome(&Scenario::of("m0\ng4 p1\nm2\n"));
    assert_eq!(run.end, End::Paused);
    assert!(run.steps.last().is_some_and(|step| step.block.line == 1 && step.state.is_none()));
    assert_eq!(ends(&Scenario::of("m1\nm2\n")), "program_end");
}

#[test]
fn a_bound_is_met_between_blocks() {
    let mut scenario = Scenario::of("o1 while [1]\ng4 p1\no1 endwhile\nm2\n");
    scenario.budget = Budget { steps: 7, ..Budget::default() };
    let run = outcome(&scenario);
    assert_eq!(run.end, End::BudgetExhausted { bound: Bound::Steps });
    assert_eq!(run.steps.len(), 7);
    scenario.budget = Budget { effects: 2, ..Budget::default() };
    assert_eq!(outcome(&scenario).end, End::BudgetExhausted { bound: Bound::Effects });
    scenario.budget = Budget { time: 3.0, ..Budget::default() };
    assert_eq!(outcome(&scenario).end, End::BudgetExhausted { bound: Bound::Time });
}

/// A compensated move, and what waits after it, are in the blocks that programmed them; what never came out is not.
#[test]
fn late_effects_are_at_their_places() {
    let names = |program: &str| -> Vec<Vec<String>> {
        let run = outcome(&Scenario::of(program));
        let names = |step: &Step| {
            let effects = step.events.iter().filter_map(|event| match event {
                Event::Do(effect) => Some(effect.name().to_owned()),
                Event::Set(_) | Event::Unknown(_) => None,
            });
            effects.collect()
        };
        run.steps.iter().map(names).collect()
    };
    let head = "g42.1 d2 f10\ng1 x5\ng4 p1 f20\nt0\nz1\n";
    let whole = names(&format!("{head}y5\ng40\nm2\n"));
    let expected: [&[&str]; 8] = [
        &[],
        &["straight_feed"],
        &["dwell"],
        &["prepare_tool"],
        &["straight_feed"],
        &["arc_feed", "straight_feed"],
        &[],
        &["controller_mode", "program_end"],
    ];
    assert_eq!(whole, expected);
    let lost = names(&format!("{head}g28\nm2\n"));
    let expected: [&[&str]; 5] = [&[], &[], &[], &["prepare_tool"], &[]];
    assert_eq!(lost, expected);
}

/// A sub that is called by hand has many blocks, and an entry is over where the bound is.
#[test]
fn a_bound_is_met_within_an_entry() {
    let by_hand = |body: &str, budget: Budget| {
        let file = format!("o<x> sub\n{body}\no<x> endsub\n");
        let mut scenario = Scenario::of("o<x> call\n");
        scenario.program.start = Start::Mdi;
        scenario.program.files.insert("x.ngc".to_owned(), file);
        scenario.budget = budget;
        outcome(&scenario)
    };
    let steps = Budget { steps: 100, ..Budget::default() };
    let run = by_hand("o1 while [1]\n#31=1\no1 endwhile", steps);
    assert_eq!((run.end, run.steps.len()), (End::BudgetExhausted { bound: Bound::Steps }, 100));
    let effects = Budget { effects: 1, ..Budget::default() };
    let run = by_hand("m64 p1 g0 x1", effects);
    assert_eq!(run.end, End::BudgetExhausted { bound: Bound::Effects });
}

/// A file that ends too early is no line without a block.
#[test]
fn an_entry_whose_file_has_no_end_is_refused() {
    let mut scenario = Scenario::of("o<x> call\n#32=6\n");
    scenario.program.start = Start::Mdi;
    scenario.program.files.insert("x.ngc".to_owned(), "o<x> sub\n#31=5\n".to_owned());
    assert_eq!(ends(&scenario), "missing_end");
}

/// However many strokes the interpreter executes at a time, and whatever the block did: the parameters are those
/// before it.
#[test]
fn a_block_with_more_effects_than_there_are_is_not_recorded() {
    let mut scenario = Scenario::of("f100 g0 x1\n#31=7 g73 q1 x9 z-60 r2\nm2\n");
    for effects in [3, 40, 120] {
        scenario.budget = Budget { effects, ..Budget::default() };
        let run = outcome(&scenario);
        assert_eq!(run.end, End::BudgetExhausted { bound: Bound::Effects });
        assert_eq!(run.steps.len(), 1, "{effects}");
        let parameters = run.parameters.expect("they are shown").0;
        assert!(parameters.get(&5420).is_some_and(|x| x.to_bits() == 1_f64.to_bits()), "{effects}");
        assert_eq!(parameters.get(&31), None, "{effects}");
    }
}

#[test]
fn inputs_answer_at_their_time() {
    let read = |program: &str, wires: &[(&str, u16)]| {
        let mut scenario = Scenario::of(program);
        scenario.environment.wires = wires.iter().map(|(a, b)| ((*a).to_owned(), *b)).collect();
        let change = |time, value| InputChange { time, input: "digital_in[0]".to_owned(), value };
        scenario.environment.inputs = vec![change(1.0, 1.0), change(2.0, 0.0)];
        let run = outcome(&scenario);
        let value = run.parameters.expect("they are shown").0.get(&5399).copied();
        (run.end.name(), value.unwrap_or_default())
    };
    assert_eq!(read("m66 p0 l0\nm2\n", &[]), ("program_end", 0.0));
    assert_eq!(read("m66 p0 l3 q1\nm2\n", &[]), ("program_end", 1.0));
    assert_eq!(read("m66 p0 l3 q0.5\nm2\n", &[]), ("program_end", -1.0));
    assert_eq!(read("g4 p1.5\nm66 p0 l2 q1\nm2\n", &[]), ("program_end", 0.0));
    assert_eq!(read("g4 p1.5\nm66 p0 l1 q9\nm2\n", &[]), ("program_end", -1.0));
    assert_eq!(read("m64 p2\nm66 p1 l0\nm2\n", &[("2", 1)]), ("program_end", 1.0));
    assert_eq!(read("m62 p2\nm66 p1 l0\nm2\n", &[("2", 1)]), ("program_end", 0.0));
    assert_eq!(read("m62 p2\ng0 x1\nm66 p1 l0\nm2\n", &[("2", 1)]), ("program_end", 1.0));
}

#[test]
fn a_wait_without_end_uses_up_the_time() {
    let mut scenario = Scenario::of("g4 p1\nm66 p0 l3\nm2\n");
    scenario.options.0.insert("inputs.without-timeout".to_owned(), "accepted".to_owned());
    let run = outcome(&scenario);
    assert_eq!(run.end, End::BudgetExhausted { bound: Bound::Time });
    assert_eq!(run.steps.len(), 1);
}

#[test]
fn encoders_answer() {
    let orients = |answer| {
        let mut scenario = Scenario::of("m19 r90 q0.5\nm2\n");
        scenario.environment.orient = vec![answer];
        ends(&scenario)
    };
    assert_eq!(orients(OrientAnswer::After(0.5)), "program_end");
    for answer in [OrientAnswer::After(0.6), OrientAnswer::Never, OrientAnswer::Fault(3)] {
        assert_eq!(orients(answer), FaultKind::Orient.to_string());
    }
}

#[test]
fn user_programs_are_data() {
    let calls = |program: UserProgram| {
        let mut scenario = Scenario::of("m101\nm2\n");
        scenario.environment.user_programs = vec![program];
        ends(&scenario)
    };
    let named = |file: &str| UserProgram { file: file.to_owned(), ..UserProgram::default() };
    assert_eq!(calls(named("M101")), "program_end");
    assert_eq!(calls(named("m101")), FaultKind::UnknownCode.to_string());
    let failing = UserProgram { exit_status: 3, ..named("M101") };
    assert_eq!(calls(failing), FaultKind::UserCode.to_string());
    let text = UserProgram { executable: false, ..named("M101") };
    assert_eq!(calls(text), FaultKind::UnknownCode.to_string());
}
