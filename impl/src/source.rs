//! Where program text comes from: a caller's file, memory, or a line from a serial port.

use alloc::string::String;
use alloc::vec::Vec;

/// What a source had to give.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    /// A line stands in the buffer.
    Read,
    /// The file is over.
    End,
}

/// The text of a program and of its subroutine files, a line at a time.
///
/// A main program is read once from front to back and never held whole, so it may be larger than memory; what runs
/// again (loops, subroutines) is kept in packed form by the interpreter.
pub trait Source {
    /// Puts the next line of the innermost open file into `line`, without its line break.
    ///
    /// `line` comes empty and keeps its allocation from call to call. A line longer than
    /// [`crate::Limits::line_length`] may be cut one byte beyond it: the interpreter refuses it either way.
    ///
    /// # Errors
    /// The file cannot be read on.
    fn read_line(&mut self, line: &mut Vec<u8>) -> Result<Line, Unreadable>;

    /// Opens a subroutine file for reading; `false` where there is none of this name.
    ///
    /// The name is what the program says. Which folders are searched is the caller's affair: a program reaches no other file.
    ///
    /// # Errors
    /// The file is there but cannot be read.
    fn open(&mut self, name: &str) -> Result<bool, Unreadable>;

    /// Closes the innermost open subroutine file; reading goes on in the one that it was called from.
    fn close(&mut self);
}

/// Why a source could not be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unreadable {
    /// File name as the program or the caller calls it.
    pub file: String,
    /// For people.
    pub message: String,
}
