//! Words against each other: groups, numbers of words, unused and missing words, initial modes.

use gaugeblock_vocabulary::FaultKind::{
    AxisWords, MissingWord, ModalConflict, NoSuchAxis, TooManyMCodes, UnknownCode, UnusedWord,
};

use super::Expect::{After, Effects, Refused};
use super::{check, check_on, machine};

#[test]
fn two_codes_of_a_group_are_refused() {
    for program in [
        "g0 g1 x1",
        "g80 g0",
        "g17 g18",
        "g90 g91",
        "g90.1 g91.1",
        "g93 g94 f1",
        "g20 g21",
        "g40 g41",
        "g43 g49",
        "g43.1 g43.2 z1",
        "g98 g99",
        "g54 g59.3",
        "g61 g64",
        "g96 g97 s1",
        "g7 g8",
        "g4 g53 g0 x1 p1",
        "g4 g92 x1 p1",
        "m0 m1",
        "m2 m30",
        "m62 m64 p0",
        "m66 m65 p0",
        "m6 m61 q1",
        "m3 m5",
        "m3 m19 r1 q1",
        "m7 m8",
        "m7 m9",
        "m48 m49",
        "m100 m101",
        "g0 g0",
    ] {
        check(program, Refused(ModalConflict));
    }
}

#[test]
fn options_widen_and_narrow_groups() {
    let independent = &[("modal-groups.io-members", "independent")];
    check_on(
        &machine(),
        independent,
        "m62 m64 p0",
        Effects(
            "1 set_digital_output output=0 on=yes timing=with_motion; 1 set_digital_output output=0 on=yes timing=at_once",
        ),
    );
    let all = &[("modal-groups.override-members", "all")];
    check_on(&machine(), all, "m52 p0 m53", Refused(ModalConflict));
    check_on(&machine(), all, "m49 m50", Refused(ModalConflict));
    check("m52 m53 p0", After("adaptive_feed = off, feed_stop = off"));
    check("m49 m50 p1", After("feed_override = on, speed_override[0] = off"));
    let both = &[("coolant.both-in-one-block", "accepted")];
    check_on(&machine(), both, "m7 m8", After("mist = on, flood = on"));
    check_on(&machine(), both, "m7 m9", Refused(ModalConflict));
    check_on(&machine(), both, "m7 m7", Refused(ModalConflict));
}

#[test]
fn codes_are_counted_and_known() {
    check("m0 m7 m48 m3", After("mist = on, spindle[0] = clockwise"));
    check("m0 m7 m48 m3 m70", Refused(TooManyMCodes));
    for program in ["m10", "m54", "m69", "m200", "m1000", "g1.1", "g12", "g85.5", "g99.9"] {
        check(program, Refused(UnknownCode));
    }
    for program in ["g70", "g71", "g71.1", "g71.2", "g72", "g72.1", "g72.2"] {
        check(program, Refused(MissingWord));
    }
}

#[test]
fn words_are_used_and_there() {
    for program in [
        "p1",
        "g0 x1 p1",
        "m3 p1",
        "h1",
        "d1",
        "g40 d1",
        "g49 h1",
        "l1",
        "q1 m62 p1",
        "r1",
        "e1",
        "m0 $0",
        "g0 x1 $0",
        "f1 $0",
        "m50 $0",
        "m52 $0",
        "m53 $0",
        "g4 p1 $0",
        "g97 d5 s1",
        "i1",
        "g1 x1 j1 f1",
        "m66 p0 r1",
        "g61 p1",
        "g10 l20 p1 x1 r5",
        "g41.1 d1 l1",
        "m70 p1",
        "m61 q1 p1",
    ] {
        check(program, Refused(UnusedWord));
    }
    for program in [
        "g4",
        "m62",
        "m65",
        "m66",
        "m67 e0",
        "m68 q1",
        "m61",
        "m19 r1",
        "m19 q1",
        "g96",
        "g41.1",
        "g10 l2",
        "g10 p1",
        "g43.1",
        "g43.2",
        "g52",
        "g92",
        "g53 g0",
        "g10 l20 p1",
        "g64 q1",
    ] {
        check(program, Refused(MissingWord));
    }
}

#[test]
fn axis_words_belong_to_one_code() {
    for program in [
        "x1",
        "g80 x1",
        "g17 x1",
        "g0 g92 x1",
        "g1 g52 x1 f1",
        "g0 g10 l2 p1 x1",
        "g43.1 z1 g0",
        "g43.1 z1 g1 f1",
        "g43.2 h1 z1",
        "g53 x1",
        "g53 g80 x1",
    ] {
        check(program, Refused(AxisWords));
    }
    check("g43.1 g92 x1", After("position = (x1), tool_offset = (x1)"));
    check("g0 u1", Refused(NoSuchAxis));
    check("g92 w1", Refused(NoSuchAxis));
    check("g0; g92 x1", Effects(""));
    check("g0; g43.1 z1; z2", Effects("3 straight_traverse end=(z2)"));
    check("g80 g92 x1", After("position = (x1)"));
}

#[test]
fn initial_modes() {
    check(
        "m5",
        After(
            "units = mm, plane = xy, distance = absolute, arc_distance = incremental, feed_mode = per_minute, feed_rate = 0, \
         retract = r_plane, compensation = off, tool_length = off, work_offset = 1, path = continuous, lathe = radius, \
         motion = none, position = (), tool = 0, prepared_tool = -1, controller_mode = auto, feed_override = on, \
         speed_override[2] = on, adaptive_feed = off, feed_stop = on, spindle[2] = stopped, mist = off, flood = off",
        ),
    );
    check_on(
        &super::inch_machine(),
        &[("units-planes.initial-unit", "machine")],
        "m5",
        After("units = inch"),
    );
    check_on(&super::inch_machine(), &[], "m5", After("units = mm"));
    check_on(&machine(), &[("modal-groups.initial-motion", "feed")], "m5", After("motion = feed"));
    check_on(
        &machine(),
        &[("modal-groups.initial-motion", "traverse")],
        "x1",
        After("position = (x1)"),
    );
    check_on(
        &machine(),
        &[("modal-groups.initial-retract", "old-z")],
        "m5",
        After("retract = old_z"),
    );
}
