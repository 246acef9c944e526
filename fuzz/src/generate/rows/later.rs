//! What model or production may still end as unsupported. Each row is ready; [`Kind::is_later`] says which kinds only
//! some programs use.

use super::super::table::{Kind, Row};

pub(in super::super) const ROWS: &[Row] = &[
    Row::when(
        "arc.centre",
        Kind::Arc,
        14,
        |s| s.feed && s.per_minute && s.xy_plane,
        |w| {
            // A half circle, whichever distance mode applies.
            w.block("g17 g90 g91.1 g0 x0 y0");
            let (code, radius) = (*w.dice.pick(&["g2", "g3"]), *w.dice.pick(&["1", "2.5", "10"]));
            let z = if w.dice.chance(25) { " z1" } else { "" };
            w.block(format!("{code} x[2*{radius}] y0 i{radius} j0{z}"));
            w.state.moving = false;
        },
    ),
    Row::when(
        "arc.radius",
        Kind::Arc,
        10,
        |s| s.feed && s.per_minute && s.xy_plane,
        |w| {
            w.block("g17 g90 g0 x0 y0");
            let code = *w.dice.pick(&["g2", "g3"]);
            // Half of the way is 2.5: one radius is too small for it by a rounding.
            let radius = if w.dice.chance(20) { "2.4999" } else { *w.dice.pick(&["5", "-5", "8"]) };
            w.block(format!("{code} x3 y4 r{radius}"));
            w.state.moving = false;
        },
    ),
    Row::when(
        "arc.full-circle",
        Kind::Arc,
        5,
        |s| s.feed && s.per_minute,
        |w| {
            w.block("g17 g90 g91.1");
            let words = match w.dice.below(20) {
                0..=4 => "i2 j0 p0",
                5..=10 => "i0 j0",
                _ => *w.dice.pick(&["i2 j0", "i2 j0 p2", "i2 j0 p1"]),
            };
            w.block(format!("g2 {words}"));
            w.state.moving = false;
        },
    ),
    Row::when(
        "cycle.drill",
        Kind::Cycle,
        12,
        |s| s.feed && s.per_minute,
        |w| {
            w.block("g17 g90 g0 z10");
            let code =
                *w.dice.pick(&["g81", "g82 p0.5", "g83 q1", "g73 q1", "g85", "g86 p0.5", "g89 p1"]);
            let (plane, times) = (*w.dice.pick(&["5", "2.5"]), *w.dice.pick(&["", " l2"]));
            let retract = *w.dice.pick(&["", "g98 ", "g99 "]);
            w.block(format!("{retract}{code} x1 y2 z-3 r{plane}{times}"));
            if w.dice.chance(50) {
                w.block("x4");
            }
            w.block("g80");
            w.state.moving = false;
        },
    ),
    Row::when(
        "probe",
        Kind::Probe,
        8,
        |s| s.feed && s.per_minute,
        |w| {
            let code = *w.dice.pick(&["g38.2", "g38.3", "g38.4", "g38.5"]);
            let inverse = w.dice.chance(10);
            if inverse {
                w.block(format!("g93 {code} z[#<_z> - 10] f2"));
                w.block("g94 f100");
            } else {
                w.block(format!("{code} z[#<_z> - 10]"));
            }
            w.block("#31 = #5070");
            w.block("#32 = #5063");
            w.state.moving = false;
        },
    ),
    Row::when(
        "compensation",
        Kind::Compensation,
        8,
        |s| s.feed && s.per_minute && s.xy_plane,
        |w| {
            w.block("g17 g90 g40 g0 x-20 y0");
            let code = *w.dice.pick(&["g41.1 d2", "g42.1 d2", "g41.1 d3.5"]);
            w.block(code);
            w.block("g1 x0 y0");
            w.block("x20");
            w.block("y20");
            w.block("g40");
            w.block("g0 x40 y40");
            w.moves(true);
        },
    ),
    Row::when(
        "compensation.standing",
        Kind::Compensation,
        13,
        |s| s.io > 0 && s.xy_plane,
        |w| {
            // Without a move in between there is no path to compensate.
            w.block("g17 g40");
            w.block("g41.1 d2");
            let tools = w.state.tools.clone();
            let tool = if tools.is_empty() { 0 } else { *w.dice.pick(&tools) };
            let words = match w.dice.below(7) {
                0 => "m66 p0".to_owned(),
                1 => (*w.dice.pick(&["m62 p0", "m65 p0", "m68 e0 q1"])).to_owned(),
                2 => (*w.dice.pick(&["g43.1 z1", "g49"])).to_owned(),
                3 => "g18".to_owned(),
                4 => "g10 l2 p1 x1".to_owned(),
                5 => format!("t{tool} m6"),
                _ => format!("g43 h{tool}"),
            };
            w.block(&words);
            w.block("g40");
            w.state.xy_plane = words != "g18";
        },
    ),
    Row::any("predefined.go", Kind::Predefined, 8, |w| {
        let code = *w.dice.pick(&["g28", "g30"]);
        let axes = if w.dice.chance(50) { w.axes(2) } else { String::new() };
        w.block(format!("{code}{axes}"));
    }),
    Row::any("predefined.set", Kind::Predefined, 8, |w| {
        let code = *w.dice.pick(&["g28.1", "g30.1"]);
        w.block(code);
    }),
    Row::any("axis-offset.set", Kind::AxisOffset, 14, |w| {
        let (code, axes) = (*w.dice.pick(&["g92", "g52"]), w.axes(3));
        w.block(format!("{code}{axes}"));
    }),
    Row::any("axis-offset.cancel", Kind::AxisOffset, 8, |w| {
        let code = *w.dice.pick(&["g92.1", "g92.2", "g92.3"]);
        w.block(code);
    }),
    Row::when(
        "tool-table",
        Kind::ToolTable,
        8,
        |s| !s.tools.is_empty(),
        |w| {
            let tools = w.state.tools.clone();
            let (kind, tool) = (*w.dice.pick(&["1", "10", "11"]), *w.dice.pick(&tools));
            if w.dice.chance(20) {
                w.block(format!("g10 l1 p{tool}"));
                return;
            }
            let axes = w.axes(2);
            let radius = if w.dice.chance(30) { " r2" } else { "" };
            w.block(format!("g10 l{kind} p{tool}{axes}{radius}"));
        },
    ),
    Row::any("offset.calculated", Kind::ToolTable, 8, |w| {
        let (system, axes) = (w.whole(0, 9), w.axes(3));
        w.block(format!("g10 l20 p{system}{axes}"));
    }),
    Row::when(
        "synchronised.move",
        Kind::Synchronised,
        6,
        |s| s.turning,
        |w| {
            let code = *w.dice.pick(&["g33", "g33.1"]);
            w.block(format!("{code} z-5 k1.5"));
            w.state.moving = false;
        },
    ),
    Row::when(
        "synchronised.thread",
        Kind::Synchronised,
        4,
        |s| s.turning,
        |w| {
            w.block("g18 g90 g0 x20 z0");
            w.block("g76 p1.5 z-20 i-2 j0.5 k2 q29.5 h2");
            w.state.moving = false;
        },
    ),
    Row::when(
        "spline",
        Kind::Spline,
        6,
        |s| s.feed && s.per_minute && s.xy_plane,
        |w| {
            w.block("g17 g90 g0 x0 y0");
            let words = *w.dice.pick(&["g5 i0 j3 p0 q-3 x1 y1", "g5.1 x2 y0 i1 j2"]);
            w.block(words);
            w.state.moving = false;
        },
    ),
    Row::any("polar", Kind::Polar, 6, |w| {
        let (distance, angle) = (w.within(1, 20), w.within(0, 359));
        w.block("g17 g90 g0 x1 y1");
        w.block(format!("g0 @{distance} ^{angle}"));
        w.moves(true);
    }),
];
