//! The least distance and time in which a motion can stop.

use crate::motion::curve::Curve;
use crate::motion::envelope::Envelope;
use crate::motion::route::{CornerTolerance, Route};
use crate::motion::vector::{AxisVector, direction, distance, dot, length, minus};

/// Speeds at the entry of a blend that are tried, relative to the speed at its exit.
const ENTERED: [f64; 9] = [0.25, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0];

/// Points of a blend among which the nearest one to the corner is searched.
const POINTS: u32 = 64;

/// The angle of an arc in one step, radians.
const STEP: f64 = 0.005;

/// Distance along the path, and time, until rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::motion) struct Stop {
    /// Millimetres or degrees.
    pub(in crate::motion) distance: f64,
    /// Seconds.
    pub(in crate::motion) seconds: f64,
}

impl Stop {
    /// The maximum of both, in distance and in time.
    pub(in crate::motion) fn most(self, other: Self) -> Self {
        Self {
            distance: self.distance.max(other.distance),
            seconds: self.seconds.max(other.seconds),
        }
    }
}

/// A distance in which a motion at a point of a route can stop from a speed, however its corners are rounded.
///
/// The motion brakes as hard as its most loaded axis allows, with the acceleration that turning leaves. The length of
/// the blend at a corner is a decision of the planner. The shortest blend needs all of the acceleration to turn, and
/// ends within [`Blend::inner`]: there the speed is constant, and not above that of the longest blend. On a blend of
/// twice that length half of the acceleration is left; it brakes up to the end of the longest blend. The route ends the
/// distance.
pub(in crate::motion) fn stopping(
    route: &Route<'_>,
    envelope: &Envelope,
    from: (usize, f64),
    speed: f64,
) -> Stop {
    // Where the leg ends or turns to axes that are livelier, the motion brakes for that before; in no less time than
    // it takes here.
    let (first, second) = route.legs[from.0].curve.derivatives(from.1);
    let rate = rate(envelope, (&first, &second), speed);
    let seconds = if rate > 0.0 { speed / rate } else { 0.0 };
    let mut stop = Stop::default();
    let (mut speed, mut part) = (speed, from.1);
    for number in from.0..route.legs.len() {
        for stretch in stretches(route, envelope, number, speed) {
            if stretch.to > part {
                let on = Stretch { from: stretch.from.max(part), ..stretch };
                speed = on.passed(&route.legs[number].curve, envelope, speed, &mut stop);
            }
            if speed == 0.0 {
                return Stop { seconds: stop.seconds.max(seconds), ..stop };
            }
        }
        part = 0.0;
    }
    Stop { seconds: stop.seconds.max(seconds), ..stop }
}

/// The distance and time to stop from a velocity on a blend, if the motion can be on a blend at this point of the
/// route; zero if it cannot.
///
/// On a blend that needs all of the acceleration, the velocity changes linearly from that along one leg to that along
/// the other. Its components along both legs therefore give the remaining part of the blend. If exit and entry speed
/// are equal, the sum of the components is the speed at the exit: the middle of the blend is slower, and the motion
/// cannot brake earlier. The exit speed can differ from the entry speed, since an axis that turns little then changes
/// its speed less. It is at most that of the longest blend with the same relative entry speed.
pub(in crate::motion) fn stopping_on_blend(
    route: &Route<'_>,
    envelope: &Envelope,
    (leg, part): (usize, f64),
    velocity: &AxisVector,
) -> Stop {
    let way = route.legs[leg].curve.length();
    let corners = [(leg, part * way), (leg + 1, (1.0 - part) * way)];
    let stops = corners.into_iter().filter_map(|(corner, away)| {
        let blend = Blend::at(route, envelope, corner).filter(|blend| away <= blend.reach)?;
        let (before, behind) = blend.shares(velocity)?;
        let stop = |entered: f64| {
            let speed = (before / entered + behind).min(blend.left(envelope, entered));
            let half = blend.inner(speed);
            let left = 2.0 * half * before / (before + behind);
            let end = (corner, half / route.legs[corner].curve.length());
            let Stop { distance, seconds } = stopping(route, envelope, end, speed);
            Stop { distance: left + distance, seconds: left / speed + seconds }
        };
        Some(ENTERED.into_iter().map(stop).fold(Stop::default(), Stop::most))
    });
    stops.fold(Stop::default(), Stop::most)
}

/// The least stop of a motion if only the next legs are known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::motion) enum Shortest {
    /// It needs at least this distance and time.
    Within(Stop),
    /// It reaches a place where a blend may begin, at least at this speed. How the blend brakes is a decision of the
    /// planner.
    Rounds { place: (usize, f64), speed: f64 },
}

/// The least stop of a motion at a point of a route, if only the first `legs` legs are known.
///
/// If the motion still has speed at the end of the last known leg, it is assumed to brake as hard as there: braking on
/// an unknown leg may take longer, but must not count. A corner that is not rounded takes no distance.
pub(in crate::motion) fn shortest_stopping(
    route: &Route<'_>,
    envelope: &Envelope,
    from: (usize, f64),
    speed: f64,
    legs: usize,
) -> Shortest {
    let last = legs.clamp(from.0 + 1, route.legs.len());
    let mut stop = Stop::default();
    let (mut speed, mut part) = (speed, from.1);
    for number in from.0..last {
        let curve = &route.legs[number].curve;
        let share = |blend: Option<Blend>| blend.map_or(0.0, |blend| blend.reach / curve.length());
        let begun = share(Blend::at(route, envelope, number).filter(|_| number == from.0));
        let ahead = Blend::at(route, envelope, number + 1).filter(|_| number + 1 < last);
        let rounds = 1.0 - share(ahead);
        if part < begun || part > rounds {
            return Shortest::Rounds { place: (number, part), speed };
        }
        let whole = Stretch { from: part, to: rounds, brakes: Brakes::Fully };
        speed = whole.passed(curve, envelope, speed, &mut stop);
        if speed == 0.0 {
            return Shortest::Within(stop);
        }
        if rounds < 1.0 {
            return Shortest::Rounds { place: (number, rounds), speed };
        }
        part = 0.0;
    }
    let (first, second) = route.legs[last - 1].curve.derivatives(1.0);
    let rate = rate(envelope, (&first, &second), speed);
    stop.distance += speed * speed / (2.0 * rate);
    stop.seconds += speed / rate;
    Shortest::Within(stop)
}

/// How hard a motion brakes.
#[derive(Clone, Copy, Debug)]
enum Brakes {
    /// As its axes allow.
    Fully,
    /// With half of that, and no more than half of what another leg allows, millimetres per second squared.
    Half(f64),
    /// Not at all, on a blend that is passed no faster than so, millimetres per second.
    Not(f64),
}

/// A stretch of a leg, by its parameter.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    from: f64,
    to: f64,
    brakes: Brakes,
}

/// The stretches of a leg that is entered at a speed.
fn stretches(
    route: &Route<'_>,
    envelope: &Envelope,
    number: usize,
    speed: f64,
) -> impl Iterator<Item = Stretch> + use<> {
    let length = route.legs[number].curve.length();
    let ends = [Blend::at(route, envelope, number), Blend::at(route, envelope, number + 1)];
    let shares = ends.map(|blend| {
        let blend = blend.unwrap_or_default();
        (blend.inner(speed) / length, blend.reach / length, blend)
    });
    let [(steady, bends, blend), (last_steady, last_bends, last)] = shares;
    let mut places = [0.0, steady, bends, 1.0 - last_bends, 1.0 - last_steady, 1.0];
    places.sort_by(f64::total_cmp);
    (1..places.len()).filter_map(move |place| {
        let (from, to) = (places[place - 1].max(0.0), places[place].min(1.0));
        let middle = 0.5 * (from + to);
        let brakes = if middle < steady {
            Brakes::Not(blend.fastest())
        } else if middle > 1.0 - last_steady {
            Brakes::Not(last.fastest())
        } else {
            match (middle < bends, middle > 1.0 - last_bends) {
                (true, true) => Brakes::Half(blend.rate.min(last.rate)),
                (true, false) => Brakes::Half(blend.rate),
                (false, true) => Brakes::Half(last.rate),
                (false, false) => Brakes::Fully,
            }
        };
        (to > from).then_some(Stretch { from, to, brakes })
    })
}

impl Stretch {
    /// Brakes on it; the speed at its end.
    fn passed(&self, curve: &Curve, envelope: &Envelope, speed: f64, stop: &mut Stop) -> f64 {
        let all = self.to - self.from;
        let steps = (curve.angle().abs() * all / STEP).ceil().max(1.0);
        let (mut speed, mut done) = (speed, 0.0);
        while done < steps {
            let (first, second) = curve.derivatives(self.from + all * done / steps);
            let scale = length(&first);
            if scale == 0.0 {
                return speed;
            }
            let fully = || rate(envelope, (&first, &second), speed);
            let rate = match self.brakes {
                Brakes::Fully => fully(),
                Brakes::Half(other) => 0.5 * fully().min(other),
                Brakes::Not(_) => 0.0,
            };
            let way = scale * all / steps;
            if 2.0 * rate * way >= speed * speed {
                stop.distance += speed * speed / (2.0 * rate);
                stop.seconds += speed / rate;
                return 0.0;
            }
            let after = crate::math::square_root(speed * speed - 2.0 * rate * way);
            stop.distance += way;
            stop.seconds += match self.brakes {
                Brakes::Not(fastest) => way / speed.min(fastest),
                Brakes::Fully | Brakes::Half(_) => 2.0 * way / (speed + after),
            };
            speed = after;
            done += 1.0;
        }
        speed
    }
}

/// How hard the point may brake where a curve has these derivatives, millimetres per second squared.
fn rate(envelope: &Envelope, (first, second): (&AxisVector, &AxisVector), speed: f64) -> f64 {
    let scale = length(first);
    let square = (speed / scale) * (speed / scale);
    let (low, high) = envelope.rates(first, second, square);
    if low <= high && low < 0.0 { -low * scale } else { 0.0 }
}

/// A corner that may be rounded.
#[derive(Clone, Copy, Debug, Default)]
struct Blend {
    /// How much of a leg the longest blend takes: what the tolerance allows of a parabola that is tangent to both
    /// legs, and no more than the shorter leg, or its half between midpoints.
    reach: f64,
    /// What turning costs: the acceleration of the axis that turns most, over its limit, for a square of speed and
    /// per length of a blend's half.
    turn: f64,
    /// How hard the point may brake in either direction.
    rate: f64,
    /// The directions of the legs.
    directions: [AxisVector; 2],
    /// How much of each leg a blend may take, whatever the tolerance.
    room: [f64; 2],
    /// How far from the corner it may pass; without end between midpoints.
    tolerance: f64,
}

impl Blend {
    /// That of a corner, where it may be rounded.
    fn at(route: &Route<'_>, envelope: &Envelope, corner: usize) -> Option<Self> {
        if !route.breaks(corner) || corner == 0 || corner == route.legs.len() {
            return None;
        }
        let legs = (&route.legs[corner - 1].curve, &route.legs[corner].curve);
        let (before, after) = (legs.0.derivatives(1.0), legs.1.derivatives(0.0));
        let (one, other) = (direction(&before.0)?, direction(&after.0)?);
        let lengths = [legs.0.length(), legs.1.length()];
        let (room, tolerance) = match route.corners[corner].tolerance {
            CornerTolerance::Rest | CornerTolerance::Exact => return None,
            CornerTolerance::BetweenMidpoints => {
                (lengths.map(|length| 0.5 * length), f64::INFINITY)
            }
            CornerTolerance::Within(tolerance) => (lengths, tolerance),
        };
        let reach = room[0].min(room[1]).min(4.0 * tolerance / distance(&one, &other));
        let used = minus(&other, &one);
        let turn = (0..9).map(|axis| used[axis].abs() / envelope.acceleration[axis]);
        let rest = [0.0; 9];
        let rate = rate(envelope, (&one, &rest), 0.0).min(rate(envelope, (&other, &rest), 0.0));
        let turn = 0.5 * turn.fold(0.0, f64::max);
        Some(Self { reach, turn, rate, directions: [one, other], room, tolerance })
    }

    /// How far from the corner a blend may still take more than half of the acceleration at a speed.
    fn inner(&self, speed: f64) -> f64 {
        self.reach.min(2.0 * self.turn * speed * speed)
    }

    /// The speed with which the longest one takes all of the acceleration.
    fn fastest(&self) -> f64 {
        crate::math::square_root(self.reach / self.turn)
    }

    /// The speed with which the longest one is left that is entered with this share of it, and takes all of the
    /// acceleration.
    fn left(&self, envelope: &Envelope, entered: f64) -> f64 {
        let [before, after] = &self.directions;
        let turn = (0..9)
            .map(|axis| (after[axis] - entered * before[axis]).abs() / envelope.acceleration[axis]);
        let turn = 0.5 * turn.fold(0.0, f64::max);
        let nearest = (0..=POINTS).map(|point| {
            let part = f64::from(point) / f64::from(POINTS);
            let (one, other) = (entered * (1.0 - part) * (1.0 - part), part * part);
            length(&std::array::from_fn(|axis| other * after[axis] - one * before[axis]))
        });
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        let way = self.room[1].min(self.room[0] / entered).min(self.tolerance / nearest);
        crate::math::square_root(way / turn)
    }

    /// The shares of a velocity along the legs, if it lies between their directions.
    fn shares(&self, velocity: &AxisVector) -> Option<(f64, f64)> {
        let [before, after] = &self.directions;
        let (one, other, both) = (dot(velocity, before), dot(velocity, after), dot(before, after));
        let (one, other) = (one - both * other, other - both * one);
        let rest = 1.0 - both * both;
        let between = one >= 0.0 && other >= 0.0 && one + other > 0.0 && rest > 0.0;
        between.then_some((one / rest, other / rest))
    }
}

#[cfg(test)]
mod tests {
    use gaugeblock_vocabulary::motion::{
        Controls, Feed, MotionLimits, PathElement, PathMode, ProgrammedPath, Shape,
    };
    use gaugeblock_vocabulary::scenario::AxisLimits;
    use gaugeblock_vocabulary::{Axis, BlockLocation, Position};

    use super::*;

    fn path(mode: PathMode, shapes: Vec<Shape>) -> ProgrammedPath {
        let element = |shape| PathElement {
            block: BlockLocation::new("main.ngc", 1),
            shape,
            feed: Feed::PerSecond(200.0),
            mode,
            controls: Controls::default(),
            switches: Vec::new(),
        };
        let elements = shapes.into_iter().map(element).collect();
        ProgrammedPath { elements, ..ProgrammedPath::default() }
    }

    fn envelope() -> Envelope {
        let limit = AxisLimits {
            velocity: Some(250.0),
            acceleration: Some(2000.0),
            ..AxisLimits::default()
        };
        let axes = [Axis::X, Axis::Y].map(|axis| (axis, limit)).into();
        Envelope::of(&MotionLimits { period: 0.001, axes })
    }

    fn stop(mode: PathMode, shapes: Vec<Shape>, speed: f64) -> (Stop, Shortest) {
        let (path, envelope) = (path(mode, shapes), envelope());
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
        let blend = 0.4 / std::f64::consts::SQRT_2;
        close(stop.distance, 2.5 + 2.0 * blend);
        let Shortest::Rounds { place: (0, part), speed } = least else { panic!("{least:?}") };
        close(part, 1.0 - blend);
        close(speed * speed, 100.0 * 100.0 - 2.0 * 2000.0 * (1.0 - blend));
    }

    #[test]
    fn in_a_blend_that_has_begun_nothing_is_known_of_braking() {
        let shapes = vec![line(0.2, 0.0), line(0.2, 50.0)];
        let mode = PathMode::Within { tolerance: 0.1, merge: 0.0 };
        let (stop, least) = stop(mode, shapes, 20.0);
        close(stop.distance, 2.0 * 0.2 + 0.1);
        assert_eq!(least, Shortest::Rounds { place: (0, 0.0), speed: 20.0 });
    }

    #[test]
    fn where_a_corner_is_flat_most_of_the_brakes_is_left() {
        let shapes = vec![line(10.0, 0.0), line(20.0, 0.1)];
        let mode = PathMode::Within { tolerance: 0.1, merge: 0.0 };
        let (stop, _) = stop(mode, shapes, 100.0);
        assert!(stop.distance > 4.9 && stop.distance < 5.1, "{stop:?}");
    }

    #[test]
    fn a_blend_ends_faster_than_its_middle_is_passed() {
        let shapes = vec![line(1.0, 0.0), line(1.0, 50.0)];
        let path = path(PathMode::Within { tolerance: 0.1, merge: 0.0 }, shapes);
        let route = Route::of(&path).expect("lines and arcs are known");
        let stop = |part: f64, x: f64, y: f64| {
            let velocity = Position { x, y, ..Position::default() }.to_array();
            stopping_on_blend(&route, &envelope(), (0, part), &velocity)
        };
        let reach = 0.4 / std::f64::consts::SQRT_2;
        // A blend that is entered with a quarter of the speed with which it is left: where it is nearest to the
        // corner, its time that has passed is the cube root of a sixteenth of what is left.
        let ratio = 0.396_850_262_992;
        let all = (1.0 + ratio) * (1.0 + ratio);
        let fast = 0.1 * all / crate::math::hypotenuse(0.25, ratio * ratio);
        let near = |found: f64, wanted: f64| {
            assert!((found - wanted).abs() < 2e-4, "{found} is not {wanted}");
        };
        for speed in [20.0, 100.0] {
            let middle = stop(0.9, speed, speed);
            near(middle.distance, reach + fast);
        }
        near(stop(0.9, 30.0, 10.0).distance, 1.5 * reach + fast);
        assert_eq!(stop(0.5, 10.0, 5.0), Stop::default());
        assert_eq!(stop(0.9, 10.0, -5.0), Stop::default());
    }

    #[test]
    fn beyond_the_end_there_is_nothing_to_stop_on() {
        let (stop, least) = stop(PathMode::ExactPath, vec![line(1.0, 0.0)], 100.0);
        close(stop.distance, 1.0);
        let Shortest::Within(least) = least else { panic!("{least:?}") };
        close(least.distance, 2.5);
    }
}
