//! What goes over the link, as text.

use std::fs::File;
use std::io::Write as _;
use std::path::Path;

use gaugeblock_adapter::HarnessError;
use gaugeblock_filesystem::open_output;

/// A file that gets a line for each line that goes over the link: `>` before what the adapter sends, `<` before what
/// it receives. `^X` is a soft reset.
#[derive(Debug)]
pub(crate) struct Transcript(File);

impl Transcript {
    /// Begins a transcript. What was in the file is gone.
    ///
    /// # Errors
    /// The file cannot be opened.
    pub(crate) fn create(path: &Path) -> Result<Self, HarnessError> {
        let file = open_output(path);
        file.map(Self).map_err(|error| failed(&format!("{}: {error}", path.display())))
    }

    /// The same transcript, for the next connection.
    ///
    /// # Errors
    /// The system has no handle left.
    pub(crate) fn go_on(&self) -> Result<Self, HarnessError> {
        self.0.try_clone().map(Self).map_err(|error| failed(&error.to_string()))
    }

    /// Writes down what the adapter sends.
    pub(crate) fn sent(&mut self, bytes: &[u8]) -> Result<(), HarnessError> {
        let text = String::from_utf8_lossy(bytes).replace('\u{18}', "^X");
        self.line('>', text.strip_suffix('\n').unwrap_or(&text))
    }

    /// Writes down a line that the adapter receives.
    pub(crate) fn received(&mut self, line: &str) -> Result<(), HarnessError> {
        self.line('<', line)
    }

    fn line(&mut self, mark: char, text: &str) -> Result<(), HarnessError> {
        let line = format!("{mark} {text}");
        writeln!(self.0, "{}", line.trim_end()).map_err(|error| failed(&error.to_string()))
    }
}

fn failed(why: &str) -> HarnessError {
    HarnessError::NotRun(format!("the transcript cannot be written: {why}"))
}
