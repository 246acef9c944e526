//! G10 L0, L1, L10, L11 (11.5.12, 11.5.13, 11.5.15, 11.5.16).

use gaugeblock_vocabulary::FaultKind::{
    AxisWords, CompensationActive, MissingWord, ModalConflict, NotAnInteger, ToolNotFound,
    UnusedWord, WordOutOfRange,
};
use gaugeblock_vocabulary::Machine;

use super::Expect::{After, Effects, Refused};
use super::{check, check_on, inch_machine, machine};

#[test]
fn values() {
    check(
        "g10 l1 p1 z1.5",
        Effects(
            "1 set_tool_entry tool=1 offset=(z1.5) diameter=6 front_angle=0 back_angle=0 orientation=0",
        ),
    );
    check(
        "g10 l1 p2 r0.015 q3 i5 j-7",
        Effects(
            "1 set_tool_entry tool=2 offset=(z20) diameter=0.03 front_angle=5 back_angle=-7 orientation=3",
        ),
    );
    check("g10 l1 p1 z1.5 x2; g43 h1", After("tool_offset = (x2 z1.5)"));
    // What applies stays until the next G43.
    check("g43 h1; g10 l1 p1 z1.5", After("tool_offset = (z10)"));
    check("t1 m6; g10 l1 p1 z1.5 r4", After("#5403 = 1.5, #5410 = 8"));
    check("t1 m6; g10 l1 p2 z1.5", After("#5403 = 10"));
    check("g10 l1 p1", After("tool = 0"));
    check_on(
        &inch_machine(),
        &[],
        "g10 l1 p1 x25.4 r12.7; t1 m6",
        After("#5401 = 1, #5403 = 10, #5410 = 1"),
    );
    check("g7 g10 l1 p1 x4; g43 h1", After("tool_offset = (x4 z10)"));
    check_on(
        &machine(),
        &[("units-planes.diameter-offsets", "every-word")],
        "g7 g10 l1 p1 x4; g43 h1",
        After("tool_offset = (x2 z10)"),
    );
}

#[test]
fn measured() {
    // The example of 11.5.15.
    check("t1 m6 g43; g10 l10 p1 z1.5; g43", After("position = (z1.5), tool_offset = (z-1.5)"));
    check("g0 z7; g10 l10 p1 z1.5; g43 h1", After("position = (z1.5)"));
    check(
        "g10 l2 p1 z3; g92 z2; g0 z7; g10 l10 p1 z1.5; g43 h1",
        After("position = (z1.5), g92_offset = (z-5)"),
    );
    check(
        "g10 l2 p9 z3; g0 z7; g92 z9; g10 l11 p1 z1.5; g43 h1; g59.3; g92.1",
        After("position = (z1.5)"),
    );
    check("g0 z7; g10 l11 p1 z7; g43 h1", After("tool_offset = ()"));
    check("g0 x3 z7; g10 l10 p1 x1; g43 h1", After("position = (x1 z-3), tool_offset = (x2 z10)"));
    check("g20 g0 z1; g10 l10 p1 z0; g21; g43 h1", After("tool_offset = (z25.4)"));
    // Incremental mode says nothing about it.
    check("g91 g0 z7; g10 l10 p1 z1.5; g43 h1", After("position = (z1.5)"));
}

#[test]
fn reloaded() {
    check("g10 l0", After("tool = 0"));
    check("g10 l1 p1 z2; g10 l0; g43 h1", After("tool_offset = (z2)"));
    check("t1 m6; g10 l0", Refused(ModalConflict));
    check("g10 l0 p1", Refused(UnusedWord));
    check("g10 l0 x1", Refused(UnusedWord));
    check("m7 g10 l0 x1", Refused(UnusedWord));
    check("g10 l0 g43.1 x1", After("tool_offset = (x1)"));
    check("g10 l0 g0 x1", Refused(AxisWords));
}

#[test]
fn refused() {
    for kind in ["l1", "l10", "l11"] {
        let refused = |rest: &str, kind_of| {
            check(&alloc::format!("g10 {kind} {rest}"), Refused(kind_of));
        };
        refused("z1", MissingWord);
        refused("p0 z1", WordOutOfRange);
        refused("p-1 z1", ToolNotFound);
        refused("p9 z1", ToolNotFound);
        refused("p1.5 z1", NotAnInteger);
        refused("p1 q10", WordOutOfRange);
        refused("p1 q-1", WordOutOfRange);
        refused("p1 q0.5", NotAnInteger);
        refused("p1 k1", UnusedWord);
        refused("p1 z1 g0", AxisWords);
        check(&alloc::format!("g41 d3; g10 {kind} p1 z1"), Refused(CompensationActive));
    }
    let random = Machine { random_tool_changer: true, ..machine() };
    check_on(&random, &[], "g10 l1 p0 z1", Refused(WordOutOfRange));
    check("g10 l2 p1 x1 i1", Refused(UnusedWord));
    check("g10 l2 p1 q1", Refused(UnusedWord));
    // Q is a word of M67 there.
    check("g10 l2 p1 x1 m67 e0 q1", After("g5x_offset = (x1)"));
    check("g10 l20 p1 x1 r1", Refused(UnusedWord));
    check("g10 l20 p1", Refused(MissingWord));
    check("g10 p1 x1", Refused(MissingWord));
    check("g10 l2", Refused(MissingWord));
}
