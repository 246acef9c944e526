//! Moves in step with a spindle: G33 and G33.1 (11.5.22, 11.5.23).

use gaugeblock_trace::{Effect, FaultKind};

use crate::canon::Sink;

use super::Modal;
use super::check::Block;
use super::motions::mode_of;
use super::refusal::{Refusal, refuse};
use super::spindle::FIRST;

impl Modal {
    /// G33: a straight move at K per revolution.
    pub(super) fn synchronised_move<K: Sink>(
        &mut self,
        block: &Block<'_>,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        let spindle = self.turning_spindle(block)?;
        let (line, end) = (block.words.line, self.end_point(block.words));
        self.motion = mode_of(330);
        self.synchronise(line, spindle, block.words.get(b'K').unwrap_or(0.0), sink)?;
        self.feed_to(line, end, sink)?;
        self.perform(line, &Effect::StopSpindleSynchronisation {}, sink)
    }

    /// G33.1: there at K per revolution and back, where the move ends. I says how fast back, which the effect does not show.
    pub(super) fn tap_rigidly<K: Sink>(
        &mut self,
        block: &Block<'_>,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        let spindle = self.turning_spindle(block)?;
        let (line, end) = (block.words.line, self.end_point(block.words).position());
        self.motion = mode_of(331);
        self.synchronise(line, spindle, block.words.get(b'K').unwrap_or(0.0), sink)?;
        self.perform(line, &Effect::RigidTap { end }, sink)?;
        self.perform(line, &Effect::StopSpindleSynchronisation {}, sink)
    }

    /// Feed per revolution of a spindle from here.
    pub(super) fn synchronise<K: Sink>(
        &mut self,
        line: u32,
        spindle: u32,
        pitch: f64,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        self.perform(line, &Effect::StartSpindleSynchronisation { spindle, pitch }, sink)
    }

    /// The number of the selected spindle, which must turn.
    fn turning_spindle(&self, block: &Block<'_>) -> Result<u32, Refusal> {
        self.check_compensated_move(false)?;
        let spindle = self.selected(block, FIRST)?;
        if !self.spindle_of(spindle).turns() {
            return refuse(FaultKind::ZeroSpeed, "a synchronised move while the spindle stands");
        }
        Ok(spindle.trailing_zeros())
    }
}
