//! The moves that a cycle makes.

use super::super::vector::Vector;
use super::piece::{Arc, Curve};

/// A move of a cycle.
#[derive(Clone, Copy, Debug)]
pub(super) enum CycleMotion {
    Traverse(Vector),
    Feed(Vector),
    Arc { to: Vector, arc: Arc },
}

impl CycleMotion {
    /// A feed move along a curve.
    pub(super) fn along(curve: Curve, to: Vector) -> Self {
        match curve {
            Curve::Line => Self::Feed(to),
            Curve::Traverse => Self::Traverse(to),
            Curve::Arc(arc) => Self::Arc { to, arc },
        }
    }
}
