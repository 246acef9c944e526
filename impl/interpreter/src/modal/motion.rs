//! Moves (11.5.3 to 11.5.5, 11.5.33) and the dwell (11.5.6). G codes are in tenths: 530 is G53, 800 is G80.

use gaugeblock_vocabulary::{Compensation, Effect, FaultKind, Motion};

use crate::canon::Sink;
use crate::faults::{PlantedFault, planted};
use crate::parameters::Numbered;
use crate::words::Words;

use super::Modal;
use super::check::Block;
use super::choices::WithoutAxisWords;
use super::codes::{MOTION, NON_MODAL};
use super::motion_codes::mode_of;
use super::refusal::{Refusal, refuse};
use super::values::not_negative;

impl Modal {
    /// G4.
    pub(super) fn dwell<K: Sink>(&mut self, words: &Words, sink: &mut K) -> Result<(), Refusal> {
        let seconds = words.get(b'P').unwrap_or(0.0);
        if planted(PlantedFault::NegativeDwell) && seconds < 0.0 {
            return Ok(());
        }
        let seconds = not_negative(seconds, "P")?;
        self.perform(words.line, &Effect::Dwell { seconds }, sink)
    }

    /// Performs the block's move and sets its motion mode. An aborted motion does not change the mode.
    pub(super) fn execute_motion<K: Sink>(
        &mut self,
        block: &Block<'_>,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        let mode = self.motion;
        let moved = self.perform_motion(block, numbered, sink);
        if matches!(moved, Err(Refusal::Aborted)) {
            self.motion = mode;
        }
        moved
    }

    fn perform_motion<K: Sink>(
        &mut self,
        block: &Block<'_>,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        let Some(code) = block.motion else { return Ok(()) };
        let code = if block.g(MOTION).is_none() && block.m().any(|(_, code)| code == 72) {
            // M72 in the same block may have restored the motion mode that this block repeats.
            self.repeated_motion()?
        } else {
            code
        };
        self.check_inverse_time(block, code)?;
        if self.motion == Motion::Nurbs {
            self.check_open_curve(code)?;
        }
        if !matches!(code, 0 | 10 | 20 | 30 | 800) {
            if !self.compensation.is_idle() {
                self.leave_path_by_other_move(code);
            }
            return self.dispatch_motion(block, code, numbered, sink);
        }
        if self.choices.without_axis_words == WithoutAxisWords::Refused {
            check_axis_words(block, code)?;
        }
        self.motion = mode_of(code);
        let moves = block.axes_move
            || self.choices.move_in_place() && block.g(MOTION).is_some() && !block.words.has_axes();
        if self.motion == Motion::None {
            return Ok(());
        }
        if !moves {
            // G1 without axis words needs a feed rate, too (11.5.4).
            return if code == 10 { self.check_feed_rate() } else { Ok(()) };
        }
        self.check_straight_or_arc()?;
        if !self.compensation.is_idle() {
            self.check_machine_move(block.g(NON_MODAL) == Some(530))?;
            self.leave_path(block)?;
            if self.compensates() {
                return self.compensated_move(block, sink);
            }
        }
        let start = self.position;
        self.move_to_end_point(block)?;
        let end = self.position.position();
        let effect = if self.motion == Motion::Traverse {
            Effect::StraightTraverse { end }
        } else if self.motion == Motion::Feed {
            Effect::StraightFeed { end }
        } else {
            self.arc(block.words, self.motion, &start)?
        };
        self.note_rate(start, &effect);
        self.perform_move(block.words.line, start, &effect, sink)
    }

    /// Checks the feed of G0 to G3.
    fn check_straight_or_arc(&self) -> Result<(), Refusal> {
        if self.motion == Motion::Traverse && !planted(PlantedFault::TraverseNeedsFeed) {
            return Ok(());
        }
        if self.motion != Motion::Feed && planted(PlantedFault::SurfaceArc) {
            return self.check_feed_rate();
        }
        self.check_feed_move()
    }

    /// Checks the preconditions of a feed move.
    pub(super) fn check_feed_move(&self) -> Result<(), Refusal> {
        self.check_feed_rate()?;
        self.check_turning()
    }

    /// A feed rate must have been set.
    pub(super) fn check_feed_rate(&self) -> Result<(), Refusal> {
        if self.active.now().feed_rate <= 0.0 {
            return refuse(FaultKind::ZeroFeed, "a feed move without a feed rate");
        }
        Ok(())
    }

    /// Under constant surface speed the spindle must turn (11.5.60).
    pub(super) fn check_turning(&self) -> Result<(), Refusal> {
        if self.is_surface_speed_stopped() {
            return refuse(
                FaultKind::ZeroSpeed,
                "a feed move under G96 while the spindle is stopped",
            );
        }
        Ok(())
    }

    /// G53 is refused under cutter compensation.
    fn check_machine_move(&self, machine_coordinates: bool) -> Result<(), Refusal> {
        if machine_coordinates {
            return self.refuse_under_compensation("G53");
        }
        Ok(())
    }

    /// Whether moves are compensated: compensation is on, and the cutter has a radius.
    pub(super) fn compensates(&self) -> bool {
        self.active.now().compensation != Compensation::Off && self.cutter.has_radius()
    }

    /// Ends the run at a move whose compensation the documents leave open.
    pub(super) fn check_uncompensated_move(&self) -> Result<(), Refusal> {
        if self.compensates() {
            return Err(Refusal::Unspecified("such a move under cutter compensation".into()));
        }
        Ok(())
    }
}

/// G0 and G1 have an axis word, where by a choice they need one.
#[cold]
fn check_axis_words(block: &Block<'_>, code: u16) -> Result<(), Refusal> {
    let names_point = block.words.has_axes() || block.words.is_polar();
    let is_missing = block.g(MOTION).is_some() && !names_point;
    if matches!(code, 0 | 10) && is_missing {
        return refuse(FaultKind::MissingWord, "a move without an axis word");
    }
    Ok(())
}
