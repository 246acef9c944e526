//! Stops, ends, aborts.

use gaugeblock_vocabulary::FaultKind::{ModalConflict, NothingSaved, UnusedWord};

use super::Expect::{After, Effects, Refused};
use super::{check, check_on, machine};

#[test]
fn stops() {
    check(
        "m0; m1; m60",
        Effects("1 stop optional=no; 2 stop optional=yes; 3 pallet_shuttle; 3 stop optional=no"),
    );
    check("g0 x1 m0", Effects("1 straight_traverse end=(x1); 1 stop optional=no"));
    check("m0 p1", Refused(UnusedWord));
    check("m2 m0", Refused(ModalConflict));
}

#[test]
fn program_ends() {
    check("m2; g0 x1", Effects("1 controller_mode mode=mdi; 1 program_end"));
    check("m30", Effects("1 pallet_shuttle; 1 controller_mode mode=mdi; 1 program_end"));
    let table = &[("pause.pallet-codes", "table")];
    check_on(
        &machine(),
        table,
        "m30; m60; g0 x1",
        Effects(
            "1 pallet_shuttle; 1 stop optional=no; 2 pallet_shuttle; 2 controller_mode mode=mdi; 2 program_end",
        ),
    );
    check(
        "g55 g18 g91 g95 m49; m3; m8 g41 g0; f5; m2",
        After(
            "work_offset = 1, plane = xy, distance = absolute, feed_mode = per_minute, feed_rate = 0, feed_override = on, \
         speed_override[2] = on, compensation = off, spindle[0] = stopped, spindle[2] = stopped, motion = feed, mist = off, \
         flood = off, controller_mode = mdi, #5220 = 1",
        ),
    );
    check(
        "g20 g90.1 g7 g61 g98 g96 s5; f3; g52 x1; m2",
        After(
            "units = inch, arc_distance = absolute, lathe = diameter, path = exact_path, retract = old_z, feed_rate = 3, \
         spindle_mode[0] = surface_speed, g92_offset = (x1)",
        ),
    );
    check("g10 l2 p2 x1; g55; m2", After("position = (), g5x_offset = ()"));
    check_on(
        &machine(),
        &[("program-end.feed-after-mode-change", "kept")],
        "g93 g1 x1 f2; m2",
        After("feed_rate = 2"),
    );
    check_on(
        &machine(),
        &[("program-end.spindles", "first")],
        "m3; m2",
        After("spindle[0] = stopped, spindle[1] = clockwise"),
    );
}

#[test]
fn aborts() {
    check("m3; m8; abort", After("spindle[0] = stopped, flood = off"));
    check_on(
        &machine(),
        &[("abort.spindle-and-coolant", "left-alone")],
        "m3; m8; abort",
        After("spindle[0] = clockwise, flood = on"),
    );
    check("g91 g55; abort", After("distance = incremental, work_offset = 2"));
}

#[test]
fn another_program_begins() {
    check("call; m70; begin; m72", Refused(NothingSaved));
    check("f1; m70; f2; begin; m72", After("feed_rate = 1"));
    check(
        "g91 f5; begin; m5",
        After("distance = incremental, feed_rate = 5, controller_mode = auto"),
    );
}
