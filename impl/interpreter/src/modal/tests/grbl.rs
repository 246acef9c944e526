//! Choices that Grbl 1.1h decides differently from LinuxCNC, as far as they concern modes.

use gaugeblock_vocabulary::FaultKind::{
    AxisWords, BadArc, MissingWord, ModalConflict, WordOutOfRange, ZeroFeed,
};
use gaugeblock_vocabulary::{Effect, Options, Settings};

use super::Expect::{After, Effects, Refused};
use super::{Chosen, check, check_on, machine, modal, words};
use crate::canon::{Reply, Sink};
use crate::parameters::Numbered;

/// Checks programs under an option.
fn check_under(chosen: Chosen, table: &[(&str, super::Expect)]) {
    for (program, expect) in table {
        check_on(&machine(), chosen, program, *expect);
    }
}

/// The only effect of a full circle about X1 in the second line.
const CIRCLE: super::Expect = Effects("2 arc_feed end=() first_centre=1 second_centre=0 turns=-1");

#[test]
fn arc_without_axis_words_is_refused_by_choice() {
    check("f9; g2 i1", CIRCLE);
    check_under(
        &[("arcs.without-axis-words", "refused")],
        &[
            ("f9; g2 i1", Refused(MissingWord)),
            ("f9; g17 g2 i1", Refused(MissingWord)),
            ("f9; g2 i1 z-2", Refused(MissingWord)),
            ("f9; g18 g3 k1 y3", Refused(MissingWord)),
            ("f9; g2 x2 i1; i1 z2", Refused(MissingWord)),
            ("g2 i1", Refused(ZeroFeed)),
            ("f9; g2 x0 i1", CIRCLE),
            ("f9; g2 y0 i1", CIRCLE),
            (
                "f9; g2 x2 i1",
                Effects("2 arc_feed end=(x2) first_centre=1 second_centre=0 turns=-1"),
            ),
            ("f9 g0 x1; g3 @1 ^90 i-1", After("motion = arc_ccw")),
            ("f9; g2 x2 r1", After("position = (x2)")),
        ],
    );
}

#[test]
fn arc_tolerance_is_in_millimetres_by_choice() {
    let chosen: Chosen = &[("arcs.small-tolerance", "millimetres")];
    for program in ["f9; g2 x2.004 i1", "f9; g2 x2000.45 i1000"] {
        check(program, After("motion = arc_cw"));
        check_on(&machine(), chosen, program, After("motion = arc_cw"));
    }
    for program in ["f9; g2 x2.006 i1", "f9; g2 x2000.55 i1000"] {
        check(program, Refused(BadArc));
        check_on(&machine(), chosen, program, Refused(BadArc));
    }
    for program in ["g20 f9; g2 x0.2004 i0.1", "g20 f9; g2 x199.955 i100"] {
        check(program, After("motion = arc_cw"));
        check_on(&machine(), chosen, program, Refused(BadArc));
    }
    for program in ["g20 f9; g2 x0.2001 i0.1", "g20 f9; g2 x2000.015 i1000"] {
        check_on(&machine(), chosen, program, After("motion = arc_cw"));
    }
    let fine: Chosen = &[("arcs.small-tolerance", "fine")];
    check_on(&machine(), fine, "f9; g2 x2.004 i1", Refused(BadArc));
    check_on(&machine(), fine, "g20 f9; g2 x0.2004 i0.1", Refused(BadArc));
}

#[test]
fn position_keeps_offsets_of_other_axes_by_choice() {
    let program = "g0 x4 y5; g92 x7; g92 y1";
    check(program, After("g92_offset = (y4), position = (x4 y1), #5211 = 0"));
    check_under(
        &[("offsets.position-other-axes", "kept")],
        &[
            (program, After("g92_offset = (x-3 y4), position = (x7 y1), #5211 = -3, #5212 = 4")),
            ("g0 x4; g92 x7; g92 x1", After("g92_offset = (x3), position = (x1)")),
            ("g92 z2; g55; g92 y1", After("g92_offset = (y-1 z-2)")),
            ("g92", Refused(MissingWord)),
        ],
    );
}

#[test]
fn setting_an_origin_needs_axis_words_by_choice() {
    check("g10 l2 p1", After("g5x_offset = ()"));
    check_under(
        &[("offsets.set-without-axes", "refused")],
        &[
            ("g10 l2 p1", Refused(MissingWord)),
            ("g10 l2 p1 r30", Refused(MissingWord)),
            ("g10 l20 p1", Refused(MissingWord)),
            ("g10 l2 p1 x0", After("g5x_offset = ()")),
            ("g10 l2 p1 z3 r30", After("g5x_offset = (z3), rotation = 30")),
            ("g10 l1 p1 r3", After("motion = none")),
        ],
    );
}

#[test]
fn coordinate_systems_are_six_by_choice() {
    check("g10 l2 p9 x1", After("#5381 = 1"));
    check_under(
        &[("offsets.systems", "six")],
        &[
            ("g10 l2 p7 x1", Refused(WordOutOfRange)),
            ("g10 l20 p9 x1", Refused(WordOutOfRange)),
            ("g10 l2 p-1 x1", Refused(WordOutOfRange)),
            ("g10 l2 p257 x1", Refused(WordOutOfRange)),
            ("g10 l2 p6 x1", After("#5321 = 1")),
            ("g10 l20 p0 x1", After("g5x_offset = (x-1)")),
        ],
    );
}

#[test]
fn offset_words_under_g80_are_refused_by_choice() {
    const CODES: [&str; 7] =
        ["g92 x5", "g10 l2 p1 x5", "g10 l20 p1 x5", "g43.1 z5", "g28 z5", "g30 x5 y5", "g52 x1"];
    let chosen: Chosen = &[("motion.offset-words-after-cancel", "refused")];
    for code in CODES {
        let place = |head: &str| alloc::format!("{head}{code}");
        for head in ["", "g80; ", "g80 "] {
            check(&place(head), After("motion = none"));
            check_on(&machine(), chosen, &place(head), Refused(AxisWords));
        }
        check_on(&machine(), chosen, &place("g0; "), After("motion = traverse"));
    }
    check_under(
        chosen,
        &[
            ("g80; g28", Effects("2 straight_traverse end=()")),
            ("g80; g30", Effects("2 straight_traverse end=()")),
            ("g80; g92.1", Effects("")),
            ("g80; g10 l2 p1", Effects("")),
            ("g80; g0 x1", Effects("2 straight_traverse end=(x1)")),
        ],
    );
}

#[test]
fn g49_with_motion_is_refused_by_choice() {
    let chosen: Chosen = &[("tool.length-off-with-motion", "refused")];
    for program in [
        "g49 g0 x1",
        "g0 g49",
        "g49 g1 x1 f1",
        "g49 g2 x2 i1 f1",
        "g49 g3 x2 r1 f1",
        "g49 g38.3 z-1 f1",
        "g49 g38.5 z-1 f1",
        "g49 g28",
        "g49 g30 x1",
        "g49 g92 x1",
        "g49 g10 l2 p1 x1",
        "g49 g53 g0 x1",
    ] {
        check(program, After("tool_length = off"));
        check_on(&machine(), chosen, program, Refused(AxisWords));
    }
    for program in [
        "g49",
        "g49 g90 g55",
        "g49 g4 p1",
        "g49 m8",
        "g80 g49",
        "g49 g28.1",
        "g49 g92.1",
        "g49 g20",
    ] {
        check_on(&machine(), chosen, program, After("tool_length = off"));
    }
    check_on(&machine(), chosen, "g43.1 z2; g0 x1", After("tool_offset = (z2)"));
}

#[test]
fn feed_rate_is_zero_after_inverse_time_by_choice() {
    check("g93 g1 x1 f2; g4 p0", After("feed_rate = 2"));
    check_under(
        &[("feed.after-inverse-time", "zero")],
        &[
            ("g93 g1 x1 f2", After("feed_rate = 2")),
            ("g93 g1 x1 f2; g4 p0", After("feed_rate = 0")),
            ("g93 g1 x1 f2; g0 x2", After("feed_rate = 0")),
            ("g93 g1 x1 f2; m8", After("feed_rate = 0, flood = on")),
            ("g93 g1 x1 f2; g91", After("feed_rate = 0")),
            ("g93 g1 x1 f2; g1 x2 f3; g90", After("feed_rate = 0")),
            ("f7; g93", After("feed_rate = 0")),
            ("g93; f5", After("feed_rate = 5")),
            ("g93 g1 x1 f2; g1 x2", Refused(MissingWord)),
            ("g93; f-1", Refused(WordOutOfRange)),
            ("g94 g1 x1 f2; g4 p0", After("feed_rate = 2")),
            ("g93 g1 x1 f2; g94 f3; g4 p0", After("feed_rate = 3")),
            ("g93 g1 x1 f2; g94", After("feed_rate = 0")),
        ],
    );
    let run =
        super::run(&machine(), &[("feed.after-inverse-time", "zero")], "g93 g1 x1 f2; g0 x2 m8 i1");
    assert!(run.last.1.is_err());
    assert_eq!(run.value("feed_rate"), "2", "a refused block changes nothing");
}

#[test]
fn feed_is_in_the_unit_of_its_block_by_choice() {
    check("g20 f254", After("feed_rate = 10"));
    check_under(
        &[("order.feed-unit", "new")],
        &[
            ("g20 f10", After("feed_rate = 10, units = inch")),
            ("g20 f0.3", After("feed_rate = 0.3")),
            ("g20 f10; g21", After("feed_rate = 254")),
            ("g20; g21 f100 g1 x1", After("feed_rate = 100")),
            ("g21 f0.3", After("feed_rate = 0.3")),
            ("g95; g20 f0.1", After("feed_rate = 0.1")),
            ("g93; g20 g1 x1 f3", After("feed_rate = 3")),
            ("g20 f-1", Refused(WordOutOfRange)),
            ("f254; g20 m8", After("feed_rate = 10")),
            ("f254; m70; f1; g20 m72 f5", After("feed_rate = 10")),
        ],
    );
    check_on(
        &machine(),
        &[("order.feed-unit", "new"), ("units-planes.feed-over-unit-change", "kept")],
        "g20 f10",
        After("feed_rate = 10"),
    );
}

/// The feed rates at dwells.
#[derive(Default)]
struct Dwells {
    settings: Settings,
    feeds: alloc::vec::Vec<f64>,
}

impl Sink for Dwells {
    fn set(&mut self, _line: u32, changed: &Settings) {
        self.settings.overlay(changed);
    }

    fn perform(&mut self, _line: u32, _effect: &Effect) -> Reply {
        self.feeds.extend(self.settings.feed_rate);
        Reply::Done
    }
}

#[test]
fn feed_of_a_new_unit_is_set_before_a_dwell() {
    let options = Options([("order.feed-unit".into(), "new".into())].into());
    let mut numbered = Numbered::new();
    let mut modal = modal(&machine(), &options, &mut numbered).unwrap();
    let mut sink = Dwells::default();
    let flow = modal.execute(&words(1, "g20 f10 g4 p0"), &mut numbered, &mut sink);
    assert!(flow.is_ok());
    assert_eq!(sink.feeds, [254.0], "the dwell comes before the unit");
    assert_eq!(sink.settings.feed_rate, Some(10.0));
}

#[test]
fn optional_stop_does_nothing_by_choice() {
    check("m1", Effects("1 stop optional=yes"));
    check_under(
        &[("pause.optional-stop", "ignored")],
        &[
            ("m1", Effects("")),
            ("g0 x1 m1", Effects("1 straight_traverse end=(x1)")),
            ("m1 m2", Refused(ModalConflict)),
            ("m1 m1", Refused(ModalConflict)),
            ("m0", Effects("1 stop optional=no")),
        ],
    );
}

#[test]
fn unknown_options_are_refused() {
    for id in [
        "arcs.small-tolerance",
        "arcs.without-axis-words",
        "feed.after-inverse-time",
        "motion.offset-words-after-cancel",
        "offsets.position-other-axes",
        "offsets.set-without-axes",
        "offsets.systems",
        "order.feed-unit",
        "pause.optional-stop",
        "tool.length-off-with-motion",
    ] {
        let options = Options([(id.into(), "observed".into())].into());
        assert!(modal(&machine(), &options, &mut Numbered::new()).is_err(), "{id}");
    }
}
