//! G33, G33.1 and G76.

use gaugeblock_vocabulary::FaultKind::{
    AxisWords, BeyondLimit, MissingWord, ModalConflict, NotAnInteger, SpindleOutOfRange,
    UnusedWord, WordOutOfRange, ZeroSpeed,
};

use gaugeblock_vocabulary::Machine;
use gaugeblock_vocabulary::scenario::AxisLimits;

use super::Expect::{After, Effects, Refused, Unspecified};
use super::cycles::shows;
use super::{check, machine, run};
use crate::modal::Refusal;

#[test]
fn synchronised_motion() {
    check(
        "g0 x1 z0.5; s100 m3; g33 z-2 k0.125",
        Effects(
            "1 straight_traverse end=(x1 z0.5); 3 start_spindle_synchronisation spindle=0 pitch=0.125; \
             3 straight_feed end=(x1 z-2); 3 stop_spindle_synchronisation",
        ),
    );
    check(
        "m3 $1; g33 z-2 k1 $1; z-3 k2 $1",
        Effects(
            "2 start_spindle_synchronisation spindle=1 pitch=1; 2 straight_feed end=(z-2); 2 stop_spindle_synchronisation; \
             3 start_spindle_synchronisation spindle=1 pitch=2; 3 straight_feed end=(z-3); 3 stop_spindle_synchronisation",
        ),
    );
    check("m3; g91 g7 g33 x2 k1", After("position = (x1), motion = spindle_synchronised"));
    check("m3; g33 k1", Refused(MissingWord));
    check("m3; g33 z1", Refused(MissingWord));
    check("m3; g33 z1 k1; z2", Refused(MissingWord));
    check("g33 z1 k1", Refused(ZeroSpeed));
    check("m3 $1; g33 z1 k1", Refused(ZeroSpeed));
    check("m3; g33 z1 k1 $7", Refused(SpindleOutOfRange));
    check("m3; g33 z1 k1 i1", Refused(UnusedWord));
    check("m3; g41 d1; g33 z1 k1", Unspecified);
}

#[test]
fn rigid_tapping() {
    check(
        "g0 x1 z0.5; s100 m3; g33.1 z-2 k0.125 i2",
        Effects(
            "1 straight_traverse end=(x1 z0.5); 3 start_spindle_synchronisation spindle=0 pitch=0.125; \
             3 rigid_tap end=(x1 z-2); 3 stop_spindle_synchronisation",
        ),
    );
    check("m4; g0 z1; g33.1 z-1 k1", After("position = (z1), motion = rigid_tap"));
    check("m3; g33.1 k1", Refused(MissingWord));
    check("m3; g33.1 z1", Refused(MissingWord));
    check("m3; m5; g33.1 z1 k1", Refused(ZeroSpeed));
}

#[test]
fn faster_than_an_axis() {
    let limit = |velocity| AxisLimits { velocity: Some(velocity), ..AxisLimits::default() };
    let limits = [("x".into(), limit(1.0)), ("z".into(), limit(2.0))].into();
    let machine = Machine { limits, ..machine() };
    let check = |program: &str, expect| super::check_on(&machine, &[], program, expect);
    // 60 revolutions a minute at 2 a revolution are 2 a second.
    check("s60 m3; g33 z-5 k2", After("position = (z-5)"));
    check("s60 m3; g33 z-5 k2.1", Refused(BeyondLimit));
    check("s61 m3; g33.1 z-5 k2", Refused(BeyondLimit));
    check("s60 m3; g33 z-5 k-2.1", Refused(BeyondLimit));
    check("s60 m3; g33 x3 z-4 k1.7", Refused(BeyondLimit));
    check("s60 m3; g33 x3 z-4 k1.6", After("position = (x3 z-4)"));
    check("s60 m3; g33 y9 k100", After("position = (y9)"));
    check("g20; s60 m3; g33 z-5 k0.08", Refused(BeyondLimit));
    check("g96 s600 m3; g33 z-5 k2", After("position = (z-5)"));
}

const SYNC: &str = "start_spindle_synchronisation spindle=0 pitch=0.5";
/// Half a unit along the drive line for each revolution, on a taper of one to two.
const ASLANT: &str = "start_spindle_synchronisation spindle=0 pitch=0.5590169943749475";
const FREE: &str = "stop_spindle_synchronisation";

#[test]
fn passes() {
    let at = "g18; g0 x10 z2";
    // J, then twice J, then K, and a spring pass; external, from z2 to z-6.
    shows(
        at,
        "g76 p0.5 z-6 i-1 j0.25 k0.625 h1",
        &[
            "rapid (x8.75 z2)",
            SYNC,
            "feed (x8.75 z-6)",
            FREE,
            "rapid (x10 z-6)",
            "rapid (x10 z2)",
            "rapid (x8.5 z2)",
            SYNC,
            "feed (x8.5 z-6)",
            FREE,
            "rapid (x10 z-6)",
            "rapid (x10 z2)",
            "rapid (x8.375 z2)",
            SYNC,
            "feed (x8.375 z-6)",
            FREE,
            "rapid (x10 z-6)",
            "rapid (x10 z2)",
            "rapid (x8.375 z2)",
            SYNC,
            "feed (x8.375 z-6)",
            FREE,
            "rapid (x10 z-6)",
        ],
    );
    // Internal, constant area: J, and at the fourth pass 2 J.
    shows(
        at,
        "g91 g76 p0.5 z-8 i1 j0.5 k0.5 r2",
        &["rapid (x11.5 z2)", SYNC, "feed (x11.5 z-6)", FREE, "rapid (x10 z-6)"],
    );
    let passes = |program: &str| {
        let run = run(&machine(), &[], &alloc::format!("{at}; {program}"));
        run.sink.effects.iter().filter(|effect| effect.contains("start_spindle")).count()
    };
    assert_eq!(passes("g76 p1 z-6 i-1 j0.25 k0.5 r2"), 4);
    assert_eq!(passes("g76 p1 z-6 i-1 j0.25 k0.5 r1"), 2);
    assert_eq!(passes("g76 p1 z-6 i-1 j0.1 k0.7 h2"), 9);
    assert_eq!(passes("g76 p1 z-6 i-1 j0.5 k0.25"), 1);
    assert_eq!(passes("g7; g76 p1 z-6 i-2 j0.5 k1"), 2);
    check(
        "g18; g7; g0 x20; g76 p1 z-6 i-2 j0.5 k1",
        After("position = (x10 z-6), motion = thread_76"),
    );
}

#[test]
fn tapers_and_slide() {
    let at = "g18; g0 x10 z2";
    shows(
        at,
        "g76 p0.5 z-6 i-1 j0.5 k1 l3 e2",
        &[
            ASLANT,
            "feed (x9.5 z2)",
            "feed (x8.5)",
            SYNC,
            "feed (x8.5 z-4)",
            ASLANT,
            "feed (x9.5 z-6)",
            FREE,
            "rapid (x10 z-6)",
            "rapid (x10 z2)",
            ASLANT,
            "feed (x9 z2)",
            "feed (x8)",
            SYNC,
            "feed (x8 z-4)",
            ASLANT,
            "feed (x9 z-6)",
            FREE,
            "rapid (x10 z-6)",
        ],
    );
    shows(
        at,
        "g76 p0.5 z-6 i-1 j1 k1 l1 e2",
        &[ASLANT, "feed (x9 z2)", "feed (x8)", SYNC, "feed (x8 z-6)", FREE, "rapid (x10 z-6)"],
    );
    shows(
        at,
        "g76 p0.5 z-6 i-1 j1 k1 l2 e2",
        &["rapid (x8 z2)", SYNC, "feed (x8 z-4)", ASLANT, "feed (x9 z-6)", FREE, "rapid (x10 z-6)"],
    );
    // The slide moves a pass in the direction of the feed; the end is the end of the drive line.
    let run = run(&machine(), &[], &alloc::format!("{at}; g76 p0.5 z-6 i-1 j1 k1 q45"));
    let text = run.sink.effects.join("; ");
    assert!(text.contains("(x8 z1); 3 start_spindle_synchronisation"), "{text}");
    assert!(text.contains("straight_feed end=(x8 z-6); 3 stop"), "{text}");
    assert!(text.ends_with("3 straight_traverse end=(x10 z-6)"), "{text}");
}

#[test]
fn refused_threads() {
    let thread = |more: &str| alloc::format!("g18; g0 x10 z2; g76 {more}");
    for (more, kind) in [
        ("p1 i-1 j1 k1", MissingWord),
        ("z-6 i-1 j1 k1", MissingWord),
        ("z-6 p1 j1 k1", MissingWord),
        ("z-6 p1 i-1 k1", MissingWord),
        ("z-6 p1 i-1 j1", MissingWord),
        ("z-6 p1 i-1 j1 k1 x1", AxisWords),
        ("y-6 p1 i-1 j1 k1", AxisWords),
        ("z-6 p-1 i-1 j1 k1", WordOutOfRange),
        ("z-6 p1 i-1 j-1 k1", WordOutOfRange),
        ("z-6 p1 i-1 j1 k-1", WordOutOfRange),
        ("z-6 p1 i-1 j1 k1 h-1", WordOutOfRange),
        ("z-6 p1 i-1 j1 k1 h1.5", NotAnInteger),
        ("z-6 p1 i-1 j1 k1 r0.5", WordOutOfRange),
        ("z-6 p1 i-1 j1 k1 e4.5 l1", WordOutOfRange),
        ("z-6 p1 i-1 j1 k1 l4", WordOutOfRange),
        ("z-6 p1 i-1 j1 k1 d1", UnusedWord),
        ("z-6 p1 i-1 j1 k1 $5", SpindleOutOfRange),
    ] {
        check(&thread(more), Refused(kind));
    }
    check("g17; g76 z-6 p1 i-1 j1 k1", Refused(ModalConflict));
    let run = run(&machine(), &[], &thread("z-6 p1 i0 j1 k1"));
    assert!(matches!(run.last.1, Err(Refusal::Unspecified(_))), "{:?}", run.last);
}
