//! Random motion programs.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use gaugeblock_vocabulary::Axis;
use gaugeblock_vocabulary::motion::{
    MotionAction, MotionEvent, MotionLimits, MotionScript, PathMode,
};
use gaugeblock_vocabulary::scenario::AxisLimits;

use super::{Axes, MotionProgram, Pace, Plane, Step};
use crate::generate::Entropy;

/// Coordinates are multiples of this, millimetres or degrees, as a program for a machine has them.
const GRID: f64 = 1e5;

/// The kind of steps that are chords of a curve.
const CHORDS: u32 = 5;

/// A random motion program; some have an operator.
pub fn motion_program(entropy: &mut Entropy<'_>) -> MotionProgram {
    let axes = *entropy.pick(&[2, 3, 3, 3, 3, 4, 6, 9]);
    // Some are chords of curves, of which several are over within a cycle.
    let fine = entropy.chance(12);
    let size = if fine { any_size(entropy, 0.002, 0.2) } else { any_size(entropy, 0.003, 25.0) };
    let plane = *entropy.pick(&[Plane::Xy, Plane::Xy, Plane::Xy, Plane::Zx, Plane::Yz]);
    // Where a controller stands that has not moved.
    let start = [0.0; 9];
    let limits = limits(entropy, axes.max(3), size);
    let mut script = MotionScript::default();
    if entropy.chance(40) {
        operate(entropy, &mut script);
    }
    let every =
        if entropy.chance(50) { None } else { Some(*entropy.pick(&[1, 1, 2, 5, 20, 31, 80])) };
    let mut program = MotionProgram { start, plane, steps: Vec::new(), limits, script, every };
    let direction = between(entropy, -PI, PI);
    let curve = if fine { any_size(entropy, 1e-4, 0.15) } else { 0.0 };
    let mut pen = Pen { here: start, direction, size, axes, curve };
    let first = if fine { within(entropy, size, 3.0) } else { mode(entropy, size) };
    program.steps.push(Step::Mode(first));
    let first =
        if fine { quick(entropy, size / program.limits.period) } else { pace(entropy, size) };
    program.steps.push(Step::Pace(first));
    let count = match fine {
        true => entropy.range(50, 300),
        false if entropy.chance(10) => entropy.range(60, 150),
        false => entropy.range(2, 30),
    };
    // Most programs have long runs of one kind of step.
    let kind = if fine { CHORDS } else { entropy.below(5) };
    for _ in 0..count {
        if fine && entropy.chance(95) {
            let step = pen.line(entropy, plane, kind);
            program.steps.push(step);
        } else {
            any_step(entropy, &mut pen, &mut program, kind);
        }
    }
    if entropy.chance(70) {
        let mut last = pen.here;
        last[0] = on_grid(last[0] + size);
        program.steps.push(Step::Line(last));
    }
    if program.steps.iter().any(|step| matches!(step, Step::Pace(Pace::PerTurn(_)))) {
        let action = MotionAction::SpindleSpeed { spindle: 0, turns: any_size(entropy, 2.0, 50.0) };
        program.script.events.insert(0, MotionEvent { cycle: 0, action });
    }
    let runs_back = |event: &MotionEvent| matches!(event.action, MotionAction::AdaptiveFeed(_));
    if program.script.events.iter().any(runs_back) && entropy.chance(40) {
        rock(entropy, &mut program.script);
    }
    limit_jerk(entropy, &mut program.limits);
    program
}

/// Limits the jerk of each axis on a quarter of the machines, so that its acceleration takes one to 200 ms.
fn limit_jerk(entropy: &mut Entropy<'_>, limits: &mut MotionLimits) {
    if !entropy.chance(25) {
        return;
    }
    let alike = entropy.chance(70);
    let mut seconds = any_size(entropy, 0.001, 0.2);
    for limit in limits.axes.values_mut() {
        if !alike {
            seconds = any_size(entropy, 0.001, 0.2);
        }
        limit.jerk = limit.acceleration.map(|acceleration| round(acceleration / seconds));
    }
}

/// A step of any kind, mostly of one; before some of them another mode or feed.
fn any_step(entropy: &mut Entropy<'_>, pen: &mut Pen, program: &mut MotionProgram, kind: u32) {
    if entropy.chance(8) {
        let mode = mode(entropy, pen.size);
        program.steps.push(Step::Mode(mode));
    }
    if entropy.chance(8) {
        let pace = pace(entropy, pen.size);
        program.steps.push(Step::Pace(pace));
    }
    let kind = if entropy.chance(40) { entropy.below(5) } else { kind };
    let step = pen.step(entropy, program.plane, kind);
    program.steps.push(step);
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
    fn step(&mut self, entropy: &mut Entropy<'_>, plane: Plane, kind: u32) -> Step {
        match entropy.below(24) {
            0 => return Step::Dwell(on_grid(between(entropy, 0.0, 0.02))),
            1 => {
                let (number, on) = (entropy.below(3), entropy.chance(50));
                return Step::Output { number, on, with_motion: entropy.chance(70) };
            }
            2 => return Step::Line(self.here),
            _ => {}
        }
        self.line(entropy, plane, kind)
    }

    /// A line, or an arc where the kind has some.
    fn line(&mut self, entropy: &mut Entropy<'_>, plane: Plane, kind: u32) -> Step {
        let other = if kind == CHORDS { 2 } else { 25 };
        let length = if entropy.chance(other) { any_size(entropy, 1e-4, 30.0) } else { self.size };
        self.direction += match (kind, entropy.below(8)) {
            (CHORDS, 0) => self.curve * between(entropy, -0.5, 2.0),
            (CHORDS, _) => self.curve,
            // Nearly smooth.
            (0, _) => between(entropy, -0.06, 0.06),
            (1, _) => any_size(entropy, 1e-9, 0.1) * if entropy.chance(50) { 1.0 } else { -1.0 },
            (_, 0) => 0.0,
            (_, 1) => PI,
            (_, 2) => FRAC_PI_2,
            (_, 3) => any_size(entropy, 1e-8, 1.0),
            _ => between(entropy, -PI, PI),
        };
        if kind == 3 || kind == 4 && entropy.chance(30) {
            return self.arc(entropy, plane, length.max(0.05));
        }
        let [first, second] = plane.axes();
        let mut end = self.here;
        end[first] = on_grid(end[first] + length * libm::cos(self.direction));
        end[second] = on_grid(end[second] + length * libm::sin(self.direction));
        if entropy.chance(if kind == CHORDS { 3 } else { 30 }) {
            for place in end.iter_mut().take(self.axes).skip(2) {
                *place = on_grid(*place + between(entropy, -length, length));
            }
        }
        self.here = end;
        if entropy.chance(if kind == CHORDS { 1 } else { 8 }) {
            Step::Rapid(end)
        } else {
            Step::Line(end)
        }
    }

    /// An arc that begins in the direction of the last move, or with a corner.
    fn arc(&mut self, entropy: &mut Entropy<'_>, plane: Plane, radius: f64) -> Step {
        let clockwise = entropy.chance(50);
        let sense = if clockwise { -1.0 } else { 1.0 };
        let (angle, turns) = if entropy.chance(8) {
            (TAU, entropy.range(1, 3))
        } else {
            (any_size(entropy, 0.02, 6.2), 1)
        };
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
        if entropy.chance(30) {
            let normal = 3 - first - second;
            end[normal] = on_grid(end[normal] + between(entropy, -radius, radius));
        }
        self.here = end;
        self.direction += sense * angle;
        Step::Arc { end, centre: offset, clockwise, turns }
    }
}

fn limits(entropy: &mut Entropy<'_>, axes: usize, size: f64) -> MotionLimits {
    let period = *entropy.pick(&[0.001, 0.001, 0.001, 0.001, 0.0005, 0.002, 0.004]);
    let alike = entropy.chance(50);
    let mut limits = MotionLimits { period, axes: std::collections::BTreeMap::new() };
    for axis in Axis::ALL.iter().take(axes) {
        let (velocity, acceleration) = if alike {
            (250.0, 2000.0)
        } else {
            (
                round(any_size(entropy, 10.0_f64.max(size), 600.0)),
                round(any_size(entropy, 100.0, 10_000.0)),
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

fn mode(entropy: &mut Entropy<'_>, size: f64) -> PathMode {
    match entropy.below(8) {
        0 => PathMode::ExactStop,
        1 => PathMode::ExactPath,
        2 => PathMode::BetweenMidpoints,
        3 => PathMode::Within {
            tolerance: rounded(any_size(entropy, 1e-5, size.min(1.0))),
            merge: 0.0,
        },
        _ => within(entropy, size, 0.3),
    }
}

/// A tolerance of so many times a size at most.
fn within(entropy: &mut Entropy<'_>, size: f64, most: f64) -> PathMode {
    let tolerance = rounded((size * any_size(entropy, 1e-3, most)).max(1e-5));
    PathMode::Within { tolerance, merge: 0.0 }
}

/// A feed at which one move, or up to twenty, are over within a cycle.
fn quick(entropy: &mut Entropy<'_>, speed: f64) -> Pace {
    Pace::PerMinute(round(60.0 * speed * any_size(entropy, 0.5, 20.0)))
}

/// A feed at which a move does not take for ever.
fn pace(entropy: &mut Entropy<'_>, size: f64) -> Pace {
    match entropy.below(12) {
        0 => Pace::PerMove(round(any_size(entropy, 200.0, 6000.0))),
        1 => Pace::PerTurn(rounded((size * any_size(entropy, 0.3, 3.0)).max(0.2))),
        _ => Pace::PerMinute(round(60.0 * any_size(entropy, (2.0 * size).max(2.0), 400.0))),
    }
}

fn operate(entropy: &mut Entropy<'_>, script: &mut MotionScript) {
    let adaptive = entropy.chance(40);
    let mut cycle = 0;
    for _ in 0..entropy.range(1, 8) {
        cycle += *entropy.pick(&[1, 3, 10, 30, 100, 300]) + entropy.below(30);
        let action = match entropy.below(7) {
            0 => MotionAction::FeedOverride(*entropy.pick(&[0.0, 0.05, 0.5, 0.97, 1.0, 1.3, 2.0])),
            1 => MotionAction::RapidOverride(*entropy.pick(&[0.05, 0.25, 0.5, 1.0])),
            2 | 3 if adaptive => {
                MotionAction::AdaptiveFeed(*entropy.pick(&[-1.0, -0.5, 0.0, 0.3, 0.8, 1.0]))
            }
            4 => MotionAction::FeedStop(entropy.chance(50)),
            _ => MotionAction::Hold(entropy.chance(50)),
        };
        script.events.push(MotionEvent { cycle, action });
    }
    cycle += entropy.range(1, 300);
    let mut last = vec![MotionAction::FeedOverride(1.0), MotionAction::RapidOverride(1.0)];
    last.extend([MotionAction::FeedStop(false), MotionAction::Hold(false)]);
    if adaptive {
        last.push(MotionAction::AdaptiveFeed(1.0));
    }
    if entropy.chance(20) {
        last = vec![MotionAction::Abort];
    }
    script.events.extend(last.into_iter().map(|action| MotionEvent { cycle, action }));
}

/// Runs back and forth again and again, with whatever else an operator does.
fn rock(entropy: &mut Entropy<'_>, script: &mut MotionScript) {
    let mut cycle = 0;
    for _ in 0..entropy.range(2, 12) {
        for feed in [*entropy.pick(&[-1.0, -1.0, -0.5]), 1.0] {
            cycle += *entropy.pick(&[3, 10, 30, 60, 100, 300]) + entropy.below(30);
            let action = MotionAction::AdaptiveFeed(feed);
            script.events.push(MotionEvent { cycle, action });
        }
    }
    script.events.sort_by_key(|event| event.cycle);
}

/// From 0 to 1.
fn share(entropy: &mut Entropy<'_>) -> f64 {
    f64::from(entropy.below(1 << 30)) / f64::from(1 << 30)
}

pub(super) fn between(entropy: &mut Entropy<'_>, low: f64, high: f64) -> f64 {
    low + share(entropy) * (high - low)
}

/// Small ones as often as large ones.
fn any_size(entropy: &mut Entropy<'_>, low: f64, high: f64) -> f64 {
    low * libm::pow(high / low, share(entropy))
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
