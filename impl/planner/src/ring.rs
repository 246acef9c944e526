//! A queue of fixed size. Elements keep their number while they are in it.

use alloc::boxed::Box;
use alloc::vec;

/// Elements `first..end`, numbered since the planner was made.
#[derive(Debug)]
pub(crate) struct Ring<T> {
    slots: Box<[T]>,
    /// The number of slots, a power of two, minus one.
    mask: u64,
    first: u64,
    end: u64,
}

impl<T: Copy + Default> Ring<T> {
    /// Allocates room for at least so many elements.
    pub(crate) fn new(room: usize) -> Self {
        let slots = room.max(1).checked_next_power_of_two().unwrap_or(1);
        let mask = u64::try_from(slots).unwrap_or(u64::MAX).saturating_sub(1);
        Self { slots: vec![T::default(); slots].into_boxed_slice(), mask, first: 0, end: 0 }
    }

    pub(crate) fn first(&self) -> u64 {
        self.first
    }

    /// The number that the next element gets.
    pub(crate) fn end(&self) -> u64 {
        self.end
    }

    pub(crate) fn room(&self) -> u64 {
        self.mask.saturating_add(1).saturating_sub(self.end.wrapping_sub(self.first))
    }

    #[inline]
    pub(crate) fn get(&self, number: u64) -> Option<&T> {
        if self.holds(number) { self.slots.get(self.slot(number)) } else { None }
    }

    #[inline]
    pub(crate) fn get_mut(&mut self, number: u64) -> Option<&mut T> {
        let slot = self.slot(number);
        if self.holds(number) { self.slots.get_mut(slot) } else { None }
    }

    /// Appends an element. Without room it is lost, so check `room` first.
    pub(crate) fn push(&mut self, element: &T) {
        if let Some(place) = self.append() {
            *place = *element;
        }
    }

    /// Appends the old content of the slot, to be overwritten; `None` without room.
    #[inline]
    pub(crate) fn append(&mut self) -> Option<&mut T> {
        if self.room() == 0 {
            return None;
        }
        let slot = self.slot(self.end);
        let place = self.slots.get_mut(slot)?;
        self.end = self.end.wrapping_add(1);
        Some(place)
    }

    /// Appends a copy of the last element, to be changed; `None` without room.
    pub(crate) fn append_copy(&mut self) -> Option<&mut T> {
        if self.room() == 0 || self.end == self.first {
            return None;
        }
        let (last, slot) = (self.slot(self.end.wrapping_sub(1)), self.slot(self.end));
        let last = *self.slots.get(last)?;
        let place = self.slots.get_mut(slot)?;
        *place = last;
        self.end = self.end.wrapping_add(1);
        Some(place)
    }

    /// Drops the oldest element.
    pub(crate) fn drop_first(&mut self) {
        if self.first < self.end {
            self.first = self.first.wrapping_add(1);
        }
    }

    /// Drops the elements from a number on.
    pub(crate) fn truncate(&mut self, end: u64) {
        self.end = end.clamp(self.first, self.end);
    }

    /// Drops all elements; the numbers go on.
    pub(crate) fn clear(&mut self) {
        self.first = self.end;
    }

    #[inline]
    fn holds(&self, number: u64) -> bool {
        number.wrapping_sub(self.first) < self.end.wrapping_sub(self.first)
    }

    #[inline]
    fn slot(&self, number: u64) -> usize {
        usize::try_from(number & self.mask).unwrap_or(0)
    }
}
