//! What waits for the next move, where it is recorded, and what is lost.

use super::Move::{Arc, Line};
use super::{completed, effects, feed_ends, leads, moves, outcome};
use gaugeblock_vocabulary::Outcome;

/// The names of the effects with the lines of their blocks.
fn names(outcome: &Outcome) -> Vec<(u32, &'static str)> {
    effects(outcome).iter().map(|(line, effect)| (*line, effect.name())).collect()
}

#[test]
fn the_intersection_ends_moves_out_of_the_plane_too() {
    let outcome = completed("g41.1 d.5; g1 x1; y1; z1; g4 p1; (msg,hello); z2 y1; a5; x0; g40");
    let ends = feed_ends(&outcome).into_iter();
    let ends: Vec<_> = ends.map(|(line, end)| (line, end.x, end.y, end.z, end.a)).collect();
    assert_eq!(
        ends,
        [
            (3, 0.75, 0.25, 0.0, 0.0),
            (4, 0.75, 0.75, 0.0, 0.0),
            (5, 0.75, 0.75, 1.0, 0.0),
            (8, 0.75, 0.75, 2.0, 0.0),
            (9, 0.75, 0.75, 2.0, 5.0),
            (10, 0.0, 0.75, 2.0, 5.0),
        ]
    );
}

#[test]
fn an_intersection_counts_in_the_unit_of_each_block() {
    let outcome = completed("g41.1 d.5; g1 x1; y1; z1; g21; g1 z50.8 f10; x0; g40");
    let found = moves(&outcome);
    leads(&found[1..4], &[Line([0.75, 0.75]), Line([0.75, 0.75]), Line([19.05, 19.05])]);
}

#[test]
fn an_error_loses_what_waits() {
    let outcome = outcome("g41.1 d.5; g1 x1; y1; z1; g4 p1; (msg,hello); f20; t10; g28; m2");
    assert_eq!(
        names(&outcome),
        [(3, "straight_feed"), (7, "message"), (9, "prepare_tool")],
        "{}",
        outcome.to_text()
    );
    leads(&moves(&outcome), &[Line([0.75, 0.25])]);
}

#[test]
fn a_percent_sign_loses_what_waits() {
    let scenario = gaugeblock_vocabulary::Scenario {
        machine: super::machine(),
        ..gaugeblock_vocabulary::Scenario::of("%\ng20 f10\ng41.1 d.5\ng1 x1\ny1\n%\n")
    };
    let (outcome, _) = gaugeblock_reference::run(&scenario);
    leads(&moves(&outcome), &[Line([0.75, 0.25])]);
}

#[test]
fn the_end_and_pauses_put_it_out() {
    for end in ["g40", "m0", "m1", "m60", "m2", "m30"] {
        let outcome = outcome(&format!("g41.1 d.5; g1 x1; y1; z1; {end}; o5"));
        leads(&moves(&outcome), &[Line([0.75, 0.25]), Line([0.75, 1.0]), Line([0.75, 1.0])]);
    }
}

#[test]
fn a_line_after_a_pause_begins_where_the_tool_is() {
    let outcome = completed("g41.1 d.5; g1 x1; y1; m1; x0; m1; y0.1; x-1; g40; x2");
    leads(
        &moves(&outcome),
        &[
            Line([0.75, 0.25]),
            Line([0.75, 1.0]),
            Line([0.0, 0.75]),
            Line([0.25, 0.1]),
            Arc([0.0, -0.15], [0.0, 0.1], -1),
            Line([-1.0, -0.15]),
            Line([2.0, 0.1]),
        ],
    );
}

#[test]
fn a_joining_move_belongs_to_the_block_after_the_corner() {
    let outcome = completed("g41.1 d.5; g1 x1; y1; (msg,one); z1; x3");
    assert_eq!(
        names(&outcome)[..6],
        [
            (3, "straight_feed"),
            (4, "straight_feed"),
            (5, "message"),
            (6, "straight_feed"),
            (7, "arc_feed"),
            (7, "straight_feed"),
        ]
    );
}

#[test]
fn a_line_right_after_a_pause_need_not_fit() {
    let outcome = completed("g42.1 d-1; g1 x-1; m1; y-.25; y1.25; g40; x0 y0");
    let expected = [
        Line([-1.0, -0.5]),
        Line([-0.5, -0.25]),
        Arc([-1.5, -0.25], [-1.0, -0.25], -1),
        Line([-1.5, 1.25]),
        Line([0.0, 0.0]),
    ];
    leads(&moves(&outcome), &expected);
}
