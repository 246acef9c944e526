//! Lathe cycles, with their profiles as subs.

use super::super::kind::StatementKind;
use super::super::state::State;
use super::super::writer::{Statement, Writer};

pub(in super::super) const STATEMENTS: &[Statement] = &[
    Statement::when("turning.finish", StatementKind::Turning, 30, is_possible, |w| {
        let axes = *w.entropy.pick(&[&ALONG_Z, &ALONG_X]);
        let passes =
            *w.entropy.pick(&["", "", " p1", " p2", " p2.5 d1", " p3 d2 e0.5", " e0.5", " e-1"]);
        let label = profile(w, axes, !passes.contains(['d', 'e']));
        cut(w, axes, &format!("g70 q{label}{passes}"));
    }),
    Statement::when("turning.rough", StatementKind::Turning, 70, is_possible, |w| {
        let (code, axes) = *w.entropy.pick(&[
            ("g71", &ALONG_Z),
            ("g71.1", &ALONG_Z),
            ("g71.2", &ALONG_Z),
            ("g72", &ALONG_X),
            ("g72.1", &ALONG_X),
            ("g72.2", &ALONG_X),
        ]);
        let distance = *w.entropy.pick(&["", "", "", " d0.5", " d0.25"]);
        let label = profile(w, axes, distance.is_empty());
        let increment = *w.entropy.pick(&[" i5", " i8", " i12.5", " i9", ""]);
        let retract = *w.entropy.pick(&["", " r0.25", " r2", " r0"]);
        cut(w, axes, &format!("{code} q{label}{increment}{retract}{distance}"));
    }),
];

/// Subs are defined in the main program only.
fn is_possible(state: &State) -> bool {
    let has = |axis| state.axes.contains(&axis);
    has("x") && has("z") && !state.in_sub && !state.nested
}

/// The axes of a cycle: that of its travel and that of its depth, with the letters of increments and offsets.
struct Axes {
    travel: [&'static str; 3],
    depth: [&'static str; 3],
}

const ALONG_Z: Axes = Axes { travel: ["z", "w", "k"], depth: ["x", "u", "i"] };
const ALONG_X: Axes = Axes { travel: ["x", "u", "i"], depth: ["z", "w", "k"] };

/// Where the tool is before the profile: travel and depth.
const START: [i32; 2] = [2, 60];
/// Where the profile begins.
const FIRST: [i32; 2] = [0, 20];
/// The depth at which it ends, so that no pocket is left open.
const LAST: i32 = 58;

/// A move of a profile: its text, and its displacement if it is a line.
struct Move {
    text: String,
    line: Option<[i32; 2]>,
}

/// Defines the sub of a profile that travels in one direction; its label. It needs G90. Some controllers have arcs, of
/// corners too, only where the cycle has no distance.
fn profile(w: &mut Writer<'_, '_>, axes: &Axes, no_distance: bool) -> u32 {
    let arcs = no_distance || !w.state.no_arcs_at_distance;
    let label = w.new_label();
    w.structure(&format!("o{label} sub"));
    let code = *w.entropy.pick(&["g1 ", "g0 ", ""]);
    w.structure(&format!("{code}{}{} {}{}", axes.travel[0], FIRST[0], axes.depth[0], FIRST[1]));
    let (mut at, mut moves) = (FIRST, Vec::new());
    for _ in 0..w.entropy.range(1, 6) {
        let drawn = if arcs && w.entropy.chance(25) {
            arc(w, axes, &mut at)
        } else {
            line(w, axes, &mut at)
        };
        moves.push(drawn);
    }
    if at[1] < LAST {
        let rise = LAST - at[1];
        moves.push(Move { text: format!("g1 {}{rise}", axes.depth[1]), line: Some([0, rise]) });
    }
    for (place, each) in moves.iter().enumerate() {
        if w.entropy.chance(20) {
            let read = *w.entropy.pick(&["f50", "m8", "g4 p1", "(msg,no)", "s100", "#31=5", "g7"]);
            w.structure(read);
        }
        let next = moves.get(place + 1).and_then(|next| next.line);
        let turns = each.line.zip(next).is_some_and(|(one, other)| is_corner(one, other));
        let rounded = arcs && turns && w.entropy.chance(25);
        let corner = if rounded { *w.entropy.pick(&[" a0.5", " c0.5", " a0.25"]) } else { "" };
        w.structure(&format!("{}{corner}", each.text));
    }
    w.structure(&format!("o{label} endsub"));
    label
}

/// Whether two displacements are not parallel.
fn is_corner(one: [i32; 2], other: [i32; 2]) -> bool {
    one[0] * other[1] != one[1] * other[0]
}

/// A line that travels, or rises.
fn line(w: &mut Writer<'_, '_>, axes: &Axes, at: &mut [i32; 2]) -> Move {
    let travel = *w.entropy.pick(&[0, 4, 8, 8, 12]);
    let rise = *w.entropy.pick(&[2, 4, 6]);
    let depth = match (travel, w.entropy.below(6)) {
        (_, 0) if travel > 0 => 0,
        (_, 1 | 2) if travel > 0 => -rise,
        _ => rise,
    };
    *at = [at[0] - travel, at[1] + depth];
    let text = if w.entropy.chance(20) {
        format!("g1 {}{} {}{depth}", axes.travel[1], -travel, axes.depth[1])
    } else {
        format!("g1 {}{} {}{}", axes.travel[0], at[0], axes.depth[0], at[1])
    };
    Move { text, line: Some([travel, depth]) }
}

/// Parts of circles below their centres, from the first point to the second one: displacements from the centre in the
/// direction of travel and in depth. First quarters, then parts of a half.
const PARTS: &[[[i32; 2]; 2]] = &[
    [[0, -2], [2, 0]],
    [[0, -4], [4, 0]],
    [[0, -6], [6, 0]],
    [[-4, 0], [0, -4]],
    [[-6, 0], [0, -6]],
    [[-4, 0], [4, 0]],
    [[-4, -3], [4, -3]],
    [[-5, 0], [3, -4]],
    [[-3, -4], [5, 0]],
    [[-4, -3], [-3, -4]],
    [[0, -5], [4, -3]],
    [[-8, -6], [6, -8]],
];

/// An arc that goes on in the direction of travel: below its centre, or above it.
fn arc(w: &mut Writer<'_, '_>, axes: &Axes, at: &mut [i32; 2]) -> Move {
    let part = *w.entropy.pick(PARTS);
    let hollow = w.entropy.chance(50);
    let [first, last] = part.map(|[travel, depth]| [-travel, if hollow { depth } else { -depth }]);
    let (from, centre) = (*at, [at[0] - first[0], at[1] - first[1]]);
    let to = [centre[0] + last[0], centre[1] + last[1]];
    let code = if hollow == (axes.travel[0] == "z") { "g2" } else { "g3" };
    *at = to;
    let ([travel, _, k], [depth, _, i]) = (axes.travel, axes.depth);
    let circle = if w.entropy.chance(20) {
        format!("r{}", (first[0] * first[0] + first[1] * first[1]).isqrt())
    } else {
        format!("{k}{} {i}{}", centre[0] - from[0], centre[1] - from[1])
    };
    Move { text: format!("{code} {travel}{} {depth}{} {circle}", to[0], to[1]), line: None }
}

/// Goes to the start and cuts; few cycles go to X and Z themselves.
fn cut(w: &mut Writer<'_, '_>, axes: &Axes, cycle: &str) {
    let ([travel, ..], [depth, ..]) = (axes.travel, axes.depth);
    w.block("g18 g90 g91.1 g94 f100 g8 g40");
    w.block(format!("g0 {travel}{} {depth}{}", START[0], START[1]));
    let to = match w.entropy.below(10) {
        0 => format!(" {travel}3"),
        1 => format!(" {depth}64 {travel}1"),
        _ => String::new(),
    };
    w.block(format!("{cycle}{to}"));
    w.block("g17");
    w.state.xy_plane = true;
    w.state.feed = true;
    w.state.per_minute = true;
    // The last move may be an arc.
    w.state.moving = false;
}
