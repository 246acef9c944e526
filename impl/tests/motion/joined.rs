//! Segments of which several are over within a cycle become one leg, within their tolerance.

use gaugeblock_impl::Planner;
use gaugeblock_impl::plan::{
    Axes, Blend, InputParameter, OutputParameter, OutputSwitch, Path, Phase, Segment,
};
use libm::{cos, sin};

use super::check::{Feeding, Run, dynamics, farthest, programmed, run};
use super::programs::{FEED, at, distance, line};
use super::table::FEEDINGS;

const ORIGIN: Axes = [0.0; 9];
const RADIUS: f64 = 6.0;

/// An arc of so many chords of a length, numbered from 1.
fn chords(count: u32, length: f64, blend: Blend) -> Vec<Segment> {
    let end = |chord: u32| {
        let angle = f64::from(chord) * length / RADIUS;
        at(RADIUS * sin(angle), RADIUS * (1.0 - cos(angle)), 0.0)
    };
    let chord = |i: u32| Segment { number: u64::from(i), ..line(end(i), blend) };
    (1..=count).map(chord).collect()
}

/// What is asked for: the way at the feed, and coming to it and to rest at the accelerations of two axes.
fn least_time(count: u32, length: f64) -> f64 {
    f64::from(count) * length / FEED + FEED / 2000.0
}

/// The numbers of segments that are told to be executed, in order.
fn told(program: &[Segment], before: impl Fn(&mut Planner, &Segment)) -> Vec<u64> {
    let mut planner = Planner::new(dynamics(), ORIGIN).expect("limits");
    // So slow that no leg is over within a cycle.
    let input = InputParameter { feed_override: 0.05, ..InputParameter::default() };
    let mut output = OutputParameter::default();
    for segment in program {
        before(&mut planner, segment);
        planner.queue(segment).expect("room");
    }
    let mut told = Vec::new();
    while planner.update(&input, &mut output) != Phase::Idle {
        if told.last() != Some(&output.segment) {
            told.push(output.segment);
        }
    }
    told
}

#[track_caller]
fn is_lawful(run: &Run, program: &[Segment], tolerance: f64) {
    let (speed, change) = run.worst(&dynamics());
    assert!(speed <= 1.0 + 1e-9 && change <= 1.0 + 1e-9, "{speed} {change}");
    let (path, vertices) = programmed(ORIGIN, program);
    assert_eq!(run.samples.last(), vertices.last());
    let between = 2000.0 * 1.5 * 1e-6 / 8.0;
    let far = farthest(&run.samples, &path);
    assert!(far <= tolerance, "{far}");
    let missed = farthest(&vertices, &run.samples);
    // Samples are up to a tenth of a millimetre from one another.
    assert!(missed <= tolerance + between + 0.06, "{missed}");
}

#[test]
fn a_row_of_short_chords_is_as_fast_as_its_feed() {
    for length in [0.002, 0.01, 0.03, 0.045] {
        let program = chords(1500, length, Blend::Within(0.01));
        let run = run(ORIGIN, &program, Feeding::Full);
        is_lawful(&run, &program, 0.01);
        let least = least_time(1500, length);
        assert!(run.time() < least * 1.03 + 0.01, "{length}: {} s of {least} s", run.time());
    }
}

#[test]
fn it_is_lawful_at_any_feeding_and_tolerance() {
    for tolerance in [0.0, 1e-6, 1e-5, 1e-4, 1e-3, 0.1] {
        let program = chords(600, 0.01, Blend::Within(tolerance));
        for feeding in FEEDINGS {
            is_lawful(&run(ORIGIN, &program, feeding), &program, tolerance + 1e-9);
        }
    }
}

#[test]
fn samples_do_not_depend_on_how_its_segments_come() {
    let program = chords(1500, 0.04, Blend::Within(0.01));
    let all = run(ORIGIN, &program, Feeding::Full);
    // Two and a half are over within a cycle.
    for feeding in [Feeding::Every(1000, 1), Feeding::Every(1400, 2)] {
        assert!(run(ORIGIN, &program, feeding).samples == all.samples, "{feeding:?}");
    }
}

#[test]
fn a_segment_that_is_kept_apart_is_told() {
    let program = chords(200, 0.01, Blend::Within(0.01));
    let together = told(&program, |_, _| ());
    assert!(together.len() < 60, "{together:?}");
    // The last of a leg is told, and so is not the one before.
    let apart = together[together.len() / 2] - 1;
    let alone = told(&program, |planner, segment| {
        if segment.number == apart + 1 {
            planner.keep_apart();
        }
    });
    assert!(!together.contains(&apart) && alone.contains(&apart), "{alone:?}");
}

#[test]
fn an_output_switches_where_a_chord_begins() {
    let program = chords(400, 0.01, Blend::Within(0.01));
    let waits = |segment: &Segment| segment.number > 40 && segment.number.is_multiple_of(7);
    let told = told(&program, |planner, segment| {
        if waits(segment) {
            let output = u16::try_from(segment.number).expect("small");
            planner.switch(OutputSwitch { output, value: 1.0 }).expect("room");
        }
    });
    for segment in program.iter().filter(|segment| waits(segment)) {
        // The one before ends a leg.
        assert!(told.contains(&(segment.number - 1)), "{}", segment.number);
    }
}

#[test]
fn where_blends_keep_between_middles_legs_come_to_rest() {
    let mut program = chords(60, 0.01, Blend::Within(0.01));
    let end = at(3.0, 1.0, 0.0);
    program.push(line(end, Blend::BetweenMidpoints));
    let run = run(ORIGIN, &program, Feeding::Full);
    let corner = program[59].path;
    let Path::Straight { end: corner } = corner else { panic!("a line") };
    let nearest = farthest(&[corner], &run.samples);
    assert!(nearest < 1e-3, "{nearest}");
}

#[test]
fn chords_whose_ends_are_rounded_are_as_fast_as_their_feed() {
    // From 0.03 to 0.06 mm: some become one leg, some do not.
    let end = |chord: u32| {
        let angle = f64::from(chord) * 0.003;
        let radius = 14.0 + 4.0 * sin(3.0 * angle);
        let grid = |value: f64| libm::round(value * 1e4) / 1e4;
        at(grid(radius * sin(angle)), grid(14.0 - radius * cos(angle)), 0.0)
    };
    let chord = |i: u32| line(end(i), Blend::Within(0.005));
    let program: Vec<Segment> = (1..=2000).map(chord).collect();
    let way: f64 = (1..2000).map(|i| distance(&end(i), &end(i + 1))).sum();
    let run = run(ORIGIN, &program, Feeding::Full);
    is_lawful(&run, &program, 0.005);
    let least = 1.05 * way / FEED + FEED / 2000.0;
    assert!(run.time() < least, "{} s of {least} s", run.time());
}
