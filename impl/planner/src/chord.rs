//! Chords: which segments may be one of a row, and whether rounding turns their corners.

use crate::limits::{Limits, squared};
use crate::math;
use crate::parameters::Axes;
use crate::segment::{Feed, Path, PathControl, Segment};
use crate::vector::dot;

/// A shorter segment moves nothing.
const CHORD_LENGTH_MIN_MM: f64 = 1e-10;
/// A chord lasts for at most so many cycles at twice its feed.
const CHORD_CYCLES_MAX: f64 = 4.0;
/// The share of a tolerance by which a line may leave its chords.
pub(crate) const LINE_DEVIATION_RATIO_MAX: f64 = 0.75;

pub(crate) type Place = [f64; 3];

/// What is known of the last corners between chords.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ChordCorners {
    /// The direction and the length of the last chord, and its change of direction.
    seen: Option<(Place, f64)>,
    seen_change: Option<Place>,
}

impl ChordCorners {
    /// Whether rounding turns the last two corners more than the curve does, so that they are slower than the feed.
    pub(crate) fn is_rough(
        &mut self,
        segment: &Segment,
        (start, length): (&Axes, f64),
        limits: &Limits,
    ) -> bool {
        let Path::Straight { end } = &segment.path else { return false };
        let (mut direction, start) = (leading(end), leading(start));
        for (rate, start) in direction.iter_mut().zip(&start) {
            *rate = (*rate - start) / length;
        }
        let seen = self.seen.replace((direction, length));
        let Some((before, other)) = seen else { return false };
        let mut change = direction;
        for (value, before) in change.iter_mut().zip(&before) {
            *value -= before;
        }
        let Some(old) = self.seen_change.replace(change) else { return false };
        let turn_sq = math::max(dot(&change, &change), dot(&old, &old));
        let used = math::min(length, other) * limits.softest;
        let PathControl::Within(tolerance) = segment.path_control else { return false };
        let least = 4.0 * LINE_DEVIATION_RATIO_MAX * tolerance;
        turn_sq * squared(math::min(length, other)) < squared(least)
            && distance_sq(&change, &old) > turn_sq
            && squared(used) < squared(squared(feed_of(segment))) * turn_sq
    }

    /// Another segment than a chord ends what is known of corners.
    pub(crate) fn forget_corners(&mut self) {
        (self.seen, self.seen_change) = (None, None);
    }
}

/// The length of a segment that may be one of a row of chords.
pub(crate) fn chord_length(segment: &Segment, start: &Axes, limits: &Limits) -> Option<f64> {
    let (Path::Straight { end }, Feed::PerSecond(feed)) = (&segment.path, segment.feed) else {
        return None;
    };
    let PathControl::Within(tolerance) = segment.path_control else { return None };
    let [x, y, z, start_rest @ ..] = start;
    let [u, v, w, rest @ ..] = end;
    if segment.probing
        || rest.iter().zip(start_rest).any(|(end, start)| end.to_bits() != start.to_bits())
        || tolerance.is_nan()
        || tolerance <= 0.0
        || feed.is_nan()
        || feed <= 0.0
    {
        return None;
    }
    let length = math::sqrt(squared(u - x) + squared(v - y) + squared(w - z));
    let fastest = math::min(limits.fastest, 2.0 * feed);
    (length < CHORD_CYCLES_MAX * limits.cycle * fastest).then_some(length)
}

/// Whether a segment of this length moves nothing.
pub(crate) fn is_no_motion(length: f64) -> bool {
    length <= CHORD_LENGTH_MIN_MM
}

/// The feed per second of a chord.
pub(crate) fn feed_of(segment: &Segment) -> f64 {
    match segment.feed {
        Feed::PerSecond(feed) => feed,
        Feed::Rapid | Feed::InTime(_) | Feed::PerTurn(_) => 0.0,
    }
}

/// X, Y and Z.
pub(crate) fn leading(axes: &Axes) -> Place {
    let [x, y, z, ..] = *axes;
    [x, y, z]
}

/// The square of the distance of two places.
pub(crate) fn distance_sq(one: &Place, other: &Place) -> f64 {
    let mut apart = *one;
    for (value, other) in apart.iter_mut().zip(other) {
        *value -= other;
    }
    dot(&apart, &apart)
}
