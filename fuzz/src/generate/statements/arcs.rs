//! Arcs, splines and polar words.

use super::super::kind::StatementKind;
use super::super::state::State;
use super::super::writer::Statement;

pub(in super::super) const STATEMENTS: &[Statement] = &[
    Statement::when(
        "arc.centre",
        StatementKind::Arc,
        14,
        |s| s.feed && s.per_minute && s.xy_plane && s.has_xy(),
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
        |s| s.feed && s.per_minute && s.xy_plane && s.has_xy(),
        |w| {
            w.block("g17 g90 g0 x0 y0");
            let code = *w.entropy.pick(&["g2", "g3"]);
            // Half of the way is 2.5: one radius is too small for it by a rounding.
            let radius =
                if w.entropy.chance(6) { "2.4999" } else { *w.entropy.pick(&["5", "-5", "8"]) };
            w.block(format!("{code} x3 y4 r{radius}"));
            w.state.moving = false;
        },
    ),
    Statement::when(
        "arc.full-circle",
        StatementKind::Arc,
        5,
        |s| s.feed && s.per_minute && s.has_xy(),
        |w| {
            w.block("g17 g90 g91.1");
            let words = match w.entropy.below(20) {
                0 => "i2 j0 p0",
                1 => "i0 j0",
                _ => *w.entropy.pick(&["i2 j0", "i2 j0 p2", "i2 j0 p1"]),
            };
            w.block(format!("g2 {words}"));
            w.state.moving = false;
        },
    ),
    Statement::when(
        "spline",
        StatementKind::Spline,
        24,
        |s| s.feed && s.per_minute && s.xy_plane && s.has_xy(),
        |w| {
            w.block("g17 g90 g0 x0 y0");
            let words = *w.entropy.pick(&["g5 i0 j3 p0 q-3 x1 y1", "g5.1 x2 y0 i1 j2"]);
            w.block(words);
            w.state.moving = false;
        },
    ),
    Statement::when(
        "arc.plane",
        StatementKind::Arc,
        5,
        |s| s.feed && s.per_minute && s.xy_plane && s.has_xy(),
        |w| {
            let (plane, end, centre) =
                *w.entropy.pick(&[("g18", "x2 z0", "i1 k0"), ("g19", "y2 z0", "j1 k0")]);
            let code = *w.entropy.pick(&["g2", "g3"]);
            let third = *w.entropy.pick(&["", " p2"]);
            // The centre is the same, from the start or absolute.
            let distance = *w.entropy.pick(&["g90.1", "g91.1"]);
            w.block(format!("{plane} g90 {distance} g0 x0 y0 z0"));
            w.block(format!("{code} {end} {centre}{third}"));
            w.block("g17");
            w.state.moving = false;
        },
    ),
    Statement::when(
        "spline.nurbs",
        StatementKind::Spline,
        8,
        |s| s.feed && s.per_minute && s.xy_plane && s.has_xy(),
        |w| {
            w.block("g17 g90 g0 x0 y0");
            let order = *w.entropy.pick(&["", " l2", " l3"]);
            let weight = *w.entropy.pick(&["1", "2", "0.5"]);
            w.block(format!("g5.2 p1{order} x0 y1"));
            w.block(format!("x2 y2 p{weight}"));
            w.block("x2 y0 p1");
            w.block("g5.3");
            w.state.moving = false;
        },
    ),
    Statement::when("polar", StatementKind::Polar, 8, State::has_xy, |w| {
        let (distance, angle) = (w.within(1, 20), w.within(0, 359));
        w.block("g17 g90 g0 x1 y1");
        w.block(format!("g0 @{distance} ^{angle}"));
        w.moves(true);
    }),
];
