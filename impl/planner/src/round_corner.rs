//! A round corner: an arc that touches two lines, where it takes less time than a parabola.
//!
//! On a parabola the feed falls to F·cos(θ/2) in the middle of a corner that turns by θ. An arc is passed at one speed,
//! and it is shorter. Its limits are those of any arc.

use crate::limits::{Limits, least, squared};
use crate::math;
use crate::nominal_segment::NominalSegment;
use crate::parameters::Axes;
use crate::path_element::{Circle, PathElement};

/// A corner with a lesser change of the unit tangent is a parabola: there the feed falls by less than a hundredth.
pub(crate) const ROUND_CHANGE_MIN: f64 = 0.2821;
/// A corner that turns more, by the cosine of half of its angle, is nearly a reversal.
const HALF_COSINE_MIN: f64 = 0.05;

/// A corner that may be round, before the lengths of its lines are divided.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct RoundCorner {
    /// The greatest length that it may use of each line.
    pub(crate) length_max: f64,
    /// Of half of the angle by which it turns.
    half_sine: f64,
    half_cosine: f64,
    /// Radians.
    angle: f64,
    /// The programmed speed.
    feed: f64,
    /// The least acceleration and velocity of an axis in its plane.
    acceleration: f64,
    velocity: f64,
    /// The squared speed of a parabola for each unit that it uses of both lines together.
    parabola_speed_sq_rate: f64,
    /// The servo cycle, seconds.
    cycle: f64,
}

impl RoundCorner {
    /// Writes the corner between two lines of X, Y and Z that are passed at `feed`, given the change of the unit
    /// tangent, the tolerance, and the most that it may use of each line. Returns whether it may be round.
    #[inline(never)]
    pub(crate) fn write(
        &mut self,
        (before, after): (&NominalSegment, &NominalSegment),
        (change, break_angle): (&Axes, f64),
        (feed, tolerance, most): (f64, f64, f64),
        limits: &Limits,
    ) -> bool {
        let half_sine = 0.5 * break_angle;
        let half_cosine = math::sqrt((1.0 - squared(half_sine)).max(0.0));
        if half_cosine < HALF_COSINE_MIN {
            return false;
        }
        // Two directions at right angles in its plane: those of the chord and of the bisector.
        let mut amplitudes = Axes::default();
        let directions = before.end_tangent.iter().zip(&after.start_tangent).zip(change);
        for (amplitude, ((from, to), change)) in amplitudes.iter_mut().zip(directions) {
            *amplitude = math::hypotenuse((from + to) / (2.0 * half_cosine), change / break_angle);
        }
        *self = Self {
            length_max: math::min(most, tolerance * half_sine / (1.0 - half_cosine)),
            half_sine,
            half_cosine,
            angle: 2.0 * math::arc_tangent(half_sine, half_cosine),
            feed,
            acceleration: least(&limits.acceleration, &amplitudes, 3),
            velocity: least(&limits.velocity, &amplitudes, 3),
            parabola_speed_sq_rate: least(&limits.planned, change, 3),
            cycle: limits.cycle,
        };
        true
    }

    /// Whether an arc takes less time than a parabola, given what each uses of both lines.
    #[inline(never)]
    pub(crate) fn is_faster(&self, round: f64, parabola: f64) -> bool {
        let radius = self.radius(round);
        // What `Limits::assign_model` plans with.
        let turned = math::sqrt(self.acceleration / radius) * self.cycle;
        let speed_sq = self.acceleration * radius * math::sqrt((1.0 - turned).max(0.25));
        let saved = 2.0 * round - self.length_at_feed(self.angle * radius, speed_sq);
        let speed_sq = 2.0 * parabola * self.parabola_speed_sq_rate;
        saved > 2.0 * parabola - self.length_at_feed(2.0 * parabola, speed_sq)
    }

    /// The length that is passed at the feed in the time that a part takes which must be slower: with the time for
    /// slowing down before it and speeding up after it.
    fn length_at_feed(&self, length: f64, speed_sq: f64) -> f64 {
        let speed = math::sqrt(speed_sq).min(self.velocity).min(self.feed);
        length * self.feed / speed + squared(self.feed - speed) / self.acceleration
    }

    fn radius(&self, length: f64) -> f64 {
        length * self.half_cosine / self.half_sine
    }

    /// The arc that uses a length of each line.
    #[inline(never)]
    pub(crate) fn arc(
        &self,
        (before, after): (&NominalSegment, &NominalSegment),
        (change, length): (&Axes, f64),
        limits: &Limits,
    ) -> PathElement {
        let radius = self.radius(length);
        let corner = &before.whole.end;
        let mut arc = PathElement::default();
        arc.begin_at(corner);
        (arc.end, arc.axis_count) = (*corner, 3);
        let mut circle = Circle { angle_rate: 1.0 / radius, ..Circle::default() };
        let directions = before.end_tangent.iter().zip(&after.start_tangent).zip(change);
        let vectors = circle.cosine.iter_mut().zip(&mut circle.sine);
        let places = arc.origin.iter_mut().zip(&mut arc.end).zip(vectors);
        for (((centre, end), (along, across)), ((from, to), change)) in places.zip(directions) {
            // Towards the centre, which is R / cos(θ/2) from the corner.
            let inward = change / (2.0 * self.half_sine);
            *along = -radius / self.half_cosine * (self.half_sine * from + inward);
            *across = radius * from;
            *centre = *end - length * from - *along;
            *end += length * to;
        }
        arc.circle = Some(circle);
        arc.length = self.angle * radius;
        arc.smoothing = after.whole.smoothing;
        arc.segment_start = Some(0.5 * arc.length);
        arc.feed = before.whole.feed.min(after.whole.feed);
        arc.feed_basis = after.whole.feed_basis;
        (arc.number, arc.index) = (after.whole.number, after.whole.index);
        arc.probing = after.whole.probing;
        limits.assign_model(&mut arc);
        arc
    }
}
