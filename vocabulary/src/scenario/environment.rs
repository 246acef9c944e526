//! The environment: how the outside answers.

use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;

use crate::position::Position;

/// How the outside of a controller answers.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields, default)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Environment {
    /// A named environment. `stand-alone rs274` answers as that program's stubs do, whatever is said below; `whole
    /// controller` answers as said below, and stands where an edition would else name its own.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub name: Option<String>,
    /// Digital outputs wired to digital inputs, output number to input number; what comes in there is what goes out.
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
    /// Whether a person changes the tools, asked by a prompt.
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
    /// It stands at its angle after so many seconds.
    After(f64),
    /// It never does.
    Never,
    /// It reports a fault of this number.
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
    At(Position),
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
    /// Neither.
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
    /// Where it is.
    pub folder: Folder,
    /// Whether it is executable.
    pub executable: bool,
    /// Seconds that it takes.
    pub duration: f64,
    /// Its exit status.
    pub exit_status: i32,
    /// Whether it was there when the controller started.
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
