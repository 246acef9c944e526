//! Merging: several segments that would be over within a cycle become one, within their tolerance.

use gaugeblock_planner::{
    Axes, Feed, InputParameter, OutputParameter, OutputSwitch, PathControl, Phase, Planner, Segment,
};
use libm::{cos, sin};

use super::check::{Feeding, Run, dynamics, farthest, follows, programmed, run};
use super::known_times::FEEDINGS;
use super::programs::{FEED, at, distance, line};

const ORIGIN: Axes = [0.0; 9];
const RADIUS: f64 = 6.0;

/// An arc of `count` chords of a length, numbered from 1.
fn chords(count: u32, length: f64, blend: PathControl) -> Vec<Segment> {
    let end = |chord: u32| {
        let angle = f64::from(chord) * length / RADIUS;
        at(RADIUS * sin(angle), RADIUS * (1.0 - cos(angle)), 0.0)
    };
    let chord = |i: u32| Segment { number: u64::from(i), ..line(end(i), blend) };
    (1..=count).map(chord).collect()
}

/// The requested time: the way at the feed, with acceleration and braking of two axes.
fn least_time(count: u32, length: f64) -> f64 {
    f64::from(count) * length / FEED + FEED / 2000.0
}

/// The numbers of segments that the output reports, in order.
fn reported(program: &[Segment], before: impl Fn(&mut Planner, &Segment)) -> Vec<u64> {
    let mut planner = Planner::new(dynamics(), ORIGIN).expect("limits");
    // So slow that no segment is over within a cycle.
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

/// Samples are up to 0.1 mm apart.
#[track_caller]
fn is_lawful(run: &Run, program: &[Segment], tolerance: f64) {
    follows(run, program, tolerance, 0.06);
}

#[test]
fn row_of_short_chords_reaches_its_feed() {
    for length in [0.002, 0.01, 0.03, 0.045] {
        let program = chords(1500, length, PathControl::Within(0.01));
        let run = run(ORIGIN, &program, Feeding::Full);
        is_lawful(&run, &program, 0.01);
        let least = least_time(1500, length);
        assert!(run.time() < least * 1.03 + 0.01, "{length}: {} s of {least} s", run.time());
    }
}

#[test]
fn merged_row_keeps_limits_at_any_feeding_and_tolerance() {
    for tolerance in [0.0, 1e-6, 1e-5, 1e-4, 1e-3, 0.1] {
        let program = chords(600, 0.01, PathControl::Within(tolerance));
        for feeding in FEEDINGS {
            is_lawful(&run(ORIGIN, &program, feeding), &program, tolerance + 1e-9);
        }
    }
}

#[test]
fn samples_of_a_merged_row_do_not_depend_on_feeding() {
    let program = chords(1500, 0.04, PathControl::Within(0.01));
    let all = run(ORIGIN, &program, Feeding::Full);
    // Two and a half segments are over within a cycle.
    for feeding in [Feeding::Every(1000, 1), Feeding::Every(1400, 2)] {
        assert!(run(ORIGIN, &program, feeding).samples == all.samples, "{feeding:?}");
    }
}

#[test]
fn segment_that_is_not_merged_is_reported() {
    let program = chords(200, 0.01, PathControl::Within(0.01));
    let together = reported(&program, |_, _| ());
    assert!(together.len() < 60, "{together:?}");
    // The last one of a merged segment is reported, the one before it is not.
    let apart = together[together.len() / 2] - 1;
    let alone = reported(&program, |planner, segment| {
        if segment.number == apart + 1 {
            planner.prevent_merge();
        }
    });
    assert!(!together.contains(&apart) && alone.contains(&apart), "{alone:?}");
}

#[test]
fn an_output_switches_where_a_chord_begins() {
    let program = chords(400, 0.01, PathControl::Within(0.01));
    let waits = |segment: &Segment| segment.number > 40 && segment.number.is_multiple_of(7);
    let told = reported(&program, |planner, segment| {
        if waits(segment) {
            let output = u16::try_from(segment.number).expect("small");
            planner.queue_output(OutputSwitch { output, value: 1.0 }).expect("room");
        }
    });
    for segment in program.iter().filter(|segment| waits(segment)) {
        // The segment before ends a merged segment.
        assert!(told.contains(&(segment.number - 1)), "{}", segment.number);
    }
}

#[test]
fn blend_between_midpoints_ends_before_the_midpoint_of_the_last_segment() {
    // A straight row and a curved one.
    for straight in [true, false] {
        let mut program = chords(60, 0.01, PathControl::Within(0.01));
        if straight {
            program = (1..=60)
                .map(|i| line(at(0.01 * f64::from(i), 0.0, 0.0), PathControl::Within(0.01)))
                .collect();
        }
        let (_, vertices) = programmed(ORIGIN, &program);
        let corner = vertices[vertices.len() - 1];
        program.push(line(at(corner[0], 5.0, 0.0), PathControl::BetweenMidpoints));
        let run = run(ORIGIN, &program, Feeding::Full);
        let missed = farthest(&[corner], &run.samples);
        assert!(missed <= 0.0025, "{missed}");
    }
}

/// A straight row of 0.01 mm lines at 50 mm/s: each cycle would pass five of them.
#[test]
fn collinear_lines_are_merged_where_the_path_is_exact_or_has_no_tolerance() {
    for blend in [PathControl::ExactPath, PathControl::BetweenMidpoints] {
        for (dx, dy) in [(0.01, 0.0), (0.006, 0.008), (0.0071, -0.0037)] {
            let end = |i: u32| at(dx * f64::from(i), dy * f64::from(i), 0.0);
            let feed = Feed::PerSecond(50.0);
            let program: Vec<Segment> =
                (1..=400).map(|i| Segment { feed, ..line(end(i), blend) }).collect();
            for feeding in [Feeding::Full, Feeding::Every(0, 1), Feeding::Every(1, 7)] {
                let run = run(ORIGIN, &program, feeding);
                is_lawful(&run, &program, 1e-12);
                let least = distance(&ORIGIN, &end(400)) / 50.0 + 50.0 / 2000.0;
                let full = matches!(feeding, Feeding::Full);
                assert!(!full || run.time() < least + 0.005, "{} s of {least} s", run.time());
            }
        }
    }
}

#[test]
fn corner_after_a_row_without_tolerance_uses_half_of_its_last_line() {
    let row = |i: u32| line(at(0.01 * f64::from(i), 0.0, 0.0), PathControl::BetweenMidpoints);
    let mut program: Vec<Segment> = (1..=60).map(row).collect();
    program.push(line(at(0.6, 5.0, 0.0), PathControl::BetweenMidpoints));
    let run = run(ORIGIN, &program, Feeding::Full);
    is_lawful(&run, &program, 0.005);
    let left = run.samples.iter().filter(|sample| sample[1] > 0.0);
    assert!(left.map(|sample| sample[0]).fold(f64::INFINITY, f64::min) >= 0.595);
}

#[test]
fn unbounded_feed_differs_from_other_feeds() {
    let mut program: Vec<Segment> = (1..=400)
        .map(|i| line(at(0.02 * f64::from(i), 0.0, 0.0), PathControl::Within(0.01)))
        .collect();
    for (place, segment) in program.iter_mut().enumerate() {
        let unbounded = place % 20 == 0;
        segment.feed = if unbounded { Feed::InTime(1e-312) } else { Feed::PerSecond(10.0) };
    }
    let run = run(ORIGIN, &program, Feeding::Full);
    let fastest = run.outputs.iter().map(|output| output.speed).fold(0.0, f64::max);
    assert!(fastest < 16.0, "{fastest}");
}

#[test]
fn segment_of_rounding_length_moves_nothing() {
    // The third of these kept the motion at rest for ever.
    for tiny in [1e-16, 1e-13, 1.3e-12, 2.1e-12, 1e-11, 9e-11, 2e-10, 1e-9] {
        for blend in
            [PathControl::Within(0.18), PathControl::ExactStop, PathControl::BetweenMidpoints]
        {
            let mut x = 0.0;
            let mut next = |length: f64| {
                x += length;
                line(at(x, 0.5 * x, 0.0), blend)
            };
            let lengths = [0.016, 0.016, tiny, 0.016, tiny, tiny, 0.003, 0.5];
            let program: Vec<Segment> = lengths.iter().map(|length| next(*length)).collect();
            let run = run(ORIGIN, &program, Feeding::Full);
            let (speed, change) = run.worst(&dynamics());
            assert!(speed <= 1.0 + 1e-9 && change <= 1.0 + 1e-9, "{tiny}: {speed} {change}");
            assert!(run.time() < 0.2, "{tiny}: {}", run.time());
        }
    }
}

#[test]
fn chords_with_rounded_ends_reach_their_feed() {
    // From 0.03 to 0.06 mm: some are merged, others are not.
    let end = |chord: u32| {
        let angle = f64::from(chord) * 0.003;
        let radius = 14.0 + 4.0 * sin(3.0 * angle);
        let grid = |value: f64| libm::round(value * 1e4) / 1e4;
        at(grid(radius * sin(angle)), grid(14.0 - radius * cos(angle)), 0.0)
    };
    let chord = |i: u32| line(end(i), PathControl::Within(0.005));
    let program: Vec<Segment> = (1..=2000).map(chord).collect();
    let way: f64 = (1..2000).map(|i| distance(&end(i), &end(i + 1))).sum();
    let run = run(ORIGIN, &program, Feeding::Full);
    is_lawful(&run, &program, 0.005);
    let least = 1.05 * way / FEED + FEED / 2000.0;
    assert!(run.time() < least, "{} s of {least} s", run.time());
}
