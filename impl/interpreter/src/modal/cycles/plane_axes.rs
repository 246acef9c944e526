//! The axes of a plane as a canned cycle uses them.

use gaugeblock_vocabulary::{Axis, Plane};

use super::super::letters::{U, V, W, X, Y, Z};

/// First, second and normal axis of a plane: the hole is where the first two say, and the tool goes along the third.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlaneAxes {
    pub(super) first: Axis,
    pub(super) second: Axis,
    pub(super) normal: Axis,
}

impl PlaneAxes {
    pub(super) const fn of(plane: Plane) -> Self {
        let [first, second, normal] = match plane {
            Plane::Xy => [Axis::X, Axis::Y, Axis::Z],
            Plane::Zx => [Axis::Z, Axis::X, Axis::Y],
            Plane::Yz => [Axis::Y, Axis::Z, Axis::X],
            Plane::Uv => [Axis::U, Axis::V, Axis::W],
            Plane::Wu => [Axis::W, Axis::U, Axis::V],
            Plane::Vw => [Axis::V, Axis::W, Axis::U],
        };
        Self { first, second, normal }
    }

    /// The letters of axis words that a cycle takes in a plane (11.5.43).
    pub(super) const fn letters(plane: Plane) -> u32 {
        match plane {
            Plane::Xy | Plane::Zx | Plane::Yz => X | Y | Z,
            Plane::Uv | Plane::Wu | Plane::Vw => U | V | W,
        }
    }
}
