//! Laws held against samples made by hand: good ones are accepted, each planted fault is found by the law that it
//! breaks.

mod axes;
mod feed;
mod following;
mod operator;
mod outputs;
mod rest;
mod robust;

use gaugeblock_vocabulary::motion::{
    Column, Controls, Feed, MotionAction, MotionEvent, MotionLimits, MotionScript, OutputChange,
    PathElement, PathMode, ProgrammedPath, Samples, Shape,
};
use gaugeblock_vocabulary::scenario::AxisLimits;
use gaugeblock_vocabulary::{Axis, BlockLocation, Pin, Position};

use super::{Judgement, Law, Verdict, judge};
use crate::motion::vector::{AxisVector, distance, minus, plus};

/// The servo period of all records.
const PERIOD: f64 = 0.001;

/// Axes of 250 mm/s and 2000 mm/s².
fn limits() -> MotionLimits {
    let limit =
        AxisLimits { velocity: Some(250.0), acceleration: Some(2000.0), ..AxisLimits::default() };
    let axes = [Axis::X, Axis::Y, Axis::Z].map(|axis| (axis, limit));
    MotionLimits { period: PERIOD, axes: axes.into() }
}

fn xy(x: f64, y: f64) -> Position {
    Position { x, y, ..Position::default() }
}

fn within(tolerance: f64) -> PathMode {
    PathMode::Within { tolerance, merge: 0.0 }
}

/// A path from the origin, line by line of a program.
fn path(mode: PathMode, feed: Feed, shapes: Vec<Shape>) -> ProgrammedPath {
    let element = |(line, shape): (u32, Shape)| {
        let block = BlockLocation::new("main.ngc", line);
        PathElement {
            block,
            shape,
            feed,
            mode,
            controls: Controls::default(),
            switches: Vec::new(),
        }
    };
    let elements = (1..).zip(shapes).map(element).collect();
    ProgrammedPath { elements, ..ProgrammedPath::default() }
}

fn line(x: f64, y: f64) -> Shape {
    Shape::Straight { end: xy(x, y) }
}

fn digital(value: f64) -> OutputChange {
    OutputChange { pin: Pin::DigitalOut(0), value }
}

/// A motion as pieces of constant acceleration, from which samples are taken.
#[derive(Clone, Debug, Default)]
struct Motion {
    /// Where it is, how fast, and how it accelerates, from which second on.
    pieces: Vec<(f64, AxisVector, AxisVector, AxisVector)>,
    /// Until when.
    seconds: f64,
    at: AxisVector,
    velocity: AxisVector,
}

impl Motion {
    /// Goes on for a time with a constant acceleration.
    fn push(&mut self, seconds: f64, acceleration: AxisVector) -> &mut Self {
        self.pieces.push((self.seconds, self.at, self.velocity, acceleration));
        let mean = plus(&self.velocity, &acceleration, seconds / 2.0);
        self.at = plus(&self.at, &mean, seconds);
        self.velocity = plus(&self.velocity, &acceleration, seconds);
        self.seconds += seconds;
        self
    }

    /// Stands.
    fn rest(&mut self, seconds: f64) -> &mut Self {
        self.velocity = [0.0; 9];
        self.push(seconds, [0.0; 9])
    }

    /// Goes straight to a point, from a speed to another one, by way of the highest one.
    fn line(&mut self, end: Position, speeds: (f64, f64, f64), acceleration: f64) -> &mut Self {
        let end = end.to_array();
        let (first, highest, last) = speeds;
        let way = distance(&end, &self.at);
        let unit = minus(&end, &self.at).map(|part| part / way);
        let square = acceleration * way + (first * first + last * last) / 2.0;
        let top = highest.min(square.sqrt());
        let (up, down) = ((top - first) / acceleration, (top - last) / acceleration);
        let even = way - (top + first) / 2.0 * up - (top + last) / 2.0 * down;
        self.velocity = unit.map(|part| part * first);
        self.push(up, unit.map(|part| part * acceleration));
        self.velocity = unit.map(|part| part * top);
        self.push(even.max(0.0) / top, [0.0; 9]);
        self.push(down, unit.map(|part| -part * acceleration));
        self.at = end;
        self.velocity = unit.map(|part| part * last);
        self
    }

    /// Goes straight to a point, from rest to rest.
    fn to(&mut self, x: f64, y: f64, speed: f64) -> &mut Self {
        self.line(xy(x, y), (0.0, speed, 0.0), 1900.0)
    }

    fn sample(&self, second: f64) -> AxisVector {
        if second >= self.seconds {
            return self.at;
        }
        let piece = self.pieces.partition_point(|piece| piece.0 <= second).saturating_sub(1);
        let (from, at, velocity, acceleration) = self.pieces[piece];
        let t = second - from;
        std::array::from_fn(|axis| at[axis] + velocity[axis] * t + acceleration[axis] * t * t / 2.0)
    }

    /// Samples until it rests at its end for two cycles.
    fn samples(&self) -> Vec<AxisVector> {
        let mut samples = Vec::new();
        let mut second = 0.0;
        while second < self.seconds + 2.0 * PERIOD {
            samples.push(self.sample(second));
            second = crate::motion::vector::count(samples.len()) * PERIOD;
        }
        samples
    }
}

/// A record of X, Y, Z, and of further columns.
fn record(points: &[AxisVector], columns: &[(Column, Vec<f64>)]) -> Samples {
    record_with(0.0, points, columns)
}

/// The same with a declared resolution; the positions themselves are exact.
fn record_with(resolution: f64, points: &[AxisVector], columns: &[(Column, Vec<f64>)]) -> Samples {
    let axes = [Axis::X, Axis::Y, Axis::Z].map(Column::Position);
    let names = axes.into_iter().chain(columns.iter().map(|(column, _)| *column)).collect();
    let mut samples = Samples::new(PERIOD, resolution, names).unwrap();
    for (sample, point) in points.iter().enumerate() {
        let more = columns.iter().map(|(_, values)| values[sample]);
        let row: Vec<f64> = point[..3].iter().copied().chain(more).collect();
        samples.push(&row).unwrap();
    }
    samples
}

fn script(events: &[(u32, MotionAction)]) -> MotionScript {
    let event =
        |(cycle, action): &(u32, MotionAction)| MotionEvent { cycle: *cycle, action: *action };
    MotionScript { events: events.iter().map(event).collect() }
}

fn judged(points: &[AxisVector], path: &ProgrammedPath) -> Judgement {
    judge(&record(points, &[]), path, &limits(), &MotionScript::default())
}

fn judge_coarse(points: &[AxisVector], path: &ProgrammedPath, resolution: f64) -> Judgement {
    judge(&record_with(resolution, points, &[]), path, &limits(), &MotionScript::default())
}

#[track_caller]
fn lawful(judgement: &Judgement) {
    let broken: Vec<_> = judgement.violations().map(ToString::to_string).collect();
    assert!(broken.is_empty(), "{}", broken.join("\n"));
    assert!(judgement.0.iter().any(|(_, verdict)| matches!(verdict, Verdict::Satisfied { .. })));
}

/// Something is broken, and this law among it; further laws may be broken by the same fault.
#[track_caller]
fn broken(judgement: &Judgement, law: Law) -> String {
    let all: Vec<_> = judgement.violations().map(ToString::to_string).collect();
    let found = judgement.violations().find(|violation| violation.law == law);
    found.unwrap_or_else(|| panic!("{law} holds, but: {}", all.join("\n"))).to_string()
}
