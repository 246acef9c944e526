//! Named parameters: global ones, and local ones that belong to a call level (11.4.3.3).

use alloc::vec::Vec;

use crate::parameters::names::{NameId, Names};

/// The predefined names that the interpreter's loop answers; the modes answer the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Internal {
    /// `_line`: line of the block.
    Line,
    /// `_value`: value of the last return or endsub.
    Value,
    /// `_value_returned`: whether it had one.
    ValueReturned,
    /// `_call_level`: depth of calls.
    CallLevel,
    /// `_task`: whether the interpreter drives a machine, as the caller says.
    Task,
    /// `_remap_level`: nothing is remapped.
    RemapLevel,
    /// `_vmajor`: 2.9, the version of the manual.
    VersionMajor,
    /// `_vminor`.
    VersionMinor,
    /// `_hal[…]`: a HAL item, by its place among those that the caller has declared.
    Item(u32),
}

impl Internal {
    /// The name in lower case and without blanks.
    pub(crate) fn from_name(name: &str) -> Option<Self> {
        Some(match name {
            "_line" => Self::Line,
            "_value" => Self::Value,
            "_value_returned" => Self::ValueReturned,
            "_call_level" => Self::CallLevel,
            "_task" => Self::Task,
            "_remap_level" => Self::RemapLevel,
            "_vmajor" => Self::VersionMajor,
            "_vminor" => Self::VersionMinor,
            _ => return None,
        })
    }
}

/// Scope of a global parameter that exists.
const GLOBAL: u64 = u64::MAX;
/// Scope of a parameter that does not.
const NOWHERE: u64 = 0;

/// A parameter: its value, and in which scope it exists.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slot {
    value: f64,
    scope: u64,
}

impl Slot {
    pub(crate) fn value(&self) -> f64 {
        self.value
    }

    /// Whether it is that of a global parameter.
    pub(crate) fn is_global(&self) -> bool {
        self.scope == GLOBAL
    }
}

/// A local parameter as it was before a call level set it.
#[derive(Clone, Copy, Debug)]
struct Hidden {
    id: NameId,
    slot: Slot,
}

/// Where a scope began, to end it with.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScopeMark {
    scope: u64,
    hidden: usize,
}

/// Values of the named parameters.
///
/// A name has one slot. A call opens a new scope, under which no slot of another scope is seen; what a scope
/// overwrites is kept aside and put back at its end. Reading is one comparison, and a call that sets nothing costs
/// nothing.
#[derive(Clone, Debug)]
pub(crate) struct Named {
    slots: Vec<Slot>,
    hidden: Vec<Hidden>,
    /// The scope of the running level.
    scope: u64,
    /// The last scope that was opened; scopes are never used twice.
    last: u64,
}

impl Named {
    /// No parameter exists.
    pub(crate) fn new() -> Self {
        Self { slots: Vec::new(), hidden: Vec::new(), scope: 1, last: 1 }
    }

    /// Makes room for all names of a table.
    pub(crate) fn cover(&mut self, names: &Names) {
        if self.slots.len() < names.len() {
            self.slots.resize(names.len(), Slot { value: 0.0, scope: NOWHERE });
        }
    }

    /// How many names there is room for.
    #[inline]
    pub(crate) fn covered(&self) -> usize {
        self.slots.len()
    }

    fn slot(&self, id: NameId) -> Option<&Slot> {
        usize::try_from(id).ok().and_then(|id| self.slots.get(id))
    }

    /// A global parameter, where it exists.
    #[inline]
    pub(crate) fn global(&self, id: NameId) -> Option<f64> {
        self.slot(id).filter(|slot| slot.scope == GLOBAL).map(|slot| slot.value)
    }

    /// A local parameter, where it exists at this level.
    #[inline]
    pub(crate) fn local(&self, id: NameId) -> Option<f64> {
        self.slot(id).filter(|slot| slot.scope == self.scope).map(|slot| slot.value)
    }

    /// Sets a global parameter; it exists from then on. What it was comes back.
    #[inline]
    pub(crate) fn set_global(&mut self, id: NameId, value: f64) -> Slot {
        self.restore_slot(id, Slot { value, scope: GLOBAL })
    }

    /// Sets a local parameter; it exists until its level is left. What it was comes back.
    #[inline]
    pub(crate) fn set_local(&mut self, id: NameId, value: f64) -> Slot {
        let scope = self.scope;
        let before = self.restore_slot(id, Slot { value, scope });
        if before.scope != scope {
            self.hidden.push(Hidden { id, slot: before });
        }
        before
    }

    /// Makes a parameter what it was. One that its level hid stays noted as hidden, which restores it to the same
    /// once more.
    #[inline]
    pub(crate) fn restore_slot(&mut self, id: NameId, before: Slot) -> Slot {
        match usize::try_from(id).ok().and_then(|id| self.slots.get_mut(id)) {
            Some(slot) => core::mem::replace(slot, before),
            None => before,
        }
    }

    /// Opens a scope for a call.
    pub(crate) fn enter(&mut self) -> ScopeMark {
        let mark = ScopeMark { scope: self.scope, hidden: self.hidden.len() };
        self.last = self.last.wrapping_add(1);
        self.scope = self.last;
        mark
    }

    /// A mark for a call that shares its caller's scope.
    pub(crate) fn share(&self) -> ScopeMark {
        ScopeMark { scope: self.scope, hidden: self.hidden.len() }
    }

    /// Ends the scope that the mark began.
    pub(crate) fn leave(&mut self, mark: ScopeMark) {
        if self.scope != mark.scope {
            while self.hidden.len() > mark.hidden {
                let Some(hidden) = self.hidden.pop() else { break };
                if let Some(slot) =
                    usize::try_from(hidden.id).ok().and_then(|id| self.slots.get_mut(id))
                {
                    *slot = hidden.slot;
                }
            }
        }
        self.scope = mark.scope;
    }

    /// Every parameter that exists and is seen at this level, with its name.
    pub(crate) fn existing<'a>(
        &'a self,
        names: &'a Names,
    ) -> impl Iterator<Item = (&'a str, f64)> + 'a {
        names.iter().zip(self.slots.iter()).filter_map(|((_, name), slot)| {
            (slot.scope == GLOBAL || slot.scope == self.scope).then_some((name, slot.value))
        })
    }
}
