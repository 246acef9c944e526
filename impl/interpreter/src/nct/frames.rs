//! Programs in progress and modal calls in force.

use super::variables::Locals;

/// Which modal calls the blocks of a program reach.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reach {
    All,
    /// So many that were commanded first.
    Below(usize),
    /// The documents leave it open.
    Open,
}

/// A program in progress.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// Its place among the programs.
    pub(super) program: usize,
    /// Its next block.
    pub(super) next: usize,
    pub(super) reach: Reach,
    /// Whether it has a level of its own.
    pub(super) is_macro: bool,
    /// How often it is to be called, this time counted.
    pub(super) left: u32,
    /// Modal calls in force when it began.
    pub(super) modal_calls: usize,
    /// Whether it is open what G66, G66.1 and G67 do in it.
    pub(super) commands_open: bool,
}

impl Frame {
    pub(super) fn main(first: usize) -> Self {
        Self {
            program: 0,
            next: first,
            reach: Reach::All,
            is_macro: false,
            left: 1,
            modal_calls: 0,
            commands_open: false,
        }
    }
}

/// A call: what P and L of it say.
#[derive(Clone, Copy, Debug)]
pub(super) struct Call {
    /// None where no program can have the number.
    pub(super) program: Option<u32>,
    pub(super) repeats: u32,
}

/// A modal call in force.
#[derive(Clone, Copy, Debug)]
pub(super) struct ModalCall {
    pub(super) call: Call,
    pub(super) by_block: bool,
    pub(super) arguments: Locals,
}
