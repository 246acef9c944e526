//! M70 to M73: saving and restoring the modal state.

use gaugeblock_vocabulary::FaultKind;

use super::compensation::{self, Surroundings};
use crate::ids::{Rule, choice, rule};
use crate::rs274::control::{Frame, Style};
use crate::rs274::evaluate::Words;
use crate::rs274::modes::{Modes, SavedState};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// Saves, invalidates or restores, after feed, speed and spindle words of the block and before everything else.
///
/// # Errors
/// Nothing to restore. Two of these codes in one block: the documents do not say which comes first.
pub fn perform(words: &Words, state: &mut State, record: &mut Record) -> Result<(), StepError> {
    let codes: Vec<u32> = words.m.iter().copied().filter(|code| (70..=73).contains(code)).collect();
    let [code] = codes[..] else {
        let why = "M70 to M73 are in no modal group, and nothing says which of two acts first";
        return Err(StepError::Unspecified(why.to_owned()));
    };
    match code {
        70 => {
            save(state);
            state.frame_mut().saved_by_m70 = state.frame().saved.clone();
        }
        71 => invalidate(state)?,
        72 => restore_explicitly(state, record)?,
        _ => {
            save(state);
            state.frame_mut().restore_at_return = state.frame().saved.clone();
            if state.call_level() == 0 {
                state.coverage.accepted(rule::saved_state::AUTORESTORE_MAIN);
            }
        }
    }
    Ok(())
}

/// Operations on the saved state that a dialect can replace.
pub(crate) trait SavedStateRules {
    /// M72 restores what is saved at its level, as the end of a sub with M73 does.
    fn restore_in_block(&self, saved: &Modes, state: &mut State) -> Result<(), StepError> {
        state.dialect().restore(saved, state)
    }
}

/// Rule saved-state.save-restore. M70 and M73 save the modal state at the current call level.
///
/// Rule saved-state.latest-save. A level has one place: a new save replaces the old one, and an invalid one too
/// (saved-state.saved-again).
fn save(state: &mut State) {
    let saved = SavedState { modes: state.modes.clone(), valid: true };
    let earlier = state.frame_mut().saved.replace(saved);
    if let Some(earlier) = earlier {
        let again = rule::saved_state::SAVED_AGAIN;
        state.coverage.accepted(if earlier.valid { rule::saved_state::LATEST_SAVE } else { again });
    }
    for rule in levels(state) {
        state.coverage.accepted(rule);
    }
}

/// The rules about the current call level.
///
/// Rule saved-state.main-level. The main program is a level of its own. Rule saved-state.sub-level. So is each
/// invocation of a sub; what it saved is gone when it is left. A recursive call is a new invocation
/// (saved-state.recursion), and a subprogram called by M98 is one too (saved-state.fanuc-level).
fn levels(state: &State) -> Vec<Rule> {
    let Some(call) = &state.frame().call else { return vec![rule::saved_state::MAIN_LEVEL] };
    let mut rules = vec![rule::saved_state::SUB_LEVEL];
    if matches!(call.style, Style::Numbered { .. }) {
        rules.push(rule::saved_state::FANUC_LEVEL);
    }
    let same = |label: &String| *label == call.label;
    let calls = state.frames.iter().filter_map(|frame| frame.call.as_ref());
    if calls.filter(|call| same(&call.label)).count() > 1 {
        rules.push(rule::saved_state::RECURSION);
    }
    rules
}

/// Choice saved-state.after-run. A run is over, or the next one begins: what the main program has saved holds on, or
/// it does not.
pub fn run_is_over(state: &mut State) {
    if state.choices.is(choice::saved_state::AfterRun::Forgotten) {
        state.frames[0].forget_saved();
    }
}

/// M71.
///
/// Rule saved-state.invalidated-level. The saved state of this level cannot be restored from any more; no other level
/// is touched. Rule saved-state.autorestore-cancelled. Nor does the end of the sub restore. Where M70 and M73 have
/// one place (saved-state.places) the promise stays, and waits for a valid state there.
fn invalidate(state: &mut State) -> Result<(), StepError> {
    let apart = state.choices.is(choice::saved_state::Places::Apart);
    let refused = state.choices.is(choice::saved_state::InvalidateNothing::Refused);
    let frame = state.frame_mut();
    let mut any = false;
    for saved in [&mut frame.saved_by_m70, &mut frame.saved].into_iter().flatten() {
        any |= saved.valid;
        saved.valid = false;
    }
    if !any && refused {
        let message = "M71 finds no valid saved state at this call level";
        return Err(refuse(
            Rule::of_choice::<choice::saved_state::InvalidateNothing>(),
            FaultKind::NothingSaved,
            message,
        ));
    }
    let promised = frame.restore_at_return.is_some();
    if apart {
        frame.restore_at_return = None;
    } else if let Some(restore) = &mut frame.restore_at_return {
        restore.valid = false;
    }
    state.coverage.accepted(rule::saved_state::INVALIDATED_LEVEL);
    if promised {
        state.coverage.accepted(rule::saved_state::AUTORESTORE_CANCELLED);
    }
    Ok(())
}

/// M72.
///
/// Rule saved-state.repeated-restore. The saved state is not used up.
/// Rule saved-state.autorestore-explicit. It may be one that M73 saved, under choice saved-state.restorable.
/// Rule saved-state.nothing-saved. Where nothing was saved at this level the restore is refused.
/// Rule saved-state.invalidated. And where what was saved is invalid.
fn restore_explicitly(state: &mut State, record: &mut Record) -> Result<(), StepError> {
    let saved = restorable(state);
    let Some(saved) = saved.as_ref().filter(|saved| saved.valid) else {
        let (rule, message) = if saved.is_some() {
            state.coverage.refused(rule::saved_state::INVALIDATED_LEVEL);
            let message = "M71 invalidated what was saved at this call level";
            (rule::saved_state::INVALIDATED, message)
        } else {
            (rule::saved_state::NOTHING_SAVED, "nothing is saved at this call level")
        };
        for level in
            levels(state).into_iter().filter(|level| *level != rule::saved_state::MAIN_LEVEL)
        {
            state.coverage.refused(level);
        }
        return Err(refuse(rule, FaultKind::NothingSaved, message));
    };
    state.coverage.accepted(rule::saved_state::SAVE_RESTORE);
    state.coverage.accepted(rule::saved_state::REPEATED_RESTORE);
    for level in levels(state) {
        state.coverage.accepted(level);
    }
    if state.frame().restore_at_return.is_some() {
        state.coverage.accepted(rule::saved_state::AUTORESTORE_EXPLICIT);
    }
    let along_path = Surroundings::of(state);
    state.dialect().restore_in_block(&saved.modes, state)?;
    compensation::restored(along_path, state, record)
}

/// Choice saved-state.restorable: what was saved last, or only where M70 did; where each code has its own place that
/// one.
fn restorable(state: &State) -> Option<SavedState> {
    let frame = state.frame();
    if state.choices.is(choice::saved_state::Restorable::Either) {
        return frame.saved.clone();
    }
    let one_place = state.choices.is(choice::saved_state::Places::One);
    let of_m70 = frame.saved_by_m70.as_ref()?;
    if one_place { frame.saved.clone() } else { Some(of_m70.clone()) }
}

/// Restores what M73 saved at this level, when the level is left by endsub, return or M99.
///
/// Rules saved-state.autorestore-endsub, saved-state.autorestore-return, saved-state.autorestore-m99. Whichever way
/// it is left, the state in force at the M73 comes back. Rule saved-state.autorestore-nested. Each level restores its
/// own caller's. Rules saved-state.autorestore-then-save, saved-state.cancelled-then-saved. Whether an M70 since
/// changes what comes back, and revives a restore that M71 cancelled, follows from a choice (saved-state.places).
/// Rule saved-state.unprotected. Without an M73 what the sub changed stays changed; an M70 alone restores nothing
/// (saved-state.save-alone).
///
/// # Errors
/// What the controller refuses to restore; by the documents that is nothing.
pub fn restore_at_return(state: &mut State, record: &mut Record) -> Result<(), StepError> {
    let frame = state.frame();
    let promised = if state.choices.is(choice::saved_state::Places::One) {
        latest_if_promised(frame)
    } else {
        frame.restore_at_return.clone()
    };
    let has_saved = frame.saved.as_ref().is_some_and(|saved| saved.valid);
    let saved_since = frame.saved != frame.restore_at_return;
    let cancelled = frame.restore_at_return.as_ref().is_some_and(|restore| !restore.valid);
    let Some(promised) = promised else {
        state.coverage.accepted(rule::saved_state::UNPROTECTED);
        state.coverage.accepted(rule::saved_state::SELECTIVE);
        if has_saved {
            state.coverage.accepted(rule::saved_state::SAVE_ALONE);
            state.coverage.accepted(rule::saved_state::CANCELLED_THEN_SAVED);
        }
        return Ok(());
    };
    let style = state.frame().call.as_ref().map(|call| call.style.clone());
    if matches!(style, Some(Style::Numbered { .. })) {
        state.coverage.accepted(rule::saved_state::AUTORESTORE_M99);
    } else {
        state.coverage.accepted(rule::saved_state::AUTORESTORE_ENDSUB);
        state.coverage.accepted(rule::saved_state::AUTORESTORE_RETURN);
    }
    if state.call_level() > 1 {
        state.coverage.accepted(rule::saved_state::AUTORESTORE_NESTED);
    }
    if saved_since {
        state.coverage.accepted(rule::saved_state::AUTORESTORE_THEN_SAVE);
    }
    if cancelled {
        state.coverage.accepted(rule::saved_state::CANCELLED_THEN_SAVED);
    }
    let along_path = Surroundings::of(state);
    state.dialect().restore(&promised.modes, state)?;
    compensation::restored(along_path, state, record)
}

/// Where M70 and M73 have one place: what was saved last there, if an M73 promised a restore.
fn latest_if_promised(frame: &Frame) -> Option<SavedState> {
    let saved = frame.saved.as_ref().filter(|saved| saved.valid);
    saved.filter(|_| frame.restore_at_return.is_some()).cloned()
}

/// Rule saved-state.autorestore-fault. A run that is broken off in a sub with M73 does not restore.
pub fn broken_off(state: &mut State) {
    if state.frames.iter().any(|frame| frame.restore_at_return.is_some()) {
        state.coverage.refused(rule::saved_state::AUTORESTORE_FAULT);
    }
}
