//! M100 to M199.

use gaugeblock_vocabulary::{Effect, FaultKind};

use super::{pass, word};
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
    let with_path = state.choices.is("user-codes.place", "search-path");
    let found = state.environment.user_program(code, with_path);
    let found = found.map(|program| (program.duration, program.exit_status, program.folder));
    let (duration, exit_status, folder) = found.map_err(|missing| unknown(code, missing))?;
    let (p, q) = (argument('p', words, state), argument('q', words, state));
    for rule in ["user-codes.run", "user-codes.waits", "user-codes.unknown"] {
        state.coverage.accepted(rule);
    }
    if folder == gaugeblock_vocabulary::scenario::Folder::SearchPath {
        state.coverage.accepted("user-codes.place");
    }
    if state.modes.compensation != gaugeblock_vocabulary::Compensation::Off {
        state.coverage.accepted("user-codes.under-compensation");
    }
    record.effect(state, Effect::UserCode { code, p, q });
    pass(duration, state);
    if exit_status == 0 {
        return Ok(());
    }
    let rule = "user-codes.exit-status";
    if state.choices.is(rule, "ends-the-run") {
        let message = format!("the program of M{code} ended with status {exit_status}");
        return Err(refuse(rule, FaultKind::UserCode, message));
    }
    state.coverage.accepted(rule);
    Ok(())
}

/// Rule user-codes.arguments. An argument is the number as text.
/// Choice user-codes.missing-argument: what stands for a word that is not there.
fn argument(letter: char, words: &Words, state: &mut State) -> String {
    match word(words, letter) {
        Some(value) => {
            state.coverage.accepted("user-codes.arguments");
            format!("{value:.6}")
        }
        None => {
            state.coverage.accepted("user-codes.missing-argument");
            let minus_one = state.choices.is("user-codes.missing-argument", "minus-one");
            if minus_one { "-1.000000".to_owned() } else { String::new() }
        }
    }
}

/// Rules user-codes.unknown, user-codes.not-executable, user-codes.extension, user-codes.lower-case,
/// user-codes.file-name, user-codes.at-start, user-codes.place. Each way of not being there is the error of a code that
/// does not exist.
fn unknown(code: u32, missing: Missing) -> StepError {
    let (rule, why) = match missing {
        Missing::NoFile => ("user-codes.unknown", "there is no file of its name"),
        Missing::NotExecutable => ("user-codes.not-executable", "its file is not executable"),
        Missing::Extension => ("user-codes.extension", "the name of its file has an extension"),
        Missing::LowerCase => ("user-codes.lower-case", "the name of its file has a small m"),
        Missing::OtherForm => ("user-codes.file-name", "the name of its file has another form"),
        Missing::AddedLater => ("user-codes.at-start", "its file came after the start"),
        Missing::Elsewhere => ("user-codes.place", "its file is in no folder that is searched"),
    };
    refuse(rule, FaultKind::UnknownCode, format!("there is no M{code}: {why}"))
}
