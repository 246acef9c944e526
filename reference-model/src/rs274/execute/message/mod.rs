//! Active comments.

mod expand;
mod keyword;
#[cfg(test)]
mod tests;

use gaugeblock_vocabulary::{Channel, Effect, FaultKind};

use crate::Choices;
use crate::ids::{choice, rule};
use crate::rs274::parameters::{self, Name};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::syntax::Comment;
use crate::rs274::task::Record;
use expand::{expand, shown_value};
use keyword::{Active, active};

/// Operations on active comments that a dialect can replace.
pub(crate) trait MessageRules {
    /// Rule active-comments.msg-spelling. The keyword before a comma, in lower case and without its blanks.
    fn keyword(&self, before: &str, _choices: &Choices) -> String {
        keyword::spelled(before)
    }

    /// Rule active-comments.log-closed. Whether LOG writes.
    fn log_is_open(&self, state: &State) -> bool {
        state.log_open
    }

    /// Rule active-comments.long-format. Whether %lf is a format.
    fn has_long_format(&self, _choices: &Choices) -> bool {
        true
    }

    /// Rule active-comments.wrong-format. An invalid format is printed as it is written, with its percent sign.
    fn drops_percent_sign(&self, _text: &str, _choices: &Choices) -> bool {
        false
    }

    /// Rule active-comments.numbered. The text after a #0, which is not a parameter, where it is shown as zero: it is
    /// not.
    fn parameter_zero<'a>(&self, _text: &'a str, _choices: &Choices) -> Option<&'a str> {
        None
    }

    /// Rule active-comments.numbered. The value that is printed for a parameter.
    fn reported_value(&self, value: f64, _choices: &Choices) -> f64 {
        value
    }
}

/// Whether a comment does something.
pub(crate) fn is_active(comment: &str, choices: &Choices) -> bool {
    active(comment, choices).is_some()
}

/// Whether a comment is a message, MSG.
pub(crate) fn is_message(comment: &str, choices: &Choices) -> bool {
    active(comment, choices).is_some_and(|(active, _)| active == Active::Message)
}

/// Says what an active comment says, before anything of its block is done.
///
/// Rule active-comments.plain. A comment that is none of the active ones does nothing.
/// Rule active-comments.message-first. The message of a line comes before what its words do.
///
/// # Errors
/// Rule active-comments.abort. ABORT ends the program with its text as an error, with the values of parameters in it.
pub fn perform(comment: &Comment, state: &mut State, record: &mut Record) -> Result<(), StepError> {
    let Some((active, text)) = active(&comment.text, &state.choices) else {
        state.coverage.accepted(if keyword::has_msg_inside(&comment.text) {
            rule::active_comments::MSG_FIRST
        } else {
            rule::active_comments::PLAIN
        });
        return Ok(());
    };
    if active != Active::Abort {
        state.coverage.accepted(active.rule());
        state.coverage.accepted(rule::active_comments::MESSAGE_FIRST);
    }
    match active {
        Active::Message => msg(text, state, record),
        Active::Debug => debug(text, state, record)?,
        Active::Print => say(Channel::Print, text, state, record)?,
        Active::Log => log(text, state, record)?,
        Active::LogOpen | Active::LogAppend => {
            state.log_open = true;
            let append = active == Active::LogAppend;
            // Choice active-comments.file-name-blanks.
            let whole = state.choices.is(choice::active_comments::FileNameBlanks::PartOfIt);
            let name = if whole { text } else { text.trim_matches(keyword::is_blank) };
            record.effect(state, Effect::LogOpen { file: name.to_owned(), append });
        }
        Active::LogClose => {
            let open = state.dialect().log_is_open(state);
            state.log_open = false;
            if open {
                record.effect(state, Effect::LogClose {});
            }
        }
        Active::ProbeOpen => {
            state.probe_log_open = true;
            record.effect(
                state,
                Effect::ProbeLogOpen { file: text.trim_matches(keyword::is_blank).to_owned() },
            );
        }
        Active::ProbeClose => {
            if std::mem::replace(&mut state.probe_log_open, false) {
                record.effect(state, Effect::ProbeLogClose {});
            }
        }
        Active::Abort => {
            let message = expand(text, state)?;
            return Err(refuse(rule::active_comments::ABORT, FaultKind::AbortedByProgram, message));
        }
    }
    Ok(())
}

/// Rule active-comments.msg. MSG and a comma at the beginning of a comment display the rest of it.
/// Rule active-comments.msg-verbatim. The text is displayed unchanged; parameters are not replaced.
fn msg(text: &str, state: &mut State, record: &mut Record) {
    state.coverage.accepted(rule::active_comments::MSG_VERBATIM);
    state.coverage.accepted(rule::active_comments::MSG_SPELLING);
    record.effect(state, Effect::Message { channel: Channel::Display, text: text.to_owned() });
}

/// Rule active-comments.debug. DEBUG displays a message with the values of parameters in it.
/// Rule parameters.debug-switch. While 5599 is 0 the DEBUG comments say nothing.
fn debug(text: &str, state: &mut State, record: &mut Record) -> Result<(), StepError> {
    state.coverage.accepted(rule::parameters::DEBUG_SWITCH);
    let switch = shown_value(&Name::Numbered(parameters::DEBUG_SWITCH), state)?;
    if switch.abs() > 0.0 { say(Channel::Display, text, state, record) } else { Ok(()) }
}

/// Rule active-comments.log. LOG writes what follows its comma to the open log file.
/// Rule active-comments.log-closed. LOG writes nothing while no log file is open.
fn log(text: &str, state: &mut State, record: &mut Record) -> Result<(), StepError> {
    state.coverage.accepted(rule::active_comments::LOG_CLOSED);
    if state.dialect().log_is_open(state) {
        return say(Channel::Log, text, state, record);
    }
    Ok(())
}

/// Rule active-comments.print. PRINT writes a message with the values of parameters in it.
fn say(
    channel: Channel,
    text: &str,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    let text = expand(text, state)?;
    record.effect(state, Effect::Message { channel, text });
    Ok(())
}
