//! The words of one block after evaluation: what the syntax hands to the modal side.

/// Most G words of a block: more than there are modal groups is a conflict anyhow.
pub(crate) const G_WORDS: usize = 24;
/// Most M words of a block that are kept before it is refused for their number.
pub(crate) const M_WORDS: usize = 8;

/// The words of one block. Values are as the program writes them: active unit, degrees, degrees of plane.
#[derive(Clone, Debug)]
pub(crate) struct Words {
    /// Line in its file, from 1.
    pub(crate) line: u32,
    /// Bit n: letter `b'A' + n` has a value. G, M, N and O are never set.
    pub(crate) present: u32,
    /// By letter, `A` first; 0 where absent.
    pub(crate) values: [f64; 26],
    /// G codes in tenths (`G38.2` is 382), in the order of writing.
    pub(crate) g: [u16; G_WORDS],
    /// How many of `g` count.
    pub(crate) g_count: u8,
    /// M codes in the order of writing; an unknown number is kept as written.
    pub(crate) m: [u16; M_WORDS],
    /// How many of `m` count.
    pub(crate) m_count: u8,
    /// `$`: a spindle number.
    pub(crate) dollar: Option<f64>,
    /// `@`: a polar distance.
    pub(crate) at: Option<f64>,
    /// `^`: a polar angle, degrees.
    pub(crate) caret: Option<f64>,
}

impl Words {
    /// No words.
    pub(crate) fn new() -> Self {
        Self {
            line: 0,
            present: 0,
            values: [0.0; 26],
            g: [0; G_WORDS],
            g_count: 0,
            m: [0; M_WORDS],
            m_count: 0,
            dollar: None,
            at: None,
            caret: None,
        }
    }

    /// Takes all words away.
    #[inline]
    pub(crate) fn clear(&mut self, line: u32) {
        self.line = line;
        if self.present != 0 {
            self.values = [0.0; 26];
            self.present = 0;
        }
        self.g_count = 0;
        self.m_count = 0;
        self.dollar = None;
        self.at = None;
        self.caret = None;
    }

    /// Whether there is no word at all.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.present == 0
            && self.g_count == 0
            && self.m_count == 0
            && self.dollar.is_none()
            && self.at.is_none()
            && self.caret.is_none()
    }

    /// Sets the word of a letter, given as its place from 0 for A.
    #[inline]
    pub(crate) fn set(&mut self, place: u8, value: f64) {
        if let Some(slot) = self.values.get_mut(usize::from(place)) {
            *slot = value;
            self.present |= 1_u32.wrapping_shl(u32::from(place));
        }
    }

    /// Whether a letter, in upper case, has a value.
    #[inline]
    pub(crate) fn has(&self, letter: u8) -> bool {
        let place = u32::from(letter.wrapping_sub(b'A'));
        place < 26 && self.present & 1_u32.wrapping_shl(place) != 0
    }

    /// The value of a letter, in upper case.
    #[inline]
    pub(crate) fn get(&self, letter: u8) -> Option<f64> {
        if !self.has(letter) {
            return None;
        }
        self.values.get(usize::from(letter.wrapping_sub(b'A'))).copied()
    }

    /// Adds a G code in tenths; false when there are too many.
    #[inline]
    pub(crate) fn push_g(&mut self, code: u16) -> bool {
        let Some(slot) = self.g.get_mut(usize::from(self.g_count)) else { return false };
        *slot = code;
        self.g_count = self.g_count.wrapping_add(1);
        true
    }

    /// Adds an M code; false when there are too many.
    #[inline]
    pub(crate) fn push_m(&mut self, code: u16) -> bool {
        let Some(slot) = self.m.get_mut(usize::from(self.m_count)) else { return false };
        *slot = code;
        self.m_count = self.m_count.wrapping_add(1);
        true
    }

    /// Whether the words include an M code.
    #[inline]
    pub(crate) fn has_m(&self, code: u16) -> bool {
        self.m.iter().take(usize::from(self.m_count)).any(|m| *m == code)
    }
}
