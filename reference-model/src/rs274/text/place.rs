//! Places of blocks in the files of a program.

/// The place of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// The file, in the order in which they were opened; 0 is the main program.
    pub file: usize,
    /// Line, from 1.
    pub line: u32,
}
