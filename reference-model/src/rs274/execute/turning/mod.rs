//! Lathe cycles, G70 to G72.2: each is rewritten into traverses, feeds and arcs along a profile.
//!
//! | room | what it settles |
//! | --- | --- |
//! | [`cycle`] | the numbers of a block: which cycle, where it starts, which subroutine has its profile |
//! | [`profile`] | which blocks of the subroutine are moves, and where they lead |
//! | [`finishing`] | G70: passes along the profile |
//! | [`roughing`] | G71, G72 and their variants: layers down to the profile |
//! | [`tool`] | the moves that a cycle is rewritten into |
//!
//! The facts are in docs/turning.md, the geometry of a profile in [`turning`](crate::rs274::turning). The run executes
//! the subroutine, since blocks come next to it, and leaves the moves in the state.

mod cycle;
mod finishing;
mod levels;
mod profile;
mod roughing;
mod tool;

use gaugeblock_vocabulary::{Axis, FaultKind, Position};

pub(crate) use cycle::{called_label, is_programmed};
pub(crate) use profile::Reading;
pub(crate) use tool::traverse;

use super::letter;
use super::word;
use crate::ids::rule;
use crate::rs274::evaluate::Words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;
use crate::rs274::turning::{Curve, Move, Piece, Point, Profile, Travel, pieces};

/// Operations on lathe cycles that a dialect can replace.
pub(crate) trait TurningRules {
    /// Rule turning.first-traverse. With an axis word a cycle begins with a traverse to its start.
    fn traverse_to_start(
        &self,
        start: Position,
        words: &Words,
        state: &mut State,
        record: &mut Record,
    ) -> Result<(), StepError> {
        if !has_start(words) {
            return Ok(());
        }
        traverse(start, state, record)?;
        state.coverage.accepted(rule::turning::FIRST_TRAVERSE);
        Ok(())
    }

    /// Whether a traverse to the start comes before the path even if the tool is there already: between passes alone.
    fn traverses_to_start_again(&self, _state: &State) -> bool {
        false
    }

    /// Rule turning.finishing-path. The start of the cycle along its axis of travel, where it is kept even if it lies
    /// beyond that of the profile in the direction of travel. Both are given in that direction.
    fn start_along_travel(&self, start: f64, _of_profile: f64, _state: &State) -> f64 {
        start
    }

    /// Rule turning.profile-ignored. What is checked of a block of a profile: nothing, as all but its moves is ignored.
    fn check_profile_block(&self, _words: &Words, _state: &mut State) -> Result<(), StepError> {
        Ok(())
    }

    /// Rule turning.profile-ignored. Whether the axis words of another code than a motion make a move: the code is
    /// ignored, and they with it.
    fn moves_by_other_codes(&self, _state: &State) -> bool {
        false
    }

    /// Rule parameters.position. A move of the profile has been read: the position remains where the tool is.
    fn profile_reaches(&self, _end: Point, _state: &mut State) {}

    /// Rule turning.finishing-monotonic. Whether G70 follows a profile along Z: it leads one way in Z.
    fn finishes_along_z(&self, travel: Travel, _ends: [Point; 2], _state: &State) -> bool {
        travel.is_monotonic()
    }

    /// Rules turning.finishing-passes and turning.roughing-distance. Every profile has another one at a distance from
    /// it.
    ///
    /// # Errors
    /// Pieces that have none.
    fn check_distance(&self, _pieces: &[Piece], _state: &State) -> Result<(), StepError> {
        Ok(())
    }

    /// Rule turning.roughing-end. Whether the tool goes on from the end of the profile to the depth where the cycle
    /// starts: it stays there.
    fn goes_on_to_start_depth(&self, _state: &State) -> bool {
        false
    }
}

/// Whether a block of a lathe cycle says where the cycle starts.
pub(crate) fn has_start(words: &Words) -> bool {
    Axis::ALL.iter().any(|axis| word(words, letter(*axis)).is_some())
}

/// Begins a lathe cycle; its profile is read next.
///
/// Rule turning.first-traverse. It begins with a traverse to X and Z.
///
/// # Errors
/// What a cycle is refused for before its first motion, and what this motion is refused for.
pub(crate) fn begin(
    words: &Words,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    let start = cycle::start_of(words, state)?;
    state.dialect().traverse_to_start(start, words, state, record)?;
    state.profile = Some(Profile { start, moves: Vec::new() });
    Ok(())
}

/// Cuts a profile that has been read.
///
/// Rule arcs.radius-too-small. An arc whose radius does not reach its end is refused now. What a profile of fewer than
/// two moves leaves is open.
///
/// # Errors
/// What a profile is refused for.
pub(crate) fn cut(
    moves: &[Move],
    words: &Words,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    let cycle = cycle::find(words)?;
    let pieces = pieces(moves)?;
    let cuts_nothing = pieces.len() < 2 || cycle.is_finishing() && cycle.passes < 1.0;
    if cuts_nothing {
        let why = "position and motion mode after a lathe cycle that cuts nothing".to_owned();
        return Err(StepError::Unspecified(why));
    }
    accept_corners(moves, state);
    if pieces[0].curve != Curve::Line {
        let why = "a profile whose first move is an arc".to_owned();
        return Err(StepError::Unspecified(why));
    }
    if pieces.iter().any(|piece| piece.curve == Curve::NoCircle) {
        let message = "an arc of the profile whose radius does not reach its end";
        return Err(refuse(rule::arcs::RADIUS_TOO_SMALL, FaultKind::BadArc, message));
    }
    for rule in [rule::turning::PROFILE_SUBROUTINE, rule::turning::PROFILE_MOVES] {
        state.coverage.accepted(rule);
    }
    if cycle.is_finishing() {
        finishing::perform(&cycle, moves, &pieces, state, record)
    } else {
        roughing::perform(&cycle, moves, &pieces, state, record)
    }
}

/// Names the rules of the corners of a profile; at the last move a corner has no meaning.
fn accept_corners(moves: &[Move], state: &mut State) {
    let (_, before) = moves.split_last().expect("turning: a profile has moves");
    for corner in before.iter().filter_map(|before| before.corner) {
        state.coverage.accepted(corner.rule());
    }
}
