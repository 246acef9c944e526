//! The words of a cycle, and its first motion.

use gaugeblock_vocabulary::{Axis, Compensation, FaultKind, Lathe, Plane};

use crate::canon::Sink;
use crate::faults::{PlantedFault, planted};
use crate::math;
use crate::words::Words;

use super::super::Modal;
use super::super::check::Block;
use super::super::letters::{X, Z};
use super::super::refusal::{Refusal, refuse};
use super::super::vector::Vector;
use super::numbers::{Cycle, Kind, Pockets};
use super::state::Turning;

/// P of G70 where it is not programmed.
const PASSES: f64 = 1.0;
/// I of G71 and G72 where it is not programmed, active length unit.
const INCREMENT: f64 = 1.0;
/// R of G71 and G72 where it is not programmed, active length unit.
const RETRACT: f64 = 0.5;

impl Modal {
    /// Checks a lathe cycle, performs its first motion, and makes it the unfinished work of its block.
    pub(in super::super) fn lathe_cycle<K: Sink>(
        &mut self,
        block: &Block<'_>,
        code: u16,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        let words = block.words;
        if words.is_polar() {
            return refuse(FaultKind::ModalConflict, "polar words in the ZX plane");
        }
        if self.active.now().plane != Plane::Zx {
            return refuse(FaultKind::ModalConflict, "a lathe cycle outside of ZX");
        }
        let is_free =
            matches!(code, 711 | 712 | 721 | 722) && planted(PlantedFault::KeptUnderCompensation);
        if code != 700 && self.active.now().compensation != Compensation::Off && !is_free {
            return refuse(FaultKind::CompensationActive, "a lathe cycle under compensation");
        }
        if !is_free
            && !self.compensation.is_idle()
            && (self.compensates() || self.compensation.has_path())
        {
            return Err(Refusal::Unsupported("a lathe cycle under cutter compensation".into()));
        }
        let distance = |letter: u8| words.get(letter).unwrap_or(0.0);
        let pockets = match code {
            711 | 721 if planted(PlantedFault::FirstTypeCutsPockets) => Pockets::Cut,
            711 | 721 => Pockets::Left,
            712 | 722 => Pockets::Alone,
            _ => Pockets::Cut,
        };
        let kind = if code == 700 {
            let passes = words.get(b'P').unwrap_or(PASSES);
            Kind::Finishing { from: distance(b'D'), to: distance(b'E'), passes }
        } else {
            Kind::Roughing {
                faces: code >= 720 && !planted(PlantedFault::FacingAlongZ),
                pockets,
                distance: distance(b'D'),
                increment: words.get(b'I').unwrap_or(INCREMENT),
                retract: words.get(b'R').unwrap_or(RETRACT),
            }
        };
        let start = self.first_motion(block, sink)?;
        let number = math::near_integer(distance(b'Q'));
        if number.is_none() {
            return refuse(FaultKind::NotAnInteger, "Q of a lathe cycle is not an integer");
        }
        let cycle = Cycle { kind, start };
        self.turning = Some(Turning::new(cycle, distance(b'Q')).into());
        self.begin_turning_job(words.line);
        Ok(())
    }

    /// The traverse to X and Z. Where the cycle starts: Z, X.
    fn first_motion<K: Sink>(
        &mut self,
        block: &Block<'_>,
        sink: &mut K,
    ) -> Result<Vector, Refusal> {
        let words = block.words;
        let start = self.lathe_point(words, self.is_incremental());
        if self.emulates_rs274 {
            // Quirks rs274.turning-traverse-in-place and rs274.turning-start-incremental. Other axes move too.
            let first = self.lathe_point(words, false);
            self.position = self.position.replaced(words);
            self.traverse_in_plane(words.line, first, sink)?;
        } else if words.present & (X | Z) != 0 {
            self.traverse_in_plane(words.line, start, sink)?;
        }
        Ok(start)
    }

    /// The point of X and Z: Z, X.
    fn lathe_point(&self, words: &Words, is_incremental: bool) -> Vector {
        let half = if self.active.now().lathe == Lathe::Diameter { 0.5 } else { 1.0 };
        let place = |axis: Axis, letter: u8, scale: f64| {
            let here = self.position.coordinate_of(axis);
            match words.get(letter) {
                Some(word) if is_incremental => here + word * scale,
                Some(word) => word * scale,
                None if words.present & (X | Z) != 0 && planted(PlantedFault::OneWordMovesBoth) => {
                    0.0
                }
                None => here,
            }
        };
        Vector { p: place(Axis::Z, b'Z', 1.0), q: place(Axis::X, b'X', half) }
    }
}
