//! What a compensated path depends on, and must not change along it.

use gaugeblock_vocabulary::{Compensation, LengthUnit, Plane, Position};

use crate::rs274::modes::{Modes, converted};
use crate::rs274::order::Phase;
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

/// The plane, the side and the offsets along a compensated path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surroundings {
    plane: Plane,
    compensation: Compensation,
    radius: f64,
    units: LengthUnit,
    rotation: f64,
    offsets: [Position; 3],
}

/// The offsets between a point of the program and one of the machine, active length unit.
fn offsets(modes: &Modes) -> [Position; 3] {
    [modes.g5x_offset, modes.g92_offset, modes.tool_offset]
}

impl Surroundings {
    /// Those of the path that is under way.
    pub(crate) fn of(state: &State) -> Option<Self> {
        let modes = &state.modes;
        state.contour.path.is_some().then(|| Self {
            plane: modes.plane,
            compensation: modes.compensation,
            radius: modes.compensation_radius,
            units: modes.units,
            rotation: modes.rotation,
            offsets: offsets(modes),
        })
    }

    /// Whether the tool is still on the same side.
    pub(super) fn is_same_side(&self, state: &State) -> bool {
        let left =
            |compensation| matches!(compensation, Compensation::Left | Compensation::DynamicLeft);
        let is_left = |compensation, radius: f64| left(compensation) == (radius > 0.0);
        let modes = &state.modes;
        is_left(self.compensation, self.radius)
            == is_left(modes.compensation, modes.compensation_radius)
    }

    /// Where a choice allows another plane or other offsets along the path, nothing says where it goes on.
    ///
    /// # Errors
    /// They are not as they were.
    pub(crate) fn check(&self, state: &State) -> Result<(), StepError> {
        let modes = &state.modes;
        let before = self.offsets.map(|offset| converted(offset, self.units, modes.units));
        let same = self.plane == modes.plane
            && self.rotation.to_bits() == modes.rotation.to_bits()
            && before == offsets(modes);
        if same {
            return Ok(());
        }
        let why = "another plane or another offset along a compensated path";
        Err(StepError::Unspecified(why.to_owned()))
    }

    /// A phase of a block is over.
    ///
    /// # Errors
    /// It has changed what the path depends on, or the tool, or was a user-defined code: all that is open.
    pub(crate) fn after(&self, phase: Phase, state: &State) -> Result<(), StepError> {
        if state.contour.path.is_none() {
            return Ok(());
        }
        if matches!(phase, Phase::ChangeTool | Phase::UserCode) {
            let why = "another tool, or a user-defined code, along a compensated path";
            return Err(StepError::Unspecified(why.to_owned()));
        }
        self.check(state)
    }
}
