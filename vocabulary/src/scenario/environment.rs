//! The environment: how everything outside of the controller answers it.

use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;

use crate::position::Position;

/// How everything outside of a controller answers it: wires, inputs, encoders, probe, tool changer, user programs.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields, default)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Environment {
    /// A named environment. `stand-alone rs274` answers as that program's stubs do, whatever the other fields say;
    /// `whole controller` answers as the other fields say, and replaces the environment that an edition names.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub name: Option<String>,
    /// Digital outputs that are wired to digital inputs: output number to input number.
    pub wires: BTreeMap<String, u16>,
    /// Inputs over virtual time, in order; an input that is not listed and not wired is zero, and adaptive feed
    /// is 1: full speed.
    pub inputs: Vec<InputChange>,
    /// What an encoder answers to an orientation, by spindle from 0; a spindle not listed answers at once.
    pub orient: Vec<OrientAnswer>,
    /// Where the probe touches.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub probe: Option<ProbeContact>,
    /// Seconds that a tool change takes.
    pub tool_change_time: f64,
    /// Whether a person changes the tools, after a prompt.
    pub manual_tool_change: bool,
    /// Files that may be programs of user-defined M codes, as data: nothing runs.
    pub user_programs: Vec<UserProgram>,
}

/// An input that changes.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct InputChange {
    /// Virtual time, seconds.
    pub time: f64,
    /// Name: `digital_in[0]`, `analog_in[0]`, `adaptive_feed`, `feed_hold`.
    pub input: String,
    /// New value; 0 and 1 for digital inputs.
    pub value: f64,
}

/// What an encoder answers to an orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum OrientAnswer {
    /// The spindle is at its angle after this time, seconds.
    After(f64),
    /// The spindle never reaches its angle.
    Never,
    /// The encoder reports a fault of this number.
    Fault(i32),
}

/// Where the probe touches.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum ProbeContact {
    /// At the end of every probing move.
    AtTarget,
    /// When the controlled point reaches this machine position, machine unit.
    At(
        #[cfg_attr(
            feature = "serde",
            serde(deserialize_with = "crate::json::number::read_finite")
        )]
        Position,
    ),
    /// Never.
    Never,
}

/// Where a file is that may be the program of a user-defined M code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Folder {
    /// The folder of programs, `PROGRAM_PREFIX`.
    #[default]
    ProgramPrefix,
    /// A folder of the search path, `USER_M_PATH`.
    SearchPath,
    /// Neither of the two.
    Elsewhere,
}

/// A file that may be the program of a user-defined M code, as data.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields, default)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct UserProgram {
    /// File name, such as `M101`.
    pub file: String,
    /// The folder that holds the file.
    pub folder: Folder,
    /// Whether the file is executable.
    pub executable: bool,
    /// Duration of a run, seconds.
    pub duration: f64,
    /// Exit status of the program.
    pub exit_status: i32,
    /// Whether the file existed when the controller started.
    pub at_start: bool,
}

impl Default for UserProgram {
    fn default() -> Self {
        Self {
            file: String::new(),
            folder: Folder::ProgramPrefix,
            executable: true,
            duration: 0.0,
            exit_status: 0,
            at_start: true,
        }
    }
}
