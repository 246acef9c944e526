//! Arcs and helices: centre format, radius format, planes, turns (11.5.5).

use gaugeblock_vocabulary::FaultKind::{
    AxisWords, BadArc, CompensationActive, Gouging, MissingWord, ModalConflict, NotAnInteger,
    UnknownCode, UnusedWord, WordOutOfRange, ZeroFeed, ZeroSpeed,
};

use super::Expect::{After, Effects, Refused};
use super::{check, check_on, machine};
use crate::math;

/// One arc after a head that gives the feed rate.
fn arc(line: &str, effect: &'static str) {
    check(&alloc::format!("f10; {line}"), Effects(effect));
}

#[test]
fn centre_format() {
    // The examples of 11.5.5.2.
    arc("g2 x1 y1 i1", "2 arc_feed end=(x1 y1) first_centre=1 second_centre=0 turns=-1");
    arc("g2 x0 y1 i1 j0.5", "2 arc_feed end=(y1) first_centre=1 second_centre=0.5 turns=-1");
    check(
        "f1; g0 y1; g3 x0 y0 i1 j-0.5",
        Effects(
            "2 straight_traverse end=(y1); 3 arc_feed end=() first_centre=1 second_centre=0.5 turns=1",
        ),
    );
    // Offsets are from where the arc begins; an axis without a word keeps its coordinate.
    check(
        "f1; g0 x3 y1; g3 x1 i-1",
        Effects(
            "2 straight_traverse end=(x3 y1); 3 arc_feed end=(x1 y1) first_centre=2 second_centre=1 turns=1",
        ),
    );
    check(
        "f1; g91 g0 x3; g3 x-2 i-1",
        Effects(
            "2 straight_traverse end=(x3); 3 arc_feed end=(x1) first_centre=2 second_centre=0 turns=1",
        ),
    );
    check("f1; g2 x1 y1 i1", After("motion = arc_cw, position = (x1 y1)"));
    check("f1; g3 x2 i1", After("motion = arc_ccw, position = (x2)"));
}

/// Where the centre of an arc is that begins at a point.
fn centre(program: &str) -> (f64, f64) {
    let run = super::run(&machine(), &[], program);
    assert!(run.last.1.is_ok(), "{program}: {:?}", run.last);
    let effect = run.sink.effects.last().unwrap();
    let value = |name: &str| -> f64 {
        let (_, behind) = effect.split_once(name).unwrap();
        behind.split(' ').next().unwrap().parse().unwrap()
    };
    (value("first_centre="), value("second_centre="))
}

#[test]
fn arc_with_finite_centre_is_accepted() {
    let near = |found: (f64, f64), wanted: (f64, f64)| {
        let size = wanted.0.abs().max(wanted.1.abs());
        let apart =
            (found.0 / size - wanted.0 / size).abs() + (found.1 / size - wanted.1 / size).abs();
        assert!(apart < 1e-12, "{found:?} {wanted:?}");
    };
    let side = 1e200 * math::sqrt(0.5);
    near(centre("f1; g2 x1 i1e155"), (1e155, 0.0));
    near(centre("f1; g2 i1e-200"), (1e-200, 0.0));
    near(centre("f1; g2 x1 y1 r1e200"), (side, -side));
    near(centre("f1; g2 x1e-319 r10"), (0.0, -10.0));
    near(centre("f1; g3 x1e308 r1e308"), (5e307, 1e308 * math::sqrt(0.75)));
    // The chord is longer than the largest number, the radius is not.
    near(centre("f1; g0 x-1e308; g3 x1e308 r1.5e308"), (0.0, 1e308 * math::sqrt(1.25)));
}

#[test]
fn arc_without_radius_or_finite_centre_is_refused() {
    for line in [
        "g2 x1 i1.7e308 j1.7e308",
        "g0 x1.7e308; g2 i1.7e308",
        "g0 x1.7e308; g3 y1 x1.7e308 r-1.7e308",
        "g0 x1.7e308; g2 y-1 x1.7e308 r-1.7e308",
        "g0 x-1.7e308; g2 x1.7e308 r1",
        // No rounding makes a radius of zero.
        "g2 x0.0001 r0",
    ] {
        check(&alloc::format!("f1; {line}"), Refused(BadArc));
    }
}

#[test]
fn full_circles() {
    arc("g2 i5", "2 arc_feed end=() first_centre=5 second_centre=0 turns=-1");
    arc("g3 j5 p3", "2 arc_feed end=() first_centre=0 second_centre=5 turns=3");
    // The end may be the start (11.5.5.1), as in the sample of 11.1.6.1.
    check(
        "f1; g0 x-0.1; g3 x-0.1 y0 i0.1 j0",
        Effects(
            "2 straight_traverse end=(x-0.1); 3 arc_feed end=(x-0.1) first_centre=0 second_centre=0 turns=1",
        ),
    );
    arc("g2 z-1 i5", "2 arc_feed end=(z-1) first_centre=5 second_centre=0 turns=-1");
    check("f1 g2", Refused(MissingWord));
    check("f1 g2 p2", Refused(MissingWord));
    check("f1 g2 i0 j0", Refused(BadArc));
}

#[test]
fn absolute_centres() {
    check(
        "f1; g90.1 g0 x3 y1; g3 x1 i2 j1",
        Effects(
            "2 straight_traverse end=(x3 y1); 3 arc_feed end=(x1 y1) first_centre=2 second_centre=1 turns=1",
        ),
    );
    check(
        "f1 g90.1; g3 i2 j0",
        Effects("2 arc_feed end=() first_centre=2 second_centre=0 turns=1"),
    );
    check("f1 g90.1; g3 x4 i2", Refused(MissingWord));
    check("f1 g90.1; g3 x4 j2", Refused(MissingWord));
    check("f1 g90.1 g18; g3 z4 k2", Refused(MissingWord));
    check(
        "f1 g90.1 g18; g3 z4 k2 i0",
        Effects("2 arc_feed end=(z4) first_centre=2 second_centre=0 turns=1"),
    );
    check("f1 g90.1 g19; g3 y4 j2", Refused(MissingWord));
}

#[test]
fn planes() {
    arc("g18 g2 z2 k1", "2 arc_feed end=(z2) first_centre=1 second_centre=0 turns=-1");
    arc("g18 g3 x2 i1", "2 arc_feed end=(x2) first_centre=0 second_centre=1 turns=1");
    arc("g19 g2 y2 j1", "2 arc_feed end=(y2) first_centre=1 second_centre=0 turns=-1");
    arc("g19 g3 z2 k1", "2 arc_feed end=(z2) first_centre=0 second_centre=1 turns=1");
    check("f1; g2 x2 i1 k1", Refused(UnusedWord));
    check("f1; g18 g2 x2 i1 j1", Refused(UnusedWord));
    check("f1; g19 g2 y2 i1 j1", Refused(UnusedWord));
    for plane in ["g17.1", "g18.1", "g19.1"] {
        check(&alloc::format!("f1 {plane}; g2 x2 i1"), Refused(ModalConflict));
        check(&alloc::format!("f1; {plane} g2 x2 r1"), Refused(ModalConflict));
    }
}

#[test]
fn helices_and_turns() {
    arc(
        "g17 g2 x0 y1 z-1 i1 j0.5 p2",
        "2 arc_feed end=(y1 z-1) first_centre=1 second_centre=0.5 turns=-2",
    );
    arc("g3 x2 z5 a90 i1", "2 arc_feed end=(x2 z5 a90) first_centre=1 second_centre=0 turns=1");
    arc("g3 x2 i1 p1.00001", "2 arc_feed end=(x2) first_centre=1 second_centre=0 turns=1");
    check("f1; g3 x2 i1 p1.5", Refused(NotAnInteger));
    check("f1; g3 x2 i1 p0", Refused(WordOutOfRange));
    check("f1; g3 x2 i1 p-1", Refused(WordOutOfRange));
    check("f1; g3 x2 i1 p3e9", Refused(WordOutOfRange));
}

#[test]
fn radius_format() {
    arc("g3 x2 r1", "2 arc_feed end=(x2) first_centre=1 second_centre=0 turns=1");
    arc("g2 x8 r5", "2 arc_feed end=(x8) first_centre=4 second_centre=-3 turns=-1");
    arc("g2 x8 r-5", "2 arc_feed end=(x8) first_centre=4 second_centre=3 turns=-1");
    arc("g3 x8 r5", "2 arc_feed end=(x8) first_centre=4 second_centre=3 turns=1");
    arc("g3 x8 r-5 p2 z1", "2 arc_feed end=(x8 z1) first_centre=4 second_centre=-3 turns=2");
    arc("g18 g3 z8 r5", "2 arc_feed end=(z8) first_centre=4 second_centre=3 turns=1");
    arc("g19 g3 z8 r5", "2 arc_feed end=(z8) first_centre=-3 second_centre=4 turns=1");
    check("f1; g2 z8 r5", Refused(MissingWord));
    check("f1; g2 r5", Refused(MissingWord));
    check("f1; g18 g2 y8 r5", Refused(MissingWord));
    check("f1; g2 x0 r5", Refused(BadArc));
    check("f1; g2 x0 y0 z1 r-5", Refused(BadArc));
    check("f1; g2 x11 r5", Refused(BadArc));
    check("f1; g2 x1 r0", Refused(BadArc));
    check("f1; g2 x1 r5 i1", Refused(UnusedWord));
    check("f1; g2 x1 r5 k1", Refused(UnusedWord));
}

/// "more than (.05 inch/.5 mm) or ((.0005 inch/.005 mm) and .1% of radius)": 11.5.5.1.
#[test]
fn tolerance_of_radii() {
    for (line, good) in [
        // Fine: whatever the radius.
        ("g21 g2 x0.0049 i1", true),
        ("g21 g2 x2.0049 i1", true),
        ("g21 g2 x2.0051 i1", false),
        // A thousandth of the radius of the start.
        ("g21 g2 x200.09 i100", true),
        ("g21 g2 x200.11 i100", false),
        ("g21 g2 x199.91 i100", true),
        ("g21 g2 x199.89 i100", false),
        // Coarse: not even where it is less than a thousandth.
        ("g21 g2 x2000.49 i1000", true),
        ("g21 g2 x2000.51 i1000", false),
        ("g20 g2 x0.20049 i0.1", true),
        ("g20 g2 x0.20051 i0.1", false),
        ("g20 g2 x20.0099 i10", true),
        ("g20 g2 x20.0101 i10", false),
        ("g20 g2 x200.049 i100", true),
        ("g20 g2 x200.051 i100", false),
    ] {
        let program = alloc::format!("f1; {line}");
        check(&program, if good { After("motion = arc_cw") } else { Refused(BadArc) });
    }
    // A chord that is hardly longer than the diameter makes half a circle where the reading says so.
    let half_circle = &[("arcs.radius-just-too-small", "half-circle")];
    for (line, good) in [
        ("g21 g2 x2.0025 r1", true),
        ("g21 g2 x2.0026 r1", false),
        ("g20 g2 x2.000099 r1", true),
        ("g20 g2 x2.000101 r1", false),
    ] {
        let program = alloc::format!("f1; {line}");
        check(&program, Refused(BadArc));
        let expected = if good { After("motion = arc_cw") } else { Refused(BadArc) };
        check_on(&machine(), half_circle, &program, expected);
    }
    // A radius of nothing has no thousandth.
    check("f1; g2 x0.1 i0", Refused(BadArc));
    check("f1; g2 x0.001 i0", Refused(BadArc));
}

#[test]
fn repeated_arcs() {
    check(
        "f1; g2 x2 i1; x4 i1; x6 r1",
        Effects(
            "2 arc_feed end=(x2) first_centre=1 second_centre=0 turns=-1; \
             3 arc_feed end=(x4) first_centre=3 second_centre=0 turns=-1; \
             4 arc_feed end=(x6) first_centre=5 second_centre=0 turns=-1",
        ),
    );
    check("f1; g2 x2 i1; x4 i1 m8", After("flood = on, position = (x4)"));
    check("f1; g2 x2 i1; x4", Refused(MissingWord));
    // The words of an arc without axis words are no arc (11.4.11).
    check("f1; g2 x2 i1; i1", Refused(UnusedWord));
    check("f1; g2 x2 i1; r1", Refused(UnusedWord));
    check("f1; g2 x2 i1; g1 x4 i1", Refused(UnusedWord));
    check("f1; g2 x2 i1; g80; x4 i1", Refused(UnusedWord));
    check("i1", Refused(UnusedWord));
    check("g0 x1 j1", Refused(UnusedWord));
    check("f1; g2 x2 i1; g92 x1; x4 i1.5", After("position = (x4)"));
    check("f1; g2 x2 i1; g92 x1 i1", Refused(UnusedWord));
    check("f1; g2 g3 x1 i1", Refused(ModalConflict));
    check("f1; g2.1 x1 i1", Refused(UnknownCode));
    check("f1; g2 i1 g10 l2 p1 r3", Refused(AxisWords));
    check("f1; g2 x1 i1 g52 x1", Refused(AxisWords));
    check("f1; g53 g2 x1 i1", Refused(AxisWords));
    check("f1; g2 x2 i1; g53 x1 i1", Refused(AxisWords));
    check("f1; g2 x2 i1; g53 x1", Refused(AxisWords));
    check("f1; g43.1 z1 g2 i1", Refused(AxisWords));
}

#[test]
fn feed() {
    check("g2 x2 i1", Refused(ZeroFeed));
    check("g2 x2 i1 f0", Refused(ZeroFeed));
    check("g2 x2 i1 f-1", Refused(WordOutOfRange));
    check("g2 x2 i1 f5", After("feed_rate = 5"));
    check("g93 g2 x2 i1 f5; x4 i1 f6", After("feed_rate = 6"));
    check("g93 g2 x2 i1", Refused(MissingWord));
    check("g93 g3 i1 f2; x4 i1", Refused(MissingWord));
    check("g93 f4; g3 i1", Refused(MissingWord));
    check("f3; g95; g3 i1", Refused(ZeroFeed));
    check("g95 g3 i1 f0.1", After("feed_mode = per_revolution, feed_rate = 0.1"));
    check("g96 s100; g3 i1 f5", Refused(ZeroSpeed));
    check("g96 s100 m3; g3 i1 f5", After("motion = arc_ccw"));
}

/// X is a diameter, I and R are radii (2.6.6.2).
#[test]
fn diameter_mode() {
    check(
        "g18 g7 f1; g0 x10; g2 x14 z-2 i2",
        Effects(
            "2 straight_traverse end=(x5); 3 arc_feed end=(x7 z-2) first_centre=0 second_centre=7 turns=-1",
        ),
    );
    check(
        "g18 g7 g90.1 f1; g0 x10; g2 x14 z-2 i7 k0",
        Effects(
            "2 straight_traverse end=(x5); 3 arc_feed end=(x7 z-2) first_centre=0 second_centre=7 turns=-1",
        ),
    );
    check(
        "g18 g7 f1; g3 x4 r1",
        Effects("2 arc_feed end=(x2) first_centre=0 second_centre=1 turns=1"),
    );
}

#[test]
fn under_compensation() {
    check("f1 g41 d3; g2 x2 i1", After("position = (x2)"));
    check("f1 g41 d1; g2 x2 i1", Refused(Gouging));
    check("f1 g41 d1; g2 x20 i10", After("position = (x23)"));
    check("f1 g41 d3; g53 g1 x2", Refused(CompensationActive));
}

#[test]
fn in_moved_systems() {
    check(
        "f1 g10 l2 p1 x10 r90; g92 x1 y1; g2 x3 i1",
        Effects("3 arc_feed end=(x3 y1) first_centre=2 second_centre=1 turns=-1"),
    );
    check(
        "f1; g20; g2 x2 i1; g21",
        Effects("3 arc_feed end=(x2) first_centre=1 second_centre=0 turns=-1"),
    );
    check_on(
        &gaugeblock_vocabulary::Machine {
            axes: [gaugeblock_vocabulary::Axis::X].into(),
            ..machine()
        },
        &[],
        "f1; g2 x2 y0 r1",
        Refused(gaugeblock_vocabulary::FaultKind::NoSuchAxis),
    );
}
