//! The state that a sink receives before a block: its evaluated words, and the stored offsets.

use gaugeblock_vocabulary::Position;

use crate::modal::offsets;
use crate::parameters::Numbered;
use crate::words::Words;

/// The words of a block that is about to be executed.
#[derive(Clone, Copy, Debug)]
pub struct BlockStart<'a> {
    pub(crate) words: &'a Words,
    pub(crate) numbered: &'a Numbered,
}

impl BlockStart<'_> {
    /// The line in its file, from 1.
    pub fn line(&self) -> u32 {
        self.words.line
    }

    /// G codes in tenths (`G38.2` is 382), in the order of writing.
    pub fn g(&self) -> &[u16] {
        self.words.g.get(..usize::from(self.words.g_count)).unwrap_or(&[])
    }

    /// M codes, in the order of writing.
    pub fn m(&self) -> &[u16] {
        self.words.m.get(..usize::from(self.words.m_count)).unwrap_or(&[])
    }

    /// The value of the word of a letter, in upper case; G, M, N and O have none.
    pub fn letter(&self, letter: u8) -> Option<f64> {
        self.words.get(letter)
    }

    /// `$`: a spindle number.
    pub fn dollar(&self) -> Option<f64> {
        self.words.dollar
    }

    /// The stored origin of a work coordinate system from 1 to 9 (machine units) and its rotation (degrees), as the
    /// block finds them.
    pub fn work_offset(&self, system: u32) -> (Position, f64) {
        let origin = offsets::origin(self.numbered, system).position();
        (origin, offsets::rotation(self.numbered, system))
    }
}
