//! Predefined named parameters, position parameters, and what is told to the sink.

use alloc::format;
use alloc::string::{String, ToString};

use super::{machine, run};
use crate::parameters::Predefined;

/// A name's value after a program.
fn named(options: &[(&str, &str)], program: &str, name: &str) -> String {
    let run = run(&machine(), options, program);
    assert!(run.last.1.is_ok(), "{program}: {:?}", run.last);
    run.modal.predefined(Predefined::from_name(name).unwrap()).to_string()
}

#[test]
fn names_report_the_modes() {
    for (program, name, value) in [
        ("m5", "_motion_mode", 800.0),
        ("g0", "_motion_mode", 0.0),
        ("f1 g1", "_motion_mode", 10.0),
        ("g18.1", "_plane", 181.0),
        ("g18", "_plane", 180.0),
        ("m5", "_plane", 170.0),
        ("g42.1 d1", "_ccomp", 421.0),
        ("m5", "_ccomp", 400.0),
        ("g20", "_metric", 0.0),
        ("g20", "_imperial", 1.0),
        ("g91", "_absolute", 0.0),
        ("g91", "_incremental", 1.0),
        ("g93", "_inverse_time", 1.0),
        ("g95", "_units_per_rev", 1.0),
        ("g95", "_units_per_minute", 0.0),
        ("g55", "_coord_system", 550.0),
        ("g59", "_coord_system", 590.0),
        ("g59.1", "_coord_system", 591.0),
        ("g59.3", "_coord_system", 593.0),
        ("g43 h3", "_tool_offset", 1.0),
        ("g49", "_tool_offset", 0.0),
        ("g98", "_retract_old_z", 1.0),
        ("g98", "_retract_r_plane", 0.0),
        ("g96 s1", "_spindle_css_mode", 1.0),
        ("g96 s1", "_spindle_rpm_mode", 0.0),
        ("g90.1", "_ijk_absolute_mode", 1.0),
        ("g7", "_lathe_diameter_mode", 1.0),
        ("g7", "_lathe_radius_mode", 0.0),
        ("m4", "_spindle_on", 1.0),
        ("m4", "_spindle_cw", 0.0),
        ("m3", "_spindle_cw", 1.0),
        ("m19 r1 q1", "_spindle_on", 0.0),
        ("m7", "_mist", 1.0),
        ("m8", "_flood", 1.0),
        ("m51 p0", "_speed_override", 0.0),
        ("m51 p0", "_feed_override", 1.0),
        ("m52", "_adaptive_feed", 1.0),
        ("m53 p0", "_feed_hold", 0.0),
        ("f5.5", "_feed", 5.5),
        ("s70", "_rpm", 70.0),
        ("g0 x1 y2 z3", "_z", 3.0),
        ("g0 a4 b5 c6", "_c", 6.0),
        ("g10 l2 p1 x5; g0 x1", "_abs_x", 6.0),
        ("g7 g0 x4", "_x", 2.0),
        ("t1 m6", "_current_tool", 1.0),
        ("m5", "_selected_tool", -1.0),
        ("t2", "_selected_tool", 2.0),
        ("m5", "_selected_pocket", -1.0),
        ("t2", "_selected_pocket", 2.0),
        ("t1 m6", "_current_pocket", 1.0),
        ("m5", "_current_pocket", 0.0),
    ] {
        assert_eq!(named(&[], program, name), value.to_string(), "{program} {name}");
    }
}

#[test]
fn names_follow_options() {
    let written = &[("parameters.override-names", "as-written")];
    assert_eq!(named(written, "m50 p0", "_speed_override"), "0");
    assert_eq!(named(written, "m50 p0", "_feed_override"), "1");
    let written = &[("parameters.retract-names", "as-written")];
    assert_eq!(named(written, "g98", "_retract_old_z"), "0");
    assert_eq!(
        named(&[("parameters.lathe-flags", "lathe-only")], "g7", "_lathe_diameter_mode"),
        "0"
    );
    let turning = &[("parameters.spindle-on-at-zero", "turning")];
    assert_eq!(named(turning, "s0 m3", "_spindle_on"), "0");
    assert_eq!(named(turning, "s1 m3", "_spindle_on"), "1");
    assert_eq!(named(&[], "s0 m3", "_spindle_on"), "1");
}

#[test]
fn names_that_are_none() {
    for name in ["_x ", "x", "_X", "_line", "_value", "_abs_u", "", "_motion"] {
        assert_eq!(Predefined::from_name(name), None, "{name}");
    }
    for (name, value) in Predefined::ALL {
        assert_eq!(Predefined::from_name(name), Some(*value));
    }
}

#[test]
fn position_parameters() {
    let mut run = run(&machine(), &[], "g0 x1 c3");
    assert_eq!(run.modal.numbered(5420), Some(1.0));
    assert_eq!(run.modal.numbered(5425), Some(3.0));
    assert_eq!(run.modal.numbered(5428), Some(0.0));
    assert_eq!(run.modal.numbered(5419), None);
    assert_eq!(run.modal.numbered(5429), None);
    run.modal.publish(&mut run.numbered);
    assert_eq!(run.numbered.get(5425).to_string(), "3");
}

#[test]
fn only_changes_are_reported() {
    let told = |program: &str| run(&machine(), &[], program).sink.reported;
    assert_eq!(told("g17 g21 g90 g94 g40 g49 g54; m5; m9; m48; s0"), 0);
    assert_eq!(told("f5; g1 x1 f5; x2 f5; g0 x3"), 1);
    assert_eq!(told("g20 g91 f5"), 1);
    assert_eq!(told("m7; m7; m9; m9"), 2);
    let run = run(&machine(), &[], "m3 $1");
    assert_eq!(format!("{:?}", run.sink.settings.spindle.unwrap().0.len()), "3");
}
