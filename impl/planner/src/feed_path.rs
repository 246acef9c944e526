//! The axes along which a feed is measured: X Y Z where those move, else U V W, else A B C in degrees.

use crate::limits::squared;
use crate::math;
use crate::parameters::Axes;
use crate::path_element::PathElement;
use crate::vector::dot;

/// The axes whose path a feed is measured along.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum FeedPath {
    /// X Y Z, millimetres.
    #[default]
    Linear,
    /// U V W, millimetres.
    Secondary,
    /// A B C, degrees.
    Rotary,
}

impl FeedPath {
    /// The length of the part of a vector along these axes.
    pub(crate) fn part_of(self, vector: &Axes) -> f64 {
        let [x, y, z, a, b, c, u, v, w] = *vector;
        let [one, other, third] = match self {
            Self::Linear => [x, y, z],
            Self::Secondary => [u, v, w],
            Self::Rotary => [a, b, c],
        };
        math::sqrt(squared(one) + squared(other) + squared(third))
    }
}

/// The axes along which the feed of an element is measured, and the least and the greatest ratio of that path to the
/// parameter.
#[inline]
pub(crate) fn feed_path_ratios(whole: &PathElement) -> (FeedPath, (f64, f64)) {
    let [x, y, z, a, b, c, u, v, w] = whole.tangent;
    let even = squared(x) + squared(y) + squared(z);
    let linear = match &whole.circle {
        None => (even, even),
        Some(circle) => {
            let radius = dot(&circle.cosine, &circle.cosine);
            let turning = |grown: f64| squared(circle.angle_rate * grown) + squared(circle.growth);
            let (start, end) = (turning(1.0), turning(circle.radius_ratio(whole.length)));
            (even + radius * start.min(end), even + radius * start.max(end))
        }
    };
    if linear.1 > 0.0 {
        return (FeedPath::Linear, (math::sqrt(linear.0), math::sqrt(linear.1)));
    }
    let second = squared(u) + squared(v) + squared(w);
    let rotary = squared(a) + squared(b) + squared(c);
    let (path, square) = if second > 0.0 {
        (FeedPath::Secondary, second)
    } else if rotary > 0.0 {
        (FeedPath::Rotary, rotary)
    } else {
        (FeedPath::Linear, 1.0)
    };
    (path, (math::sqrt(square), math::sqrt(square)))
}
