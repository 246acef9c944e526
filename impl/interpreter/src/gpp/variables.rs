//! Variables: what they are called, what they hold, and which of them are identical.

use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

use super::formats::{CHARACTER, Format, TooLong};
use crate::faults::{PlantedFault, planted};

/// Most variables of a program, members of arrays counted.
pub(super) const MOST: usize = 25_000;

/// A variable or an array.
#[derive(Clone, Debug)]
pub(super) struct Variable {
    /// In capitals.
    pub(super) name: String,
    /// A place among the formats.
    pub(super) format: usize,
    pub(super) modal: bool,
    /// Its slot, or that of its first member.
    pub(super) first: usize,
    /// How many members it has; none where it is not an array.
    pub(super) size: Option<usize>,
}

impl Variable {
    pub(super) fn is_text(&self) -> bool {
        self.format == CHARACTER
    }
}

/// A variable that is not an array, or a member of one.
#[derive(Clone, Debug)]
pub(super) struct Slot {
    pub(super) variable: usize,
    /// The text as it is printed.
    pub(super) text: String,
    /// The slot that keeps value and flag of all that are identical.
    root: usize,
    /// The next one that is identical; itself where there is none.
    next: usize,
    number: f64,
    has_value: bool,
    on: bool,
    /// The step in which it was set last.
    set_at: u64,
    /// Its flag before that step.
    was_on: bool,
    /// Whether its text is another one since that step.
    new_text: bool,
}

/// All variables, and what the step that is being executed does to them.
#[derive(Clone, Debug, Default)]
pub(super) struct Variables {
    pub(super) variables: Vec<Variable>,
    pub(super) slots: Vec<Slot>,
    /// Slots that this step has set, each once.
    noted: Vec<usize>,
    /// Numbers the steps, from 1.
    step: u64,
    /// A text that is being made.
    scratch: String,
}

impl Variables {
    /// Declares a variable; whether there is room for it.
    pub(super) fn declare(&mut self, name: String, format: usize, size: Option<usize>) -> bool {
        let (first, variable) = (self.slots.len(), self.variables.len());
        let Some(end) = first.checked_add(size.unwrap_or(1)) else { return false };
        if end > MOST {
            return false;
        }
        self.variables.push(Variable { name, format, modal: false, first, size });
        self.slots.extend((first..end).map(|place| Slot {
            variable,
            text: String::new(),
            root: place,
            next: place,
            number: 0.0,
            has_value: false,
            on: false,
            set_at: 0,
            was_on: false,
            new_text: false,
        }));
        true
    }

    /// Makes two slots identical, and those that are identical to them.
    pub(super) fn join(&mut self, one: usize, other: usize) {
        let (Some(first), Some(second)) = (self.slots.get(one), self.slots.get(other)) else {
            return;
        };
        let (root, old_root) = (first.root, second.root);
        if root == old_root || planted(PlantedFault::IdenticalApart) {
            return;
        }
        let (after_one, after_other) = (first.next, second.next);
        let mut place = other;
        while let Some(slot) = self.slots.get_mut(place).filter(|slot| slot.root != root) {
            slot.root = root;
            place = slot.next;
        }
        for (place, next) in [(one, after_other), (other, after_one)] {
            if let Some(slot) = self.slots.get_mut(place) {
                slot.next = next;
            }
        }
    }

    /// The variable that a slot belongs to.
    pub(super) fn variable_of(&self, slot: usize) -> Option<&Variable> {
        self.variables.get(self.slots.get(slot)?.variable)
    }

    /// Begins a step.
    pub(super) fn begin(&mut self) {
        self.step = self.step.saturating_add(1);
        self.noted.clear();
    }

    /// How many slots the step has set, each once.
    pub(super) fn set_in_step(&self) -> usize {
        self.noted.len()
    }

    fn root(&self, slot: usize) -> Option<&Slot> {
        self.slots.get(self.slots.get(slot)?.root)
    }

    pub(super) fn is_on(&self, slot: usize) -> bool {
        self.root(slot).is_some_and(|slot| slot.on)
    }

    pub(super) fn has_value(&self, slot: usize) -> bool {
        self.root(slot).is_some_and(|slot| slot.has_value)
    }

    /// The number of a variable that has one.
    pub(super) fn number(&self, slot: usize) -> Option<f64> {
        self.root(slot).filter(|slot| slot.has_value).map(|slot| slot.number)
    }

    /// Switches a variable and all that are identical to it.
    pub(super) fn switch(&mut self, slot: usize, on: bool) {
        self.note_all(slot);
        let root = self.slots.get(slot).map_or(slot, |slot| slot.root);
        if let Some(slot) = self.slots.get_mut(root) {
            slot.on = on;
        }
    }

    /// Notes that a slot is being set, and all that are identical to it.
    fn note_all(&mut self, slot: usize) {
        let on = self.is_on(slot);
        let step = self.step;
        let mut place = slot;
        while let Some(noted) = self.slots.get_mut(place) {
            if noted.set_at != step {
                noted.set_at = step;
                noted.was_on = on;
                noted.new_text = false;
                self.noted.push(place);
            }
            place = noted.next;
            if place == slot {
                break;
            }
        }
    }

    /// Sets a number; whether the variable's text is another one now. Nothing changes where one of the identical
    /// variables cannot print it.
    ///
    /// # Errors
    /// One of them cannot.
    pub(super) fn set_number(
        &mut self,
        slot: usize,
        number: f64,
        formats: &[Format],
        tie_even: bool,
    ) -> Result<bool, TooLong> {
        let old = self.number(slot);
        let next = self.slots.get(slot).map_or(slot, |slot| slot.next);
        let mut place = next;
        while place != slot {
            let format = self.variable_of(place).and_then(|one| formats.get(one.format));
            format.ok_or(TooLong)?.rounded(number, tie_even)?;
            place = self.slots.get(place).map_or(slot, |slot| slot.next);
        }
        let changed = self.print_into(slot, slot, number, formats, tie_even)?;
        let mut place = next;
        while place != slot {
            let like = if planted(PlantedFault::IdenticalFormat) { slot } else { place };
            self.print_into(place, like, number, formats, tie_even)?;
            place = self.slots.get(place).map_or(slot, |slot| slot.next);
        }
        self.put_value(slot, number);
        let other = old.is_none_or(|old| old.to_bits() != number.to_bits());
        Ok(if planted(PlantedFault::ChangedByValue) { other } else { changed })
    }

    /// Prints a number in a slot, in the format of the slot `like`; whether its text is another one now.
    fn print_into(
        &mut self,
        place: usize,
        like: usize,
        number: f64,
        formats: &[Format],
        tie_even: bool,
    ) -> Result<bool, TooLong> {
        let format = self.variable_of(like).and_then(|one| formats.get(one.format));
        let format = format.ok_or(TooLong)?;
        let decimal = format.rounded(number, tie_even)?;
        self.scratch.clear();
        format.print(decimal, &mut self.scratch);
        self.note_all(place);
        Ok(self.put_scratch(place))
    }

    /// Sets a text; whether it is another one.
    pub(super) fn set_text(&mut self, slot: usize, text: &str) -> bool {
        self.note_all(slot);
        let (mut place, mut changed) = (slot, false);
        loop {
            self.scratch.clear();
            self.scratch.push_str(text);
            let differs = self.put_scratch(place);
            changed |= place == slot && differs;
            place = self.slots.get(place).map_or(slot, |slot| slot.next);
            if place == slot {
                break;
            }
        }
        self.put_value(slot, 0.0);
        changed
    }

    /// Exchanges a slot's text for the one that was made; whether they differ.
    fn put_scratch(&mut self, place: usize) -> bool {
        let Some(slot) = self.slots.get_mut(place) else { return false };
        let differs = slot.text != self.scratch;
        if differs {
            core::mem::swap(&mut slot.text, &mut self.scratch);
            slot.new_text = true;
        }
        differs
    }

    fn put_value(&mut self, slot: usize, number: f64) {
        let root = self.slots.get(slot).map_or(slot, |slot| slot.root);
        if let Some(slot) = self.slots.get_mut(root) {
            slot.number = number;
            slot.has_value = true;
        }
    }

    /// The changes of the step.
    pub(super) fn changes(&self) -> impl Iterator<Item = Change<'_>> {
        self.noted.iter().filter_map(|place| {
            let slot = self.slots.get(*place)?;
            let on = self.is_on(*place);
            let text = slot.new_text.then_some(slot.text.as_str());
            let on = (on != slot.was_on).then_some(on);
            let changed = text.is_some() || on.is_some();
            changed.then(|| Change { name: self.name_of(*place), text, on })
        })
    }

    /// The name of a slot.
    pub(super) fn name_of(&self, slot: usize) -> Name<'_> {
        let variable = self.variable_of(slot);
        let member = variable.and_then(|one| {
            one.size?;
            slot.checked_sub(one.first)?.checked_add(1)
        });
        Name { name: variable.map_or("", |one| one.name.as_str()), member }
    }
}

/// A variable's name as it is reported: `AXIS(3)` for a member of an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Name<'a> {
    name: &'a str,
    member: Option<usize>,
}

impl fmt::Display for Name<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.member {
            None => f.write_str(self.name),
            Some(member) => write!(f, "{}({member})", self.name),
        }
    }
}

/// A variable after a step.
#[derive(Clone, Copy, Debug)]
pub struct Change<'a> {
    /// Its name.
    pub name: Name<'a>,
    /// Its text, if it is another one.
    pub text: Option<&'a str>,
    /// Whether it is on, if that changed.
    pub on: Option<bool>,
}
