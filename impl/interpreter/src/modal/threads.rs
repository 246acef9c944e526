//! Moves in step with a spindle: G33 and G33.1 (11.5.22, 11.5.23).

use gaugeblock_vocabulary::{Effect, FaultKind, Motion, SpindleMode};

use crate::canon::Sink;
use crate::faults::{PlantedFault, planted};
use crate::math;

use super::Modal;
use super::check::Block;
use super::coordinates::Coordinates;
use super::modes::FIRST;
use super::motion_codes::mode_of;
use super::refusal::{Refusal, refuse};

impl Modal {
    /// G33: a straight move at K per revolution.
    pub(super) fn synchronised_move<K: Sink>(
        &mut self,
        block: &Block<'_>,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        let (line, end) = (block.words.line, self.begin_synchronised(block, mode_of(330), sink)?);
        self.feed_to(line, end, sink)?;
        self.perform(line, &Effect::StopSpindleSynchronisation {}, sink)
    }

    /// G33.1: there at K per revolution and back, where the move ends. I sets the speed of the way back, which is not
    /// part of the effect.
    pub(super) fn tap_rigidly<K: Sink>(
        &mut self,
        block: &Block<'_>,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        let (line, end) = (block.words.line, self.begin_synchronised(block, mode_of(331), sink)?);
        self.perform(line, &Effect::RigidTap { end: end.position() }, sink)?;
        self.perform(line, &Effect::StopSpindleSynchronisation {}, sink)
    }

    /// The beginning of both: a spindle turns, and from here the feed is K per revolution. Returns the end of the
    /// move.
    fn begin_synchronised<K: Sink>(
        &mut self,
        block: &Block<'_>,
        motion: Motion,
        sink: &mut K,
    ) -> Result<Coordinates, Refusal> {
        let spindle = self.turning_spindle(block)?;
        let end = self.polar_end_point(block.words)?;
        let pitch = block.words.get(b'K').unwrap_or(0.0);
        self.check_velocity(end, pitch, spindle)?;
        self.motion = motion;
        self.synchronise(block.words.line, spindle, pitch, sink)?;
        Ok(end)
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
        self.check_uncompensated_move()?;
        let spindle = self.selected(block, FIRST)?;
        let asked = if planted(PlantedFault::ChecksFirst) { FIRST } else { spindle };
        if !self.spindle_of(asked).turns() && !planted(PlantedFault::StandingSpindle) {
            return refuse(
                FaultKind::ZeroSpeed,
                "a synchronised move while the spindle is stopped",
            );
        }
        Ok(spindle.trailing_zeros())
    }

    /// The move must not be faster than an axis is, by the speed that S says (11.5.22, 11.5.23). Under constant
    /// surface speed that is not known.
    fn check_velocity(&self, end: Coordinates, pitch: f64, spindle: u32) -> Result<(), Refusal> {
        let now = self.active.now();
        let Some(spindle) = usize::try_from(spindle).ok().and_then(|at| now.spindles.get(at))
        else {
            return Ok(());
        };
        let way = now.machine_of(end).minus(now.machine_of(self.position));
        let [x, y, z, ..] = way.0;
        let length = math::sqrt(x * x + y * y + z * z);
        if spindle.mode != SpindleMode::Rpm || length <= 0.0 {
            return Ok(());
        }
        // K is a distance in X, Y and Z.
        let seconds = length / (pitch.abs() * spindle.speed / 60.0);
        let way = if planted(PlantedFault::LimitNumber) {
            way
        } else {
            way.converted(self.active_to_machine())
        };
        let too_fast = |(way, limit): (f64, f64)| way.abs() / seconds > limit * (1.0 + 1e-9);
        if way.0.into_iter().zip(self.velocities.0).any(too_fast) {
            return refuse(FaultKind::BeyondLimit, "the spindle is too fast for an axis");
        }
        Ok(())
    }
}
