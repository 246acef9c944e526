//! What the bound needs to know of a curve.

use crate::motion::curve::{Bounds, Curve};
use crate::motion::vector::AxisVector;

/// A curve over a parameter from 0 to 1, with three derivatives and bounds of the third and fourth.
pub(super) trait Smooth {
    /// First, second and third derivative.
    fn derivatives(&self, part: f64) -> [AxisVector; 3];
    /// Bounds of the third and fourth.
    fn bounds(&self) -> Bounds;
    /// The length of a vector in the coordinates that a feed counts.
    fn counted(&self, vector: &AxisVector) -> f64;
    /// That of the first derivative, where it is the same everywhere.
    fn steady(&self, first: &AxisVector) -> Option<f64>;
    /// Into how many cells it is to be divided if a radian is divided into so many; 1 for a straight line.
    fn cells(&self, per_radian: f64) -> f64;
}

impl Smooth for Curve {
    fn derivatives(&self, part: f64) -> [AxisVector; 3] {
        let (first, second) = Self::derivatives(self, part);
        [first, second, self.third(part)]
    }

    fn bounds(&self) -> Bounds {
        Self::bounds(self)
    }

    fn counted(&self, vector: &AxisVector) -> f64 {
        Self::counted(self).length(vector)
    }

    fn steady(&self, first: &AxisVector) -> Option<f64> {
        self.is_even().then(|| Smooth::counted(self, first))
    }

    fn cells(&self, per_radian: f64) -> f64 {
        (self.angle().abs() * per_radian).ceil().max(1.0)
    }
}
