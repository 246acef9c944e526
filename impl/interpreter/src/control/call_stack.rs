//! Call levels, and the labels that are defined at each.

use alloc::vec::Vec;

use crate::parameters::{NameId, ScopeMark};
use crate::syntax::bytecode::Keyword;

/// The segment that holds the block being read from the main program.
pub(crate) const STREAM: u32 = 0;
/// The segment that holds a loop of the main program.
pub(crate) const LOOP: u32 = 1;
/// The segment that holds the numbered subprograms.
pub(crate) const PROGRAMS: u32 = 2;

/// The place of the next block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Cursor {
    /// The segment; [`STREAM`] for the next line of the main program.
    pub(crate) segment: u32,
    /// The block within it.
    pub(crate) place: u32,
}

impl Cursor {
    /// The next line of the main program.
    pub(crate) const MAIN: Self = Self { segment: STREAM, place: 0 };

    /// The next block.
    pub(crate) fn after(self) -> Self {
        Self { place: self.place.saturating_add(1), ..self }
    }
}

/// How a call level was begun.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FrameKind {
    /// By an o-word.
    Sub,
    /// By M98.
    Numbered {
        /// How many turns follow this one.
        left: u64,
        /// First block.
        entry: u32,
    },
}

/// A call level.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    /// How it was begun.
    pub(crate) kind: FrameKind,
    /// The sub's label.
    pub(crate) label: NameId,
    /// Where the caller continues.
    pub(crate) back: Cursor,
    /// `#1` to `#30` of the caller.
    pub(crate) arguments: [f64; 30],
    /// How many of them the call has passed; only a planted fault asks.
    #[cfg(feature = "faults")]
    pub(crate) passed: u8,
    /// The caller's named parameters.
    pub(crate) mark: ScopeMark,
    /// How many labels were defined when it began.
    pub(crate) definitions: usize,
}

impl Frame {
    /// How many arguments the call has passed; all where no fault can be planted.
    pub(crate) fn passed(&self) -> usize {
        #[cfg(feature = "faults")]
        let passed = usize::from(self.passed);
        #[cfg(not(feature = "faults"))]
        let passed = self.arguments.len();
        passed
    }
}

/// A label that points to a condition or loop.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Definition {
    /// The label.
    pub(crate) label: NameId,
    /// The keyword that defines it: If, While, Do or Repeat.
    pub(crate) keyword: Keyword,
    /// Whether the structure has ended.
    pub(crate) ended: bool,
    /// The line that defines it.
    pub(crate) line: u32,
    /// Where that line begins in its file.
    pub(crate) offset: u64,
    /// The place of the block.
    pub(crate) at: Cursor,
    /// The generation of the segment [`LOOP`] in which the block is: another loop may have replaced that one since.
    pub(crate) generation: u32,
    /// Turns of a repeat that are left, this one included.
    pub(crate) left: u64,
}

/// The call levels above the main program, and all labels.
#[derive(Clone, Debug)]
pub(crate) struct CallStack {
    /// Innermost last.
    pub(crate) frames: Vec<Frame>,
    /// Level by level, those of the main program first; sorted by label within a level.
    definitions: Vec<Definition>,
    /// How many levels are outside of the profile that is read.
    pub(crate) outside_profile: usize,
}

impl CallStack {
    /// The main program, without labels.
    pub(crate) fn new() -> Self {
        Self { frames: Vec::new(), definitions: Vec::new(), outside_profile: 0 }
    }

    /// How many definitions there are at all levels.
    pub(crate) fn definitions(&self) -> usize {
        self.definitions.len()
    }

    /// Forgets the definitions of a level that is left.
    pub(crate) fn forget_definitions(&mut self, count: usize) {
        self.definitions.truncate(count);
    }

    /// Where the running level's definitions begin.
    fn base(&self) -> usize {
        self.frames.last().map_or(0, |frame| frame.definitions)
    }

    /// The place of a label's definition at the running level, or where it would be inserted.
    #[inline]
    fn search(&self, label: NameId) -> Result<usize, usize> {
        let base = self.base();
        let own = self.definitions.get(base..).unwrap_or(&[]);
        match own {
            // Few labels: look at each.
            [_, ..] if own.len() <= 4 => {
                match own.iter().position(|definition| definition.label >= label) {
                    Some(place) if own.get(place).is_some_and(|found| found.label == label) => {
                        Ok(base.wrapping_add(place))
                    }
                    Some(place) => Err(base.wrapping_add(place)),
                    None => Err(self.definitions.len()),
                }
            }
            _ => own
                .binary_search_by_key(&label, |definition| definition.label)
                .map(|place| base.wrapping_add(place))
                .map_err(|place| base.wrapping_add(place)),
        }
    }

    /// The definition of a label at the running level.
    #[inline]
    pub(crate) fn find(&mut self, label: NameId) -> Option<&mut Definition> {
        match self.search(label) {
            Ok(place) => self.definitions.get_mut(place),
            Err(_) => None,
        }
    }

    /// Defines a label at the running level, in place of an earlier definition.
    pub(crate) fn define(&mut self, definition: Definition) {
        match self.search(definition.label) {
            Ok(place) => {
                if let Some(slot) = self.definitions.get_mut(place) {
                    *slot = definition;
                }
            }
            Err(place) => self.definitions.insert(place, definition),
        }
    }
}
