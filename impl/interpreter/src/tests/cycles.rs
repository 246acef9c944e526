//! Canned cycles in whole programs: a step is bounded work, and where a cycle is interrupted changes nothing.

use alloc::string::{String, ToString as _};
use alloc::vec::Vec;

use gaugeblock_vocabulary::{Effect, End, Machine, Options, Settings};
use proptest::prelude::*;

use super::{Recorder, check_all};
use crate::{Error, Interpreter, Limits, Memory, Progress, Reply, Sink};

#[test]
fn cycles_in_programs() {
    check_all(&[
        (
            "f100\ng91 g81 x1 z-1 r1 l3 m2\n",
            "accepted; count straight_feed = 3; at 2 straight_feed end=(x3)",
        ),
        ("f100\ng81 x1 z-1 r1 l1000\nm2\n", "accepted; count straight_feed = 1000"),
        ("f100\ng73 z-1 r1 q0.001 l2\nm2\n", "accepted; count straight_feed = 4000"),
        (
            "f100\ng81 x1 z-1 r1\no1 repeat [5]\nx[#5420+1] l100\no1 endrepeat\nm2\n",
            "accepted; count straight_feed = 501; at 4 straight_feed end=(x6 z-1)",
        ),
        (
            "o1 sub\ng81 x#1 z-1 r1 l50 (msg,drilled)\no1 endsub\nf100\no1 call [7]\nm2\n",
            "accepted; count straight_feed = 50; messages: drilled; at 2 straight_feed end=(x7 z-1)",
        ),
        ("f100\ng81 x1 z-1 r1 l99 m0\nm2\n", "accepted; count stop = 1"),
        ("f100\ng87 x1 z-1 r1\nm2\n", "ends unspecified"),
        ("f100\ng81 x1 z-1\nm2\n", "refused at 2 missing_word"),
        ("f100\ng38.2 x1 z-1\nm2\n", "refused at 2 probe"),
        ("f100\ng38.3 x4 z-1\nm2\n", "accepted; #5061 = 4; #5063 = -1; #5070 = 0"),
    ]);
}

/// Counts effects, and asks to stop at every so many.
struct Stops {
    effects: Vec<String>,
    every: usize,
}

impl Sink for Stops {
    fn set(&mut self, _line: u32, changed: &Settings) {
        self.effects.push(alloc::format!("{:?}", changed.entries()));
    }

    fn perform(&mut self, line: u32, effect: &Effect) -> Reply {
        self.effects.push(alloc::format!("{line} {effect:?}"));
        if self.effects.len().is_multiple_of(self.every) { Reply::Stop } else { Reply::Done }
    }
}

fn interpreter() -> Interpreter {
    Interpreter::new(Machine::default(), Options::default(), Limits::default()).unwrap()
}

/// Runs a program, so many blocks at a time, for no more than so many calls.
fn effects(program: &str, every: usize, blocks: u64, calls: u32) -> (Vec<String>, Option<End>) {
    let mut interpreter = interpreter();
    let mut source = Memory::new(program);
    let mut sink = Stops { effects: Vec::new(), every };
    for _ in 0..calls {
        match interpreter.run(&mut source, &mut sink, blocks) {
            Ok(Progress::Ended(end)) => return (sink.effects, Some(end)),
            Ok(Progress::More | Progress::Stopped) => {}
            Err(Error::Fault(fault)) => return (alloc::vec![fault.message], None),
            Ok(Progress::Aborted) => panic!("nobody breaks it off"),
            Err(error) => panic!("{error}"),
        }
    }
    (sink.effects, None)
}

#[test]
fn a_step_is_bounded() {
    for cycle in [
        "g81 x1 z-1 r1 l4000000000000000",
        "g73 z-1000000000000000 r0 q0.001",
        "g83 z-1000000000000000 r0 q0.001 l1000000000",
        "g84 z-1 r0 p0 l999999999999",
        "g18 g76 p1 z-9 i-1 j0.001 k1000000000 r1",
        "g18 g76 p1 z-9 i-1 j0.001 k1 r1000000000",
        "g18 g76 p1 z-9 i-1 j1 k1 h2000000000",
    ] {
        let program = alloc::format!("f100 m3\n{cycle}\nm2\n");
        let mut interpreter = interpreter();
        let mut source = Memory::new(&*program);
        let mut sink = Stops { effects: Vec::new(), every: usize::MAX };
        let mut before = 0;
        for _ in 0..50 {
            let progress = interpreter.step(&mut source, &mut sink).unwrap();
            assert_eq!(progress, Progress::More, "{cycle}");
            assert!(sink.effects.len() - before <= 64, "{cycle}");
            before = sink.effects.len();
        }
        assert!(before > 800, "{cycle}: {before}");
        // An operator can abort within it, and then run something else.
        interpreter.abort(&mut Recorder::default());
        let settings = interpreter.settings();
        assert_eq!(settings.feed_override, Some(gaugeblock_vocabulary::Switch::On), "{cycle}");
        let mut recorder = Recorder::default();
        let end = interpreter.run(&mut Memory::new("g0 x1\nm2\n"), &mut recorder, 9);
        assert_eq!(end, Ok(Progress::Ended(End::ProgramEnd)));
        assert_eq!(recorder.done.len(), 2);
    }
}

/// Words of a cycle that is accepted.
fn cycle() -> impl Strategy<Value = String> {
    let code = "(g73 q0\\.3|g74 p1|g81|g82 p2|g83 q0\\.4|g84 p0|g85|g86 p1|g89 p1)";
    (code, "( x[1-3]| y2|)( z-[1-3])( r[1-3])( l[1-9]0?|)", "( g98| g99|)( g90| g91|)( m0| m1|)")
        .prop_map(|(code, words, modes)| code + &words + &modes)
}

/// Where a program runs out of Z, the cycle's bottom is above R.
fn program() -> impl Strategy<Value = String> {
    proptest::collection::vec(
        prop_oneof![4 => cycle(), 2 => "(x[1-3]|y-1 l3|r2 x1)", 1 => "(g0 z[2-9]|g1 x2|m8)"],
        1..6,
    )
    .prop_map(|lines| alloc::format!("f100 m3\n{}\nm2\n", lines.join("\n")))
}

/// The end point of a move that an effect shows.
fn point(effect: &str) -> Option<[f64; 3]> {
    let inner = effect.split_once("end=(")?.1.strip_suffix(')')?;
    let mut point = [0.0; 3];
    for word in inner.split(' ').filter(|word| !word.is_empty()) {
        let (axis, value) = word.split_at(1);
        point["xyz".find(axis)?] = value.parse().ok()?;
    }
    Some(point)
}

#[expect(clippy::float_cmp, reason = "the numbers are written and not calculated")]
fn check_hole(cycle: &str, start: i8, old: &str) {
    let words = cycle.replace(" g98", "").replace(" g99", "").replace(" g91", "");
    let program = alloc::format!("f100 m3 g0 z{start}\n{old} {words}\nm2\n");
    let mut recorder = Recorder::default();
    let mut interpreter = interpreter();
    let end = interpreter.run(&mut Memory::new(&*program), &mut recorder, 10_000);
    assert!(matches!(end, Ok(Progress::Ended(_))), "{program} {end:?}");
    let number = |letter| {
        let word = words.split(' ').find_map(|word| word.strip_prefix(letter));
        word.map(|word| word.parse::<f64>().unwrap())
    };
    let (retract, bottom) = (number('r').unwrap(), number('z').unwrap());
    let points = recorder.effects.iter().filter(|(line, _)| *line == 2);
    let ends: Vec<[f64; 3]> = points.filter_map(|(_, text)| point(text)).collect();
    let lowest = ends.iter().map(|[_, _, z]| *z).fold(f64::INFINITY, f64::min);
    assert_eq!(lowest, bottom);
    // G73 ends at R, whatever the return mode says.
    let returns = old == "g98" && !cycle.starts_with("g73");
    let clear = if returns { retract.max(f64::from(start)) } else { retract };
    assert_eq!(ends.last().unwrap()[2], clear);
    for pair in ends.windows(2) {
        let ([x0, y0, z0], [x1, y1, z1]) = (pair[0], pair[1]);
        assert!(z0 == z1 || (x0, y0) == (x1, y1), "{pair:?}");
        assert!((x0, y0) == (x1, y1) || z0 >= retract, "{pair:?}");
    }
    let at_bottom = ends.iter().filter(|[_, _, z]| *z == bottom).count();
    assert_eq!(at_bottom.to_string().parse(), Ok(number('l').unwrap_or(1.0)));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn interruptions_change_nothing(program in program(), every in 1_usize..5, blocks in 1_u64..4) {
        let whole = effects(&program, usize::MAX, 100_000, 1);
        prop_assert_eq!(effects(&program, every, blocks, 100_000), whole, "{}", program);
    }

    /// A cycle ends at its clear level, moves along the normal axis while it is in the hole, and never goes below its
    /// bottom.
    #[test]
    fn a_hole_is_a_hole(cycle in cycle(), start in 0_i8..6, old in proptest::bool::ANY) {
        check_hole(&cycle, start, if old { "g98" } else { "g99" });
    }
}
