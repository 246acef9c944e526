//! Where program text comes from: a caller's file, memory, or a line from a serial port.

use alloc::borrow::Cow;
use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;

/// The text of a program and of its subroutine files, as much at a time as is ready.
///
/// A main program is read from front to back and never held whole, so it may be larger than memory; what runs again
/// (loops, subroutines) is kept as bytecode by the interpreter. Lines that are whole in the result of [`Self::text`]
/// are read in place.
pub trait Source {
    /// The text of the innermost open file from the reader's place; empty at its end. The same call again gives the
    /// same text.
    ///
    /// # Errors
    /// The file cannot be read on.
    fn text(&mut self) -> Result<&[u8], SourceError>;

    /// Moves on by so many bytes of what [`Self::text`] gave.
    fn consume(&mut self, bytes: usize);

    /// Goes to a place of the innermost open file, bytes from its beginning; `false` where the source cannot go back.
    ///
    /// It is called for M98, whose subprogram follows later in the file, and for jumps back to a loop that has ended.
    ///
    /// # Errors
    /// The file cannot be read any more.
    fn rewind(&mut self, offset: u64) -> Result<bool, SourceError>;

    /// Opens a subroutine file for reading; `false` where there is none of this name.
    ///
    /// The name is what the program says and `.ngc`. Which folders are searched is the caller's affair: a program
    /// reaches no other file.
    ///
    /// # Errors
    /// The file is there but cannot be read.
    fn open(&mut self, name: &str) -> Result<bool, SourceError>;

    /// Closes the innermost open subroutine file; reading continues in the one before it.
    fn close(&mut self);
}

/// Why a source could not be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceError {
    /// File name as the program or the caller calls it.
    pub file: String,
    /// For people.
    pub message: String,
}

/// A program in memory, with its subroutine files by name.
///
/// ```
/// use gaugeblock_interpreter::{Memory, Source};
///
/// let mut source = Memory::new("G1 X1 F100\nM2\n").with_file("probe.ngc", "o<probe> sub\no<probe> endsub\nM2\n");
/// assert!(source.open("probe.ngc")?);
/// # Ok::<(), gaugeblock_interpreter::SourceError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Memory<'a> {
    main: Cow<'a, [u8]>,
    files: BTreeMap<String, Cow<'a, [u8]>>,
    /// The reader's place in the main file.
    at: usize,
    /// The open subroutine files, innermost last, and the reader's place in each.
    open: Vec<(String, usize)>,
}

impl<'a> Memory<'a> {
    /// A program without subroutine files.
    pub fn new<T: AsRef<[u8]> + ?Sized>(main: &'a T) -> Self {
        Self { main: Cow::Borrowed(main.as_ref()), files: BTreeMap::new(), at: 0, open: Vec::new() }
    }

    /// Adds a subroutine file.
    #[must_use]
    pub fn with_file<T: AsRef<[u8]> + ?Sized>(
        mut self,
        name: impl Into<String>,
        text: &'a T,
    ) -> Self {
        self.files.insert(name.into(), Cow::Borrowed(text.as_ref()));
        self
    }
}

impl Source for Memory<'_> {
    fn text(&mut self) -> Result<&[u8], SourceError> {
        let (text, at) = match self.open.last() {
            Some((name, at)) => (self.files.get(name), *at),
            None => (Some(&self.main), self.at),
        };
        Ok(text.and_then(|text| text.get(at..)).unwrap_or(&[]))
    }

    fn consume(&mut self, bytes: usize) {
        let at = match self.open.last_mut() {
            Some((_, at)) => at,
            None => &mut self.at,
        };
        *at = at.saturating_add(bytes);
    }

    fn rewind(&mut self, offset: u64) -> Result<bool, SourceError> {
        let at = match self.open.last_mut() {
            Some((_, at)) => at,
            None => &mut self.at,
        };
        *at = usize::try_from(offset).unwrap_or(usize::MAX);
        Ok(true)
    }

    fn open(&mut self, name: &str) -> Result<bool, SourceError> {
        let there = self.files.contains_key(name);
        if there {
            self.open.push((name.into(), 0));
        }
        Ok(there)
    }

    fn close(&mut self) {
        self.open.pop();
    }
}
