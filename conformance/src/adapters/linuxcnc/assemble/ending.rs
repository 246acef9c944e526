//! How a run ends, and what the block did that it ended with.

use gaugeblock_trace::{Bound, Effect, End, Event, Fault, FaultKind, Position, Rs274State, State};

use super::{Assembly, is_end, unreadable};
use crate::adapters::HarnessError;
use crate::adapters::linuxcnc::stream::Issued;
use crate::adapters::probing::probe::Probe;
use crate::adapters::probing::source::{Form, form};
use crate::adapters::probing::{faults, state};

impl Assembly<'_> {
    /// How the run ended, and its last block.
    ///
    /// # Errors
    /// Nothing tells how it ended, or an error message is unknown.
    pub(super) fn end(&mut self, after_end: Option<&Probe>) -> Result<End, HarnessError> {
        match self.ends.as_deref() {
            Some("budget") => return Ok(End::BudgetExhausted { bound: Bound::Steps }),
            Some("endless") => return Ok(End::Endless),
            Some("paused") => {
                self.paused()?;
                return Ok(End::Paused);
            }
            _ => {}
        }
        if let Some(fault) = self.refused.take() {
            return Ok(End::Fault(fault));
        }
        if self.aborted {
            self.unfinished(after_end)?;
            return Ok(End::Aborted);
        }
        if self.issued.iter().any(is_end) {
            let Some(probe) = after_end else {
                return Err(unreadable("an end whose state was not shown"));
            };
            let (printed, issued) =
                (std::mem::take(&mut self.printed), std::mem::take(&mut self.issued));
            let events = self.events(printed, &issued, probe)?;
            self.ended(probe, events)?;
            return Ok(End::ProgramEnd);
        }
        if let Some(message) = self.stopped.take() {
            self.unfinished(after_end)?;
            return self.machine_fault(message);
        }
        if self.steps.next_form() == Form::Percent {
            return Ok(End::PercentEnd);
        }
        if self.asked_for_mode {
            self.unfinished(after_end)?;
            return Ok(End::Aborted);
        }
        Err(unreadable("a run without an end"))
    }

    /// The program ended, in the mode that the controller was in then.
    pub(super) fn ended(&mut self, probe: &Probe, events: Vec<Event>) -> Result<(), HarnessError> {
        let mode = self.steps.mode;
        self.steps.mode = self.mode_at_end.or(mode);
        self.steps.ended(probe, None, events, self.canon.tool)?;
        self.steps.mode = mode;
        Ok(())
    }

    /// The block at which the run pauses. Nothing can be asked of a program that pauses: of its state only what was read
    /// ahead is known, and else that it is as before.
    fn paused(&mut self) -> Result<(), HarnessError> {
        let Some(next) = self.steps.next() else { return Ok(()) };
        let issued = std::mem::take(&mut self.issued);
        if let Some((printed, probe)) = self.read.pop_front() {
            let events = self.events(printed, &issued, &probe)?;
            return self.steps.passed(&probe, events, self.canon.tool);
        }
        for effect in std::mem::take(&mut self.printed) {
            self.canon.push(effect);
        }
        for issued in &issued {
            self.canon.issue(issued)?;
        }
        let state = State::Rs274(Rs274State::default());
        self.steps.step(next, self.canon.take_events(), Some(state));
        Ok(())
    }

    /// The block that was being carried out when the run stopped: its events and what was in force afterwards; no state.
    fn unfinished(&mut self, after_end: Option<&Probe>) -> Result<(), HarnessError> {
        let (Some(next), Some(probe)) = (self.steps.next(), after_end) else { return Ok(()) };
        let read = self.read.pop_front().map(|(printed, _)| printed);
        let printed = read.unwrap_or_else(|| std::mem::take(&mut self.printed));
        let issued = std::mem::take(&mut self.issued);
        let state = after_stop(&issued);
        let mut events = self.events(printed, &issued, probe)?;
        let at = state::position(probe);
        // A move that was broken off has not been made, and a wait for an input has read nothing.
        events.retain(|event| !matches!(event, Event::Do(effect) if is_broken_off(effect, &at)));
        for event in &mut events {
            if let Event::Do(Effect::WaitInput { read, .. }) = event {
                *read = -1.0;
            }
        }
        if !matches!(form(self.source.line(next.0, next.1)), Form::Empty) && !events.is_empty() {
            self.steps.step(next, events, state);
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

/// A block that pauses is over when it does; of its state nothing more is known.
pub(super) fn after_stop(issued: &[Issued]) -> Option<State> {
    let is_stop = |issued: &Issued| {
        ["TASK_PLAN_PAUSE", "TASK_PLAN_OPTIONAL_STOP"].contains(&issued.name.as_str())
    };
    issued.iter().any(is_stop).then(|| State::Rs274(Rs274State::default()))
}

/// Whether a move did not reach its end.
fn is_broken_off(effect: &Effect, at: &Position) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() < 1e-5;
    let (Effect::StraightTraverse { end }
    | Effect::StraightFeed { end }
    | Effect::ArcFeed { end, .. }) = effect
    else {
        return false;
    };
    !end.to_array().into_iter().zip(at.to_array()).all(|(a, b)| near(a, b))
}
