//! What a campaign asks of one program.

use gaugeblock_vocabulary::Axis;
use serde::{Deserialize, Serialize};

/// A program that is asked for.
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
    /// Axes whose positions are asked for.
    pub axes: Vec<Axis>,
    /// Variables that are asked for.
    pub variables: Vec<u32>,
    /// Whether it may show messages.
    pub messages: bool,
    /// Whether recorded samples are asked for, and nothing else.
    pub samples: bool,
}
