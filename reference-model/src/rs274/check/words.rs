//! Words that nothing in the block uses, and axes that the machine does not have.

use gaugeblock_vocabulary::{Axis, FaultKind};

use super::codes::has_later_codes;
use crate::ids::rule;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::programmed_motion::{is_arc, motion_of};
use crate::rs274::execute::{letter, whole};
use crate::rs274::modes::{ARC, Code, g_code, g_text, m_code, motion_code};
use crate::rs274::order::{has_axis_words, is_of_axis, moves_by_axis_words};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// Refuses words without a use. F, S, T and axis words need no code of their own, but for axis words beside G10 L0.
pub(super) fn check(words: &Words, state: &mut State) -> Result<(), StepError> {
    axes(words, state)?;
    polar(words)?;
    for letter in words.letters.keys().copied() {
        let itself = match letter {
            'f' | 's' | 't' => true,
            _ => is_of_axis(letter) && !beside_reload(letter, words, state),
        };
        if !itself && !is_used(letter, words, state) {
            state.dialect().check_unused(letter, words, state)?;
        }
    }
    state.coverage.accepted(rule::modal_groups::UNUSED_WORD);
    state.coverage.accepted(rule::modal_groups::UNUSED_ARC_WORD);
    if words.g_tenths.contains(&640)
        && words.letters.contains_key(&'q')
        && !words.letters.contains_key(&'p')
    {
        state.dialect().check_naive_cam_alone(state)?;
    }
    one_meaning_of_p(words, state)
}

/// Which words a code uses.
pub(crate) trait WordRules {
    /// Rule modal-groups.unused-word. A word without a use is refused.
    fn check_unused(
        &self,
        letter: char,
        words: &Words,
        state: &mut State,
    ) -> Result<(), StepError> {
        Err(unused(letter, words, state))
    }

    /// Rule modal-groups.unused-word. Whether a G code of the block, in tenths, uses a letter.
    fn is_used_by_g(&self, letter: char, code: u32, words: &Words, state: &State) -> bool {
        let kind = kind_of_offset_data(words);
        g_code(code).is_some_and(|code| code.words.contains(letter))
            && (code != 100 || state.dialect().is_used_by_offset_data(letter, kind, state))
    }

    /// Rule modal-groups.unused-word. Whether an M code of the block uses a letter.
    fn is_used_by_m(&self, letter: char, code: u32, _state: &State) -> bool {
        m_code(code).is_some_and(|code| code.words.contains(letter))
    }

    /// Rule modal-groups.unused-word. Whether G10 uses a letter: its L, which is the kind of its data, says which.
    fn is_used_by_offset_data(&self, letter: char, kind: Option<i32>, _state: &State) -> bool {
        let letters = match kind {
            Some(0) => "l",
            Some(1 | 10 | 11) => "lpqrij",
            Some(20) => "lp",
            _ => "lpr",
        };
        letters.contains(letter)
    }

    /// Rule path-control.naive-cam-alone. Q of G64 stands behind a P only.
    fn check_naive_cam_alone(&self, _state: &State) -> Result<(), StepError> {
        let message = "G64 with Q and without P";
        Err(refuse(rule::path_control::NAIVE_CAM_ALONE, FaultKind::MissingWord, message))
    }
}

/// P of one code is not that of another: seconds, a number of a coordinate system, a tolerance, a switch. No document
/// says whose it is when two codes of a block use it. M50 to M53 mean the same by it.
fn one_meaning_of_p(words: &Words, state: &State) -> Result<(), StepError> {
    if !words.letters.contains_key(&'p') {
        return Ok(());
    }
    let uses = |code: &&Code| code.words.contains('p');
    let by_g = words.g_tenths.iter().filter_map(|code| g_code(*code)).filter(uses).count();
    let by_m = words.m.iter().filter_map(|code| m_code(*code)).filter(uses).count();
    let without_code = !words.g_tenths.iter().any(|code| [20, 30].contains(code));
    let by_g = by_g + usize::from(without_code && by_arc('p', words, state));
    if by_g > 1 || by_g == 1 && by_m > 0 {
        let why = "two codes of the block use P, and nothing says whose it is";
        return Err(StepError::Unspecified(why.to_owned()));
    }
    Ok(())
}

/// Rule motion.no-such-axis. A letter of an axis that the machine does not have is refused, with G10 L2 too
/// (offsets.set-unknown-axis). Polar words stand for X and Y.
fn axes(words: &Words, state: &mut State) -> Result<(), StepError> {
    if !has_axis_words(words) {
        return Ok(());
    }
    let polar = words.letters.keys().any(|letter| matches!(letter, '@' | '^'));
    let absent = Axis::ALL.iter().find(|axis| {
        let by_angle = polar && matches!(axis, Axis::X | Axis::Y);
        let named = by_angle || words.letters.contains_key(&letter(**axis));
        named && !state.machine.axes.contains(axis)
    });
    let Some(axis) = absent else { return Ok(()) };
    let origin = words.g_tenths.contains(&100);
    let rule = if origin { rule::offsets::SET_UNKNOWN_AXIS } else { rule::motion::NO_SUCH_AXIS };
    let message = format!("the machine has no axis {}", axis.word().to_uppercase());
    Err(refuse(rule, FaultKind::NoSuchAxis, message))
}

/// Rule modal-groups.unused-word. A word needs a code of its block that uses it, or the motion mode where axis words
/// alone repeat it; $ serves S too.
///
/// Choice modal-groups.later-codes. Without the later codes no code uses $.
fn is_used(letter: char, words: &Words, state: &State) -> bool {
    if letter == '$' && !has_later_codes(state) {
        return false;
    }
    let serves_speed = letter == '$' && words.letters.contains_key(&'s');
    let repeated = moves_by_axis_words(words).then(|| motion_code(state.modes.motion));
    let mut by_g = words.g_tenths.iter().copied().chain(repeated);
    let mut by_m = words.m.iter().copied();
    serves_speed
        || by_g.any(|code| state.dialect().is_used_by_g(letter, code, words, state))
        || by_m.any(|code| state.dialect().is_used_by_m(letter, code, state))
        || by_arc(letter, words, state)
}

/// Whether an axis word stands beside G10 L0, which takes none, and beside no other code that uses it.
fn beside_reload(letter: char, words: &Words, state: &State) -> bool {
    let kind = kind_of_offset_data(words);
    if !words.g_tenths.contains(&100) || kind != Some(0) {
        return false;
    }
    let users =
        words.g_tenths.iter().filter_map(|code| g_code(*code)).filter(|code| code.axis_words);
    users.count() == 1 && !state.dialect().is_used_by_offset_data(letter, kind, state)
}

/// The L of G10.
fn kind_of_offset_data(words: &Words) -> Option<i32> {
    words.letters.get(&'l').copied().and_then(whole)
}

/// Rule motion.polar-moves-only. Polar words name a point that a move goes to, and no offset.
fn polar(words: &Words) -> Result<(), StepError> {
    if !words.letters.keys().any(|letter| matches!(letter, '@' | '^')) {
        return Ok(());
    }
    if words.g_tenths.iter().any(|code| [280, 300].contains(code)) {
        let why = "whether polar words can name the point by way of which G28 and G30 go";
        return Err(StepError::Unspecified(why.to_owned()));
    }
    if words.g_tenths.contains(&530) {
        let why = "what the angle and distance of polar words are in machine coordinates";
        return Err(StepError::Unspecified(why.to_owned()));
    }
    let offset = |code: &u32| [100, 431, 432, 520, 920].contains(code);
    let Some(code) = words.g_tenths.iter().find(|code| offset(code)) else { return Ok(()) };
    let message = format!("polar words with {}", g_text(*code));
    Err(refuse(rule::motion::POLAR_MOVES_ONLY, FaultKind::AxisWords, message))
}

/// Rule arcs.mode-holds. While G2 or G3 is in force, a block with axis words is an arc without a code.
fn by_arc(letter: char, words: &Words, state: &State) -> bool {
    ARC.contains(letter) && motion_of(words, state).is_some_and(is_arc)
}

/// The rule that refuses a word without a use: some chapters say it of a word of their own.
///
/// Rules modal-groups.unused-arc-word (I, J, K), spindle.unused-dollar, spindle.unused-limit (D), tool.unused-length
/// (H), path-control.unused-tolerance, overrides.both-unused-p, overrides.feed-takes-no-dollar.
fn unused(letter: char, words: &Words, state: &mut State) -> StepError {
    let m = |codes: &[u32]| words.m.iter().any(|code| codes.contains(code));
    let exact = words.g_tenths.iter().any(|code| [610, 611].contains(code));
    let rule = match letter {
        'i' | 'j' | 'k' => rule::modal_groups::UNUSED_ARC_WORD,
        'd' => rule::spindle::UNUSED_LIMIT,
        'h' => rule::tool::UNUSED_LENGTH,
        '$' if m(&[50, 52, 53]) => rule::overrides::FEED_TAKES_NO_DOLLAR,
        '$' => rule::spindle::UNUSED_DOLLAR,
        'p' | 'q' if exact => rule::path_control::UNUSED_TOLERANCE,
        'p' if m(&[48, 49]) => rule::overrides::BOTH_UNUSED_P,
        _ => rule::modal_groups::UNUSED_WORD,
    };
    if letter == 'p' {
        state.coverage.refused(rule::dwell::ONCE);
    }
    let message = format!("{} without a code that uses it", letter.to_uppercase());
    refuse(rule, FaultKind::UnusedWord, message)
}
