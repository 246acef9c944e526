//! The worked programs, and points that were observed.

use super::Move::{Arc, Line, Rapid};
use super::{Move, completed, feed_ends, leads, moves, moves_in, outcome_under};
use gaugeblock_vocabulary::{Position, State};

/// Whether a program makes these moves.
#[track_caller]
fn makes(blocks: &str, expected: &[Move]) {
    leads(&moves(&completed(blocks)), expected);
}

#[test]
fn lines_meet_at_inner_corners() {
    makes(
        "g41.1 d.5; g1 x1; y1; x0; y0; g40; x2",
        &[
            Line([0.75, 0.25]),
            Line([0.75, 0.75]),
            Line([0.25, 0.75]),
            Line([0.25, 0.0]),
            Line([2.0, 0.0]),
        ],
    );
}

#[test]
fn arcs_join_outer_corners() {
    makes(
        "g42.1 d.5; g1 x1; y1; x0; g40; x-2",
        &[
            Line([1.0, -0.25]),
            Arc([1.25, 0.0], [1.0, 0.0], 1),
            Line([1.25, 1.0]),
            Arc([1.0, 1.25], [1.0, 1.0], 1),
            Line([0.0, 1.25]),
            Line([-2.0, 1.0]),
        ],
    );
    makes(
        "g41.1 d.5; g1 x1; x2; x1; x0",
        &[
            Line([1.0, 0.25]),
            Line([2.0, 0.25]),
            Arc([2.0, -0.25], [2.0, 0.0], -1),
            Line([1.0, -0.25]),
            Line([0.0, -0.25]),
        ],
    );
}

#[test]
fn arcs_are_concentric() {
    makes(
        "g41.1 d.5; g1 x1; x2; g3 x4 i1; g1 x5",
        &[
            Line([1.0, 0.25]),
            Line([2.0, 0.25]),
            Arc([2.25, 0.0], [2.0, 0.0], -1),
            Arc([3.75, 0.0], [3.0, 0.0], 1),
            Arc([4.0, 0.25], [4.0, 0.0], -1),
            Line([5.0, 0.25]),
        ],
    );
    makes(
        "g42.1 d.5; g1 x1; x2; g3 x4 i1; g1 x5",
        &[
            Line([1.0, -0.25]),
            Line([1.775_255_1, -0.25]),
            Arc([4.224_744_9, -0.25], [3.0, 0.0], 1),
            Line([5.0, -0.25]),
        ],
    );
    makes(
        "g41.1 d.5; g1 x3; g3 i-1; g1 x-5",
        &[Line([2.707_106_8, 0.25]), Arc([2.707_106_8, -0.25], [2.0, 0.0], 1), Line([-5.0, -0.25])],
    );
}

#[test]
fn a_straight_traverse_joins_in_front_of_a_traverse() {
    makes(
        "g42.1 d.5; g0 x1; g1 y1; g0 x0",
        &[
            Rapid([1.0, -0.25]),
            Arc([1.25, 0.0], [1.0, 0.0], 1),
            Line([1.25, 1.0]),
            Rapid([1.0, 1.25]),
            Rapid([0.0, 1.25]),
        ],
    );
}

#[test]
fn a_move_that_becomes_a_point_is_accepted() {
    makes(
        "g41.1 d.5; g1 x1; y.5; x0; y3",
        &[
            Line([0.75, 0.25]),
            Line([0.75, 0.25]),
            Line([0.0, 0.25]),
            Arc([-0.25, 0.5], [0.0, 0.5], -1),
            Line([-0.25, 3.0]),
        ],
    );
}

#[test]
fn an_arc_is_the_entry() {
    makes("g41.1 d.5; g2 x1 y1 i1", &[Arc([1.0, 1.25], [1.0, 0.225], -1)]);
    // The circle of the entry is the one that a corner cuts.
    makes(
        "g42.1 d.5; g2 x1 y1 i1; g1 y-2; x0; g40; x5",
        &[
            Arc([0.75, 0.719_555_1], [1.0, -0.291_666_7], -1),
            Line([0.75, -1.75]),
            Line([0.0, -1.75]),
            Line([5.0, -2.0]),
        ],
    );
}

#[test]
fn a_negative_diameter_changes_the_side() {
    for blocks in ["x1; y1; x0; g3 x2 i1", "x1; g2 x1 y2 r3; g1 x5; g40; x9"] {
        let left = moves(&completed(&format!("g41.1 d-.5; g1 {blocks}")));
        leads(&left, &moves(&completed(&format!("g42.1 d.5; g1 {blocks}"))));
    }
}

#[test]
fn without_a_radius_moves_are_as_without_compensation() {
    let blocks = "g1 x1; z1; y1; g2 x2 i.5; g40; g1 y2; g2 x3 i.5";
    leads(&moves(&completed(&format!("g41.1 d0; {blocks}"))), &moves(&completed(blocks)));
    leads(&moves(&completed(&format!("g42; {blocks}"))), &moves(&completed(blocks)));
}

#[test]
fn the_plane_of_a_lathe_has_z_first() {
    let outcome = completed("g18 g42.1 d.5; g1 z1; x1; z0; g40; x3");
    leads(
        &moves_in(&outcome, |end| [end.z, end.x]),
        &[
            Line([1.0, -0.25]),
            Arc([1.25, 0.0], [1.0, 0.0], 1),
            Line([1.25, 1.0]),
            Arc([1.0, 1.25], [1.0, 1.0], 1),
            Line([0.0, 1.25]),
            Line([0.0, 3.0]),
        ],
    );
}

#[test]
fn an_orientation_shifts_all_points() {
    let outcome = completed("g18 g41 d12; g1 z1; x1; z0; g40; z2");
    let first = [Line([0.5, 0.0]), Line([0.5, 0.5]), Line([-0.25, 0.5]), Line([2.0, 1.0])];
    leads(&moves_in(&outcome, |end| [end.z, end.x]), &first);
    let outcome = completed("g18 g41 d20; g0 x1 z2; g1 z-2; x2; g40; x4");
    let found = moves_in(&outcome, |end| [end.z, end.x]);
    leads(&found[2..], &[Line([-2.0, 1.0]), Line([-2.0, 1.75]), Line([-2.0, 4.0])]);
    let outcome = completed("g18 g42 d13; g1 z1; x1; g40; x4");
    let found = moves_in(&outcome, |end| [end.z, end.x]);
    leads(&found[1..2], &[Arc([1.0, 0.25], [0.75, 0.25], 1)]);
    for without in ["g41 d19", "g41 d10", "g41.1 d.5 l0", "g41.1 d.5"] {
        let outcome = completed(&format!("g18 {without}; g1 z1; x1"));
        leads(&moves_in(&outcome, |end| [end.z, end.x])[..1], &[Line([0.75, 0.25])]);
    }
}

#[test]
fn incremental_words_count_from_programmed_points() {
    let absolute = completed("g41.1 d.5; g1 x1; y1; x0; y3; g2 x2 y3 i1; g40; g1 x5");
    let incremental = "g41.1 d.5 g91; g1 x1; y1; x-1; y2; g2 x2 i1; g40; g1 x3";
    leads(&moves(&completed(incremental)), &moves(&absolute));
    let polar = completed("g41.1 d.5; g1 x1 y1; y2; @3; g40; g1 x9");
    leads(&moves(&polar)[3..], &[Line([1.118_034, 2.795_085]), Line([9.0, 2.683_281_6])]);
}

#[test]
fn the_length_unit_may_change_on_the_way() {
    let outcome = completed("g41.1 d.5; g1 x1; g21; g1 y25.4 f10; x0; g20; g1 y0 f10; g40; x2");
    leads(
        &moves(&outcome),
        &[
            Line([0.75, 0.25]),
            Line([19.05, 19.05]),
            Line([6.35, 19.05]),
            Line([0.25, 0.0]),
            Line([2.0, 0.0]),
        ],
    );
}

#[test]
fn a_joining_move_keeps_the_height_and_turns_rotary_axes() {
    let outcome = completed("g41.1 d.5; g1 x1; y1 z1 a10; x2 z2 a20");
    let ends: Vec<_> =
        feed_ends(&outcome).iter().map(|(line, end)| (*line, end.z, end.a)).collect();
    assert_eq!(ends, [(3, 0.0, 0.0), (4, 1.0, 10.0), (5, 1.0, 20.0), (5, 2.0, 20.0)]);
}

/// The last position that is recorded up to a line.
fn position_after(blocks: &str, line: u32) -> Position {
    let outcome = completed(blocks);
    let steps = outcome.steps.iter().take_while(|step| step.block.line <= line);
    let positions = steps.filter_map(|step| match &step.state {
        Some(State::Rs274(state)) => state.position,
        Some(State::Nct(_) | State::Gpp(_)) | None => None,
    });
    positions.last().expect("a move changes the position")
}

#[test]
fn the_position_is_the_end_without_an_inner_corner() {
    let blocks = "g41.1 d.5; g1 x1; y1; x0; g40; x2";
    let at = |x, y| Position { x, y, ..Position::default() };
    assert_eq!(position_after(blocks, 3), at(1.0, 0.25));
    assert_eq!(position_after(blocks, 4), at(0.75, 1.0));
    assert_eq!(position_after(blocks, 5), at(0.0, 0.75));
    assert_eq!(position_after(blocks, 6), at(0.0, 1.0));
    assert_eq!(
        position_after("g18 g41 d12; g1 z1; x1", 3),
        Position { x: 0.25, z: 1.0, ..Position::default() }
    );
}

#[test]
fn after_g40_even_a_move_without_a_way_leads_to_the_programmed_point() {
    let observed = [("rs274.compensation-exit-length", "observed")];
    let outcome = outcome_under(&observed, "g41.1 d.5; g1 x1; y1; g40; y1; g2 x3 i1; m2");
    leads(
        &moves(&outcome),
        &[Line([0.75, 0.25]), Line([0.75, 1.0]), Line([1.0, 1.0]), Arc([3.0, 1.0], [2.0, 1.0], -1)],
    );
}

#[test]
fn a_new_entry_may_follow_g40_at_once() {
    makes(
        "g41.1 d.5; g1 x1; y1; g40; g41.1 d.5; g1 x3; g2 x4 y0 j-1; g40; g1 x5",
        &[
            Line([0.75, 0.25]),
            Line([0.75, 1.0]),
            Line([3.0, 1.25]),
            Arc([4.25, 0.0], [3.0, 0.0], -1),
            Line([5.0, 0.0]),
        ],
    );
}
