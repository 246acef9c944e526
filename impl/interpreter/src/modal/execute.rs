//! The order of execution of a block (11.4.23).

use gaugeblock_vocabulary::{Effect, FaultKind, FeedMode};

use crate::block_start::BlockStart;
use crate::canon::{Reply, Sink};
use crate::faults::{PlantedFault, planted};
use crate::parameters::Numbered;
use crate::words::Words;

use super::Modal;
use super::check::Block;
use super::codes::{
    ARC_DISTANCE, COMPENSATION, DISTANCE, FEED_MODE, LATHE, MOTION, NON_MODAL, PATH, PLANE,
    RETRACT, STOP_RANK, TOOL_LENGTH, UNITS, WORK_OFFSET,
};
use super::compensation::waits_after_move;
use super::coordinates::{Conversion, Coordinates};
use super::mode_select::{checked_feed, unit_of};
use super::refusal::{Flow, Refusal, refuse};

impl Modal {
    /// Checks and executes the words of one block, on a fast path where there is one. Settings and effects go to the
    /// sink in the documents' order.
    #[inline]
    pub(crate) fn execute<K: Sink>(
        &mut self,
        words: &Words,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<Flow, Refusal> {
        sink.start_block(&BlockStart { words, numbered });
        if self.is_straight(words) {
            return self.straight_block(words, sink);
        }
        self.other_block(words, numbered, sink)
    }

    /// A block that is not a straight move.
    #[inline(never)]
    fn other_block<K: Sink>(
        &mut self,
        words: &Words,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<Flow, Refusal> {
        if self.is_arc(words) {
            self.arc_block(words, sink)
        } else {
            self.whole_block(words, numbered, sink)
        }
    }

    /// Every phase of the order of execution.
    #[inline(never)]
    pub(super) fn whole_block<K: Sink>(
        &mut self,
        words: &Words,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<Flow, Refusal> {
        let block = self.check(words)?;
        self.check_compensated_path()?;
        let before = self.snapshot_block(numbered);
        let tool_offset = self.active.now().tool_offset;
        let flow = self.phases(&block, numbered, sink);
        if self.emulates_rs274 && flow.is_ok() {
            self.after_tool_change(&block, tool_offset, numbered);
        }
        self.end_step(before, flow, numbered)
    }

    /// The phases of a block that passed the checks.
    fn phases<K: Sink>(
        &mut self,
        block: &Block<'_>,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<Flow, Refusal> {
        let words = block.words;
        self.stop_asked = false;
        self.feed(block)?;
        self.spindle_speed(block)?;
        if words.m_count != 0 {
            self.report(words.line, sink);
        }
        if let Some(tool) = words.get(b'T') {
            self.prepare_tool(tool, words.line, sink)?;
        }
        for (rank, code) in block.m() {
            if rank < STOP_RANK {
                self.before_motion(block, code, numbered, sink)?;
                // A setting that the next code sets again is reported first.
                self.report(words.line, sink);
            }
        }
        let stop = |block: &Block<'_>| {
            block.m().find(|(rank, _)| *rank >= STOP_RANK).map(|(_, code)| code)
        };
        if planted(PlantedFault::OptionalStopFirst) && stop(block) == Some(1) {
            self.stop(1, words.line, numbered, sink)?;
            self.g_phases(block, numbered, sink)?;
            return self.after_motion(words.line, None, numbered, sink);
        }
        self.g_phases(block, numbered, sink)?;
        self.after_motion(words.line, stop(block), numbered, sink)
    }

    /// An M code that comes before the G codes.
    fn before_motion<K: Sink>(
        &mut self,
        block: &Block<'_>,
        code: u16,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        match code {
            62..=65 => self.digital_output(block, code, sink),
            66 => self.wait_input(block, numbered, sink),
            67 | 68 => self.analog_output(block, code, sink),
            6 => self.change_tool(block.words.line, numbered, sink),
            61 => self.set_tool(block, numbered, sink),
            3..=5 => self.turn_spindle(block, code),
            19 => self.orient(block, sink),
            70..=73 => self.saved_state(code, numbered),
            7..=9 => {
                self.coolant(code);
                Ok(())
            }
            48..=53 => self.overrides(block, code),
            _ => self.user_code(block, code, sink),
        }
    }

    /// From the dwell to the motion.
    fn g_phases<K: Sink>(
        &mut self,
        block: &Block<'_>,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        if block.words.g_count == 0 && !block.axes_move {
            return Ok(());
        }
        let late = planted(PlantedFault::DwellLate);
        if block.g(NON_MODAL) == Some(40) && !late {
            self.dwell(block.words, sink)?;
        }
        if let Some(code) = block.g(PLANE) {
            self.select_plane(code)?;
        }
        if planted(PlantedFault::LengthBeforeUnits) {
            self.length_offset(block)?;
        }
        if let Some(code) = block.g(UNITS) {
            self.select_units(code)?;
            self.read_feed_again(block);
        }
        if let Some(code) = block.g(LATHE) {
            self.select_lathe_mode(code);
        }
        if let Some(code) = block.g(COMPENSATION) {
            self.switch_compensation(block.words, code, sink)?;
        }
        if !planted(PlantedFault::LengthBeforeUnits) {
            self.length_offset(block)?;
        }
        self.coordinate_system(block, false, numbered)?;
        if let Some(code) = block.g(PATH) {
            self.path(block.words, code)?;
        }
        self.distance(block, false);
        if let Some(code) = block.g(ARC_DISTANCE) {
            self.select_arc_distance(code);
        }
        if let Some(code) = block.g(RETRACT) {
            self.select_retract(code)?;
        }
        if let Some(code) = block.g(NON_MODAL) {
            match code {
                100 => self.set_data(block.words, numbered, sink)?,
                280 | 281 | 300 | 301 => self.stored_position(block, code, numbered, sink)?,
                _ => self.local_offset(block.words, code, numbered)?,
            }
        }
        self.coordinate_system(block, true, numbered)?;
        self.distance(block, true);
        self.execute_motion(block, numbered, sink)?;
        if block.g(NON_MODAL) == Some(40) && late {
            self.dwell(block.words, sink)?;
        }
        Ok(())
    }

    /// Applies a tool length offset.
    #[inline]
    fn length_offset(&mut self, block: &Block<'_>) -> Result<(), Refusal> {
        match block.g(TOOL_LENGTH) {
            Some(code) => self.tool_length(block.words, code),
            None => Ok(()),
        }
    }

    /// Sets the distance mode, before or, as a planted fault, after the reference location.
    fn distance(&mut self, block: &Block<'_>, after_reference: bool) {
        if let Some(code) = block.g(DISTANCE)
            && after_reference == planted(PlantedFault::DistanceAfterReference)
        {
            self.select_distance(code);
        }
    }

    /// Selects a coordinate system, before or, as a planted fault, after G10.
    fn coordinate_system(
        &mut self,
        block: &Block<'_>,
        after_data: bool,
        numbered: &mut Numbered,
    ) -> Result<(), Refusal> {
        let late = planted(PlantedFault::DataBeforeSelection) && block.g(NON_MODAL) == Some(100);
        match block.g(WORK_OFFSET) {
            Some(code) if after_data == late => self.select_work_offset(code, numbered),
            Some(_) | None => Ok(()),
        }
    }

    /// Set feed rate mode, then the feed rate: the first phases.
    fn feed(&mut self, block: &Block<'_>) -> Result<(), Refusal> {
        if let Some(code) = block.g(FEED_MODE) {
            if code == 950 {
                let which = self.selected(block, super::modes::FIRST)?;
                self.feed_spindle = which.trailing_zeros();
            }
            self.select_feed_mode(code);
        }
        let feed = block.words.get(b'F');
        if self.active.now().feed_mode != FeedMode::InverseTime {
            return feed.map_or(Ok(()), |feed| self.set_feed(self.feed_before_units(block, feed)));
        }
        if self.choices.feed_for_one_block {
            return self.set_feed(feed.unwrap_or(0.0));
        }
        // Under inverse time F belongs to one move; on any other line it is ignored (11.5.59).
        let kept = planted(PlantedFault::IgnoredRateKept);
        if !block.motion.is_some_and(takes_inverse_time) && !kept {
            return feed.map_or(Ok(()), |feed| checked_feed(feed).map(drop));
        }
        feed.map_or(Ok(()), |feed| self.set_feed(feed))
    }

    /// F in the unit that is in force before the block selects one. In which of them F is read is a choice.
    fn feed_before_units(&self, block: &Block<'_>, feed: f64) -> f64 {
        match block.g(UNITS) {
            Some(code) if self.choices.feed_in_new_unit => {
                Conversion::between(unit_of(code), self.active.now().units).of(feed)
            }
            Some(_) | None => feed,
        }
    }

    /// Reads F in the new unit of its block, where it is to be read in that one (or by a planted fault): converted
    /// there and back it would lose its last bits. M72 has restored another feed rate.
    fn read_feed_again(&mut self, block: &Block<'_>) {
        let in_new_unit = self.choices.feed_in_new_unit && block.m().all(|(_, code)| code != 72);
        let reads_late = (in_new_unit || planted(PlantedFault::FeedAfterUnits))
            && self.active.now().feed_mode != FeedMode::InverseTime;
        if let Some(feed) = block.words.get(b'F').filter(|_| reads_late) {
            self.active.set_feed_rate(feed);
        }
    }

    /// Executes a block that has no words, and so no F for the choice by which F holds for its own block under G93.
    #[inline]
    pub(crate) fn execute_wordless<K: Sink>(&mut self, line: u32, sink: &mut K) {
        if self.choices.feed_for_one_block && self.active.now().feed_mode == FeedMode::InverseTime {
            self.active.set_feed_rate(0.0);
            self.report(line, sink);
        }
    }

    /// A move under inverse time has its F in its block (11.5.59). Which mode is in force M72 of the same block may
    /// have decided.
    pub(super) fn check_inverse_time(&self, block: &Block<'_>, code: u16) -> Result<(), Refusal> {
        // G1 needs F, also where it only sets the mode.
        let moves = block.axes_move || code == 10 || self.choices.move_in_place();
        let needs = self.active.now().feed_mode == FeedMode::InverseTime
            && takes_inverse_time(code)
            && moves
            && !(block.g(MOTION).is_none() && planted(PlantedFault::ExplicitOnly));
        if needs && block.words.get(b'F').is_none() && !planted(PlantedFault::InverseTimeOld) {
            return refuse(FaultKind::MissingWord, "inverse time without an F word");
        }
        Ok(())
    }

    /// Performs an effect under the settings in force.
    pub(super) fn perform<K: Sink>(
        &mut self,
        line: u32,
        effect: &Effect,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        if self.compensation.waits() && waits_after_move(effect) {
            self.hold(line, self.position, effect.clone(), sink);
            return Ok(());
        }
        self.report(line, sink);
        match sink.perform(line, effect) {
            Reply::Stop => self.stop_asked = true,
            Reply::Failed(kind) => return refuse(kind, "refused from outside"),
            Reply::Aborted => return Err(Refusal::Aborted),
            Reply::ReadOnly => self.begin_read_ahead_at(self.reached_point()),
            Reply::Done | Reply::Contact(_) | Reply::Input(_) | Reply::Tool(_) => {}
        }
        Ok(())
    }

    /// Performs a move whose end point is set already; where it is aborted the point is where the move began.
    pub(super) fn perform_move<K: Sink>(
        &mut self,
        line: u32,
        start: Coordinates,
        effect: &Effect,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        let is_ahead = self.machine_snapshot.is_some();
        let done = self.perform(line, effect, sink);
        if matches!(done, Err(Refusal::Aborted)) {
            self.position = start;
        } else if self.machine_snapshot.is_some() && !is_ahead {
            self.machine_snapshot = None;
            self.begin_read_ahead_at(start);
        }
        done
    }

    /// Performs an effect whose reply carries a result.
    pub(super) fn perform_with_reply<K: Sink>(
        &mut self,
        line: u32,
        effect: &Effect,
        sink: &mut K,
    ) -> Result<Reply, Refusal> {
        self.report(line, sink);
        let reply = sink.perform(line, effect);
        match reply {
            Reply::Stop => self.stop_asked = true,
            Reply::Failed(kind) => return refuse(kind, "refused from outside"),
            Reply::Aborted => return Err(Refusal::Aborted),
            Reply::ReadOnly => self.begin_read_ahead_at(self.reached_point()),
            Reply::Done | Reply::Contact(_) | Reply::Input(_) | Reply::Tool(_) => {}
        }
        Ok(reply)
    }
}

/// The motion codes that take F under inverse time. 11.5.59 names G1 to G3; 11.5.24 says that a straight probe takes
/// the specified time, and a spline is a feed move too.
const fn takes_inverse_time(code: u16) -> bool {
    matches!(code, 10 | 20 | 30 | 50 | 51 | 53 | 382..=385)
}
