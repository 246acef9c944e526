//! A corner of an exact path that is passed without a stop.

use crate::limits::{Limits, least, squared};
use crate::math;
use crate::nominal_segment::NominalSegment;
use crate::parameters::Axes;
use crate::path_element::{AccelerationModel, PathElement};

/// How many times the speed of a tangent break is bisected.
const SPEED_BISECTIONS: u32 = 12;
/// The share of an arc's acceleration that a tangent break next to it may use. The whole arc is slower for it.
const ARC_BREAK_USE_RATIO: f64 = 0.075;

/// A corner of an exact path that is passed without a stop.
///
/// On an exact path every commanded point is on the path, and one point is commanded per cycle. Between two points the
/// velocity may jump at a corner if it could have changed by as much in that time. The acceleration seen in samples is
/// a mean over two cycles in which the middle counts most (a triangle of height 1/h), so a jump J counts at most as
/// J/h.
///
/// Let each jump be spread evenly over a time T about its corner, where these times do not overlap: T is at most a
/// cycle h, and at most the time to the next corner. Then the spread jump counts as much as the jump itself, except
/// for the one that contains the middle: J/h against J/h·(1 - T/4h). If J ≤ c·T, this is c/4·T/h too little, and
/// leaving another c/3 within T makes up for it, since T·(1 - T/4h)/3 ≥ T/4. So an axis with limit a keeps it if along
/// the path it is given a - 4c/3 within T. With c ≤ a/2 the chord misses a corner between two samples by J·h/4 ≤
/// a·h²/8, no more than a motion with constant acceleration does.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct TangentBreak {
    /// The square of the speed at which it may be passed.
    junction_limit_sq: f64,
    /// The length of half of T on each segment, millimetres.
    pub(crate) half_length: f64,
    /// The share of the acceleration that remains there.
    acceleration_ratio: f64,
}

impl TangentBreak {
    pub(crate) fn between(
        before: &NominalSegment,
        after: &NominalSegment,
        change: &Axes,
        limits: &Limits,
    ) -> Self {
        let h = limits.cycle;
        // Per axis c·|direction of the jump|, which bounds the speed times T.
        let jump = 0.5 * least(&limits.planned, change, change.len());
        let rounds = before.whole.circle.is_some() || after.whole.circle.is_some();
        let jump = if rounds { ARC_BREAK_USE_RATIO * jump } else { jump };
        // The most that the speed rises within a cycle: the way to the next corner takes at least length / (speed +
        // rise).
        let (one, other) =
            (max_tangential_acceleration(before), max_tangential_acceleration(after));
        let rise = one.max(other) * h;
        let length = before.whole.length.min(after.whole.length);
        let used = |speed: f64| speed * (1.0 / h).max((speed + rise) / length) / jump;
        // A hold may take two cycles more to stop than with all of the acceleration, so little may be missing.
        let use_max = |speed: f64| {
            let cycles = 2.0 * one.min(other) * h / speed;
            1.5 * cycles / (1.0 + cycles)
        };
        let fits = |speed: f64| used(speed) <= use_max(speed).min(1.0);
        let mut speed = math::sqrt(before.max_speed_sq().min(after.max_speed_sq()));
        if !fits(speed) {
            let mut low = 0.0;
            for _ in 0..SPEED_BISECTIONS {
                let middle = 0.5 * (low + speed);
                if fits(middle) { low = middle } else { speed = middle }
            }
            speed = low;
        }
        let used = if rounds { ARC_BREAK_USE_RATIO * used(speed) } else { used(speed) };
        let near = 0.5 * h * (speed + 0.25 * rise);
        Self {
            junction_limit_sq: squared(speed),
            half_length: near,
            acceleration_ratio: 1.0 - used * 2.0 / 3.0,
        }
    }

    /// The last part of the segment before the corner.
    pub(crate) fn end(&self, segment: &NominalSegment, given: f64) -> PathElement {
        self.reduced(segment.whole.part(segment.whole.length - given, segment.whole.length))
    }

    /// The first part of the segment after the corner.
    pub(crate) fn start(&self, segment: &NominalSegment, given: f64) -> PathElement {
        let element = self.reduced(segment.whole.part(0.0, given));
        PathElement {
            junction_limit_sq: self.junction_limit_sq,
            segment_start: Some(0.0),
            ..element
        }
    }

    fn reduced(&self, mut element: PathElement) -> PathElement {
        element.has_tangent_break = true;
        match &mut element.model {
            AccelerationModel::Constant { acceleration } => {
                *acceleration *= self.acceleration_ratio;
            }
            AccelerationModel::Arc { acceleration, planned } => {
                *acceleration *= self.acceleration_ratio;
                *planned *= self.acceleration_ratio;
                element.start_limit_sq *= self.acceleration_ratio;
                element.end_limit_sq = element.start_limit_sq;
                element.speed_limit = math::sqrt(element.start_limit_sq);
            }
            AccelerationModel::Blend { .. }
            | AccelerationModel::BlendedArc { .. }
            | AccelerationModel::Dwell(_) => {}
        }
        element
    }
}

/// The greatest acceleration along a segment.
fn max_tangential_acceleration(segment: &NominalSegment) -> f64 {
    match segment.whole.model {
        AccelerationModel::Constant { acceleration }
        | AccelerationModel::Arc { acceleration, .. } => acceleration,
        AccelerationModel::Blend { .. }
        | AccelerationModel::BlendedArc { .. }
        | AccelerationModel::Dwell(_) => 0.0,
    }
}
