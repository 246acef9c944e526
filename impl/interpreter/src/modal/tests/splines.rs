//! G5, G5.1, and the data block of G5.2 and G5.3.

use gaugeblock_vocabulary::FaultKind::{
    AxisWords, MissingWord, ModalConflict, NotAnInteger, UnusedWord, WordOutOfRange, ZeroFeed,
};

use super::Expect::{After, Effects, Refused};
use super::{check, machine, run};
use crate::modal::Refusal;

#[test]
fn the_examples_of_the_manual() {
    check(
        "f10; g90 g17; g0 x0 y0; g5 i0 j3 p0 q-3 x1 y1; g5 p0 q-3 x2 y2",
        Effects(
            "3 straight_traverse end=(); 4 nurbs_feed points=4 end=(x1 y1); 5 nurbs_feed points=4 end=(x2 y2)",
        ),
    );
    check(
        "f10; g90 g17; g0 x-2 y4; g5.1 x2 i2 j-8",
        Effects("3 straight_traverse end=(x-2 y4); 4 nurbs_feed points=3 end=(x2 y4)"),
    );
    check(
        "g0 x0 y0; f10; g5.2 p1 l3; x0 y1 p1; x2 y2 p1; x2 y0 p1; x0 y0 p2; g5.3; g0 x0 y1; x2 y2",
        Effects(
            "1 straight_traverse end=(); 8 nurbs_feed points=5 end=(); 9 straight_traverse end=(y1); \
             10 straight_traverse end=(x2 y2)",
        ),
    );
}

#[test]
fn cubic() {
    let first = "f10; g5 i1 j1 p1 q1 x1";
    check(first, After("motion = cubic_spline, position = (x1)"));
    check("f10; g91; g5 i1 j1 p1 q1 x1 y2; p1 q1 x1 y2", After("position = (x2 y4)"));
    check("f10; g5 p1 q1 x1", Refused(MissingWord));
    check(&alloc::format!("{first}; g5 p1 q1 x2; i1 p1 q1 x3"), Refused(MissingWord));
    check(&alloc::format!("{first}; g1 x2; g5 p1 q1 x3"), Refused(MissingWord));
    check("f10; g5 i1 j1 p1 x1", Refused(MissingWord));
    check("f10; g5 i1 j1 q1 x1", Refused(MissingWord));
    check(&alloc::format!("{first}; x2"), Refused(MissingWord));
    check("f10; g5 i1 j1 p1 q1", Refused(MissingWord));
    check("f10; g5 i1 j1 p1 q1 x1 z1", Refused(AxisWords));
    check("f10; g18 g5 i1 j1 p1 q1 x1", Refused(ModalConflict));
    check("g5 i1 j1 p1 q1 x1", Refused(ZeroFeed));
    check("f10; g5 i1 j1 p1 q1 x1 k1", Refused(UnusedWord));
    check("g93; g5 i1 j1 p1 q1 x1", Refused(MissingWord));
}

#[test]
fn quadratic() {
    check("f10; g5.1 x1 j2; g91 x1 i1", After("motion = quadratic_spline, position = (x2)"));
    check("f10; g5.1 x1", Refused(MissingWord));
    check("f10; g5.1 x1 i0", Refused(WordOutOfRange));
    check("f10; g5.1 x1 i0 j0", Refused(WordOutOfRange));
    check("f10; g5.1 x1 z2 i1", Refused(AxisWords));
    check("f10; g19 g5.1 x1 i1", Refused(ModalConflict));
    check("f10; g5.1 x1 i1 p1", Refused(UnusedWord));
}

#[test]
fn data_block() {
    // The point stands still until the block is closed.
    check("f10; g0 x5; g5.2 x1 y1; x2 y2", After("motion = nurbs, position = (x5)"));
    check("f10; g5.2 x1 y1; x2 y2; g5.3", After("motion = none, position = (x2 y2)"));
    check("f10; g91; g5.2 x1 y1; m8; g5.2 x2 y2; g5.3", After("position = (x3 y3)"));
    check("f10; g5.2 x1 y1 l2; g5.3", Effects("3 nurbs_feed points=2 end=(x1 y1)"));
    check(
        "f10; g5.2 x1 y1; g92 x10; x1 y1; x2; g5.3",
        Effects("6 nurbs_feed points=4 end=(x2 y1)"),
    );
    check("f10; g5.2 x1 z1", Refused(AxisWords));
    check("f10; g5.2 l1.5", Refused(NotAnInteger));
    check("f10; g5.2 l0", Refused(WordOutOfRange));
    check("f10; g5.2 x1 y1; g5.2 p3", Refused(MissingWord));
    check("f10; g5.2 p1; p2", Refused(UnusedWord));
    check("f10; g5.2 x1 y1; g5.3 x2", Refused(AxisWords));
    check("g5.2 x1 y1; x2 y2; g5.3", Refused(ZeroFeed));
    for program in [
        "f10; g5.3",
        "f10; g5.2 x1 y1; g5.3",
        "f10; g5.2 x1; g1 x1",
        "g5.2 x1; g0 x1",
        "g5.2 x1; g80",
    ] {
        let run = run(&machine(), &[], program);
        assert!(matches!(run.last.1, Err(Refusal::Unspecified(_))), "{program}: {:?}", run.last);
    }
}
