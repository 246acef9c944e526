//! Performs a lathe cycle, a move or a round of its offset at a time.

use alloc::vec::Vec;

use gaugeblock_vocabulary::{Axis, Effect, FaultKind, FeedMode, Motion};

use crate::canon::Sink;
use crate::faults::{PlantedFault, planted};

use super::super::Modal;
use super::super::coordinates::Coordinates;
use super::super::refusal::{Refusal, refuse};
use super::super::vector::Vector;
use super::finishing::Finishing;
use super::motions::CycleMotion;
use super::numbers::{Contour, Kind};
use super::offset::Offset;
use super::piece::{Arc, Piece};
use super::reading::Reading;
use super::roughing::{Cut, Roughing};
use super::state::{Stage, Turning};

impl Modal {
    /// Performs the next move of a lathe cycle, or a part of the work before it. Returns whether it was the last one.
    pub(in super::super) fn perform_lathe_cycle<K: Sink>(
        &mut self,
        line: u32,
        sink: &mut K,
    ) -> Result<bool, Refusal> {
        let Some(mut turning) = self.turning.take() else { return Ok(true) };
        let over = self.advance_lathe_cycle(&mut turning, line, sink);
        if matches!(over, Ok(false)) {
            self.turning = Some(turning);
        }
        over
    }

    fn advance_lathe_cycle<K: Sink>(
        &mut self,
        turning: &mut Turning,
        line: u32,
        sink: &mut K,
    ) -> Result<bool, Refusal> {
        let moves_max = self.profile_moves;
        let Turning { cycle, stage, contour, .. } = turning;
        match stage {
            Stage::Profile(_) => Ok(false),
            Stage::Read => self.begin_cutting(turning),
            Stage::Offset(offset) => {
                if offset.step()?
                    && let Kind::Roughing { pockets, increment, retract, .. } = cycle.kind
                {
                    let cut = Cut { pockets, increment, retract };
                    let ends = (!self.emulates_rs274, self.emulates_rs274);
                    *stage = Stage::Roughing(Roughing::new(contour, &offset.pieces, cut, ends));
                }
                Ok(false)
            }
            Stage::Finishing(finishing) => {
                if finishing.passes == 0 {
                    return Ok(true);
                }
                if !finishing.is_ready {
                    check_side(contour, finishing.distance())?;
                    finishing.is_ready = finishing.offset.step()?;
                    return Ok(false);
                }
                if let Some(motion) = finishing.next(contour, moves_max) {
                    self.move_in_cycle(contour, motion, line, sink)?;
                }
                Ok(false)
            }
            Stage::Roughing(roughing) => {
                let Some(motion) = roughing.next()? else { return Ok(true) };
                self.move_in_cycle(contour, motion, line, sink)?;
                Ok(false)
            }
        }
    }

    /// The profile is complete. Returns whether the cycle is over: too few moves, or no pass.
    fn begin_cutting(&mut self, turning: &mut Turning) -> Result<bool, Refusal> {
        let moves_max = self.profile_moves;
        if let Kind::Roughing { increment, .. } = turning.cycle.kind
            && increment <= 0.0
        {
            return refuse(FaultKind::WordOutOfRange, "I of a lathe cycle is not positive");
        }
        let contour = turning.contour(self.emulates_rs274)?;
        let is_cut = !matches!(turning.cycle.kind, Kind::Finishing { passes, .. } if passes < 1.0);
        let Some(contour) = contour.filter(|_| is_cut) else {
            self.end_without_moves(&turning.reading)?;
            return Ok(true);
        };
        turning.contour = contour;
        let contour = &turning.contour;
        turning.stage = match turning.cycle.kind {
            Kind::Finishing { from, to, passes } => {
                let other = (!self.emulates_rs274, moves_max);
                Stage::Finishing(Finishing::new(contour, (from, to, passes), other))
            }
            Kind::Roughing { distance, .. } => {
                check_side(contour, distance)?;
                let distance = distance * contour.side.unwrap_or(1.0);
                let bounds = (moves_max, contour.joins_parallels);
                Stage::Offset(if planted(PlantedFault::DistanceInDepth) {
                    Offset::new(&raised(contour, distance), 0.0, bounds)
                } else {
                    Offset::new(&contour.pieces, distance, bounds)
                })
            }
        };
        Ok(false)
    }

    /// The end of a cycle that cuts nothing. The documents leave open which mode it leaves; `rs274` goes on as if the
    /// moves had been made.
    fn end_without_moves(&mut self, reading: &Reading) -> Result<(), Refusal> {
        if !self.emulates_rs274 {
            let why = "the motion mode after a lathe cycle without a cut (11.5.38, 11.5.39)";
            return Err(Refusal::Unspecified(why.into()));
        }
        if !reading.moves.is_empty() {
            (self.position, self.motion) = (self.in_plane(reading.here), reading.motion);
        }
        Ok(())
    }

    /// A move of the cycle, as a block of the program would make it.
    fn move_in_cycle<K: Sink>(
        &mut self,
        contour: &Contour,
        motion: CycleMotion,
        line: u32,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        let frame = contour.frame;
        if planted(PlantedFault::FeedOfProfile) {
            self.report(line, sink);
        }
        match motion {
            CycleMotion::Traverse(to) => self.traverse_in_plane(line, frame.back(to), sink),
            CycleMotion::Feed(to) => {
                self.check_cycle_feed()?;
                self.motion = Motion::Feed;
                self.feed_to(line, self.in_plane(frame.back(to)), sink)
            }
            CycleMotion::Arc { to, arc } => {
                self.check_cycle_feed()?;
                let arc = Arc { centre: frame.back(arc.centre), sense: arc.sense * frame.flip() };
                self.arc_in_plane(line, frame.back(to), arc, sink)
            }
        }
    }

    /// What a feed move of a block needs. Under inverse time it needs an F of its own, which no move of a cycle has.
    fn check_cycle_feed(&self) -> Result<(), Refusal> {
        if self.active.now().feed_mode == FeedMode::InverseTime {
            return refuse(FaultKind::MissingWord, "a lathe cycle under inverse time");
        }
        self.check_feed_move()
    }

    /// A traverse to a point: Z, X.
    pub(super) fn traverse_in_plane<K: Sink>(
        &mut self,
        line: u32,
        to: Vector,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        self.motion = Motion::Traverse;
        self.traverse_to(line, self.in_plane(to), sink)
    }

    fn arc_in_plane<K: Sink>(
        &mut self,
        line: u32,
        to: Vector,
        arc: Arc,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        let start = self.position;
        let from = Vector { p: start.coordinate_of(Axis::Z), q: start.coordinate_of(Axis::X) };
        let radius = |point: Vector| point.minus(arc.centre).length();
        self.check_radii(radius(from), radius(to))?;
        let (motion, turns) = if arc.sense > 0.0 {
            (Motion::ArcCounterclockwise, 1)
        } else {
            (Motion::ArcClockwise, -1)
        };
        self.motion = motion;
        self.position = self.in_plane(to);
        let effect = Effect::ArcFeed {
            end: self.position.position(),
            first_centre: arc.centre.p,
            second_centre: arc.centre.q,
            turns,
        };
        self.perform_move(line, start, &effect, sink)
    }

    pub(super) fn in_plane(&self, point: Vector) -> Coordinates {
        self.position.with_axis(Axis::Z, point.p).with_axis(Axis::X, point.q)
    }
}

/// Moves the profile along its depth. Only a planted fault uses it.
fn raised(contour: &Contour, distance: f64) -> Vec<Piece> {
    let raised = |point: Vector| Vector { q: point.q + distance, ..point };
    contour.pieces.iter().map(|piece| piece.mapped(raised, 1.0)).collect()
}

/// The side of an offset is open with one piece.
fn check_side(contour: &Contour, distance: f64) -> Result<(), Refusal> {
    if contour.side.is_none() && distance.abs() > 0.0 {
        return Err(Refusal::Unspecified("the side of an offset of one piece".into()));
    }
    Ok(())
}
