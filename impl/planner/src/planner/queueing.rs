//! Queueing: how segments are added to the end of the path, at once or as a row of chords that waits for more of them.

use crate::chord::{chord_length, is_no_motion};
use crate::chord_row::RowLine;
use crate::error::NotQueued;
use crate::limits::squared;
use crate::math;
use crate::nominal_segment::{ResolvedSegment, resolve};
use crate::path_builder::{PathBuilder, PathEdit};
use crate::path_element::FeedBasis;
use crate::planner::Planner;
use crate::row_end::{NEAR_END_ELEMENTS, REVERSE_ELEMENTS_MIN, RowEnd};
use crate::segment::{PathControl, Segment};

/// Work of look-ahead per queued segment: a blend takes two units, any other element one.
const LOOK_AHEAD_WORK_PER_SEGMENT: u32 = 24;
/// The most elements that are made when a segment is queued, and in the mean for each chord that waits.
const ELEMENTS_PER_SEGMENT_MAX: u64 = 8;
const ELEMENTS_PER_CHORD: u64 = 3;
/// For how many cycles the motion must be able to go on without a look at the end of the path.
const NEAR_END_CYCLES: f64 = 20.0;
/// A cycle that has cost more leaves the row to the next one. A line is added in a cycle that has cost even less, or
/// after so many cycles.
const ROW_CYCLE_WORK_MAX: u32 = 2;
const LINE_CYCLE_WORK_MAX: u32 = 1;
const LINE_CYCLES_MAX: u8 = 8;

impl Planner {
    /// Queues a segment that begins where the last one ends.
    ///
    /// # Errors
    /// [`NotQueued::Full`] if the queue has no room, [`NotQueued::Malformed`] for numbers that describe no segment.
    pub fn queue(&mut self, segment: &Segment) -> Result<(), NotQueued> {
        self.finish_row_end();
        self.make_room();
        let waiting = self.queued_count.saturating_sub(self.motion.begun);
        let held = u64::try_from(self.row.count()).unwrap_or(0);
        let needed =
            ELEMENTS_PER_SEGMENT_MAX.saturating_add(held.saturating_mul(ELEMENTS_PER_CHORD));
        if self.aborting
            || self.elements.room() < needed
            || waiting > u64::from(self.dynamics.queue)
        {
            return Err(NotQueued::Full);
        }
        let in_stretch;
        let segment = if self.smoothing.is_some() {
            in_stretch = self.in_stretch(segment);
            &in_stretch
        } else {
            segment
        };
        let length = chord_length(segment, self.row.end(&self.builder.end), &self.limits);
        let continues = !self.row.is_empty() && length.is_some() && self.row.continues(segment);
        if continues && length.is_some_and(is_no_motion) {
            self.switches_due_at_end = self.switches.end();
            return Ok(());
        }
        let is_separate = self.next_is_separate || self.is_awaited();
        let turns = continues && self.row.turns_sharply(segment);
        if !self.row.is_empty() && (is_separate || !continues || turns) {
            // The triangle of such a corner has the last chord as a side.
            let last = if segment.path_control == PathControl::BetweenMidpoints {
                self.row.take_last()
            } else {
                None
            };
            self.end_row();
            if let Some(line) = last {
                self.add_line(&line);
            }
        }
        let after_midpoint = core::mem::replace(&mut self.last_path_control, segment.path_control)
            == PathControl::BetweenMidpoints;
        let start = *self.row.end(&self.builder.end);
        let length = length.filter(|length| !(after_midpoint || is_no_motion(*length)));
        let is_rough = match length {
            Some(length) => self.corners.is_rough(segment, (&start, length), &self.limits),
            None => {
                self.corners.forget_corners();
                false
            }
        };
        match length.filter(|_| is_rough || !self.row.is_empty()) {
            Some(length) => {
                self.queued_count = self.queued_count.saturating_add(1);
                self.next_is_separate = false;
                let index = (self.queued_count, is_separate);
                self.row.push(segment, (&start, length), index, &self.limits);
                while let Some(line) = self.row.next_line(&self.limits) {
                    self.add_line(&line);
                }
                if !self.row.is_empty() && self.is_near_end(false) {
                    self.end_row();
                }
            }
            None => self.add_segment(segment)?,
        }
        self.look_ahead.advance(
            &mut self.elements,
            self.motion.at,
            &self.table,
            (LOOK_AHEAD_WORK_PER_SEGMENT, false),
        );
        self.look_ahead.note_quiet_after_queueing(self.motion.at);
        Ok(())
    }

    /// Whether an output waits for the next segment that moves.
    fn is_awaited(&self) -> bool {
        let last = self.switches.get(self.switches.end().wrapping_sub(1));
        last.is_some_and(|(segment, _)| *segment == self.queued_count.saturating_add(1))
    }

    /// Adds a segment outside of rows to the path.
    fn add_segment(&mut self, segment: &Segment) -> Result<(), NotQueued> {
        let resolved = resolve(segment, self.builder.new_segment(), &self.limits)?;
        if let ResolvedSegment::ZeroLength = resolved {
            self.switches_due_at_end = self.switches.end();
        }
        match resolved {
            ResolvedSegment::ZeroLength if segment.path_control == PathControl::ExactStop => {
                self.builder.stop_at_end();
            }
            ResolvedSegment::ZeroLength => {}
            ResolvedSegment::Dwell(seconds) => {
                let (builder, mut edit) = self.edit();
                builder.dwell(seconds, &mut edit);
            }
            ResolvedSegment::Moves => {
                let separate = self.next_is_separate || self.is_awaited();
                self.queued_count = self.queued_count.saturating_add(1);
                let (nominal, _) = self.builder.new_segment();
                (nominal.whole.index, nominal.is_separate) = (self.queued_count, separate);
                self.next_is_separate = false;
                if segment.probing {
                    self.builder.stop_at_end();
                }
                let (builder, mut edit) = self.edit();
                builder.add(&mut edit);
                if self.builder.follows_spindle() {
                    self.note_spindle_sync();
                }
            }
        }
        Ok(())
    }

    /// What a change of the path needs.
    fn edit(&mut self) -> (&mut PathBuilder, PathEdit<'_>) {
        if self.motion_exceeds_plan && self.look_ahead.is_ready(self.motion.at) {
            self.motion_exceeds_plan = !self.motion.can_follow(&self.elements, &self.table);
        }
        let edit = PathEdit {
            elements: &mut self.elements,
            look_ahead: &mut self.look_ahead,
            motion: &self.motion,
            limits: &self.limits,
            table: &self.table,
            first_changed: u64::MAX,
            motion_exceeds_plan: self.motion_exceeds_plan,
        };
        (&mut self.builder, edit)
    }

    /// Adds a line that replaces chords to the path.
    fn add_line(&mut self, line: &RowLine) {
        if self.write_line(line) {
            let (builder, mut edit) = self.edit();
            builder.add(&mut edit);
            self.note_added_line();
        }
    }

    /// Writes a line that replaces chords. Returns whether it moves.
    fn write_line(&mut self, line: &RowLine) -> bool {
        let resolved = resolve(&line.segment, self.builder.new_segment(), &self.limits);
        let (nominal, _) = self.builder.new_segment();
        (nominal.whole.index, nominal.is_separate) = (line.index, line.is_separate);
        (nominal.merge_deviation, nominal.is_merged) = (line.deviation, line.is_merged);
        (nominal.start_length, nominal.end_length) = (line.start_length, line.end_length);
        matches!(resolved, Ok(ResolvedSegment::Moves))
    }

    /// Completes what cycles have begun of a line that replaces chords.
    fn finish_row_end(&mut self) {
        match self.row_end {
            RowEnd::Open | RowEnd::Near => {}
            RowEnd::Written => {
                self.builder.find_corner(&self.limits);
                self.add_written_line();
            }
            RowEnd::HasCorner(_) => self.add_written_line(),
        }
    }

    /// Adds the line that is written, with as little work as possible.
    #[inline(never)]
    fn add_written_line(&mut self) {
        self.row_end = RowEnd::Open;
        let (builder, mut edit) = self.edit();
        builder.add_after_corner(false, &mut edit);
        self.note_added_line();
    }

    /// A segment that follows the spindle may have been made again.
    fn note_added_line(&mut self) {
        if self.builder.follows_spindle() {
            self.note_spindle_sync();
        }
    }

    /// Ends the row of chords where its last one ends.
    #[inline(never)]
    pub(super) fn end_row(&mut self) {
        self.row_end = RowEnd::Open;
        while let Some(line) = self.row.last_line(&self.limits) {
            self.add_line(&line);
        }
    }

    /// Whether the motion comes near the end of the path, so that chords that wait would slow it down. At rest that
    /// counts only in a servo cycle.
    fn is_near_end(&self, in_cycle: bool) -> bool {
        let motion = &self.motion;
        if self.elements.end().saturating_sub(motion.at) > NEAR_END_ELEMENTS {
            return false;
        }
        let soft = self.limits.planned.iter().take(3).copied().fold(f64::INFINITY, math::min);
        let soon = NEAR_END_CYCLES * self.limits.cycle;
        let mut need = squared(motion.speed) / (2.0 * soft) + motion.speed * soon;
        if in_cycle {
            need += 0.5 * soft * squared(soon);
        }
        let mut left = -motion.x;
        for place in motion.at..self.elements.end() {
            left += self.elements.get(place).map_or(0.0, |element| element.length);
            if left > need {
                return false;
            }
        }
        in_cycle || need > 0.0
    }

    /// Ends the row when the motion comes near the end of the path: in each cycle a part of that work. Returns whether
    /// this cycle has done any.
    #[inline(never)]
    pub(super) fn end_row_in_cycles(&mut self) -> bool {
        if self.motion.work > ROW_CYCLE_WORK_MAX || self.aborting {
            return false;
        }
        match self.row_end {
            RowEnd::Open if self.row.is_empty() || !self.is_near_end(true) => return false,
            RowEnd::Open => self.row_end = RowEnd::Near,
            RowEnd::Near => {
                if let Some(line) = self.row.try_last_line(&self.limits) {
                    let moves = self.write_line(&line);
                    self.row_end = if moves { RowEnd::Written } else { RowEnd::Open };
                }
            }
            RowEnd::Written => {
                self.builder.find_corner(&self.limits);
                self.row_end = RowEnd::HasCorner(0);
            }
            RowEnd::HasCorner(waits)
                if self.motion.work > LINE_CYCLE_WORK_MAX && waits < LINE_CYCLES_MAX =>
            {
                self.row_end = RowEnd::HasCorner(waits.saturating_add(1));
                return false;
            }
            RowEnd::HasCorner(_) => self.add_written_line(),
        }
        true
    }

    /// Finds the last element that follows the spindle. A segment includes the corner before it, which is made with
    /// the next segment and again with the one after.
    fn note_spindle_sync(&mut self) {
        let end = self.elements.end();
        let follows = |place: &u64| {
            self.elements.get(*place).is_some_and(|p| p.feed_basis == FeedBasis::PerTurn)
        };
        if let Some(last) = (end.saturating_sub(ELEMENTS_PER_SEGMENT_MAX)..end).rev().find(follows)
        {
            self.spindle_sync_end = last.saturating_add(1);
        }
    }

    /// Drops elements that the motion passed long ago if the queue needs room.
    fn make_room(&mut self) {
        while self.elements.room() < 16
            && !self.retrace.is_requested()
            && !self.motion.is_reversed
            && self.elements.first().saturating_add(REVERSE_ELEMENTS_MIN) < self.motion.at
        {
            self.elements.drop_first();
        }
    }
}
