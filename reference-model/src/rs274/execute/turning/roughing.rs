//! G71, G72 and their variants: layers along the travel axis, each deeper than the one before, down to the profile.

use gaugeblock_vocabulary::FaultKind;

use super::cycle::{Cycle, Pockets};
use super::finishing::ends;
use super::levels::Roughing;
use super::tool::Tool;
use crate::ids::rule;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;
use crate::rs274::turning::{
    Curve, Frame, Move, Piece, Point, ROUNDING, Travel, check_corners, left_of, offset,
};

/// Roughs a profile.
///
/// Rule turning.roughing-direction. G71 removes layers along Z and G72 along X, in the direction of the profile.
/// Rules turning.roughing-whole, turning.roughing-without-pockets and turning.roughing-pockets. Each variant cuts its
/// part. Rule turning.roughing-end. The tool stops at the end of the profile, at its distance.
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
    let frame = frame(cycle, moves, &pieces[1..], state)?;
    let pieces: Vec<Piece> = pieces.iter().map(|piece| piece.within(frame)).collect();
    let mut lead = pieces[0];
    lead.start.w = state.dialect().start_along_travel(lead.start.w, lead.end.w, state);
    let profile = at_distance(cycle, &lead, &pieces[1..], frame, state)?;
    lead.end = profile[0].start;
    let start = lead.start;
    let Path { pieces: path, halves, closes } = path(lead, profile);
    let again = state.dialect().traverses_to_start_again(state);
    let goes_on = state.dialect().goes_on_to_start_depth(state);
    let mut tool = Tool { frame, state: &mut *state, record };
    if again {
        tool.traverse(start)?;
    }
    let highest = start.u;
    let mut roughing = Roughing { tool, cycle, path, halves, highest, layer: 0.0, closes, goes_on };
    let rule = match cycle.pockets() {
        Pockets::Cut => {
            roughing.whole()?;
            rule::turning::ROUGHING_WHOLE
        }
        Pockets::Left => {
            roughing.without_pockets()?;
            rule::turning::ROUGHING_WITHOUT_POCKETS
        }
        Pockets::Only => {
            roughing.pockets()?;
            rule::turning::ROUGHING_POCKETS
        }
    };
    for rule in [rule, rule::turning::ROUGHING_DIRECTION, rule::turning::ROUGHING_END] {
        state.coverage.accepted(rule);
    }
    Ok(())
}

/// The axes of the cycle. Depth counts away from the material: in the other direction where the profile ends lower than
/// it starts, and for G72 also where it ends as high, which is inside turning.
///
/// Rule turning.roughing-monotonic. The profile leads one way along the travel axis.
fn frame(
    cycle: &Cycle,
    moves: &[Move],
    pieces: &[Piece],
    state: &mut State,
) -> Result<Frame, StepError> {
    let across = cycle.is_across();
    let looked_at = Frame { across, travel: 1.0, depth: 1.0 };
    let pieces: Vec<Piece> = pieces.iter().map(|piece| piece.within(looked_at)).collect();
    let [from, to] = ends(moves).map(|end| looked_at.of(end));
    let travel = if to.w > from.w { 1.0 } else { -1.0 };
    let is_inside = if across { to.u <= from.u } else { to.u < from.u };
    let frame = Frame { travel, depth: if is_inside { -1.0 } else { 1.0 }, ..looked_at };
    check_corners(moves, frame)?;
    let along = Travel::of(&pieces)?;
    if !(if travel > 0.0 { along.never_back } else { along.never_forth }) {
        let message = "a profile that is not monotonic along the axis of travel";
        let rule = rule::turning::ROUGHING_MONOTONIC;
        return Err(refuse(rule, FaultKind::WordOutOfRange, message));
    }
    state.coverage.accepted(rule::turning::ROUGHING_MONOTONIC);
    Ok(frame)
}

/// Rule turning.roughing-distance. The profile at the distance D, towards the start of the cycle.
fn at_distance(
    cycle: &Cycle,
    lead: &Piece,
    pieces: &[Piece],
    frame: Frame,
    state: &mut State,
) -> Result<Vec<Piece>, StepError> {
    if cycle.distance == 0.0 {
        return Ok(pieces.to_vec());
    }
    let (from, to) = (pieces[0].start, pieces[pieces.len() - 1].end);
    let rises = frame.depth * to.u >= frame.depth * from.u;
    let is_left = left_of(lead, pieces, rises == (frame.depth > 0.0))?;
    state.coverage.accepted(rule::turning::ROUGHING_DISTANCE);
    state.dialect().check_distance(pieces, state)?;
    offset(pieces, if is_left { cycle.distance } else { -cycle.distance })
}

/// The path of a cycle.
struct Path {
    /// The lead to the start of the profile, the profile, and, if this ends lower than the cycle starts, a line along
    /// the depth axis that closes it. An arc is split at its highest point.
    pieces: Vec<Piece>,
    /// The places of the second parts of arcs that were split.
    halves: Vec<usize>,
    /// The place of the line that closes it.
    closes: usize,
}

fn path(lead: Piece, profile: Vec<Piece>) -> Path {
    let (mut pieces, mut halves) = (vec![lead], Vec::new());
    for piece in profile {
        match piece.highest_inside() {
            Some(highest) => {
                halves.push(pieces.len() + 1);
                pieces.extend(<[Piece; 2]>::from(piece.split(highest)));
            }
            None => pieces.push(piece),
        }
    }
    let end = pieces[pieces.len() - 1].end;
    let closes = pieces.len();
    if end.u < lead.start.u - ROUNDING {
        let above = Point { u: lead.start.u, ..end };
        pieces.push(Piece { start: end, end: above, curve: Curve::Line });
    }
    Path { pieces, halves, closes }
}
