//! M100 to M199.

use gaugeblock_vocabulary::{Effect, FaultKind};

use super::{pass, word};
use crate::ids::{choice, rule};
use crate::rs274::environment::Missing;
use crate::rs274::evaluate::Words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// Runs the program of a user-defined code.
///
/// Rule user-codes.run. The program of that name gets P and Q as its two arguments (user-codes.arguments).
/// Rule user-codes.waits. The next thing is executed when it has ended.
/// Rule user-codes.under-compensation. It is allowed while cutter compensation is on.
///
/// # Errors
/// The rule that says why there is no such program; rule user-codes.exit-status.
pub fn perform(
    code: u32,
    words: &Words,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    let with_path = state.choices.is(choice::user_codes::Place::SearchPath);
    let found = state.environment.user_program(code, with_path);
    let found = found.map(|program| (program.duration, program.exit_status, program.folder));
    let (duration, exit_status, folder) = found.map_err(|missing| unknown(code, missing))?;
    let (p, q) = (argument('p', words, state), argument('q', words, state));
    for rule in [rule::user_codes::RUN, rule::user_codes::WAITS, rule::user_codes::UNKNOWN] {
        state.coverage.accepted(rule);
    }
    if folder == gaugeblock_vocabulary::scenario::Folder::SearchPath {
        state.coverage.accepted(rule::user_codes::PLACE);
    }
    if state.modes.compensation != gaugeblock_vocabulary::Compensation::Off {
        state.coverage.accepted(rule::user_codes::UNDER_COMPENSATION);
    }
    record.effect(state, Effect::UserCode { code, p, q });
    pass(duration, state);
    if exit_status == 0 {
        return Ok(());
    }
    let rule = rule::user_codes::EXIT_STATUS;
    if state.choices.is(choice::user_codes::ExitStatus::EndsTheRun) {
        let message = format!("the program of M{code} ended with status {exit_status}");
        return Err(refuse(rule, FaultKind::UserCode, message));
    }
    state.coverage.accepted(rule);
    Ok(())
}

/// Rule user-codes.arguments. An argument is the number as text.
/// Choice user-codes.missing-argument: the value that replaces a missing word.
fn argument(letter: char, words: &Words, state: &mut State) -> String {
    match word(words, letter) {
        Some(value) => {
            state.coverage.accepted(rule::user_codes::ARGUMENTS);
            format!("{value:.6}")
        }
        None => {
            state.coverage.accepted(rule::user_codes::MISSING_ARGUMENT);
            let minus_one = state.choices.is(choice::user_codes::MissingArgument::MinusOne);
            if minus_one { "-1.000000".to_owned() } else { String::new() }
        }
    }
}

/// Rules user-codes.unknown, user-codes.not-executable, user-codes.extension, user-codes.lower-case,
/// user-codes.file-name, user-codes.at-start, user-codes.place. Each way of not being there is the error of a code that
/// does not exist.
fn unknown(code: u32, missing: Missing) -> StepError {
    let (rule, why) = match missing {
        Missing::NoFile => (rule::user_codes::UNKNOWN, "there is no file of its name"),
        Missing::NotExecutable => (rule::user_codes::NOT_EXECUTABLE, "its file is not executable"),
        Missing::Extension => {
            (rule::user_codes::EXTENSION, "the name of its file has an extension")
        }
        Missing::LowerCase => (rule::user_codes::LOWER_CASE, "the name of its file has a small m"),
        Missing::OtherForm => {
            (rule::user_codes::FILE_NAME, "the name of its file has another form")
        }
        Missing::AddedLater => (rule::user_codes::AT_START, "its file came after the start"),
        Missing::Elsewhere => {
            (rule::user_codes::PLACE, "its file is in no folder that is searched")
        }
    };
    refuse(rule, FaultKind::UnknownCode, format!("there is no M{code}: {why}"))
}
