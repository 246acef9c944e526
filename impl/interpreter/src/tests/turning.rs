//! Lathe cycles in whole programs: the worked programs of `docs/turning.md`, refusals, what is open, and steps.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use gaugeblock_vocabulary::{Effect, End, Machine, Options, Settings};

use super::{Case, Recorder, check};
use crate::{Error, Interpreter, Limits, Memory, Progress, Reply, Sink};

/// The moves in ZX: `T(x,z)`, `F(x,z)` and `C(x,z;x,z)` with the centre of an arc.
#[derive(Default)]
struct Path(Vec<String>);

impl Sink for Path {
    fn set(&mut self, _line: u32, _changed: &Settings) {}

    fn perform(&mut self, _line: u32, effect: &Effect) -> Reply {
        let point = |x: f64, z: f64| format!("{},{}", rounded(x), rounded(z));
        if let Effect::StraightTraverse { end } = effect {
            self.0.push(format!("T({})", point(end.x, end.z)));
        } else if let Effect::StraightFeed { end } = effect {
            self.0.push(format!("F({})", point(end.x, end.z)));
        } else if let Effect::ArcFeed { end, first_centre, second_centre, .. } = effect {
            let centre = point(*second_centre, *first_centre);
            self.0.push(format!("C({};{centre})", point(end.x, end.z)));
        }
        Reply::Done
    }
}

/// To seven decimals, without a negative zero.
fn rounded(value: f64) -> f64 {
    libm::round(value * 1e7) / 1e7 + 0.0
}

const S: &str = "x8 z0;z-5;x9 z-6";
const V: &str = "x8 z0;x9 z-2;x6.5 z-10;x10 z-12";

/// The moves of a cycle after the profile's definition, with the tool at X10 Z1.
fn moves(profile: &str, cycle: &str, emulates_rs274: bool) -> (String, Result<Progress, Error>) {
    let profile = profile.replace(';', "\n");
    let program =
        format!("g18 g20 g8 g90 f10\no100 sub\n{profile}\no100 endsub\ng0 x10 z1\n{cycle}\nm2\n");
    let mut interpreter =
        Interpreter::new(Machine::default(), Options::default(), Limits::default()).unwrap();
    if emulates_rs274 {
        interpreter.emulate_rs274([]);
    }
    let (mut source, mut path) = (Memory::new(&*program), Path::default());
    let end = interpreter.run(&mut source, &mut path, 10_000);
    (path.0.get(1..).unwrap_or_default().join(" "), end)
}

#[track_caller]
fn check_moves(profile: &str, cycle: &str, expected: &str) {
    let (found, end) = moves(profile, cycle, false);
    assert_eq!(found, expected, "{profile} {cycle}");
    assert_eq!(end, Ok(Progress::Ended(End::ProgramEnd)), "{profile} {cycle}");
}

/// The same with the quirks of `rs274`: a worked program, without the first motion.
#[track_caller]
fn check_observed(profile: &str, cycle: &str, expected: &str) {
    let (found, end) = moves(profile, cycle, true);
    assert_eq!(found, format!("T(10,1) {expected}"), "{profile} {cycle}");
    assert_eq!(end, Ok(Progress::Ended(End::ProgramEnd)), "{profile} {cycle}");
}

#[test]
fn worked_programs_with_the_quirks_of_rs274() {
    check_observed(S, "g70 q100", "T(10,1) T(8,0) F(8,-5) F(9,-6)");
    check_observed(
        S,
        "g70 q100 d.2 p2",
        "T(10,1) T(8.1,0) F(8.1,-4.9585786) F(9.0707107,-5.9292893) T(10,1) T(8,0) F(8,-5) F(9,-6)",
    );
    check_observed(
        S,
        "g71 q100",
        "T(10,1) T(10,1) F(10,-6) T(10.5,-5.5) T(10.5,0.5) T(10,1) T(9,0.5) F(9,-6) T(9.5,-5.5) \
         T(9.5,0) T(9,0.5) T(8,0) F(8,-5) F(9,-6) F(10,-6)",
    );
    check_observed(
        S,
        "g71 q100 d-.1 i5",
        "T(10,1) T(10,1) F(10,-6.0707107) T(10.5,-5.5707107) T(10.5,0.5) T(10,1) T(7.9,0) F(7.9,-5) \
         C(7.9292893,-5.0707107;8,-5) F(8.9292893,-6.0707107) F(10,-6.0707107)",
    );
    check_observed("x8 z0;x5.5 z-2;x7 z-10", "g71 q100", "T(10,1) F(8,0) F(5.5,-2) F(7,-10)");
    check_observed(
        "x8 z0;z-5 a1;x10;z-7",
        "g70 q100",
        "T(10,1) T(8,0) F(8,-4) C(9,-5;9,-4) F(10,-5) F(10,-7)",
    );
    check_observed(
        V,
        "g71.1 q100 r.3",
        "T(10,1) T(10,1) F(10,-12) T(10.3,-11.7) T(10.3,0.7) T(10,1) T(9,0.5) F(9,-2) T(9.3,-1.7) \
         T(9.3,0.2) T(9,0.5) T(8,0) F(8,0) F(9,-2) F(9,-11.4285714) F(10,-12)",
    );
    check_observed(
        V,
        "g71.2 q100 r.3",
        "T(10,1) T(8,0) F(9,-2) F(9,-2) F(9,-11.4285714) T(9.3,-11.1285714) T(9.3,-2.3) F(9,-2) \
         F(8,-5.2) F(8,-10.8571429) T(8.3,-10.5571429) T(8.3,-5.5) F(8,-5.2) F(7,-8.4) \
         F(7,-10.2857143) T(7.3,-9.9857143) T(7.3,-8.7) F(7,-8.4) F(6.5,-10) F(10,-12)",
    );
}

#[test]
fn the_documents_have_no_traverse_in_place_and_end_with_the_profile() {
    check_moves(S, "g70 q100", "T(8,0) F(8,-5) F(9,-6)");
    check_moves(S, "g70 q100 x11", "T(11,1) T(8,0) F(8,-5) F(9,-6)");
    check_moves(S, "g70 q100 p2", "T(8,0) F(8,-5) F(9,-6) T(10,1) T(8,0) F(8,-5) F(9,-6)");
    check_moves(
        S,
        "g71 q100 i2",
        "T(10,1) F(10,-6) T(10.5,-5.5) T(10.5,0.5) T(10,1) T(8,0) F(8,-5) F(9,-6)",
    );
    // X and Z are increments once.
    check_moves(
        "x-2 z-1;z-5;x1 z-1",
        "g91\ng70 q100 x1 z.5\ng90",
        "T(11,1.5) T(9,0.5) F(9,-4.5) F(10,-5.5)",
    );
    // The start keeps its Z where that is beyond the profile.
    check_moves(S, "g70 q100 z-1", "T(10,-1) T(8,0) F(8,-5) F(9,-6)");
    // One arc may go towards greater Z, whatever X does.
    check_moves("x8 z0;g3 x8 z2 i1 k1", "g70 q100", "T(8,0) C(8,2;9,1)");
}

#[test]
fn a_facing_cycle_swaps_the_axes_and_inside_turning_mirrors_depth() {
    check_moves(
        "x0 z8;x-5;x-6 z9",
        "g0 x1 z10\ng72 q100 i2",
        "T(1,10) T(1,10) F(-6,10) T(-5.5,10.5) T(0.5,10.5) T(1,10) T(0,8) F(-5,8) F(-6,9)",
    );
    check_moves(
        "x8 z0;z-5;x7 z-6",
        "g0 x6 z1\ng71 q100 i2",
        "T(6,1) T(6,1) F(6,-6) T(5.5,-5.5) T(5.5,0.5) T(6,1) T(8,0) F(8,-5) F(7,-6)",
    );
}

#[test]
fn blocks_of_a_profile_are_read_and_not_executed() {
    let ignored = "x8 z0 f5 s9;m3;(msg,no);g4 p1;g7;g21;g91;m70;m2;t1;g17;z-5 m8;x9 z-6";
    check_moves(ignored, "g70 q100", "T(8,0) F(8,-5) F(9,-6)");
    // No word is checked, and the axis words of other codes are ignored, too.
    check_moves(
        "x8 z0;g4;h3;g92 x3 z3;g10 l2 p1 x4;z-5;x9 z-6",
        "g70 q100",
        "T(8,0) F(8,-5) F(9,-6)",
    );
    // Another motion ends the moves.
    check_moves("x8 z0;g81;x1 z1;g1 z-5;x9 z-6", "g70 q100", "T(8,0) F(8,-5) F(9,-6)");
    check_moves("x8 z0;w-5;u1 w-1", "g70 q100", "T(8,0) F(8,-5) F(9,-6)");
    check_moves("g0 x8 z0;g0 z-5;x9 z-6", "g70 q100", "T(8,0) F(8,-5) F(9,-6)");
    let (_, checked) = moves("x8 z0;g4;z-5;x9 z-6", "g70 q100", true);
    assert!(matches!(checked, Err(Error::Fault(_))), "{checked:?}");
}

#[test]
fn a_profile_runs_as_a_call_does() {
    check(
        "o101 sub\nx#1 z#2\no101 endsub\no100 sub\n#1=8 #<d>=-1\ng1 x#1 z0\no1 repeat [2]\nz#<d>\n#<d>=[#<d>*5]\n\
         o1 endrepeat\no101 call [9] [-6]\n#<_last>=#<d>\no100 return [3]\nx99\no100 endsub\n#1=7 f10\n\
         g18 g0 x10 z1\ng70 q100\ng1 x[#1+4] z#<_last>\n#31=#<_value>\nm2\n",
        "accepted; #1 = 7; #31 = 3; at 18 straight_feed end=(x9 z-6); count straight_feed = 4",
    );
    // Its blocks are not blocks of the program.
    let outcome = Case::default()
        .run(b"o100 sub\nx8 z0\nz-5\nx9\no100 endsub\ng18 f10\ng0 x10 z1\ng70 q100\nm2\n");
    let lines: Vec<u32> = outcome.recorder.done.iter().map(|(_, line)| *line).collect();
    assert_eq!(lines, [1, 6, 7, 8, 9]);
}

#[test]
fn a_profile_may_be_in_a_file_of_its_own() {
    let case = Case {
        files: alloc::vec![("7.ngc", "o7 sub\nx8 z0\nz-5\nx9\no7 endsub\nm2\n")],
        ..Case::default()
    };
    case.check("g18 f10\ng0 x10 z1\ng70 q7\nm2\n", "accepted; count straight_feed = 2");
}

#[test]
fn refusals() {
    for (profile, cycle, refused) in [
        (S, "g70", "missing_word"),
        (S, "g70 q1.5", "not_an_integer"),
        (S, "g70 q99", "unknown_sub"),
        (S, "g17 g70 q100", "modal_conflict"),
        (S, "g41.1 d1 g71 q100", "compensation_active"),
        (S, "g71 q100 i0", "word_out_of_range"),
        (S, "g71 q100 e1", "unused_word"),
        (S, "g70 q100 i1", "unused_word"),
        (S, "g70 q100 k1", "unused_word"),
        (S, "g53 g70 q100 x9", "axis_words"),
        (S, "g1 g70 q100", "modal_conflict"),
        (S, "g93 g70 q100 f1", "missing_word"),
        (S, "f0 g71 q100", "zero_feed"),
        ("x8 z0;x9 z-5;x7 z-3", "g70 q100", "bad_block"),
        ("x8 z0;z-5;z-3;x9 z-6", "g71 q100", "bad_block"),
        ("x8 z0;z-5 a1 c1;x9", "g70 q100", "modal_conflict"),
        ("x8 z0;z-5 a2;x9", "g70 q100", "bad_block"),
        ("x8 z0;u1 x9;z-6", "g70 q100", "axis_words"),
        ("x8 z0;g2 x9 z-1;z-6", "g70 q100", "missing_word"),
        ("x8 z0;z-5;g2 x9 z-6 i1.3 k0", "g70 q100", "bad_arc"),
    ] {
        let (_, end) = moves(profile, cycle, false);
        let Err(Error::Fault(fault)) = &end else { panic!("{profile} {cycle}: {end:?}") };
        assert_eq!(fault.kind.map(|kind| kind.word()), Some(refused), "{profile} {cycle}");
    }
}

#[test]
fn lines_in_a_row_keep_the_distance_and_rs274_refuses_them() {
    let profile = "x8 z0;z-5;z-6;x9";
    let (_, end) = moves(profile, "g70 q100 e.1", false);
    assert!(matches!(end, Ok(Progress::Ended(End::ProgramEnd))), "{end:?}");
    let (_, end) = moves(profile, "g70 q100 e.1", true);
    let Err(Error::Fault(fault)) = &end else { panic!("{end:?}") };
    assert_eq!(fault.kind.map(|kind| kind.word()), Some("gouging"));
}

#[test]
fn a_piece_that_the_distance_makes_vanish_is_dropped() {
    check_moves("x8 z0;x5 z-4;x7;z-6", "g70 q100 e1", "T(8.8,-0.6) F(7,-3) C(8,-4;7,-4) F(8,-6)");
}

#[test]
fn a_dome_of_two_arcs_is_not_one_that_was_split() {
    let before = "T(10,1) F(10,-3) T(10.5,-2.5) T(10.5,0.5) T(10,1) T(8,0) F(8,0) C(9,-1;8,-1)";
    for (profile, after) in [
        ("x8 z0;g3 x9 z-1 k-1;x8 z-2 i-1;g1 x9 z-3", "F(9,-1) F(9,-3) F(9,-3)"),
        ("x8 z0;g3 x8 z-2 k-1;g1 x9 z-3", "F(9,-3) F(9,-3)"),
    ] {
        check_moves(profile, "g71.1 q100 i5", &format!("{before} {after}"));
    }
}

#[test]
fn levels_go_on_below_those_of_an_arc_that_has_risen_again() {
    check_moves(
        "x9 z0;g2 x9 z-4 k-2;g1 x6 z-10;x10 z-12",
        "g71 q100 i.8",
        "T(10,1) F(10,-12) T(10.5,-11.5) T(10.5,0.5) T(10,1) T(9.2,0.2) F(9.2,-11.6) T(9.7,-11.1) \
         T(9.7,-0.3) T(9.2,0.2) T(9,0) C(8.4,-0.0921216;9,-2) F(8.4,-3.9078784) T(8.9,-3.4078784) \
         T(8.9,-0.5921216) F(8.4,-0.0921216) C(7.6,-0.5717143;9,-2) F(7.6,-3.4282857) \
         T(8.1,-2.9282857) T(8.1,-1.0717143) F(7.6,-0.5717143) C(9,-4;9,-2) F(6.8,-8.4) F(6.8,-10.4) \
         T(7.3,-9.9) T(7.3,-8.9) F(6.8,-8.4) F(6,-10) F(10,-12)",
    );
}

#[test]
fn what_is_open_ends_the_run() {
    for (profile, cycle) in [
        ("x8 z0;z-5", "g71 q100 d.1"),
        ("x8 z0;z-5 a.1;z-6;x9", "g70 q100"),
        ("x8 z0;g3 x8.5 z-2 r2;g2 x9 z-4 r3", "g70 q100 e.1"),
        // The joints of a piece pass each other.
        ("x8 z0;x5 z-1;x7;z-6", "g70 q100 e1"),
        ("x8 z0;x10;x8;z-5", "g70 q100 e1"),
        ("x8 z0;z-1;x10;z-6", "g70 q100 e1"),
        ("x8 z0;g2 x9 z-1.0001 i1;g1 z-6", "g70 q100 e.1"),
        ("x9 z0;g2 x9 z-4 k-2;g1 x10", "g71 q100 i3"),
        ("x8 z0", "g70 q100"),
        (S, "g70 q100 p.5"),
    ] {
        let (_, end) = moves(profile, cycle, false);
        let is_open = matches!(end, Ok(Progress::Ended(End::Unspecified { .. })));
        assert!(is_open, "{profile}: {end:?}");
    }
    let (_, end) = moves(V, "g71.1 q100", false);
    assert_eq!(end, Ok(Progress::Ended(End::ProgramEnd)));
}

#[test]
fn a_refused_cycle_changes_nothing() {
    let program =
        "o1 sub\nx8 z0\nx9 z-5\nx7 z-3\n#40=5\no1 endsub\ng18 f10\ng0 x10 z1\nf20 g70 q1 x11\nm2\n";
    let mut interpreter =
        Interpreter::new(Machine::default(), Options::default(), Limits::default()).unwrap();
    let end = interpreter.run(&mut Memory::new(program), &mut Recorder::default(), 1000);
    assert!(matches!(end, Err(Error::Fault(_))), "{end:?}");
    assert_eq!(interpreter.settings().feed_rate, Some(10.0));
    let state = interpreter.state();
    assert_eq!(state.position.map(|position| position.x), Some(10.0));
    assert_eq!(state.motion, Some(gaugeblock_vocabulary::Motion::Traverse));
    assert_eq!(state.call_level, Some(0));
}

#[test]
fn a_long_profile_meets_its_limit() {
    let case = Case { limits: Limits { profile_moves: 5, ..Limits::default() }, ..Case::default() };
    let program = "o1 sub\n#1=8\ng1 x8\no2 repeat [9]\n#1=[#1+1]\nx#1 z-#1\no2 endrepeat\no1 endsub\n\
                   g18 f10\ng0 x9 z0\ng70 q1\nm2\n";
    case.check(program, "beyond");
    check(program, "accepted");
}

/// Effects of a step at most.
const EFFECTS_PER_STEP: usize = 40;

#[derive(Default)]
struct Count(usize);

impl Sink for Count {
    fn set(&mut self, _line: u32, _changed: &Settings) {}

    fn perform(&mut self, _line: u32, _effect: &Effect) -> Reply {
        self.0 += 1;
        if self.0.is_multiple_of(7) { Reply::Stop } else { Reply::Done }
    }
}

#[test]
fn a_step_is_bounded_and_an_abort_leaves_the_cycle() {
    for (profile, cycle) in [
        ("x1 z0;z-5;x20 z-6", "g71 q1 i.000000000001"),
        ("x8 z0;z-5;x9 z-6", "g70 q1 p999999999999"),
        ("x8 z0;x9 z-1;z-6", "g71 q1 d1000000000"),
        ("o2 while [1]\nx8\no2 endwhile", "g70 q1"),
    ] {
        let profile = profile.replace(';', "\n");
        let program = format!("o1 sub\n{profile}\no1 endsub\ng18 f10\ng0 x10 z1\n{cycle}\nm2\n");
        let mut interpreter =
            Interpreter::new(Machine::default(), Options::default(), Limits::default()).unwrap();
        let (mut source, mut count) = (Memory::new(&*program), Count::default());
        let mut before = 0;
        for _ in 0..60 {
            let progress = interpreter.step(&mut source, &mut count).unwrap();
            assert!(matches!(progress, Progress::More | Progress::Stopped), "{cycle}");
            assert!(count.0 - before <= EFFECTS_PER_STEP, "{cycle}");
            before = count.0;
        }
        interpreter.abort(&mut Recorder::default());
        let end = interpreter.run(&mut Memory::new("g0 x1\nm2\n"), &mut Recorder::default(), 9);
        assert_eq!(end, Ok(Progress::Ended(End::ProgramEnd)), "{cycle}");
    }
}
