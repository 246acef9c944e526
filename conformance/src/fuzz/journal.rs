//! The journal of a run: a header, then a line for each chunk that is done. A kill at any moment loses at most the chunks in work.

use std::fs::{File, OpenOptions};
use std::io::{BufRead as _, BufReader, Write as _};
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::groups::Find;
use super::statistics::Statistics;

/// Name of the journal in its folder.
pub const FILE: &str = "journal.jsonl";

/// What a journal is of; a run can be resumed only as what it was begun.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Header {
    /// Form of the journal.
    pub journal: u32,
    /// Version of gaugeblock, whose generator the numbers are of.
    pub version: String,
    /// The controller under test and its version.
    pub iut: String,
    /// The controller that it is compared with and its version.
    pub against: String,
    /// Edition and how options are chosen.
    pub options: String,
    /// What is generated, in one line.
    pub recipe: String,
    /// The seed.
    pub seed: u64,
    /// The shard, `1/1` for the whole.
    pub shard: String,
}

/// A chunk that is done.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Chunk {
    /// Its number.
    pub chunk: u64,
    /// What its programs came to.
    pub statistics: Statistics,
    /// What was found, smallest programs only.
    pub found: Vec<Find>,
}

/// An open journal.
#[derive(Debug)]
pub struct Journal {
    file: File,
}

impl Journal {
    /// Begins a journal in a folder, or goes on with the one there; `done` is told of each chunk that is done, one at a time.
    ///
    /// # Errors
    /// The folder cannot be written, a journal is there although nothing is to be resumed, or it is of something else.
    pub fn open(
        folder: &Path,
        header: &Header,
        resume: bool,
        done: &mut dyn FnMut(Chunk),
    ) -> Result<Self, String> {
        let path = folder.join(FILE);
        let name = path.display();
        let failed = |error: std::io::Error| format!("{name}: {error}");
        let mut kept = 0;
        if path.exists() {
            if !resume {
                return Err(format!("{name}: there is a journal already"));
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
                } else if serde_json::from_slice::<Header>(&line).map_err(unreadable)? != *header {
                    let first = String::from_utf8_lossy(&line);
                    return Err(format!("{name}: it is of another run: {}", first.trim_end()));
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

    /// Writes down that a chunk is done.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn done(&mut self, chunk: &mut Chunk) -> Result<(), String> {
        chunk.statistics.settle();
        self.line(chunk)
    }

    fn line(&mut self, value: &impl Serialize) -> Result<(), String> {
        let mut line = serde_json::to_string(value).map_err(|error| error.to_string())?;
        line.push('\n');
        // One call for one line: a kill cuts the last line at worst.
        self.file.write_all(line.as_bytes()).map_err(|error| error.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header() -> Header {
        let of = |text: &str| text.to_owned();
        Header {
            journal: 0,
            version: of("1"),
            iut: of("a"),
            against: of("b"),
            options: of("edition"),
            recipe: of("any"),
            seed: 1,
            shard: of("1/1"),
        }
    }

    #[test]
    fn a_cut_line_is_done_again() {
        let folder =
            std::env::temp_dir().join(format!("gaugeblock-journal-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.join(FILE);
        let _absent = std::fs::remove_file(&path);
        let chunk = |chunk| Chunk { chunk, statistics: Statistics::default(), found: Vec::new() };
        let open = |header: &Header, resume| {
            let mut done = Vec::new();
            Journal::open(&folder, header, resume, &mut |chunk| done.push(chunk))
                .map(|journal| (journal, done))
        };
        let (mut journal, done) = open(&header(), false).unwrap();
        assert!(done.is_empty());
        journal.done(&mut chunk(0)).unwrap();
        journal.done(&mut chunk(1)).unwrap();
        drop(journal);
        let text = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, &text[..text.len() - 5]).unwrap();
        assert!(open(&header(), false).is_err(), "nothing is overwritten");
        let other = Header { seed: 2, ..header() };
        assert!(open(&other, true).is_err(), "another run is not gone on with");
        let (mut journal, done) = open(&header(), true).unwrap();
        assert_eq!(done, [chunk(0)]);
        journal.done(&mut chunk(2)).unwrap();
        drop(journal);
        let (_, done) = open(&header(), true).unwrap();
        assert_eq!(done, [chunk(0), chunk(2)]);
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
