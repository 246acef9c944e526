//! An MDI block, as a source of one line; subs come from the program's source.

use crate::source::{Source, SourceError};

/// One line, and the files of its subs.
#[derive(Debug)]
pub(super) struct MdiSource<'a, S> {
    line: &'a [u8],
    at: usize,
    files: &'a mut S,
    /// How many files are open.
    open: u32,
}

impl<'a, S: Source> MdiSource<'a, S> {
    /// A line before its first byte.
    pub(super) fn new(line: &'a [u8], files: &'a mut S) -> Self {
        Self { line, at: 0, files, open: 0 }
    }

    /// Whether it has been read.
    pub(super) fn is_over(&self) -> bool {
        self.at >= self.line.len()
    }
}

impl<S: Source> Source for MdiSource<'_, S> {
    fn text(&mut self) -> Result<&[u8], SourceError> {
        if self.open != 0 {
            return self.files.text();
        }
        Ok(self.line.get(self.at..).unwrap_or(&[]))
    }

    fn consume(&mut self, bytes: usize) {
        if self.open != 0 {
            self.files.consume(bytes);
        } else {
            self.at = self.at.saturating_add(bytes);
        }
    }

    fn rewind(&mut self, offset: u64) -> Result<bool, SourceError> {
        if self.open != 0 {
            return self.files.rewind(offset);
        }
        self.at = usize::try_from(offset).unwrap_or(usize::MAX);
        Ok(true)
    }

    fn open(&mut self, name: &str) -> Result<bool, SourceError> {
        let opened = self.files.open(name)?;
        self.open = self.open.saturating_add(u32::from(opened));
        Ok(opened)
    }

    fn close(&mut self) {
        self.files.close();
        self.open = self.open.saturating_sub(1);
    }
}
