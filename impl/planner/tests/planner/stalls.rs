//! No stall: the motion is never far slower than axes, feed and tolerance allow for more than a few cycles.

use gaugeblock_planner::{
    Axes, Dynamics, Feed, InputParameter, Path, PathControl, Planner, Segment,
};
use proptest::prelude::*;

use super::check::{CYCLE, Feeding, Run, dynamics, run_with};
use super::programs::{distance, line};
use super::random::Dice;

const ORIGIN: Axes = [0.0; 9];
/// Below this share of the allowed speed the motion stalls, if it lasts for more than so many cycles.
const STALL_RATIO: f64 = 0.1;
const STALL_CYCLES_MAX: usize = 10;
/// The share of the acceleration that is expected between corners.
const ACCELERATION_RATIO: f64 = 0.25;

/// A line of a program, and the speed that is expected on it at least: by axes and feed along it, by the corner at its
/// end, and so that it can be reached.
struct Leg {
    start: Axes,
    tangent: Axes,
    length: f64,
    speed: f64,
    acceleration: f64,
    /// The programmed feed, and the first of the three axes along which it is measured.
    feed: f64,
    measure: usize,
    speed_at_end: f64,
    /// The part of it that the corner at its end uses.
    used_at_end: f64,
}

impl Leg {
    fn new(start: Axes, segment: &Segment, limits: &Dynamics) -> Self {
        let Path::Straight { end } = segment.path else { panic!("only lines are expected") };
        let length = distance(&start, &end);
        let tangent: Axes = std::array::from_fn(|axis| (end[axis] - start[axis]) / length);
        let measure = [0, 6, 3].into_iter().find(|first| part(&tangent, *first) > 0.0).unwrap_or(0);
        let feed = match segment.feed {
            Feed::Rapid => f64::INFINITY,
            Feed::PerSecond(feed) => feed,
            Feed::InTime(seconds) => length * part(&tangent, measure) / seconds,
            Feed::PerTurn(_) => 0.0,
        };
        let along = feed / part(&tangent, measure);
        // A line that is over within a cycle shares it with others.
        let speed = least(&limits.velocity, &tangent).min(along).min(length / limits.cycle);
        let acceleration = ACCELERATION_RATIO * least(&limits.acceleration, &tangent);
        Self {
            start,
            tangent,
            length,
            speed,
            acceleration,
            feed,
            measure,
            speed_at_end: 0.0,
            used_at_end: 0.0,
        }
    }

    /// The speed in the middle of a parabola that replaces the corner, where it is least, and the length that it uses.
    fn corner(&self, next: &Self, blend: PathControl, limits: &Dynamics) -> (f64, f64) {
        let change: Axes = std::array::from_fn(|axis| next.tangent[axis] - self.tangent[axis]);
        let half = 0.5 * self.length.min(next.length);
        let used = match blend {
            PathControl::Within(tolerance) => {
                half.min(4.0 * tolerance / distance(&change, &ORIGIN))
            }
            PathControl::BetweenMidpoints => half,
            PathControl::ExactStop | PathControl::ExactPath => return (0.0, 0.0),
        };
        // Each feed is kept by its own measure.
        let feed = |leg: &Self| {
            leg.feed / part(&self.tangent, leg.measure).max(part(&next.tangent, leg.measure))
        };
        let most = (2.0 * used * least(&limits.acceleration, &change)).sqrt();
        let middle: Axes = std::array::from_fn(|axis| next.tangent[axis] + self.tangent[axis]);
        (0.5 * distance(&middle, &ORIGIN) * most.min(feed(self)).min(feed(next)), used)
    }
}

/// The length of the part of a vector along three axes.
fn part(vector: &Axes, first: usize) -> f64 {
    vector[first..first + 3].iter().map(|value| value * value).sum::<f64>().sqrt()
}

fn least(limits: &Axes, uses: &Axes) -> f64 {
    limits.iter().zip(uses).map(|(limit, used)| limit / used.abs()).fold(f64::INFINITY, f64::min)
}

fn legs(start: Axes, program: &[Segment], limits: &Dynamics) -> Vec<Leg> {
    let mut legs: Vec<Leg> = Vec::new();
    let mut here = start;
    for segment in program {
        let leg = Leg::new(here, segment, limits);
        let Path::Straight { end } = segment.path else { continue };
        here = end;
        legs.push(leg);
    }
    for place in 1..legs.len() {
        let blend = program[place - 1].path_control;
        let alike = blend == program[place].path_control;
        let (speed, used) = legs[place - 1].corner(&legs[place], blend, limits);
        legs[place - 1].speed_at_end = if alike { speed } else { 0.0 };
        legs[place - 1].used_at_end = used;
    }
    let reach = |from: f64, leg: &Leg| (from * from + 2.0 * leg.acceleration * leg.length).sqrt();
    let mut before = 0.0;
    for leg in &mut legs {
        leg.speed_at_end = leg.speed_at_end.min(reach(before, leg));
        before = leg.speed_at_end;
    }
    for place in (1..legs.len()).rev() {
        let most = reach(legs[place].speed_at_end, &legs[place]);
        legs[place - 1].speed_at_end = legs[place - 1].speed_at_end.min(most);
    }
    legs
}

/// The most cycles in a row that are far slower than expected, and the last one of them.
fn longest_stall(run: &Run, legs: &[Leg]) -> (usize, usize) {
    let (mut row, mut longest) = (0, (0, 0));
    for (cycle, output) in run.outputs.iter().enumerate() {
        let place = usize::try_from(output.segment.max(1)).expect("a number of a leg") - 1;
        let leg = &legs[place];
        let (before, used) = match place.checked_sub(1) {
            Some(before) => (legs[before].speed_at_end, legs[before].used_at_end),
            None => (0.0, 0.0),
        };
        let along: f64 = (0..9).map(|i| (output.position[i] - leg.start[i]) * leg.tangent[i]).sum();
        let after = (along - used).clamp(0.0, leg.length);
        let ahead = (leg.length - along - leg.used_at_end).clamp(0.0, leg.length);
        let reach = |from: f64, way: f64| (from * from + 2.0 * leg.acceleration * way).sqrt();
        let expected = leg.speed.min(reach(before, after)).min(reach(leg.speed_at_end, ahead));
        row = if output.speed < STALL_RATIO * expected { row + 1 } else { 0 };
        longest = longest.max((row, cycle));
    }
    longest
}

fn run_all(start: Axes, program: &[Segment], limits: Dynamics) -> Run {
    let mut planner = Planner::new(limits, start).expect("limits");
    run_with(&mut planner, start, program, Feeding::Full, |_| InputParameter::default())
}

/// A line that moves X and A.
fn to(x: f64, a: f64, feed: Feed) -> Segment {
    let end = [x, 0.0, 0.0, a, 0.0, 0.0, 0.0, 0.0, 0.0];
    Segment { feed, ..line(end, PathControl::Within(0.05)) }
}

#[track_caller]
fn takes(program: &[Segment], seconds: f64) {
    let limits = dynamics();
    let run = run_all(ORIGIN, program, limits);
    let (speed, change) = run.worst(&limits);
    assert!(speed <= 1.0 + 1e-9 && change <= 1.0 + 1e-9, "{speed} {change}");
    let time = run.time();
    assert!((time - seconds).abs() <= 2.1 * CYCLE, "{time} s, expected {seconds} s");
    let (stall, at) = longest_stall(&run, &legs(ORIGIN, program, &limits));
    assert!(stall <= STALL_CYCLES_MAX, "{stall} cycles up to {at}");
}

/// A blend was passed at the lesser number of two feeds, one in millimetres and one in degrees per second: the
/// rotation nearly stopped.
#[test]
fn rotation_goes_on_between_a_rotary_and_a_mixed_move() {
    let rotary = Feed::PerSecond(9.0);
    let mixed = Feed::PerSecond(0.1);
    takes(&[to(0.0, 90.0, rotary), to(1.0, 180.0, mixed), to(1.0, 270.0, rotary)], 30.0045);
    let timed = Feed::InTime(10.0);
    takes(
        &[
            to(0.0, 90.0, timed),
            to(1.0, 180.0, timed),
            to(1.0, 270.0, timed),
            to(2.0, 360.0, timed),
        ],
        40.0045,
    );
    // The linear part is tiny.
    takes(&[to(0.0, 90.0, timed), to(0.005, 180.0, timed), to(0.005, 270.0, timed)], 30.0045);
}

/// Lines of all kinds of axes, limits and feeds.
fn random_lines(seed: u64) -> (Dynamics, Vec<Segment>) {
    let mut dice = Dice::new(seed);
    let mut limits = dynamics();
    if dice.below(2) == 0 {
        limits.velocity = std::array::from_fn(|_| dice.any_size(10.0, 600.0));
        limits.acceleration = std::array::from_fn(|_| dice.any_size(100.0, 10_000.0));
    }
    let mut blend = PathControl::Within(dice.any_size(1e-4, 1.0));
    let mut feed = Feed::PerSecond(dice.any_size(5.0, 400.0));
    let (size, share) = (dice.any_size(0.05, 30.0), dice.any_size(1e-4, 1.0));
    let (mut here, mut program) = (ORIGIN, Vec::new());
    for _ in 0..2 + dice.below(30) {
        match dice.below(12) {
            0 => blend = PathControl::Within(dice.any_size(1e-4, 1.0)),
            1 => feed = Feed::PerSecond(dice.any_size(5.0, 400.0)),
            2 => feed = Feed::InTime(dice.any_size(0.02, 1.0)),
            3 => feed = Feed::Rapid,
            4 => blend = PathControl::BetweenMidpoints,
            5 => blend = [PathControl::ExactStop, PathControl::ExactPath][dice.below(2)],
            _ => {}
        }
        let moving: &[usize] =
            [&[0, 1][..], &[0, 1, 2], &[3], &[0, 3], &[0, 1, 3, 4], &[6, 4]][dice.below(6)];
        for axis in moving {
            let linear = if *axis == 3 { 1.0 } else { share };
            here[*axis] += linear * size * dice.between(-1.0, 1.0);
        }
        program.push(Segment { feed, ..line(here, blend) });
    }
    (limits, program)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    #[test]
    fn random_lines_are_passed_without_a_stall(seed in any::<u64>()) {
        let (limits, program) = random_lines(seed);
        let run = run_all(ORIGIN, &program, limits);
        let (speed, change) = run.worst(&limits);
        prop_assert!(speed <= 1.0 + 1e-9 && change <= 1.0 + 1e-9, "{} {}", speed, change);
        let (stall, at) = longest_stall(&run, &legs(ORIGIN, &program, &limits));
        prop_assert!(stall <= STALL_CYCLES_MAX, "{} cycles up to {}", stall, at);
    }
}
