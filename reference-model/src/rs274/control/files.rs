//! The files of the program: the main one and those that calls name.

use std::collections::BTreeMap;
use std::sync::Arc;

use gaugeblock_vocabulary::{BlockLocation, Program};

use super::labels::Labels;
use crate::rs274::state::State;
use crate::rs274::text::{Line, Place, Source};

/// The name under which blocks are recorded that the operator enters by hand while a program is loaded.
pub const ENTRIES: &str = "mdi";

/// The files of the program, opened when they are called for the first time.
#[derive(Clone, Debug)]
pub struct Files {
    /// Texts by file name.
    texts: BTreeMap<String, String>,
    /// Whether blocks that begin with a slash are skipped.
    block_delete: bool,
    opened: Vec<File>,
}

#[derive(Clone, Debug)]
struct File {
    source: Arc<Source>,
    labels: Labels,
}

impl Files {
    pub(super) fn new(program: &Program) -> Self {
        let (texts, block_delete) = (program.files.clone(), program.block_delete);
        Self { texts, block_delete, opened: Vec::new() }
    }

    /// Opens the main program; its first block.
    pub(super) fn begin_main(&mut self, text: &str, state: &mut State) -> Place {
        self.add(Program::MAIN, text, state)
    }

    /// Opens a file, when there is one of this name; its first block.
    pub(super) fn open(&mut self, name: &str, state: &mut State) -> Option<Place> {
        // The main program is opened already, and is no file that is called.
        let called = self.opened.iter().skip(1).position(|file| file.source.name == name);
        if let Some(file) = called {
            return Some(self.begin(file + 1));
        }
        let text = self.texts.get(name)?.clone();
        Some(self.add(name, &text, state))
    }

    /// Whether there is a file of this name.
    pub(super) fn has(&self, name: &str) -> bool {
        self.texts.contains_key(name)
    }

    /// Whether there is a file of this name in another folder, in which calls do not look for files.
    pub(super) fn has_elsewhere(&self, name: &str) -> bool {
        self.texts.keys().any(|path| path.rsplit_once('/').is_some_and(|(_, file)| file == name))
    }

    /// Opens a file and reads it once for its labels, up to the percent line that ends it. This reading counts for no
    /// rule's coverage.
    fn add(&mut self, name: &str, text: &str, state: &mut State) -> Place {
        let mut source = Source::new(name, text, &state.choices);
        if let Some(main) = self.opened.first() {
            state.dialect().begin_called_file(&mut source, &main.source, &state.choices);
        }
        let mut labels = Labels::default();
        let before = state.coverage.set_muted(true);
        let mut index = source.first;
        loop {
            match source.line(index, self.block_delete, state) {
                None | Some(Line::End) => break,
                Some(Line::Nothing | Line::Skipped(_)) => {}
                Some(Line::Block(text)) => labels.read_line(line_number(index), text, state),
            }
            index += 1;
        }
        state.coverage.set_muted(before);
        labels.finish();
        self.opened.push(File { source: source.into(), labels });
        self.begin(self.opened.len() - 1)
    }

    /// Opens a text of which each line is entered by hand; its first line.
    pub fn begin_entries(&mut self, text: &str, state: &mut State) -> Place {
        self.add(ENTRIES, text, state)
    }

    /// The first block of a file.
    pub fn begin(&self, file: usize) -> Place {
        Place { file, line: line_number(self.opened[file].source.first) }
    }

    /// The labels of a file.
    pub(crate) fn labels(&self, file: usize) -> &Labels {
        &self.opened[file].labels
    }

    /// The labels of a file, to record where a sub ends.
    pub(super) fn labels_mut(&mut self, file: usize) -> &mut Labels {
        &mut self.opened[file].labels
    }

    /// The line at a place; none after the end of the file.
    pub fn line(&self, place: Place, state: &mut State) -> Option<Line<'_>> {
        self.line_of(self.source(place.file), place.line, state)
    }

    /// A line of a file; none after its end.
    pub fn line_of<'a>(
        &self,
        source: &'a Source,
        line: u32,
        state: &mut State,
    ) -> Option<Line<'a>> {
        let index = usize::try_from(line).ok()?.checked_sub(1)?;
        source.line(index, self.block_delete, state)
    }

    /// The text of a file.
    pub fn source(&self, file: usize) -> &Arc<Source> {
        &self.opened[file].source
    }

    /// A place as it is recorded.
    pub fn block(&self, place: Place) -> BlockLocation {
        BlockLocation::new(self.opened[place.file].source.name.as_str(), place.line)
    }
}

fn line_number(index: usize) -> u32 {
    u32::try_from(index).map_or(u32::MAX, |index| index.saturating_add(1))
}
