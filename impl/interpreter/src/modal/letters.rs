//! The letters of words as bits of a mask, as in [`Words::present`].

use crate::words::Words;

macro_rules! letters {
    ($($name:ident = $place:literal,)*) => {
        $(pub(crate) const $name: u32 = 1 << $place;)*
    };
}

letters! {
    A = 0, B = 1, C = 2, D = 3, E = 4, F = 5, H = 7, I = 8, J = 9, K = 10, L = 11, P = 15, Q = 16, R = 17, S = 18,
    T = 19, U = 20, V = 21, W = 22, X = 23, Y = 24, Z = 25,
}

/// The nine axis letters.
pub(crate) const AXES: u32 = A | B | C | U | V | W | X | Y | Z;

/// The letters of an arc besides its axis words.
pub(crate) const ARC_WORDS: u32 = I | J | K | P | R;

impl Words {
    /// Whether the block has an axis word.
    pub(crate) fn has_axes(&self) -> bool {
        self.present & AXES != 0
    }

    /// The G words as written.
    pub(crate) fn g_words(&self) -> &[u16] {
        self.g.get(..usize::from(self.g_count)).unwrap_or(&self.g)
    }

    /// The M words as written.
    pub(crate) fn m_words(&self) -> &[u16] {
        self.m.get(..usize::from(self.m_count)).unwrap_or(&self.m)
    }
}

/// The first letter of a mask, for people.
pub(crate) fn first_letter(mask: u32) -> char {
    ('A'..='Z').nth(usize::try_from(mask.trailing_zeros()).unwrap_or(0)).unwrap_or('?')
}
