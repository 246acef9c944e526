//! Records which rules a run reaches.
//!
//! Rules are reached some fifty times in a block, and nearly always they have been reached before. So each has a
//! slot, and whether it was put down there already is seen by the number that the compiler makes of its id.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use crate::by_name::{ByName, hash};
use crate::evidence::{Evidence, Reached};
use crate::{gpp, nct, rs274};

/// The id of each rule that a run can reach, a line each: those of the suite's pages, which a test holds against this
/// list.
pub const RULES: &str = include_str!("rules.txt");

/// Slots of all rules; a power of two.
const SLOTS: usize = 1 << 14;

/// Bits of a slot that one rule has alone, and that only its id leads to: they tell without a look at the id.
const ACCEPTED: u8 = 1;
const REFUSED: u8 = 2;
/// By so much the bits of any other slot are shifted: to tell whose they are, ids have to be compared.
const SHARED: u32 = 2;

/// The rules that a run has reached so far.
#[derive(Clone, Debug, Default)]
pub struct RuleCoverage {
    /// What has been put down, by slot; empty before anything is.
    slots: Vec<u8>,
    /// The slots where something stands.
    filled: Vec<u16>,
    /// Whether nothing is put down: what is only looked at reaches no rule.
    muted: bool,
}

impl RuleCoverage {
    /// One of what is only looked at: nothing that is reached counts.
    pub(crate) fn muted() -> Self {
        Self { muted: true, ..Self::default() }
    }

    /// Puts nothing down from now on, or puts down again; what it did before.
    pub(crate) fn set_muted(&mut self, muted: bool) -> bool {
        std::mem::replace(&mut self.muted, muted)
    }

    /// The rule decided what an accepted block does.
    #[inline]
    pub(crate) fn accepted(&mut self, rule: &str) {
        self.reached(rule, ACCEPTED);
    }

    /// The rule refused a block.
    #[inline]
    pub(crate) fn refused(&mut self, rule: &str) {
        self.reached(rule, REFUSED);
    }

    #[inline]
    fn reached(&mut self, rule: &str, outcome: u8) {
        let hash = hash(rule);
        let known = self.slots.get(hash % SLOTS).is_some_and(|slot| slot & outcome != 0);
        if !known {
            self.put_down(rule, hash, outcome);
        }
    }

    #[inline(never)]
    fn put_down(&mut self, rule: &str, hash: usize, outcome: u8) {
        if self.muted {
            return;
        }
        let Some(slot) = REGISTER.rules.slot(rule, hash) else {
            debug_assert!(false, "model: {rule} is not in the list of rules");
            return;
        };
        if self.slots.is_empty() {
            self.slots.resize(SLOTS, 0);
        }
        let known = &mut self.slots[slot];
        if *known == 0 {
            self.filled.extend(u16::try_from(slot));
        }
        *known |= if REGISTER.alone[slot] { outcome } else { outcome << SHARED };
    }

    /// What was put down; nothing of it is left.
    pub(crate) fn take(&mut self) -> Evidence {
        let reached = self.filled.drain(..).filter_map(|slot| {
            let slot = usize::from(slot);
            let outcomes = std::mem::take(&mut self.slots[slot]);
            let outcomes = outcomes | outcomes >> SHARED;
            let (accepted, refused) = (outcomes & ACCEPTED != 0, outcomes & REFUSED != 0);
            Some(Reached { rule: REGISTER.rules.place(slot)?, accepted, refused })
        });
        Evidence::new(reached.collect())
    }
}

/// The id of a rule by its place among all.
pub(crate) fn id(rule: u16) -> &'static str {
    REGISTER.rules.name(rule)
}

/// How many rules there are.
pub(crate) fn count() -> usize {
    REGISTER.rules.names().len()
}

/// The place of a rule among all.
pub(crate) fn place(rule: &str) -> Option<usize> {
    let slot = REGISTER.rules.slot(rule, hash(rule))?;
    REGISTER.rules.place(slot).map(usize::from)
}

/// All rules with their slots.
struct Register {
    rules: ByName<()>,
    /// Whether the id of just one rule leads to a slot, and this rule has it.
    alone: Vec<bool>,
}

static REGISTER: LazyLock<Register> = LazyLock::new(|| {
    // Some refuse under the id of a choice or quirk.
    let choices = [rs274::choices::CHOICES, gpp::choices::CHOICES, nct::choices::CHOICES];
    let choices = choices.into_iter().flatten().map(|(id, _)| *id);
    let ids = RULES.lines().chain(choices).chain(rs274::choices::QUIRKS.iter().copied());
    let ids: BTreeSet<_> = ids.collect();
    let rules = ByName::new(SLOTS, ids.into_iter().map(|id| (id, ())).collect());
    let mut led_to = vec![0_u16; SLOTS];
    rules.names().for_each(|id| led_to[hash(id) % SLOTS] += 1);
    let is_alone = |slot: usize| {
        let own = rules.place(slot).map(|place| hash(rules.name(place)) % SLOTS);
        led_to[slot] == 1 && own == Some(slot)
    };
    let alone = (0..SLOTS).map(is_alone).collect();
    Register { rules, alone }
});

#[cfg(test)]
mod tests {
    use super::*;
    use crate::RuleOutcome;

    #[test]
    fn each_rule_is_put_down_as_itself() {
        for (place, rule) in (0..).zip(REGISTER.rules.names()) {
            let mut coverage = RuleCoverage::default();
            coverage.refused(rule);
            coverage.refused(rule);
            let refused = [Reached { rule: place, accepted: false, refused: true }];
            assert_eq!(coverage.take(), Evidence::new(refused.to_vec()), "{rule}");
            assert_eq!(coverage.take(), Evidence::default());
        }
    }

    #[test]
    fn of_all_rules_none_hides_another() {
        let mut coverage = RuleCoverage::default();
        for _ in 0..2 {
            REGISTER.rules.names().for_each(|rule| coverage.accepted(rule));
        }
        let all: Vec<_> = coverage.take().iter().collect();
        let expected = REGISTER.rules.names().map(|rule| (rule, RuleOutcome::Accepted));
        let expected: Vec<_> = expected.collect();
        assert_eq!(all, expected);
    }

    #[test]
    fn few_rules_share_a_slot() {
        let all = count();
        let alone = REGISTER.alone.iter().filter(|alone| **alone).count();
        assert!(all - alone < all / 15, "{} of {all}", all - alone);
    }

    #[test]
    fn nothing_is_put_down_while_it_is_deaf() {
        let mut coverage = RuleCoverage::muted();
        coverage.accepted("text.blanks");
        assert_eq!(coverage.take(), Evidence::default());
        assert!(coverage.set_muted(false));
        coverage.accepted("text.blanks");
        assert_eq!(coverage.take().iter().count(), 1);
    }
}
