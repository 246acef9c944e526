//! The rules of chapter `order`: which phase comes before which.
//!
//! The order itself is that of [`Phase`]; this table says which rule speaks about two phases that meet in a block.

use super::phase::Phase;
use super::phase::Phase as P;
use super::phase::Phases;
use crate::rs274::evaluate::Words;

/// A rule about two phases of one block.
#[derive(Clone, Copy, Debug)]
pub struct OrderRule {
    /// Its id.
    pub id: &'static str,
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
const fn rule(id: &'static str, first: &'static [Phase], later: &'static [Phase]) -> OrderRule {
    OrderRule {
        id,
        first: Phases::these(first),
        later: Phases::these(later),
        saved_state: &[],
        refuses: false,
    }
}

/// A rule that can refuse.
const fn refusing(id: &'static str, first: &'static [Phase], later: &'static [Phase]) -> OrderRule {
    OrderRule {
        id,
        first: Phases::these(first),
        later: Phases::these(later),
        saved_state: &[],
        refuses: true,
    }
}

/// A rule about M70 and M73.
const fn save(id: &'static str, first: &'static [Phase], later: &'static [Phase]) -> OrderRule {
    OrderRule {
        id,
        first: Phases::these(first),
        later: Phases::these(later),
        saved_state: &[70, 73],
        refuses: false,
    }
}

/// A rule about M72.
const fn restore(id: &'static str, first: &'static [Phase], later: &'static [Phase]) -> OrderRule {
    OrderRule {
        id,
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
    rule("order.comment-first", &[P::Comment], Phase::ALL.split_at(1).1),
    refusing("order.compensation-before-work-offset", &[P::Compensation], &[P::WorkOffset]),
    rule("order.coolant-before-dwell", &[P::Coolant], &[P::Dwell]),
    rule("order.distance-before-motion", &[P::Distance], &[P::Motion]),
    rule("order.dwell-before-compensation", &[P::Dwell], &[P::Compensation]),
    rule("order.dwell-before-distance", &[P::Dwell], &[P::Distance, P::Retract]),
    rule("order.dwell-before-motion", &[P::Dwell], &[P::Motion]),
    rule("order.dwell-before-path", &[P::Dwell], &[P::Path]),
    rule("order.dwell-before-plane", &[P::Dwell], &[P::Plane]),
    rule("order.dwell-before-tool-length", &[P::Dwell], &[P::ToolLength]),
    rule("order.dwell-before-units", &[P::Dwell], &[P::Units]),
    rule("order.dwell-before-work-offset", &[P::Dwell], &[P::WorkOffset]),
    save("order.feed-and-speed-before-save", FEED_AND_SPEED, &[P::SavedState]),
    rule("order.feed-before-motion", &[P::FeedRate], &[P::Motion]),
    rule("order.feed-before-units", &[P::FeedRate], &[P::Units]),
    rule("order.feed-mode-before-feed", &[P::FeedMode], &[P::FeedRate]),
    rule("order.outputs-before-tool-change", &[P::InputsOutputs], &[P::ChangeTool]),
    rule("order.overrides-before-dwell", &[P::Overrides], &[P::Dwell]),
    rule("order.overrides-before-user-code", &[P::Overrides], &[P::UserCode]),
    rule("order.path-before-motion", &[P::Path], &[P::Motion]),
    refusing("order.plane-before-compensation", &[P::Plane], &[P::Compensation]),
    restore("order.restore-before-coolant", &[P::SavedState], &[P::Coolant]),
    restore("order.restore-before-modes", &[P::SavedState], MODES),
    restore("order.restore-before-overrides", &[P::SavedState], &[P::Overrides]),
    rule("order.return-mode-before-motion", &[P::Retract], &[P::Motion]),
    save("order.save-before-coolant", &[P::SavedState], &[P::Coolant]),
    save("order.save-before-modes", &[P::SavedState], MODES),
    save("order.save-before-overrides", &[P::SavedState], &[P::Overrides]),
    rule("order.select-before-outputs", &[P::SelectTool], &[P::InputsOutputs]),
    rule("order.select-before-tool-change", &[P::SelectTool], &[P::ChangeTool]),
    rule("order.speed-before-spindle", &[P::SpindleSpeed], &[P::Spindle]),
    rule("order.spindle-before-dwell", SPINDLE, &[P::Dwell]),
    restore("order.spindle-before-restore", SPINDLE, &[P::SavedState]),
    save("order.spindle-before-save", &[P::Spindle], &[P::SavedState]),
    rule("order.stop-last", Phase::ALL.split_at(Phase::ALL.len() - 1).0, &[P::Stop]),
    rule("order.tool-change-before-spindle", &[P::ChangeTool], &[P::Spindle]),
    rule("order.tool-length-before-motion", &[P::ToolLength], &[P::Motion]),
    rule("order.units-before-motion", &[P::Units], &[P::Motion]),
    rule("order.units-before-offset-data", &[P::Units], &[P::OffsetData]),
    rule("order.units-before-path", &[P::Units], &[P::Path]),
    rule("order.user-code-before-modes", &[P::UserCode], MODES),
    rule("order.work-offset-before-motion", &[P::WorkOffset], &[P::Motion]),
    rule("order.work-offset-before-offset-data", &[P::WorkOffset], &[P::OffsetData]),
    rule("program-end.last-in-block", Phase::ALL.split_at(Phase::ALL.len() - 1).0, &[P::Stop]),
    OrderRule {
        id: "saved-state.block-order",
        first: Phases::these(BEFORE_SAVE),
        later: Phases::these(&[P::SavedState]),
        saved_state: &[70, 72, 73],
        refuses: false,
    },
    OrderRule {
        id: "saved-state.block-order",
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
            assert!(rule.first.iter().max() < rule.later.iter().min(), "{}", rule.id);
        }
    }
}
