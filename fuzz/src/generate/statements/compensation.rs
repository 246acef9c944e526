//! Cutter compensation, and contours under it.

use super::super::kind::StatementKind;
use super::super::state::State;
use super::super::writer::{Statement, Writer};

pub(in super::super) const STATEMENTS: &[Statement] = &[
    Statement::when("compensation.move", StatementKind::CompensatedMove, 40, State::has_xy, |w| {
        w.block("g17 g90 g94 f100 g40 g0 x-20 y0");
        let code = *w.entropy.pick(&["g41.1 d2", "g42.1 d2", "g41.1 d3.5"]);
        w.block(code);
        w.block("g1 x0 y0");
        w.block("x20");
        w.block("y20");
        w.block("g40");
        w.block("g0 x40 y40");
        w.moves(true);
    }),
    Statement::when(
        "compensation.contour",
        StatementKind::CompensatedMove,
        120,
        State::has_xy,
        |w| {
            contour(w, &XY);
        },
    ),
    Statement::when(
        "compensation.lathe",
        StatementKind::CompensatedMove,
        40,
        |state| state.has_xy() && state.axes.contains(&"z"),
        |w| contour(w, &ZX),
    ),
    Statement::when(
        "compensation.without-move",
        StatementKind::Compensation,
        13,
        |s| s.io > 0 && s.xy_plane,
        |w| {
            // Without a move in between there is no path to compensate.
            w.block("g17 g40");
            let tools = w.state.tools.clone();
            let of_tool = w.entropy.chance(30) && !tools.is_empty();
            let code = if of_tool {
                format!("{} d{}", w.entropy.pick(&["g41", "g42"]), w.entropy.pick(&tools))
            } else {
                (*w.entropy.pick(&["g41.1 d2", "g42.1 d1"])).to_owned()
            };
            w.block(code);
            let tool = if tools.is_empty() { 0 } else { *w.entropy.pick(&tools) };
            let words = match w.entropy.below(24) {
                0 => "m66 p0".to_owned(),
                1 => (*w.entropy.pick(&["m62 p0", "m65 p0", "m68 e0 q1"])).to_owned(),
                2 => (*w.entropy.pick(&["g43.1 z1", "g49"])).to_owned(),
                3 => "g18".to_owned(),
                4 => "g10 l2 p1 x1".to_owned(),
                5 => format!("t{tool} m6"),
                6 => format!("g43 h{tool}"),
                // Most choices of the documents refuse the words above.
                _ => (*w.entropy.pick(&["m8", "g4 p0.1", "f100", "s100", "g61"])).to_owned(),
            };
            w.block(&words);
            w.block("g40");
            // The move after G40 is longer than the tool's diameter, or in most programs it is refused.
            if w.state.has_xy() && w.entropy.chance(95) {
                w.block("g91 g0 x-50 y30");
                w.block("g90");
                w.moves(true);
            }
            w.state.xy_plane = words != "g18";
        },
    ),
];

/// A plane: its code, its axes, and the offsets of arcs.
struct Plane {
    code: &'static str,
    axes: [&'static str; 2],
    offsets: [&'static str; 2],
}

const XY: Plane = Plane { code: "g17", axes: ["x", "y"], offsets: ["i", "j"] };
const ZX: Plane = Plane { code: "g18", axes: ["z", "x"], offsets: ["k", "i"] };

/// A contour of lines and arcs on a grid, wide enough for most of its cutters.
fn contour(w: &mut Writer<'_, '_>, plane: &Plane) {
    let [first, second] = plane.axes;
    w.block(format!("{} g90 g91.1 g94 f100 g40 g0 {first}-24 {second}0", plane.code));
    let code = *w.entropy.pick(&["g41.1", "g42.1"]);
    let diameter = *w.entropy.pick(&["2", "2", "3.5", "1", "5", "0", "-2"]);
    let orientation = match w.entropy.below(12) {
        number @ 0..=9 if plane.code == "g18" && w.entropy.chance(50) => format!(" l{number}"),
        _ => String::new(),
    };
    w.block(format!("{code} d{diameter}{orientation}"));
    let mut at = [0, 0];
    let entry = if w.entropy.chance(15) { "g0" } else { "g1" };
    if w.entropy.chance(12) {
        // A half circle onto the contour.
        let code = *w.entropy.pick(&["g2", "g3"]);
        let [one, other] = plane.offsets;
        w.block(format!("{code} {first}0 {second}0 {one}12 {other}0"));
    } else {
        w.block(format!("{entry} {first}0 {second}0"));
    }
    for _ in 0..w.entropy.range(1, 7) {
        if w.entropy.chance(25) {
            let word = between(w);
            w.block(word);
        }
        at = if w.entropy.chance(35) { arc(w, plane, at) } else { line(w, plane, at) };
    }
    // Most exits are long lines: an arc is refused, and so is a move that is too short.
    match w.entropy.below(24) {
        0 => {}
        1 => w.block(format!("g40 g0 {first}40 {second}40")),
        2 => {
            w.block("g40");
            w.block(format!("g2 {first}40 {second}0 {}20 {}0", plane.offsets[0], plane.offsets[1]));
        }
        _ => {
            w.block("g40");
            w.block(format!("g0 {first}40 {second}40"));
        }
    }
    w.block("g17 g90 g94 f100");
    w.state.xy_plane = true;
    w.moves(true);
}

/// A line to a point of the grid; few lead back, or nowhere.
fn line(w: &mut Writer<'_, '_>, plane: &Plane, at: [i32; 2]) -> [i32; 2] {
    let step = |w: &mut Writer<'_, '_>| *w.entropy.pick(&[-12, -8, -4, 0, 4, 8, 12, 20]);
    let to = [at[0] + step(w), at[1] + step(w)];
    let [first, second] = plane.axes;
    let code = if w.entropy.chance(8) { "g0" } else { "g1" };
    w.block(format!("{code} {first}{} {second}{}", to[0], to[1]));
    to
}

/// A quarter, half or three quarters of a circle, or all of it.
fn arc(w: &mut Writer<'_, '_>, plane: &Plane, at: [i32; 2]) -> [i32; 2] {
    let [one, other] =
        *w.entropy.pick(&[[4, 0], [-4, 0], [0, 4], [0, -8], [8, 0], [3, 4], [-6, 8]]);
    let centre = [at[0] + one, at[1] + other];
    let from = [at[0] - centre[0], at[1] - centre[1]];
    let to = match w.entropy.below(8) {
        0..=2 => [-from[1], from[0]],
        3..=5 => [from[1], -from[0]],
        6 => from,
        _ => [-from[0], -from[1]],
    };
    let to = [centre[0] + to[0], centre[1] + to[1]];
    let code = *w.entropy.pick(&["g2", "g3"]);
    let ([first, second], [i, j]) = (plane.axes, plane.offsets);
    w.block(format!("{code} {first}{} {second}{} {i}{one} {j}{other}", to[0], to[1]));
    to
}

/// Blocks that wait with the move before them.
const WAITS: &[&str] =
    &["f50", "s200", "m3 s100", "m5", "m8", "m9", "g4 p0.1", "m19 r0", "(a comment)"];

/// Blocks that do not.
const PASSES: &[&str] = &["(msg,between)", "t1", "g21", "g91 g90", "g97", "#31=5", "g80"];

/// Blocks that put out what waits, or are refused.
const RARE: &[&str] =
    &["m0", "m1", "m60", "g20", "g93 f2", "g61", "g92 x0", "m70", "m72", "g54", "g28", "m66 p0"];

/// A block that leads nowhere in the plane, or one that compensation may refuse.
fn between(w: &mut Writer<'_, '_>) -> &'static str {
    let words = match w.entropy.below(20) {
        0..=9 => WAITS,
        10..=17 => PASSES,
        _ => RARE,
    };
    w.entropy.pick::<&str>(words)
}
