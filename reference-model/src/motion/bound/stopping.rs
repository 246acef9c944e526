//! How far and how long a motion goes on at least when it is asked to stop.

use crate::motion::curve::Curve;
use crate::motion::envelope::Envelope;
use crate::motion::route::{Leg, Passing, Route};
use crate::motion::vector::{Nine, direction, distance, length};

/// The angle of an arc in one step, radians.
const STEP: f64 = 0.005;

/// Distance along the path, and time, until rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::motion) struct Stop {
    /// Millimetres, and degrees alike.
    pub(in crate::motion) distance: f64,
    /// Seconds.
    pub(in crate::motion) seconds: f64,
}

/// The least distance in which a motion at a point of a route can stop on it, from a speed.
///
/// The point brakes as hard as the axis that is loaded most allows, with what turning leaves
/// of its acceleration. A corner that may be rounded is passed at a steady speed for as long as its longest blend: the blend
/// may take all of the acceleration. Beyond the end of the route there is nothing to stop on.
pub(in crate::motion) fn stopping(
    route: &Route<'_>,
    envelope: &Envelope,
    from: (usize, f64),
    speed: f64,
) -> Stop {
    along(&route.legs, envelope, from, speed, |number| blend(route, number)).0
}

/// The same if no corner costs anything, and if nothing is known but so many legs: no motion near them stops in less.
///
/// What is left of the speed at the end of the last of them is braked as hard as it is there. A leg that nobody knows of yet may
/// be one on which braking takes longer, and it must not count.
pub(in crate::motion) fn shortest_stopping(
    route: &Route<'_>,
    envelope: &Envelope,
    from: (usize, f64),
    speed: f64,
    legs: usize,
) -> Stop {
    let last = legs.clamp(from.0 + 1, route.legs.len());
    let (mut stop, speed) = along(&route.legs[..last], envelope, from, speed, |_| 0.0);
    if speed > 0.0 {
        let (first, second) = route.legs[last - 1].curve.derivatives(1.0);
        let rate = rate(envelope, (&first, &second), speed);
        stop.distance += speed * speed / (2.0 * rate);
        stop.seconds += speed / rate;
    }
    stop
}

/// The distance and time until rest or the end of the legs, and the speed there.
fn along(
    legs: &[Leg<'_>],
    envelope: &Envelope,
    from: (usize, f64),
    speed: f64,
    blend: impl Fn(usize) -> f64,
) -> (Stop, f64) {
    let mut stop = Stop::default();
    let (mut speed, mut part) = (speed, from.1);
    for (number, leg) in legs.iter().enumerate().skip(from.0) {
        let blend = if number > from.0 { blend(number) } else { 0.0 };
        if blend > 0.0 {
            stop.distance += blend;
            stop.seconds += blend / speed;
        }
        speed = brake(&leg.curve, envelope, part, speed, &mut stop);
        if speed == 0.0 {
            break;
        }
        part = 0.0;
    }
    (stop, speed)
}

/// Brakes on one curve from a parameter on; the speed at its end.
fn brake(curve: &Curve, envelope: &Envelope, from: f64, speed: f64, stop: &mut Stop) -> f64 {
    let steps = (curve.angle().abs() * (1.0 - from) / STEP).ceil().max(1.0);
    let (mut speed, mut done) = (speed, 0.0);
    while done < steps {
        let part = from + (1.0 - from) * done / steps;
        let (first, second) = curve.derivatives(part);
        let scale = length(&first);
        if scale == 0.0 {
            return speed;
        }
        let rate = rate(envelope, (&first, &second), speed);
        let way = scale * (1.0 - from) / steps;
        if 2.0 * rate * way >= speed * speed {
            stop.distance += speed * speed / (2.0 * rate);
            stop.seconds += speed / rate;
            return 0.0;
        }
        let after = crate::math::square_root(speed * speed - 2.0 * rate * way);
        stop.distance += way;
        stop.seconds += 2.0 * way / (speed + after);
        speed = after;
        done += 1.0;
    }
    speed
}

/// How hard the point may brake where a curve has these derivatives, millimetres per second squared.
fn rate(envelope: &Envelope, (first, second): (&Nine, &Nine), speed: f64) -> f64 {
    let scale = length(first);
    let square = (speed / scale) * (speed / scale);
    let (low, high) = envelope.rates(first, second, square);
    if low <= high && low < 0.0 { -low * scale } else { 0.0 }
}

/// How long the blend at the start of a leg may be, at most: what the tolerance allows of a parabola that is tangent to both
/// legs, and no more than the legs.
fn blend(route: &Route<'_>, number: usize) -> f64 {
    let legs = (&route.legs[number - usize::from(number > 0)], &route.legs[number]);
    let reach = match route.corners[number].passing {
        Passing::Rest | Passing::Exact => return 0.0,
        Passing::BetweenMidpoints => f64::INFINITY,
        Passing::Within(tolerance) => {
            let before = direction(&legs.0.curve.derivatives(1.0).0);
            let after = direction(&legs.1.curve.derivatives(0.0).0);
            match (before, after) {
                (Some(before), Some(after)) => 4.0 * tolerance / distance(&before, &after),
                _ => f64::INFINITY,
            }
        }
    };
    if !route.breaks(number) {
        return 0.0;
    }
    reach.min(legs.0.curve.length()) + reach.min(legs.1.curve.length())
}

#[cfg(test)]
mod tests {
    use gaugeblock_trace::motion::{
        Controls, Element, Feed, MotionLimits, PathMode, ProgrammedPath, Shape,
    };
    use gaugeblock_trace::scenario::AxisLimits;
    use gaugeblock_trace::{Axis, Block, Position};

    use super::*;

    fn stop(mode: PathMode, shapes: Vec<Shape>, speed: f64) -> (Stop, Stop) {
        let element = |shape| Element {
            block: Block::new("main.ngc", 1),
            shape,
            feed: Feed::PerSecond(200.0),
            mode,
            controls: Controls::default(),
            switches: Vec::new(),
        };
        let elements = shapes.into_iter().map(element).collect();
        let path = ProgrammedPath { elements, ..ProgrammedPath::default() };
        let limit = AxisLimits {
            velocity: Some(250.0),
            acceleration: Some(2000.0),
            ..AxisLimits::default()
        };
        let axes = [Axis::X, Axis::Y].map(|axis| (axis, limit)).into();
        let envelope = Envelope::of(&MotionLimits { period: 0.001, axes });
        let route = Route::of(&path).expect("lines and arcs are known");
        let from = (0, 0.0);
        let all = route.legs.len();
        let shortest = shortest_stopping(&route, &envelope, from, speed, all);
        (stopping(&route, &envelope, from, speed), shortest)
    }

    fn line(x: f64, y: f64) -> Shape {
        Shape::Straight { end: Position { x, y, ..Position::default() } }
    }

    fn close(found: f64, wanted: f64) {
        assert!((found - wanted).abs() < 1e-9, "{found} is not {wanted}");
    }

    #[test]
    fn on_a_line_the_axis_that_is_loaded_most_decides() {
        let (stop, _) = stop(PathMode::ExactPath, vec![line(100.0, 0.0)], 100.0);
        close(stop.distance, 2.5);
        close(stop.seconds, 0.05);
        let (stop, _) = self::stop(PathMode::ExactPath, vec![line(60.0, 80.0)], 100.0);
        close(stop.distance, 100.0 * 100.0 / 2.0 / 2500.0);
    }

    #[test]
    fn an_arc_leaves_less_to_brake_with() {
        let end = Position { x: 40.0, ..Position::default() };
        let arc =
            Shape::Arc { end, centre: [20.0, 0.0, 0.0], normal: [0.0, 0.0, 1.0], angle: -180.0 };
        let (stop, _) = stop(PathMode::ExactPath, vec![arc], 180.0);
        let straight = 180.0 * 180.0 / 2.0 / 2000.0;
        assert!(stop.distance > straight && stop.distance < 2.0 * straight, "{stop:?}");
    }

    #[test]
    fn a_rounded_corner_may_take_its_longest_blend() {
        let shapes = vec![line(1.0, 0.0), line(1.0, 50.0)];
        let mode = PathMode::Within { tolerance: 0.1, merge: 0.0 };
        let (stop, least) = stop(mode, shapes, 100.0);
        close(least.distance, 2.5);
        close(stop.distance, 2.5 + 2.0 * 0.4 / std::f64::consts::SQRT_2);
    }

    #[test]
    fn beyond_the_end_there_is_nothing_to_stop_on() {
        let (stop, least) = stop(PathMode::ExactPath, vec![line(1.0, 0.0)], 100.0);
        close(stop.distance, 1.0);
        close(least.distance, 2.5);
    }
}
