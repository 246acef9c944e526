//! The state that a sink receives after each block: enough to record a run, at no cost to a sink that does not look.

use core::fmt;

use gaugeblock_vocabulary::{Position, Rs274State, Settings};

use crate::modal::Modal;
use crate::parameters::{Names, Parameters};

/// The kind of an executed block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BlockKind {
    /// Words, settings of parameters, perhaps with a comment; a line number alone.
    Words,
    /// A comment that may act, and nothing else; one that had nothing to say did nothing.
    Comment,
    /// An o-word that is neither a call nor a return.
    OWord,
    /// A call by an o-word; the callee's first block comes next.
    Call,
    /// A return or endsub; the caller goes on.
    Return,
    /// M98.
    NumberedCall,
    /// M99.
    NumberedReturn,
    /// M2 or M30.
    End,
}

/// A block that was executed, and the state after it.
pub struct BlockEnd<'a> {
    pub(crate) file: &'a str,
    pub(crate) line: u32,
    pub(crate) kind: BlockKind,
    pub(crate) parameters: &'a mut Parameters,
    pub(crate) modal: &'a Modal,
    pub(crate) names: &'a Names,
}

impl BlockEnd<'_> {
    /// The file's name; `main.ngc` for the main program.
    pub fn file(&self) -> &str {
        self.file
    }

    /// The line in that file, from 1.
    pub fn line(&self) -> u32 {
        self.line
    }

    /// The kind of the block.
    pub fn kind(&self) -> BlockKind {
        self.kind
    }

    /// Depth of calls after the block; 0 in the main program.
    pub fn call_level(&self) -> u32 {
        self.parameters.call_level
    }

    /// Modes, position, tool and call level; the methods below report parameters.
    pub fn state(&self) -> Rs274State {
        let mut state = self.modal.state();
        state.call_level = Some(self.parameters.call_level);
        state
    }

    /// All settings in force.
    pub fn settings(&self) -> Settings {
        self.modal.settings()
    }

    /// Reports each numbered parameter that was set since the last call, in ascending order, also where its value is
    /// the same as before. A call and a return count as setting `#1` to `#30`. Position and tool, #5420 to #5428, are
    /// not among them: they are in the state.
    pub fn take_numbered(&mut self, tell: impl FnMut(u32, f64)) {
        self.parameters.numbered.take_changes(tell);
    }

    /// Where the controlled point is: machine coordinates, machine unit.
    pub fn machine_point(&self) -> Position {
        self.modal.machine_point().position()
    }

    /// Sets the values of HAL items that programs read from the next block on, in the order in which they were
    /// declared ([`Interpreter::declare_items`](crate::Interpreter::declare_items)).
    pub fn set_items(&mut self, values: &[f64]) {
        self.parameters.set_items(values);
    }

    /// Reports each named parameter that was set since the last call and is visible at this call level, also where its
    /// value is the same as before.
    pub fn take_named(&mut self, report: impl FnMut(&str, f64)) {
        self.parameters.named.take_changes(self.names, report);
    }

    /// The local named parameters of this call level. One can be listed twice.
    pub fn locals(&self) -> impl Iterator<Item = (&str, f64)> {
        self.parameters.named.locals(self.names)
    }

    /// Every named parameter that exists and is visible at this call level, by name; global ones begin with an
    /// underscore. Predefined ones are not among them.
    pub fn named(&self) -> impl Iterator<Item = (&str, f64)> {
        self.parameters.named.existing(self.names)
    }
}

impl fmt::Debug for BlockEnd<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("BlockDone")
            .field("file", &self.file)
            .field("line", &self.line)
            .field("kind", &self.kind)
            .finish_non_exhaustive()
    }
}
