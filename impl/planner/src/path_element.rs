//! Pieces of the commanded path, by a parameter that runs like the distance.
//!
//! A piece is p(x) = origin + rate·x + bend·x²/2, and on arcs a circle about it. Its parameter x runs from 0 to
//! `length`, and
//! |p'| is 1 at its start: so the speed of x is the path's speed wherever pieces meet. Lines have no bend, blends of two
//! lines are bends alone, and a blend with an arc is that arc with a bend added, which takes the break out of its
//! direction.

use crate::math;
use crate::parameters::{Axes, lead};

/// The part of a position that turns: (cosine·cos(turn·x) + sine·sin(turn·x))·(1 + growth·x) on X, Y and Z.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Circle {
    /// From the centre to where the piece begins.
    pub(crate) cosine: [f64; 3],
    /// A quarter turn further.
    pub(crate) sine: [f64; 3],
    /// Radians per unit of the parameter; never negative, since `sine` has the sense of the turn.
    pub(crate) angle_rate: f64,
    /// How much the radius grows per unit of the parameter, over what it is where the piece begins: an end point that
    /// is rounded is never quite on the circle of its start, and the distance from the axis changes evenly between
    /// them.
    pub(crate) growth: f64,
}

impl Circle {
    /// The radius after so much, over that at the start.
    pub(crate) fn radius_ratio(&self, x: f64) -> f64 {
        1.0 + self.growth * x
    }

    /// Whether what lies so far ahead limits no speed here: whatever the speed there, it is planned to fall within
    /// half of that angle.
    pub(crate) fn is_beyond_influence(&self, distance: f64) -> bool {
        2.0 * self.angle_rate * distance >= core::f64::consts::FRAC_PI_2
    }

    /// What turns of p, p' and p'' at x.
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

    /// Lets it begin further on.
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

/// What keeps speed and acceleration of a piece within the limits of all axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum AccelerationModel {
    /// The parameter may be accelerated by so much anywhere.
    Constant {
        /// Per second squared.
        acceleration: f64,
    },
    /// Limits are looked at axis by axis: exact for a piece that is a bend and nothing else.
    Blend {
        /// The square of the speed at which it may be passed evenly.
        steady_speed_sq: f64,
    },
    /// On an arc acceleration along the path and towards the centre share a limit: u² + (turn·v²)² ≤ acceleration².
    Arc {
        /// Per second squared, of whichever axis has least.
        acceleration: f64,
        /// What is planned with: less by what a speed that changes in steps of a cycle loses.
        planned: f64,
    },
    /// On an arc that is bent acceleration along the path and across it share what the axes can do: |u| + less·v² ≤
    /// most, planned with. Both are less than what the axes can do by what a speed that changes in steps of a cycle
    /// loses: less·v times the cycle at the highest speed.
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

/// What a feed is measured by, and so which override applies to it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum FeedBasis {
    #[default]
    Rapid,
    PerSecond,
    PerTurn,
}

/// The same as |entry + slope·exit| ≤ limit, which is infinite where an axis does not limit the entry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BlendLimits<const N: usize> {
    pub(crate) slopes: [[f64; N]; 2],
    pub(crate) limits: [[f64; N]; 2],
    /// The highest exit that axes allow which do not limit the entry.
    pub(crate) exit_max: f64,
    /// Whether no slope is above 0, so that a lower exit never allows a higher entry.
    pub(crate) slopes_fall: bool,
    /// Up to this exit there is an entry that all axes allow, for certain.
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

/// A part of the path with one law.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PathElement {
    pub(crate) origin: Axes,
    pub(crate) tangent: Axes,
    pub(crate) curvature: Axes,
    pub(crate) circle: Option<Circle>,
    /// p(length), as programmed where it was.
    pub(crate) end: Axes,
    pub(crate) length: f64,
    /// |p'| at the end: how much faster than its parameter the next one's runs.
    pub(crate) end_speed_ratio: f64,
    /// How many of the leading axes take part.
    pub(crate) axis_count: usize,
    pub(crate) model: AccelerationModel,
    /// What the axes allow at both ends of a bend of up to three, run forward.
    pub(crate) blend_limits: BlendLimits<3>,
    /// Highest square of the parameter's speed that the axes allow, where the piece begins.
    pub(crate) start_limit_sq: f64,
    /// The same where it ends; between these it changes evenly.
    pub(crate) end_limit_sq: f64,
    /// The root of the higher one.
    pub(crate) speed_limit: f64,
    /// Programmed speed of the parameter, per second or per turn.
    pub(crate) feed: f64,
    pub(crate) feed_basis: FeedBasis,
    /// Whether it is also part of a rapid move, so that the rapid override applies too.
    pub(crate) is_partly_rapid: bool,
    /// The square of the speed at which this piece may be entered so that all that is queued can be kept to.
    pub(crate) entry_speed_sq: f64,
    /// What the next piece's was when that was found.
    pub(crate) assumed_next_entry_sq: f64,
    /// The same for entering it from its end, running back.
    pub(crate) reverse_entry_speed_sq: f64,
    /// The square of the speed at which it may be entered at most, from either side: 0 where the motion rests there.
    pub(crate) junction_limit_sq: f64,
    /// Where in it a segment begins.
    pub(crate) segment_start: Option<f64>,
    /// Whether a break of direction at its end takes a share of what the axes can do.
    pub(crate) has_tangent_break: bool,
    /// Whether it ends where the probe changes.
    pub(crate) probing: bool,
    /// Which segment that is, or which was under way: the caller's number and the planner's.
    pub(crate) number: u64,
    pub(crate) index: u64,
}

impl PathElement {
    /// Becomes a piece that begins at a position and leads nowhere yet, with nothing of what it was.
    pub(crate) fn begin_at(&mut self, start: &Axes) {
        self.origin = *start;
        self.curvature = Axes::default();
        self.circle = None;
        (self.end_speed_ratio, self.junction_limit_sq) = (1.0, f64::INFINITY);
        (self.entry_speed_sq, self.assumed_next_entry_sq, self.reverse_entry_speed_sq) =
            (0.0, 0.0, 0.0);
        (self.segment_start, self.is_partly_rapid, self.has_tangent_break) = (None, false, false);
    }

    /// p, p' and p'' at x, of so many leading axes.
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

    /// p' and p'' at x, of so many leading axes.
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

    /// The part of it from one place to another, as if nothing began there.
    pub(crate) fn part(&self, from: f64, to: f64) -> Self {
        let mut part = *self;
        part.cut(from, to);
        part
    }

    /// Leaves of it the part from one place to another, as if nothing began there.
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

    /// The same for what does not turn, and the end.
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
