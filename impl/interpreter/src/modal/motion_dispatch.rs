//! Motion codes other than G0 to G3 and G80, each handed to where it is done.

use gaugeblock_vocabulary::{Distance, Effect};

use crate::canon::Sink;
use crate::faults::{PlantedFault, planted};
use crate::parameters::Numbered;
use crate::words::Words;

use super::Modal;
use super::check::Block;
use super::coordinates::Coordinates;
use super::end_point::with_radius;
use super::modes::{Spindle, Spindles};
use super::refusal::Refusal;

impl Modal {
    /// The block's motion.
    pub(super) fn dispatch_motion<K: Sink>(
        &mut self,
        block: &Block<'_>,
        code: u16,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        if block.words.is_polar() && matches!(code, 50..=53) {
            let why = "polar words of a spline: they give no move (11.4.12)";
            return Err(Refusal::Unspecified(why.into()));
        }
        match code {
            330 => self.synchronised_move(block, sink),
            331 => self.tap_rigidly(block, sink),
            382..=385 => self.probe(block.words, code, numbered, sink),
            50 | 51 => self.spline(block.words, code, sink),
            52 => self.add_control_point(block.words),
            53 => self.close_curve(block.words.line, sink),
            700..=722 => self.lathe_cycle(block, code, sink),
            760 => self.thread(block),
            _ => self.canned_cycle(block, code),
        }
    }

    /// The end point of a move's axis words.
    pub(super) fn end_point(&self, words: &Words) -> Coordinates {
        self.point_from(self.position, words)
    }

    /// The end point of a move's axis words, which may be polar.
    pub(super) fn polar_end_point(&self, words: &Words) -> Result<Coordinates, Refusal> {
        let end = self.end_point(words);
        if words.is_polar() {
            return self.polar(words, self.is_incremental()).end(self.position, end);
        }
        Ok(end)
    }

    /// The point of axis words, incremental ones from a point.
    pub(super) fn point_from(&self, from: Coordinates, words: &Words) -> Coordinates {
        let radius;
        let words = if self.halves_x(false) && !planted(PlantedFault::OnlyPlainHalves) {
            radius = with_radius(words);
            &radius
        } else {
            words
        };
        if self.is_incremental() {
            from.moved_by(words).rotary_fault(words)
        } else {
            from.replaced(words)
        }
    }

    /// Whether axis words are increments.
    pub(super) fn is_incremental(&self) -> bool {
        self.active.now().distance == Distance::Incremental
    }

    /// A straight feed move of a code's own.
    pub(super) fn feed_to<K: Sink>(
        &mut self,
        line: u32,
        end: Coordinates,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        self.straight_to(line, end, &Effect::StraightFeed { end: end.position() }, sink)
    }

    /// A straight traverse of a code's own.
    pub(super) fn traverse_to<K: Sink>(
        &mut self,
        line: u32,
        end: Coordinates,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        self.straight_to(line, end, &Effect::StraightTraverse { end: end.position() }, sink)
    }

    fn straight_to<K: Sink>(
        &mut self,
        line: u32,
        end: Coordinates,
        effect: &Effect,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        let start = core::mem::replace(&mut self.position, end);
        self.perform_move(line, start, effect, sink)
    }

    /// The spindle of a set of one.
    pub(super) fn spindle_of(&self, which: Spindles) -> Spindle {
        let [first, ..] = self.active.now().spindles;
        let number = usize::try_from(which.trailing_zeros()).unwrap_or(0);
        self.active.now().spindles.get(number).copied().unwrap_or(first)
    }
}
