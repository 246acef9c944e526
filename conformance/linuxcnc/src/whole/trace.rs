//! Follows the line numbers that the interpreter prints, to name the line of a refused block.

use crate::instrumentation::instrument::{Ends, Plan};
use crate::instrumentation::source::Source;

/// The interpreter's place in the instrumented files.
#[derive(Debug)]
pub(super) struct Trace {
    /// For each file its instrumented text, and the numbers of its own lines.
    files: Vec<(String, Vec<Option<u32>>)>,
    file: usize,
    line: u32,
    executing: bool,
}

impl Trace {
    /// The place at the beginning of the main program.
    pub(super) fn new(source: &Source, plan: &Plan) -> Self {
        let instrumented = |(file, (_, lines)): (usize, &(String, Vec<String>))| {
            let text = plan.with_checkpoints(file, lines, &Ends::default());
            let own = plan.own_lines(&text);
            (text, own)
        };
        let files = source.files().iter().enumerate().map(instrumented).collect();
        Self { files, file: 0, line: 0, executing: false }
    }

    /// Takes over the open file from a checkpoint.
    pub(super) fn set_file(&mut self, file: usize) {
        self.file = file;
    }

    /// Records that the execution of a block begins.
    pub(super) fn block(&mut self, text: &str, line: u32) {
        if !self.has(self.file, line, text) {
            let other = (0..self.files.len()).find(|file| self.has(*file, line, text));
            self.file = other.unwrap_or(self.file);
        }
        self.line = line;
        self.executing = true;
    }

    /// Records that the execution of the block has ended.
    pub(super) fn executed(&mut self) {
        self.executing = false;
    }

    /// Records the last line that the interpreter read.
    pub(super) fn line(&mut self, line: u32) {
        if !self.executing {
            self.line = line;
        }
    }

    /// The text of the refused line: the executed one, or else the next one that is read.
    pub(super) fn refused_line(&self) -> Option<String> {
        let line = if self.executing { self.line } else { self.line + 1 };
        let (text, own) = self.files.get(self.file)?;
        let place = usize::try_from(line).ok()?.checked_sub(1)?;
        own.get(place).copied().flatten()?;
        text.lines().nth(place).map(str::to_owned)
    }

    fn has(&self, file: usize, line: u32, text: &str) -> bool {
        let place = usize::try_from(line).ok().and_then(|line| line.checked_sub(1));
        let lines = self.files.get(file).map(|(text, _)| text);
        let found = lines.zip(place).and_then(|(lines, place)| lines.lines().nth(place));
        found.is_some_and(|found| found.trim() == text.trim())
    }
}
