//! The profile as a cycle uses it: its direction of travel, and the side of its offset.

use alloc::vec::Vec;

use gaugeblock_vocabulary::FaultKind;

use crate::faults::{PlantedFault, planted};

use super::super::refusal::{Refusal, refuse};
use super::super::vector::Vector;
use super::frame::Frame;
use super::numbers::{Contour, Kind};
use super::piece::Piece;
use super::rounding::{not_monotonic, rounded};
use super::state::Turning;

impl Turning {
    /// Makes a contour of the moves; none where they are too few.
    pub(super) fn contour(&self, emulates_rs274: bool) -> Result<Option<Contour>, Refusal> {
        let start = self.cycle.start;
        let moves = &self.reading.moves;
        // Direction and side of turning are those of the points before corners are rounded.
        let Some(programmed) = moves.first().filter(|_| moves.len() > 1) else { return Ok(None) };
        let pieces = rounded(start, moves)?;
        let (Some(first), Some(last)) = (pieces.get(1), pieces.last()) else { return Ok(None) };
        if pieces.iter().any(Piece::has_no_circle) {
            return refuse(FaultKind::BadArc, "the radius of an arc does not reach its end");
        }
        let (first, last) = (first.from, last.to);
        let after_lead = pieces.get(1..).unwrap_or(&[]);
        let mut frame = match self.cycle.kind {
            Kind::Finishing { .. } => finishing_frame(after_lead, emulates_rs274),
            Kind::Roughing { faces, .. } => roughing_frame(after_lead, faces),
        };
        frame.along = if frame.of(last).p > frame.of(programmed.to).p { 1.0 } else { -1.0 };
        if !after_lead.iter().all(|piece| frame.piece(piece).travels()) {
            return not_monotonic();
        }
        let mut at = frame.of(start);
        // Quirk rs274.turning-start-too-far.
        if emulates_rs274 {
            at.p = at.p.min(frame.of(first).p);
        }
        let mut side = side(&frame, at, after_lead);
        if matches!(self.cycle.kind, Kind::Finishing { .. })
            && planted(PlantedFault::SideOfGreaterX)
        {
            side = side.map(|_| 1.0);
        }
        let sinks = frame.of(last).q - frame.of(programmed.to).q;
        let inside = match self.cycle.kind {
            Kind::Finishing { .. } => false,
            Kind::Roughing { faces, .. } => sinks < 0.0 || faces && sinks <= 0.0,
        };
        if inside {
            frame.outward = -1.0;
            at.q = -at.q;
        }
        let side = side.map(|side| side * frame.outward);
        let pieces: Vec<Piece> = after_lead.iter().map(|piece| frame.piece(piece)).collect();
        // Quirk rs274.turning-parallel-pieces.
        let joins_parallels = !emulates_rs274;
        Ok(Some(Contour { frame, start: at, pieces, side, joins_parallels }))
    }
}

/// The axes of G70. It travels along Z where the profile is monotonic in Z, or else along X.
fn finishing_frame(pieces: &[Piece], emulates_rs274: bool) -> Frame {
    let along = |sign: f64| {
        let frame = Frame { along: sign, ..Frame::unturned(false) };
        pieces.iter().all(|piece| frame.piece(piece).travels())
    };
    if along(-1.0) {
        return Frame::unturned(false);
    }
    let (Some(first), Some(last)) = (pieces.first(), pieces.last()) else {
        return Frame::unturned(false);
    };
    // Quirk rs274.finishing-one-arc: Z has to grow after the first piece.
    let grows = !emulates_rs274 || last.to.p > first.to.p;
    Frame::unturned(!(along(1.0) && grows))
}

/// The axes of G71 or G72. A planted fault exchanges them if the profile is monotonic in the other direction only.
fn roughing_frame(pieces: &[Piece], faces: bool) -> Frame {
    let own = Frame::unturned(faces);
    let travels = |frame: Frame| {
        [1.0, -1.0].iter().any(|along| {
            let frame = Frame { along: *along, ..frame };
            pieces.iter().all(|piece| frame.piece(piece).travels())
        })
    };
    if planted(PlantedFault::EitherAxisMonotonic) && !travels(own) {
        return Frame::unturned(!faces);
    }
    own
}

/// On which side of the direction of travel an offset is: 1 for greater depths, -1 for smaller ones. It is open with
/// one piece.
fn side(frame: &Frame, start: Vector, pieces: &[Piece]) -> Option<f64> {
    let (first, last) = (pieces.first()?, pieces.last()?);
    if pieces.len() < 2 {
        return None;
    }
    let (begin, end) = (frame.of(first.from), frame.of(last.to));
    let (lead, way) = (begin.minus(start), frame.of(last.from).minus(begin));
    let turn = lead.q * way.p - lead.p * way.q;
    let greater = turn < 0.0 || turn <= 0.0 && end.q >= begin.q;
    Some(if greater { 1.0 } else { -1.0 })
}
