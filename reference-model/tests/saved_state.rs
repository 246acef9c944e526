//! A restore brings back every setting of the saved state, whatever was set since.

use gaugeblock_reference::run;
use gaugeblock_vocabulary::{
    End, Event, Machine, Motion, Options, Outcome, PathControlMode, Scenario, Settings, State,
    Value,
};
use proptest::prelude::{Just, ProptestConfig, Strategy, any, proptest};
use proptest::{collection, prop_oneof};

/// A machine with several spindles and a coordinate system that is not at its origin.
fn machine() -> Machine {
    let parameters = [(5241, 10.0), (5250, 30.0)].into_iter().collect();
    Machine { spindles: 3, parameters, ..Machine::default() }
}

fn scenario(program: String, options: &[(&str, &str)]) -> Scenario {
    let options =
        options.iter().map(|(id, option)| ((*id).to_owned(), (*option).to_owned())).collect();
    Scenario { machine: machine(), options: Options(options), ..Scenario::of(program) }
}

/// Settings after the last execution of a block of the main program.
fn settings_after(outcome: &Outcome, line: u32) -> Settings {
    let last = outcome.steps.iter().rposition(|step| step.block.line == line);
    let last = last.unwrap_or_else(|| panic!("block {line} was not executed: {:?}", outcome.end));
    let mut settings = outcome.start.clone();
    for event in outcome.steps[..=last].iter().flat_map(|step| &step.events) {
        if let Event::Set(change) = event {
            settings.overlay(change);
        }
    }
    settings
}

/// The settings without the tolerances of G64 in another mode, numbers rounded so far that units changed there and
/// back make no difference.
fn shown(settings: &Settings) -> Vec<String> {
    let entries = settings.entries();
    let continuous = settings.path == Some(PathControlMode::Continuous);
    entries
        .iter()
        .filter(|entry| continuous || !entry.field.ends_with("tolerance"))
        .map(|entry| match &entry.value {
            Value::Number(number) => format!("{} {number:.6}", entry.name()),
            Value::Position(position) => {
                let numbers = position.to_array().map(|number| format!("{:.6}", number + 0.0));
                format!("{} {}", entry.name(), numbers.join(" "))
            }
            Value::Word(word) | Value::Text(word) => format!("{} {word}", entry.name()),
        })
        .collect()
}

/// A block that sets something that belongs to the saved state.
fn block() -> impl Strategy<Value = String> {
    let number = (1_u32..1000).prop_map(|tenths| f64::from(tenths) / 10.0);
    let spindle = 0..3;
    prop_oneof![
        Just("g20").prop_map(str::to_owned),
        Just("g21").prop_map(str::to_owned),
        proptest::sample::select(vec![
            "g17",
            "g18",
            "g19",
            "g17.1",
            "g18.1",
            "g19.1",
            "g90",
            "g91",
            "g90.1",
            "g91.1",
            "g7",
            "g8",
            "g98",
            "g99",
            "g61",
            "g61.1",
            "g64",
            "g54",
            "g55",
            "g59.3",
            "g49",
            "g40",
            "m7",
            "m8",
            "m9",
            "m48",
            "m49",
            "m50",
            "m50 p0",
            "m51",
            "m51 p0 $1",
            "m52",
            "m52 p0",
            "m53",
            "m53 p0",
            "m3",
            "m4 $1",
            "m5 $2",
            "m5",
        ])
        .prop_map(str::to_owned),
        number.clone().prop_map(|rate| format!("f{rate}")),
        number.clone().prop_map(|rate| format!("g95 f{rate}")),
        number.clone().prop_map(|rate| format!("g94 f{rate}")),
        number.clone().prop_map(|tolerance| format!("g64 p{tolerance} q1")),
        number.clone().prop_map(|offset| format!("g43.1 z{offset}")),
        (number.clone(), spindle.clone())
            .prop_map(|(speed, spindle)| format!("s{speed} ${spindle}")),
        (number.clone(), spindle.clone())
            .prop_map(|(speed, spindle)| format!("g97 s{speed} ${spindle}")),
        (number, spindle, any::<bool>()).prop_map(|(speed, spindle, limit)| {
            format!("g96 s{speed} ${spindle}{}", if limit { " d500" } else { "" })
        }),
    ]
}

fn blocks() -> impl Strategy<Value = Vec<String>> {
    collection::vec(block(), 0..12)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn an_explicit_restore_brings_back_every_setting(before in blocks(), since in blocks()) {
        let program = format!("{}\nm70\n{}\nm72\nm2\n", before.join("\n"), since.join("\n"));
        let lines = program.lines();
        let find = |code| (1..).zip(lines.clone()).find(|(_, line)| *line == code).map(|(line, _)| line);
        let (save, restore) = (find("m70").expect("it is there"), find("m72").expect("it is there"));
        let (outcome, _) = run(&scenario(program, &[]));
        assert_eq!(outcome.end, End::ProgramEnd);
        let saved = settings_after(&outcome, save);
        let restored = settings_after(&outcome, restore);
        assert_eq!(shown(&saved), shown(&restored));
    }

    #[test]
    fn the_end_of_a_sub_brings_back_every_setting(before in blocks(), since in blocks()) {
        let sub = format!("o1 sub\nm73\n{}\no1 endsub\n", since.join("\n"));
        let program = format!("{sub}{}\n#31=1\no1 call\n#32=1\nm2\n", before.join("\n"));
        let lines = program.lines();
        let find = |code| (1..).zip(lines.clone()).find(|(_, line)| *line == code).map(|(line, _)| line);
        let (call, after) = (find("#31=1").expect("it is there"), find("#32=1").expect("it is there"));
        let (outcome, _) = run(&scenario(program, &[]));
        assert_eq!(outcome.end, End::ProgramEnd);
        assert_eq!(shown(&settings_after(&outcome, call)), shown(&settings_after(&outcome, after)));
    }
}

/// The motion mode after a block.
fn motion_after(outcome: &Outcome, line: u32) -> Option<Motion> {
    let steps = outcome.steps.iter().take_while(|step| step.block.line <= line);
    let states = steps.filter_map(|step| match &step.state {
        Some(State::Rs274(state)) => state.motion,
        Some(State::Nct(_) | State::Gpp(_)) | None => None,
    });
    states.last()
}

#[test]
fn the_draft_restores_the_motion_modes_that_it_lists() {
    let program = |saved: &str, since: &str| format!("f100\n{saved}\nm70\n{since}\nm72\nm2\n");
    let restored = ("saved-state.motion-mode", "restored");
    let every = ("saved-state.listed-motion", "every");
    for (saved, since, options, expected) in [
        ("g1", "g0", vec![], Motion::Traverse),
        ("g1", "g0", vec![restored], Motion::Feed),
        ("g80", "g0", vec![restored], Motion::None),
        ("g0", "g1", vec![restored], Motion::Feed),
        ("g0", "g1", vec![restored, every], Motion::Traverse),
    ] {
        let (outcome, _) = run(&scenario(program(saved, since), &options));
        assert_eq!(motion_after(&outcome, 5), Some(expected), "{saved} {options:?}");
    }
}

#[test]
fn a_restored_unit_leaves_the_machine_where_it_is() {
    let program = "g21\ng0 x25.4\nm70\ng20 g55\nm72\nm2\n".to_owned();
    let (outcome, _) = run(&scenario(program, &[]));
    let positions: Vec<_> = outcome
        .steps
        .iter()
        .filter_map(|step| match &step.state {
            Some(State::Rs274(state)) => state.position,
            Some(State::Nct(_) | State::Gpp(_)) | None => None,
        })
        .collect();
    let last = positions.last().expect("the restore changed the position").to_array();
    assert!((last[0] - 25.4).abs() < 1e-9 && last[1].abs() < 1e-9, "{last:?}");
}
