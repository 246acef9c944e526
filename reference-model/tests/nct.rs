//! NCT custom macros: what stays open, what holds for any macro, and hostile programs.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use gaugeblock_reference::run;
use gaugeblock_vocabulary::scenario::Budget;
use gaugeblock_vocabulary::{
    Effect, End, Event, FaultKind, Language, MacroValue, Options, Outcome, Scenario, State,
};
use proptest::prelude::{ProptestConfig, Strategy, proptest};
use proptest::{collection, option};

/// Programs about which the documents at hand say nothing, and no choice does.
const OPEN: &[(&str, &str)] = &[
    ("vacant-comparison: a number less than zero", "O1\nIF [#1 GT -1] GOTO5\n#100 = 1\nN5\nM30"),
    ("vacant-comparison: LT", "O1\nIF [#1 LT 0] GOTO5\n#100 = 1\nN5\nM30"),
    ("vacant-comparison: LE", "O1\nIF [#1 LE #0] GOTO5\n#100 = 1\nN5\nM30"),
    ("goto: a number twice", "O1\nGOTO10\nN10\nN10\nM30"),
    ("loops: into it", "O1\nGOTO10\nWHILE [1 EQ 2] DO1\nN10\nEND1\nM30"),
    ("statement-form: IF with THEN", "O1\nIF [1 EQ 1] THEN #1 = 2\nM30"),
    ("statement-form: DO without WHILE", "O1\nDO1\nEND1\nM30"),
    ("modes: the feed of another unit", "O1\nG21 G1 X1 F100\nG20 X2\nM30"),
    ("modes: a code that this edition does not hold", "O1\nG81 X1\nM30"),
    ("motion: before any code", "O1\nX1\nM30"),
    ("motion: without a feed", "O1\nG1 X1\nM30"),
    ("arc: two radii", "O1\nG2 X5 I1 F100\nM30"),
    ("open: G66 and G66.1", "O1\nG66 P2\nG66.1 P2\nM30\nO2\nM99"),
    ("open: G66 in a modal macro", "O1\nG66 P2\nG1 X1 F100\nM30\nO2\nG66 P2\nM99"),
    ("open: G67 in a modal macro", "O1\nG66 P2\nG1 X1 F100\nM30\nO2\nG67\nM99"),
    ("open: motion in a macro of G65", "O1\nG66 P2\nG65 P3\nM30\nO2\nM99\nO3\nG1 X1 F100\nM99"),
    ("open: motion and M98", "O1\nG66 P2\nG1 X1 F100 M98 P2\nM30\nO2\nM99"),
    ("open: a modal call that outlives its program", "O1\nM98 P2\nM30\nO2\nG66 P3\nM99\nO3\nM99"),
    ("open: an argument twice", "O1\nG65 P2 A1 A2\nM30\nO2\nM99"),
    ("open: a program twice", "O1\nG65 P2\nM30\nO2\nM99\nO2\nM99"),
    ("open: arguments of G66.1", "O1\nG66.1 P2 A1\nM30\nO2\nM99"),
    ("open: M30 as arguments", "O1\nG66.1 P2\nM30\nO2\nM99"),
    ("open: the number of a variable", "O1\n#[1.5] = 1\nM30"),
    ("open: G67 with a motion", "O1\nG66 P2\nG67 X1\nM30\nO2\nM99"),
];

fn outcome(program: &str) -> Outcome {
    outcome_under(program, &[])
}

fn outcome_under(program: &str, options: &[(&str, &str)]) -> Outcome {
    let options =
        options.iter().map(|(id, option)| ((*id).to_owned(), (*option).to_owned())).collect();
    let mut scenario = Scenario { options: Options(options), ..Scenario::of(program) };
    scenario.program.language = Language::Nct;
    run(&scenario).0
}

#[test]
fn what_no_document_settles_stays_open() {
    let settled: Vec<_> = OPEN
        .iter()
        .map(|(name, program)| (name, outcome(program).end))
        .filter(|(_, end)| !matches!(end, End::Unspecified { .. } | End::Unsupported { .. }))
        .collect();
    assert!(settled.is_empty(), "{settled:#?}");
}

/// Where there are no loops DO alone is a statement of another form, as END is. No edition reads it so.
#[test]
fn where_there_are_no_loops_there_is_no_do() {
    for program in ["O1\nDO1\nM30", "O1\nEND1\nM30", "O1\nWHILE [1 EQ 2] DO1\nEND1\nM30"] {
        let end = outcome_under(program, &[("nct.loops", "refused")]).end;
        let End::Fault(fault) = end else { panic!("{program:?} ends {end:?}") };
        assert_eq!(fault.kind, Some(FaultKind::Statement), "{program:?}");
    }
}

/// Of several words with a letter that has a variable of its own in such a block the last counts. No edition gives it
/// one.
#[test]
fn of_several_letters_in_a_block_that_is_taken_as_arguments_the_last_counts() {
    let program = "O1\nG66.1 P2\nG1 X5 L2 P7 G90 L3 P8\nG67\nM30\nO2\n#100 = #10\n#112 = #12\n#116 = #16\nM99";
    let outcome = outcome_under(program, &[("nct.block-arguments", "own-numbers")]);
    assert_eq!(outcome.end, End::ProgramEnd);
    let mut common = BTreeMap::new();
    for step in &outcome.steps {
        let Some(State::Nct(state)) = &step.state else { continue };
        for (number, value) in state.common.iter().flat_map(|common| &common.0) {
            common.insert(*number, *value);
        }
    }
    let expected = [(100, 90.0), (112, 3.0), (116, 8.0)];
    let expected = expected.map(|(number, value)| (number, MacroValue::Number(value)));
    assert_eq!(common, BTreeMap::from(expected));
}

/// The local variables of a level when a run ended, vacant ones left out.
fn locals(outcome: &Outcome, level: u32) -> BTreeMap<String, u64> {
    let mut locals = BTreeMap::new();
    for step in &outcome.steps {
        let Some(State::Nct(state)) = &step.state else { continue };
        for (name, value) in state.local.iter().flat_map(|local| &local.0) {
            let Some(number) = name.strip_prefix(&format!("{level}.")) else { continue };
            match value {
                MacroValue::Vacant(_) => locals.remove(number),
                MacroValue::Number(value) => locals.insert(number.to_owned(), value.to_bits()),
            };
        }
    }
    locals
}

/// A value for a local variable, or none.
type Assignment = (u32, Option<i32>);

fn assignments() -> impl Strategy<Value = Vec<Assignment>> {
    collection::vec((1_u32..=33, option::of(-1000_i32..1000)), 0..40)
}

fn written(assignments: &[Assignment]) -> String {
    let mut text = String::new();
    for (number, value) in assignments {
        let written = match value {
            Some(value) => writeln!(text, "#{number} = {value} / 8"),
            None => writeln!(text, "#{number} = #0"),
        };
        written.expect("a string takes what is written");
    }
    text
}

/// How many moves a run has made.
fn moves(outcome: &Outcome) -> usize {
    let events = outcome.steps.iter().flat_map(|step| &step.events);
    events.filter(|event| matches!(event, Event::Do(Effect::StraightFeed { .. }))).count()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_macro_leaves_the_variables_of_its_caller_as_they_are(
        own in assignments(),
        of_macro in assignments(),
        of_inner in assignments(),
        call in proptest::sample::select(vec!["G65 P2 A1 B2", "G65 P2 L3 I1 J2 K3", "G66 P2 X5\nG1 X1 F100\nG67"]),
    ) {
        let before = outcome(&format!("O1\n{}M30\n", written(&own)));
        let after = outcome(&format!(
            "O1\n{}{call}\nM30\nO2\n{}G65 P3 A1\n{}M99\nO3\n{}M99\n",
            written(&own), written(&of_macro), written(&of_inner), written(&of_inner),
        ));
        assert_eq!(after.end, End::ProgramEnd);
        assert_eq!(locals(&after, 0), locals(&before, 0));
        assert_eq!((locals(&after, 1).len(), locals(&after, 2).len()), (0, 0));
    }

    /// With n modal calls, the last of them with m moves, a move makes F(n) = 1 + m F(n - 1) moves in all; F(0) = 1.
    #[test]
    fn modal_calls_make_as_many_moves_as_the_rule_says(counts in collection::vec(0_usize..4, 0..=4)) {
        let mut program = "O1\n".to_owned();
        let calls = 2..2 + counts.len();
        calls.clone().for_each(|number| program.push_str(&format!("G66 P{number}\n")));
        program.push_str("G1 X1 F100\nM30\n");
        for (number, count) in calls.zip(&counts) {
            program.push_str(&format!("O{number}\n{}M99\n", "G1 X2\n".repeat(*count)));
        }
        let found = outcome(&program);
        assert_eq!(found.end, End::ProgramEnd, "{program}");
        assert_eq!(moves(&found), counts.iter().fold(1, |all, count| 1 + count * all), "{program}");
    }

    #[test]
    fn no_program_makes_it_panic(
        lines in collection::vec("(O[12]|N[1-3]|/)?(G(65|66|66\\.1|67|0|1|2|4)|M(98|99|3|30)|P[12]|L2|X[#0-9\\[\\]]{1,4}|I1|R2|F9|#[0-9#\\[\\]+]{1,6}=?|IF\\[#1EQ#2\\]|GOTO[12]|WHILE\\[1LT2\\]DO[12]|END[12]|COS|\\(|%|=|-| ){0,5}", 0..14),
    ) {
        let mut scenario = Scenario::of(lines.join("\n"));
        scenario.program.language = Language::Nct;
        scenario.budget = Budget { steps: 2000, ..Budget::default() };
        let (first, coverage) = run(&scenario);
        assert!(first.steps.len() <= 2000);
        assert_eq!((first, coverage), run(&scenario));
    }
}

#[test]
fn what_is_long_or_deep_ends_soon() {
    let sum = format!("O1\n#1=1{}\nM30\n", "+1*1".repeat(200_000));
    assert_eq!(outcome(&sum).end, End::ProgramEnd);
    let refused = |program: String| assert!(matches!(outcome(&program).end, End::Fault(_)));
    refused(format!("O1\n#1={}1{}\nM30\n", "[".repeat(200_000), "]".repeat(200_000)));
    refused(format!("O1\n#1={}1\nM30\n", "-".repeat(200_000)));
    refused(format!("O1\n#1={}1\nM30\n", "COS".repeat(200_000)));
    refused(format!("O1\n{}1=1\nM30\n", "#".repeat(200_000)));
    refused(format!("O1\n{}M30\n", "WHILE[1EQ1]DO1\n".repeat(50_000)));
    refused("O1\nG65 P1 L9999\nM30\n".to_owned());
    let steps = |program: &str| {
        let end = outcome(program).end;
        assert!(matches!(end, End::BudgetExhausted { .. }), "{end:?}");
    };
    steps("O1\nN1 GOTO1\n");
    steps("O1\nN1 G66 P1\nGOTO1\n");
    steps("O1\nG65 P2 L9999\nM30\nO2\nG65 P3 L9999\nM99\nO3\nG65 P4 L9999\nM99\nO4\nM99\n");
}

/// How a program ends, in a word or two, under block delete or not.
fn ending(program: &str, block_delete: bool) -> String {
    let mut scenario = Scenario::of(program);
    scenario.program.language = Language::Nct;
    scenario.program.block_delete = block_delete;
    let end = run(&scenario).0.end;
    if let End::Fault(fault) = &end {
        let line = fault.block.as_ref().expect("a fault of this language has a block").line;
        let kind = fault.kind.expect("a fault of the model has a kind");
        return format!("{kind} at {line}");
    }
    if let End::Unspecified { block, .. } = &end {
        return format!("open at {}", block.line);
    }
    if end == End::ProgramEnd { "accepted".to_owned() } else { format!("{end:?}") }
}

fn ends(expected: &[(&str, &str)]) {
    for (program, wanted) in expected {
        assert_eq!(ending(program, false), *wanted, "{program:?}");
    }
}

#[test]
fn a_program_number_counts_whatever_is_wrong_behind_it() {
    ends(&[
        ("M98P2\nM30\nO2N", "bad_number at 3"),
        ("M98P2\nM30\nO2N#1", "statement at 3"),
        ("M98P2\nM30\nO2.", "unknown_sub at 1"),
        ("M98P2\nM30\nO2?", "unknown_sub at 1"),
    ]);
}

#[test]
fn a_slash_may_stand_behind_a_comment() {
    for program in ["(a)/?\nM30", " (a) (/) / (b\nM30", "(a)/G0X\nM30"] {
        assert_eq!(ending(program, true), "accepted", "{program:?}");
    }
    for (program, wanted) in [
        ("(a /\nM30", "bad_comment at 1"),
        ("(a(b)/?\nM30", "bad_comment at 1"),
        ("?/\nM30", "bad_character at 1"),
    ] {
        assert_eq!(ending(program, true), wanted, "{program:?}");
    }
}

#[test]
fn one_carriage_return_belongs_to_the_end_of_a_line() {
    ends(&[
        ("O1\r\nM30\r\n", "accepted"),
        ("O1\nM30\r", "accepted"),
        ("O1\r\r\nM30", "bad_character at 1"),
        ("O1\nM30\r\r", "bad_character at 2"),
        ("O1\n\r\r\nM30", "bad_character at 2"),
    ]);
}

#[test]
fn the_number_of_a_variable_may_begin_with_a_point() {
    ends(&[
        ("G0X1\nX#.0\nM30", "accepted"),
        ("#.0=1\nM30", "read_only_parameter at 1"),
        ("X#.5\nM30", "open at 1"),
        ("X#.\nM30", "bad_number at 1"),
    ]);
}

#[test]
fn a_position_that_the_other_unit_has_no_number_for_is_refused_where_the_unit_changes() {
    ends(&[
        ("#1=EXP[709]\nG0X#1G20\nX#1\nG21\nY1\nM30", "out_of_domain at 4"),
        ("#1=EXP[709]\nG0A#1G20\nA#1\nG21\nY1\nM30", "accepted"),
        ("#1=EXP[709]\nG0X#1\nG20\nG21\nM30", "accepted"),
    ]);
}

/// The centre of the only arc of a program, in the first and the second axis.
fn centre(program: &str) -> (f64, f64) {
    let outcome = outcome(program);
    assert_eq!(outcome.end, End::ProgramEnd, "{program:?}");
    let events = outcome.steps.iter().flat_map(|step| &step.events);
    let arcs: Vec<_> = events
        .filter_map(|event| {
            let Event::Do(Effect::ArcFeed { first_centre, second_centre, .. }) = event else {
                return None;
            };
            Some((*first_centre, *second_centre))
        })
        .collect();
    assert_eq!(arcs.len(), 1, "{program:?}");
    arcs[0]
}

fn assert_centre(program: &str, wanted: (f64, f64)) {
    let found = centre(program);
    let close = |one: f64, other: f64| (one - other).abs() <= 1e-12 * other.abs().max(1.0);
    assert!(
        close(found.0, wanted.0) && close(found.1, wanted.1),
        "{program:?} goes round {found:?}"
    );
}

#[test]
fn an_arc_is_one_whose_centre_and_radius_are_numbers() {
    let large = 1.403_592_217_852_837_5e217;
    assert_centre("#1=EXP[500]\nG2X1R#1F1\nM30", (0.5, -large));
    assert_centre("#1=EXP[500]\nG2X1I#1F1\nM30", (large, 0.0));
    assert_centre("#1=EXP[500]\nG2X1J#1F1\nM30", (0.0, large));
    assert_centre("#1=EXP[-500]\nG2X#1R1F1\nM30", (0.0, -1.0));
    assert_centre("#1=EXP[709.5]\nG0X-#1\nG2X#1R#1F1\nM30", (0.0, 0.0));
    ends(&[
        ("#1=EXP[709.5]\nG0X#1\nG2X0I#1F1\nM30", "bad_arc at 3"),
        ("#1=EXP[709.5]\nG2X1I#1J#1F1\nM30", "bad_arc at 2"),
        ("#1=EXP[709.5]\nG0Y#1\nG3X1R#1F1\nM30", "bad_arc at 3"),
        ("#1=EXP[709]\nG2X#1I-#1F1\nM30", "open at 2"),
    ]);
}

#[test]
fn half_a_circle_does_not_hang_on_the_last_bit() {
    assert_centre("G2 X23.7 Y10.4 R12.940730273056461 F100\nM30", (11.85, 5.2));
    for (x, y) in (1..40).flat_map(|x| (1..40).map(move |y| (x, y))) {
        let program = format!("#1={x}.7\n#2={y}.1\n#3=SQRT[#1*#1+#2*#2]/2\nG2X#1Y#2R#3F1\nM30");
        assert_eq!(ending(&program, false), "accepted", "{program:?}");
    }
    ends(&[
        ("G2X2R0.9999999995F1\nM30", "accepted"),
        ("G2X2R0.999999998F1\nM30", "bad_arc at 1"),
        ("G2X2R-0.999999998F1\nM30", "bad_arc at 1"),
        ("G2X2R0F1\nM30", "bad_arc at 1"),
    ]);
}

#[test]
fn the_centre_of_a_flat_arc_is_exact() {
    let (first, second) = centre("G2X200000R100000.0000001F1\nM30");
    // r - d is what the number of R leaves of 1e-7.
    let expected = -((100_000.000_000_1_f64 - 100_000.0) * 200_000.000_000_1_f64).sqrt();
    assert!((first - 100_000.0).abs() < 1e-9 && (second - expected).abs() < 1e-12, "{second}");
}

#[test]
fn a_word_that_is_zero_has_no_sign() {
    let outcome = outcome("G0X1\nX[0*-1]\nM30");
    let ends: Vec<u64> = outcome
        .steps
        .iter()
        .flat_map(|step| &step.events)
        .filter_map(|event| {
            let Event::Do(Effect::StraightTraverse { end }) = event else { return None };
            Some(end.to_array()[0].to_bits())
        })
        .collect();
    assert_eq!(ends, [1.0_f64.to_bits(), 0.0_f64.to_bits()]);
}

/// M99 is executed where blocks are taken as arguments: it calls nothing, with a motion or without.
#[test]
fn a_return_is_executed_where_modal_calls_are_by_block() {
    ends(&[
        ("G66.1P2\nM99X1G0\nO2\nM99", "Endless"),
        ("G66P2\nM99X1G0\nO2\nM99", "open at 2"),
        ("G66.1P2\nG66.1P3\nX1\nG67\nG67\nM30\nO2\nGOTO9\nO3\nM99X1G0", "accepted"),
    ]);
}
