//! Corners at a feed that the axes can keep: it is kept, and a larger tolerance never costs time.

use gaugeblock_planner::{
    Axes, Feed, InputParameter, OutputParameter, PathControl, Planner, Segment,
};
use libm::{cos, sin};
use proptest::prelude::*;

use super::check::{CYCLE, Feeding, Run, dynamics, farthest, follows, programmed, run, run_with};
use super::known_times::FEEDINGS;
use super::programs::{at, distance, line};
use super::random::Dice;

const ORIGIN: Axes = [0.0; 9];
const TOLERANCES: [f64; 9] = [0.001, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0];

fn per_minute(mut program: Vec<Segment>, feed: f64) -> Vec<Segment> {
    for segment in &mut program {
        segment.feed = Feed::PerSecond(feed / 60.0);
    }
    program
}

fn through(points: &[(f64, f64)], tolerance: f64) -> Vec<Segment> {
    points.iter().map(|(x, y)| line(at(*x, *y, 0.0), PathControl::Within(tolerance))).collect()
}

/// A square of 20 mm.
fn square(tolerance: f64) -> Vec<Segment> {
    through(&[(20.0, 0.0), (20.0, 20.0), (0.0, 20.0), (0.0, 0.0)], tolerance)
}

/// Corners that turn by an angle, alternately left and right, 10 mm apart.
fn turning(degrees: f64, tolerance: f64) -> Vec<Segment> {
    let (mut here, mut heading) = ((0.0, 0.0), 0.1);
    let mut points = Vec::new();
    for place in 0..6 {
        here = (here.0 + 10.0 * cos(heading), here.1 + 10.0 * sin(heading));
        points.push(here);
        let sense = if place % 2 == 0 { 1.0 } else { -1.0 };
        heading += sense * degrees.to_radians();
    }
    through(&points, tolerance)
}

#[track_caller]
fn is_lawful(run: &Run, program: &[Segment], tolerance: f64) {
    let Feed::PerSecond(feed) = program[0].feed else { panic!("a feed is expected") };
    follows(run, program, tolerance, 0.5 * feed * CYCLE);
}

/// The times of LinuxCNC 2.9 with P0.5, measured: never slower.
#[test]
fn square_at_a_moderate_feed_is_no_slower_than_on_linuxcnc() {
    for (feed, linuxcnc) in [(300.0, 15.696), (600.0, 7.855), (1200.0, 3.940), (3000.0, 1.621)] {
        let time = run(ORIGIN, &per_minute(square(0.5), feed), Feeding::Full).time();
        assert!(time <= linuxcnc, "F{feed}: {time} s, LinuxCNC {linuxcnc} s");
    }
}

/// The feed fell to 71 % of itself in each corner.
#[test]
fn feed_is_kept_through_corners_that_axes_and_tolerance_allow() {
    for (feed, tolerance) in
        [(300.0, 0.01), (600.0, 0.05), (600.0, 0.5), (1200.0, 0.1), (2900.0, 0.5)]
    {
        for degrees in [20.0, 45.0, 60.0, 90.0] {
            let program = per_minute(turning(degrees, tolerance), feed);
            let run = run(ORIGIN, &program, Feeding::Full);
            is_lawful(&run, &program, tolerance);
            let is_slow = |output: &&OutputParameter| output.speed < 0.99 * feed / 60.0;
            let slow = u32::try_from(run.outputs.iter().filter(is_slow).count()).expect("a count");
            // Acceleration and braking alone.
            let ramps = 2.0 * feed / 60.0 / 2000.0 / CYCLE + 2.0;
            assert!(f64::from(slow) <= ramps, "F{feed} P{tolerance} {degrees}: {slow} cycles");
        }
    }
}

#[test]
fn round_corners_keep_limits_at_any_feeding() {
    for (feed, tolerance) in [(600.0, 0.5), (2900.0, 0.5), (3300.0, 0.5), (1500.0, 0.1)] {
        for degrees in [30.0, 90.0, 120.0, 150.0] {
            let program = per_minute(turning(degrees, tolerance), feed);
            for feeding in FEEDINGS {
                is_lawful(&run(ORIGIN, &program, feeding), &program, tolerance);
            }
        }
    }
}

#[test]
fn round_corners_are_followed_in_reverse_and_overridden() {
    let program = per_minute(turning(90.0, 0.5), 2400.0);
    for period in [40, 130, 370] {
        let mut planner = Planner::new(dynamics(), ORIGIN).expect("limits");
        let run = run_with(&mut planner, ORIGIN, &program, Feeding::Full, |cycle| {
            let step = cycle / period;
            InputParameter {
                feed_override: [1.0, 2.0, 0.3][step % 3],
                adaptive_feed: if step % 5 == 4 { -1.0 } else { 1.0 },
                ..InputParameter::default()
            }
        });
        is_lawful(&run, &program, 0.5);
    }
}

#[test]
fn more_tolerance_never_costs_time_at_any_feed() {
    for feed in [1200.0, 2400.0, 3000.0, 4500.0, 6000.0, 12_000.0] {
        for degrees in [20.0, 72.0, 90.0, 144.0, 175.0] {
            let mut last = f64::INFINITY;
            for tolerance in TOLERANCES {
                let program = per_minute(turning(degrees, tolerance), feed);
                let time = run(ORIGIN, &program, Feeding::Full).time();
                assert!(
                    time <= last + 2.1 * CYCLE,
                    "F{feed} P{tolerance} {degrees}: {time} s, {last} s"
                );
                last = last.min(time);
            }
        }
    }
}

/// Lines with sharp corners, one feed and one tolerance.
fn random_corners(seed: u64) -> (f64, f64, Vec<Segment>) {
    let mut dice = Dice::new(seed);
    let (feed, tolerance) = (dice.any_size(100.0, 6000.0), dice.any_size(0.002, 2.0));
    let (size, flat) = (dice.any_size(0.3, 15.0), dice.below(2) == 0);
    let (mut here, mut heading, mut program) = (ORIGIN, dice.between(0.0, 6.0), Vec::new());
    for _ in 0..3 + dice.below(12) {
        heading += [1.57, -1.57, 2.5, 0.4, -1.1, 2.0][dice.below(6)] + dice.between(-0.3, 0.3);
        let length = size * dice.between(0.3, 1.0);
        here[0] += length * cos(heading);
        here[1] += length * sin(heading);
        if !flat && dice.below(3) == 0 {
            here[2] += dice.between(-length, length);
        }
        program.push(line(here, PathControl::Within(tolerance)));
    }
    (feed, tolerance, per_minute(program, feed))
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(100) })]

    #[test]
    fn random_corners_keep_limits_feed_and_tolerance(seed in any::<u64>()) {
        let (feed, tolerance, program) = random_corners(seed);
        let run = run(ORIGIN, &program, FEEDINGS[usize::try_from(seed % 6).unwrap_or(0)]);
        let (speed, change) = run.worst(&dynamics());
        prop_assert!(speed <= 1.0 + 1e-9 && change <= 1.0 + 1e-9, "{} {}", speed, change);
        let (path, vertices) = programmed(ORIGIN, &program);
        prop_assert_eq!(run.samples.last(), vertices.last());
        let far = farthest(&run.samples, &path);
        prop_assert!(far <= tolerance * (1.0 + 1e-9), "{} of {}", far, tolerance);
        let steps = run.samples.windows(2).map(|two| distance(&two[0], &two[1]));
        let fastest = steps.fold(0.0, f64::max) / CYCLE;
        prop_assert!(fastest <= feed / 60.0 * (1.0 + 1e-9), "{} of {}", fastest, feed / 60.0);
    }
}
