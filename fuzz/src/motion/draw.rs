//! Rides at random.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use gaugeblock_vocabulary::Axis;
use gaugeblock_vocabulary::motion::{
    MotionAction, MotionEvent, MotionLimits, MotionScript, PathMode,
};
use gaugeblock_vocabulary::scenario::AxisLimits;

use super::{Axes, Pace, Plane, Ride, Step};
use crate::generate::Dice;

/// Coordinates are multiples of this, millimetres or degrees, as a program for a machine has them.
const GRID: f64 = 1e5;

/// The kind of steps that are chords of a curve.
const CHORDS: u32 = 5;

/// A ride; what an operator does to it comes with some of them.
pub fn ride(dice: &mut Dice<'_>) -> Ride {
    let axes = *dice.pick(&[2, 3, 3, 3, 3, 4, 6, 9]);
    // Some are chords of curves, of which several are over within a cycle.
    let fine = dice.chance(12);
    let size = if fine { any_size(dice, 0.002, 0.2) } else { any_size(dice, 0.003, 25.0) };
    let plane = *dice.pick(&[Plane::Xy, Plane::Xy, Plane::Xy, Plane::Zx, Plane::Yz]);
    // Where a controller stands that has not moved.
    let start = [0.0; 9];
    let limits = limits(dice, axes.max(3), size);
    let mut script = MotionScript::default();
    if dice.chance(40) {
        operate(dice, &mut script);
    }
    let every = if dice.chance(50) { None } else { Some(*dice.pick(&[1, 1, 2, 5, 20, 31, 80])) };
    let mut ride = Ride { start, plane, steps: Vec::new(), limits, script, every };
    let direction = between(dice, -PI, PI);
    let curve = if fine { any_size(dice, 1e-4, 0.15) } else { 0.0 };
    let mut pen = Pen { here: start, direction, size, axes, curve };
    let first = if fine { within(dice, size, 3.0) } else { mode(dice, size) };
    ride.steps.push(Step::Mode(first));
    let first = if fine { quick(dice, size / ride.limits.period) } else { pace(dice, size) };
    ride.steps.push(Step::Pace(first));
    let count = match fine {
        true => dice.range(50, 300),
        false if dice.chance(10) => dice.range(60, 150),
        false => dice.range(2, 30),
    };
    // Most programs have long rows of one kind.
    let kind = if fine { CHORDS } else { dice.below(5) };
    for _ in 0..count {
        if fine && dice.chance(95) {
            let step = pen.line(dice, plane, kind);
            ride.steps.push(step);
        } else {
            any_step(dice, &mut pen, &mut ride, kind);
        }
    }
    if dice.chance(70) {
        let mut last = pen.here;
        last[0] = on_grid(last[0] + size);
        ride.steps.push(Step::Line(last));
    }
    if ride.steps.iter().any(|step| matches!(step, Step::Pace(Pace::PerTurn(_)))) {
        let action = MotionAction::SpindleSpeed { spindle: 0, turns: any_size(dice, 2.0, 50.0) };
        ride.script.events.insert(0, MotionEvent { cycle: 0, action });
    }
    let runs_back = |event: &MotionEvent| matches!(event.action, MotionAction::AdaptiveFeed(_));
    if ride.script.events.iter().any(runs_back) && dice.chance(40) {
        rock(dice, &mut ride.script);
    }
    ride
}

/// A step of any kind, mostly of one; before some of them another mode or feed.
fn any_step(dice: &mut Dice<'_>, pen: &mut Pen, ride: &mut Ride, kind: u32) {
    if dice.chance(8) {
        let mode = mode(dice, pen.size);
        ride.steps.push(Step::Mode(mode));
    }
    if dice.chance(8) {
        let pace = pace(dice, pen.size);
        ride.steps.push(Step::Pace(pace));
    }
    let kind = if dice.chance(40) { dice.below(5) } else { kind };
    let step = pen.step(dice, ride.plane, kind);
    ride.steps.push(step);
}

/// Where the drawing is.
struct Pen {
    here: Axes,
    /// Of the last move in the plane, radians.
    direction: f64,
    size: f64,
    axes: usize,
    /// By how much a chord turns, radians.
    curve: f64,
}

impl Pen {
    fn step(&mut self, dice: &mut Dice<'_>, plane: Plane, kind: u32) -> Step {
        match dice.below(24) {
            0 => return Step::Dwell(on_grid(between(dice, 0.0, 0.02))),
            1 => {
                let (number, on) = (dice.below(3), dice.chance(50));
                return Step::Output { number, on, with_motion: dice.chance(70) };
            }
            2 => return Step::Line(self.here),
            _ => {}
        }
        self.line(dice, plane, kind)
    }

    /// A line, or an arc where the kind has some.
    fn line(&mut self, dice: &mut Dice<'_>, plane: Plane, kind: u32) -> Step {
        let other = if kind == CHORDS { 2 } else { 25 };
        let length = if dice.chance(other) { any_size(dice, 1e-4, 30.0) } else { self.size };
        self.direction += match (kind, dice.below(8)) {
            (CHORDS, 0) => self.curve * between(dice, -0.5, 2.0),
            (CHORDS, _) => self.curve,
            // Nearly smooth.
            (0, _) => between(dice, -0.06, 0.06),
            (1, _) => any_size(dice, 1e-9, 0.1) * if dice.chance(50) { 1.0 } else { -1.0 },
            (_, 0) => 0.0,
            (_, 1) => PI,
            (_, 2) => FRAC_PI_2,
            (_, 3) => any_size(dice, 1e-8, 1.0),
            _ => between(dice, -PI, PI),
        };
        if kind == 3 || kind == 4 && dice.chance(30) {
            return self.arc(dice, plane, length.max(0.05));
        }
        let [first, second] = plane.axes();
        let mut end = self.here;
        end[first] = on_grid(end[first] + length * libm::cos(self.direction));
        end[second] = on_grid(end[second] + length * libm::sin(self.direction));
        if dice.chance(if kind == CHORDS { 3 } else { 30 }) {
            for place in end.iter_mut().take(self.axes).skip(2) {
                *place = on_grid(*place + between(dice, -length, length));
            }
        }
        self.here = end;
        if dice.chance(if kind == CHORDS { 1 } else { 8 }) {
            Step::Rapid(end)
        } else {
            Step::Line(end)
        }
    }

    /// An arc that begins in the direction of the last move, or with a corner.
    fn arc(&mut self, dice: &mut Dice<'_>, plane: Plane, radius: f64) -> Step {
        let clockwise = dice.chance(50);
        let sense = if clockwise { -1.0 } else { 1.0 };
        let (angle, turns) =
            if dice.chance(8) { (TAU, dice.range(1, 3)) } else { (any_size(dice, 0.02, 6.2), 1) };
        let radius = radius.min(8.0 / angle).max(0.02);
        let outward = self.direction - sense * FRAC_PI_2;
        let offset = [-radius * libm::cos(outward), -radius * libm::sin(outward)].map(on_grid);
        let [first, second] = plane.axes();
        let mut end = self.here;
        if angle < TAU {
            let to = outward + sense * angle;
            end[first] = on_grid(self.here[first] + offset[0] + radius * libm::cos(to));
            end[second] = on_grid(self.here[second] + offset[1] + radius * libm::sin(to));
        }
        if dice.chance(30) {
            let normal = 3 - first - second;
            end[normal] = on_grid(end[normal] + between(dice, -radius, radius));
        }
        self.here = end;
        self.direction += sense * angle;
        Step::Arc { end, centre: offset, clockwise, turns }
    }
}

fn limits(dice: &mut Dice<'_>, axes: usize, size: f64) -> MotionLimits {
    let period = *dice.pick(&[0.001, 0.001, 0.001, 0.001, 0.0005, 0.002, 0.004]);
    let alike = dice.chance(50);
    let mut limits = MotionLimits { period, axes: std::collections::BTreeMap::new() };
    for axis in Axis::ALL.iter().take(axes) {
        let (velocity, acceleration) = if alike {
            (250.0, 2000.0)
        } else {
            (
                round(any_size(dice, 10.0_f64.max(size), 600.0)),
                round(any_size(dice, 100.0, 10_000.0)),
            )
        };
        let limit = AxisLimits {
            velocity: Some(velocity),
            acceleration: Some(acceleration),
            ..AxisLimits::default()
        };
        limits.axes.insert(*axis, limit);
    }
    limits
}

fn mode(dice: &mut Dice<'_>, size: f64) -> PathMode {
    match dice.below(8) {
        0 => PathMode::ExactStop,
        1 => PathMode::ExactPath,
        2 => PathMode::BetweenMidpoints,
        3 => {
            PathMode::Within { tolerance: rounded(any_size(dice, 1e-5, size.min(1.0))), merge: 0.0 }
        }
        _ => within(dice, size, 0.3),
    }
}

/// A tolerance of so many times a size at most.
fn within(dice: &mut Dice<'_>, size: f64, most: f64) -> PathMode {
    let tolerance = rounded((size * any_size(dice, 1e-3, most)).max(1e-5));
    PathMode::Within { tolerance, merge: 0.0 }
}

/// A feed at which one move, or up to twenty, are over within a cycle.
fn quick(dice: &mut Dice<'_>, speed: f64) -> Pace {
    Pace::PerMinute(round(60.0 * speed * any_size(dice, 0.5, 20.0)))
}

/// A feed at which a move does not take for ever.
fn pace(dice: &mut Dice<'_>, size: f64) -> Pace {
    match dice.below(12) {
        0 => Pace::PerMove(round(any_size(dice, 200.0, 6000.0))),
        1 => Pace::PerTurn(rounded((size * any_size(dice, 0.3, 3.0)).max(0.2))),
        _ => Pace::PerMinute(round(60.0 * any_size(dice, (2.0 * size).max(2.0), 400.0))),
    }
}

fn operate(dice: &mut Dice<'_>, script: &mut MotionScript) {
    let adaptive = dice.chance(40);
    let mut cycle = 0;
    for _ in 0..dice.range(1, 8) {
        cycle += *dice.pick(&[1, 3, 10, 30, 100, 300]) + dice.below(30);
        let action = match dice.below(7) {
            0 => MotionAction::FeedOverride(*dice.pick(&[0.0, 0.05, 0.5, 0.97, 1.0, 1.3, 2.0])),
            1 => MotionAction::RapidOverride(*dice.pick(&[0.05, 0.25, 0.5, 1.0])),
            2 | 3 if adaptive => {
                MotionAction::AdaptiveFeed(*dice.pick(&[-1.0, -0.5, 0.0, 0.3, 0.8, 1.0]))
            }
            4 => MotionAction::FeedStop(dice.chance(50)),
            _ => MotionAction::Hold(dice.chance(50)),
        };
        script.events.push(MotionEvent { cycle, action });
    }
    cycle += dice.range(1, 300);
    let mut last = vec![MotionAction::FeedOverride(1.0), MotionAction::RapidOverride(1.0)];
    last.extend([MotionAction::FeedStop(false), MotionAction::Hold(false)]);
    if adaptive {
        last.push(MotionAction::AdaptiveFeed(1.0));
    }
    if dice.chance(20) {
        last = vec![MotionAction::Abort];
    }
    script.events.extend(last.into_iter().map(|action| MotionEvent { cycle, action }));
}

/// Runs back and forth again and again, with whatever else an operator does.
fn rock(dice: &mut Dice<'_>, script: &mut MotionScript) {
    let mut cycle = 0;
    for _ in 0..dice.range(2, 12) {
        for feed in [*dice.pick(&[-1.0, -1.0, -0.5]), 1.0] {
            cycle += *dice.pick(&[3, 10, 30, 60, 100, 300]) + dice.below(30);
            let action = MotionAction::AdaptiveFeed(feed);
            script.events.push(MotionEvent { cycle, action });
        }
    }
    script.events.sort_by_key(|event| event.cycle);
}

/// From 0 to 1.
fn share(dice: &mut Dice<'_>) -> f64 {
    f64::from(dice.below(1 << 30)) / f64::from(1 << 30)
}

pub(super) fn between(dice: &mut Dice<'_>, low: f64, high: f64) -> f64 {
    low + share(dice) * (high - low)
}

/// Small ones as often as large ones.
fn any_size(dice: &mut Dice<'_>, low: f64, high: f64) -> f64 {
    low * libm::pow(high / low, share(dice))
}

fn on_grid(value: f64) -> f64 {
    libm::round(value * GRID) / GRID
}

fn round(value: f64) -> f64 {
    libm::round(value).max(1.0)
}

/// With three digits that count.
fn rounded(value: f64) -> f64 {
    let scale = libm::pow(10.0, libm::floor(libm::log10(value)) - 2.0);
    let digits = libm::round(value / scale);
    // A power of ten is exact only where it is no fraction.
    if scale < 1.0 { digits / libm::round(1.0 / scale) } else { digits * scale }
}
