//! The directions of a cycle: in which direction it travels, and in which one the tool cuts into the work.

use super::super::vector::Vector;
use super::piece::Piece;

/// How the plane of a cycle lies in the ZX plane. Points of the program are (Z, X), points of the cycle are (travel,
/// depth): the first coordinate grows in the direction of travel, the second one out of the work.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// Whether the tool travels along X: G72.
    pub(super) faces: bool,
    /// 1 where travel is towards greater coordinates, or else -1.
    pub(super) along: f64,
    /// 1 where depth is counted as the program does, -1 for inside turning.
    pub(super) outward: f64,
}

impl Frame {
    /// The axes of G71 or G72, in the directions of the program.
    pub(super) fn unturned(faces: bool) -> Self {
        Self { faces, along: 1.0, outward: 1.0 }
    }

    /// A point of the program in the cycle.
    pub(super) fn of(&self, point: Vector) -> Vector {
        let Vector { p: z, q: x } = point;
        let (travel, depth) = if self.faces { (x, z) } else { (z, x) };
        Vector { p: travel * self.along, q: depth * self.outward }
    }

    /// A point of the cycle in the program.
    pub(super) fn back(&self, point: Vector) -> Vector {
        // No zero is negative.
        let (travel, depth) = (point.p * self.along + 0.0, point.q * self.outward + 0.0);
        if self.faces { Vector { p: depth, q: travel } } else { Vector { p: travel, q: depth } }
    }

    /// -1 where the plane is turned over, so that arcs change their sense.
    pub(super) fn flip(&self) -> f64 {
        let swapped = if self.faces { -1.0 } else { 1.0 };
        swapped * self.along * self.outward
    }

    /// A piece of the program in the cycle.
    pub(super) fn piece(&self, piece: &Piece) -> Piece {
        piece.mapped(|point| self.of(point), self.flip())
    }
}
