//! Where an element leads: place, speed and curvature over its parameter, which runs from 0 to 1.

use std::array;

use gaugeblock_vocabulary::Position;
use gaugeblock_vocabulary::motion::Shape;

use super::vector::{self, AxisVector, distance, from_segment, minus, plus};
use crate::math;

/// Which coordinates a feed counts (manual of 2.9, section 2.5.2.5).
///
/// Rule trajectory.feed-coordinates. X, Y, Z if any of them moves; else U, V, W if any of them does; else A, B, C.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Counted {
    /// X, Y, Z.
    First,
    /// U, V, W.
    Second,
    /// A, B, C, in degrees.
    Rotary,
}

impl Counted {
    fn of(change: &AxisVector, is_arc: bool) -> Self {
        let moves = |place: usize| change[place] != 0.0;
        if is_arc || (0..3).any(moves) {
            Self::First
        } else if (6..9).any(moves) {
            Self::Second
        } else {
            Self::Rotary
        }
    }

    /// The length of a vector in these coordinates.
    pub(super) fn length(self, vector: &AxisVector) -> f64 {
        let first = match self {
            Self::First => 0,
            Self::Rotary => 3,
            Self::Second => 6,
        };
        let parts = &vector[first..first + 3];
        math::square_root(parts.iter().map(|part| part * part).sum())
    }
}

/// Bounds of the size of derivatives over a whole curve, axis by axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) third: AxisVector,
    pub(super) fourth: AxisVector,
}

/// The part of an arc that is not a straight line: a turn about an axis of space.
#[derive(Clone, Copy, Debug)]
struct Turn {
    /// A point of the axis, at the height of the start.
    centre: [f64; 3],
    /// From the axis to the start: a unit vector.
    outward: [f64; 3],
    /// Square to it and to the axis: where the start goes if the angle is positive.
    onward: [f64; 3],
    /// Distance from the axis at the start, and what it gains on the way.
    radius: (f64, f64),
    /// Along the axis, on the whole way.
    rise: [f64; 3],
    /// Radians, on the whole way.
    angle: f64,
}

/// From the axis to where a turn is.
struct Spoke {
    length: f64,
    /// Unit vectors along it and square to it, the way the turn goes on.
    outward: [f64; 3],
    onward: [f64; 3],
}

impl Turn {
    fn spoke(&self, part: f64) -> Spoke {
        let (sine, cosine) = (math::sine(self.angle * part), math::cosine(self.angle * part));
        Spoke {
            length: self.radius.0 + self.radius.1 * part,
            outward: array::from_fn(|axis| self.outward[axis] * cosine + self.onward[axis] * sine),
            onward: array::from_fn(|axis| self.onward[axis] * cosine - self.outward[axis] * sine),
        }
    }

    fn place(&self, part: f64, spoke: &Spoke) -> [f64; 3] {
        array::from_fn(|axis| {
            self.centre[axis] + self.rise[axis] * part + spoke.length * spoke.outward[axis]
        })
    }

    fn rate(&self, spoke: &Spoke) -> [f64; 3] {
        array::from_fn(|axis| {
            let onward = spoke.onward[axis] * self.angle;
            self.rise[axis] + self.radius.1 * spoke.outward[axis] + spoke.length * onward
        })
    }
}

/// A moving element.
#[derive(Clone, Copy, Debug)]
pub(super) struct Curve {
    start: AxisVector,
    end: AxisVector,
    turn: Option<Turn>,
}

impl Curve {
    /// A straight line.
    pub(super) fn straight(start: AxisVector, end: AxisVector) -> Self {
        Self { start, end, turn: None }
    }

    /// What a shape is from a start; `None` for what does not move or is not known.
    pub(super) fn of(start: Position, shape: &Shape) -> Option<Self> {
        let start = start.to_array();
        match shape {
            Shape::Straight { end } | Shape::Probe { end, contact: None } => {
                Some(Self::straight(start, end.to_array()))
            }
            Shape::Arc { end, centre, normal, angle } => {
                let end = end.to_array();
                let turn = turn(&start, &end, *centre, *normal, angle.to_radians());
                Some(Self { start, end, turn: Some(turn) })
            }
            Shape::Probe { .. }
            | Shape::Curve { .. }
            | Shape::Dwell { .. }
            | Shape::Wait { .. }
            | Shape::AtOnce(_) => None,
        }
    }

    /// Where it starts.
    pub(super) fn start(&self) -> AxisVector {
        self.start
    }

    /// Where it ends.
    pub(super) fn end(&self) -> AxisVector {
        self.end
    }

    /// Whether it is a straight line.
    pub(super) fn is_straight(&self) -> bool {
        self.turn.is_none()
    }

    /// How far it goes about its axis, radians; zero for a line.
    pub(super) fn angle(&self) -> f64 {
        self.turn.map_or(0.0, |turn| turn.angle)
    }

    /// How far a point is off it.
    pub(super) fn away(&self, point: &AxisVector) -> f64 {
        let step = (self.angle().abs() / std::f64::consts::FRAC_PI_2).ceil().max(1.0).recip();
        let mut from = 0.0;
        let mut least = f64::INFINITY;
        while from < 1.0 {
            let near = self.at(self.nearest(point, from, (from + step).min(1.0)));
            least = least.min(distance(&near, point));
            from += step;
        }
        least
    }

    /// How far an arc is from the line between its ends, at least; zero for a line.
    pub(super) fn rise_over_chord(&self) -> f64 {
        from_segment(&self.start, &self.end, &self.at(0.5))
    }

    /// Whether it leads nowhere.
    pub(super) fn is_empty(&self) -> bool {
        self.turn.is_none() && distance(&self.start, &self.end) == 0.0
    }

    /// The point at a parameter; exactly its ends at 0 and 1.
    pub(super) fn at(&self, part: f64) -> AxisVector {
        if part <= 0.0 {
            return self.start;
        }
        if part >= 1.0 {
            return self.end;
        }
        let mut point = plus(&self.start, &minus(&self.end, &self.start), part);
        if let Some(turn) = &self.turn {
            point[..3].copy_from_slice(&turn.place(part, &turn.spoke(part)));
        }
        point
    }

    /// First and second derivative over the parameter.
    pub(super) fn derivatives(&self, part: f64) -> (AxisVector, AxisVector) {
        let mut first = minus(&self.end, &self.start);
        let mut second = [0.0; 9];
        if let Some(turn) = &self.turn {
            let spoke = turn.spoke(part);
            first[..3].copy_from_slice(&turn.rate(&spoke));
            for (axis, value) in second[..3].iter_mut().enumerate() {
                let onward = spoke.onward[axis] * turn.angle;
                *value = 2.0 * turn.radius.1 * onward
                    - spoke.length * turn.angle * turn.angle * spoke.outward[axis];
            }
        }
        (first, second)
    }

    /// Third derivative over the parameter.
    pub(super) fn third(&self, part: f64) -> AxisVector {
        let mut third = [0.0; 9];
        if let Some(turn) = &self.turn {
            let (spoke, square) = (turn.spoke(part), turn.angle * turn.angle);
            for (axis, value) in third[..3].iter_mut().enumerate() {
                let (outward, onward) = (spoke.outward[axis], spoke.onward[axis]);
                *value =
                    -square * (3.0 * turn.radius.1 * outward + spoke.length * turn.angle * onward);
            }
        }
        third
    }

    /// Bounds of its third and fourth derivative.
    pub(super) fn bounds(&self) -> Bounds {
        let mut bounds = Bounds { third: [0.0; 9], fourth: [0.0; 9] };
        if let Some(turn) = &self.turn {
            let (angle, gain) = (turn.angle.abs(), turn.radius.1.abs());
            let radius = turn.radius.0.max(turn.radius.0 + turn.radius.1);
            let (square, cube) = (angle * angle, angle * angle * angle);
            for axis in 0..3 {
                let share = math::hypotenuse(turn.outward[axis], turn.onward[axis]);
                bounds.third[axis] = share * (3.0 * gain * square + radius * cube);
                bounds.fourth[axis] = share * (4.0 * gain * cube + radius * square * square);
            }
        }
        bounds
    }

    /// Whether its speed over the parameter is the same everywhere: no spiral.
    pub(super) fn is_even(&self) -> bool {
        self.turn.is_none_or(|turn| turn.radius.1 == 0.0)
    }

    /// Which coordinates its feed counts.
    pub(super) fn counted(&self) -> Counted {
        Counted::of(&minus(&self.end, &self.start), self.turn.is_some())
    }

    /// Its length in the coordinates that its feed counts. That of a spiral is taken at its mean radius.
    pub(super) fn feed_length(&self) -> f64 {
        self.counted().length(&self.derivatives(0.5).0)
    }

    /// Its length in all nine.
    pub(super) fn length(&self) -> f64 {
        vector::length(&self.derivatives(0.5).0)
    }

    /// The point at a parameter, and its derivative.
    fn passing(&self, part: f64) -> (AxisVector, AxisVector) {
        let whole = minus(&self.end, &self.start);
        let (mut point, mut rate) = (plus(&self.start, &whole, part), whole);
        if let Some(turn) = &self.turn {
            let spoke = turn.spoke(part);
            point[..3].copy_from_slice(&turn.place(part, &spoke));
            rate[..3].copy_from_slice(&turn.rate(&spoke));
        }
        (point, rate)
    }

    /// The parameter from `from` to `to` that is nearest to a point: of a line exactly, of an arc of at most a
    /// quarter to the last place.
    pub(super) fn nearest(&self, point: &AxisVector, from: f64, to: f64) -> f64 {
        if self.is_straight() {
            return vector::nearest_part(&self.start, &self.end, point).clamp(from, to);
        }
        let slope = |part: f64| {
            let (here, rate) = self.passing(part);
            vector::dot(&minus(&here, point), &rate)
        };
        let (first, last) = (slope(from), slope(to));
        if first >= 0.0 || last <= 0.0 {
            let (first, last) = (distance(&self.at(from), point), distance(&self.at(to), point));
            return if first <= last { from } else { to };
        }
        boundary((from, first), (to, last), slope)
    }

    /// The parameters from `from` to `to` at which it is within a tolerance of a point, if there are any.
    pub(super) fn within(
        &self,
        point: &AxisVector,
        tolerance: f64,
        from: f64,
        to: f64,
    ) -> Option<(f64, f64)> {
        let nearest = self.nearest(point, from, to);
        let excess = |part: f64| distance(&self.at(part), point) - tolerance;
        let least = excess(nearest);
        let up_to = |end: f64| {
            let there = excess(end);
            if there <= 0.0 { end } else { boundary((nearest, least), (end, there), excess) }
        };
        (least <= 0.0).then(|| (up_to(from), up_to(to)))
    }
}

/// The last place on the way from one where a function is at most zero to one where it is more: where their line
/// crosses zero, again and again, with half the value of an end that has stayed for two times, and halfway every
/// fourth time.
fn boundary(inside: (f64, f64), outside: (f64, f64), excess: impl Fn(f64) -> f64) -> f64 {
    let ((mut inside, mut below), (mut outside, mut above)) = (inside, outside);
    let mut went_out = None;
    for round in 1..=4 * 54 {
        let width = outside - inside;
        if width.abs() <= f64::EPSILON {
            break;
        }
        let part = if round % 4 == 0 { 0.5 } else { below / (below - above) };
        // One step of the last place beside an end tells whether that is the boundary.
        let least = f64::EPSILON / width.abs();
        let middle = inside + width * part.max(least).min(1.0 - least);
        let value = excess(middle);
        let is_out = value > 0.0;
        if is_out {
            (outside, above) = (middle, value);
            below = if went_out == Some(true) { below / 2.0 } else { below };
        } else {
            (inside, below) = (middle, value);
            above = if went_out == Some(false) { above / 2.0 } else { above };
        }
        went_out = Some(is_out);
    }
    inside
}

fn turn(
    start: &AxisVector,
    end: &AxisVector,
    centre: [f64; 3],
    normal: [f64; 3],
    angle: f64,
) -> Turn {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let from = |point: &AxisVector| -> ([f64; 3], f64) {
        let away: [f64; 3] = array::from_fn(|axis| point[axis] - centre[axis]);
        let height = dot(away, normal);
        (array::from_fn(|axis| away[axis] - normal[axis] * height), height)
    };
    let ((outward, start_height), (end_outward, end_height)) = (from(start), from(end));
    let radius = math::square_root(dot(outward, outward));
    let gain = math::square_root(dot(end_outward, end_outward)) - radius;
    // What rounding leaves of equal radii is no spiral.
    let gain = if gain.abs() <= 1e-12 * radius { 0.0 } else { gain };
    let outward = if radius > 0.0 { outward.map(|part| part / radius) } else { [0.0; 3] };
    let onward = [
        normal[1] * outward[2] - normal[2] * outward[1],
        normal[2] * outward[0] - normal[0] * outward[2],
        normal[0] * outward[1] - normal[1] * outward[0],
    ];
    Turn {
        centre: array::from_fn(|axis| centre[axis] + normal[axis] * start_height),
        outward,
        onward,
        radius: (radius, gain),
        rise: normal.map(|part| part * (end_height - start_height)),
        angle,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn helix() -> Curve {
        let end = Position { z: -10.0, a: 90.0, ..Position::default() };
        let shape =
            Shape::Arc { end, centre: [5.0, 0.0, 3.0], normal: [0.0, 0.0, 1.0], angle: -3600.0 };
        Curve::of(Position::default(), &shape).expect("an arc moves")
    }

    #[test]
    fn a_helix_goes_round_its_axis_and_along_it() {
        let quarter = helix().at(0.025);
        for (place, wanted) in [(0, 5.0), (1, 5.0), (2, -0.25), (3, 2.25)] {
            assert!((quarter[place] - wanted).abs() < 1e-12, "{quarter:?}");
        }
        assert!(
            (helix().feed_length() - (100.0 * std::f64::consts::PI).hypot_of(10.0)).abs() < 1e-9
        );
    }

    trait Hypot {
        fn hypot_of(self, other: f64) -> f64;
    }

    impl Hypot for f64 {
        fn hypot_of(self, other: f64) -> f64 {
            math::hypotenuse(self, other)
        }
    }

    #[test]
    fn derivatives_are_those_of_the_point() {
        let (curve, step) = (helix(), 1e-5);
        for part in [0.1, 0.37, 0.9] {
            let (first, second) = curve.derivatives(part);
            let (before, here, after) =
                (curve.at(part - step), curve.at(part), curve.at(part + step));
            for axis in 0..9 {
                let slope = (after[axis] - before[axis]) / (2.0 * step);
                let bend = (after[axis] - 2.0 * here[axis] + before[axis]) / (step * step);
                assert!((slope - first[axis]).abs() < 1e-3, "{axis}");
                assert!((bend - second[axis]).abs() < 1e-1, "{axis}");
                let (earlier, later) =
                    (curve.derivatives(part - step).1, curve.derivatives(part + step).1);
                let third = (later[axis] - earlier[axis]) / (2.0 * step);
                assert!((third - curve.third(part)[axis]).abs() < 1.0, "{axis}");
                assert!(third.abs() <= curve.bounds().third[axis] + 1.0);
            }
        }
    }

    #[test]
    fn the_nearest_point_of_a_quarter_is_found() {
        let curve = helix();
        for part in [0.001, 0.01, 0.02] {
            let found = curve.nearest(&curve.at(part), 0.0, 0.025);
            assert!((found - part).abs() < 1e-12);
        }
    }

    #[test]
    fn a_boundary_is_where_halving_finds_it() {
        let halved = |excess: &dyn Fn(f64) -> f64, from: f64, to: f64| {
            let (mut inside, mut outside) = (from, to);
            for _ in 0..54 {
                let middle = inside + (outside - inside) / 2.0;
                if excess(middle) <= 0.0 { inside = middle } else { outside = middle }
            }
            inside
        };
        let away = |from: f64, high: f64| move |part: f64| libm::hypot(part - from, high);
        let mut functions: Vec<Box<dyn Fn(f64) -> f64>> = vec![
            Box::new(|part| part - 0.3),
            Box::new(|part| libm::cbrt(part - 0.37)),
            Box::new(|part| if part < 0.71 { -1e-9 } else { 1e9 }),
            Box::new(|part| part * part * part - 0.1),
        ];
        for tolerance in [1e-9, 1e-3, 0.2] {
            for high in [0.0, 0.5, 0.999_999, 1.0] {
                let distance = away(0.2, high * tolerance);
                functions.push(Box::new(move |part| distance(part) - tolerance));
            }
        }
        for (place, excess) in functions.iter().enumerate() {
            let found = boundary((0.2, excess(0.2)), (1.0, excess(1.0)), excess);
            let wanted = halved(excess, 0.2, 1.0);
            assert!((found - wanted).abs() <= 1e-15, "{place}: {found} {wanted}");
        }
    }

    #[test]
    fn a_point_is_as_far_off_as_from_the_nearest_turn() {
        let curve = helix();
        for part in [0.0, 0.31, 0.5, 0.77, 1.0] {
            assert!(curve.away(&curve.at(part)) < 1e-9);
            let mut beside = curve.at(part);
            beside[8] += 0.25;
            assert!((curve.away(&beside) - 0.25).abs() < 1e-9);
        }
    }
}
