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
//! direction. The bounds of the stretches add up. It is slow and sure: every lower bound is proved in the section
//! that computes it, up to the rounding of its sums.
//!
//! What is bounded is a motion that keeps its limits at every instant. The laws hold samples to them, and between two
//! samples a velocity may jump by what an axis could have changed it by in the time: so an exact path whose direction
//! breaks slightly can be passed lawfully without the rest that is counted here, in less time than the bound.

mod cell;
mod reach;
mod relaxation;
mod smooth;
mod stopping;
mod trapezoid;

use gaugeblock_vocabulary::motion::{Feed, MotionLimits, PathMode, ProgrammedPath};

use self::relaxation::Gate;
use self::smooth::Smooth;
pub(in crate::motion) use self::stopping::{
    Shortest, Stop, shortest_stopping, stopping, stopping_on_blend,
};
use super::curve::{Counted, Curve};
use super::envelope::Envelope;
use super::route::{CornerTolerance, Leg, Route, Task};
use super::vector::AxisVector;
use crate::math;

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
    /// No motion that keeps its limits at every instant is faster, seconds.
    pub least: f64,
    /// A lawful motion takes so long, seconds; infinite where none was found.
    pub achieved: f64,
}

/// The bound of a path.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeBound {
    /// No motion that keeps its limits at every instant is faster, seconds, dwells included.
    pub least: f64,
    /// A lawful motion takes so long, seconds; infinite where none was found.
    pub achieved: f64,
    /// Its stretches in order.
    pub stretches: Vec<StretchBound>,
}

/// The least time of a path under limits, with no feed faster than programmed times `fastest`: the highest override.
///
/// Limits of jerk are dropped, which leaves a lower bound; then nothing is said to be achieved. So does the feed per
/// turn of a spindle, whose speed nobody knows beforehand.
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
        if envelope.limits_jerk() {
            stretch.achieved = f64::INFINITY;
        }
        bound.least += stretch.least;
        bound.achieved += stretch.achieved;
        bound.stretches.push(stretch);
        first = last + 1;
    }
    Ok(bound)
}

/// Whether a motion that keeps its limits at every instant rests where a leg ends.
fn rests_after(route: &Route<'_>, leg: usize) -> bool {
    match route.corners[leg + 1].tolerance {
        CornerTolerance::Rest => true,
        CornerTolerance::Exact => route.breaks(leg + 1),
        CornerTolerance::Within(_) | CornerTolerance::BetweenMidpoints => false,
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
    let (gates, fastest) = gates(route, (first, last), &Fastest::of(legs, envelope, feed));
    let highest = legs.iter().map(feed).fold(0.0, f64::max);
    let spatial = legs.iter().all(|leg| leg.curve.counted() == Counted::First);
    let mut bound = StretchBound { elements, kind: Kind::Length, least: 0.0, achieved };
    bound.least = relaxation::shortest(&gates, &fastest, 0..3);
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

/// How fast the point can be in space on the way along the legs of a stretch.
///
/// By trajectory.feed it is no faster than the feed of the legs that it may be on. About a corner these are the ones
/// next to it, and further ones where a leg is shorter than the tolerances. A rapid has the speeds of the axes.
struct Fastest {
    /// On a leg itself, and where it may be on others too.
    legs: Vec<(f64, f64)>,
    /// How far from an end of a leg the point is on this leg alone.
    apart: f64,
}

impl Fastest {
    fn of(legs: &[Leg<'_>], envelope: &Envelope, feed: impl Fn(&Leg<'_>) -> f64) -> Self {
        let moves = |axis: &usize| {
            let change = |leg: &Leg<'_>| leg.curve.end()[*axis] - leg.curve.start()[*axis];
            legs.iter().any(|leg| change(leg) != 0.0 || !leg.curve.is_straight())
        };
        let velocities = (0..3).filter(moves).map(|axis| envelope.velocity[axis]);
        let squares = velocities.map(|speed| speed * speed).sum();
        let rapid = if squares > 0.0 { math::square_root(squares) } else { f64::INFINITY };
        let apart = 4.0 * legs.iter().map(|leg| leg.tolerance).fold(0.0, f64::max);
        let own = |leg: &Leg<'_>| match leg.curve.counted() {
            Counted::First => feed(leg).min(rapid),
            Counted::Second | Counted::Rotary => rapid,
        };
        // The legs that begin close to where a leg ends, one at least.
        let next = |along: &mut dyn Iterator<Item = &Leg<'_>>| {
            let (mut highest, mut away) = (0.0_f64, 0.0);
            for leg in along {
                highest = highest.max(own(leg));
                away += leg.curve.length();
                if away > apart {
                    break;
                }
            }
            highest
        };
        let about = |(place, leg): (usize, &Leg<'_>)| {
            let before = next(&mut legs[..place].iter().rev());
            let behind = next(&mut legs[place + 1..].iter());
            (own(leg), own(leg).max(before).max(behind))
        };
        Self { legs: legs.iter().enumerate().map(about).collect(), apart }
    }
}

/// What a lawful motion passes between two rests, and how fast the point can be on the way to each of it.
fn gates(
    route: &Route<'_>,
    (first, last): (usize, usize),
    fastest: &Fastest,
) -> (Vec<Gate>, Vec<f64>) {
    let (mut gates, mut speeds) = (Vec::new(), Vec::new());
    let mut add = |at: AxisVector, tolerance: f64, speed: f64| {
        gates.push(Gate { at, tolerance });
        speeds.push(speed);
    };
    add(route.corners[first].at, 0.0, 0.0);
    for number in first..=last {
        let leg = &route.legs[number];
        let (alone, about) = fastest.legs[number - first];
        if leg.element.mode == PathMode::BetweenMidpoints {
            add(leg.curve.at(0.5), 0.0, about);
        } else {
            let apart = fastest.apart / leg.curve.length();
            let mut from = 0.0;
            for part in parts(&leg.curve, apart) {
                let fast = if from >= apart && part <= 1.0 - apart { alone } else { about };
                add(leg.curve.at(part), leg.tolerance, fast);
                from = part;
            }
        }
        let tolerance = match route.corners[number + 1].tolerance {
            _ if number == last => 0.0,
            CornerTolerance::Rest | CornerTolerance::Exact => 0.0,
            CornerTolerance::Within(tolerance) => tolerance,
            CornerTolerance::BetweenMidpoints => continue,
        };
        add(route.corners[number + 1].at, tolerance, about);
    }
    (gates, speeds)
}

/// Where on a leg gates stand: some of each radian of an arc, and so far from its ends that the point is on this leg
/// alone.
fn parts(curve: &Curve, apart: f64) -> Vec<f64> {
    let cells = curve.cells(8.0);
    let mut parts: Vec<f64> =
        (1_u32..).map(|done| f64::from(done) / cells).take_while(|part| *part < 1.0).collect();
    if apart > 0.0 && apart < 0.5 {
        parts.extend([apart, 1.0 - apart]);
        parts.sort_by(f64::total_cmp);
    }
    parts
}

#[cfg(test)]
mod tests;
