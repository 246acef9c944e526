//! Named parameters: global ones, and local ones that belong to a call level (11.4.3.3).

use alloc::vec::Vec;

use crate::faults::{PlantedFault, planted};
use crate::parameters::names::{NameId, Names};

/// Predefined parameters with values of the interpreter's loop. Those with values of the modes are elsewhere.
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
    /// `_task`: whether the interpreter controls a machine; the caller decides.
    Task,
    /// `_remap_level`: always 0; no code is remapped.
    RemapLevel,
    /// `_vmajor`: 2.9, the version of the manual.
    VersionMajor,
    /// `_vminor`.
    VersionMinor,
    /// `_hal[…]`: a HAL item, by its place among those that the caller has declared.
    Item(u32),
}

impl Internal {
    /// The parameter of a name in lower case and without blanks.
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

/// Scope of an existing global parameter.
const GLOBAL: u64 = u64::MAX;
/// Scope of a parameter that does not exist.
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

    /// Whether it holds a global parameter.
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

/// The state at the beginning of a scope; [`Named::leave`] returns to it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScopeMark {
    scope: u64,
    first: usize,
    hidden: usize,
}

/// Marks a slot as written.
#[inline]
fn mark_written(marks: &mut [u64], id: NameId) {
    let word = usize::try_from(id >> 6).unwrap_or(usize::MAX);
    if let Some(marks) = marks.get_mut(word) {
        *marks |= 1 << (id & 63);
    }
}

/// Values of the named parameters.
///
/// A name has one slot. A call opens a new scope, in which local parameters of other scopes do not exist. If a scope
/// overwrites a slot, the previous content is kept in `hidden` and restored at the end of the scope. Reading is one
/// comparison, and a call that sets nothing costs nothing.
#[derive(Clone, Debug)]
pub(crate) struct Named {
    slots: Vec<Slot>,
    hidden: Vec<Hidden>,
    /// A bit for each slot that was written since [`Named::take_changes`].
    marks: Vec<u64>,
    /// The scope of the current call level.
    scope: u64,
    /// Where its local parameters begin in `hidden`.
    first: usize,
    /// The last scope that was opened; scopes are never used twice.
    last: u64,
}

impl Named {
    /// No parameter exists.
    pub(crate) fn new() -> Self {
        Self {
            slots: Vec::new(),
            hidden: Vec::new(),
            marks: Vec::new(),
            scope: 1,
            first: 0,
            last: 1,
        }
    }

    /// Makes room for all names of a table.
    pub(crate) fn cover(&mut self, names: &Names) {
        if self.slots.len() < names.len() {
            self.slots.resize(names.len(), Slot { value: 0.0, scope: NOWHERE });
            self.marks.resize(names.len().div_ceil(64), 0);
        }
    }

    /// The number of names that have a slot.
    #[inline]
    pub(crate) fn covered(&self) -> usize {
        self.slots.len()
    }

    fn slot(&self, id: NameId) -> Option<&Slot> {
        usize::try_from(id).ok().and_then(|id| self.slots.get(id))
    }

    /// The value of a global parameter, if it exists.
    #[inline]
    pub(crate) fn global(&self, id: NameId) -> Option<f64> {
        self.slot(id).filter(|slot| slot.scope == GLOBAL).map(|slot| slot.value)
    }

    /// The value of a local parameter, if it exists at this call level.
    #[inline]
    pub(crate) fn local(&self, id: NameId) -> Option<f64> {
        self.slot(id).filter(|slot| slot.scope == self.scope).map(|slot| slot.value)
    }

    /// Whether a parameter exists at any call level.
    pub(crate) fn exists_anywhere(&self, id: NameId) -> bool {
        self.slot(id).is_some_and(|slot| slot.scope != NOWHERE)
    }

    /// Sets a global parameter, which exists from then on. Returns the previous slot.
    #[inline]
    pub(crate) fn set_global(&mut self, id: NameId, value: f64) -> Slot {
        self.restore_slot(id, Slot { value, scope: GLOBAL })
    }

    /// Sets a local parameter, which exists until its call level ends. Returns the previous slot.
    #[inline]
    pub(crate) fn set_local(&mut self, id: NameId, value: f64) -> Slot {
        let scope = self.scope;
        let before = self.restore_slot(id, Slot { value, scope });
        if before.scope != scope {
            self.hidden.push(Hidden { id, slot: before });
        }
        before
    }

    /// Restores an earlier slot of a parameter, and returns the present one. An entry of the slot in `hidden` remains;
    /// it restores the same content once more at the end of the scope.
    #[inline]
    pub(crate) fn restore_slot(&mut self, id: NameId, before: Slot) -> Slot {
        match usize::try_from(id).ok().and_then(|id| self.slots.get_mut(id)) {
            Some(slot) => {
                mark_written(&mut self.marks, id);
                core::mem::replace(slot, before)
            }
            None => before,
        }
    }

    /// A program begins: the parameters stay, but with a planted fault.
    pub(crate) fn begin(&mut self) {
        if !planted(PlantedFault::MainLocalsForgotten) {
            return;
        }
        let scope = self.scope;
        for slot in self.slots.iter_mut().filter(|slot| slot.scope == scope) {
            slot.scope = NOWHERE;
        }
    }

    /// Opens a scope for a call.
    pub(crate) fn enter(&mut self) -> ScopeMark {
        let mark = self.share();
        self.last = self.last.wrapping_add(1);
        self.scope = self.last;
        self.first = self.hidden.len();
        mark
    }

    /// A mark for a call that shares its caller's scope.
    pub(crate) fn share(&self) -> ScopeMark {
        ScopeMark { scope: self.scope, first: self.first, hidden: self.hidden.len() }
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
                    mark_written(&mut self.marks, hidden.id);
                }
            }
        }
        (self.scope, self.first) = (mark.scope, mark.first);
    }

    /// Reports each parameter that was set since the last time and exists at this call level, and forgets that it was.
    pub(crate) fn take_changes<'a>(
        &mut self,
        names: &'a Names,
        mut report: impl FnMut(&'a str, f64),
    ) {
        for (word, marks) in (0_u32..).zip(&mut self.marks) {
            let mut marks = core::mem::take(marks);
            while marks != 0 {
                let id = word.wrapping_mul(64).wrapping_add(marks.trailing_zeros());
                marks &= marks.wrapping_sub(1);
                let slot = usize::try_from(id).ok().and_then(|id| self.slots.get(id));
                if let Some(slot) = slot
                    && (slot.scope == GLOBAL || slot.scope == self.scope)
                {
                    report(names.name(id), slot.value);
                }
            }
        }
    }

    /// The local parameters that exist at this call level, with their names; one can be there twice.
    pub(crate) fn locals<'a>(
        &'a self,
        names: &'a Names,
    ) -> impl Iterator<Item = (&'a str, f64)> + 'a {
        let set = self.hidden.get(self.first..).unwrap_or(&[]);
        set.iter().filter_map(|hidden| Some((names.name(hidden.id), self.local(hidden.id)?)))
    }

    /// Every parameter that exists at this call level, with its name.
    pub(crate) fn existing<'a>(
        &'a self,
        names: &'a Names,
    ) -> impl Iterator<Item = (&'a str, f64)> + 'a {
        names.iter().zip(self.slots.iter()).filter_map(|((_, name), slot)| {
            (slot.scope == GLOBAL || slot.scope == self.scope).then_some((name, slot.value))
        })
    }
}
