//! The axes of the plane, for arcs and compensated moves.

use gaugeblock_vocabulary::{Axis, FaultKind, Plane, Position};

use crate::ids::rule;
use crate::rs274::planar::InPlane;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// The axes of an arc.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axes {
    pub(crate) first: Axis,
    pub(crate) second: Axis,
    /// The axis at right angles to the plane; a helix moves along it.
    pub(crate) normal: Axis,
}

impl Axes {
    /// The coordinates of a position in the plane.
    pub(crate) fn in_plane(self, position: Position) -> InPlane {
        (position.get(self.first), position.get(self.second))
    }

    /// Both axes of the plane.
    pub(crate) fn of_plane(self) -> [Axis; 2] {
        [self.first, self.second]
    }

    /// A position with other coordinates in the plane.
    pub(crate) fn with(self, mut position: Position, (first, second): InPlane) -> Position {
        *position.get_mut(self.first) = first;
        *position.get_mut(self.second) = second;
        position
    }

    /// A position with the coordinate that another one has along the normal axis.
    pub(crate) fn with_normal_of(self, mut position: Position, other: Position) -> Position {
        *position.get_mut(self.normal) = other.get(self.normal);
        position
    }
}

/// Rule arcs.plane. An arc lies in the selected plane: XY, ZX or YZ.
/// Rule arcs.secondary-planes. The planes of U, V and W have no arcs.
pub(crate) fn axes(state: &mut State) -> Result<Axes, StepError> {
    use Axis::{X, Y, Z};
    let (first, second, normal) = match state.modes.plane {
        Plane::Xy => (X, Y, Z),
        Plane::Zx => (Z, X, Y),
        Plane::Yz => (Y, Z, X),
        Plane::Uv | Plane::Wu | Plane::Vw => {
            let message = "an arc in a plane of U, V or W";
            return Err(refuse(rule::arcs::SECONDARY_PLANES, FaultKind::ModalConflict, message));
        }
    };
    Ok(Axes { first, second, normal })
}
