//! Straight moves (11.5.3, 11.5.4, 11.5.33) and the dwell (11.5.6).

use gaugeblock_trace::{Compensation, Distance, Effect, FaultKind, Lathe, Motion};

use crate::canon::Sink;
use crate::faults::{Fault, planted};
use crate::words::Words;

use super::Modal;
use super::check::Block;
use super::codes::{MOTION, NON_MODAL};
use super::coordinates::Coordinates;
use super::refusal::{Refusal, refuse};
use super::values::not_negative;

impl Modal {
    /// G4.
    pub(super) fn dwell<K: Sink>(&mut self, words: &Words, sink: &mut K) -> Result<(), Refusal> {
        let seconds = words.get(b'P').unwrap_or(0.0);
        if planted(Fault::NegativeDwell) && seconds < 0.0 {
            return Ok(());
        }
        let seconds = not_negative(seconds, "P")?;
        self.perform(words.line, &Effect::Dwell { seconds }, sink)
    }

    /// Moves the point to where the axis words of a straight move lead.
    #[inline]
    pub(super) fn move_by(&mut self, words: &Words) {
        match self.in_force.now().distance {
            Distance::Absolute => self.position.replace(words),
            Distance::Incremental => self.position.add(words),
        }
    }

    /// The block's move, and the motion mode that it sets.
    pub(super) fn motion<K: Sink>(
        &mut self,
        block: &Block<'_>,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        let Some(code) = block.motion else { return Ok(()) };
        self.motion = match code {
            0 => Motion::Traverse,
            10 => Motion::Feed,
            _ => Motion::None,
        };
        let moves = block.axes_move
            || self.choices.move_in_place && block.g(MOTION).is_some() && !block.words.has_axes();
        if self.motion == Motion::None || !moves {
            return Ok(());
        }
        let machine_coordinates = block.g(NON_MODAL) == Some(530);
        self.check_compensated_move(machine_coordinates)?;
        let feed = self.motion == Motion::Feed;
        if feed || planted(Fault::TraverseNeedsFeed) {
            self.check_feed_move()?;
        }
        self.move_point(block, machine_coordinates);
        let end = self.position.position();
        let effect =
            if feed { Effect::StraightFeed { end } } else { Effect::StraightTraverse { end } };
        self.perform(block.words.line, &effect, sink)
    }

    /// Moves the point to the end of the block's move.
    fn move_point(&mut self, block: &Block<'_>, machine_coordinates: bool) {
        let radius;
        let diameter = self.in_force.now().lathe == Lathe::Diameter;
        let words = if diameter && !planted(Fault::DiameterAsRadius) {
            radius = with_radius(block.words);
            &radius
        } else {
            block.words
        };
        if machine_coordinates {
            // Absolute positions whatever the distance mode says (11.1.2.1).
            let now = self.in_force.now();
            let here = now.machine_of(self.position);
            let adds = planted(Fault::MachineIncremental) && now.distance == Distance::Incremental;
            let there = if adds { here.moved_by(words) } else { here.replaced(words) };
            self.position = now.program_of(there);
        } else {
            self.move_by(words);
        }
    }

    fn check_feed_move(&self) -> Result<(), Refusal> {
        if self.in_force.now().feed_rate <= 0.0 {
            return refuse(FaultKind::ZeroFeed, "a feed move without a feed rate");
        }
        if self.surface_speed_stands() {
            return refuse(FaultKind::ZeroSpeed, "a feed move under G96 while the spindle stands");
        }
        Ok(())
    }

    fn check_compensated_move(&self, machine_coordinates: bool) -> Result<(), Refusal> {
        if self.in_force.now().compensation == Compensation::Off {
            return Ok(());
        }
        if machine_coordinates {
            return refuse(FaultKind::CompensationActive, "G53 under cutter compensation");
        }
        if self.compensation_radius.abs() > 0.0 {
            return Err(Refusal::Unsupported("moves under cutter compensation".into()));
        }
        Ok(())
    }

    /// A straight traverse of a code's own.
    pub(super) fn traverse_to<K: Sink>(
        &mut self,
        line: u32,
        end: Coordinates,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        self.position = end;
        self.perform(line, &Effect::StraightTraverse { end: end.position() }, sink)
    }
}

/// The words with the X word as a radius: diameter mode (11.5.10).
pub(super) fn with_radius(words: &Words) -> Words {
    let mut radius = words.clone();
    if let Some(x) = words.get(b'X') {
        radius.set(23, x / 2.0);
    }
    radius
}
