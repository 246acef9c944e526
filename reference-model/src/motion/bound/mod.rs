//! How fast a path could be at best, and in which distance a motion can stop.
//!
//! | read | to learn |
//! | --- | --- |
//! | `trapezoid` | one straight way, in closed form |
//! | `reach`, `cell`, `smooth` | exact curves: the least time in a bracket, by reachability |
//! | `relaxation` | paths that may be rounded: each axis alone, and the shortest way |
//! | `stopping` | the distance in which a motion can stop |
//!
//! A path is divided where the motion must rest: at exact stops, dwells and waits, and where an exact path breaks its
//! direction. The bounds of the stretches add up. It is slow and sure: every lower bound is proved in the section that computes
//! it, up to the rounding of its sums.

mod cell;
mod reach;
mod relaxation;
mod smooth;
mod stopping;
mod trapezoid;

use gaugeblock_trace::motion::{Feed, MotionLimits, PathMode, ProgrammedPath};

use self::relaxation::Gate;
pub(in crate::motion) use self::smooth::Bounds;
use self::smooth::Smooth;
pub(in crate::motion) use self::stopping::{shortest_stopping, stopping};
use super::curve::{Counted, Curve};
use super::envelope::Envelope;
use super::route::{Leg, Passing, Route, Task};

/// Which bound a stretch has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// One straight line from rest to rest, in closed form.
    ExactStop,
    /// Exact curves, by reachability.
    Reachability,
    /// One axis alone.
    Axis,
    /// The shortest way at the highest feed.
    Length,
}

/// The bound of a stretch from rest to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StretchBound {
    /// The first and the last element, from 0.
    pub elements: (usize, usize),
    /// Which bound is the highest.
    pub kind: Kind,
    /// No lawful motion is faster, seconds.
    pub least: f64,
    /// A lawful motion takes so long, seconds; infinite where none was found.
    pub achieved: f64,
}

/// The bound of a path.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeBound {
    /// No lawful motion is faster, seconds, dwells included.
    pub least: f64,
    /// A lawful motion takes so long, seconds; infinite where none was found.
    pub achieved: f64,
    /// Its stretches in order.
    pub stretches: Vec<StretchBound>,
}

/// The least time of a path under limits, with no feed faster than programmed times `fastest`: the highest override.
///
/// Limits of jerk are dropped, which leaves a lower bound; then nothing is said to be achieved. So does the feed per turn of a
/// spindle, whose speed nobody knows beforehand.
///
/// # Errors
/// Why there is none: an element of which only the end is known, or an axis that moves and has no limits.
pub fn least_time(
    path: &ProgrammedPath,
    limits: &MotionLimits,
    fastest: f64,
) -> Result<TimeBound, String> {
    let route = Route::of(path)?;
    let envelope = Envelope::of(limits);
    let change =
        |axis: usize| route.legs.iter().any(|leg| leg.curve.derivatives(0.5).0[axis] != 0.0);
    if let Some(axis) = envelope.unstated(change) {
        return Err(format!("{axis} moves and no velocity and acceleration of it are stated"));
    }
    let mut bound = TimeBound { least: 0.0, achieved: 0.0, stretches: Vec::new() };
    for corner in &route.corners {
        let dwell = corner
            .tasks
            .iter()
            .map(|task| if let Task::Dwell(seconds) = task { *seconds } else { 0.0 });
        let dwell: f64 = dwell.sum();
        bound.least += dwell;
        bound.achieved += dwell;
    }
    let mut first = 0;
    for last in 0..route.legs.len() {
        if !rests_after(&route, last) {
            continue;
        }
        let mut stretch = stretch(&route, (first, last), &envelope, fastest);
        if envelope.jerk {
            stretch.achieved = f64::INFINITY;
        }
        bound.least += stretch.least;
        bound.achieved += stretch.achieved;
        bound.stretches.push(stretch);
        first = last + 1;
    }
    Ok(bound)
}

/// Whether every lawful motion rests where a leg ends.
fn rests_after(route: &Route<'_>, leg: usize) -> bool {
    match route.corners[leg + 1].passing {
        Passing::Rest => true,
        Passing::Exact => route.breaks(leg + 1),
        Passing::Within(_) | Passing::BetweenMidpoints => false,
    }
}

fn stretch(
    route: &Route<'_>,
    (first, last): (usize, usize),
    envelope: &Envelope,
    fastest: f64,
) -> StretchBound {
    let legs = &route.legs[first..=last];
    let elements = (legs[0].place, legs[legs.len() - 1].place);
    let feed = |leg: &Leg<'_>| fastest * speed(leg);
    let is_exact = legs
        .iter()
        .all(|leg| matches!(leg.element.mode, PathMode::ExactPath | PathMode::ExactStop));
    if is_exact {
        let curves: Vec<(&dyn Smooth, f64)> =
            legs.iter().map(|leg| (&leg.curve as &dyn Smooth, feed(leg))).collect();
        let bracket = reach::bracket(&curves, envelope);
        let straight = legs.len() == 1 && legs[0].curve.is_straight();
        let kind = if straight { Kind::ExactStop } else { Kind::Reachability };
        return StretchBound { elements, kind, least: bracket.least, achieved: bracket.achieved };
    }
    // To stop at every corner is lawful too.
    let stopping = |leg: &Leg<'_>| {
        reach::bracket(&[(&leg.curve as &dyn Smooth, feed(leg))], envelope).achieved
    };
    let achieved = legs.iter().map(stopping).sum();
    let gates = gates(route, (first, last));
    let highest = legs.iter().map(feed).fold(0.0, f64::max);
    let spatial = legs.iter().all(|leg| leg.curve.counted() == Counted::First);
    let mut bound = StretchBound { elements, kind: Kind::Length, least: 0.0, achieved };
    if spatial && highest.is_finite() {
        bound.least = relaxation::shortest(&gates, 0..3) / highest;
    }
    for axis in 0..9 {
        // No axis of space is faster than the point itself.
        let cap = if spatial && axis < 3 { highest } else { f64::INFINITY };
        let speed = envelope.velocity[axis].min(cap);
        let least = relaxation::axis(&gates, axis, speed, envelope.acceleration[axis]);
        if least > bound.least {
            (bound.least, bound.kind) = (least, Kind::Axis);
        }
    }
    bound
}

/// The programmed speed of a leg; infinite where none is known.
fn speed(leg: &Leg<'_>) -> f64 {
    match leg.element.feed {
        Feed::Rapid | Feed::PerTurn { .. } => f64::INFINITY,
        Feed::PerSecond(rate) => rate,
        Feed::InTime(seconds) => leg.curve.feed_length() / seconds,
    }
}

/// What a lawful motion passes between two rests.
fn gates(route: &Route<'_>, (first, last): (usize, usize)) -> Vec<Gate> {
    let mut gates = vec![Gate { at: route.corners[first].at, tolerance: 0.0 }];
    for number in first..=last {
        let leg = &route.legs[number];
        if leg.element.mode == PathMode::BetweenMidpoints {
            gates.push(Gate { at: leg.curve.at(0.5), tolerance: 0.0 });
        } else {
            along(&leg.curve, leg.tolerance, &mut gates);
        }
        let tolerance = match route.corners[number + 1].passing {
            _ if number == last => 0.0,
            Passing::Rest | Passing::Exact => 0.0,
            Passing::Within(tolerance) => tolerance,
            Passing::BetweenMidpoints => continue,
        };
        gates.push(Gate { at: route.corners[number + 1].at, tolerance });
    }
    gates
}

/// Points of an arc, some of each radian.
fn along(curve: &Curve, tolerance: f64, gates: &mut Vec<Gate>) {
    let parts = curve.cells(8.0);
    let mut done = 1.0;
    while done < parts {
        gates.push(Gate { at: curve.at(done / parts), tolerance });
        done += 1.0;
    }
}

#[cfg(test)]
mod tests;
