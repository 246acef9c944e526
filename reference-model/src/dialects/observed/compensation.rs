//! Quirks of cutter compensation.

use gaugeblock_vocabulary::Position;

use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::execute::compensation::CompensationRules;
use crate::rs274::refusal::StepError;
use crate::rs274::state::{Exit, State};

impl CompensationRules for Observed {
    /// Quirk rs274.compensation-entry-equal. An entry that is as long as the radius is too short.
    fn is_entry(&self, length: f64, radius: f64, state: &State) -> bool {
        let equals = length <= radius && Documented.is_entry(length, radius, state);
        !(equals && state.has_quirk(quirk::rs274::COMPENSATION_ENTRY_EQUAL))
            && Documented.is_entry(length, radius, state)
    }

    /// Quirk rs274.compensation-exit-arc. An arc may follow where no move was compensated.
    fn has_exit(&self, along_path: bool, state: &State) -> bool {
        (along_path || !state.has_quirk(quirk::rs274::COMPENSATION_EXIT_ARC))
            && Documented.has_exit(along_path, state)
    }

    /// Quirk rs274.compensation-exit-length. A line of any length leads away.
    fn check_exit_line(
        &self,
        exit: &Exit,
        end: Position,
        state: &mut State,
    ) -> Result<(), StepError> {
        if state.has_quirk(quirk::rs274::COMPENSATION_EXIT_LENGTH) {
            return Ok(());
        }
        Documented.check_exit_line(exit, end, state)
    }

    /// Quirk rs274.compensation-exit-arc. An arc is refused also after a cycle, a probe, a spline or a stored position.
    fn lead_away_by_other_move(&self, state: &mut State) {
        if state.contour.exit.is_some() && state.has_quirk(quirk::rs274::COMPENSATION_EXIT_ARC) {
            return;
        }
        Documented.lead_away_by_other_move(state);
    }

    /// Quirk rs274.orientation-too-large. L of G41.1 and G42.1 above 9 is accepted, too.
    fn is_orientation(&self, number: i32, state: &State) -> bool {
        number > 9 && state.has_quirk(quirk::rs274::ORIENTATION_TOO_LARGE)
            || Documented.is_orientation(number, state)
    }
}
