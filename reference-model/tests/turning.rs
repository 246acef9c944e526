//! Lathe cycles: the worked programs of docs/turning.md, and laws of their geometry.

use gaugeblock_reference::run;
use gaugeblock_vocabulary::{Axis, Effect, End, Event, Outcome, Scenario};

/// A move in the plane: X and Z of its end; an arc also has its centre.
type Move = (char, Vec<f64>);

/// Runs a cycle with a profile, after a traverse to X10 Z1.
fn outcome(profile: &str, cycle: &str) -> Outcome {
    outcome_from("x10 z1", profile, cycle)
}

/// Runs a cycle with a profile, after a traverse to a start.
fn outcome_from(start: &str, profile: &str, cycle: &str) -> Outcome {
    let blocks = profile.replace("; ", "\n");
    let program = format!(
        "o100 sub\n{blocks}\no100 endsub\ng18 g20 g8 g90 f10 g0 {start}\n{cycle} q100\nm2\n"
    );
    let mut scenario = Scenario::of(program);
    scenario.machine.axes = Axis::ALL.to_vec();
    run(&scenario).0
}

/// The moves of an outcome after the traverse to the start.
fn moves(outcome: &Outcome) -> Vec<Move> {
    let events = outcome.steps.iter().flat_map(|step| &step.events);
    let effects = events.filter_map(|event| match event {
        Event::Do(effect) => Some(effect),
        Event::Set(_) | Event::Unknown(_) => None,
    });
    let moves = effects.filter_map(|effect| {
        if let Effect::StraightTraverse { end } = effect {
            Some(('T', vec![end.x, end.z]))
        } else if let Effect::StraightFeed { end } = effect {
            Some(('F', vec![end.x, end.z]))
        } else if let Effect::ArcFeed { end, first_centre, second_centre, .. } = effect {
            Some(('C', vec![end.x, end.z, *second_centre, *first_centre]))
        } else {
            None
        }
    });
    moves.skip(1).collect()
}

/// Whether a cycle makes these moves, written as `T(x,z) F(x,z) C(x,z;x,z)`.
#[track_caller]
fn makes(profile: &str, cycle: &str, expected: &str) {
    let outcome = outcome(profile, cycle);
    assert_eq!(outcome.end, End::ProgramEnd, "{}", outcome.to_text());
    let found = moves(&outcome);
    let wanted: Vec<Move> = expected.split_whitespace().map(parsed).collect();
    assert_eq!(found.len(), wanted.len(), "{found:?}");
    for (found, wanted) in found.iter().zip(&wanted) {
        let close = |(one, other): (&f64, &f64)| (one - other).abs() < 1e-7;
        let same = found.0 == wanted.0 && found.1.iter().zip(&wanted.1).all(close);
        assert!(same, "{found:?} is not {wanted:?}");
    }
}

fn parsed(text: &str) -> Move {
    let numbers = text[2..text.len() - 1].split([',', ';']);
    let numbers = numbers.map(|number| number.parse().expect("test: a number"));
    (text.chars().next().expect("test: a letter"), numbers.collect())
}

const STEP: &str = "x8 z0; z-5; x9 z-6";
const POCKET: &str = "x8 z0; x9 z-2; x6.5 z-10; x10 z-12";

#[test]
fn finishing_follows_the_profile() {
    makes(STEP, "g70", "T(8,0) F(8,-5) F(9,-6)");
}

#[test]
fn finishing_makes_its_passes_closer_and_closer() {
    makes(
        STEP,
        "g70 d.2 p2",
        "T(8.1,0) F(8.1,-4.95857864) F(9.07071068,-5.92928932) T(10,1) T(8,0) F(8,-5) F(9,-6)",
    );
}

#[test]
fn roughing_cuts_layers_and_then_the_profile() {
    makes(
        STEP,
        "g71",
        "T(10,1) F(10,-6) T(10.5,-5.5) T(10.5,.5) T(10,1) T(9,.5) F(9,-6) T(9.5,-5.5) T(9.5,0) T(9,.5) T(8,0) F(8,-5) \
         F(9,-6)",
    );
}

#[test]
fn outer_corner_has_an_arc_at_a_distance() {
    makes(
        STEP,
        "g71 d-.1 i5",
        "T(10,1) F(10,-6.07071068) T(10.5,-5.57071068) T(10.5,.5) T(10,1) T(7.9,0) F(7.9,-5) \
         C(7.92928932,-5.07071068;8,-5) F(8.92928932,-6.07071068)",
    );
}

#[test]
fn piece_of_no_length_at_a_distance_is_dropped() {
    makes("x8 z0; x5 z-4; x7; z-6", "g70 e1", "T(8.8,-.6) F(7,-3) C(8,-4;7,-4) F(8,-6)");
}

#[test]
fn arc_that_a_block_begins_at_its_top_has_a_feed_in_place() {
    let before = "T(10,1) F(10,-3) T(10.5,-2.5) T(10.5,.5) T(10,1) T(8,0) F(8,0) C(9,-1;8,-1)";
    for (dome, after) in [
        ("g3 x9 z-1 k-1; x8 z-2 i-1", "F(9,-1) F(9,-3) F(9,-3)"),
        ("g3 x8 z-2 k-1", "F(9,-3) F(9,-3)"),
    ] {
        makes(&format!("x8 z0; {dome}; g1 x9 z-3"), "g71.1 i5", &format!("{before} {after}"));
    }
}

#[test]
fn arc_that_rises_from_its_lowest_point_has_a_feed_in_place() {
    makes(
        "x8 z0; z-2; g2 x9 z-3 i1",
        "g71.1 i5",
        "T(10,1) F(10,-3) T(10.5,-2.5) T(10.5,.5) T(10,1) T(8,0) F(8,0) F(8,-2) F(8,-2) C(9,-3;9,-2)",
    );
}

#[test]
fn inside_profile_is_followed_from_the_other_side() {
    makes("x8 z0; x5.5 z-2; x7 z-10", "g71", "F(8,0) F(5.5,-2) F(7,-10)");
}

#[test]
fn fillet_takes_as_much_of_both_moves() {
    makes("x8 z0; z-5 a1; x10; z-7", "g70", "T(8,0) F(8,-4) C(9,-5;9,-4) F(10,-5) F(10,-7)");
    makes("x8 z0; z-5 c1; x10; z-7", "g70", "T(8,0) F(8,-4) F(9,-5) F(10,-5) F(10,-7)");
}

#[test]
fn first_variant_passes_over_pockets() {
    makes(
        POCKET,
        "g71.1 r.3",
        "T(10,1) F(10,-12) T(10.3,-11.7) T(10.3,.7) T(10,1) T(9,.5) F(9,-2) T(9.3,-1.7) T(9.3,.2) T(9,.5) T(8,0) \
         F(8,0) F(9,-2) F(9,-11.42857143) F(10,-12)",
    );
}

#[test]
fn second_variant_cuts_pockets_alone() {
    makes(
        POCKET,
        "g71.2 r.3",
        "T(8,0) F(9,-2) F(9,-2) F(9,-11.42857143) T(9.3,-11.12857143) T(9.3,-2.3) F(9,-2) F(8,-5.2) F(8,-10.85714286) \
         T(8.3,-10.55714286) T(8.3,-5.5) F(8,-5.2) F(7,-8.4) F(7,-10.28571429) T(7.3,-9.98571429) T(7.3,-8.7) \
         F(7,-8.4) F(6.5,-10) F(10,-12)",
    );
}

#[test]
fn mirrored_profile_has_the_mirrored_path() {
    for cycle in ["g71 i.7 r.2", "g71 d.1 i.7", "g71.1 i.4", "g71.2 i.4", "g71.2 d.05"] {
        let from = moves(&outcome(POCKET, cycle));
        let mirrored = moves(&outcome_from("x10 z-1", &POCKET.replace("z-", "z"), cycle));
        assert!(from.len() > 5);
        assert_eq!(from.len(), mirrored.len(), "{cycle}");
        for (one, other) in from.iter().zip(&mirrored) {
            let close = (one.1[0] - other.1[0]).abs() + (one.1[1] + other.1[1]).abs() < 1e-9;
            assert!(one.0 == other.0 && close, "{cycle}: {one:?} and {other:?}");
        }
    }
}

#[test]
fn facing_is_turning_with_exchanged_axes() {
    let turned = moves(&outcome(POCKET, "g71 i.7 d.05"));
    let exchanged = "z8 x0; z9 x-2; z6.5 x-10; z10 x-12";
    let faced = moves(&outcome_from("z10 x1", exchanged, "g72 i.7 d.05"));
    assert_eq!(turned.len(), faced.len());
    for (one, other) in turned.iter().zip(&faced) {
        let close = (one.1[0] - other.1[1]).abs() + (one.1[1] - other.1[0]).abs() < 1e-9;
        assert!(one.0 == other.0 && close, "{one:?} and {other:?}");
    }
}

#[test]
fn each_layer_is_one_increment_deeper() {
    let moves = moves(&outcome("x5 z0; x9.5 z-8; x10", "g71 i.25 r0"));
    let depths: Vec<f64> =
        moves.windows(2).filter(|pair| pair[1].0 == 'F').map(|pair| pair[1].1[0]).collect();
    for (number, depth) in (0..20).map(f64::from).zip(&depths) {
        assert!((depth - (10.0 - 0.25 * number)).abs() < 1e-9, "{depth}");
    }
    assert!(depths.len() > 20);
}

#[test]
fn distance_is_kept_along_the_profile() {
    let outcome = outcome("x8 z0; z-5; x9 z-6; x9.5 z-9; x10", "g71 d.1 i50");
    let ends = moves(&outcome);
    let has = |x: f64, z: f64| {
        ends.iter().any(|(_, end)| (end[0] - x).abs() < 1e-9 && (end[1] - z).abs() < 1e-9)
    };
    assert!(has(8.1, 0.0), "{ends:?}");
    assert!(has(10.0, -8.9), "{ends:?}");
}

#[test]
fn what_the_documents_leave_open_is_unspecified() {
    for (profile, cycle) in [
        ("x8 z0; x9 z-6", "g70 e.1"),
        ("x8 z0; g3 x8.5 z-2 r2; g3 x9 z-4 r2", "g70 e.1"),
        ("x9 z0; g2 x9 z-4 k-2; g1 x10", "g71 i3"),
        ("x8 z0; x5 z-1; x7; z-6", "g70 e1"),
        ("x8 z0; x10; x8; z-5", "g70 e1"),
        ("x8 z0; z-1; x10; z-6", "g70 e1"),
        ("g2 x8 z0 r3; g1 z-5; x9 z-6", "g71"),
        ("x8 z0; g81 z-3 r1; x9 z-6", "g70"),
    ] {
        let end = outcome(profile, cycle).end;
        assert!(matches!(end, End::Unspecified { .. }), "{profile} {cycle}: {end:?}");
    }
}

#[test]
fn block_of_the_profile_that_is_refused_is_the_block_of_the_fault() {
    let end = outcome("x8 z0; z-5; u1 x9", "g70").end;
    let End::Fault(fault) = end else { panic!("{end:?}") };
    assert_eq!(fault.block.map(|block| block.line), Some(4));
    let end = outcome("x8 z0; z-5; z-2; x9", "g71").end;
    let End::Fault(fault) = end else { panic!("{end:?}") };
    assert_eq!(fault.block.map(|block| block.line), Some(8));
}
