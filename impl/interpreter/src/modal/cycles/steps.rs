//! Performs the pending work of a block in steps, a bounded number of moves at a time.

use crate::canon::Sink;
use crate::parameters::Numbered;

use super::super::Modal;
use super::super::refusal::{Flow, Refusal};
use super::super::snapshots::BlockSnapshot;
use super::pending::{Job, PendingBlock};

/// Most moves of a step.
const MOVES_PER_STEP: u8 = 32;

impl Modal {
    /// The block has work that is done in steps.
    pub(super) fn begin_job(&mut self, line: u32, job: Job) {
        self.pending = Some(PendingBlock { line, job, stop: None, before: None });
    }

    /// The block has a lathe cycle.
    pub(in super::super) fn begin_turning_job(&mut self, line: u32) {
        self.begin_job(line, Job::Turning);
    }

    /// Gives up a block that is not finished: the point stays where it is, and overrides are as they were before the
    /// cycle.
    pub(in super::super) fn abandon(&mut self) {
        self.turning = None;
        if let Some(PendingBlock { job: Job::Drilling(drilling), .. }) = self.pending.take() {
            self.restore_overrides(&drilling);
        }
    }

    /// The last phases of a block, after the motion: its pending work, then a stop or an end.
    pub(in super::super) fn after_motion<K: Sink>(
        &mut self,
        line: u32,
        stop: Option<u16>,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<Flow, Refusal> {
        if let Some(pending) = &mut self.pending {
            // `rs274` forgets it after a lathe cycle: no page yet, because no document mentions it.
            let is_kept = !self.emulates_rs274 || !matches!(pending.job, Job::Turning);
            pending.stop = stop.filter(|_| is_kept);
            return self.continue_pending(numbered, sink);
        }
        self.finish(line, stop, numbered, sink)
    }

    /// Continues a block that is not finished.
    #[inline(never)]
    pub(crate) fn resume_block<K: Sink>(
        &mut self,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<Flow, Refusal> {
        let Some(before) = self.pending.as_ref().and_then(|pending| pending.before) else {
            return Ok(Flow::More);
        };
        let flow = self.continue_pending(numbered, sink);
        self.end_step(before, flow, numbered)
    }

    /// Gives up a block while its profile is read: it is rolled back.
    #[cold]
    pub(crate) fn abandon_profile(&mut self, numbered: &mut Numbered) {
        if let Some(before) = self.pending.take().and_then(|pending| pending.before) {
            self.roll_back(&before, numbered);
        }
        self.turning = None;
        numbered.end_notes();
    }

    /// After a step of a block that can be refused: the block is rolled back, or done, or can still be refused in a
    /// later step.
    #[inline]
    pub(in super::super) fn end_step(
        &mut self,
        before: BlockSnapshot,
        flow: Result<Flow, Refusal>,
        numbered: &mut Numbered,
    ) -> Result<Flow, Refusal> {
        match &flow {
            Err(Refusal::Aborted) => {
                if self.pending.is_some() {
                    self.abandon();
                    self.motion = before.motion();
                }
            }
            // The block has been executed up to its probe.
            Err(Refusal::Missed) => {}
            Err(_) => {
                (self.pending, self.turning) = (None, None);
                self.roll_back(&before, numbered);
            }
            Ok(Flow::Within { .. }) => {
                if let Some(pending) = &mut self.pending {
                    pending.before = Some(before);
                }
                return flow;
            }
            Ok(Flow::More | Flow::Stopped | Flow::Ended) => {}
        }
        numbered.end_notes();
        flow
    }

    /// Performs the moves of one step.
    fn continue_pending<K: Sink>(
        &mut self,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<Flow, Refusal> {
        let Some(mut pending) = self.pending.take() else { return Ok(Flow::More) };
        for _ in 0..MOVES_PER_STEP {
            if self.stop_asked || self.profile_stage().is_some() {
                break;
            }
            let line = pending.line;
            let over = match &mut pending.job {
                Job::Drilling(drilling) => self.perform_cycle_move(drilling, line, sink),
                Job::Threading(threading) => self.pass(threading, line, sink),
                Job::Turning => self.perform_lathe_cycle(line, sink),
            };
            if matches!(over, Err(Refusal::Aborted)) {
                self.pending = Some(pending);
            }
            if over? {
                return self.finish(line, pending.stop, numbered, sink);
            }
        }
        let stopped = self.stop_asked;
        self.stop_asked = false;
        self.pending = Some(pending);
        Ok(Flow::Within { stopped })
    }

    fn finish<K: Sink>(
        &mut self,
        line: u32,
        stop: Option<u16>,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<Flow, Refusal> {
        let ended = stop.map_or(Ok(false), |code| self.stop(code, line, numbered, sink))?;
        self.report(line, sink);
        Ok(match (ended, self.stop_asked) {
            (true, _) => Flow::Ended,
            (false, true) => Flow::Stopped,
            (false, false) => Flow::More,
        })
    }
}
