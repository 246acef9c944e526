//! Fillets and chamfers at the corners of a profile.

use gaugeblock_vocabulary::{FaultKind, Position};

use super::piece::{Curve, Piece, is_tied};
use super::point::Frame;
use super::{ROUNDING, SHORTEST, SHORTEST_JOIN, open};
use crate::ids::{Rule, rule};
use crate::rs274::refusal::{StepError, refuse};

/// What a block of a profile inserts at the end of its move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Corner {
    /// A: an arc with this radius that is tangent to both moves.
    Fillet(f64),
    /// C: the chord of this arc.
    Chamfer(f64),
}

impl Corner {
    fn radius(self) -> f64 {
        match self {
            Self::Fillet(radius) | Self::Chamfer(radius) => radius,
        }
    }

    /// The rule that has it.
    pub(crate) fn rule(self) -> Rule {
        match self {
            Self::Fillet(_) => rule::turning::PROFILE_FILLET,
            Self::Chamfer(_) => rule::turning::PROFILE_CHAMFER,
        }
    }
}

/// A move of a profile as its block programs it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Move {
    pub(crate) piece: Piece,
    /// What is inserted at its end.
    pub(crate) corner: Option<Corner>,
}

/// The profile of a lathe cycle that is about to be cut.
#[derive(Clone, Debug)]
pub(crate) struct Profile {
    /// Where the cycle starts, program coordinates.
    pub(crate) start: Position,
    pub(crate) moves: Vec<Move>,
}

/// The pieces of a profile, the lead first: with fillets and chamfers, and without pieces that are too short.
///
/// Rules turning.profile-fillet and turning.profile-chamfer. A corner takes as much of both moves as its arc needs. At
/// the last move it has no meaning.
///
/// # Errors
/// A corner that does not fit. What is open of corners next to arcs.
pub(crate) fn pieces(moves: &[Move]) -> Result<Vec<Piece>, StepError> {
    let mut pieces: Vec<Piece> = Vec::with_capacity(moves.len());
    let mut corner = None;
    for next in moves {
        let mut piece = next.piece;
        if let (Some(corner), Some(before)) = (corner, pieces.last_mut()) {
            let inserted = insert(before, corner, &mut piece)?;
            pieces.extend(inserted);
        }
        pieces.push(piece);
        corner = next.corner;
    }
    drop_short(&mut pieces);
    Ok(pieces)
}

/// What a program makes of some corners is open: of one that turns down, in the axes of a cycle, with an arc of little
/// extent along the travel axis, and of one after a lead against the direction of travel.
///
/// # Errors
/// Such a corner.
pub(crate) fn check_corners(moves: &[Move], frame: Frame) -> Result<(), StepError> {
    for (place, pair) in moves.windows(2).enumerate() {
        let Some(corner) = pair[0].corner else { continue };
        let [before, next] = [pair[0].piece.within(frame), pair[1].piece.within(frame)];
        let (from, to) = (before.arrives(), next.leaves());
        if place == 0 && from.w < 0.0 {
            return Err(open("a fillet or chamfer after a lead against the direction of travel"));
        }
        let extent = corner.radius() * (from.left().w - to.left().w).abs();
        if from.turn_to(to) < 0.0 && extent <= SHORTEST_JOIN {
            return Err(open("a fillet or chamfer that turns down and is short along the travel"));
        }
    }
    Ok(())
}

/// Shortens two lines, and returns what connects them; nothing between lines in one direction.
fn insert(
    before: &mut Piece,
    corner: Corner,
    next: &mut Piece,
) -> Result<Option<Piece>, StepError> {
    if before.curve != Curve::Line || next.curve != Curve::Line {
        return Err(open("a fillet or chamfer next to an arc"));
    }
    let (from, to) = (before.arrives(), next.leaves());
    let (turn, along) = (from.turn_to(to), from.along(to));
    if turn.abs() <= ROUNDING {
        return Err(open("a fillet or chamfer between moves in one direction"));
    }
    let radius = corner.radius();
    // Half of the angle between both directions has this tangent.
    let cut = radius * turn.abs() / (1.0 + along);
    let room = before.chord().min(next.chord());
    let is_tight = is_tied(cut, room);
    if radius > 0.0 && is_tight {
        return Err(open("a fillet or chamfer that takes a whole move within rounding"));
    }
    if radius <= 0.0 || cut >= room {
        let message = "a fillet or chamfer without a radius, or too large for its moves";
        return Err(refuse(corner.rule(), FaultKind::WordOutOfRange, message));
    }
    let start = before.end.plus(-cut, from);
    let end = next.start.plus(cut, to);
    before.end = start;
    next.start = end;
    let curve = match corner {
        Corner::Chamfer(_) => Curve::Line,
        Corner::Fillet(_) => Curve::Arc {
            centre: start.plus(radius * turn.signum(), from.left()),
            sense: turn.signum(),
        },
    };
    Ok(Some(Piece { start, end, curve }))
}

/// A piece that is too short is dropped; its neighbours then meet in its middle.
fn drop_short(pieces: &mut Vec<Piece>) {
    let mut place = 1;
    while place < pieces.len() {
        if pieces[place].chord() >= SHORTEST {
            place += 1;
            continue;
        }
        let dropped = pieces.remove(place);
        let middle = dropped.start.middle(dropped.end);
        pieces[place - 1].end = middle;
        if let Some(next) = pieces.get_mut(place) {
            next.start = middle;
        }
    }
}
