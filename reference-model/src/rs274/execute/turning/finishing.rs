//! G70: passes along the profile, each closer to it.

use gaugeblock_vocabulary::FaultKind;

use super::cycle::Cycle;
use super::tool::Tool;
use crate::ids::rule;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;
use crate::rs274::turning::{Frame, Move, Piece, Point, Travel, check_corners, left_of, offset};

/// Finishes a profile.
///
/// Rule turning.finishing-path. Each pass traverses to the start of the profile at its distance and follows it at feed
/// rate; between passes it traverses to the start of the cycle. Rule turning.finishing-end. The tool stays at the end
/// of the last pass.
///
/// # Errors
/// Those of its moves and of the profile at a distance.
pub(super) fn perform(
    cycle: &Cycle,
    moves: &[Move],
    pieces: &[Piece],
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    let frame = frame(moves, &pieces[1..], state)?;
    let pieces: Vec<Piece> = pieces.iter().map(|piece| piece.within(frame)).collect();
    let (mut lead, pieces) = (pieces[0], &pieces[1..]);
    lead.start.w = state.dialect().start_along_travel(lead.start.w, lead.end.w, state);
    let mut is_first = true;
    for distance in distances(cycle, state)? {
        let away = at_distance(distance, &lead, pieces, state)?;
        let mut tool = Tool { frame, state: &mut *state, record: &mut *record };
        if !is_first || tool.state.dialect().traverses_to_start_again(tool.state) {
            tool.traverse(lead.start)?;
        }
        tool.traverse(away[0].start)?;
        away.iter().try_for_each(|piece| tool.along(piece))?;
        is_first = false;
    }
    for rule in [rule::turning::FINISHING_PATH, rule::turning::FINISHING_END] {
        state.coverage.accepted(rule);
    }
    Ok(())
}

/// Rule turning.finishing-monotonic. The profile leads one way along Z, or else along X.
fn frame(moves: &[Move], pieces: &[Piece], state: &mut State) -> Result<Frame, StepError> {
    let along_z = Travel::of(pieces)?;
    let after_first = [pieces[0].end, pieces[pieces.len() - 1].end];
    let across = !state.dialect().finishes_along_z(along_z, after_first, state);
    let looked_at = Frame { across, travel: 1.0, depth: 1.0 };
    let [from, to] = ends(moves).map(|end| looked_at.of(end));
    let frame = Frame { travel: if to.w > from.w { 1.0 } else { -1.0 }, ..looked_at };
    check_corners(moves, Frame { depth: if to.u < from.u { -1.0 } else { 1.0 }, ..frame })?;
    let pieces: Vec<Piece> = pieces.iter().map(|piece| piece.within(looked_at)).collect();
    if !Travel::of(&pieces)?.is_monotonic() {
        let message = "a profile that is monotonic in neither Z nor X";
        let rule = rule::turning::FINISHING_MONOTONIC;
        return Err(refuse(rule, FaultKind::WordOutOfRange, message));
    }
    state.coverage.accepted(rule::turning::FINISHING_MONOTONIC);
    Ok(frame)
}

/// The ends of the first and of the last move: P0 and Pn.
pub(super) fn ends(moves: &[Move]) -> [Point; 2] {
    [moves[0].piece.end, moves[moves.len() - 1].piece.end]
}

/// Rule turning.finishing-passes. The distance of each pass: (pass - 1)(D - E)/P + E, from the greatest pass down to
/// the first.
fn distances(
    cycle: &Cycle,
    state: &mut State,
) -> Result<impl Iterator<Item = f64> + use<>, StepError> {
    let Cycle { distance, last_distance, passes, .. } = *cycle;
    let count = passes.floor();
    if !count.is_finite() {
        return Err(StepError::TooManyEffects);
    }
    state.coverage.accepted(rule::turning::FINISHING_PASSES);
    let mut pass = count;
    Ok(std::iter::from_fn(move || {
        (pass >= 1.0).then(|| {
            pass -= 1.0;
            pass * (distance - last_distance) / passes + last_distance
        })
    }))
}

/// The profile at a distance; a positive one is towards the start of the cycle.
///
/// Rule turning.finishing-side. The start of the cycle says which side that is.
fn at_distance(
    distance: f64,
    lead: &Piece,
    pieces: &[Piece],
    state: &mut State,
) -> Result<Vec<Piece>, StepError> {
    if distance == 0.0 {
        return Ok(pieces.to_vec());
    }
    let (from, to) = (pieces[0].start, pieces[pieces.len() - 1].end);
    let is_left = left_of(lead, pieces, to.u >= from.u)?;
    state.coverage.accepted(rule::turning::FINISHING_SIDE);
    state.dialect().check_distance(pieces, state)?;
    offset(pieces, if is_left { distance } else { -distance })
}
