//! The journal of a run of generated programs: what it is of, and its chunks.

use gaugeblock_vocabulary::Scenario;
use serde::{Deserialize, Serialize};

use super::groups::Finding;
use super::statistics::Statistics;

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
    pub config: String,
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
    /// Counts over its programs.
    pub statistics: Statistics,
    /// What was found, smallest programs only.
    pub found: Vec<Finding>,
    /// The first of its programs of which nothing can be said.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub not_judged: Vec<NotJudged>,
}

/// A program of which nothing can be said.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NotJudged {
    /// The program's number under the seed.
    pub number: u64,
    /// What stands in the way.
    pub why: String,
    /// The program and what it is run with.
    pub scenario: Scenario,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::journal::{FILE, Journal};

    fn header() -> Header {
        let of = |text: &str| text.to_owned();
        Header {
            journal: 0,
            version: of("1"),
            iut: of("a"),
            against: of("b"),
            options: of("edition"),
            config: of("any"),
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
        let chunk = |chunk| Chunk {
            chunk,
            statistics: Statistics::default(),
            found: Vec::new(),
            not_judged: Vec::new(),
        };
        let open = |header: &Header, resume| {
            let mut done = Vec::new();
            Journal::open(&folder, header, resume, &mut |chunk: Chunk| done.push(chunk))
                .map(|journal| (journal, done))
        };
        let (mut journal, done) = open(&header(), false).unwrap();
        assert!(done.is_empty());
        journal.done(&chunk(0)).unwrap();
        journal.done(&chunk(1)).unwrap();
        drop(journal);
        let text = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, &text[..text.len() - 5]).unwrap();
        assert!(open(&header(), false).is_err(), "nothing is overwritten");
        let other = Header { seed: 2, ..header() };
        assert!(open(&other, true).is_err(), "the journal of another run is refused");
        let (mut journal, done) = open(&header(), true).unwrap();
        assert_eq!(done, [chunk(0)]);
        journal.done(&chunk(2)).unwrap();
        drop(journal);
        let (_, done) = open(&header(), true).unwrap();
        assert_eq!(done, [chunk(0), chunk(2)]);
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
