//! More tolerance, faster axes or a divided line cost no time: each of these did once.

use gaugeblock_planner::{Axes, Feed, InputParameter, PathControl, Planner, Segment};
use std::f64::consts::TAU;

use super::check::{CYCLE, Feeding, dynamics, run, run_with};
use super::programs::{arc, at, line};

const ORIGIN: Axes = [0.0; 9];

/// The time of a program in seconds, with a check that it keeps all limits.
#[track_caller]
fn time(program: &[Segment]) -> f64 {
    let run = run(ORIGIN, program, Feeding::Full);
    let (speed, change) = run.worst(&dynamics());
    assert!(speed <= 1.0 + 1e-9 && change <= 1.0 + 1e-9, "{speed} {change}");
    run.time()
}

/// An arc about a centre, counterclockwise or not.
fn about(
    start: Axes,
    end: Axes,
    offset: (f64, f64),
    turns_left: bool,
    blend: PathControl,
) -> Segment {
    let from = libm::atan2(-offset.1, -offset.0);
    let to = libm::atan2(end[1] - start[1] - offset.1, end[0] - start[0] - offset.0);
    let angle = (to - from).rem_euclid(TAU);
    arc(start, end, offset, if turns_left { angle } else { angle - TAU }, blend)
}

fn at_feed(mut program: Vec<Segment>, per_minute: f64) -> Vec<Segment> {
    for segment in &mut program {
        segment.feed = Feed::PerSecond(per_minute / 60.0);
    }
    program
}

/// A line, and an arc that nearly reverses it.
fn sharp(blend: PathControl) -> Vec<Segment> {
    let corner = at(13.316_49, 14.074_47, 0.0);
    let end = at(12.049_53, 13.061_99, 0.0);
    let back = about(corner, end, (-3.4365, 3.0013), false, blend);
    at_feed(vec![line(corner, blend), back], 1376.0)
}

/// A short line, a short arc in nearly the same direction, and a line across.
fn flat(blend: PathControl) -> Vec<Segment> {
    let (before, corner) = (at(2.81, -15.59, 0.0), at(2.814_55, -15.588_48, 0.0));
    let end = at(2.674_01, -15.327_57, 0.0);
    let round = about(corner, end, (-7.006_57, -3.605_73), true, blend);
    let across = line(at(13.0, -7.0, 0.0), blend);
    at_feed(vec![line(before, blend), line(corner, blend), round, across], 20801.0)
}

#[test]
fn a_farther_corner_with_an_arc_takes_no_longer() {
    for program in [sharp, flat] {
        let mut last = f64::INFINITY;
        for tolerance in [0.003, 0.01, 0.03, 0.05, 0.06, 0.1, 0.15, 0.2, 0.3] {
            let time = time(&program(PathControl::Within(tolerance)));
            assert!(time <= last * 1.001 + 0.002, "{tolerance}: {time} s after {last} s");
            last = time;
        }
    }
}

/// A slower Z limits the speed in some directions of a curve. Chords were merged in the others alone, and segments of
/// unequal length are slower: P0.015 took 40 cycles longer than P0.001.
#[test]
fn more_tolerance_costs_no_time_on_a_dense_curve_with_a_slower_axis() {
    let curve = |t: f64| {
        at(15.0 * libm::sin(2.0 * t), 10.0 * libm::sin(3.0 * t), 2.0 * libm::sin(5.0 * t))
            .map(|value| (value * 1e5).round() / 1e5)
    };
    let mut limits = dynamics();
    (limits.velocity[2], limits.acceleration[2]) = (100.0, 1000.0);
    for chord in [0.03, 0.05, 0.1] {
        let (mut t, mut ends) = (0.0, Vec::new());
        while t < TAU {
            let [x, y, z] =
                [30.0 * libm::cos(2.0 * t), 30.0 * libm::cos(3.0 * t), 10.0 * libm::cos(5.0 * t)];
            t += chord / (x * x + y * y + z * z).sqrt();
            ends.push(curve(t));
        }
        let mut last = f64::INFINITY;
        for tolerance in [0.0001, 0.001, 0.005, 0.009, 0.01, 0.015, 0.02, 0.05, 0.3] {
            let lines = ends.iter().map(|end| line(*end, PathControl::Within(tolerance)));
            let program = at_feed(lines.collect(), 12_000.0);
            let mut planner = Planner::new(limits, ORIGIN).expect("limits");
            let wants = |_| InputParameter::default();
            let time = run_with(&mut planner, ORIGIN, &program, Feeding::Full, wants).time();
            assert!(time <= last + 2.1 * CYCLE, "{chord} P{tolerance}: {time} s, {last} s");
            last = last.min(time);
        }
    }
}

#[test]
fn a_faster_axis_takes_no_longer() {
    let blend = PathControl::Within(0.13);
    let corner = at(12.203_07, -1.476_41, 0.0);
    let end = at(16.615_52, -4.174_87, 0.0);
    let mut program = at_feed(
        vec![
            line(at(0.02, -0.002_65, 0.0), blend),
            line(at(6.105_33, -0.778_61, 0.0), blend),
            line(corner, blend),
            about(corner, end, (-0.697_76, -6.097_75), false, blend),
        ],
        20832.0,
    );
    (program[0].feed, program[1].feed) = (Feed::Rapid, Feed::Rapid);
    let time = |velocity: f64| {
        let mut faster = dynamics();
        faster.velocity[0] = velocity;
        let mut planner = Planner::new(faster, ORIGIN).expect("limits");
        let wants = |_| InputParameter::default();
        run_with(&mut planner, ORIGIN, &program, Feeding::Full, wants).time()
    };
    let slow = time(250.0);
    for velocity in [300.0, 350.0, 400.0, 443.4, 500.0] {
        assert!(time(velocity) <= slow + 0.0021, "{velocity}: {} s, {slow} s", time(velocity));
    }
}

#[test]
fn an_axis_that_accelerates_more_makes_no_corner_slower() {
    // The line between the corners takes less than a cycle, and a blend between midpoints uses half of it.
    let corners = [(-4.0, -12.0), (1.596_57, -14.090_99), (1.604_14, -14.094_1), (23.0, -21.0)];
    let program = corners.map(|(x, y)| line(at(x, y, 0.0), PathControl::BetweenMidpoints)).to_vec();
    let program = at_feed(program, 6775.0);
    let mut last = f64::INFINITY;
    for acceleration in [3000.0, 5000.0, 7085.0, 9000.0, 12_559.0, 20_000.0, 50_000.0] {
        let mut livelier = dynamics();
        (livelier.acceleration[0], livelier.acceleration[1]) = (116.0, acceleration);
        let mut planner = Planner::new(livelier, ORIGIN).expect("limits");
        let wants = |_| InputParameter::default();
        let run = run_with(&mut planner, ORIGIN, &program, Feeding::Full, wants);
        let (speed, change) = run.worst(&livelier);
        assert!(speed <= 1.0 + 1e-9 && change <= 1.0 + 1e-9, "{acceleration}: {speed} {change}");
        assert!(run.time() <= last + 0.0021, "{acceleration}: {} s, {last} s", run.time());
        last = run.time();
    }
}

#[test]
fn a_divided_line_before_a_slower_one_takes_as_long() {
    let blend = PathControl::Within(0.14);
    let ends = [(61.0, -9.0), (74.0, 4.0), (87.0, 18.0)];
    let mut program = at_feed(ends.map(|(x, y)| line(at(x, y, 0.0), blend)).to_vec(), 10_827.0);
    program[2].feed = Feed::PerSecond(100.0);
    let whole = time(&program);
    for share in [0.3, 0.6, 0.9] {
        let middle = at(61.0 + share * 13.0, -9.0 + share * 13.0, 0.0);
        let mut divided = program.clone();
        divided.insert(1, Segment { feed: program[1].feed, ..line(middle, blend) });
        let time = time(&divided);
        assert!((time - whole).abs() <= 2.1 * CYCLE, "{share}: {time} s, {whole} s");
    }
}

#[test]
fn path_of_many_lines_does_not_wait_for_look_ahead_when_the_spindle_starts() {
    let place = |number: u32| at(0.005 * f64::from(number), 0.0, 0.0);
    let mut program: Vec<Segment> =
        (1..=400).map(|number| line(place(number), PathControl::Within(1e-5))).collect();
    for segment in &mut program {
        segment.feed = Feed::PerTurn(0.2);
    }
    let mut planner = Planner::new(dynamics(), ORIGIN).expect("limits");
    let mut turns = 0.0;
    let run = run_with(&mut planner, ORIGIN, &program, Feeding::Full, |_| {
        turns += 10.0 * CYCLE;
        InputParameter { spindle_turns: turns, ..InputParameter::default() }
    });
    // 2 mm at 2 mm/s.
    assert!(run.time() < 1.01, "{}", run.time());
}
