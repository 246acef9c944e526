//! Hard braking on an arc. The arc model has one limit for all directions; in most directions the axes allow more.

use crate::blend_motion::signed;
use crate::limits::{Limits, squared};
use crate::math;
use crate::motion::{AXIS_SHARE_MIN, CYCLE_WORK_MAX, MotionState};
use crate::path_element::{Averaged, PathElement};

/// The cost of finding the strongest braking on an arc, in units of [`MotionState::work`].
const ARC_BRAKING_WORK: u32 = 4;

impl MotionState {
    /// The least acceleration that all axes allow on an arc in this cycle; a hold or a lowered override needs all of
    /// it.
    ///
    /// It is computed once in a cycle: where the motion stays on the arc for half of the cycle or up to the arc's end.
    pub(crate) fn strongest_braking(
        &mut self,
        element: &PathElement,
        limits: &Limits,
        time_left: f64,
    ) -> f64 {
        let Some(circle) = &element.circle else { return 0.0 };
        let (remaining, way) = (self.remaining(element), self.speed * time_left);
        let passes = remaining < way && remaining < 0.5 * self.speed * limits.cycle;
        if passes
            || element.has_tangent_break
            // The averaged parameter is where the axes have other shares.
            || element.smoothing.averaged == Averaged::LoneArc
            || self.found_braking
            || self.work > CYCLE_WORK_MAX
            || self.speed <= 0.0
        {
            return 0.0;
        }
        let far = math::min(way, remaining);
        // Between two points of an arc p' and p'' are longer by this factor than on the chord between their values.
        let kept = 1.0 - squared(circle.angle_rate * far) / 8.0;
        if kept < 0.9 {
            return 0.0;
        }
        self.found_braking = true;
        self.work = self.work.saturating_add(ARC_BRAKING_WORK);
        if element.axis_count <= 3 {
            self.strongest_braking_of::<3>(element, far, (limits, kept))
        } else {
            self.strongest_braking_of::<9>(element, far, (limits, kept))
        }
    }

    /// Does the same for N leading axes.
    #[inline(never)]
    fn strongest_braking_of<const N: usize>(
        &self,
        element: &PathElement,
        far: f64,
        (limits, kept): (&Limits, f64),
    ) -> f64 {
        let y = squared(self.speed);
        let (sense, ahead) =
            if self.is_reversed { (-1.0, self.x - far) } else { (1.0, self.x + far) };
        // The bound holds at two squared speeds, and so between them.
        let least = |(first, second): ([f64; N], [f64; N]), y: f64, other: f64| {
            let mut least = [0.0; N];
            let axes = first.iter().zip(&second).zip(&limits.acceleration);
            for (least, ((first, second), limit)) in least.iter_mut().zip(axes) {
                let share = sense * first;
                let used = math::min(signed(second * y, share), signed(second * other, share));
                *least = (-limit * kept - used) / math::max(share.abs(), AXIS_SHARE_MIN);
            }
            least.into_iter().fold(f64::NEG_INFINITY, math::max)
        };
        let now = least(element.tangent_and_curvature(self.x), y, y);
        let later = math::max(0.0, y + 2.0 * now * far);
        math::max(now, least(element.tangent_and_curvature(ahead), y, later))
    }
}
