//! The journal of a long run: a header that identifies the run, then a line for each finished piece (a case, or a chunk
//! of generated programs). A run that is killed loses at most the pieces that it had begun.

use std::fs::{File, OpenOptions};
use std::io::{BufRead as _, BufReader, Write as _};
use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;

/// The name of the journal's file in its folder.
pub const FILE: &str = "journal.jsonl";

/// An open journal.
#[derive(Debug)]
pub struct Journal {
    file: File,
}

impl Journal {
    /// Creates a journal in a folder, or opens one to resume its run; `done` receives each finished piece.
    ///
    /// # Errors
    /// The folder cannot be written, a journal exists although `resume` is false, or it belongs to another run.
    pub fn open<H, T>(
        folder: &Path,
        header: &H,
        resume: bool,
        done: &mut dyn FnMut(T),
    ) -> Result<Self, String>
    where
        H: Serialize + DeserializeOwned + PartialEq,
        T: DeserializeOwned,
    {
        let path = folder.join(FILE);
        let name = path.display();
        let failed = |error: std::io::Error| format!("{name}: {error}");
        let mut kept = 0;
        if path.exists() {
            if !resume {
                return Err(format!("{name}: the journal exists already"));
            }
            let mut lines = BufReader::new(File::open(&path).map_err(failed)?);
            let mut line = Vec::new();
            for at in 1.. {
                line.clear();
                lines.read_until(b'\n', &mut line).map_err(failed)?;
                // A line without its end was being written when the run was killed.
                if line.last() != Some(&b'\n') {
                    break;
                }
                let unreadable = |error: serde_json::Error| format!("{name}:{at}: {error}");
                if at > 1 {
                    done(serde_json::from_slice(&line).map_err(unreadable)?);
                } else if serde_json::from_slice::<H>(&line).map_err(unreadable)? != *header {
                    let first = String::from_utf8_lossy(&line);
                    return Err(format!(
                        "{name}: the journal belongs to another run: {}",
                        first.trim_end()
                    ));
                }
                kept += line.len();
            }
        }
        let file = OpenOptions::new().create(true).append(true).open(&path).map_err(failed)?;
        file.set_len(u64::try_from(kept).unwrap_or_default()).map_err(failed)?;
        let mut journal = Self { file };
        if kept == 0 {
            journal.line(header).map_err(|error| format!("{name}: {error}"))?;
        }
        Ok(journal)
    }

    /// Records a finished piece.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn done(&mut self, piece: &impl Serialize) -> Result<(), String> {
        self.line(piece)
    }

    fn line(&mut self, value: &impl Serialize) -> Result<(), String> {
        let mut line = serde_json::to_string(value).map_err(|error| error.to_string())?;
        line.push('\n');
        // One call for one line: a kill cuts the last line at worst.
        self.file.write_all(line.as_bytes()).map_err(|error| error.to_string())
    }
}
