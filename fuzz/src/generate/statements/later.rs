//! Statements that model or production may end as unsupported. [`StatementKind::is_later`] says which kinds only
//! some programs use.

use super::super::table::{Statement, StatementKind};

pub(in super::super) const STATEMENTS: &[Statement] = &[
    Statement::when(
        "arc.centre",
        StatementKind::Arc,
        14,
        |s| s.feed && s.per_minute && s.xy_plane,
        |w| {
            // A half circle, whichever distance mode applies.
            w.block("g17 g90 g91.1 g0 x0 y0");
            let (code, radius) =
                (*w.entropy.pick(&["g2", "g3"]), *w.entropy.pick(&["1", "2.5", "10"]));
            let z = if w.entropy.chance(25) { " z1" } else { "" };
            w.block(format!("{code} x[2*{radius}] y0 i{radius} j0{z}"));
            w.state.moving = false;
        },
    ),
    Statement::when(
        "arc.radius",
        StatementKind::Arc,
        10,
        |s| s.feed && s.per_minute && s.xy_plane,
        |w| {
            w.block("g17 g90 g0 x0 y0");
            let code = *w.entropy.pick(&["g2", "g3"]);
            // Half of the way is 2.5: one radius is too small for it by a rounding.
            let radius =
                if w.entropy.chance(20) { "2.4999" } else { *w.entropy.pick(&["5", "-5", "8"]) };
            w.block(format!("{code} x3 y4 r{radius}"));
            w.state.moving = false;
        },
    ),
    Statement::when(
        "arc.full-circle",
        StatementKind::Arc,
        5,
        |s| s.feed && s.per_minute,
        |w| {
            w.block("g17 g90 g91.1");
            let words = match w.entropy.below(20) {
                0..=4 => "i2 j0 p0",
                5..=10 => "i0 j0",
                _ => *w.entropy.pick(&["i2 j0", "i2 j0 p2", "i2 j0 p1"]),
            };
            w.block(format!("g2 {words}"));
            w.state.moving = false;
        },
    ),
    Statement::when(
        "cycle.drill",
        StatementKind::Cycle,
        12,
        |s| s.feed && s.per_minute,
        |w| {
            w.block("g17 g90 g0 z10");
            let code = *w
                .entropy
                .pick(&["g81", "g82 p0.5", "g83 q1", "g73 q1", "g85", "g86 p0.5", "g89 p1"]);
            let (plane, times) = (*w.entropy.pick(&["5", "2.5"]), *w.entropy.pick(&["", " l2"]));
            let retract = *w.entropy.pick(&["", "g98 ", "g99 "]);
            w.block(format!("{retract}{code} x1 y2 z-3 r{plane}{times}"));
            if w.entropy.chance(50) {
                w.block("x4");
            }
            w.block("g80");
            w.state.moving = false;
        },
    ),
    Statement::when(
        "probe",
        StatementKind::Probe,
        8,
        |s| s.feed && s.per_minute,
        |w| {
            let code = *w.entropy.pick(&["g38.2", "g38.3", "g38.4", "g38.5"]);
            let inverse = w.entropy.chance(10);
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
    Statement::when(
        "compensation",
        StatementKind::Compensation,
        8,
        |s| s.feed && s.per_minute && s.xy_plane,
        |w| {
            w.block("g17 g90 g40 g0 x-20 y0");
            let code = *w.entropy.pick(&["g41.1 d2", "g42.1 d2", "g41.1 d3.5"]);
            w.block(code);
            w.block("g1 x0 y0");
            w.block("x20");
            w.block("y20");
            w.block("g40");
            w.block("g0 x40 y40");
            w.moves(true);
        },
    ),
    Statement::when(
        "compensation.standing",
        StatementKind::Compensation,
        13,
        |s| s.io > 0 && s.xy_plane,
        |w| {
            // Without a move in between there is no path to compensate.
            w.block("g17 g40");
            w.block("g41.1 d2");
            let tools = w.state.tools.clone();
            let tool = if tools.is_empty() { 0 } else { *w.entropy.pick(&tools) };
            let words = match w.entropy.below(7) {
                0 => "m66 p0".to_owned(),
                1 => (*w.entropy.pick(&["m62 p0", "m65 p0", "m68 e0 q1"])).to_owned(),
                2 => (*w.entropy.pick(&["g43.1 z1", "g49"])).to_owned(),
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
    Statement::any("predefined.go", StatementKind::Predefined, 8, |w| {
        let code = *w.entropy.pick(&["g28", "g30"]);
        let axes = if w.entropy.chance(50) { w.axes(2) } else { String::new() };
        w.block(format!("{code}{axes}"));
    }),
    Statement::any("predefined.set", StatementKind::Predefined, 8, |w| {
        let code = *w.entropy.pick(&["g28.1", "g30.1"]);
        w.block(code);
    }),
    Statement::any("axis-offset.set", StatementKind::AxisOffset, 14, |w| {
        let (code, axes) = (*w.entropy.pick(&["g92", "g52"]), w.axes(3));
        w.block(format!("{code}{axes}"));
    }),
    Statement::any("axis-offset.cancel", StatementKind::AxisOffset, 8, |w| {
        let code = *w.entropy.pick(&["g92.1", "g92.2", "g92.3"]);
        w.block(code);
    }),
    Statement::when(
        "tool-table",
        StatementKind::ToolTable,
        8,
        |s| !s.tools.is_empty(),
        |w| {
            let tools = w.state.tools.clone();
            let (kind, tool) = (*w.entropy.pick(&["1", "10", "11"]), *w.entropy.pick(&tools));
            if w.entropy.chance(20) {
                w.block(format!("g10 l1 p{tool}"));
                return;
            }
            let axes = w.axes(2);
            let radius = if w.entropy.chance(30) { " r2" } else { "" };
            w.block(format!("g10 l{kind} p{tool}{axes}{radius}"));
        },
    ),
    Statement::any("offset.calculated", StatementKind::ToolTable, 8, |w| {
        let (system, axes) = (w.whole(0, 9), w.axes(3));
        w.block(format!("g10 l20 p{system}{axes}"));
    }),
    Statement::when(
        "synchronised.move",
        StatementKind::Synchronised,
        6,
        |s| s.turning,
        |w| {
            let code = *w.entropy.pick(&["g33", "g33.1"]);
            w.block(format!("{code} z-5 k1.5"));
            w.state.moving = false;
        },
    ),
    Statement::when(
        "synchronised.thread",
        StatementKind::Synchronised,
        4,
        |s| s.turning,
        |w| {
            w.block("g18 g90 g0 x20 z0");
            w.block("g76 p1.5 z-20 i-2 j0.5 k2 q29.5 h2");
            w.state.moving = false;
        },
    ),
    Statement::when(
        "spline",
        StatementKind::Spline,
        6,
        |s| s.feed && s.per_minute && s.xy_plane,
        |w| {
            w.block("g17 g90 g0 x0 y0");
            let words = *w.entropy.pick(&["g5 i0 j3 p0 q-3 x1 y1", "g5.1 x2 y0 i1 j2"]);
            w.block(words);
            w.state.moving = false;
        },
    ),
    Statement::any("polar", StatementKind::Polar, 6, |w| {
        let (distance, angle) = (w.within(1, 20), w.within(0, 359));
        w.block("g17 g90 g0 x1 y1");
        w.block(format!("g0 @{distance} ^{angle}"));
        w.moves(true);
    }),
];
