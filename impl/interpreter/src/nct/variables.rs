//! Local and common variables, and which of them a step has changed.

use super::program::Slot;
use crate::faults::{PlantedFault, planted};

/// How many levels of local variables there may be, that of the main program among them.
pub(super) const LEVELS: usize = 6;
/// How many local variables a level has.
const LOCALS: usize = 33;
/// How many common variables there are.
const COMMONS: usize = 200;

/// Thirty-three values, any of which may be vacant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Locals {
    values: [f64; LOCALS],
    /// A bit for each that is not vacant, #1 in the lowest.
    present: u64,
}

impl Locals {
    pub(super) const VACANT: Self = Self { values: [0.0; LOCALS], present: 0 };

    fn get(&self, place: u8) -> Option<f64> {
        let value = self.values.get(usize::from(place)).copied();
        value.filter(|_| self.present & bit(place) != 0)
    }

    /// Gives a variable a value, by its place from 0. A zero has no sign.
    pub(super) fn put(&mut self, place: u8, value: Option<f64>) {
        self.present &= !bit(place);
        if let (Some(slot), Some(value)) = (self.values.get_mut(usize::from(place)), value) {
            *slot = value + 0.0;
            self.present |= bit(place);
        }
    }
}

fn bit(place: u8) -> u64 {
    1_u64.wrapping_shl(u32::from(place))
}

/// The variables of one level.
#[derive(Clone, Copy, Debug)]
struct Level {
    locals: Locals,
    /// A bit for each that the step has changed.
    changed: u64,
    /// The arguments of this level's macro, kept for its repeats.
    arguments: Locals,
}

/// All variables.
#[derive(Clone, Debug)]
pub(super) struct Variables {
    levels: [Level; LEVELS],
    /// The macro level.
    level: usize,
    commons: [Option<f64>; COMMONS],
    /// The common variable that the step has changed.
    changed_common: Option<u16>,
}

/// A local or common variable that a step has changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VariableChange {
    /// The level of a local variable, none for a common one.
    pub level: Option<u32>,
    /// Its number.
    pub number: u32,
    /// Its value; `None` where it is vacant.
    pub value: Option<f64>,
}

impl Variables {
    pub(super) fn new() -> Self {
        let vacant = Locals::VACANT;
        let level = Level { locals: vacant, changed: 0, arguments: vacant };
        Self { levels: [level; LEVELS], level: 0, commons: [None; COMMONS], changed_common: None }
    }

    /// The macro level.
    pub(super) fn level(&self) -> usize {
        self.level
    }

    /// A step begins: nothing has changed.
    pub(super) fn begin(&mut self) {
        for level in &mut self.levels {
            level.changed = 0;
        }
        self.changed_common = None;
    }

    /// The value of a variable.
    pub(super) fn get(&self, slot: Slot) -> Option<f64> {
        match slot {
            Slot::Vacant => None,
            Slot::Local(place) => self.levels.get(self.level)?.locals.get(place),
            Slot::Common(number) => self.commons.get(place_of(number)).copied().flatten(),
        }
    }

    /// Gives a variable a value; whether it can have one.
    pub(super) fn put(&mut self, slot: Slot, value: Option<f64>) -> bool {
        match slot {
            Slot::Vacant => return false,
            Slot::Local(place) => {
                if let Some(level) = self.levels.get_mut(self.level)
                    && !same(level.locals.get(place), value)
                {
                    level.locals.put(place, value);
                    level.changed |= bit(place);
                }
            }
            Slot::Common(number) => {
                if let Some(common) = self.commons.get_mut(place_of(number))
                    && !same(*common, value)
                {
                    *common = value.map(|value| value + 0.0);
                    self.changed_common = Some(number);
                }
            }
        }
        true
    }

    /// The level above begins, with these variables; they are kept where they are wanted again.
    pub(super) fn enter(&mut self, arguments: &Locals, keeps: bool) {
        self.level = self.level.saturating_add(1);
        if let Some(level) = self.levels.get_mut(self.level) {
            if planted(PlantedFault::StaleLocals) {
                level.changed = arguments.present;
                let stale = level.locals;
                level.locals = *arguments;
                for place in 0..33 {
                    if arguments.get(place).is_none() {
                        level.locals.put(place, stale.get(place));
                    }
                }
                return;
            }
            level.locals = *arguments;
            level.changed = arguments.present;
            if keeps {
                level.arguments = *arguments;
            }
        }
    }

    /// The macro of this level begins again with what it was called with.
    pub(super) fn reload(&mut self) {
        if let Some(level) = self.levels.get_mut(self.level) {
            let (left, given) = (&level.locals, &level.arguments);
            let differs = |place: &u8| !same(left.get(*place), given.get(*place));
            level.changed = (0..33).filter(differs).fold(0, |bits, place| bits | bit(place));
            level.locals = level.arguments;
        }
    }

    /// The level ends: its variables are vacant, and those of the level below are as they were.
    pub(super) fn leave(&mut self) {
        let mut left = Locals::VACANT;
        if let Some(level) = self.levels.get_mut(self.level) {
            left = level.locals;
            level.changed = level.locals.present;
            if planted(PlantedFault::StaleLocals) {
                level.changed = 0;
            } else {
                level.locals.present = 0;
            }
        }
        self.level = self.level.saturating_sub(1);
        if planted(PlantedFault::LocalsNotRestored) {
            self.take_over(left);
        }
        if planted(PlantedFault::VacancyLost) {
            for place in 0..33 {
                let value = self.get(Slot::Local(place)).unwrap_or(0.0);
                self.put(Slot::Local(place), Some(value));
            }
        }
    }

    /// Takes over what another level held.
    fn take_over(&mut self, left: Locals) {
        for place in 0..33 {
            if let Some(value) = left.get(place) {
                self.put(Slot::Local(place), Some(value));
            }
        }
    }

    /// The changes of the step.
    pub(super) fn changes(&self) -> impl Iterator<Item = VariableChange> {
        let locals = (0..).zip(&self.levels).flat_map(|(level, one)| {
            let changed = (0_u8..33).filter(|place| one.changed & bit(*place) != 0);
            changed.map(move |place| VariableChange {
                level: Some(level),
                number: u32::from(place).saturating_add(1),
                value: one.locals.get(place),
            })
        });
        let common = self.changed_common.map(|number| VariableChange {
            level: None,
            number: u32::from(number),
            value: self.get(Slot::Common(number)),
        });
        locals.chain(common)
    }
}

/// The place of a common variable.
fn place_of(number: u16) -> usize {
    let behind_gap = number.checked_sub(400).filter(|place| *place >= 100);
    usize::from(behind_gap.unwrap_or_else(|| number.saturating_sub(100)))
}

/// Whether a variable that holds the one holds the other.
fn same(one: Option<f64>, other: Option<f64>) -> bool {
    let bits = |value: Option<f64>| value.map(|value| (value + 0.0).to_bits());
    bits(one) == bits(other)
}
