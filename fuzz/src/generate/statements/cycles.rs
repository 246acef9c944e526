//! Canned cycles, probing, spindle-synchronised motion and threads.

use super::super::kind::StatementKind;
use super::super::writer::Statement;

pub(in super::super) const STATEMENTS: &[Statement] = &[
    Statement::when(
        "cycle.drill",
        StatementKind::Cycle,
        12,
        |s| s.feed && s.per_minute && s.has_xy(),
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
        "cycle.tap",
        StatementKind::Cycle,
        5,
        |s| s.feed && s.per_minute && s.has_xy(),
        |w| {
            w.starts_spindle();
            w.block("g17 g90 g0 z10");
            // Against the direction of the spindle a cycle faults.
            let code = if w.entropy.chance(90) { "g84" } else { "g74" };
            let direction = if w.entropy.chance(30) { ("m4", "g74") } else { ("m3", code) };
            w.block(direction.0);
            w.block(format!("{} x1 y2 z-3 r5", direction.1));
            w.block("g80");
            w.state.moving = false;
        },
    ),
    Statement::when(
        "cycle.plane",
        StatementKind::Cycle,
        5,
        |s| s.feed && s.per_minute && s.xy_plane && s.has_xy(),
        |w| {
            let (plane, along) = *w.entropy.pick(&[("g18", "x1 z2 y-3"), ("g19", "y1 z2 x-3")]);
            let code = *w.entropy.pick(&["g81", "g82 p0.5", "g83 q1", "g89 p1"]);
            let distance = *w.entropy.pick(&["g90", "g91"]);
            w.block(format!("{plane} g90 g0 x10 y10 z10"));
            w.block(format!("{distance} {code} {along} r5"));
            w.block("g80");
            w.block("g17 g90");
            w.state.moving = false;
        },
    ),
    Statement::when(
        "probe",
        StatementKind::Probe,
        14,
        |s| s.feed && s.per_minute,
        |w| {
            // Where nothing has been touched before, moving away faults, or does not move.
            let code = match w.entropy.below(40) {
                0..=2 => "g38.4",
                3..=5 => "g38.5",
                6..=9 => "g38.2",
                _ => "g38.3",
            };
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
    Statement::any("synchronised.move", StatementKind::Synchronised, 6, |w| {
        w.starts_spindle();
        let code = *w.entropy.pick(&["g33", "g33.1"]);
        w.block(format!("{code} z-5 k1.5"));
        w.state.moving = false;
    }),
    Statement::any("synchronised.thread", StatementKind::Synchronised, 4, |w| {
        w.starts_spindle();
        w.block("g18 g90 g0 x20 z0");
        w.block("g76 p1.5 z-20 i-2 j0.5 k2 q29.5 h2");
        w.state.moving = false;
    }),
];
