//! Straight probing: the recorder's probe touches something at Z-1.

use gaugeblock_vocabulary::FaultKind::{
    AxisWords, CompensationActive, MissingWord, Probe, UnusedWord, ZeroFeed,
};

use super::Expect::{After, Effects, Missed, Refused};
use super::check;

#[test]
fn contact() {
    check("f10; g38.2 z-5", Effects("2 straight_probe end=(z-5)"));
    check(
        "f10; g0 x1 y2 a3; g38.2 z-5",
        After(
            "#5061 = 1, #5062 = 2, #5063 = -1, #5064 = 3, #5069 = 0, #5070 = 1, position = (x1 y2 z-1 a3)",
        ),
    );
    check("f10; g91 g38.4 z-5; g38.3 z2", After("#5063 = 1, #5070 = 0, position = (z1)"));
    check("f10; g38.5 z-5", After("motion = probe_away, #5070 = 1"));
    // In the coordinate system in force.
    check("f10; g10 l2 p1 z-3; g0 z0; g38.2 z-7", After("#5063 = -1"));
    check("f10; g38.2 z-5; z-6", Effects("2 straight_probe end=(z-5); 3 straight_probe end=(z-6)"));
    check("g93 g38.3 z-5 f2", After("feed_rate = 2"));
}

#[test]
fn no_contact() {
    check("f10; g38.3 x4", After("#5061 = 4, #5063 = 0, #5070 = 0, position = (x4)"));
    check("f10; g38.5 x4", After("#5061 = 4, #5070 = 0, motion = probe_away"));
    check("f10; g38.2 x4", Missed);
    check("f10; g38.4 x4", Missed);
    let run = super::run(&super::machine(), &[], "f10; g0 x1; g59.3 g38.2 x4");
    // What the parameters hold after an unsuccessful probe is said of every code.
    assert_eq!((run.value("#5061"), run.value("position")), ("4".into(), "(x4)".into()));
    // The block has been executed as far as that.
    assert_eq!(run.value("motion"), "probe_toward_error");
    assert_eq!(run.value("#5220"), "9");
}

#[test]
fn refused() {
    check("f10; g38.2", Refused(MissingWord));
    check("g38.2 z-5", Refused(ZeroFeed));
    check("f10; g38.2 z0", Refused(Probe));
    check("f10; g91 g38.3 z0", Refused(Probe));
    check("f10; g41 d3; g38.3 z-5", Refused(CompensationActive));
    check("f10; g38.3 z-5 p1", Refused(UnusedWord));
    check("f10; g53 g38.3 z-5", Refused(AxisWords));
    check("f10; g28 g38.3 z-5", Refused(AxisWords));
}
