//! M70 to M73.

use gaugeblock_vocabulary::FaultKind::{MissingWord, NothingSaved};

use super::Expect::{After, Refused};
use super::{check, check_on, machine};

/// One row for each entry of the list in 11.6.19: set, saved, changed, restored.
#[test]
fn listed_settings_are_restored() {
    for (set, change, after) in [
        ("g20", "g21", "units = inch"),
        ("g21", "g20", "units = mm"),
        ("g18", "g17", "plane = zx"),
        ("g41", "g40", "compensation = left"),
        ("g40", "g42.1 d2", "compensation = off"),
        ("g91", "g90", "distance = incremental"),
        ("g93", "g94", "feed_mode = inverse_time"),
        ("f100", "g93", "feed_mode = per_minute, feed_rate = 100"),
        ("g55", "g54", "work_offset = 2, #5220 = 2"),
        ("g43 h1", "g49", "tool_length = on, tool_offset = (z10), position = (z-10)"),
        ("g43.1 z1", "g43.1 z2", "tool_offset = (z1)"),
        ("g49", "g43 h1", "tool_length = off, tool_offset = (), position = ()"),
        ("g98", "g99", "retract = old_z"),
        (
            "g96 s10 d50",
            "g97 s20",
            "spindle_mode[0] = surface_speed, spindle_speed[0] = 10, spindle_limit[0] = 50",
        ),
        ("g97 s20", "g96 s10", "spindle_mode[0] = rpm, spindle_speed[0] = 20"),
        ("g90.1", "g91.1", "arc_distance = absolute"),
        ("g7", "g8", "lathe = diameter"),
        ("g61", "g64 p1", "path = exact_path, blend_tolerance = 1"),
        (
            "g64 p0.1 q0.2",
            "g61.1",
            "path = continuous, blend_tolerance = 0.1, naive_cam_tolerance = 0.2",
        ),
        ("f12.3456", "f1", "feed_rate = 12.3456"),
        ("s1234.56", "s1", "spindle_speed[0] = 1234.56"),
        ("s5 $2", "s1 $2", "spindle_speed[2] = 5"),
        ("m3", "m5", "spindle[0] = clockwise, spindle[2] = clockwise"),
        ("m4", "m3", "spindle[0] = counterclockwise"),
        ("m5", "m3", "spindle[0] = stopped"),
        ("m5", "m19 r1 q1", "spindle[0] = stopped"),
        ("m19 r1 q1", "m3", "spindle[0] = stopped, spindle[1] = stopped"),
        ("m7", "m9", "mist = on, flood = off"),
        ("m8", "m7", "mist = off, flood = on"),
        ("m50 p0", "m50 p1", "feed_override = off"),
        ("m51 p0", "m51 p1", "speed_override[0] = off, speed_override[1] = off"),
        ("m49", "m48", "feed_override = off, speed_override[0] = off"),
        ("m52", "m52 p0", "adaptive_feed = on"),
        ("m53 p0", "m53", "feed_stop = off"),
    ] {
        check(&alloc::format!("{set}; m70; {change}; m72"), After(after));
        check(&alloc::format!("{set}; call; m73; {change}; back"), After(after));
    }
}

#[test]
fn unlisted_settings_are_not_restored() {
    check("m70; g0 x1; m72", After("motion = traverse, position = (x1)"));
    check("m70; g52 x1; m72", After("g92_offset = (x1)"));
    check("m70; g10 l2 p1 x1; m72", After("g5x_offset = (x1)"));
    check("m70; t1 m6; m72", After("tool = 1"));
    let motion = &[("saved-state.motion-mode", "restored")];
    check_on(&machine(), motion, "g1 f1; m70; g0; m72", After("motion = feed"));
    check_on(&machine(), motion, "g0; m70; g1 f1; m72", After("motion = feed"));
    let every = &[("saved-state.motion-mode", "restored"), ("saved-state.listed-motion", "every")];
    check_on(&machine(), every, "g0; m70; g1 f1; m72", After("motion = traverse"));
}

#[test]
fn units_come_before_the_feed() {
    check("g21 f200; m70; g20; f5; m72", After("units = mm, feed_rate = 200"));
    check("g20; f5; m70; g21; m72", After("units = inch, feed_rate = 5"));
    check("g21 g0 x25.4 g64 p1; m70; g20; m72", After("position = (x25.4), blend_tolerance = 1"));
    // The rest of the block is executed under what came back.
    check("g21; m70; g20; m72 g0 x25.4", After("position = (x25.4)"));
}

#[test]
fn call_levels() {
    check("f1; m70; f2; m70; f3; m72", After("feed_rate = 2"));
    check("f1; m70; f2; m72; f3; m72", After("feed_rate = 1"));
    check("m72", Refused(NothingSaved));
    check("m70; call; m72", Refused(NothingSaved));
    check("call; m70; back; m72", Refused(NothingSaved));
    check("call; m70; call; back; m72", After("feed_rate = 0"));
    check("call; m70; call; m72", Refused(NothingSaved));
    check("call; m70; back; call; m72", Refused(NothingSaved));
    check("f1; call; m70; f2; back", After("feed_rate = 2"));
    check("f1; call; m73; f2; call; m73; f3; back", After("feed_rate = 2"));
    check("f1; call; m73; f2; call; m73; f3; back; back", After("feed_rate = 1"));
    check("f1; call; m73; f2; call; f3; back; back", After("feed_rate = 1"));
    check("f1; m73; f2; call; back", After("feed_rate = 2"));
}

#[test]
fn invalidating() {
    check("m70; m71; m72", Refused(NothingSaved));
    check("m71; m72", Refused(NothingSaved));
    check("f1; call; m73; f2; m71; back", After("feed_rate = 2"));
    check("f1; m70; call; m71; back; f2; m72", After("feed_rate = 1"));
    check("m70; m71; f3; m70; f4; m72", After("feed_rate = 3"));
    let refused = &[("saved-state.invalidate-nothing", "refused")];
    check_on(&machine(), refused, "m71", Refused(NothingSaved));
    check_on(&machine(), refused, "m70; m71; m71", Refused(NothingSaved));
}

#[test]
fn one_place_or_one_each() {
    let program = "f200; call; m73; f5; m70; f9; back";
    check(program, After("feed_rate = 200"));
    check("m73; m72", After("feed_rate = 0"));
    check("f1; m70; f2; m73; f3; m72", After("feed_rate = 2"));
    let of_m70 = &[("saved-state.restorable", "m70-only")];
    check_on(&machine(), of_m70, "m73; m72", Refused(NothingSaved));
    check_on(&machine(), of_m70, "f1; m70; f2; m73; f3; m72", After("feed_rate = 1"));
    let both = &[("saved-state.restorable", "m70-only"), ("saved-state.places", "one")];
    check_on(&machine(), both, "m73; m72", Refused(NothingSaved));
    check_on(&machine(), both, "f1; m70; f2; m73; f3; m72", After("feed_rate = 2"));
    check("f200; call; m73; f5; m71; f7; m70; f9; back", After("feed_rate = 9"));
    let one = &[("saved-state.places", "one")];
    check_on(&machine(), one, program, After("feed_rate = 5"));
    check_on(&machine(), one, "f1; m73; f2; m72", After("feed_rate = 1"));
    check_on(
        &machine(),
        one,
        "f200; call; m73; f5; m71; f7; m70; f9; back",
        After("feed_rate = 7"),
    );
    check_on(&machine(), one, "f200; call; m73; f5; m70; f9; m71; back", After("feed_rate = 9"));
}

#[test]
fn ends_and_aborts_restore_nothing() {
    check("f1 g91; call; m73; g90 f2; abort", After("feed_rate = 2, distance = absolute"));
    check("f1 m7; call; m73; f2 m9; m2", After("feed_rate = 2, mist = off"));
}

/// What a call has saved is gone with it; what the main program has saved is there for the next one, or not.
#[test]
fn saved_state_outlives_the_program_by_option() {
    let forgotten: super::Chosen = &[("saved-state.after-run", "forgotten")];
    let program = "f1; m70; f2; call; f3 m70; abort; m72";
    check(program, After("feed_rate = 1"));
    check_on(&machine(), forgotten, program, Refused(NothingSaved));
    check("call; m70; abort; m72", Refused(NothingSaved));
}

#[test]
fn order_within_a_block() {
    // Saving comes after F, S and the spindle, and before coolant and overrides.
    check("f5 m70; f6 m72", After("feed_rate = 5"));
    check("m70 m7; m72", After("mist = off"));
    check("f1; m70; f2; m71 m72", After("feed_rate = 1"));
    check("m70 m71; m72", Refused(NothingSaved));
}

/// Sticky words and the direction of a spline are those of a series, which another motion ends.
#[test]
fn restored_cycles() {
    let every: super::Chosen =
        &[("saved-state.motion-mode", "restored"), ("saved-state.listed-motion", "every")];
    let after = |between: &str, expect| {
        let program = alloc::format!("f100; g0 z5; g98 g81 x1 z-1 r1; m70; {between}; m72; x2");
        check_on(&machine(), every, &program, expect);
    };
    after("m8", After("position = (x2 z5)"));
    after("g0 x5", Refused(MissingWord));
    after("g82 x5 z-2 r1 p1", Refused(MissingWord));
    let spline = "f9; g5 x1 i1 j1 p1 q1; m70; g0 x2; m72; x3 p1 q1";
    check_on(&machine(), every, spline, Refused(MissingWord));
}
