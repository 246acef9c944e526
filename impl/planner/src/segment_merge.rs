//! Short lines that are merged: several segments that would be over within one servo cycle become one, within their
//! tolerance, or where they are collinear.

use crate::limits::{Limits, squared};
use crate::math;
use crate::nominal_segment::{NominalSegment, set_line};
use crate::path_element::FeedBasis;
use crate::segment::PathControl;

/// The share of a tolerance that merged segments may use. Blends use the rest.
const MERGE_DEVIATION_RATIO_MAX: f64 = 0.25;
/// How far lines may deviate from the one that they are merged into, millimetres, where the path is exact or has no
/// tolerance: what rounding makes of collinear lines.
const COLLINEAR_DEVIATION_MAX_MM: f64 = 1e-12;
/// At least so many segments of equal length are merged, since segments of unequal length are slower round a curve.
const MERGED_SEGMENTS_MIN: f64 = 4.0;
/// How much longer a merged segment may be after another merged one. Lines whose lengths differ by rounding are then
/// merged in equal numbers.
const MERGED_LENGTH_SLACK_RATIO: f64 = 1.02;
/// The greatest change of direction, radians, between segments that are merged.
const MERGE_ANGLE_MAX_RAD: f64 = 0.2;

impl NominalSegment {
    /// Whether the next segment may be merged into this one: both are similar lines, nearly in one direction, and over
    /// within a cycle. `after_merged` says whether the segment before is merged.
    #[inline]
    pub(crate) fn can_merge_with(&self, next: &Self, after_merged: bool, limits: &Limits) -> bool {
        let (one, other) = (&self.whole, &next.whole);
        let length = (one.length + other.length).max(other.length * MERGED_SEGMENTS_MIN);
        // The limits of the axes along this line do not count: where they change with the direction of a curve, so
        // would the lengths of its segments.
        let fastest = match one.feed_basis {
            FeedBasis::PerSecond => math::min(limits.fastest, 2.0 * one.feed),
            FeedBasis::Rapid | FeedBasis::PerTurn => limits.fastest,
        };
        let slack = if after_merged || self.is_merged { MERGED_LENGTH_SLACK_RATIO } else { 1.0 };
        if length > slack * fastest * limits.cycle {
            return false;
        }
        let lines = one.circle.is_none()
            && other.circle.is_none()
            && one.axis_count.max(other.axis_count) <= 3;
        let alike = lines && self.has_same_feed(next) && self.path_control == next.path_control;
        let mut bends = 0.0;
        for (last, first) in self.end_tangent.iter().zip(&next.start_tangent) {
            bends += squared(first - last);
        }
        alike
            && one.feed_basis != FeedBasis::PerTurn
            && !next.is_separate
            && bends <= squared(MERGE_ANGLE_MAX_RAD)
            && (matches!(self.path_control, PathControl::Within(_))
                || bends * squared(other.length) <= squared(COLLINEAR_DEVIATION_MAX_MM))
    }

    /// Merges the next segment into this one. Returns whether the tolerance permits it; if not, the content is
    /// undefined.
    pub(crate) fn merge(&mut self, next: &Self, limits: &Limits) -> bool {
        let allowed = match self.path_control {
            PathControl::Within(tolerance) => MERGE_DEVIATION_RATIO_MAX * tolerance,
            PathControl::ExactPath | PathControl::BetweenMidpoints => COLLINEAR_DEVIATION_MAX_MM,
            PathControl::ExactStop => return false,
        };
        let whole = &mut self.whole;
        let length = whole.length;
        if set_line(whole, &next.whole.end).is_err() {
            return false;
        }
        // The distance of the dropped end point from the line: the part of the old direction that is not along the new
        // one.
        let (mut along, mut across) = (0.0, 0.0);
        for (new, old) in whole.tangent.iter().zip(&self.end_tangent) {
            along += new * old;
        }
        for (new, old) in whole.tangent.iter().zip(&self.end_tangent) {
            across += squared(old - along * new);
        }
        self.merge_deviation =
            math::max(self.merge_deviation, next.merge_deviation) + length * math::sqrt(across);
        if self.merge_deviation > allowed {
            return false;
        }
        (whole.number, whole.index) = (next.whole.number, next.whole.index);
        limits.assign_line_model(whole);
        (self.start_tangent, self.end_tangent) = (whole.tangent, whole.tangent);
        self.end_length = next.whole.length;
        self.is_merged = true;
        true
    }
}
