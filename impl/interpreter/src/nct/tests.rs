//! What the executor itself decides: ends of hostile programs in bounded memory, what a sink hears, and that no text
//! makes it panic.

extern crate std;

use alloc::string::String;
use alloc::vec::Vec;

use gaugeblock_vocabulary::{Effect, FaultKind, Options, Settings};
use proptest::prelude::*;

use super::*;
use crate::canon::Reply;

/// What a sink has heard.
#[derive(Debug, Default)]
struct Recorder {
    heard: Vec<String>,
    /// Local variables of the main program, as they were told last.
    main: std::collections::BTreeMap<u32, Option<u64>>,
    level: u32,
    steps: u32,
    /// That of the last arc.
    centre: Option<(f64, f64)>,
}

impl Sink for Recorder {
    fn set(&mut self, line: u32, changed: &Settings) {
        self.heard.push(alloc::format!("{line} set {:?}", changed.feed_rate));
    }

    fn perform(&mut self, line: u32, effect: &Effect) -> Reply {
        self.heard.push(alloc::format!("{line} {}", effect.name()));
        if let Effect::ArcFeed { first_centre, second_centre, .. } = effect {
            self.centre = Some((*first_centre, *second_centre));
        }
        Reply::Done
    }

    fn end_macro_step(&mut self, done: &MacroStep<'_>) {
        self.steps += 1;
        self.level = done.level();
        for change in done.variables().filter(|change| change.level == Some(0)) {
            self.main.insert(change.number, change.value.map(f64::to_bits));
        }
    }
}

const AXES: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

/// What a run tells, and how it ends within so many steps.
fn run(text: &str, most: u32) -> (Recorder, Option<End>) {
    let mut recorder = Recorder::default();
    let mut run = CustomMacros::new(text, &AXES, false, &Options::default()).unwrap();
    for _ in 0..most {
        if let Err(end) = run.step(&mut recorder) {
            assert_eq!(run.step(&mut recorder), Err(end.clone()), "an end is told again");
            return (recorder, Some(*end));
        }
    }
    (recorder, None)
}

fn kind(end: Option<End>) -> Option<FaultKind> {
    match end {
        Some(End::Fault(fault)) => fault.kind,
        _ => None,
    }
}

#[test]
fn sink_receives_only_complete_blocks() {
    let (recorder, end) = run("O1\nT5 M6 G1 X1 F100\nT6 M6 G4 P-1\nM30\n", 10);
    assert_eq!(kind(end), Some(FaultKind::WordOutOfRange));
    let heard = ["2 set Some(100.0)", "2 prepare_tool", "2 change_tool", "2 straight_feed"];
    assert_eq!(recorder.heard, heard);
}

#[test]
fn endless_program_can_be_left_after_any_step() {
    for text in [
        "O1\nN1 GOTO1\n",
        "O1\nWHILE [1 EQ 1] DO1\nEND1\n",
        "O1\nN1 G65 P2 L9999\nGOTO1\nO2\nM99\n",
        "O1\nN1 M99 P1\n",
        "O1\nG66 P2\nG67\nM98 P3 L9999\nM99 P5\nO2\nM99\nO3\n#1 = #1 + 1\nM99\n",
    ] {
        assert_eq!(run(text, 9_000).1, None, "{text}");
    }
}

#[test]
fn the_number_of_a_loop_may_begin_with_zeros() {
    let (_, end) = run("O1\nWHILE[1EQ2]DO000000001\nEND01\nM30\n", 10);
    assert_eq!(end, Some(End::ProgramEnd));
    for number in ["0", "04", "", "1.", "#1"] {
        let (_, end) = run(&alloc::format!("O1\nWHILE[1EQ2]DO{number}\nEND1\nM30\n"), 10);
        assert!(matches!(end, Some(End::Fault(_))), "{number}: {end:?}");
    }
}

/// Where an arc's centre is, or why there is none.
fn centre(blocks: &str) -> Result<(f64, f64), Option<FaultKind>> {
    let mut recorder = Recorder::default();
    let text = alloc::format!("O1\nF1\n{blocks}\nM30\n");
    let mut run = CustomMacros::new(&text, &AXES, false, &Options::default()).unwrap();
    loop {
        if let Err(end) = run.step(&mut recorder) {
            return recorder.centre.ok_or(kind(Some(*end)));
        }
    }
}

#[test]
fn arcs_of_any_size_have_a_centre() {
    let near = |blocks: &str, wanted: (f64, f64)| {
        let found = centre(blocks).unwrap();
        let is_near =
            |found: f64, wanted: f64| (found - wanted).abs() <= 1e-9 * wanted.abs().max(1.0);
        assert!(is_near(found.0, wanted.0) && is_near(found.1, wanted.1), "{blocks}: {found:?}");
    };
    near("G2X3Y4R2.5", (1.5, 2.0));
    near("G2X23.7Y10.4R12.940730273056461", (11.85, 5.2));
    near("G2X2R0.9999999995", (1.0, 0.0));
    near("G2X200000R100000.0000001", (100_000.0, -0.141_421_894_662));
    near("#1=EXP[-500]\nG2X#1R1", (0.0, -1.0));
    near("#1=EXP[709]\nG0X-#1\nG2X#1R#1", (0.0, 0.0));
    near("#1=EXP[500]\nG2X1R#1", (0.5, -1.403_592_217_852_837_4e217));
    near("#1=EXP[500]\nG2X1I#1", (1.403_592_217_852_837_4e217, 0.0));
}

#[test]
fn an_arc_without_a_centre_is_refused() {
    for blocks in [
        "G2X2R0.999999998",
        "#1=EXP[709.5]\nG0X#1\nG2X0I#1",
        "#1=EXP[709.5]\n#2=EXP[709.7]\nG0X#1\nG2Y#1R#2",
        "#1=EXP[709.7]\nG2X1I#1J#1",
    ] {
        assert_eq!(centre(blocks), Err(Some(FaultKind::BadArc)), "{blocks}");
    }
}

#[test]
fn a_unit_in_which_the_position_is_too_large_is_refused() {
    let far = "O1\n#1=EXP[709]\nG0X#1G20\nX#1\nG21\nY1\nM30\n";
    let (recorder, end) = run(far, 10);
    assert_eq!(kind(end), Some(FaultKind::OutOfDomain));
    assert_eq!(recorder.heard.last().unwrap(), "4 straight_traverse");
    assert_eq!(run(&far.replace("709", "700"), 10).1, Some(End::ProgramEnd));
}

#[test]
fn angles_in_radians_are_of_any_size() {
    let options = Options([("nct.angles".into(), "radians".into())].into_iter().collect());
    for angle in ["TAN[EXP[708.3]]", "SIN[-EXP[709]]", "COS[EXP[709.7]]"] {
        let text = alloc::format!("O1\n#1={angle}\nM30\n");
        let mut run = CustomMacros::new(&text, &AXES, false, &options).unwrap();
        let mut recorder = Recorder::default();
        let end = loop {
            if let Err(end) = run.step(&mut recorder) {
                break *end;
            }
        };
        assert_eq!(end, End::ProgramEnd, "{angle}");
    }
}

#[test]
fn calls_within_calls_have_an_end() {
    for text in [
        "O1\nG65 P1\n",
        "O1\nM98 P1\n",
        "O1\nG65 P2\nM30\nO2\nM98 P3\nM99\nO3\nM98 P2\nM99\n",
        "O1\nG66 P2\nG66 P3\nG66 P4\nG66 P5\nG66 P6\nG0 X1\nM30\nO2\nX2\nM99\nO3\nX3\nM99\nO4\nX4\nM99\nO5\nX5\nM99\nO6\nX6\nM99\n",
    ] {
        assert_eq!(kind(run(text, 1_000).1), Some(FaultKind::TooManyLevels), "{text}");
    }
}

#[test]
fn a_jump_takes_no_longer_in_a_long_program() {
    // Loops within loops, none of which is entered, and a jump past all of them, 100,000 times: a search would take
    // minutes.
    let mut text = String::from("O1\nN1 GOTO2\n");
    for number in 10..30_000 {
        text.push_str(&alloc::format!("N{number} WHILE [1 EQ 2] DO{}\n", number % 3 + 1));
    }
    for number in (10..30_000).rev() {
        text.push_str(&alloc::format!("END{}\n", number % 3 + 1));
    }
    text.push_str("N2 GOTO1\n");
    assert_eq!(run(&text, 100_000).1, None);
}

#[test]
fn in_steady_state_nothing_is_allocated() {
    let text = "O1\nG66 P2 A1\nN1 G1 X[#1 + 1] F100\nG65 P3 I1 J2 K3 L2\nGOTO1\nO2\n#2 = SIN[#1] * 2\nM99\nO3\n#100 = #4\nM99\n";
    let mut run = CustomMacros::new(text, &AXES, false, &Options::default()).unwrap();
    struct Deaf;
    impl Sink for Deaf {
        fn set(&mut self, _line: u32, _changed: &Settings) {}
        fn perform(&mut self, _line: u32, _effect: &Effect) -> Reply {
            Reply::Done
        }
    }
    for _ in 0..100 {
        run.step(&mut Deaf).unwrap();
    }
    let allocated = allocation_counter::measure(|| {
        for _ in 0..1_000 {
            run.step(&mut Deaf).unwrap();
        }
    });
    assert_eq!(allocated.count_total, 0);
}

/// A block of any kind, which may be refused.
const BLOCK: &str = concat!(
    r"N[1-4]|O[1-3]|G6[5-7](\.1)? P[1-3]( L[0-3])?( A#1 I2 I3)?|G[0-3] X#1 [IJKR]-?[0-9]|",
    r"#[0-9]{1,3} = (#[0-9]|[0-9.]{1,3}) (AND|/|MOD|\*) -?[0-9.]{1,3}|IF \[#1 (EQ|GE) #2\] GOTO[1-4]|",
    r"WHILE \[#1 LT [0-9]\] DO[1-3]|END[1-3]|M(2|98 P2|99|99 P[1-3])|G(20|21|91|90|18) X1|#\[#1\] = 1",
);

/// A block of a macro that sets variables, or calls.
fn any_block() -> impl Strategy<Value = String> {
    let value = proptest::sample::select(&["#0", "-1.5", "#7", "#[#1 * 0 + 12]", "0", "1 / 3"][..]);
    prop_oneof![
        4 => (1_u32..=33, value).prop_map(|(number, value)| alloc::format!("#{number} = {value}")),
        1 => Just(String::from("G65 P3 A1 I2 I3 Z4")),
        1 => Just(String::from("G1 X1")),
        1 => Just(String::from("M98 P4")),
        1 => Just(String::from("G0 X#5 Y#33")),
    ]
}

proptest! {
    #[test]
    fn any_macro_leaves_its_caller_what_it_had(
        own in proptest::collection::vec(any_block(), 0..12),
        body in proptest::collection::vec(any_block(), 0..30),
        call in proptest::sample::select(&["G65 P2 B5 L3", "G65 P2", "G66 P2\nG1 X5", "G66.1 P2\nX5 A7"][..]),
    ) {
        let own: Vec<_> = own.into_iter().filter(|block| block.starts_with('#')).collect();
        let program = |calls: &str| alloc::format!(
            "O1\nG1 F100\n{}\n{calls}\nM30\nO2\n{}\nM99\nO3\n#4 = 9\n#33 = #0\nM99\nO4\n#2 = 5\nM99\n",
            own.join("\n"), body.join("\n")
        );
        let (before, end) = run(&program(""), 1_000);
        prop_assert_eq!(end, Some(End::ProgramEnd));
        let (after, end) = run(&program(call), 10_000);
        // A call within a macro may be open; then it is still in progress.
        if end == Some(End::ProgramEnd) {
            prop_assert_eq!(before.main, after.main);
            prop_assert_eq!(after.level, 0);
        }
    }

    #[test]
    fn no_text_makes_it_panic(text in "[OGNMXIJRPLFA#0-9.\\-+*/=\\[\\]()% \n]{0,200}") {
        run(&text, 200);
    }

    #[test]
    fn no_blocks_make_it_panic(
        blocks in proptest::collection::vec(BLOCK, 0..40),
        block_delete: bool,
    ) {
        let text = blocks.join("\n");
        let mut run = CustomMacros::new(&text, &AXES, block_delete, &Options::default()).unwrap();
        let mut recorder = Recorder::default();
        for _ in 0..300 {
            if run.step(&mut recorder).is_err() {
                break;
            }
        }
    }
}
