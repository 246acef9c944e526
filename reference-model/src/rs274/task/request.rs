//! What the controller does with a request of the operator, or refuses, by its mode and by what it is doing.

use gaugeblock_vocabulary::scenario::Action;
use gaugeblock_vocabulary::{ControllerMode, Effect, End, Request};

use super::operator::Happening;
use super::run::ModelRun;
use crate::ids::{choice, rule};
use crate::rs274::refusal::StepError;

/// What the controller is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Activity {
    /// It executes a block.
    Running,
    /// Its program pauses.
    Paused(By),
    /// Nothing.
    Idle,
}

/// By what a program pauses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum By {
    /// By M0 or M1.
    Stop,
    /// By M60.
    Pallets,
    /// By the operator.
    Operator,
}

/// What follows from a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Answer {
    /// Nothing more.
    Nothing,
    /// The program pauses.
    Pauses,
    /// The program goes on.
    GoesOn,
    /// The program begins at its first block.
    Begins,
    /// This block is executed, by its place among the events.
    Executes(usize),
}

impl ModelRun<'_> {
    /// Does what the operator requests. An encoder that answers at the same time does so afterwards.
    ///
    /// # Errors
    /// An abort of what is being executed; what the documents leave open.
    pub(super) fn request(
        &mut self,
        happening: Happening<'_>,
        activity: Activity,
    ) -> Result<Answer, StepError> {
        if self.record.waits() {
            let why = "what the operator does while a compensated move waits for the next one";
            return Err(StepError::Unspecified(why.to_owned()));
        }
        self.state.environment.is_asked(true);
        let answer = self.answer(happening, activity);
        self.state.environment.is_asked(false);
        answer
    }

    fn answer(
        &mut self,
        happening: Happening<'_>,
        activity: Activity,
    ) -> Result<Answer, StepError> {
        // A spindle may have reached its angle meanwhile.
        self.update_pins(None);
        let panel = &mut self.state.panel;
        match happening.action {
            Action::OptionalStop(on) => panel.optional_stop = *on,
            Action::FeedOverride(factor) => panel.feed_override = *factor,
            Action::RapidOverride(factor) => panel.rapid_override = *factor,
            Action::SpindleOverride { spindle, factor } => {
                if let Some(now) = panel.spindle_overrides.get_mut(usize::from(*spindle)) {
                    *now = *factor;
                }
                self.update_pins(None);
            }
            Action::FeedHold(pressed) => panel.feed_hold = *pressed,
            Action::Abort if activity == Activity::Idle => {
                self.forget_waiting();
                self.switch_off();
            }
            Action::Abort => return Err(StepError::Ended(End::Aborted)),
            Action::Pause => return self.pause(activity),
            Action::Resume => return self.resume(activity),
            Action::CycleStart => return self.cycle_start(activity),
            Action::Mode(mode) => self.change_mode(*mode, activity)?,
            Action::Mdi(_) => return self.enter(happening.place, activity),
        }
        Ok(Answer::Nothing)
    }

    /// A program that runs can be paused, and then goes on where it was.
    fn pause(&mut self, activity: Activity) -> Result<Answer, StepError> {
        if self.by_hand && activity == Activity::Running {
            return Err(self.open("a pause"));
        }
        Ok(if activity == Activity::Running { Answer::Pauses } else { Answer::Nothing })
    }

    /// Rule pause.resume. After a pause the program goes on at the following block.
    fn resume(&mut self, activity: Activity) -> Result<Answer, StepError> {
        if self.by_hand && activity == Activity::Running {
            return Err(self.open("resume"));
        }
        self.pause_asked = false;
        if !matches!(activity, Activity::Paused(_)) {
            return Ok(Answer::Nothing);
        }
        self.state.coverage.accepted(rule::pause::RESUME);
        Ok(Answer::GoesOn)
    }

    /// Cycle start.
    ///
    /// Rule pause.pallet-restart. After M60 it lets the program go on at the following block.
    /// Rule pause.cycle-start. Whether it does so after M0 and M1 is a choice.
    /// Rule program-end.restart. While nothing runs it starts the program at its first block.
    fn cycle_start(&mut self, activity: Activity) -> Result<Answer, StepError> {
        match activity {
            Activity::Running | Activity::Paused(By::Operator) => {
                return Err(self.open("cycle start"));
            }
            Activity::Idle => return Ok(Answer::Begins),
            Activity::Paused(By::Pallets) => {
                if self.state.dialect().goes_on_after_pallets(&self.state) {
                    self.state.coverage.accepted(rule::pause::PALLET_RESTART);
                    return Ok(Answer::GoesOn);
                }
            }
            Activity::Paused(By::Stop) => {
                let rule = rule::pause::CYCLE_START;
                if self.state.choices.is(choice::pause::CycleStart::GoesOn) {
                    self.state.coverage.accepted(rule);
                    return Ok(Answer::GoesOn);
                }
                self.state.coverage.refused(rule);
            }
        }
        Ok(self.refuse(Request::CycleStart))
    }

    /// Rules task.mode-kept and pause.mode-kept. While a program runs or pauses the controller remains in auto mode.
    fn change_mode(&mut self, mode: ControllerMode, activity: Activity) -> Result<(), StepError> {
        if self.by_hand && activity != Activity::Idle {
            return Err(self.open("a mode"));
        }
        if mode == self.state.modes.controller_mode {
            let is_running = activity == Activity::Running;
            return self.state.dialect().request_same_mode(is_running, &self.state);
        }
        if activity == Activity::Idle {
            self.state.coverage.accepted(rule::task::MODE_KEPT);
            self.change_mode_to(mode);
            return Ok(());
        }
        let paused = matches!(activity, Activity::Paused(_));
        self.state.coverage.refused(if paused {
            rule::pause::MODE_KEPT
        } else {
            rule::task::MODE_KEPT
        });
        self.refuse(Request::Mode);
        Ok(())
    }

    /// The controller changes its mode.
    pub(super) fn change_mode_to(&mut self, mode: ControllerMode) {
        if self.state.modes.controller_mode != mode {
            self.state.modes.controller_mode = mode;
            self.state.dialect().mode_has_changed(&mut self.state);
            self.record.effect(&mut self.state, Effect::ChangeControllerMode { mode });
        }
    }

    /// Rule task.auto-refuses-mdi. In auto mode no block can be entered by hand.
    ///
    /// Rule program-end.mdi-follows. After the program end, in MDI mode, it can. Rule pause.mdi-refused. Nor can it
    /// while a program pauses. Rule task.mdi-in-manual. Whether it can in manual mode is a choice; the controller
    /// changes to MDI mode by itself then.
    fn enter(&mut self, place: usize, activity: Activity) -> Result<Answer, StepError> {
        let mode = self.state.modes.controller_mode;
        let in_manual = rule::task::MDI_IN_MANUAL;
        let rule = match mode {
            ControllerMode::Mdi if activity == Activity::Idle => rule::task::AUTO_REFUSES_MDI,
            ControllerMode::Mdi => return Err(self.open("another block")),
            ControllerMode::Manual => in_manual,
            ControllerMode::Auto => rule::task::AUTO_REFUSES_MDI,
        };
        let allowed = mode == ControllerMode::Mdi
            || mode == ControllerMode::Manual
                && self.state.choices.is(choice::task::MdiInManual::Executed);
        if allowed {
            self.state.coverage.accepted(rule);
            self.state.coverage.accepted(rule::program_end::MDI_FOLLOWS);
            self.change_mode_to(ControllerMode::Mdi);
            return Ok(Answer::Executes(place));
        }
        self.state.coverage.refused(rule);
        if matches!(activity, Activity::Paused(_)) {
            self.state.coverage.refused(rule::pause::MDI_REFUSED);
        }
        Ok(self.refuse(Request::Mdi))
    }

    /// The controller refuses the request with a message.
    fn refuse(&mut self, request: Request) -> Answer {
        self.record.effect(&mut self.state, Effect::RequestRefused { request });
        Answer::Nothing
    }

    /// What no document settles.
    fn open(&self, what: &str) -> StepError {
        let doing = if self.by_hand { "a block entered by hand" } else { "a program" };
        StepError::Unspecified(format!("{what} is requested while {doing} is executed"))
    }
}
