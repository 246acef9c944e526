//! Elements of the commanded path, each with a parameter that runs like the distance.
//!
//! An element is p(x) = origin + tangent·x + curvature·x²/2, on arcs plus a circle. Its parameter x runs from 0 to
//! `length`, and |p'| is 1 at its start, so the speed of x is the path's speed at every junction. Lines have no
//! curvature. A parabola between two lines has curvature alone; a round corner is an arc. A blend with an arc is that
//! arc plus a curvature that removes the break of direction.
//!
//! Names that end in `_sq` are squares of speeds of the parameter.

use crate::math;
use crate::parameters::{Axes, lead};

/// The part of a position that rotates: (cosine·cos(κ·x) + sine·sin(κ·x))·(1 + growth·x) on X, Y and
/// Z.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Circle {
    /// From the centre to the start of the element.
    pub(crate) cosine: [f64; 3],
    /// A quarter turn further.
    pub(crate) sine: [f64; 3],
    /// Radians per unit of the parameter, κ in formulas; at least 0: `sine` has the sense of rotation.
    pub(crate) angle_rate: f64,
    /// Growth of the radius per unit of the parameter, relative to the radius at the start. A rounded end point is
    /// never exactly on the circle of the start, so the distance from the axis changes evenly between them.
    pub(crate) growth: f64,
}

impl Circle {
    /// The radius at x relative to the one at the start.
    pub(crate) fn radius_ratio(&self, x: f64) -> f64 {
        1.0 + self.growth * x
    }

    /// Whether something at this distance cannot limit the speed here: whatever the speed there, it is reached within
    /// half of that angle.
    pub(crate) fn is_beyond_influence(&self, distance: f64) -> bool {
        2.0 * self.angle_rate * distance >= core::f64::consts::FRAC_PI_2
    }

    /// The rotating part of p, p' and p'' at x.
    #[inline(never)]
    fn derivatives(&self, x: f64) -> [[f64; 3]; 3] {
        let [mut position, mut first, mut second] = [[0.0; 3]; 3];
        let (sine, cosine) = math::sin_cos(self.angle_rate * x);
        let grown = self.radius_ratio(x);
        let square = self.angle_rate * self.angle_rate * grown;
        let vectors = self.cosine.iter().zip(&self.sine);
        let places = position.iter_mut().zip(&mut first).zip(&mut second);
        for (((place, first), second), (start, quarter)) in places.zip(vectors) {
            let along = start * cosine + quarter * sine;
            let across = self.angle_rate * (quarter * cosine - start * sine);
            *place = grown * along;
            *first = grown * across + self.growth * along;
            *second = 2.0 * self.growth * across - square * along;
        }
        [position, first, second]
    }

    /// Moves its start forward.
    fn begin_at(&mut self, from: f64) {
        let (sine, cosine) = math::sin_cos(self.angle_rate * from);
        let grown = self.radius_ratio(from);
        self.growth /= grown;
        for (along, across) in self.cosine.iter_mut().zip(&mut self.sine) {
            let (was_along, was_across) = (*along, *across);
            *along = grown * (was_along * cosine + was_across * sine);
            *across = grown * (was_across * cosine - was_along * sine);
        }
    }
}

/// What keeps speed and acceleration of an element within the limits of all axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum AccelerationModel {
    /// A line: the acceleration of the parameter has one limit everywhere.
    Constant {
        /// Per second squared.
        acceleration: f64,
    },
    /// A parabola between two lines: each axis is checked by itself, which is exact.
    Blend {
        /// The squared speed at which it may be passed without acceleration.
        steady_speed_sq: f64,
    },
    /// An arc, programmed or a round corner: tangential and centripetal acceleration share a limit,
    /// u² + (κ·v²)² ≤ acceleration².
    Arc {
        /// Per second squared, of the axis that has least.
        acceleration: f64,
        /// The limit for plans: less by what a speed that changes once per cycle loses.
        planned: f64,
    },
    /// A blended arc: acceleration along and across the path share what the axes allow, `|u| + loss * v² <= at_rest` in
    /// plans. Both values are less than what the axes allow by what a speed that changes once per cycle loses: loss·v
    /// times the cycle at the highest speed.
    BlendedArc {
        /// Per second squared, at rest.
        at_rest: f64,
        /// Per unit of the parameter.
        loss: f64,
    },
    /// No motion for so many seconds.
    Dwell(f64),
}

impl Default for AccelerationModel {
    fn default() -> Self {
        Self::Dwell(0.0)
    }
}

/// The unit of a feed, and so which override applies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum FeedBasis {
    #[default]
    Rapid,
    PerSecond,
    PerTurn,
}

/// The limits of a blend in the form |entry + slope·exit| ≤ limit; infinite where an axis does not limit the entry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BlendLimits<const N: usize> {
    pub(crate) slopes: [[f64; N]; 2],
    pub(crate) limits: [[f64; N]; 2],
    /// The highest exit that the axes allow which do not limit the entry.
    pub(crate) exit_max: f64,
    /// Whether no slope is above 0, so that a lower exit never allows a higher entry.
    pub(crate) slopes_fall: bool,
    /// Up to this exit some entry is certainly allowed by all axes.
    pub(crate) feasible_exit_max: f64,
}

impl<const N: usize> Default for BlendLimits<N> {
    fn default() -> Self {
        let none = [[0.0; N]; 2];
        Self {
            slopes: none,
            limits: none,
            exit_max: 0.0,
            slopes_fall: false,
            feasible_exit_max: 0.0,
        }
    }
}

/// What a moving average is taken of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Averaged {
    /// Positions.
    #[default]
    Position,
    /// The parameter of a line between two rests, whose acceleration does not change its sign within the window.
    LoneLine,
    /// The parameter of an arc between two rests.
    LoneArc,
}

/// How the motion on an element is smoothed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Smoothing {
    /// How many cycles the moving average covers; 0 without limits of jerk.
    pub(crate) window: u16,
    /// The number of its limits in [`crate::limits::LimitTable`].
    pub(crate) limits: u16,
    pub(crate) averaged: Averaged,
    /// Whether other axes than X, Y and Z may move.
    pub(crate) has_more_axes: bool,
}

/// A part of the path with one acceleration model.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PathElement {
    pub(crate) origin: Axes,
    pub(crate) tangent: Axes,
    pub(crate) curvature: Axes,
    pub(crate) circle: Option<Circle>,
    /// p(length), exactly as programmed where it was programmed.
    pub(crate) end: Axes,
    pub(crate) length: f64,
    /// |p'| at the end: the ratio of the next element's parameter speed to this one's.
    pub(crate) end_speed_ratio: f64,
    /// How many leading axes take part, at least 3.
    pub(crate) axis_count: usize,
    pub(crate) model: AccelerationModel,
    /// The limits of a blend of up to three axes, run forward.
    pub(crate) blend_limits: BlendLimits<3>,
    /// Highest squared speed that the axes allow at the start.
    pub(crate) start_limit_sq: f64,
    /// The same at the end; between them it changes linearly.
    pub(crate) end_limit_sq: f64,
    /// The root of the higher one.
    pub(crate) speed_limit: f64,
    /// Programmed speed of the parameter, per second or per revolution.
    pub(crate) feed: f64,
    pub(crate) feed_basis: FeedBasis,
    /// Whether it is also part of a rapid move, so that the rapid override applies, too.
    pub(crate) is_partly_rapid: bool,
    /// The squared speed at which it may be entered so that all that is queued can be executed within the limits.
    pub(crate) entry_speed_sq: f64,
    /// `entry_speed_sq` of the next element on which that value relies.
    pub(crate) assumed_next_entry_sq: f64,
    /// The same for entering it from its end, in reverse.
    pub(crate) reverse_entry_speed_sq: f64,
    /// The highest squared speed at its start in either direction: 0 where the motion stops there.
    pub(crate) junction_limit_sq: f64,
    /// Where a segment begins in it.
    pub(crate) segment_start: Option<f64>,
    /// Whether a break of the tangent at its end uses a share of the axes' acceleration.
    pub(crate) has_tangent_break: bool,
    /// Whether the motion ends where the probe changes.
    pub(crate) probing: bool,
    pub(crate) smoothing: Smoothing,
    /// Whether the smoothed motion rests at its start, too.
    pub(crate) starts_at_rest: bool,
    /// The segment that begins in it or was under way: the caller's number and the planner's.
    pub(crate) number: u64,
    pub(crate) index: u64,
}

impl PathElement {
    /// Resets it to an element of no length at a position.
    pub(crate) fn begin_at(&mut self, start: &Axes) {
        self.origin = *start;
        self.curvature = Axes::default();
        self.circle = None;
        (self.end_speed_ratio, self.junction_limit_sq) = (1.0, f64::INFINITY);
        (self.entry_speed_sq, self.assumed_next_entry_sq, self.reverse_entry_speed_sq) =
            (0.0, 0.0, 0.0);
        (self.segment_start, self.is_partly_rapid, self.has_tangent_break) = (None, false, false);
        self.starts_at_rest = false;
    }

    /// p, p' and p'' at x, of N leading axes.
    #[inline]
    pub(crate) fn derivatives<const N: usize>(&self, x: f64) -> [[f64; N]; 3] {
        let [mut position, mut first, mut second] = [[0.0; N]; 3];
        let half = 0.5 * x;
        let places = position.iter_mut().zip(&mut first).zip(&mut second);
        let terms = self.origin.iter().zip(&self.tangent).zip(&self.curvature);
        for (((place, first), second), ((origin, rate), bend)) in places.zip(terms) {
            *place = origin + x * (rate + half * bend);
            *first = rate + x * bend;
            *second = *bend;
        }
        if let Some(circle) = &self.circle {
            let turned = circle.derivatives(x);
            for (sum, turned) in [&mut position, &mut first, &mut second].into_iter().zip(&turned) {
                for (sum, turned) in sum.iter_mut().zip(turned) {
                    *sum += turned;
                }
            }
        }
        [position, first, second]
    }

    /// p' and p'' at x, of N leading axes.
    #[inline]
    pub(crate) fn tangent_and_curvature<const N: usize>(&self, x: f64) -> ([f64; N], [f64; N]) {
        let [_, first, second] = self.derivatives(x);
        (first, second)
    }

    /// p'(x).
    pub(crate) fn tangent_at(&self, x: f64) -> Axes {
        let mut tangent = Axes::default();
        if self.axis_count <= 3 {
            let [_, first, _] = self.derivatives::<3>(x);
            lead(&mut tangent, &first);
        } else {
            [_, tangent, _] = self.derivatives(x);
        }
        tangent
    }

    /// A copy of the part between two parameters, without the start of a segment.
    pub(crate) fn part(&self, from: f64, to: f64) -> Self {
        let mut part = *self;
        part.cut(from, to);
        part
    }

    /// Keeps the part between two parameters, without the start of a segment.
    pub(crate) fn cut(&mut self, from: f64, to: f64) {
        self.junction_limit_sq = f64::INFINITY;
        self.segment_start = None;
        if self.axis_count <= 3 {
            self.cut_axes::<3>(from, to);
        } else {
            self.cut_axes::<9>(from, to);
        }
        if let Some(circle) = &mut self.circle {
            circle.begin_at(from);
        }
    }

    /// Does so for the part that does not rotate, and for the end.
    #[inline]
    fn cut_axes<const N: usize>(&mut self, from: f64, to: f64) {
        if to < self.length {
            let [end, _, _] = self.derivatives::<N>(to);
            lead(&mut self.end, &end);
            self.end_speed_ratio = 1.0;
        }
        self.length = to - from;
        let motion = self.origin.iter_mut().zip(&mut self.tangent).zip(&self.curvature).take(N);
        for ((origin, rate), bend) in motion {
            *origin += from * (*rate + 0.5 * from * bend);
            *rate += from * bend;
        }
    }
}
