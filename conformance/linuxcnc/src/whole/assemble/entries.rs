//! Blocks that a person enters by hand while no program runs.
//!
//! The driver reports the settings before such a block and after it: the first checkpoint ends what came before, the
//! program's end among it.

use gaugeblock_adapter::HarnessError;
use serde_json::Value;

use super::entering::{Entering, block};
use super::{Assembly, is_end};
use crate::instrumentation::checkpoint::Checkpoint;

impl Assembly<'_> {
    /// The driver's word on a block that is entered.
    pub(super) fn entry(&mut self, moment: &str, report: &Value) {
        if moment == "begins" {
            let line =
                report.get("line").and_then(Value::as_u64).and_then(|line| line.try_into().ok());
            let text = report.get("text").and_then(Value::as_str).unwrap_or_default().to_owned();
            self.entering = line.map(|line| Entering::Before { line, text });
        } else if moment == "is over"
            && let Some(Entering::Block { line, text }) = self.entering.take()
        {
            self.entering = Some(Entering::After { line, text });
        }
    }

    /// A checkpoint before or after a block that is entered.
    pub(super) fn checkpoints_around_entry(
        &mut self,
        entering: Entering,
        checkpoint: &Checkpoint,
    ) -> Result<(), HarnessError> {
        let (printed, issued) =
            (std::mem::take(&mut self.printed), std::mem::take(&mut self.issued));
        match entering {
            Entering::Before { line, text } => {
                // What was read ahead is never carried out.
                self.read.clear();
                self.marked.clear();
                let events = self.events(printed, &issued, checkpoint)?;
                if issued.iter().any(is_end) {
                    self.program_ended(checkpoint, events)?;
                    self.has_ended = true;
                } else {
                    self.aborted(events);
                }
                self.entering = Some(Entering::Block { line, text });
            }
            Entering::Block { line, text } | Entering::After { line, text } => {
                let events = self.events_of(&text, printed, &issued, checkpoint)?;
                self.steps.record_mdi_block(block(line), checkpoint, events, self.canon.tool)?;
            }
        }
        Ok(())
    }
}
