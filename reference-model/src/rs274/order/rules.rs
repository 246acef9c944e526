//! The rules of chapter `order`: which phase comes before which.
//!
//! The order itself is that of [`Phase`]; this table says which rule speaks about two phases that meet in a block.

use super::phase::Phase;
use super::phase::Phase as P;
use super::phase::Phases;
use crate::ids::{Rule, rule};
use crate::rs274::evaluate::Words;

/// A rule about two phases of one block.
#[derive(Clone, Copy, Debug)]
pub struct OrderRule {
    /// The rule.
    pub rule: Rule,
    /// The phases that come first.
    pub first: Phases,
    /// The phases that come later.
    pub later: Phases,
    /// Codes of the saved state phase that it is about; empty where that phase has no part in it.
    pub saved_state: &'static [u32],
    /// Whether it can refuse a block: what comes first makes impossible what comes later.
    pub refuses: bool,
}

impl OrderRule {
    /// Whether a block with these phases has some on both sides of the rule.
    #[inline]
    pub fn concerns(&self, words: &Words, phases: Phases) -> bool {
        let codes = self.saved_state;
        let saved_state = || codes.is_empty() || words.m.iter().any(|code| codes.contains(code));
        phases.meets(self.first) && phases.meets(self.later) && saved_state()
    }
}

/// A rule about two sets of phases.
const fn rule(rule: Rule, first: &'static [Phase], later: &'static [Phase]) -> OrderRule {
    OrderRule {
        rule,
        first: Phases::these(first),
        later: Phases::these(later),
        saved_state: &[],
        refuses: false,
    }
}

/// A rule that can refuse.
const fn refusing(rule: Rule, first: &'static [Phase], later: &'static [Phase]) -> OrderRule {
    OrderRule {
        rule,
        first: Phases::these(first),
        later: Phases::these(later),
        saved_state: &[],
        refuses: true,
    }
}

/// A rule about M70 and M73.
const fn save(rule: Rule, first: &'static [Phase], later: &'static [Phase]) -> OrderRule {
    OrderRule {
        rule,
        first: Phases::these(first),
        later: Phases::these(later),
        saved_state: &[70, 73],
        refuses: false,
    }
}

/// A rule about M72.
const fn restore(rule: Rule, first: &'static [Phase], later: &'static [Phase]) -> OrderRule {
    OrderRule {
        rule,
        first: Phases::these(first),
        later: Phases::these(later),
        saved_state: &[72],
        refuses: false,
    }
}

const FEED_AND_SPEED: &[Phase] = &[P::FeedMode, P::FeedRate, P::SpindleSpeed];
const SPINDLE: &[Phase] = &[P::FeedRate, P::SpindleSpeed, P::Spindle];
const BEFORE_SAVE: &[Phase] = &[P::FeedMode, P::FeedRate, P::SpindleSpeed, P::Spindle];
const MODES: &[Phase] = &[
    P::Plane,
    P::Units,
    P::Compensation,
    P::ToolLength,
    P::WorkOffset,
    P::Path,
    P::Distance,
    P::Retract,
];
const AFTER_SAVE: &[Phase] = &[
    P::Coolant,
    P::Overrides,
    P::Plane,
    P::Units,
    P::Compensation,
    P::ToolLength,
    P::WorkOffset,
    P::Path,
    P::Distance,
    P::Retract,
    P::Motion,
    P::Stop,
];

/// Every rule about the order of phases.
pub const ORDER_RULES: &[OrderRule] = &[
    rule(rule::order::COMMENT_FIRST, &[P::Comment], Phase::ALL.split_at(1).1),
    refusing(rule::order::COMPENSATION_BEFORE_TOOL_LENGTH, &[P::Compensation], &[P::ToolLength]),
    refusing(rule::order::COMPENSATION_BEFORE_WORK_OFFSET, &[P::Compensation], &[P::WorkOffset]),
    rule(rule::order::COOLANT_BEFORE_DWELL, &[P::Coolant], &[P::Dwell]),
    rule(rule::order::DISTANCE_BEFORE_MOTION, &[P::Distance], &[P::Motion]),
    rule(rule::order::DWELL_BEFORE_COMPENSATION, &[P::Dwell], &[P::Compensation]),
    rule(rule::order::DWELL_BEFORE_DISTANCE, &[P::Dwell], &[P::Distance, P::Retract]),
    rule(rule::order::DWELL_BEFORE_MOTION, &[P::Dwell], &[P::Motion]),
    rule(rule::order::DWELL_BEFORE_PATH, &[P::Dwell], &[P::Path]),
    rule(rule::order::DWELL_BEFORE_PLANE, &[P::Dwell], &[P::Plane]),
    rule(rule::order::DWELL_BEFORE_TOOL_LENGTH, &[P::Dwell], &[P::ToolLength]),
    rule(rule::order::DWELL_BEFORE_UNITS, &[P::Dwell], &[P::Units]),
    rule(rule::order::DWELL_BEFORE_WORK_OFFSET, &[P::Dwell], &[P::WorkOffset]),
    save(rule::order::FEED_AND_SPEED_BEFORE_SAVE, FEED_AND_SPEED, &[P::SavedState]),
    rule(rule::order::FEED_BEFORE_MOTION, &[P::FeedRate], &[P::Motion]),
    rule(rule::order::FEED_BEFORE_UNITS, &[P::FeedRate], &[P::Units]),
    rule(rule::order::FEED_MODE_BEFORE_FEED, &[P::FeedMode], &[P::FeedRate]),
    rule(rule::order::OFFSET_DATA_BEFORE_MOTION, &[P::OffsetData], &[P::Motion]),
    rule(rule::order::OUTPUTS_BEFORE_TOOL_CHANGE, &[P::InputsOutputs], &[P::ChangeTool]),
    rule(rule::order::OVERRIDES_BEFORE_DWELL, &[P::Overrides], &[P::Dwell]),
    rule(rule::order::OVERRIDES_BEFORE_USER_CODE, &[P::Overrides], &[P::UserCode]),
    rule(rule::order::PATH_BEFORE_MOTION, &[P::Path], &[P::Motion]),
    refusing(rule::order::PLANE_BEFORE_COMPENSATION, &[P::Plane], &[P::Compensation]),
    rule(rule::order::PLANE_BEFORE_MOTION, &[P::Plane], &[P::Motion]),
    restore(rule::order::RESTORE_BEFORE_COOLANT, &[P::SavedState], &[P::Coolant]),
    restore(rule::order::RESTORE_BEFORE_MODES, &[P::SavedState], MODES),
    restore(rule::order::RESTORE_BEFORE_OVERRIDES, &[P::SavedState], &[P::Overrides]),
    rule(rule::order::RETURN_MODE_BEFORE_MOTION, &[P::Retract], &[P::Motion]),
    save(rule::order::SAVE_BEFORE_COOLANT, &[P::SavedState], &[P::Coolant]),
    save(rule::order::SAVE_BEFORE_MODES, &[P::SavedState], MODES),
    save(rule::order::SAVE_BEFORE_OVERRIDES, &[P::SavedState], &[P::Overrides]),
    rule(rule::order::SELECT_BEFORE_OUTPUTS, &[P::SelectTool], &[P::InputsOutputs]),
    rule(rule::order::SELECT_BEFORE_TOOL_CHANGE, &[P::SelectTool], &[P::ChangeTool]),
    rule(rule::order::SPEED_BEFORE_SPINDLE, &[P::SpindleSpeed], &[P::Spindle]),
    rule(rule::order::SPINDLE_BEFORE_DWELL, SPINDLE, &[P::Dwell]),
    restore(rule::order::SPINDLE_BEFORE_RESTORE, SPINDLE, &[P::SavedState]),
    save(rule::order::SPINDLE_BEFORE_SAVE, &[P::Spindle], &[P::SavedState]),
    rule(rule::order::STOP_LAST, Phase::ALL.split_at(Phase::ALL.len() - 1).0, &[P::Stop]),
    rule(rule::order::TOOL_CHANGE_BEFORE_SPINDLE, &[P::ChangeTool], &[P::Spindle]),
    rule(rule::order::TOOL_LENGTH_BEFORE_MOTION, &[P::ToolLength], &[P::Motion]),
    rule(rule::order::UNITS_BEFORE_MOTION, &[P::Units], &[P::Motion]),
    rule(rule::order::UNITS_BEFORE_OFFSET_DATA, &[P::Units], &[P::OffsetData]),
    rule(rule::order::UNITS_BEFORE_PATH, &[P::Units], &[P::Path]),
    rule(rule::order::UNITS_BEFORE_TOOL_LENGTH, &[P::Units], &[P::ToolLength]),
    rule(rule::order::USER_CODE_BEFORE_MODES, &[P::UserCode], MODES),
    rule(rule::order::WORK_OFFSET_BEFORE_MOTION, &[P::WorkOffset], &[P::Motion]),
    rule(rule::order::WORK_OFFSET_BEFORE_OFFSET_DATA, &[P::WorkOffset], &[P::OffsetData]),
    rule(rule::program_end::LAST_IN_BLOCK, Phase::ALL.split_at(Phase::ALL.len() - 1).0, &[P::Stop]),
    OrderRule {
        rule: rule::saved_state::BLOCK_ORDER,
        first: Phases::these(BEFORE_SAVE),
        later: Phases::these(&[P::SavedState]),
        saved_state: &[70, 72, 73],
        refuses: false,
    },
    OrderRule {
        rule: rule::saved_state::BLOCK_ORDER,
        first: Phases::these(&[P::SavedState]),
        later: Phases::these(AFTER_SAVE),
        saved_state: &[70, 72, 73],
        refuses: false,
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_does_not_contradict_the_order() {
        for rule in ORDER_RULES {
            assert!(rule.first.iter().max() < rule.later.iter().min(), "{}", rule.rule);
        }
    }
}
