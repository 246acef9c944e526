//! The operator's requests, and the controller's answers (11.6.2 to 11.6.4).
//!
//! | request | a program runs | it pauses | an MDI block runs | idle |
//! | --- | --- | --- | --- | --- |
//! | cycle start | open | goes on after M60, after M0 and M1 by option; open after a requested pause | open | starts |
//! | pause | pauses | nothing more | open | nothing |
//! | resume | nothing | goes on | open | nothing |
//! | abort | ends | ends | ends | as an abort leaves spindles and coolant |
//! | a mode | refused where it is another one | refused where it is another one | open | changes |
//! | an MDI block | refused | refused | open | executed in MDI mode, by option in manual mode |

use alloc::string::String;

use gaugeblock_vocabulary::scenario::Action;
use gaugeblock_vocabulary::{ControllerMode, Effect, Request};

use crate::faults::{PlantedFault, planted};

use super::IdleRequest;
use super::machine::Machine;
use super::state::{AbortCause, Pause, RunKind, TaskState};

impl<M: Machine> TaskState<M> {
    /// Handles a request while something is being executed.
    pub(super) fn handle_request(&mut self, action: Action) {
        if self.panel.apply(&action) {
            self.update_pins();
            return;
        }
        if self.run_kind == RunKind::Mdi && action != Action::Abort {
            self.leave_unspecified("a request while a block that was entered by hand is executed");
            return;
        }
        match action {
            Action::CycleStart => self.cycle_start(),
            Action::Pause => self.pause = self.pause.or(Some(Pause::Requested)),
            Action::Resume => self.pause = None,
            Action::Abort if planted(PlantedFault::AbortResumes) && self.pause.is_some() => {
                self.pause = None;
            }
            Action::Abort => self.abort_cause = Some(AbortCause::Operator),
            Action::Mode(ControllerMode::Auto) => {}
            Action::Mode(mode)
                if planted(PlantedFault::ModeWhilePaused) && self.pause.is_some() =>
            {
                self.change_mode(mode);
            }
            Action::Mode(_) => self.refuse(Request::Mode),
            Action::Mdi(_) => self.refuse(Request::Mdi),
            Action::OptionalStop(_)
            | Action::FeedOverride(_)
            | Action::RapidOverride(_)
            | Action::SpindleOverride { .. }
            | Action::FeedHold(_) => {}
        }
    }

    /// Cycle start while a program runs or pauses.
    fn cycle_start(&mut self) {
        match self.pause {
            Some(Pause::Pallets) => self.pause = None,
            Some(Pause::Stop) if self.choices.cycle_start_resumes => self.pause = None,
            Some(Pause::Stop) => self.refuse(Request::CycleStart),
            Some(Pause::Requested) | None => {
                self.leave_unspecified("cycle start while a program runs");
            }
        }
    }

    /// Handles a request to an idle controller; what it is to execute, if anything.
    pub(super) fn handle_idle_request(&mut self, action: Action) -> Option<IdleRequest> {
        if self.panel.apply(&action) {
            self.update_pins();
            return None;
        }
        match action {
            Action::CycleStart => return Some(IdleRequest::Start),
            Action::Abort => self.abort_cause = Some(AbortCause::Operator),
            Action::Mode(mode) => self.change_mode(mode),
            Action::Mdi(text) => match self.mode {
                ControllerMode::Mdi => return mdi_request(text),
                ControllerMode::Manual if self.choices.mdi_in_manual => {
                    // The mode changes before the block, which may be refused.
                    self.change_mode(ControllerMode::Mdi);
                    return mdi_request(text);
                }
                ControllerMode::Auto if planted(PlantedFault::EnteredInAuto) => {
                    return Some(IdleRequest::Mdi(text));
                }
                ControllerMode::Auto | ControllerMode::Manual => self.refuse(Request::Mdi),
            },
            // There is nothing to pause, and nothing that pauses.
            Action::Pause
            | Action::Resume
            | Action::OptionalStop(_)
            | Action::FeedOverride(_)
            | Action::RapidOverride(_)
            | Action::SpindleOverride { .. }
            | Action::FeedHold(_) => {}
        }
        None
    }

    /// Reports that the controller refuses a request.
    fn refuse(&mut self, request: Request) {
        let _reply = self.machine.perform(self.line, &Effect::RequestRefused { request });
    }

    /// Changes the mode of the controller.
    pub(super) fn change_mode(&mut self, mode: ControllerMode) {
        if self.mode != mode {
            self.mode = mode;
            let effect = Effect::ChangeControllerMode { mode };
            let _reply = self.machine.perform(self.line, &effect);
        }
    }
}

/// The request of an MDI block. A blank line is not a block: nothing is executed for it.
fn mdi_request(text: String) -> Option<IdleRequest> {
    let is_blank = text.bytes().all(|byte| matches!(byte, b' ' | b'\t' | b'\r' | b'\n'));
    (!is_blank).then_some(IdleRequest::Mdi(text))
}
