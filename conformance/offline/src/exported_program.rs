//! What a campaign requests of one program.

use gaugeblock_vocabulary::Axis;
use serde::{Deserialize, Serialize};

/// An exported program.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExportedProgram {
    /// Its folder.
    pub folder: String,
    /// Digest of its scenario.
    pub scenario: String,
    /// What it is about.
    pub chapter: String,
    /// How many cases it serves.
    pub cases: usize,
    /// Axes whose positions are requested.
    pub axes: Vec<Axis>,
    /// Variables whose values are requested.
    pub variables: Vec<u32>,
    /// Whether it may show messages.
    pub messages: bool,
    /// Whether only recorded samples are requested.
    pub samples: bool,
}
