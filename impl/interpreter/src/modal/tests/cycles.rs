//! Canned cycles: the examples of 11.5.45, each cycle's moves, what is sticky, and what is refused.

use gaugeblock_vocabulary::FaultKind::{
    AxisWords, CompensationActive, MissingWord, ModalConflict, NotAnInteger, SpindleOutOfRange,
    UnusedWord, WordOutOfRange, ZeroFeed, ZeroSpeed,
};
use gaugeblock_vocabulary::{Axis, FaultKind, Machine};

use super::Expect::{After, Refused};
use super::{check, machine, run};
use crate::modal::Refusal;

/// The effects of the lines behind a preparation, `rapid` and `feed` for short.
#[track_caller]
pub(super) fn shows(before: &str, program: &str, expected: &[&str]) {
    shows_on(&machine(), before, program, expected);
}

#[track_caller]
fn shows_on(machine: &Machine, before: &str, program: &str, expected: &[&str]) {
    let all = run(machine, &[], &alloc::format!("{before}; {program}"));
    assert!(all.last.1.is_ok(), "{program}: {:?}", all.last);
    let done = run(machine, &[], before).sink.effects.len();
    let found: alloc::vec::Vec<_> = all.sink.effects[done..]
        .iter()
        .map(|effect| effect.split_once(' ').unwrap().1)
        .map(|effect| effect.replace("straight_traverse end=", "rapid "))
        .map(|effect| effect.replace("straight_feed end=", "feed "))
        .collect();
    assert_eq!(found, expected, "{program}");
}

#[test]
fn the_examples_of_the_manual() {
    let at = "f100; g0 x1 y2 z3";
    shows(
        at,
        "g90 g98 g81 x4 y5 z1.5 r2.75",
        &["rapid (x4 y5 z3)", "rapid (x4 y5 z2.75)", "feed (x4 y5 z1.5)", "rapid (x4 y5 z3)"],
    );
    shows(
        at,
        "g91 g98 g81 x4 y5 z-0.5 r1.5 l3",
        &[
            "rapid (x1 y2 z4.5)",
            "rapid (x5 y7 z4.5)",
            "feed (x5 y7 z4)",
            "rapid (x5 y7 z4.5)",
            "rapid (x9 y12 z4.5)",
            "feed (x9 y12 z4)",
            "rapid (x9 y12 z4.5)",
            "rapid (x13 y17 z4.5)",
            "feed (x13 y17 z4)",
            "rapid (x13 y17 z4.5)",
        ],
    );
    shows(
        "f100",
        "g90 g98 g81 x4 y5 z1.5 r2.75",
        &["rapid (z2.75)", "rapid (x4 y5 z2.75)", "feed (x4 y5 z1.5)", "rapid (x4 y5 z2.75)"],
    );
    shows(
        "f100",
        "g90 g98 g81 x4 y5 z-0.5 r1.5 l2",
        &[
            "rapid (z1.5)",
            "rapid (x4 y5 z1.5)",
            "feed (x4 y5 z-0.5)",
            "rapid (x4 y5 z1.5)",
            "rapid (x4 y5 z1.5)",
            "feed (x4 y5 z-0.5)",
            "rapid (x4 y5 z1.5)",
        ],
    );
    // Twelve holes in a square, 11.5.43.7.
    let square = "g90 g0 x0 y0 z0; g1 f50 x0 g4 p0.1; g91 g81 x1 y0 z-0.5 r1 l4; x0 y1 r0 l3; x-1 y0 l3; x0 y-1 l2";
    let holes = run(&machine(), &[], square);
    let feeds =
        |effect: &&alloc::string::String| effect.contains("feed") && effect.contains("z0.5");
    assert_eq!(holes.sink.effects.iter().filter(feeds).count(), 12);
    assert_eq!(holes.value("position"), "(x1 y1 z1)");
    // Eight holes, 11.5.44; the feed is added, the manual leaves it to the lines before.
    let eight = "g90 g0 x0 y0 z0; g1 x0 f9 g4 p0.1; g81 x1 y0 z0 r1; x2; x3; x4; y1 z0.5; x3; x2; x1; g80; g0 x0";
    check(eight, After("position = (y1 z1), motion = traverse"));
}

#[test]
fn each_cycle() {
    let at = "f100; g0 z5; g98";
    let [above, down, bottom, out] =
        ["rapid (x1 z5)", "rapid (x1 z1)", "feed (x1 z-1)", "rapid (x1 z5)"];
    shows(at, "g81 x1 z-1 r1", &[above, down, bottom, out]);
    shows(at, "g82 x1 z-1 r1 p2", &[above, down, bottom, "dwell seconds=2", out]);
    shows(at, "g85 x1 z-1 r1", &[above, down, bottom, "feed (x1 z1)", out]);
    shows(at, "g99 g85 x1 z-1 r1", &[above, down, bottom, "feed (x1 z1)", "rapid (x1 z1)"]);
    shows(at, "m3 s9; g86 x1 z-1 r1 p0", &[above, down, bottom, "dwell seconds=0", out]);
    shows(at, "g89 x1 z-1 r1 p2", &[above, down, bottom, "dwell seconds=2", "feed (x1 z5)"]);
    for tap in ["g74", "g84"] {
        let program = alloc::format!("{tap} x1 z-1 r1 p2");
        shows(at, &program, &[above, down, bottom, "dwell seconds=2", "feed (x1 z5)"]);
    }
}

#[test]
fn pecks() {
    let at = "f100; g0 z5; g98";
    let (above, down, out) = ("rapid (x1 z5)", "rapid (x1 z1)", "rapid (x1 z5)");
    shows(
        at,
        "g83 x1 z-1 r1 q0.75",
        &[
            above,
            down,
            "feed (x1 z0.25)",
            "rapid (x1 z1)",
            "rapid (x1 z0.504)",
            "feed (x1 z-0.5)",
            "rapid (x1 z1)",
            "rapid (x1 z-0.246)",
            "feed (x1 z-1)",
            out,
        ],
    );
    shows(
        at,
        "g73 x1 z-1 r1 q1.5",
        &[above, down, "feed (x1 z-0.5)", "rapid (x1 z-0.246)", "feed (x1 z-1)", down],
    );
    shows(
        "g20; f100; g0 z5; g99",
        "g73 x1 z-1 r1 q1.5",
        &[above, down, "feed (x1 z-0.5)", "rapid (x1 z-0.49)", "feed (x1 z-1)", "rapid (x1 z1)"],
    );
    shows(at, "g83 x1 z-1 r1 q2", &[above, down, "feed (x1 z-1)", out]);
    // Twenty pecks of a tenth, whatever is lost by rounding: 20 down, 19 up.
    let deep = run(&machine(), &[], "f100; g73 x1 z-1 r1 q0.1");
    assert_eq!(deep.sink.effects.len(), 2 + 20 + 19 + 1);
}

/// What the settings are at each effect of a cycle.
fn settings_at(program: &str, setting: &str) -> alloc::string::String {
    struct Watch<'a>(
        &'a str,
        gaugeblock_vocabulary::Settings,
        alloc::vec::Vec<alloc::string::String>,
    );
    impl crate::Sink for Watch<'_> {
        fn set(&mut self, _line: u32, changed: &gaugeblock_vocabulary::Settings) {
            self.1.overlay(changed);
        }
        fn perform(&mut self, _line: u32, effect: &gaugeblock_vocabulary::Effect) -> crate::Reply {
            let found = self.1.entries().into_iter().find(|entry| entry.name() == self.0).unwrap();
            self.2.push(alloc::format!("{} {}", effect.name(), found.value));
            crate::Reply::Done
        }
    }
    let mut numbered = crate::parameters::Numbered::new();
    let mut modal = super::modal(&machine(), &super::Options::default(), &mut numbered).unwrap();
    let mut sink = Watch(setting, modal.settings(), alloc::vec![]);
    for (line, text) in (1..).zip(program.split(';')) {
        modal.execute(&super::words(line, text), &mut numbered, &mut sink).unwrap();
    }
    sink.2.join("; ").replace("straight_", "")
}

#[test]
fn spindle_and_overrides() {
    assert_eq!(
        settings_at("m3 f100; g84 x1 z-1 r1 p0; x2", "spindle[0]"),
        "traverse clockwise; traverse clockwise; feed clockwise; dwell counterclockwise; feed counterclockwise; \
         traverse counterclockwise; feed counterclockwise; dwell counterclockwise; feed counterclockwise"
    );
    assert_eq!(
        settings_at("m4 f100; g74 x1 z-1 r1 p0 $1", "spindle[1]"),
        "traverse counterclockwise; traverse counterclockwise; feed counterclockwise; dwell clockwise; feed clockwise"
    );
    for setting in ["feed_override", "speed_override[2]"] {
        assert_eq!(
            settings_at("f100; g84 x1 z-1 r1 p0 $2; x2 $2", setting),
            "traverse on; traverse on; feed off; dwell off; feed off; traverse on; feed off; dwell off; feed off"
        );
    }
    check("f100; m49; g84 x1 z-1 r1 p0", After("feed_override = off, speed_override[0] = off"));
    check("f100; g84 x1 z-1 r1 p0", After("feed_override = on, speed_override[0] = on"));
    assert_eq!(
        settings_at("m4 f100; g86 x1 z-1 r1 p0; x2", "spindle[0]"),
        "traverse counterclockwise; traverse counterclockwise; feed counterclockwise; dwell counterclockwise; \
         traverse stopped; traverse counterclockwise; feed counterclockwise; dwell counterclockwise; traverse stopped"
    );
    check("m4 f100; g86 x1 z-1 r1 p0", After("spindle[0] = counterclockwise"));
    check("m3 $1 f100; g86 x1 z-1 r1 p0 $1", After("spindle[1] = clockwise"));
    check("m3 $1 f100; g86 x1 z-1 r1 p0", Refused(ZeroSpeed));
    check("f100; g84 x1 z-1 r1 p0 $3", Refused(SpindleOutOfRange));
    check("f100; g81 x1 z-1 r1 $0", Refused(UnusedWord));
}

#[test]
fn sticky_words() {
    let at = "f100; g0 z5; g81 x1 z-1 r1";
    shows(at, "x2", &["rapid (x2 z1)", "feed (x2 z-1)", "rapid (x2 z1)"]);
    shows(at, "g81 x2", &["rapid (x2 z1)", "feed (x2 z-1)", "rapid (x2 z1)"]);
    shows(at, "z-2", &["rapid (x1 z1)", "feed (x1 z-2)", "rapid (x1 z1)"]);
    shows(
        at,
        "y3; m8; f50; x2 r0",
        &[
            "rapid (x1 y3 z1)",
            "feed (x1 y3 z-1)",
            "rapid (x1 y3 z1)",
            "rapid (x2 y3 z1)",
            "rapid (x2 y3)",
            "feed (x2 y3 z-1)",
            "rapid (x2 y3)",
        ],
    );
    shows(
        "f100; g82 x1 z-1 r1 p2",
        "x2; x3 p4",
        &[
            "rapid (x2 z1)",
            "feed (x2 z-1)",
            "dwell seconds=2",
            "rapid (x2 z1)",
            "rapid (x3 z1)",
            "feed (x3 z-1)",
            "dwell seconds=4",
            "rapid (x3 z1)",
        ],
    );
    check("f100; g81 x1 z-1 r1; g83 x1 z-1 q1", Refused(MissingWord));
    check("f100; g81 x1 z-1 r1; g83 x1 r1 q1", Refused(MissingWord));
    check("f100; g81 x1 z-1 r1; g0 x2; g81 x1", Refused(MissingWord));
    check("f100; g81 x1 z-1 r1; g80; g81 x1", Refused(MissingWord));
    check("f100; g81 x1 z-1 r1 l2; x2; x3", After("position = (x3 z1)"));
}

#[test]
fn return_level() {
    // The initial level is that before the series, also from cycle to cycle.
    let at = "f100; g0 z5; g98 g81 x1 z-1 r1";
    shows(
        at,
        "g99 x2; g98 x3; g82 x4 z0 r1 p0",
        &[
            "rapid (x2 z5)",
            "rapid (x2 z1)",
            "feed (x2 z-1)",
            "rapid (x2 z1)",
            "rapid (x3 z1)",
            "feed (x3 z-1)",
            "rapid (x3 z5)",
            "rapid (x4 z5)",
            "rapid (x4 z1)",
            "feed (x4)",
            "dwell seconds=0",
            "rapid (x4 z5)",
        ],
    );
    check("f100; g0 z5; g98 g81 x1 z-1 r1; g80; g0 z3; g81 x1 z-1 r1", After("position = (x1 z3)"));
    check("f100; g0 z5; g98 g81 x1 z-1 r1; g0 z3; g81 x1 z-1 r1", After("position = (x1 z3)"));
    check("f100; g0 z5; g98 g99 g81 x1 z-1 r1", Refused(ModalConflict));
    // The level stays where it is when offsets and units change.
    check("f100; g0 z5; g98 g81 x1 z-1 r1; g92 z0; x2 z-7 r-6", After("position = (x2)"));
    check("f100; g0 z50.8; g98 g81 x1 z-1 r1; g20; x2 z-1 r1", After("position = (x2 z2)"));
}

#[test]
fn every_plane() {
    let machine = Machine {
        axes: alloc::vec![Axis::X, Axis::Y, Axis::Z, Axis::U, Axis::V, Axis::W],
        ..machine()
    };
    for (plane, words, [above, down, bottom]) in [
        ("g17", "x2 y3 z-1", ["(x2 y3 z5)", "(x2 y3 z1)", "(x2 y3 z-1)"]),
        ("g18", "x2 z3 y-1", ["(x2 y5 z3)", "(x2 y1 z3)", "(x2 y-1 z3)"]),
        ("g19", "y2 z3 x-1", ["(x5 y2 z3)", "(x1 y2 z3)", "(x-1 y2 z3)"]),
        ("g17.1", "u2 v3 w-1", ["(u2 v3 w5)", "(u2 v3 w1)", "(u2 v3 w-1)"]),
        ("g18.1", "u2 w3 v-1", ["(u2 v5 w3)", "(u2 v1 w3)", "(u2 v-1 w3)"]),
        ("g19.1", "v2 w3 u-1", ["(u5 v2 w3)", "(u1 v2 w3)", "(u-1 v2 w3)"]),
    ] {
        let normal = &words.split(' ').nth(2).unwrap()[..1];
        let [rapid, again, feed] = [("rapid", above), ("rapid", down), ("feed", bottom)]
            .map(|(how, end)| alloc::format!("{how} {end}"));
        shows_on(
            &machine,
            &alloc::format!("f100; g0 {normal}5; {plane} g98"),
            &alloc::format!("g81 {words} r1"),
            &[&rapid, &again, &feed, &rapid],
        );
    }
    let refused = |program| {
        let run = run(&machine, &[], program);
        assert!(matches!(run.last.1, Err(Refusal::Fault(AxisWords, _))), "{program}");
    };
    refused("f100 g81 x1 z-1 r1 u2");
    refused("f100 g81 u1 w-1 r1");
    refused("g17.1 f100 g81 z-1 r1");
}

#[test]
fn diameter_mode() {
    shows(
        "f100; g7; g0 z5",
        "g81 x8 z-1 r1",
        &["rapid (x4 z5)", "rapid (x4 z1)", "feed (x4 z-1)", "rapid (x4 z1)"],
    );
    check("f100; g7 g91; g81 x8 z-1 r1 l2", After("position = (x8 z1)"));
}

#[test]
fn refused() {
    let at_once = |program: &str, kind: FaultKind| {
        check(&alloc::format!("f100 m3; {program}"), Refused(kind));
    };
    for (program, kind) in [
        ("g81", MissingWord),
        ("g81 r1", MissingWord),
        ("g81 x1 r1", MissingWord),
        ("g81 x1 z-1", MissingWord),
        ("g82 x1 z-1 r1", MissingWord),
        ("g83 x1 z-1 r1", MissingWord),
        ("g82 x1 z-1 r1 p-1", WordOutOfRange),
        ("g86 x1 z-1 r1 p-1", WordOutOfRange),
        ("g83 x1 z-1 r1 q0", WordOutOfRange),
        ("g73 x1 z-1 r1 q-1", WordOutOfRange),
        ("g81 x1 z-1 r1 l0", WordOutOfRange),
        ("g81 x1 z-1 r1 l-2", WordOutOfRange),
        ("g81 x1 z-1 r1 l1.5", NotAnInteger),
        ("g81 x1 z-1 r-2", WordOutOfRange),
        ("g91 g81 x1 z1 r2", WordOutOfRange),
        ("g81 x1 z-1 r1 a5", AxisWords),
        ("g81 x1 z-1 r1 q1", UnusedWord),
        ("g81 x1 z-1 r1 p1", UnusedWord),
        ("g93 g81 x1 z-1 r1", ModalConflict),
        ("g81 g82 x1 z-1 r1 p1", ModalConflict),
        ("g41 g81 x1 z-1 r1", CompensationActive),
        ("g53 g81 x1 z-1 r1", AxisWords),
        ("g80 x1", AxisWords),
        ("g81 x1 z-1 r1 f0", ZeroFeed),
        ("g92 x1 g81 z-1 r1", AxisWords),
    ] {
        at_once(program, kind);
    }
    check("f100; g81 x1 z-1 r1; l2", Refused(UnusedWord));
    check("f100; g81 x1 z-1 r1; g80; x1", Refused(AxisWords));
    // A code of group 0 that uses axis words suspends the cycle (11.4.13).
    check("f100; g81 x1 z-1 r1; g92 x0", After("position = (z1), motion = cycle_81"));
}

#[test]
fn accepted_and_undefined() {
    for code in ["g87", "g88"] {
        let run = run(&machine(), &[], &alloc::format!("f1; {code} x1 z-1 r1 i1 j2 k3"));
        assert!(matches!(run.last.1, Err(Refusal::Unspecified(_))), "{:?}", run.last);
    }
}

#[test]
fn refusal_by_the_sink_rolls_back_the_cycle() {
    struct Refuses(u32);
    impl crate::Sink for Refuses {
        fn set(&mut self, _line: u32, _changed: &gaugeblock_vocabulary::Settings) {}
        fn perform(&mut self, _line: u32, _effect: &gaugeblock_vocabulary::Effect) -> crate::Reply {
            self.0 -= 1;
            if self.0 == 0 {
                crate::Reply::Failed(FaultKind::BeyondLimit)
            } else {
                crate::Reply::Done
            }
        }
    }
    for effects in 1..90 {
        let mut numbered = crate::parameters::Numbered::new();
        let mut modal =
            super::modal(&machine(), &super::Options::default(), &mut numbered).unwrap();
        let mut sink = Refuses(effects);
        let mut execute = |modal: &mut super::Modal, text| {
            let mut flow = modal.execute(&super::words(1, text), &mut numbered, &mut sink);
            while let Ok(super::Flow::Within { .. }) = flow {
                flow = modal.resume_block(&mut numbered, &mut sink);
            }
            flow
        };
        execute(&mut modal, "f100 m3").unwrap();
        let before = (modal.settings(), modal.state());
        let flow = execute(&mut modal, "g84 x1 z-1 r1 p1 l100");
        assert!(matches!(flow, Err(Refusal::Fault(FaultKind::BeyondLimit, _))));
        assert_eq!((modal.settings(), modal.state()), before, "{effects}");
        assert!(execute(&mut modal, "x1").is_err());
    }
}
