//! S, G96, G97, M3 to M5, M19, coolant and overrides.

use gaugeblock_vocabulary::FaultKind::{
    CompensationActive, MissingWord, ModalConflict, NotAnInteger, Orient, SpindleOutOfRange,
    WordOutOfRange,
};
use gaugeblock_vocabulary::Machine;

use super::Expect::{After, Effects, Refused};
use super::{check, check_on, machine};

#[test]
fn speed_and_turning() {
    check(
        "s100 $1; m3 $1",
        After(
            "spindle_speed[1] = 100, spindle_speed[0] = 0, spindle[1] = clockwise, spindle[0] = stopped",
        ),
    );
    check(
        "s100 m4",
        After(
            "spindle_speed[0] = 100, spindle_speed[1] = 0, spindle[0] = counterclockwise, spindle[2] = counterclockwise",
        ),
    );
    check_on(
        &machine(),
        &[("spindle.without-dollar", "first")],
        "m3",
        After("spindle[0] = clockwise, spindle[1] = stopped"),
    );
    check_on(
        &machine(),
        &[("spindle.minus-one", "all")],
        "m3 $-1",
        After("spindle[2] = clockwise"),
    );
    check("m3; m5 $1", After("spindle[0] = clockwise, spindle[1] = stopped"));
    check("m3; m5; m5", After("spindle[0] = stopped"));
    check("s-1", Refused(WordOutOfRange));
    for program in ["s1 $3", "m3 $-1", "m3 $3", "m19 r1 q1 $3", "m48 $3", "g96 s1 $-2"] {
        check(program, Refused(SpindleOutOfRange));
    }
    check_on(&machine(), &[("spindle.minus-one", "all")], "s100 $-1", Refused(SpindleOutOfRange));
    check("m3 $0.5", Refused(NotAnInteger));
}

#[test]
fn surface_speed() {
    check(
        "g96 d2500 s250 $1",
        After(
            "spindle_mode[1] = surface_speed, spindle_limit[1] = 2500, spindle_speed[1] = 250, spindle_mode[0] = rpm",
        ),
    );
    check("g96 d2500 s250; g96 s100", After("spindle_limit[0] = none, spindle_speed[0] = 100"));
    check("g96 s250; g97", After("spindle_mode[0] = rpm, spindle_speed[0] = 250"));
    check("g97 s20", After("spindle_speed[0] = 20"));
    check("g96 d10", Refused(MissingWord));
    check("g96 s1 d-1", Refused(WordOutOfRange));
    check_on(&machine(), &[("spindle.rpm-mode-speed", "required")], "g97", Refused(MissingWord));
}

#[test]
fn orientation() {
    check(
        "m19 r90 q2",
        Effects(
            "1 orient_spindle spindle=0 angle=90 direction=shortest; 1 wait_orient spindle=0 timeout=2",
        ),
    );
    check(
        "m19 r0 q2 p2 $2",
        Effects(
            "1 orient_spindle spindle=2 angle=0 direction=counterclockwise; 1 wait_orient spindle=2 timeout=2",
        ),
    );
    check("m19 r1 q1; m3", After("spindle[0] = clockwise"));
    check("m19 r1 q1", After("spindle[0] = oriented, spindle[1] = stopped"));
    check_on(
        &machine(),
        &[("orient.without-dollar", "all")],
        "m19 r1 q1",
        After("spindle[2] = oriented"),
    );
    check_on(
        &machine(),
        &[("orient.zero-timeout", "accepted")],
        "m19 r1 q0",
        After("spindle[0] = oriented"),
    );
    check_on(
        &Machine { orient_offset: 15.0, ..machine() },
        &[],
        "m19 r350 q1 p1",
        Effects(
            "1 orient_spindle spindle=0 angle=365 direction=clockwise; 1 wait_orient spindle=0 timeout=1",
        ),
    );
    for program in
        ["m19 r-1 q1", "m19 r361 q1", "m19 r1 q0", "m19 r1 q-1", "m19 r1 q1 p3", "m19 r1 q1 p-1"]
    {
        check(program, Refused(WordOutOfRange));
    }
    check("m19 r1 q1 p0.5", Refused(NotAnInteger));
    check("m19 r1 q10", Refused(Orient));
}

#[test]
fn coolant() {
    check("m7; m8", After("mist = on, flood = on"));
    check("m7; m8; m9", After("mist = off, flood = off"));
    check("m9 m8", Refused(ModalConflict));
    check("m8 m8", Refused(ModalConflict));
}

#[test]
fn overrides() {
    check("m49", After("feed_override = off, speed_override[0] = off, speed_override[2] = off"));
    check("m49 $1", After("feed_override = off, speed_override[1] = off, speed_override[0] = on"));
    check_on(
        &machine(),
        &[("overrides.selected-feed", "untouched")],
        "m49 $1",
        After("feed_override = on, speed_override[1] = off"),
    );
    check_on(
        &machine(),
        &[("overrides.without-dollar", "first")],
        "m49; m51 p0",
        After("speed_override[0] = off, speed_override[1] = on"),
    );
    check("m49; m48", After("feed_override = on, speed_override[2] = on"));
    check("m50 p0", After("feed_override = off, speed_override[0] = on"));
    check("m50 p0; m50", After("feed_override = on"));
    check("m51 p0 $2", After("speed_override[2] = off, speed_override[0] = on"));
    check("m52", After("adaptive_feed = on"));
    check("m52 p1; m52 p0", After("adaptive_feed = off"));
    check("m53 p0; m53 p1", After("feed_stop = on"));
    for program in ["m50 p2", "m51 p-1", "m52 p3", "m53 p2"] {
        check(program, Refused(WordOutOfRange));
    }
    check("m50 p0.5", Refused(NotAnInteger));
    let strict = &[("overrides.under-compensation", "refused")];
    check_on(&machine(), strict, "g41; m49", Refused(CompensationActive));
    check_on(&machine(), strict, "g41; m53", Refused(CompensationActive));
    check("g41; m49", After("feed_override = off"));
}
