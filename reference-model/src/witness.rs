//! Who looks on while a run goes, and puts down which rules it reaches.
//!
//! A run reaches some rule fifty times a block, and nearly always one that it has reached before. So each rule has a slot of its own, and what has
//! been put down is found by the number that the compiler makes of the rule's id.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use crate::evidence::{Evidence, Reached};
use crate::{gpp, nct, rs274};

/// The id of each rule, a line each: those of the suite's pages, which a test holds against this list.
pub const RULES: &str = include_str!("rules.txt");

/// Slots of all rules; a power of two.
const SLOTS: usize = 1 << 14;
/// Of some thousand factors the one by which the fewest rules have to share a slot.
const FACTOR: u64 = 0x4484_31bc_e18c_b9a5;
/// What stands in a slot that no rule has.
const NONE: u16 = u16::MAX;

/// What has been put down of the rule that its slot is the first one for, and of no other.
const ACCEPTED: u8 = 1;
const REFUSED: u8 = 2;
/// The same, where ids of several rules lead to the slot.
const AMONG_OTHERS: u32 = 2;

/// The rules that a run has reached so far.
#[derive(Clone, Debug, Default)]
pub struct Witness {
    /// What has been put down, by slot; empty before anything is.
    slots: Vec<u8>,
    /// The slots where something stands.
    filled: Vec<u16>,
    /// Whether nothing is put down: what is only looked at reaches no rule.
    deaf: bool,
}

impl Witness {
    /// One of what is only looked at: nothing that is reached counts.
    pub(crate) fn deaf() -> Self {
        Self { deaf: true, ..Self::default() }
    }

    /// Puts nothing down from now on, or puts down again; what it did before.
    pub(crate) fn set_deaf(&mut self, deaf: bool) -> bool {
        std::mem::replace(&mut self.deaf, deaf)
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
        let mixed = mixed(rule);
        let known = self.slots.get(mixed % SLOTS).is_some_and(|slot| slot & outcome != 0);
        if !known {
            self.put_down(rule, mixed, outcome);
        }
    }

    #[inline(never)]
    fn put_down(&mut self, rule: &str, mixed: usize, outcome: u8) {
        if self.deaf {
            return;
        }
        let Some((slot, alone)) = REGISTER.slot(rule, mixed) else {
            debug_assert!(false, "model: {rule} is not in the list of rules");
            return;
        };
        if self.slots.is_empty() {
            self.slots.resize(SLOTS, 0);
        }
        let known = &mut self.slots[usize::from(slot)];
        if *known == 0 {
            self.filled.push(slot);
        }
        *known |= if alone { outcome } else { outcome << AMONG_OTHERS };
    }

    /// What was put down; nothing of it is left.
    pub(crate) fn take(&mut self) -> Evidence {
        let reached = self.filled.drain(..).map(|slot| {
            let outcomes = std::mem::take(&mut self.slots[usize::from(slot)]);
            let outcomes = outcomes | outcomes >> AMONG_OTHERS;
            let (accepted, refused) = (outcomes & ACCEPTED != 0, outcomes & REFUSED != 0);
            Reached { rule: REGISTER.slots[usize::from(slot)], accepted, refused }
        });
        Evidence::new(reached.collect())
    }
}

/// The id of a rule by its place in the list.
pub(crate) fn id(rule: u16) -> &'static str {
    REGISTER.ids[usize::from(rule)]
}

/// How many rules there are.
pub(crate) fn count() -> usize {
    REGISTER.ids.len()
}

/// The place of a rule in the list.
pub(crate) fn place(rule: &str) -> Option<usize> {
    let (slot, _) = REGISTER.slot(rule, mixed(rule))?;
    Some(usize::from(REGISTER.slots[usize::from(slot)]))
}

/// All rules with their slots.
struct Register {
    ids: Vec<&'static str>,
    /// The place in `ids` of the rule that has a slot. It is the slot that its id leads to, or the next free one.
    slots: Vec<u16>,
    /// Whether the id of just one rule leads to a slot, and this rule has it.
    alone: Vec<bool>,
}

static REGISTER: LazyLock<Register> = LazyLock::new(|| {
    // Some refuse under the id of a choice or quirk.
    let choices = [rs274::readings::CHOICES, gpp::readings::CHOICES, nct::readings::CHOICES];
    let choices = choices.into_iter().flatten().map(|(id, _)| *id);
    let all = RULES.lines().chain(choices).chain(rs274::readings::QUIRKS.iter().copied());
    Register::of(all.collect::<BTreeSet<_>>().into_iter().collect())
});

impl Register {
    fn of(ids: Vec<&'static str>) -> Self {
        let (mut slots, mut led_to) = (vec![NONE; SLOTS], vec![0_u8; SLOTS]);
        for (place, id) in (0..).zip(&ids) {
            let mut slot = mixed(id) % SLOTS;
            led_to[slot] = led_to[slot].saturating_add(1);
            while slots[slot] != NONE {
                slot = (slot + 1) % SLOTS;
            }
            slots[slot] = place;
        }
        let is_alone = |slot: usize| {
            let own = ids.get(usize::from(slots[slot])).map(|id| mixed(id) % SLOTS);
            led_to[slot] == 1 && own == Some(slot)
        };
        let alone = (0..SLOTS).map(is_alone).collect();
        Self { ids, slots, alone }
    }

    /// The slot of a rule, and whether it has that alone.
    fn slot(&self, rule: &str, mixed: usize) -> Option<(u16, bool)> {
        let mut slot = mixed % SLOTS;
        loop {
            let id = self.ids.get(usize::from(self.slots[slot]))?;
            if *id == rule {
                return Some((u16::try_from(slot).ok()?, self.alone[slot]));
            }
            slot = (slot + 1) % SLOTS;
        }
    }
}

/// A number that is another one for most ids: from their length, beginning, middle and end. For an id that stands in the text of the model the
/// compiler knows it.
#[inline]
fn mixed(id: &str) -> usize {
    let bytes = id.as_bytes();
    let number = |chunk: Option<&[u8; 8]>| chunk.copied().map_or(0, u64::from_le_bytes);
    let middle = (bytes.len() / 2).checked_sub(4).and_then(|from| bytes.get(from..));
    let first = number(bytes.first_chunk()).rotate_left(23);
    let middle = number(middle.and_then(<[u8]>::first_chunk)).rotate_left(47);
    let last = number(bytes.last_chunk()).wrapping_add(bytes.len() as u64);
    usize::try_from((first ^ middle ^ last).wrapping_mul(FACTOR) >> 40).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::RuleOutcome;

    #[test]
    fn each_rule_is_put_down_as_itself() {
        for (place, rule) in (0..).zip(&REGISTER.ids) {
            let mut witness = Witness::default();
            witness.refused(rule);
            witness.refused(rule);
            let refused = [Reached { rule: place, accepted: false, refused: true }];
            assert_eq!(witness.take(), Evidence::new(refused.to_vec()), "{rule}");
            assert_eq!(witness.take(), Evidence::default());
        }
    }

    #[test]
    fn of_all_rules_none_hides_another() {
        let mut witness = Witness::default();
        for _ in 0..2 {
            REGISTER.ids.iter().for_each(|rule| witness.accepted(rule));
        }
        let all: Vec<_> = witness.take().iter().collect();
        let expected = REGISTER.ids.iter().map(|rule| (*rule, RuleOutcome::Accepted));
        let expected: Vec<_> = expected.collect();
        assert_eq!(all, expected);
    }

    #[test]
    fn few_rules_share_a_slot() {
        let alone = |id: &&&str| REGISTER.slot(id, mixed(id)).is_some_and(|(_, alone)| alone);
        let all = REGISTER.ids.len();
        let alone = REGISTER.ids.iter().filter(alone).count();
        assert!(all - alone < all / 15, "{} of {all}", all - alone);
    }

    #[test]
    fn nothing_is_put_down_while_it_is_deaf() {
        let mut witness = Witness::deaf();
        witness.accepted("text.blanks");
        assert_eq!(witness.take(), Evidence::default());
        assert!(witness.set_deaf(false));
        witness.accepted("text.blanks");
        assert_eq!(witness.take().iter().count(), 1);
    }
}
