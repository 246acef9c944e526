//! Work of a block that may be more than a step does: it is done a bounded number of strokes at a time.

use crate::canon::Sink;
use crate::parameters::Numbered;

use super::super::Modal;
use super::super::refusal::{Flow, Refusal};
use super::super::snapshots::Before;
use super::pending::{Job, Unfinished};

/// Most strokes of a step.
const STROKES: u8 = 32;

impl Modal {
    /// The block has work that is done in steps.
    pub(super) fn begin_job(&mut self, line: u32, job: Job) {
        self.unfinished = Some(Unfinished { line, job, stop: None, before: None });
    }

    /// Gives up a block that is not finished: the point stays where it is, and overrides are as they were before the
    /// cycle.
    pub(in super::super) fn abandon(&mut self) {
        if let Some(Unfinished { job: Job::Drilling(drilling), .. }) = self.unfinished.take() {
            self.restore_overrides(&drilling);
        }
    }

    /// The last phases of a block, behind the motion: its unfinished work, then a stop or an end.
    pub(in super::super) fn after_motion<K: Sink>(
        &mut self,
        line: u32,
        stop: Option<u16>,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<Flow, Refusal> {
        if let Some(unfinished) = &mut self.unfinished {
            unfinished.stop = stop;
            return self.strokes(numbered, sink);
        }
        self.finish(line, stop, numbered, sink)
    }

    /// Goes on within a block that is not finished.
    #[inline(never)]
    pub(crate) fn go_on<K: Sink>(
        &mut self,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<Flow, Refusal> {
        let Some(before) = self.unfinished.as_ref().and_then(|unfinished| unfinished.before) else {
            return Ok(Flow::More);
        };
        let flow = self.strokes(numbered, sink);
        self.end_step(before, flow, numbered)
    }

    /// Behind a step of a block that can be refused: it is taken back, or done, or can still be refused in a later
    /// step.
    #[inline]
    pub(in super::super) fn end_step(
        &mut self,
        before: Before,
        flow: Result<Flow, Refusal>,
        numbered: &mut Numbered,
    ) -> Result<Flow, Refusal> {
        match &flow {
            Err(Refusal::Aborted) => {
                if self.unfinished.is_some() {
                    self.abandon();
                    self.motion = before.motion();
                }
            }
            // The block has been executed up to its probe.
            Err(Refusal::Missed) => {}
            Err(_) => {
                self.unfinished = None;
                self.take_back(&before, numbered);
            }
            Ok(Flow::Within { .. }) => {
                if let Some(unfinished) = &mut self.unfinished {
                    unfinished.before = Some(before);
                }
                return flow;
            }
            Ok(Flow::More | Flow::Stopped | Flow::Ended) => {}
        }
        numbered.end_notes();
        flow
    }

    /// Performs so many strokes as are a step.
    fn strokes<K: Sink>(&mut self, numbered: &mut Numbered, sink: &mut K) -> Result<Flow, Refusal> {
        let Some(mut unfinished) = self.unfinished.take() else { return Ok(Flow::More) };
        for _ in 0..STROKES {
            if self.stop_asked {
                break;
            }
            let line = unfinished.line;
            let over = match &mut unfinished.job {
                Job::Drilling(drilling) => self.stroke(drilling, line, sink),
                Job::Threading(threading) => self.pass(threading, line, sink),
            };
            if matches!(over, Err(Refusal::Aborted)) {
                self.unfinished = Some(unfinished);
            }
            if over? {
                return self.finish(line, unfinished.stop, numbered, sink);
            }
        }
        let stopped = self.stop_asked;
        self.stop_asked = false;
        self.unfinished = Some(unfinished);
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
        self.in_force.tell(line, sink);
        Ok(match (ended, self.stop_asked) {
            (true, _) => Flow::Ended,
            (false, true) => Flow::Stopped,
            (false, false) => Flow::More,
        })
    }
}
