//! How a run ends, and what the block did that it ended with.

use gaugeblock_adapter::HarnessError;
use gaugeblock_vocabulary::{Bound, Effect, End, Event, Fault, FaultKind};

use super::super::stream::Item;
use super::{Assembly, is_end, unreadable};
use crate::instrumentation::checkpoint::Checkpoint;
use crate::instrumentation::faults;
use crate::instrumentation::source::{Form, form};

impl Assembly<'_> {
    /// The checkpoint after the end. Blocks by hand have one before the driver enters another block; a program end among
    /// them shows only once a program begins.
    pub(super) fn state_after<'a>(&self, after: &'a [Item]) -> Option<&'a Checkpoint> {
        let mut checkpoints = after.iter().filter_map(Item::checkpoint);
        if self.by_hand && self.issued.iter().any(is_end) {
            return checkpoints.next_back();
        }
        checkpoints.next()
    }

    /// How the run ended, and its last block.
    ///
    /// # Errors
    /// Nothing reports how it ended, or an error message is unknown.
    pub(super) fn end(&mut self, after_end: Option<&Checkpoint>) -> Result<End, HarnessError> {
        if let Some(end) = self.end_by_status()? {
            return Ok(end);
        }
        if let Some(fault) = self.refused.take() {
            return Ok(End::Fault(fault));
        }
        if self.aborted || self.has_ended {
            self.ends_before(after_end)?;
            return Ok(if self.aborted { End::Aborted } else { End::ProgramEnd });
        }
        if self.issued.iter().any(is_end) {
            let Some(checkpoint) = after_end else {
                return Err(unreadable("an end without its state"));
            };
            let (printed, issued) =
                (std::mem::take(&mut self.printed), std::mem::take(&mut self.issued));
            let events = self.events(printed, &issued, checkpoint)?;
            self.program_ended(checkpoint, events)?;
            return Ok(End::ProgramEnd);
        }
        if let Some(message) = self.stopped.take() {
            self.unfinished(after_end)?;
            return self.machine_fault(message);
        }
        if self.steps.next_form() == Form::Percent {
            self.ends_before(after_end)?;
            return Ok(End::PercentEnd);
        }
        // By hand there is always another block to wait for.
        let waits = self.by_hand && self.read.is_empty() && self.marked.is_empty();
        if self.asked_for_mode || waits {
            self.ends_before(after_end)?;
            return Ok(if self.asked_for_mode { End::Aborted } else { End::Paused });
        }
        Err(unreadable("a run without an end"))
    }

    /// How a run ended that the controller does not end itself.
    fn end_by_status(&mut self) -> Result<Option<End>, HarnessError> {
        Ok(match self.ends.as_deref() {
            Some("budget") => Some(End::BudgetExhausted { bound: Bound::Steps }),
            Some("endless") => {
                self.steps.leave_out_more_turns();
                Some(End::Endless)
            }
            Some(word @ ("paused" | "held")) => {
                self.paused(word == "held")?;
                Some(End::Paused)
            }
            _ => None,
        })
    }

    /// The program ended, in the mode that the controller was in then.
    pub(super) fn program_ended(
        &mut self,
        checkpoint: &Checkpoint,
        events: Vec<Event>,
    ) -> Result<(), HarnessError> {
        let mode = self.steps.mode;
        self.steps.mode = self.mode_at_end.or(mode);
        self.steps.record_end(checkpoint, None, events, self.canon.tool)?;
        self.steps.mode = mode;
        Ok(())
    }

    /// The block at which the run pauses: what it did, and no state, since it is not over. The move that is held and
    /// those that are queued after it have not been made.
    fn paused(&mut self, is_held: bool) -> Result<(), HarnessError> {
        let Some(next) = self.steps.next() else { return Ok(()) };
        let issued = std::mem::take(&mut self.issued);
        let events = if let Some((printed, checkpoint)) = self.read.pop_front() {
            self.events(printed, &issued, &checkpoint)?
        } else {
            for effect in std::mem::take(&mut self.printed) {
                self.canon.push(effect);
            }
            for issued in &issued {
                self.canon.issue(issued)?;
            }
            self.canon.take_events()
        };
        let mut events = events;
        if is_held {
            let kinds: Vec<u64> = events.iter().filter_map(kind_of_move).collect();
            // The move before the one that is held may be in the queue still.
            let first = kinds.len().saturating_sub(self.queued_moves);
            let held = kinds.iter().skip(first).position(|kind| *kind == self.moves_as);
            let mut left = first + held.unwrap_or_default();
            let mut has_stopped = false;
            events.retain(|event| {
                let is_move = kind_of_move(event).is_some();
                has_stopped |= is_move && left == 0;
                left = left.saturating_sub(usize::from(is_move));
                !has_stopped || !is_move && !matches!(event, Event::Set(_))
            });
        }
        self.steps.step(next, events, None);
        Ok(())
    }

    /// An abort broke a block off. What it did itself is not recorded; what was in force afterwards is, and what the
    /// controller refused meanwhile.
    pub(super) fn aborted(&mut self, events: Vec<Event>) {
        let stays = |event: &Event| {
            matches!(
                event,
                Event::Set(_)
                    | Event::Do(
                        Effect::RequestRefused { .. } | Effect::ChangeControllerMode { .. }
                    )
            )
        };
        let events: Vec<_> = events.into_iter().filter(stays).collect();
        // A call is recorded once it returns; a block that is broken off in its sub comes after it.
        let call = self.steps.entered_call();
        match self.steps.taken.last_mut().filter(|_| call.is_none()) {
            Some(last) => last.events.extend(events),
            None if events.is_empty() => {}
            None => {
                let block = call.or(self.steps.next()).unwrap_or((0, 1));
                self.steps.step(block, events, None);
            }
        }
    }

    /// The run was aborted, has ended before, or waits for another MDI block; what a checkpoint printed afterwards.
    fn ends_before(&mut self, after_end: Option<&Checkpoint>) -> Result<(), HarnessError> {
        let Some(checkpoint) = after_end else { return Ok(()) };
        let issued = std::mem::take(&mut self.issued);
        let events = self.events(Vec::new(), &issued, checkpoint)?;
        self.aborted(events);
        Ok(())
    }

    /// The block that was being carried out when the run stopped: its events and what was in force afterwards; no
    /// state.
    fn unfinished(&mut self, after_end: Option<&Checkpoint>) -> Result<(), HarnessError> {
        let (Some(next), Some(checkpoint)) = (self.steps.next(), after_end) else { return Ok(()) };
        let read = self.read.pop_front().map(|(printed, _)| printed);
        let printed = read.unwrap_or_else(|| std::mem::take(&mut self.printed));
        let issued = std::mem::take(&mut self.issued);
        let events = self.events(printed, &issued, checkpoint)?;
        if !matches!(form(self.source.line(next.0, next.1)), Form::Empty) && !events.is_empty() {
            self.steps.step(next, events, None);
        }
        Ok(())
    }

    fn machine_fault(&self, message: String) -> Result<End, HarnessError> {
        let kind = if message.starts_with("user program") {
            FaultKind::UserCode
        } else if message.starts_with("wait for orient complete")
            || message.ends_with("during orient in progress")
        {
            FaultKind::Orient
        } else {
            faults::kind(&message).ok_or_else(|| HarnessError::UnknownMessage(message.clone()))?
        };
        let block = self.steps.taken.last().map(|step| step.block.clone());
        Ok(End::Fault(Fault { kind: Some(kind), block, span: None, message }))
    }
}

/// The kind of a move, as the controller numbers them.
fn kind_of_move(event: &Event) -> Option<u64> {
    let Event::Do(effect) = event else { return None };
    match effect.name() {
        "straight_traverse" => Some(1),
        "straight_feed" => Some(2),
        "arc_feed" => Some(3),
        _ => None,
    }
}
