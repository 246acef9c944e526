//! Values by name, for names that stand in the text of the model: ids of rules, choices and quirks.

/// What stands in a slot that no entry has.
const NONE: u16 = u16::MAX;

/// Of some thousand factors the one by which the fewest rules have to share a slot. Another one is found by trying
/// odd numbers until the test of `coverage` that counts them passes.
const FACTOR: u64 = 0x4484_31bc_e18c_b9a5;

/// Values by name. To find one costs the same however many there are.
#[derive(Debug)]
pub(crate) struct ByName<T> {
    /// Each name once.
    entries: Vec<(&'static str, T)>,
    /// The place of an entry, or none. An entry is in the slot that its name leads to, or in the next free one.
    slots: Vec<u16>,
}

impl<T> ByName<T> {
    /// In so many slots: a power of two, and several times as many as entries, so that most names lead to a slot of
    /// their own.
    pub(crate) fn new(slots: usize, entries: Vec<(&'static str, T)>) -> Self {
        let mut all = vec![NONE; slots];
        for (place, (name, _)) in (0..).zip(&entries) {
            let mut slot = hash(name) % slots;
            while all[slot] != NONE {
                slot = (slot + 1) % slots;
            }
            all[slot] = place;
        }
        Self { entries, slots: all }
    }

    /// All names in the order of their places.
    pub(crate) fn names(&self) -> impl ExactSizeIterator<Item = &'static str> {
        self.entries.iter().map(|(name, _)| *name)
    }

    /// The name at a place.
    pub(crate) fn name(&self, place: u16) -> &'static str {
        self.entries[usize::from(place)].0
    }

    /// The value of a name, if it has one.
    #[inline]
    pub(crate) fn get(&self, name: &str) -> Option<&T> {
        let slot = self.slot(name, hash(name))?;
        self.entries.get(usize::from(self.place(slot)?)).map(|(_, value)| value)
    }

    /// The slot of a name; its [`hash`] is known.
    pub(crate) fn slot(&self, name: &str, hash: usize) -> Option<usize> {
        let last = self.slots.len() - 1;
        let mut slot = hash & last;
        loop {
            if self.entries[usize::from(self.place(slot)?)].0 == name {
                return Some(slot);
            }
            slot = (slot + 1) & last;
        }
    }

    /// The place of the entry that has a slot.
    #[inline]
    pub(crate) fn place(&self, slot: usize) -> Option<u16> {
        self.slots.get(slot).copied().filter(|place| *place != NONE)
    }
}

/// A number that is another one for most names: from their length, beginning, middle and end. For a name that stands
/// in the text of the model the compiler knows it.
#[inline]
pub(crate) fn hash(name: &str) -> usize {
    let bytes = name.as_bytes();
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

    #[test]
    fn a_name_has_its_value_among_many() {
        let names = crate::rs274::choices::QUIRKS.iter().copied().chain(["", "a", "b"]);
        let entries: Vec<(&'static str, usize)> = names.zip(0..).collect();
        // Crowded, so that many names lead to a slot that another one has.
        let slots = entries.len().next_power_of_two();
        let table = ByName::new(slots * 2, entries.clone());
        for (name, value) in entries {
            assert_eq!(table.get(name), Some(&value), "{name}");
        }
        assert_eq!(table.get("absent"), None);
    }
}
