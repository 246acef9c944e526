//! The source of all choices of a generator: the bytes of a fuzzing engine, or a seed.

use arbitrary::Unstructured;

/// A sequence of choices, the same for the same bytes or seed on every platform.
#[derive(Debug)]
pub struct Entropy<'a>(Origin<'a>);

#[derive(Debug)]
enum Origin<'a> {
    Bytes(Unstructured<'a>),
    Seed(u64),
}

impl<'a> Entropy<'a> {
    /// Choices from bytes. When they are used up, each choice is the first one and each chance is false.
    pub fn from_bytes(bytes: &'a [u8]) -> Self {
        Self(Origin::Bytes(Unstructured::new(bytes)))
    }

    /// Choices for the program of this number under a seed. Numbers can be taken in any order.
    pub fn from_seed(seed: u64, number: u64) -> Self {
        let mut entropy = Self(Origin::Seed(seed ^ number.wrapping_mul(0xd134_2543_de82_ef95)));
        entropy.bits();
        entropy.bits();
        entropy
    }

    /// Whether the bytes are used up. A seed never is.
    pub fn is_exhausted(&self) -> bool {
        match &self.0 {
            Origin::Bytes(bytes) => bytes.is_empty(),
            Origin::Seed(_) => false,
        }
    }

    /// 64 bits of a seed (`SplitMix64`); zero from bytes, which are taken in ranges.
    fn bits(&mut self) -> u64 {
        let Origin::Seed(state) = &mut self.0 else { return 0 };
        *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// A number below `bound`; zero where `bound` is.
    pub fn below(&mut self, bound: u32) -> u32 {
        let Some(last) = bound.checked_sub(1) else { return 0 };
        if let Origin::Bytes(bytes) = &mut self.0 {
            return bytes.int_in_range(0..=last).unwrap_or_default();
        }
        let scaled = (self.bits() >> 32).wrapping_mul(u64::from(bound)) >> 32;
        u32::try_from(scaled).unwrap_or_default()
    }

    /// A number from `first` to `last`.
    pub fn range(&mut self, first: u32, last: u32) -> u32 {
        first.saturating_add(self.below(last.saturating_sub(first).saturating_add(1)))
    }

    /// True in `percent` of a hundred draws.
    pub fn chance(&mut self, percent: u32) -> bool {
        self.below(100) >= 100_u32.saturating_sub(percent)
    }

    /// A member of a slice that is not empty.
    ///
    /// # Panics
    /// The slice is empty.
    pub fn pick<'t, T>(&mut self, members: &'t [T]) -> &'t T {
        let count = u32::try_from(members.len()).unwrap_or(u32::MAX);
        let place = usize::try_from(self.below(count)).unwrap_or_default();
        members.get(place).expect("the slice has members")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_repeats_and_numbers_differ() {
        let draw = |seed, number| {
            let mut entropy = Entropy::from_seed(seed, number);
            (0..20).map(|_| entropy.below(1000)).collect::<Vec<_>>()
        };
        assert_eq!(draw(7, 3), draw(7, 3));
        assert_ne!(draw(7, 3), draw(7, 4));
        assert_ne!(draw(7, 3), draw(8, 3));
        assert!(draw(7, 3).iter().all(|number| *number < 1000));
    }

    #[test]
    fn spent_bytes_choose_the_first() {
        let mut entropy = Entropy::from_bytes(&[200]);
        assert!(!entropy.is_exhausted());
        assert_eq!(entropy.below(256), 200);
        assert!(entropy.is_exhausted());
        assert_eq!(entropy.below(256), 0);
        assert!(!entropy.chance(99));
    }
}
