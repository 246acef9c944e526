//! Polar words (11.4.12).

use gaugeblock_vocabulary::FaultKind::{AxisWords, NoSuchAxis, OutOfDomain, UnusedWord};
use gaugeblock_vocabulary::{Axis, Machine};

use super::Expect::{After, Effects, Refused};
use super::{check, check_on, machine, run};

/// X and Y after a program, to nine decimals.
fn place(program: &str) -> (f64, f64) {
    let run = run(&machine(), &[], program);
    assert!(run.last.1.is_ok(), "{program}: {:?}", run.last);
    let [x, y, ..] = run.modal.position.0.map(|coordinate| (coordinate * 1e9).round() / 1e9);
    (x, y)
}

#[track_caller]
fn near(program: &str, x: f64, y: f64) {
    let (found_x, found_y) = place(program);
    assert!((found_x - x).abs() + (found_y - y).abs() < 1e-8, "{program}: {found_x} {found_y}");
}

#[test]
fn absolute_mode() {
    check("g1 f1 @1 ^90", Effects("1 straight_feed end=(y1)"));
    check("g0 @2 ^-180 z1", After("position = (x-2 z1)"));
    near("g0 @2 ^30", 3_f64.sqrt(), 1.0);
    // What has no word stays.
    near("g0 x3 y4; @10", 6.0, 8.0);
    near("g0 x3 y4; ^0", 5.0, 0.0);
    near("g0 @5", 5.0, 0.0);
    near("g0 ^45", 0.0, 0.0);
    // A zero has no sign.
    near("g0 x-0; @7", 7.0, 0.0);
    near("g0 ^93; @7", 7.0, 0.0);
    near("g18 g0 @1 ^90", 0.0, 1.0);
    near("g7 g0 @1 ^0", 1.0, 0.0);
    near("g92 x1; g0 @2 ^90", 0.0, 2.0);
}

#[test]
fn incremental_mode() {
    // The spiral and the square of 11.4.12.
    near("f100; g1 @.5 ^90; g91 @.5 ^90", -1.0, 0.0);
    near("f100; g1 @.5 ^90; g91 @.5 ^90; @.5 ^90; @.5 ^90", 2.0, 0.0);
    near("f100; g1 @.5 ^90; g91 ^90; ^90", 0.0, -0.5);
    near("g0 x3 y4; g91 @5", 6.0, 8.0);
    near("g0 x3; g91 g53 ^90 @2", 0.0, 2.0);
    check("g91 g0 @1 ^30", Refused(OutOfDomain));
    check("g91 g0 ^30", Refused(OutOfDomain));
    check("g0 x1; g92 x0; g91 @1", Refused(OutOfDomain));
}

#[test]
fn machine_coordinates() {
    near("g92 x10 y10; g53 g0 @2 ^90; g92.1", 0.0, 2.0);
    near("g10 l2 p1 r90; g53 g0 @2 ^90", 2.0, 0.0);
}

#[test]
fn what_uses_them() {
    check(
        "f1 g0 x3; g2 @3 ^90 r3",
        Effects(
            "1 straight_traverse end=(x3); 2 arc_feed end=(y3) first_centre=3 second_centre=3 turns=-1",
        ),
    );
    check(
        "f1 g0 x3; g3 @3 ^90 i-3; @3 ^180 j-3",
        Effects(
            "1 straight_traverse end=(x3); 2 arc_feed end=(y3) first_centre=0 second_centre=0 turns=1; \
             3 arc_feed end=(x-3) first_centre=0 second_centre=0 turns=1",
        ),
    );
    check("g28 @3 ^90", Effects("1 straight_traverse end=(y3); 1 straight_traverse end=()"));
    check("g0 @1 x1", Refused(AxisWords));
    check("g0 ^1 y1", Refused(AxisWords));
    check("@1", Refused(AxisWords));
    check("g80; @1 ^3", Refused(AxisWords));
    check("g0; g92 @1 ^90", Refused(UnusedWord));
    check("g0; g52 z1 ^90", Refused(UnusedWord));
    check("g10 l2 p1 @1", Refused(UnusedWord));
    check("g43.1 z1 ^3", Refused(UnusedWord));
    let machine = Machine { axes: [Axis::X, Axis::Z].into(), ..machine() };
    check_on(&machine, &[], "g0 @1 ^0", Refused(NoSuchAxis));
}
