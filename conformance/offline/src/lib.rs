//! The offline route: programs for a control that cannot host a process, and the answers that a person brings back.
//!
//! A campaign is a folder: a manifest, a page for the operator, and for each program a folder with its files, its setup
//! and an answer sheet. **Invariant:** nothing that is exported says what is expected, and the names of rules and cases
//! are left out because they often do. The sheet records what was seen, not what should have been.
//!
//! A case finds its sheet by the digest of its scenario, and cases with the same scenario share one.

mod adapter;
mod answer;
mod blocks;
mod exportable;
mod exported_program;
mod form;
mod instructions;
mod questions;
mod requested;
mod sheet;

use std::collections::BTreeMap;
use std::path::Path;

use gaugeblock_vocabulary::motion::MotionLimits;
use gaugeblock_vocabulary::{Options, Scenario};
use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

pub use adapter::Offline;
pub use answer::answer;
pub use blocks::{Blocks, read_blocks};
pub use exported_program::ExportedProgram;
pub use instructions::{operator, readme};
pub use questions::{Question, check_language, questions};
pub use requested::Requested;
use sheet::Values;
pub use sheet::{Answer, Sheet, control_text};

/// The manifest of a campaign.
pub const MANIFEST: &str = "manifest.json";
/// What is said of the control, once for all.
pub const CONTROL: &str = "control.toml";
/// The answer sheet of a program.
pub const SHEET: &str = "answer.toml";
/// Positions of the tool after each block, if the program was run block by block.
pub const BLOCKS: &str = "blocks.csv";
/// Recorded samples, if they are requested.
pub const SAMPLES: &str = "samples.csv";
/// Setup and steps of the operator for a program.
pub const OPERATOR: &str = "operator.md";
/// The version of a campaign's form.
pub const FORMAT: u32 = 1;

/// The programs of a campaign, and where they come from.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// Version of the form: 1.
    pub format: u32,
    /// Version of gaugeblock that wrote it.
    pub gaugeblock_version: String,
    /// Digest of the suite.
    pub suite: String,
    /// The edition that the answers are compared with.
    pub edition: String,
    /// The requested profiles; empty for all.
    pub profiles: Vec<String>,
    /// Prefixes of the ids of the requested rules; empty for all.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub only: Vec<String>,
    /// The programs, in the order of their folders.
    pub programs: Vec<ExportedProgram>,
    /// What the route cannot carry: how many cases, by the reason.
    pub left_out: BTreeMap<String, usize>,
}

impl Manifest {
    /// The requested rules.
    pub fn requested(&self) -> Requested {
        Requested { profiles: self.profiles.clone(), only: self.only.clone() }
    }

    /// Reads the manifest of a folder.
    ///
    /// # Errors
    /// There is none, or none of this form, with its place.
    pub fn read(folder: &Path) -> Result<Self, String> {
        let path = folder.join(MANIFEST);
        let name = path.display();
        let text = read_file(&path).map_err(|error| format!("{name}: {error}"))?;
        let manifest: Self =
            serde_json::from_str(&text).map_err(|error| format!("{name}: {error}"))?;
        if manifest.format != FORMAT {
            return Err(format!("{name}: it is of form {}, not {FORMAT}", manifest.format));
        }
        let plain = |name: &str| {
            !name.is_empty() && name.chars().all(|character| character.is_ascii_digit())
        };
        match manifest.programs.iter().find(|exported| !plain(&exported.folder)) {
            None => Ok(manifest),
            Some(exported) => {
                Err(format!("{name}: {:?} is not a valid folder of a program", exported.folder))
            }
        }
    }
}

/// Most bytes of a file of a campaign.
const FILE_BYTES_MAX: u64 = 64 << 20;

/// The text of a file of a campaign, which others have filled in: a regular file of bounded size.
///
/// # Errors
/// It is not there, is not such a file, or is not UTF-8.
pub fn read_file(path: &Path) -> std::io::Result<String> {
    let bytes = gaugeblock_filesystem::read_regular(path, FILE_BYTES_MAX)?;
    String::from_utf8(bytes)
        .map_err(|error| std::io::Error::new(std::io::ErrorKind::InvalidData, error.utf8_error()))
}

/// The text of a file that a campaign need not have; empty if it is not there.
///
/// # Errors
/// As [`read_file`], except that it may be absent.
pub fn read_file_if_there(path: &Path) -> std::io::Result<String> {
    match read_file(path) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(String::new()),
        read => read,
    }
}

/// The files of a program's folder that a person fills in, by name, with nothing filled in.
pub fn blank_files(exported: &ExportedProgram) -> Vec<(&'static str, String)> {
    let sheet = (SHEET, sheet::text(exported, &Values::default()));
    if exported.samples {
        return vec![sheet];
    }
    vec![sheet, (BLOCKS, blocks::blocks_text(&exported.axes, &Vec::new()))]
}

/// What a scenario is found by: all of it but how the documents are read, which a control does not depend on.
pub fn digest(scenario: &Scenario) -> String {
    digest_of_json(&without_defaults(scenario))
}

/// The key of a scenario whose samples are requested on a machine with these limits.
pub fn digest_of_motion(scenario: &Scenario, limits: &MotionLimits) -> String {
    digest_of_json(&(without_defaults(scenario), limits))
}

fn without_defaults(scenario: &Scenario) -> Scenario {
    let mut plain = Scenario { options: Options::default(), ..scenario.clone() };
    plain.environment.name.take_if(|name| name == exportable::USUAL);
    plain
}

fn digest_of_json(value: &impl Serialize) -> String {
    // A scenario holds nothing that JSON cannot.
    let text = serde_json::to_string(value).unwrap_or_default();
    Sha256::digest(text.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect()
}
