//! Values by name, for names that stand in the text of the model: ids of rules and of choices.

/// Fewest slots of a table that is not empty.
const FEWEST_SLOTS: usize = 512;

/// Values by name. To find one costs the same however many there are.
#[derive(Clone, Debug)]
pub(crate) struct ByName<T> {
    /// Each name once, in the order in which they came.
    entries: Vec<(&'static str, T)>,
    /// Each slot holds the place of an entry plus one, or zero for none. An entry is in the slot that its name leads to, or in
    /// the next free one. There are a power of two of them, at least twice as many as entries.
    slots: Vec<u32>,
}

impl<T> Default for ByName<T> {
    fn default() -> Self {
        Self { entries: Vec::new(), slots: Vec::new() }
    }
}

impl<T> ByName<T> {
    /// The value of a name, if it has one.
    #[inline]
    pub(crate) fn get(&self, name: &str) -> Option<&T> {
        let place = self.find(name, mixed(name))?;
        self.entries.get(place).map(|(_, value)| value)
    }

    /// The value of a name, which has the default one when it comes for the first time.
    #[inline]
    pub(crate) fn value(&mut self, name: &'static str) -> &mut T
    where
        T: Default,
    {
        self.value_at(name, mixed(name))
    }

    fn value_at(&mut self, name: &'static str, mixed: usize) -> &mut T
    where
        T: Default,
    {
        let place = match self.at_first_sight(name, mixed) {
            Some(place) => place,
            None => self.find_or_add(name, mixed),
        };
        &mut self.entries[place].1
    }

    /// The place of a name's entry where it was made with the very same text and is in its first slot, as it most often is.
    #[inline]
    fn at_first_sight(&self, name: &str, mixed: usize) -> Option<usize> {
        let last = self.slots.len().wrapping_sub(1);
        let place = self.slots.get(mixed & last)?.checked_sub(1)? as usize;
        let (known, _) = self.entries.get(place)?;
        std::ptr::eq(*known, name).then_some(place)
    }

    /// The place of a name's entry.
    fn find(&self, name: &str, mixed: usize) -> Option<usize> {
        let last = self.slots.len().wrapping_sub(1);
        let mut slot = mixed & last;
        loop {
            let place = self.slots.get(slot)?.checked_sub(1)? as usize;
            if self.entries[place].0 == name {
                return Some(place);
            }
            slot = (slot + 1) & last;
        }
    }

    #[inline(never)]
    fn find_or_add(&mut self, name: &'static str, mixed: usize) -> usize
    where
        T: Default,
    {
        self.find(name, mixed).unwrap_or_else(|| self.add(name, mixed))
    }

    /// Adds an entry for a name that has none; its place.
    fn add(&mut self, name: &'static str, mixed: usize) -> usize
    where
        T: Default,
    {
        let place = self.entries.len();
        if place * 2 >= self.slots.len() {
            self.grow();
        }
        self.entries.push((name, T::default()));
        self.take_slot(place, mixed);
        place
    }

    fn grow(&mut self) {
        let slots = (self.slots.len() * 2).max(FEWEST_SLOTS);
        self.slots = vec![0; slots];
        self.entries.reserve_exact(slots / 2 - self.entries.len());
        for place in 0..self.entries.len() {
            self.take_slot(place, mixed(self.entries[place].0));
        }
    }

    /// Leads a name to its entry.
    fn take_slot(&mut self, place: usize, mixed: usize) {
        let last = self.slots.len() - 1;
        let mut slot = mixed & last;
        while self.slots[slot] != 0 {
            slot = (slot + 1) & last;
        }
        self.slots[slot] = u32::try_from(place + 1).expect("by name: the model has few names");
    }
}

/// A number that is another one for most names: from their length, beginning and end. For a name that stands in the text of the
/// model the compiler knows it.
#[inline]
fn mixed(name: &str) -> usize {
    let bytes = name.as_bytes();
    let first = bytes.first_chunk().copied().map_or(0, u64::from_le_bytes);
    let last = bytes.last_chunk().copied().map_or(0, u64::from_le_bytes);
    let both = first.rotate_left(23) ^ last.wrapping_add(bytes.len() as u64);
    usize::try_from(both.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_keeps_its_value_among_many() {
        let names: Vec<&'static str> = crate::rs274::readings::CHOICES
            .iter()
            .map(|(id, _)| *id)
            .chain(crate::rs274::readings::QUIRKS.iter().copied())
            .chain(["", "a", "b"])
            .collect();
        let mut table = ByName::default();
        for (place, name) in names.iter().copied().enumerate() {
            assert_eq!(table.get(name), None, "{name}");
            *table.value(name) = place;
        }
        for (place, name) in names.iter().copied().enumerate() {
            assert_eq!(table.get(name), Some(&place), "{name}");
            assert_eq!(*table.value(name), place, "{name}");
        }
        assert_eq!(table.get("absent"), None);
    }
}
