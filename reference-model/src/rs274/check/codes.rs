//! Codes that do not exist, and codes that exclude each other.

use std::fmt;

use gaugeblock_vocabulary::FaultKind;

use crate::Choices;
use crate::ids::{Rule, choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::modes::{Code, ModalGroup, g_code, g_text, m_code};
use crate::rs274::order::has_axis_words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// Most M words of a block.
const MOST_M_WORDS: usize = 4;

/// Refuses unknown codes, too many of them, and codes that exclude each other.
pub(super) fn check(words: &Words, state: &mut State) -> Result<(), StepError> {
    count(words, state)?;
    let codes = known(words, state)?;
    groups(words, &codes, state)?;
    state.dialect().check_axis_words(words, &codes, state)?;
    length_off_alone(&codes, state)
}

/// Rule modal-groups.four-m-words. A block holds up to four M words.
fn count(words: &Words, state: &mut State) -> Result<(), StepError> {
    let rule = rule::modal_groups::FOUR_M_WORDS;
    if words.m.len() > MOST_M_WORDS {
        let message = format!("{} M words in a block", words.m.len());
        return Err(refuse(rule, FaultKind::TooManyMCodes, message));
    }
    state.coverage.accepted(rule);
    Ok(())
}

/// Which codes exclude each other.
pub(crate) trait CodeRules {
    /// The modal group of an M code.
    ///
    /// Rule modal-groups.override-group. Whether M50 to M53 belong to the group of M48 and M49 is a choice.
    /// Choice modal-groups.io-members: whether M62 to M68 exclude each other.
    fn group_of_m(&self, code: &Code, state: &State) -> Option<ModalGroup> {
        code.group.or_else(|| group_by_choice(code.number, &state.choices))
    }

    /// Rule modal-groups.one-of-each. A block may hold one of every group.
    fn exclude_each_other(&self, one: &Code, other: &Code, _state: &State) -> bool {
        one.group.is_some() && one.group == other.group
    }

    /// Rule modal-groups.motion-group. G80 and another code of the motion group exclude each other.
    fn cancel_excludes_motion(&self, _state: &State) -> bool {
        true
    }

    /// Rule modal-groups.axis-words-twice. The axis words of a block have one use.
    fn check_axis_words(
        &self,
        words: &Words,
        codes: &[(Written, Code)],
        state: &mut State,
    ) -> Result<(), StepError> {
        axis_words_once(words, codes, state)
    }

    /// Rule tool.dynamic-length-with-motion. A motion code and G43.1 exclude each other, and so do a motion code and
    /// the axis words of G43.2.
    fn dynamic_length_excludes_motion(&self, _state: &State) -> bool {
        true
    }
}

/// A code as it is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Written {
    /// A G code, in tenths.
    G(u32),
    /// An M code.
    M(u32),
}

impl fmt::Display for Written {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::G(number) => f.write_str(&g_text(*number)),
            Self::M(number) => write!(f, "M{number}"),
        }
    }
}

/// The codes of a block, each as it is written.
///
/// Rules modal-groups.g-code-out-of-range and modal-groups.m-code-out-of-range. G codes end at 99, M codes at 199.
/// Rules modal-groups.unknown-g-code and modal-groups.unknown-m-code. The language does not have every number below.
fn known(words: &Words, state: &mut State) -> Result<Vec<(Written, Code)>, StepError> {
    let mut codes = Vec::with_capacity(words.g_tenths.len() + words.m.len());
    for number in &words.g_tenths {
        let text = Written::G(*number);
        let rule = if *number > 999 {
            rule::modal_groups::G_CODE_OUT_OF_RANGE
        } else {
            state.coverage.accepted(rule::modal_groups::G_CODE_OUT_OF_RANGE);
            rule::modal_groups::UNKNOWN_G_CODE
        };
        let code = g_code(*number).ok_or_else(|| unknown(rule, text))?;
        state.coverage.accepted(rule);
        codes.push((text, *code));
    }
    for number in &words.m {
        let text = Written::M(*number);
        let out_of_range = *number > 199;
        let rule = if out_of_range {
            rule::modal_groups::M_CODE_OUT_OF_RANGE
        } else {
            rule::modal_groups::UNKNOWN_M_CODE
        };
        let is_later = matches!(number, 19 | 98 | 99) && !has_later_codes(state);
        let code = m_code(*number).filter(|_| !is_later).ok_or_else(|| unknown(rule, text))?;
        state.coverage.accepted(rule);
        let group = state.dialect().group_of_m(code, state);
        codes.push((text, Code { group, ..*code }));
    }
    Ok(codes)
}

/// Choice modal-groups.later-codes. Whether M19, M98, M99 and $ are in the language.
pub(crate) fn has_later_codes(state: &State) -> bool {
    state.choices.is(choice::modal_groups::LaterCodes::Known)
}

fn unknown(rule: Rule, text: Written) -> StepError {
    refuse(rule, FaultKind::UnknownCode, format!("there is no {text}"))
}

/// Two codes of one modal group exclude each other, whichever they are; the group's own rule refuses them.
///
/// Rule modal-groups.one-of-each. A block may hold one of every group.
/// Rule coolant.both-in-one-block. Whether M7 and M8 exclude each other is a choice.
fn groups(words: &Words, codes: &[(Written, Code)], state: &mut State) -> Result<(), StepError> {
    for (place, (text, code)) in codes.iter().enumerate() {
        let Some(group) = code.group else { continue };
        let mut before = codes.iter().take(place);
        let excludes =
            |(_, other): &&(_, Code)| state.dialect().exclude_each_other(other, code, state);
        if let Some((other, _)) = before.find(excludes) {
            conflict(group, (*other, *text), words, state)?;
        }
    }
    let in_groups = || codes.iter().filter_map(|(_, code)| code.group);
    for rule in in_groups().filter_map(ModalGroup::rule) {
        state.coverage.accepted(rule);
    }
    if in_groups().count() > 1 {
        state.coverage.accepted(rule::modal_groups::ONE_OF_EACH);
    }
    Ok(())
}

/// The group of an M code of which it is a choice whether it belongs to one.
fn group_by_choice(number: u32, choices: &Choices) -> Option<ModalGroup> {
    let (group, belongs) = match number {
        50..=53 => (ModalGroup::Overrides, choices.is(choice::modal_groups::OverrideMembers::All)),
        62..=68 => {
            (ModalGroup::InputsOutputs, choices.is(choice::modal_groups::IoMembers::Exclusive))
        }
        _ => return None,
    };
    belongs.then_some(group)
}

/// Refuses two codes of a group, unless a choice allows them.
///
/// Rule orient.group. M19 and M3, M4 or M5 are codes of one group.
fn conflict(
    group: ModalGroup,
    texts: (Written, Written),
    words: &Words,
    state: &mut State,
) -> Result<(), StepError> {
    let message = if texts.0 == texts.1 {
        format!("{} is programmed twice in the block", texts.0)
    } else {
        format!("{} and {} belong to one modal group: only one of them per block", texts.0, texts.1)
    };
    let mist_and_flood =
        group == ModalGroup::Coolant && !words.m.contains(&9) && texts.0 != texts.1;
    if mist_and_flood {
        let rule = rule::coolant::BOTH_IN_ONE_BLOCK;
        if state.choices.is(choice::coolant::BothInOneBlock::Accepted) {
            state.coverage.accepted(rule);
            return Ok(());
        }
        return Err(refuse(rule, FaultKind::ModalConflict, message));
    }
    let cancels = |text: Written| text == Written::G(800);
    let cancel = group == ModalGroup::Motion && (cancels(texts.0) || cancels(texts.1));
    if cancel && !state.dialect().cancel_excludes_motion(state) {
        return Ok(());
    }
    if group == ModalGroup::Spindle && [texts.0, texts.1].contains(&Written::M(19)) {
        state.coverage.refused(rule::orient::GROUP);
    }
    let rule = group.rule().unwrap_or(rule::modal_groups::ONE_OF_EACH);
    Err(refuse(rule, FaultKind::ModalConflict, message))
}

/// Rule modal-groups.axis-words-twice. A motion code and a non-modal code that both use axis words exclude each other.
/// Rule tool.dynamic-length-with-motion. So do a motion code and G43.1, and a motion code and the axis words of G43.2
/// (tool.additional-length-words); and G53 is a motion, by whatever code.
fn axis_words_once(
    words: &Words,
    codes: &[(Written, Code)],
    state: &mut State,
) -> Result<(), StepError> {
    let user = |group: ModalGroup| {
        codes.iter().find(|(_, code)| code.group == Some(group) && code.axis_words)
    };
    // The documents leave open whether G5.3 takes a point: its execution reports that.
    let motion = user(ModalGroup::Motion).filter(|(code, _)| *code != Written::G(53));
    let Some((motion, _)) = motion else {
        let offset = user(ModalGroup::ToolLength).filter(|_| has_axis_words(words));
        return match offset {
            Some((offset, _)) if words.g_tenths.contains(&530) => {
                let message = format!("G53 in a block with {offset}");
                Err(refuse(rule::tool::DYNAMIC_LENGTH_WITH_MOTION, FaultKind::AxisWords, message))
            }
            _ => Ok(()),
        };
    };
    if let Some((other, _)) = user(ModalGroup::NonModal) {
        let message = format!("{motion} and {other} both use the axis words");
        return Err(refuse(rule::modal_groups::AXIS_WORDS_TWICE, FaultKind::AxisWords, message));
    }
    state.coverage.accepted(rule::modal_groups::AXIS_WORDS_TWICE);
    match user(ModalGroup::ToolLength) {
        Some((Written::G(432), _)) if !has_axis_words(words) => Ok(()),
        Some((other, _)) if state.dialect().dynamic_length_excludes_motion(state) => {
            let message = format!("{motion} in a block with {other}");
            Err(refuse(rule::tool::DYNAMIC_LENGTH_WITH_MOTION, FaultKind::AxisWords, message))
        }
        _ => Ok(()),
    }
}

/// Rule tool.length-off-with-motion. Whether G49 and a code that uses axis words, a motion or of group 0, exclude each
/// other is a choice.
fn length_off_alone(codes: &[(Written, Code)], state: &mut State) -> Result<(), StepError> {
    let uses_axes = |(_, code): &&(Written, Code)| {
        code.axis_words && matches!(code.group, Some(ModalGroup::Motion | ModalGroup::NonModal))
    };
    let is_off = |(text, _): &(Written, Code)| *text == Written::G(490);
    let other = codes.iter().find(uses_axes).filter(|_| codes.iter().any(is_off));
    let Some((other, _)) = other else { return Ok(()) };
    let rule = rule::tool::LENGTH_OFF_WITH_MOTION;
    if state.choices.is(choice::tool::LengthOffWithMotion::Refused) {
        let message = format!("{other} in a block with G49");
        return Err(refuse(rule, FaultKind::AxisWords, message));
    }
    state.coverage.accepted(rule);
    Ok(())
}
