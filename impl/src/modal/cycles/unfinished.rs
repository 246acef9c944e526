//! Work of a block that may be more than a step does: it is done a bounded number of strokes at a time.

use gaugeblock_trace::Motion;

use crate::canon::Sink;
use crate::parameters::Numbered;

use super::super::Modal;
use super::super::coordinates::Coordinates;
use super::super::modes::Modes;
use super::super::refusal::{Flow, Refusal};
use super::series::Series;
use super::strokes::Drilling;
use super::threading::Threading;

/// Most strokes of a step.
const STROKES: u8 = 32;

/// What is being done.
#[derive(Clone, Copy, Debug)]
pub(super) enum Job {
    /// A canned cycle.
    Drilling(Drilling),
    /// G76.
    Threading(Threading),
}

/// The rest of a block.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Unfinished {
    line: u32,
    job: Job,
    /// The code of group 4 that comes after the motion.
    stop: Option<u16>,
    /// For a refusal by the outside.
    before: Before,
}

/// What a block's motion changes, as it was before.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Before {
    modes: Modes,
    motion: Motion,
    position: Coordinates,
    series: Series,
}

impl Modal {
    /// What the block's motion may change, as it is now.
    pub(in super::super) fn before(&self) -> Before {
        Before {
            modes: *self.in_force.now(),
            motion: self.motion,
            position: self.position,
            series: self.series,
        }
    }

    /// The block's motion has not been.
    #[cold]
    pub(in super::super) fn restore_motion(&mut self, before: &Before) {
        *self.in_force.set() = before.modes;
        self.motion = before.motion;
        self.position = before.position;
        self.series = before.series;
    }

    /// The block has work that is done in steps.
    pub(super) fn begin_job(&mut self, line: u32, job: Job, before: Before) {
        self.unfinished = Some(Unfinished { line, job, stop: None, before });
    }

    /// Gives up a block that is not finished: the point stays where it is, and overrides are as they were before the block.
    pub(in super::super) fn abandon(&mut self) {
        let Some(unfinished) = self.unfinished.take() else { return };
        let before = unfinished.before.modes;
        self.in_force.put(|modes| &mut modes.feed_override, before.feed_override);
        for (now, before) in self.in_force.set().spindles.iter_mut().zip(before.spindles) {
            now.speed_override = before.speed_override;
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
            return self.go_on(numbered, sink);
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
            match over {
                Ok(false) => {}
                Ok(true) => return self.finish(line, unfinished.stop, numbered, sink),
                Err(refusal) => {
                    self.restore_motion(&unfinished.before);
                    return Err(refusal);
                }
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
