//! Pieces of the commanded path, by a parameter that runs like the distance.
//!
//! A piece is p(x) = origin + rate·x + bend·x²/2, and on arcs a circle about it. Its parameter x runs from 0 to `length`, and
//! |p'| is 1 at its start: so the speed of x is the path's speed wherever pieces meet. Lines have no bend, blends of two
//! lines are bends alone, and a blend with an arc is that arc with a bend added, which takes the break out of its direction.

use super::parameters::Axes;
use crate::math;

/// The part of a position that turns: (cosine·cos(turn·x) + sine·sin(turn·x))·(1 + growth·x) on X, Y and Z.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Circle {
    /// From the centre to where the piece begins.
    pub(super) cosine: [f64; 3],
    /// A quarter turn further.
    pub(super) sine: [f64; 3],
    /// Radians per unit of the parameter; never negative, since `sine` has the sense of the turn.
    pub(super) turn: f64,
    /// How much the radius grows per unit of the parameter, over what it is where the piece begins: an end point that is rounded is
    /// never quite on the circle of its start, and the distance from the axis changes evenly between them.
    pub(super) growth: f64,
}

impl Circle {
    /// The radius after so much, over that at the start.
    pub(super) fn grown(&self, x: f64) -> f64 {
        1.0 + self.growth * x
    }

    /// Lets it begin further on.
    fn begin_at(&mut self, from: f64) {
        let (sine, cosine) = math::turned(self.turn * from);
        let grown = self.grown(from);
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
pub(super) enum Law {
    /// The parameter may be accelerated by so much anywhere.
    Even {
        /// Per second squared.
        acceleration: f64,
    },
    /// Limits are looked at axis by axis: exact for a piece that is a bend and nothing else.
    Bent {
        /// The square of the speed at which it may be passed evenly.
        even: f64,
    },
    /// On an arc acceleration along the path and towards the centre share a limit: u² + (turn·v²)² ≤ acceleration².
    Round {
        /// Per second squared, of whichever axis has least.
        acceleration: f64,
        /// What is planned with: less by what a speed that changes in steps of a cycle loses.
        planned: f64,
    },
    /// On an arc that is bent acceleration along the path and across it share what the axes can do: |u| + less·v² ≤ most, planned with. Both are
    /// less than what the axes can do by what a speed that changes in steps of a cycle loses: less·v times the cycle at the highest speed.
    Shared {
        /// Per second squared, at rest.
        most: f64,
        /// Per unit of the parameter.
        less: f64,
    },
    /// No motion for so many seconds.
    Dwell(f64),
}

impl Default for Law {
    fn default() -> Self {
        Self::Dwell(0.0)
    }
}

/// What a feed is measured by, and so which override applies to it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Pace {
    #[default]
    Rapid,
    Second,
    Turn,
}

/// A part of the path with one law.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Piece {
    pub(super) origin: Axes,
    pub(super) rate: Axes,
    pub(super) bend: Axes,
    pub(super) circle: Option<Circle>,
    /// p(length), as programmed where it was.
    pub(super) end: Axes,
    pub(super) length: f64,
    /// |p'| at the end: how much faster than its parameter the next one's runs.
    pub(super) exit: f64,
    /// How many of the leading axes take part.
    pub(super) axes: usize,
    pub(super) law: Law,
    /// Highest square of the parameter's speed that the axes allow, where the piece begins.
    pub(super) ceiling: f64,
    /// The same where it ends; between these it changes evenly.
    pub(super) last_ceiling: f64,
    /// The root of the higher one.
    pub(super) fastest: f64,
    /// Programmed speed of the parameter, per second or per turn.
    pub(super) feed: f64,
    pub(super) pace: Pace,
    /// Whether it is also part of a rapid move, so that the rapid override applies too.
    pub(super) rapid: bool,
    /// The square of the speed at which this piece may be entered so that all that is queued can be kept to.
    pub(super) reach: f64,
    /// The same for entering it from its end, running back.
    pub(super) back: f64,
    /// The square of the speed at which it may be entered at most, from either side: 0 where the motion rests there.
    pub(super) entry: f64,
    /// Where in it a segment begins.
    pub(super) begins: Option<f64>,
    /// Whether it ends where the probe changes.
    pub(super) probing: bool,
    /// Which segment that is, or which was under way: the caller's number and the planner's.
    pub(super) number: u64,
    pub(super) index: u64,
}

impl Piece {
    /// p, p' and p'' at x, of the axes that take part.
    pub(super) fn motion(&self, x: f64, position: &mut Axes, first: &mut Axes, second: &mut Axes) {
        if self.axes <= 3 {
            self.motion_of::<3>(x, position, first, second);
        } else {
            self.motion_of::<9>(x, position, first, second);
        }
        if let Some(circle) = &self.circle {
            let (sine, cosine) = math::turned(circle.turn * x);
            let grown = circle.grown(x);
            let square = circle.turn * circle.turn * grown;
            let vectors = circle.cosine.iter().zip(&circle.sine);
            let places = position.iter_mut().zip(first).zip(second);
            for (((place, first), second), (start, quarter)) in places.zip(vectors) {
                let along = start * cosine + quarter * sine;
                let across = circle.turn * (quarter * cosine - start * sine);
                *place += grown * along;
                *first += grown * across + circle.growth * along;
                *second += 2.0 * circle.growth * across - square * along;
            }
        }
    }

    /// The part of it that does not turn.
    #[inline]
    fn motion_of<const N: usize>(
        &self,
        x: f64,
        position: &mut Axes,
        first: &mut Axes,
        second: &mut Axes,
    ) {
        let half = 0.5 * x;
        let terms = self.origin.iter().zip(&self.rate).zip(&self.bend).take(N);
        let places = position.iter_mut().zip(first.iter_mut()).zip(second.iter_mut());
        for (((place, first), second), ((origin, rate), bend)) in places.zip(terms) {
            *place = origin + x * (rate + half * bend);
            *first = rate + x * bend;
            *second = *bend;
        }
    }

    /// p(x).
    pub(super) fn position(&self, x: f64) -> Axes {
        let (mut position, mut first, mut second) = (self.end, Axes::default(), Axes::default());
        self.motion(x, &mut position, &mut first, &mut second);
        position
    }

    /// p'(x).
    pub(super) fn tangent(&self, x: f64) -> Axes {
        let (mut position, mut first, mut second) = (self.end, Axes::default(), Axes::default());
        self.motion(x, &mut position, &mut first, &mut second);
        first
    }

    /// The part of it from one place to another, as if nothing began there.
    pub(super) fn part(&self, from: f64, to: f64) -> Self {
        let mut part = *self;
        part.cut(from, to);
        part
    }

    /// Leaves of it the part from one place to another, as if nothing began there.
    pub(super) fn cut(&mut self, from: f64, to: f64) {
        self.entry = f64::INFINITY;
        self.begins = None;
        if to < self.length {
            self.end = self.position(to);
            self.exit = 1.0;
        }
        self.length = to - from;
        if self.axes <= 3 {
            self.begin_at::<3>(from);
        } else {
            self.begin_at::<9>(from);
        }
        if let Some(circle) = &mut self.circle {
            circle.begin_at(from);
        }
    }

    /// Lets the part of it that does not turn begin further on.
    #[inline]
    fn begin_at<const N: usize>(&mut self, from: f64) {
        let motion = self.origin.iter_mut().zip(&mut self.rate).zip(&self.bend).take(N);
        for ((origin, rate), bend) in motion {
            *origin += from * (*rate + 0.5 * from * bend);
            *rate += from * bend;
        }
    }
}
