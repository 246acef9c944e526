//! Quirks of the lathe cycles G70 to G72.2.

use gaugeblock_vocabulary::{Distance, FaultKind, Position};

use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::check;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::target::end_point;
use crate::rs274::execute::turning::{TurningRules, has_start, traverse};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;
use crate::rs274::turning::{Curve, Piece, Point, ROUNDING, Travel};

impl TurningRules for Observed {
    /// Quirk rs274.turning-traverse-in-place. Without an axis word the first motion is a traverse in place.
    ///
    /// Quirk rs274.turning-profile-position. Where a compensated move waits it gets the end of the profile for its own.
    ///
    /// Quirk rs274.turning-start-incremental. Under G91 it takes the axis words for a position; the traverse that
    /// follows adds them to the position before the cycle.
    fn traverse_to_start(
        &self,
        start: Position,
        words: &Words,
        state: &mut State,
        record: &mut Record,
    ) -> Result<(), StepError> {
        let follows = state.has_quirk(quirk::rs274::TURNING_PROFILE_POSITION);
        if follows && state.contour.path.is_some() {
            let why = "G70 after a compensated move, where the position follows the profile";
            return Err(StepError::Unspecified(why.to_owned()));
        }
        if !has_start(words) {
            let in_place = state.has_quirk(quirk::rs274::TURNING_TRAVERSE_IN_PLACE);
            return if in_place { traverse(start, state, record) } else { Ok(()) };
        }
        let is_twice = state.modes.distance == Distance::Incremental
            && state.has_quirk(quirk::rs274::TURNING_START_INCREMENTAL);
        if is_twice {
            let position = absolute_start(words, state)?;
            traverse(position, state, record)?;
        }
        if is_twice && self.traverses_to_start_again(state) {
            return Ok(());
        }
        Documented.traverse_to_start(start, words, state, record)
    }

    /// Quirk rs274.turning-traverse-in-place. Another traverse to the start follows the first motion.
    fn traverses_to_start_again(&self, state: &State) -> bool {
        state.has_quirk(quirk::rs274::TURNING_TRAVERSE_IN_PLACE)
    }

    /// Quirk rs274.turning-start-too-far. A start beyond that of the profile becomes that of the profile.
    fn start_along_travel(&self, start: f64, of_profile: f64, state: &State) -> f64 {
        if state.has_quirk(quirk::rs274::TURNING_START_TOO_FAR) {
            return start.min(of_profile);
        }
        Documented.start_along_travel(start, of_profile, state)
    }

    /// Quirk rs274.turning-profile-codes. A block of a profile is checked as any block is; a fillet, a chamfer and a
    /// displacement count as words of X and Z, whatever axes the machine has.
    fn check_profile_block(&self, words: &Words, state: &mut State) -> Result<(), StepError> {
        if !state.has_quirk(quirk::rs274::TURNING_PROFILE_CODES) {
            return Documented.check_profile_block(words, state);
        }
        let mut words = words.clone();
        for (of_profile, axis) in [('a', 'z'), ('c', 'z'), ('u', 'x'), ('w', 'z')] {
            if let Some(value) = words.letters.remove(&of_profile) {
                words.letters.insert(axis, value);
            }
        }
        check::check(&words, state)
    }

    /// Quirk rs274.turning-profile-codes. Axis words are a move, whatever code of the block uses them.
    fn moves_by_other_codes(&self, state: &State) -> bool {
        state.has_quirk(quirk::rs274::TURNING_PROFILE_CODES)
    }

    /// Quirk rs274.turning-profile-position. The position is the end of the last move of the profile.
    fn profile_reaches(&self, end: Point, state: &mut State) {
        if state.has_quirk(quirk::rs274::TURNING_PROFILE_POSITION) {
            state.position = Position { x: end.u, z: end.w, ..state.position };
        }
    }

    /// Quirk rs274.finishing-one-arc. Towards greater Z the profile has to lead on after its first piece.
    fn finishes_along_z(&self, travel: Travel, ends: [Point; 2], state: &State) -> bool {
        if !state.has_quirk(quirk::rs274::FINISHING_ONE_ARC) {
            return Documented.finishes_along_z(travel, ends, state);
        }
        let [of_first, of_last] = ends;
        travel.never_forth || travel.never_back && of_last.w > of_first.w
    }

    /// Quirk rs274.turning-parallel-pieces. Two lines in a row in the direction of travel do not intersect, and are
    /// refused. In other directions rounding may hide that they are parallel.
    fn check_distance(&self, pieces: &[Piece], state: &State) -> Result<(), StepError> {
        if !state.has_quirk(quirk::rs274::TURNING_PARALLEL_PIECES) {
            return Documented.check_distance(pieces, state);
        }
        let are_lines = |pair: &&[Piece]| pair.iter().all(|piece| piece.curve == Curve::Line);
        for pair in pieces.windows(2).filter(are_lines) {
            let (along, other) = (pair[0].leaves(), pair[1].leaves());
            if along == other && along.u == 0.0 {
                let message = "two pieces in one direction, at a distance from the profile";
                let quirk = quirk::rs274::TURNING_PARALLEL_PIECES;
                return Err(refuse(quirk, FaultKind::Gouging, message));
            }
            if along.turn_to(other).abs() <= ROUNDING {
                let why = "two pieces nearly in one direction, with a distance";
                return Err(StepError::Unspecified(why.to_owned()));
            }
        }
        Ok(())
    }

    /// Quirk rs274.turning-end. The tool goes on to the depth where the cycle starts.
    fn goes_on_to_start_depth(&self, state: &State) -> bool {
        state.has_quirk(quirk::rs274::TURNING_END)
    }
}

/// The point that the axis words name as a position, whatever the distance mode is.
fn absolute_start(words: &Words, state: &mut State) -> Result<Position, StepError> {
    let distance = std::mem::replace(&mut state.modes.distance, Distance::Absolute);
    let position = end_point(words, state);
    state.modes.distance = distance;
    position
}
