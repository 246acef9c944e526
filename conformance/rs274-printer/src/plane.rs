//! Positions in a plane.

use gaugeblock_vocabulary::{Plane, Position};

/// A position in the plane's axes and along its normal.
pub(super) fn in_plane(plane: Plane, at: &Position) -> ([f64; 2], f64) {
    match plane {
        Plane::Xy => ([at.x, at.y], at.z),
        Plane::Zx => ([at.z, at.x], at.y),
        Plane::Yz => ([at.y, at.z], at.x),
        Plane::Uv => ([at.u, at.v], at.w),
        Plane::Wu => ([at.w, at.u], at.v),
        Plane::Vw => ([at.v, at.w], at.u),
    }
}
