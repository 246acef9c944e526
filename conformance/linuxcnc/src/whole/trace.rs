//! Which line the interpreter has before it, by the numbers that it prints: for naming a refused block.

use crate::instrumentation::instrument::{Ends, Plan};
use crate::instrumentation::source::Source;

/// The interpreter's place in the probed files.
#[derive(Debug)]
pub(super) struct Trace {
    /// For each file its probed text, and the numbers of its own lines.
    files: Vec<(String, Vec<Option<u32>>)>,
    file: usize,
    line: u32,
    executing: bool,
}

impl Trace {
    /// At the beginning of the main program.
    pub(super) fn new(source: &Source, plan: &Plan) -> Self {
        let probed = |(file, (_, lines)): (usize, &(String, Vec<String>))| {
            let text = plan.with_probes(file, lines, &Ends::default());
            let own = plan.own_lines(&text);
            (text, own)
        };
        let files = source.files().iter().enumerate().map(probed).collect();
        Self { files, file: 0, line: 0, executing: false }
    }

    /// A probe reported which file is open.
    pub(super) fn stands_in(&mut self, file: usize) {
        self.file = file;
    }

    /// A block is about to be executed.
    pub(super) fn block(&mut self, text: &str, line: u32) {
        if !self.has(self.file, line, text) {
            let other = (0..self.files.len()).find(|file| self.has(*file, line, text));
            self.file = other.unwrap_or(self.file);
        }
        self.line = line;
        self.executing = true;
    }

    /// Its execution is over.
    pub(super) fn executed(&mut self) {
        self.executing = false;
    }

    /// The interpreter is after this line.
    pub(super) fn line(&mut self, line: u32) {
        if !self.executing {
            self.line = line;
        }
    }

    /// The text of the line that is refused: the one that is executed, or else the next one that is read.
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
