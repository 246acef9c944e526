//! The subroutine with the profile of a lathe cycle: it runs as a call runs, and its moves are kept instead of made.

use std::sync::Arc;

use gaugeblock_vocabulary::FaultKind;

use super::run::ModelRun;
use crate::ids::rule;
use crate::rs274::control::{self, Control, Next};
use crate::rs274::evaluate::{self, Words};
use crate::rs274::execute::turning::{self, Reading};
use crate::rs274::refusal::{Refusal, StepError, refuse};
use crate::rs274::syntax;
use crate::rs274::text::Line;
use crate::rs274::turning::Profile;

impl ModelRun<'_> {
    /// Reads the profile of a lathe cycle.
    ///
    /// Rule turning.profile-subroutine. The subroutine Q is called without arguments where the cycle starts; O-words,
    /// expressions and parameters have their meaning in it.
    ///
    /// # Errors
    /// A subroutine that cannot be called. A block of the profile that is refused is the block of the fault.
    pub(super) fn read_profile(&mut self, words: &Words) -> Result<(), StepError> {
        let profile = self.state.profile.take().expect("program: the first motion has been made");
        let label = turning::called_label(words)?;
        let (place, line) = (self.control.place, self.state.line);
        let (position, motion) = (self.state.position, self.state.modes.motion);
        let mut reading = Reading::begin(profile.start, &mut self.state);
        let level = self.state.frames.len();
        let called = self.control.call_with(&label, &[], &mut self.state).map_err(unknown);
        self.go_to(called?);
        let mut left = self.scenario.budget.effects;
        while self.state.frames.len() > level {
            left = left.checked_sub(1).ok_or(StepError::TooManyEffects)?;
            self.read_line(&mut reading)?;
        }
        self.control.place = place;
        self.state.line = line;
        self.state.position = position;
        self.state.modes.motion = motion;
        self.state.profile = Some(Profile { moves: reading.into_moves(), ..profile });
        Ok(())
    }

    /// A line of the subroutine.
    fn read_line(&mut self, reading: &mut Reading) -> Result<(), StepError> {
        let place = self.control.place;
        self.state.line = place.line;
        let source = Arc::clone(self.control.files.source(place.file));
        let text = match self.control.files.line_of(&source, place.line, &mut self.state) {
            Some(Line::Block(text)) => text,
            Some(Line::Nothing | Line::Skipped(_)) => {
                self.control.place.line += 1;
                return Ok(());
            }
            Some(Line::End) => {
                let why = "a percent line that is reached in a subroutine".to_owned();
                return Err(StepError::Unspecified(why));
            }
            None => return Err(self.missing_end()),
        };
        let block = syntax::parse(text, &mut self.state)?;
        let next = if let Some(word) = &block.o_word {
            self.control.o_word(&block, word, &mut self.state, &mut self.record)?
        } else {
            let words = evaluate::words(&block, &mut self.state)?;
            if Control::asks(&words) {
                let why = "M98 or M99 in the profile of a lathe cycle".to_owned();
                return Err(StepError::Unspecified(why));
            }
            reading.block(&words, &mut self.state)?;
            control::assign(&words.settings, &mut self.state)?;
            Next::Following
        };
        self.go_to(next);
        Ok(())
    }

    fn go_to(&mut self, next: Next) {
        match next {
            Next::At(place) => self.control.place = place,
            Next::Following | Next::End(_) => self.control.place.line += 1,
        }
    }
}

/// Rule turning.profile-unknown. A subroutine that is not defined has no profile.
fn unknown(error: StepError) -> StepError {
    if let StepError::Refused(Refusal { kind: FaultKind::UnknownSub, message, .. }) = error {
        return refuse(rule::turning::PROFILE_UNKNOWN, FaultKind::UnknownSub, message);
    }
    error
}
