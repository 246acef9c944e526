//! The search: the smallest scenario so far, and the attempts.

use gaugeblock_vocabulary::Scenario;

/// A search for a smaller scenario.
pub(super) struct Search<'a> {
    pub(super) best: Scenario,
    pub(super) holds: &'a mut dyn FnMut(&Scenario) -> bool,
    pub(super) attempts: u32,
    pub(super) most: u32,
}

impl Search<'_> {
    /// Keeps a smaller scenario if it still has the property.
    pub(super) fn attempt(&mut self, smaller: Scenario) -> bool {
        if self.attempts >= self.most || smaller == self.best {
            return false;
        }
        self.attempts += 1;
        let holds = (self.holds)(&smaller);
        if holds {
            self.best = smaller;
        }
        holds
    }

    /// Attempts another text of a file; the main program is the one without a name.
    pub(super) fn attempt_text(&mut self, file: Option<&str>, text: String) -> bool {
        let mut smaller = self.best.clone();
        match file {
            None => smaller.program.main = text,
            Some(name) => {
                smaller.program.files.insert(name.to_owned(), text);
            }
        }
        self.attempt(smaller)
    }

    pub(super) fn text(&self, file: Option<&str>) -> String {
        match file {
            None => self.best.program.main.clone(),
            Some(name) => self.best.program.files.get(name).cloned().unwrap_or_default(),
        }
    }

    /// The main program and the names of the files.
    pub(super) fn files(&self) -> Vec<Option<String>> {
        let names = self.best.program.files.keys().cloned().map(Some);
        std::iter::once(None).chain(names).collect()
    }
}
