//! Programs in progress and modal calls in force, as data; [`calls`](super::calls) has their rules.

use super::variables::Locals;

/// A modal call in force.
#[derive(Clone, Debug)]
pub struct ModalCall {
    /// The number of its program.
    pub program: i64,
    /// How often it is called.
    pub repeats: u32,
    /// The arguments of each call; those of the block where it is called by block.
    pub arguments: Locals,
    /// G66.1: it takes each block as arguments.
    pub by_block: bool,
}

/// A program in progress.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Which program.
    pub program: usize,
    /// The block that comes next.
    pub next: usize,
    /// What called it.
    pub kind: Kind,
    /// How often it is executed from now on, this time included.
    pub repeats: u32,
    /// Which modal calls its blocks reach.
    pub reach: Reach,
    /// How many modal calls there were when it began.
    pub modal_calls: usize,
}

/// What a program was called by.
#[derive(Clone, Debug)]
pub enum Kind {
    /// Nothing: it is the main program.
    Main,
    /// M98.
    Sub,
    /// A macro call, with these arguments.
    Macro(Box<Locals>),
}

/// Which modal calls the blocks of a program reach.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// All that are in force.
    All,
    /// The first ones, so many.
    First(usize),
    /// The documents do not say: it was called by G65 while a modal call was in force.
    Open,
}
