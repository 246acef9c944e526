//! Quirks of cutter compensation.

use gaugeblock_vocabulary::{Compensation, Position};

use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::execute::compensation::CompensationRules;
use crate::rs274::refusal::StepError;
use crate::rs274::state::{Exit, State};

impl CompensationRules for Observed {
    /// Quirk rs274.compensation-entry-equal. An entry that is as long as the radius is too short.
    fn is_entry(&self, length: f64, radius: f64, state: &State) -> bool {
        let is_refused =
            length <= radius && state.has_quirk(quirk::rs274::COMPENSATION_ENTRY_EQUAL);
        !is_refused && Documented.is_entry(length, radius, state)
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

    /// Quirk rs274.compensation-exit-arc. An arc is refused also after a cycle, a probe, a spline or a stored position,
    /// but not after G33 and G33.1.
    fn lead_away_by_other_move(&self, is_synchronised: bool, state: &mut State) {
        if is_synchronised || !state.has_quirk(quirk::rs274::COMPENSATION_EXIT_ARC) {
            Documented.lead_away_by_other_move(is_synchronised, state);
        }
    }

    /// Quirk rs274.compensation-side. A negative radius becomes a positive radius on the other side.
    fn in_force(&self, side: Compensation, radius: f64, state: &State) -> (Compensation, f64) {
        if radius >= 0.0 || !state.has_quirk(quirk::rs274::COMPENSATION_SIDE) {
            return Documented.in_force(side, radius, state);
        }
        let other = match side {
            Compensation::Off => Compensation::Off,
            Compensation::Left => Compensation::Right,
            Compensation::Right => Compensation::Left,
            Compensation::DynamicLeft => Compensation::DynamicRight,
            Compensation::DynamicRight => Compensation::DynamicLeft,
        };
        (other, -radius)
    }

    /// Quirk rs274.orientation-too-large. L of G41.1 and G42.1 above 9 is accepted, too.
    fn is_orientation(&self, number: i32, state: &State) -> bool {
        number > 9 && state.has_quirk(quirk::rs274::ORIENTATION_TOO_LARGE)
            || Documented.is_orientation(number, state)
    }
}
