//! The machine that runs a program.

use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

use crate::indexed::Indexed;
use crate::modes::LengthUnit;
use crate::position::{Axis, Position};

/// A machine: its axes, spindles, inputs and outputs, its settings and what it has stored.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields, default)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Machine {
    /// Length unit of stored data: parameters, tool table, limits.
    pub length_unit: LengthUnit,
    /// Axes that the machine has.
    pub axes: Vec<Axis>,
    /// Limits by axis name, machine unit; an axis not listed has none.
    pub limits: BTreeMap<String, AxisLimits>,
    /// Number of spindles, 1 to 8.
    pub spindles: u8,
    /// Number of digital inputs and outputs each.
    pub digital_io: u16,
    /// Number of analog inputs and outputs each.
    pub analog_io: u16,
    /// Degrees added to R of M19.
    pub orient_offset: f64,
    /// What a tool change may do besides.
    pub tool_change: ToolChange,
    /// Whether tools change places in the changer.
    pub random_tool_changer: bool,
    /// Whether M98 and M99 are enabled.
    pub fanuc_subs: bool,
    /// Tool table.
    pub tools: Vec<Tool>,
    /// Stored parameters by number, machine unit.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::json::number::read_finite"))]
    pub parameters: Indexed<u32, f64>,
    /// Entries of the INI file that a program can read, by `[section]name` in upper case.
    pub ini: BTreeMap<String, f64>,
}

impl Default for Machine {
    fn default() -> Self {
        Self {
            length_unit: LengthUnit::Millimetre,
            axes: vec![Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::B, Axis::C],
            limits: BTreeMap::new(),
            spindles: 1,
            digital_io: 4,
            analog_io: 4,
            orient_offset: 0.0,
            tool_change: ToolChange::default(),
            random_tool_changer: false,
            fanuc_subs: true,
            tools: Vec::new(),
            parameters: Indexed::default(),
            ini: BTreeMap::new(),
        }
    }
}

/// Limits of an axis in machine units (millimetres or inches, degrees).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields, default)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AxisLimits {
    /// Lowest position.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub minimum: Option<f64>,
    /// Highest position.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub maximum: Option<f64>,
    /// Highest velocity, per second.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub velocity: Option<f64>,
    /// Highest acceleration, per second squared.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub acceleration: Option<f64>,
    /// Highest jerk, per second cubed.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub jerk: Option<f64>,
}

/// What a tool change may do besides.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields, default)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ToolChange {
    /// Move to the G30 position first.
    pub at_g30: bool,
    /// Retract Z first.
    pub quill_up: bool,
    /// Leave the spindle turning.
    pub with_spindle_on: bool,
}

/// A tool of the tool table, machine unit.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields, default)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Tool {
    /// Tool number.
    pub number: u32,
    /// Pocket; the tool number when not given.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub pocket: Option<u32>,
    /// Offsets.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::json::number::read_finite"))]
    pub offset: Position,
    /// Diameter.
    pub diameter: f64,
    /// Front angle, degrees.
    pub front_angle: f64,
    /// Back angle, degrees.
    pub back_angle: f64,
    /// Orientation of a lathe tool, 0 to 9.
    pub orientation: u8,
}
