//! The words of a block, and how far it has come.

use gaugeblock_interpreter::BlockStart;
use gaugeblock_vocabulary::Position;

use super::codes::{MOTIONS, WORK_OFFSETS, system_of};

/// G80.
const CANCEL: u16 = 800;

/// The words of a block.
#[derive(Clone, Debug, Default)]
pub(super) struct Words {
    pub(super) g: Vec<u16>,
    pub(super) m: Vec<u16>,
    letters: [Option<f64>; 26],
    pub(super) dollar: Option<f64>,
    /// What is stored of the work coordinate system that the block selects before G10: origin (inches) and rotation
    /// (degrees).
    pub(super) stored: Option<(Position, f64)>,
}

impl Words {
    /// Takes over the words of a block that begins.
    pub(super) fn take(&mut self, begun: &BlockStart<'_>) {
        self.g.clear();
        self.g.extend_from_slice(begun.g());
        if self.g.iter().any(|code| *code != CANCEL && MOTIONS.contains(code)) {
            // Quirk rs274.cancel-with-motion.
            self.g.retain(|code| *code != CANCEL);
        }
        self.m.clear();
        self.m.extend_from_slice(begun.m());
        for (letter, value) in (b'A'..=b'Z').zip(&mut self.letters) {
            *value = begun.letter(letter);
        }
        self.dollar = begun.dollar();
        let selected = self.g_of(&WORK_OFFSETS).filter(|_| self.g.contains(&100));
        self.stored = selected.map(|code| begun.work_offset(system_of(code)));
    }

    /// The value of a letter, in upper case.
    pub(super) fn get(&self, letter: u8) -> Option<f64> {
        self.letters.get(usize::from(letter.wrapping_sub(b'A'))).copied().flatten()
    }

    /// The first G code of a list that is among the words.
    pub(super) fn g_of(&self, codes: &[u16]) -> Option<u16> {
        self.g.iter().copied().find(|code| codes.contains(code))
    }

    pub(super) fn has_m(&self, code: u16) -> bool {
        self.m.contains(&code)
    }
}

/// A part of a block. All before the one at which it was refused has been printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Phase {
    /// Nothing: it was refused before anything was executed.
    Comment,
    SpindleMode,
    FeedMode,
    Speed,
    Tool,
    Outputs,
    Change,
    Spindle,
    Saved,
    Coolant,
    Overrides,
    Dwell,
    Plane,
    Compensation,
    Modes,
    Offsets,
    Motion,
    Stop,
    /// It was executed whole.
    End,
}
