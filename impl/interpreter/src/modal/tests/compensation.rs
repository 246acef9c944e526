//! Moves under cutter compensation: the worked programs of `docs/compensation.md`, refusals, and what waits.

use alloc::string::String;
use alloc::vec::Vec;

use gaugeblock_vocabulary::{Effect, FaultKind, Settings, Tool};

use crate::canon::{Reply, Sink, Waiting};
use crate::limits::Limits;
use crate::parameters::Numbered;

use super::super::{Flow, Modal, Refusal};
use super::{Expect, check, check_on, inch_machine, machine, modal, words};

/// The path in the plane: a line per move, as `(x,y)` or `A(x,y, i,j, turns)`.
#[derive(Default)]
pub(super) struct Path(pub(super) Vec<Vec<f64>>);

impl Sink for Path {
    fn set(&mut self, _line: u32, _changed: &Settings) {}

    fn perform(&mut self, _line: u32, effect: &Effect) -> Reply {
        if let Effect::StraightTraverse { end } | Effect::StraightFeed { end } = effect {
            self.0.push([end.x, end.y].into());
        } else if let Effect::ArcFeed { end, first_centre, second_centre, turns } = effect {
            let arc = [end.x, end.y, *first_centre, *second_centre, f64::from(*turns)];
            self.0.push(arc.into());
        }
        Reply::Done
    }
}

/// Runs a program whose blocks are parted by semicolons. Words that have no space between them are not understood.
pub(super) fn path(program: &str) -> (Path, Modal, Result<Flow, Refusal>) {
    let mut numbered = Numbered::new();
    let mut modal = modal(&inch_machine(), &Default::default(), &mut numbered).unwrap();
    let mut path = Path::default();
    let mut result = Ok(Flow::More);
    for (line, text) in (1..).zip(program.split(';')) {
        result = modal.execute(&words(line, text), &mut numbered, &mut path);
        if result.is_err() {
            break;
        }
    }
    (path, modal, result)
}

#[track_caller]
fn check_path(program: &str, moves: &[&[f64]]) {
    let (path, _, result) = path(&alloc::format!("g20 f10;{program};m2"));
    assert!(result.is_ok(), "{program}: {result:?}");
    let same = path.0.len() == moves.len()
        && path.0.iter().zip(moves).all(|(found, expected)| {
            found.len() == expected.len()
                && found.iter().zip(*expected).all(|(a, b)| (a - b).abs() < 1e-7)
        });
    assert!(same, "{program}: {:?}", path.0);
}

#[test]
fn worked_programs() {
    check_path(
        "g41.1 d.5;g1 x1;y1;x0;y0;g40;x2",
        &[&[0.75, 0.25], &[0.75, 0.75], &[0.25, 0.75], &[0.25, 0.0], &[2.0, 0.0]],
    );
    check_path(
        "g42.1 d.5;g1 x1;y1;x0;g40;x-2",
        &[
            &[1.0, -0.25],
            &[1.25, 0.0, 1.0, 0.0, 1.0],
            &[1.25, 1.0],
            &[1.0, 1.25, 1.0, 1.0, 1.0],
            &[0.0, 1.25],
            &[-2.0, 1.0],
        ],
    );
    check_path(
        "g41.1 d.5;g1 x1;x2;x1;x0",
        &[&[1.0, 0.25], &[2.0, 0.25], &[2.0, -0.25, 2.0, 0.0, -1.0], &[1.0, -0.25], &[0.0, -0.25]],
    );
    check_path(
        "g41.1 d.5;g1 x1;x2;g3 x4 i1;g1 x5",
        &[
            &[1.0, 0.25],
            &[2.0, 0.25],
            &[2.25, 0.0, 2.0, 0.0, -1.0],
            &[3.75, 0.0, 3.0, 0.0, 1.0],
            &[4.0, 0.25, 4.0, 0.0, -1.0],
            &[5.0, 0.25],
        ],
    );
    check_path(
        "g42.1 d.5;g1 x1;x2;g3 x4 i1;g1 x5",
        &[
            &[1.0, -0.25],
            &[1.775_255_128_6, -0.25],
            &[4.224_744_871_4, -0.25, 3.0, 0.0, 1.0],
            &[5.0, -0.25],
        ],
    );
    check_path(
        "g41.1 d.5;g1 x3;g3 i-1;g1 x-5",
        &[&[2.707_106_781_2, 0.25], &[2.707_106_781_2, -0.25, 2.0, 0.0, 1.0], &[-5.0, -0.25]],
    );
    check_path(
        "g42.1 d.5;g0 x1;g1 y1;g0 x0",
        &[&[1.0, -0.25], &[1.25, 0.0, 1.0, 0.0, 1.0], &[1.25, 1.0], &[1.0, 1.25], &[0.0, 1.25]],
    );
    check_path(
        "g41.1 d.5;g1 x1;y.5;x0;y3",
        &[&[0.75, 0.25], &[0.75, 0.25], &[0.0, 0.25], &[-0.25, 0.5, 0.0, 0.5, -1.0], &[-0.25, 3.0]],
    );
    check_path("g41.1 d.5;g2 x1 y1 i1", &[&[1.0, 1.25, 1.0, 0.225, -1.0]]);
}

#[test]
fn other_moves() {
    // G91 counts from programmed points, a negative diameter changes the side, units convert the cutter.
    let square: &[&[f64]] = &[&[0.75, 0.25], &[0.75, 0.75], &[0.0, 0.75]];
    check_path("g41.1 d.5;g91 g1 x1;y1;x-1", square);
    check_path("g42.1 d-.5;g1 x1;y1;x0", square);
    check_path("g21;g41.1 d12.7;g20;f10;g1 x1;y1;x0", square);
    // A stop puts out what waits; the corner after it is not cut.
    check_path("g41.1 d.5;g1 x1;m0;y1;x0", &[&[1.0, 0.25], &[0.75, 0.75], &[0.0, 0.75]]);
    // The cutter of a lathe.
    let (path, ..) = path("g20 f10;g18 g41.1 d-.5 l2;g1 z1;x1;m2");
    let ends: Vec<f64> = path.0.iter().map(|numbers| numbers[0]).collect();
    assert_eq!(ends, [-0.5, -0.25, 0.75]);
    // A move out of the plane takes the end that the corner gives.
    check_path("g41.1 d.5;g1 x1;z1;y1", &[&[0.75, 0.25], &[0.75, 0.25], &[0.75, 1.0]]);
    // A cutter without a radius moves nothing.
    check_path("g41.1 d0;g1 x1;g40;y0.1", &[&[1.0, 0.0], &[1.0, 0.1]]);
    // An entry of R is long enough, and so is one along an arc.
    check_path("g41.1 d.5;g1 x.25;x3", &[&[0.25, 0.25], &[3.0, 0.25]]);
    // The programmed point is current again after G40.
    check_path(
        "g41.1 d.5;g1 x1;g40;z1;g3 x3 i1",
        &[&[1.0, 0.25], &[1.0, 0.0], &[3.0, 0.0, 2.0, 0.0, 1.0]],
    );
}

#[test]
fn positions() {
    check_on(
        &inch_machine(),
        &[],
        "g20 f10;g41.1 d.5;g1 x1;y1",
        Expect::After("#5420 = 0.75, #5421 = 1"),
    );
    check_on(
        &inch_machine(),
        &[],
        "g20 f10;g41.1 d.5;g1 x1;y1;g40",
        Expect::After("#5420 = 1, #5421 = 1"),
    );
    check_on(
        &inch_machine(),
        &[],
        "g20 f10;g41.1 d.5;g1 x1;y1;g21",
        Expect::After("#5420 = 19.049999999999997, #5421 = 25.4"),
    );
}

#[test]
fn geometry_that_is_refused() {
    let refused = |program| {
        check_on(&inch_machine(), &[], program, Expect::Refused(FaultKind::Gouging));
    };
    // Entries.
    refused("g20 f10;g41.1 d.5;g1 x.24");
    refused("g20 f10;g41.1 d.5;g1 z1");
    refused("g20 f10;g41.1 d.5;g2 i1");
    refused("g20 f10;g41.1 d.5;g3 x.4 i.2");
    // An arc that is too small, and one that the corner does not reach.
    refused("g20 f10;g41.1 d.5;g1 x1;g3 x1.5 i.25");
    refused("g20 f10;g41.1 d1;g1 x1;x3;g3 x1.8 i-.6");
    // The cutter does not fit.
    refused("g20 f10;g41.1 d.5;g1 x1;y.49;x0");
    refused("g20 f10;g41.1 d.5;g1 x1;y.2;g40");
    refused("g20 f10;g41.1 d.5;g1 x1;y.2;m2");
    // The exit is not an arc; a dwell does not change that.
    refused("g20 f10;g41.1 d.5;g1 x1;g40;g4 p1;g2 x2 i.5");
    refused("g20 f10;g41.1 d.5;g40;g2 x2 i.5");
    refused("g20 f10;g41.1 d.5;g1 x1;g40;g41.1 d.5;g3 x3 i1");
    // A line of the exit is longer than the diameter, also up, and from the programmed point.
    refused("g20 f10;g41.1 d.5;g1 x1;g40;g0 x1.2");
    refused("g20 f10;g41.1 d.5;g1 x1;g40;z.3");
    refused("g20 f10;g41.1 d.5;g1 x1;g40;g41.1 d.1;x1.2");
}

#[test]
fn codes_that_are_refused() {
    let refused = |program| check(program, Expect::Refused(FaultKind::CompensationActive));
    refused("f10;g41.1 d2;g1 x5;g42.1 d3");
    refused("f10;g41.1 d2;g1 x5;g28");
    refused("f10;g41.1 d2;g1 x5;g0 g53 x1");
    refused("f10;g41.1 d2;g1 x5;g55");
    refused("f10;g41.1 d2;g1 x5;g38.2 x9");
    refused("f10;g41.1 d2;g1 x5;g81 x9 z-1 r1");
    refused("f10;g41.1 d2;g1 x5;g5 x9 i1 j1 p1 q1");
    refused("f10;g41.1 d2;g1 x5;g5.1 x9 i1 j1");
    for (choice, code) in [
        ("units-planes.plane-under-compensation", "g18"),
        ("offsets.change-under-compensation", "g92 x1"),
        ("offsets.change-under-compensation", "g10 l2 p1 x1"),
        ("tool.length-under-compensation", "g49"),
        ("tool.change-under-compensation", "t1 m6"),
        ("overrides.under-compensation", "m49"),
        ("outputs.under-compensation", "m64 p0"),
        ("inputs.under-compensation", "m66 p0 l0"),
    ] {
        let program = alloc::format!("f10;g41.1 d2;g1 x5;{code}");
        let run = super::run(&machine(), &[(choice, "refused")], &program);
        let kind = matches!(run.last.1, Err(Refusal::Fault(FaultKind::CompensationActive, _)));
        assert!(kind && run.last.0 == 4, "{program}: {:?}", run.last);
    }
    let mut tooled = machine();
    tooled.tools = [Tool { number: 1, diameter: 2.0, orientation: 3, ..Tool::default() }].into();
    check_on(&tooled, &[], "f10;g41 d1", Expect::Refused(FaultKind::ModalConflict));
    check_on(&tooled, &[], "f10;g18 g41 d1", Expect::After("compensation = left"));
}

#[test]
fn what_documents_leave_open() {
    for program in [
        "f10;g41.1 d2;g1 x5;m61 q1",
        "f10;g41.1 d2;g1 x5;m101",
        "f10;g41.1 d2;m70;g40;m72;g1 x5",
        "f10;m70;g41.1 d2;g1 x5;m72",
        "f10;call;m73;g41.1 d2;g1 x5;back;g1 x9",
        "f10;g18 g41.1 d2 l3;g2 x5 z5 i5",
        "f10;g41.1 d2;g1 x5;m0;g3 x1 y4 i-4",
        "s5 m3;f10;g41.1 d2;g1 x5;g33 z-1 k1",
    ] {
        check(program, Expect::Unspecified);
    }
}

/// Writes down effects as they are put out, and what is held and released.
#[derive(Default)]
struct Places {
    calls: Vec<String>,
    next: u64,
}

impl Sink for Places {
    fn set(&mut self, line: u32, changed: &Settings) {
        let feed = changed.feed_rate.map_or(String::new(), |rate| alloc::format!(" f{rate}"));
        self.calls.push(alloc::format!("{line} set{feed}"));
    }

    fn perform(&mut self, line: u32, effect: &Effect) -> Reply {
        self.calls.push(alloc::format!("{line} {}", effect.name()));
        Reply::Done
    }

    fn hold(&mut self, line: u32, waiting: Waiting<'_>) -> u64 {
        let what = if let Waiting::Effect(effect) = waiting { effect.name() } else { "settings" };
        self.next += 1;
        self.calls.push(alloc::format!("{line} hold {what} {}", self.next));
        self.next
    }

    fn release(&mut self, place: u64) {
        self.calls.push(alloc::format!("release {place}"));
    }
}

#[test]
fn what_waits_comes_in_program_order() {
    let mut numbered = Numbered::new();
    let mut modal = modal(&machine(), &Default::default(), &mut numbered).unwrap();
    let mut places = Places::default();
    for (line, text) in (1..).zip("f10;g42.1 d2;g1 x5;f20;g4 p1;t1;z1;m8;y5 f30;g40".split(';')) {
        assert!(modal.execute(&words(line, text), &mut numbered, &mut places).is_ok(), "{text}");
    }
    let expected = "1 set f10; 2 set; 3 hold straight_feed 1; 4 hold settings 2; 5 hold dwell 3; \
        6 prepare_tool; 7 hold straight_feed 4; 8 hold settings 5; release 1; 3 straight_feed; \
        release 2; 4 set f20; release 3; 5 dwell; release 4; 7 straight_feed; release 5; 8 set; \
        9 set f30; 9 arc_feed; 9 hold straight_feed 6; release 6; 9 straight_feed; 10 set";
    assert_eq!(places.calls.join("; "), expected);
}

#[test]
fn an_error_loses_what_waits() {
    let run = super::run(&machine(), &[], "f10;g41.1 d2;g1 x5;y9;z1;g28");
    assert_eq!(run.sink.effects.len(), 1, "{:?}", run.sink.effects);
    assert!(!run.modal.compensation.waits());
}

#[test]
fn what_waits_is_bounded() {
    let mut numbered = Numbered::new();
    let mut modal = modal(&machine(), &Default::default(), &mut numbered).unwrap();
    modal.set_limits(&Limits { waiting_effects: 10, ..Limits::default() });
    let mut path = Path::default();
    for (line, text) in (1..).zip(["f10", "g41.1 d2", "g1 x5"]) {
        assert!(modal.execute(&words(line, text), &mut numbered, &mut path).is_ok());
    }
    let refusal = (4..40)
        .find_map(|line| modal.execute(&words(line, "g4 p1"), &mut numbered, &mut path).err());
    assert_eq!(refusal, Some(Refusal::LimitExceeded(crate::Limit::WaitingEffects)));
}
