//! The limits of all nine axes, and what they leave of a motion along a curve.

use gaugeblock_vocabulary::Axis;
use gaugeblock_vocabulary::motion::MotionLimits;

use super::vector::AxisVector;

/// Velocity, acceleration and jerk that each axis can have; infinite where nothing is stated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Envelope {
    pub(super) velocity: AxisVector,
    pub(super) acceleration: AxisVector,
    pub(super) jerk: AxisVector,
}

impl Envelope {
    pub(super) fn of(limits: &MotionLimits) -> Self {
        let none = [f64::INFINITY; 9];
        let mut envelope = Self { velocity: none, acceleration: none, jerk: none };
        for (axis, limit) in &limits.axes {
            let place = axis.place();
            envelope.velocity[place] = limit.velocity.unwrap_or(f64::INFINITY);
            envelope.acceleration[place] = limit.acceleration.unwrap_or(f64::INFINITY);
            envelope.jerk[place] = limit.jerk.unwrap_or(f64::INFINITY);
        }
        envelope
    }

    /// Whether some axis has a limit of its jerk.
    pub(super) fn limits_jerk(&self) -> bool {
        self.jerk.iter().any(|limit| limit.is_finite())
    }

    /// The first axis that moves and of which velocity or acceleration is not stated.
    pub(super) fn unstated(&self, moves: impl Fn(usize) -> bool) -> Option<Axis> {
        Axis::ALL.iter().copied().find(|axis| {
            let place = axis.place();
            let stated = self.velocity[place].is_finite() && self.acceleration[place].is_finite();
            moves(place) && !stated
        })
    }

    /// The lowest and highest second derivative of the parameter that the accelerations allow at a point with these
    /// derivatives, at the square `speed` of the parameter's first derivative. The first may be above the second: then
    /// there is none.
    pub(super) fn rates(&self, first: &AxisVector, second: &AxisVector, speed: f64) -> (f64, f64) {
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        for axis in 0..9 {
            let (slope, bend) = (first[axis], second[axis] * speed);
            if slope == 0.0 {
                continue;
            }
            let (one, other) = (
                (-self.acceleration[axis] - bend) / slope,
                (self.acceleration[axis] - bend) / slope,
            );
            low = low.max(one.min(other));
            high = high.min(one.max(other));
        }
        (low, high)
    }

    /// The lowest acceleration of all axes that have one.
    pub(super) fn least(&self) -> f64 {
        self.acceleration.iter().copied().fold(f64::INFINITY, f64::min)
    }
}
