//! Fillets and chamfers at the corners of a profile, and the pieces that are too short to keep.

use alloc::vec::Vec;

use gaugeblock_vocabulary::FaultKind;

use crate::faults::{PlantedFault, planted};

use super::super::refusal::{Refusal, refuse};
use super::super::vector::Vector;
use super::piece::{Arc, Curve, Piece, ROUNDING};
use super::reading::{Corner, ProfileMove};

/// A piece shorter than this is dropped; program units.
pub(super) const SHORTEST: f64 = 0.001;

/// Refuses a profile that does not go in one direction.
pub(super) fn not_monotonic<T>() -> Result<T, Refusal> {
    refuse(FaultKind::BadBlock, "the profile is not monotonic")
}

/// The lead and the pieces of a profile, its corners rounded, without pieces that are too short.
pub(super) fn rounded(start: Vector, moves: &[ProfileMove]) -> Result<Vec<Piece>, Refusal> {
    let mut pieces: Vec<Piece> = Vec::with_capacity(moves.len());
    let mut from = start;
    let mut corner = Corner::Sharp;
    for each in moves {
        let curve = if pieces.is_empty() { Curve::Line } else { each.curve };
        let mut next = Piece { from, to: each.to, curve };
        from = each.to;
        if let Some(last) = pieces.last_mut()
            && let Some(joint) = joint(last, &mut next, corner)?
        {
            pieces.push(joint);
        }
        pieces.push(next);
        corner = each.corner;
    }
    drop_short(&mut pieces);
    Ok(pieces)
}

/// Shortens two pieces for the fillet or the chamfer between them. The sign of its radius has no effect.
fn joint(last: &mut Piece, next: &mut Piece, corner: Corner) -> Result<Option<Piece>, Refusal> {
    let radius = match corner {
        Corner::Sharp => return Ok(None),
        Corner::Fillet(radius) | Corner::Chamfer(radius) => radius,
    };
    let radius = radius.abs();
    if radius <= 0.0 {
        return Ok(None);
    }
    if last.as_arc().is_some() || next.as_arc().is_some() {
        return Err(Refusal::Unspecified("a fillet or chamfer next to an arc of a profile".into()));
    }
    let (before, after) = (last.end_direction(), next.start_direction());
    let (cross, dot) = (before.cross(after), before.dot(after));
    if cross.abs() <= ROUNDING {
        return Err(Refusal::Unspecified("a fillet or chamfer between collinear moves".into()));
    }
    let sense = if cross > 0.0 { 1.0 } else { -1.0 };
    let mut length = radius * cross.abs() / (1.0 + dot);
    if matches!(corner, Corner::Chamfer(_)) && planted(PlantedFault::ChamferByLeg) {
        length = radius;
    }
    if length >= last.chord() || length >= next.chord() {
        if matches!(corner, Corner::Fillet(_)) && planted(PlantedFault::LargeFilletLeftOut) {
            return Ok(None);
        }
        return not_monotonic();
    }
    let corner_point = last.to;
    last.to = corner_point.minus(before.times(length));
    next.from = corner_point.plus(after.times(length));
    let curve = if matches!(corner, Corner::Chamfer(_)) {
        Curve::Line
    } else {
        let centre = last.to.plus(before.quarter(sense).times(radius));
        Curve::Arc(Arc { centre, sense })
    };
    Ok(Some(Piece { from: last.to, to: next.from, curve }))
}

/// Drops pieces that are too short, the lead excepted; their neighbours meet in their middle.
fn drop_short(pieces: &mut Vec<Piece>) {
    let mut place = 1;
    while let Some(piece) = pieces.get(place).copied() {
        if piece.chord() >= SHORTEST {
            place = place.saturating_add(1);
            continue;
        }
        pieces.remove(place);
        let is_last = place >= pieces.len();
        let is_first = place == 1;
        let middle = piece.from.plus(piece.to).times(0.5);
        if is_first {
            if let Some(lead) = pieces.first_mut() {
                lead.to = piece.to;
            }
        } else if !is_last {
            if let Some(last) = place.checked_sub(1).and_then(|place| pieces.get_mut(place)) {
                last.to = middle;
            }
            if let Some(next) = pieces.get_mut(place) {
                next.from = middle;
            }
        }
    }
}
