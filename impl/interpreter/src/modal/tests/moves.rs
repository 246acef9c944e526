//! Straight moves, feed, units, distance, diameter mode, dwell.

use gaugeblock_vocabulary::FaultKind::{
    CompensationActive, MissingWord, ModalConflict, WordOutOfRange, ZeroFeed, ZeroSpeed,
};

use super::Expect::{After, Effects, Refused};
use super::{check, check_on, inch_machine, machine};

#[test]
fn straight_moves() {
    check(
        "g0 x1 y2; g1 z3 f100; x5",
        Effects(
            "1 straight_traverse end=(x1 y2); 2 straight_feed end=(x1 y2 z3); 3 straight_feed end=(x5 y2 z3)",
        ),
    );
    check(
        "g91 g0 x1; x1 a5",
        Effects("1 straight_traverse end=(x1); 2 straight_traverse end=(x2 a5)"),
    );
    check("g7 g0 x4; x6", Effects("1 straight_traverse end=(x2); 2 straight_traverse end=(x3)"));
    check("g0; g1 f1; g80", Effects(""));
    let in_place = &[("motion.without-axis-words", "move-in-place")];
    check_on(
        &machine(),
        in_place,
        "g0 x1; g0; m7",
        Effects("1 straight_traverse end=(x1); 2 straight_traverse end=(x1)"),
    );
    check_on(&machine(), in_place, "g1", Refused(ZeroFeed));
    check("g1", Refused(ZeroFeed));
    check("g1 f1", After("motion = feed"));
    check("g1 x1", Refused(ZeroFeed));
    check("g1 x1 f0", Refused(ZeroFeed));
    check("g0 x1; g1 y1", Refused(ZeroFeed));
    check("f-1", Refused(WordOutOfRange));
    check("g1 x1 f-1", Refused(WordOutOfRange));
}

#[test]
fn feed_modes() {
    check("g93 g1 x1 f2; y1 f3", After("feed_rate = 3"));
    check("g93 g1 x1 f2; y1", Refused(MissingWord));
    check("g93; g1 x1", Refused(MissingWord));
    // G1 needs F, also where it only sets the mode.
    check("g93; g1", Refused(MissingWord));
    check("g93 f5", After("feed_rate = 0"));
    check("g93 g0 x1 f5", After("feed_rate = 0"));
    check("g93 g1 x1 f5; f8", After("feed_rate = 5"));
    check("f100; g95; g1 x1", Refused(ZeroFeed));
    check("f100; g94; g1 x1", After("feed_rate = 100"));
    check("f100; g95 $1 g1 x1 f0.2", After("feed_rate = 0.2, feed_mode = per_revolution"));
    check("g93 f2; g94 g1 x1", Refused(ZeroFeed));
    check("f100; g93", After("feed_rate = 100"));
    check("f100; g93; g1 x1", Refused(MissingWord));
    check("f100; g93; g94", After("feed_rate = 0"));
    check("g96 s100 d900; g1 x1 f5", Refused(ZeroSpeed));
    check("g96 s100 m3; g1 x1 f5; m5; g0 x2; g1 x3", Refused(ZeroSpeed));
    check("g96 s100; g0 x1", Effects("2 straight_traverse end=(x1)"));
}

#[test]
fn units() {
    check("g0 x25.4 a10; g20", After("position = (x1 a10), units = inch"));
    check("g20; f10; g21", After("feed_rate = 254"));
    // F comes before the units in the order of execution.
    check("g20; g21 f10", After("feed_rate = 254"));
    check(
        "g20 g0 x1; g21 x1",
        Effects("1 straight_traverse end=(x1); 2 straight_traverse end=(x1)"),
    );
    check("g93 g20 g1 x1 f2; g21", After("feed_rate = 2"));
    check_on(
        &machine(),
        &[("units-planes.feed-over-unit-change", "kept")],
        "g20; f10; g21",
        After("feed_rate = 10"),
    );
    check("g20 g64 p1 q0.5; g21", After("blend_tolerance = 25.4, naive_cam_tolerance = 12.7"));
    check("g20 g43.1 z1; g21", After("tool_offset = (z25.4), position = (z-25.4)"));
    check_on(
        &inch_machine(),
        &[],
        "g20 g10 l2 p1 x2; g21",
        After("g5x_offset = (x50.8), #5221 = 2"),
    );
    check("g20; g20 g21", Refused(ModalConflict));
}

#[test]
fn machine_coordinates() {
    check("g10 l2 p1 x10; g92 x5; g0; g53 x0 y1", Effects("4 straight_traverse end=(x5 y1)"));
    check("g10 l2 p1 x10 r360; g53 g0 x10 y4", After("rotation = 360"));
    check(
        "g91 g53 g0 x1; g53 x1",
        Effects("1 straight_traverse end=(x1); 2 straight_traverse end=(x1)"),
    );
    check("g41 d3; g53 g0 x1", Refused(CompensationActive));
}

#[test]
fn path_and_dwell() {
    check("g64", After("path = continuous, blend_tolerance = 0, naive_cam_tolerance = 0"));
    check("g64 p0.1", After("blend_tolerance = 0.1, naive_cam_tolerance = 0.1"));
    check("g64 p0.1 q0", After("blend_tolerance = 0.1, naive_cam_tolerance = 0"));
    check("g61", After("path = exact_path"));
    check("g61.1", After("path = exact_stop"));
    check("g64 p-1", Refused(WordOutOfRange));
    check("g4 p0.5", Effects("1 dwell seconds=0.5"));
    check("g4 p-0.1", Refused(WordOutOfRange));
    check("g1 x1 g4 p1 f1", Effects("1 dwell seconds=1; 1 straight_feed end=(x1)"));
}

#[test]
fn compensation() {
    check("g41", After("compensation = left"));
    check("g42 d1", After("compensation = right"));
    check("g18 g42.1 d3 l2; g40", After("compensation = off"));
    check("g41 d3; g0 x1", Effects("2 straight_traverse end=(x1)"));
    check("g41 d1; g0 x4", After("position = (x4 y3)"));
    check("g41; g42", Refused(CompensationActive));
    check("g41; g55", Refused(CompensationActive));
    check("g19; g41", Refused(ModalConflict));
    check("g19 g41", Refused(ModalConflict));
    check("g18; g41.1 d1 l10", Refused(WordOutOfRange));
    check("g41 d9", Refused(gaugeblock_vocabulary::FaultKind::ToolNotFound));
    check("g41 d-1", Refused(WordOutOfRange));
    check("g41 d1.5", Refused(gaugeblock_vocabulary::FaultKind::NotAnInteger));
}

#[test]
fn machine_coordinates_of_a_turned_system() {
    let run = super::run(&machine(), &[], "g10 l2 p1 x10 r90; g53 g0 x10 y4; g0 x1");
    let [x, y, ..] = run.modal.position.0;
    assert!((x - 1.0).abs() < 1e-9 && y.abs() < 1e-9, "{x} {y}");
    let machine_y =
        run.modal.predefined(crate::parameters::Predefined::from_name("_abs_y").unwrap());
    assert!((machine_y - 1.0).abs() < 1e-9, "{machine_y}");
}
