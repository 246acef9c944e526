//! Numbered parameters `#1` to `#5602` (11.4.3.1), and which of them changed.

use alloc::boxed::Box;
use alloc::vec::Vec;
use core::ops::RangeInclusive;

/// Highest number of a parameter.
pub(crate) const LAST: u32 = 5602;
/// User parameters, which may be stored (11.4.3.1).
const USER: RangeInclusive<u32> = 31..=5000;
/// The persistent parameters (11.4.3): positions, offsets and coordinate systems.
const PERSISTENT: RangeInclusive<u32> = 5161..=5390;
/// Values, one for each number from 0; 0 is not a parameter and stays 0.
const COUNT: usize = 5603;
/// Room for what one block sets in addition to its settings.
const NOTES: usize = 64;
/// Words of 64 bits that hold a bit for each parameter.
const MARKS: usize = 88;

/// The numbered parameters. They start at zero.
#[derive(Clone, Debug)]
pub(crate) struct Numbered {
    values: Box<[f64; COUNT]>,
    /// A bit for each parameter that was set since the marks were last taken.
    marks: [u64; MARKS],
    /// A bit for each word of marks that has one, since a block sets few parameters.
    marked: u128,
    /// A bit for each that was reported then.
    reported: [u64; MARKS],
    /// The parameters that a block has set, with their old values, while the block can still be refused.
    notes: Vec<(u32, f64)>,
    /// Whether notes are taken.
    noting: bool,
}

impl Numbered {
    /// All parameters zero.
    pub(crate) fn new() -> Self {
        Self {
            values: Box::new([0.0; COUNT]),
            marks: [0; MARKS],
            marked: 0,
            reported: [0; MARKS],
            notes: Vec::with_capacity(NOTES),
            noting: false,
        }
    }

    /// All parameters zero again, as [`Self::new`] makes them. Only those are looked at that were ever set.
    pub(crate) fn clear(&mut self) {
        for (word, (marks, reported)) in
            (0_u32..).zip(self.marks.iter_mut().zip(&mut self.reported))
        {
            for number in numbers(word, *marks | *reported) {
                if let Some(value) =
                    usize::try_from(number).ok().and_then(|at| self.values.get_mut(at))
                {
                    *value = 0.0;
                }
            }
            (*marks, *reported) = (0, 0);
        }
        self.marked = 0;
        self.notes.clear();
        self.noting = false;
    }

    /// A parameter's value; an absent number reads 0.
    #[inline]
    pub(crate) fn get(&self, number: u32) -> f64 {
        let place = usize::try_from(number).unwrap_or(usize::MAX);
        self.values.get(place).copied().unwrap_or(0.0)
    }

    /// Sets a parameter; an absent number is ignored. Its value before comes back.
    #[inline]
    pub(crate) fn replace(&mut self, number: u32, value: f64) -> f64 {
        if number == 0 {
            return 0.0;
        }
        let place = usize::try_from(number).unwrap_or(usize::MAX);
        let Some(slot) = self.values.get_mut(place) else { return 0.0 };
        if let Some(marks) = self.marks.get_mut(place >> 6) {
            *marks |= 1 << (place & 63);
            self.marked |= 1 << (place >> 6);
        }
        core::mem::replace(slot, value)
    }

    /// Sets a parameter, likewise, and takes a note of it where notes are taken.
    #[inline]
    pub(crate) fn set(&mut self, number: u32, value: f64) {
        let before = self.replace(number, value);
        if self.noting {
            self.notes.push((number, before));
        }
    }

    /// Begins to take notes of what is set.
    #[inline]
    pub(crate) fn begin_notes(&mut self) {
        self.notes.clear();
        self.noting = true;
    }

    /// Takes no notes until [`Self::resume_notes`]; those that were taken stay.
    pub(crate) fn suspend_notes(&mut self) {
        self.noting = false;
    }

    /// Takes notes again.
    pub(crate) fn resume_notes(&mut self) {
        self.noting = true;
    }

    /// Keeps what was set.
    #[inline]
    pub(crate) fn end_notes(&mut self) {
        self.noting = false;
    }

    /// Restores the values from before [`Self::begin_notes`].
    #[cold]
    pub(crate) fn roll_back(&mut self) {
        self.noting = false;
        while let Some((number, before)) = self.notes.pop() {
            self.replace(number, before);
        }
    }

    /// Reports each parameter that was set since the last time, in ascending order, and forgets that it was.
    pub(crate) fn take_changes(&mut self, mut tell: impl FnMut(u32, f64)) {
        let mut marked = core::mem::take(&mut self.marked);
        while marked != 0 {
            let word = marked.trailing_zeros();
            marked &= marked.wrapping_sub(1);
            let place = usize::try_from(word).unwrap_or(usize::MAX);
            if let (Some(marks), Some(reported)) =
                (self.marks.get_mut(place), self.reported.get_mut(place))
            {
                *reported |= *marks;
                for number in numbers(word, core::mem::take(marks)) {
                    tell(number, value_of(&*self.values, number));
                }
            }
        }
    }

    /// The parameters that are not zero, in ascending order: some of those that were ever set.
    pub(crate) fn nonzero(&self) -> impl Iterator<Item = (u32, f64)> {
        let marks = self.marks.iter().zip(&self.reported).map(|(marks, reported)| marks | reported);
        (0_u32..)
            .zip(marks)
            .flat_map(|(word, marks)| numbers(word, marks))
            .map(|number| (number, value_of(&*self.values, number)))
            .filter(|(_, value)| *value != 0.0)
    }

    /// `#1` to `#30`, which a call keeps for its caller.
    pub(crate) fn arguments(&self) -> [f64; 30] {
        self.values.get(1..31).and_then(|slice| slice.try_into().ok()).unwrap_or([0.0; 30])
    }

    /// Sets `#1` to `#30`.
    pub(crate) fn set_arguments(&mut self, arguments: &[f64; 30]) {
        if let Some(slice) = self.values.get_mut(1..31) {
            slice.copy_from_slice(arguments);
        }
        if let Some(marks) = self.marks.first_mut() {
            *marks |= 0x7fff_fffe;
            self.marked |= 1;
        }
    }
}

/// Whether a parameter is stored while the machine is off. All others are volatile, and begin as if nothing were
/// stored (11.4.3).
pub(crate) fn is_stored(number: u32) -> bool {
    USER.contains(&number) || PERSISTENT.contains(&number)
}

/// The numbers of the parameters whose bits are set in a word of marks, in ascending order.
fn numbers(word: u32, mut marks: u64) -> impl Iterator<Item = u32> {
    core::iter::from_fn(move || {
        let bit = marks.trailing_zeros();
        (marks != 0).then(|| {
            marks &= marks.wrapping_sub(1);
            word.wrapping_shl(6) | bit
        })
    })
}

fn value_of(values: &[f64], number: u32) -> f64 {
    usize::try_from(number).ok().and_then(|at| values.get(at)).copied().unwrap_or(0.0)
}
