//! What limits of jerk add to the distance and the time in which a motion stops or slows down.
//!
//! Without limits of jerk that is what braking takes with all of the acceleration. With them no closed form is known on
//! a path with corners and arcs, and no document states one. So a law grants what a plain planner needs:
//!
//! * It may use a share of the acceleration, since a planner chooses how it shares jerk between turning and braking. On
//!   a short way jerk prevents more than √(j·v) anyhow, and a share of that is granted there.
//! * The speed may rise before it falls, since an acceleration takes time to end. A motion that averages positions over
//!   the time 2·a/j has accelerated by up to a²/j before that is seen, and by no more than 2·a·√(v/j) while it is at v.
//! * The acceleration may change its sign, and reach its limit, in the time of 4·a/j.

use crate::math::square_root;
use crate::motion::envelope::Envelope;
use crate::motion::vector::length;

/// The least share of the acceleration that a planner uses on a long way, and of √(j·v) on a short one.
const ACCELERATION_SHARE: f64 = 1.0 / 16.0;
const JERK_SHARE: f64 = 0.25;
/// How many times a/j an acceleration takes to change.
const CHANGES: f64 = 4.0;

/// What limits of jerk add.
#[derive(Clone, Copy, Debug)]
pub(super) struct Easing {
    /// A speed that is at least the one seen.
    pub(super) speed: f64,
    /// Seconds that pass in addition to braking.
    pub(super) seconds: f64,
    /// The limits with the share of the acceleration that braking uses at least.
    pub(super) envelope: Envelope,
}

impl Easing {
    /// That of a motion with a speed. `moves` says which axes move at all.
    pub(super) fn of(envelope: &Envelope, speed: f64, moves: impl Fn(usize) -> bool) -> Self {
        let (mut rise, mut seconds, mut share) = (0.0_f64, 0.0_f64, 1.0_f64);
        for axis in (0..9).filter(|axis| moves(*axis)) {
            let (acceleration, jerk) = (envelope.acceleration[axis], envelope.jerk[axis]);
            if !jerk.is_finite() {
                continue;
            }
            let most = acceleration * acceleration / jerk;
            let gained = most.min(2.0 * acceleration * square_root(speed / jerk));
            rise = square_root(rise * rise + gained * gained);
            seconds = seconds.max(CHANGES * acceleration / jerk);
            let short = JERK_SHARE * square_root(jerk * speed) / acceleration;
            share = share.min(ACCELERATION_SHARE.min(short));
        }
        let mut eased = *envelope;
        eased.acceleration = eased.acceleration.map(|limit| limit * share);
        Self { speed: speed + rise, seconds, envelope: eased }
    }
}

/// The least distance on a straight line in which a motion stops from a speed, whatever its acceleration is at first:
/// at rest its acceleration is 0 again, and until then jerk lets it brake less.
pub(super) fn least_distance_on_line(envelope: &Envelope, step: &[f64; 9], speed: f64) -> f64 {
    let long = length(step);
    let (mut acceleration, mut jerk) = (f64::INFINITY, f64::INFINITY);
    for axis in (0..9).filter(|axis| step[*axis] != 0.0) {
        let share = (step[axis] / long).abs();
        acceleration = acceleration.min(envelope.acceleration[axis] / share);
        jerk = jerk.min(envelope.jerk[axis] / share);
    }
    if !jerk.is_finite() || !acceleration.is_finite() {
        return 0.0;
    }
    // The last part, in which braking ends, begins with the speed a²/(2·j).
    if 2.0 * jerk * speed >= acceleration * acceleration {
        let cube = acceleration * acceleration * acceleration;
        speed * speed / (2.0 * acceleration) + cube / (24.0 * jerk * jerk)
    } else {
        speed * square_root(2.0 * speed / jerk) / 3.0
    }
}

#[cfg(test)]
mod tests {
    use gaugeblock_vocabulary::Axis;
    use gaugeblock_vocabulary::motion::MotionLimits;
    use gaugeblock_vocabulary::scenario::AxisLimits;

    use super::*;

    fn envelope(jerk: f64) -> Envelope {
        let limit = AxisLimits {
            velocity: Some(250.0),
            acceleration: Some(2000.0),
            jerk: Some(jerk),
            ..AxisLimits::default()
        };
        let axes = [Axis::X, Axis::Y].map(|axis| (axis, limit)).into();
        Envelope::of(&MotionLimits { period: 0.001, axes })
    }

    #[test]
    fn least_distance_is_that_of_braking_that_ends_smoothly() {
        let along = |x: f64, y: f64| [x, y, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        // From 20 mm/s braking at 2000 mm/s² ends with 1e5 mm/s³ within 20 ms: 20 mm/s · 20 ms / 3.
        let found = least_distance_on_line(&envelope(1e5), &along(1.0, 0.0), 20.0);
        assert!((found - 0.4 / 3.0).abs() < 1e-12, "{found}");
        // From 100 mm/s: 40 ms at 2000 mm/s² down to 20 mm/s, 2.4 mm, and the same.
        let found = least_distance_on_line(&envelope(1e5), &along(1.0, 0.0), 100.0);
        assert!((found - 2.4 - 0.4 / 3.0).abs() < 1e-12, "{found}");
        // Along a diagonal both axes share.
        let scale = std::f64::consts::SQRT_2;
        let other = least_distance_on_line(&envelope(1e5), &along(1.0, 1.0), 100.0 * scale);
        assert!((other - scale * found).abs() < 1e-12, "{other}");
    }

    #[test]
    fn easing_vanishes_as_jerk_grows_except_for_the_share() {
        let easing = Easing::of(&envelope(1e15), 100.0, |axis| axis == 0);
        assert!(easing.speed - 100.0 < 1e-4 && easing.seconds < 1e-9, "{easing:?}");
        assert!((easing.envelope.acceleration[0] - 125.0).abs() < 1e-9, "{easing:?}");
    }
}
