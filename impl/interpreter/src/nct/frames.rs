//! Programs in progress, and modal calls in force: G66 and G66.1, each until its G67.

use super::variables::Locals;

/// Which of the modal calls in force the blocks of a program trigger. Of these, the one that was commanded last is
/// called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reach {
    /// Every modal call in force.
    All,
    /// Only the first N modal calls, in the order in which they were commanded.
    First(usize),
    /// The documents do not say which.
    Unspecified,
}

/// A program in progress.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// Its place among the programs.
    pub(super) program: usize,
    /// Its next block.
    pub(super) next: usize,
    /// Which modal calls its blocks trigger.
    pub(super) reach: Reach,
    /// Whether it has a macro level of its own, with its own local variables.
    pub(super) is_macro: bool,
    /// How many runs of it are left, the one in progress included.
    pub(super) left: u32,
    /// How many modal calls were in force when it began.
    pub(super) modal_calls: usize,
    /// Whether the documents do not say what G66, G66.1 and G67 do in this program.
    pub(super) commands_unspecified: bool,
}

impl Frame {
    /// The main program, from its first block on.
    pub(super) fn main(first: usize) -> Self {
        Self {
            program: 0,
            next: first,
            reach: Reach::All,
            is_macro: false,
            left: 1,
            modal_calls: 0,
            commands_unspecified: false,
        }
    }
}

/// A call: what P and L of it say.
#[derive(Clone, Copy, Debug)]
pub(super) struct Call {
    /// The program's number (P). None where no program can have the number.
    pub(super) program: Option<u32>,
    /// How often it is called (L).
    pub(super) repeats: u32,
}

/// A modal call in force.
#[derive(Clone, Copy, Debug)]
pub(super) struct ModalCall {
    /// The program, and how often it is called each time.
    pub(super) call: Call,
    /// Whether each block calls it (G66.1), and not only each move (G66).
    pub(super) by_block: bool,
    /// The local variables with which the called program begins.
    pub(super) arguments: Locals,
}
