//! The end of a compensated path: what waits is put out where no next move is known.

use gaugeblock_vocabulary::{Compensation, FaultKind, Motion};

use crate::canon::Sink;

use super::super::Modal;
use super::super::refusal::{Refusal, refuse};

impl Modal {
    /// Puts out what waits, because a stop or an end comes before the next move. The last move ends where its own
    /// curve does.
    pub(in super::super) fn finish_waiting<K: Sink>(
        &mut self,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        if !self.compensation.waits() {
            return Ok(());
        }
        if let Some(last) = &self.compensation.path.last {
            last.check_fit(last.end)?;
        }
        self.put_out(None, sink)
    }

    /// A move of G0 to G3 or G33 without compensation: the first one after a compensated path is not an arc (11.5.25).
    pub(in super::super) fn leave_path(&mut self) -> Result<(), Refusal> {
        if !self.compensation.path.exit_due || self.active.now().compensation != Compensation::Off {
            return Ok(());
        }
        if matches!(self.motion, Motion::ArcClockwise | Motion::ArcCounterclockwise) {
            return refuse(FaultKind::Gouging, "an arc as the first move after G40");
        }
        self.compensation.path_mut().exit_due = false;
        self.note_compensation();
        Ok(())
    }

    /// Ends the path: the programmed point is current again (11.5.25).
    pub(in super::super) fn end_path<K: Sink>(&mut self, sink: &mut K) -> Result<(), Refusal> {
        self.finish_waiting(sink)?;
        if let Some(last) = self.compensation.path_mut().last.take() {
            self.position = self.position.with_in_plane(last.plane, last.segment.to);
        }
        Ok(())
    }
}
