//! What a program sets, and what a controller's state is after a block.

use alloc::borrow::ToOwned as _;
use alloc::string::String;
use core::fmt;

#[cfg(feature = "text")]
use crate::error::TextError;
use crate::field::{Entry, Scalar, Value};
use crate::indexed::Indexed;
#[cfg(feature = "serde")]
use crate::json::number::{read, write};
use crate::language::Language;
use crate::modes::{
    Compensation, ControllerMode, Distance, FeedMode, Lathe, LengthUnit, Motion, PathControlMode,
    Plane, ReturnMode, SpindleMode, SpindleTurn, Switch,
};
use crate::position::Position;
use crate::record::record;
#[cfg(feature = "text")]
use crate::text::value::FromText;
use crate::words::words;

/// D of G96: the highest speed of the spindle in revolutions per minute, or none.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum SpindleLimit {
    /// No limit was programmed.
    None,
    /// Revolutions per minute.
    Rpm(
        #[cfg_attr(feature = "serde", serde(serialize_with = "write", deserialize_with = "read"))]
        f64,
    ),
}

#[cfg(feature = "serde")]
crate::json::number::own_form! {
    SpindleLimit, |limit| if let Self::Rpm(limit) = limit { limit.is_finite() } else { true };
    MacroValue, |value| if let Self::Number(number) = value { number.is_finite() } else { true };
}

impl Scalar for SpindleLimit {
    fn value(&self) -> Value {
        match self {
            Self::None => Value::Word("none".to_owned()),
            Self::Rpm(limit) => Value::Number(*limit),
        }
    }
}

#[cfg(feature = "text")]
impl FromText for SpindleLimit {
    fn from_text(text: &str) -> Result<Self, TextError> {
        match text {
            "none" => Ok(Self::None),
            _ => f64::from_text(text).map(Self::Rpm),
        }
    }
}

impl fmt::Display for SpindleLimit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::None => f.write_str("none"),
            Self::Rpm(limit) => write!(f, "{limit}"),
        }
    }
}

record! {
    /// What a program sets and what then stays in force until it is set again.
    ///
    /// Compared as the settings in force at each effect and after each block: a setting repeated, or reordered
    /// between two effects, is not a difference.
    pub struct Settings {
        /// Length unit of program coordinates and feeds.
        units: LengthUnit,
        /// Selected plane.
        plane: Plane,
        /// Distance mode of axis words.
        distance: Distance,
        /// Distance mode of arc offsets.
        arc_distance: Distance,
        /// Feed mode.
        feed_mode: FeedMode,
        /// F in the active length unit per minute or per revolution, or in 1/min under inverse time; zero until set.
        feed_rate: f64,
        /// Return mode of canned cycles.
        retract: ReturnMode,
        /// Cutter compensation.
        compensation: Compensation,
        /// Whether a tool length offset applies.
        tool_length: Switch,
        /// The tool offset that applies, active length unit.
        tool_offset: Position,
        /// Work coordinate system, 1 to 9 for G54 to G59.3.
        work_offset: u32,
        /// Offset of the work coordinate system, active length unit.
        g5x_offset: Position,
        /// Offset of G52 and G92, active length unit.
        g92_offset: Position,
        /// Rotation of the work coordinate system about Z, degrees.
        rotation: f64,
        /// Path control mode.
        path: PathControlMode,
        /// P of G64, active length unit; zero when not given.
        blend_tolerance: f64,
        /// Q of G64, active length unit; zero when not given.
        naive_cam_tolerance: f64,
        /// Diameter or radius programming of a lathe.
        lathe: Lathe,
        /// S by spindle: revolutions per minute, or surface speed per minute under constant surface speed.
        spindle_speed: Indexed<u8, f64>,
        /// What S means, by spindle.
        spindle_mode: Indexed<u8, SpindleMode>,
        /// D of G96, by spindle.
        spindle_limit: Indexed<u8, SpindleLimit>,
        /// What each spindle was commanded to do.
        spindle: Indexed<u8, SpindleTurn>,
        /// Mist coolant.
        mist: Switch,
        /// Flood coolant.
        flood: Switch,
        /// Whether the feed override control is enabled.
        feed_override: Switch,
        /// Whether the speed override control of each spindle is enabled.
        speed_override: Indexed<u8, Switch>,
        /// Whether the adaptive feed input is used.
        adaptive_feed: Switch,
        /// Whether the feed stop input is enabled.
        feed_stop: Switch,
    }
}

record! {
    /// What else an RS-274 controller's state holds after a block.
    pub struct Rs274State {
        /// Motion mode.
        motion: Motion,
        /// The controlled point in program coordinates, active length unit and degrees.
        position: Position,
        /// Tool number in the spindle; 0 for none.
        tool: i32,
        /// Tool number that T selected for the next change; -1 for none.
        prepared_tool: i32,
        /// Mode of the controller.
        controller_mode: ControllerMode,
        /// Depth of calls; 0 in the main program. The first record after a call or return has it even when it is
        /// the same: local named parameters that no record since then has do not exist.
        call_level: u32,
        /// Parameters that changed: `31` for `#31`, `x` for `#<x>`, `_x` for `#<_x>`. In a record with a call level all
        /// local named parameters that exist.
        parameter: Indexed<String, f64>,
    }
}

words! {
    /// Whether a macro variable holds anything.
    pub enum Vacancy {
        /// It was never assigned, or was assigned a vacant value.
        Vacant = "vacant",
    }
}

/// A value of an NCT macro variable: a number, or vacant.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(untagged))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum MacroValue {
    /// It holds nothing.
    Vacant(Vacancy),
    /// It holds a number.
    Number(
        #[cfg_attr(feature = "serde", serde(serialize_with = "write", deserialize_with = "read"))]
        f64,
    ),
}

impl Scalar for MacroValue {
    fn value(&self) -> Value {
        match self {
            Self::Vacant(_) => Value::Word("vacant".to_owned()),
            Self::Number(number) => Value::Number(*number),
        }
    }
}

#[cfg(feature = "text")]
impl FromText for MacroValue {
    fn from_text(text: &str) -> Result<Self, TextError> {
        match text {
            "vacant" => Ok(Self::Vacant(Vacancy::Vacant)),
            _ => f64::from_text(text).map(Self::Number),
        }
    }
}

record! {
    /// State of an NCT custom macro after a block.
    pub struct NctState {
        /// Macro level: 0 in the main program, 1 and above in macros.
        macro_level: u32,
        /// Local variables by `level.number`, as in `1.33`. Before the first record, and where no macro of that level
        /// is in progress, they are vacant.
        local: Indexed<String, MacroValue>,
        /// Common variables by number; vacant before the first record.
        common: Indexed<u32, MacroValue>,
        /// Programs of the modal calls in force, the one that was commanded last at the end, by depth from 0; 0 where
        /// there is none (any more).
        modal_call: Indexed<u32, u32>,
        /// Motion mode.
        motion: Motion,
        /// The controlled point in program coordinates, active length unit and degrees.
        position: Position,
    }
}

record! {
    /// State of a GPP post-processor program after a statement.
    pub struct GppState {
        /// Text of each variable as it would be printed, by name (`AXIS(3)` for a member of an array).
        variable: Indexed<String, String>,
        /// Set status of each variable.
        set: Indexed<String, Switch>,
        /// Whether each variable is modal.
        modal: Indexed<String, bool>,
    }
}

/// State after a block, in the language of the program.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(tag = "language", rename_all = "snake_case")
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum State {
    /// LinuxCNC's dialect of RS-274.
    Rs274(Rs274State),
    /// NCT custom macros.
    Nct(NctState),
    /// GPP post-processor variables.
    Gpp(GppState),
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for State {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(serde::Deserialize)]
        #[serde(rename_all = "snake_case")]
        enum Wire {
            Rs274(Rs274State),
            Nct(NctState),
            Gpp(GppState),
        }
        Ok(match crate::json::tagged::read(deserializer, "language")? {
            Wire::Rs274(state) => Self::Rs274(state),
            Wire::Nct(state) => Self::Nct(state),
            Wire::Gpp(state) => Self::Gpp(state),
        })
    }
}

impl State {
    /// Nothing recorded yet.
    pub fn empty(language: Language) -> Self {
        match language {
            Language::Rs274 => Self::Rs274(Rs274State::default()),
            Language::Nct => Self::Nct(NctState::default()),
            Language::Gpp => Self::Gpp(GppState::default()),
        }
    }

    /// The language of the program.
    pub fn language(&self) -> Language {
        match self {
            Self::Rs274(_) => Language::Rs274,
            Self::Nct(_) => Language::Nct,
            Self::Gpp(_) => Language::Gpp,
        }
    }

    /// Everything that is recorded.
    pub fn entries(&self) -> alloc::vec::Vec<Entry> {
        match self {
            Self::Rs274(state) => state.entries(),
            Self::Nct(state) => state.entries(),
            Self::Gpp(state) => state.entries(),
        }
    }

    /// Whether nothing is recorded.
    pub fn is_empty(&self) -> bool {
        self.entries().is_empty()
    }

    /// Takes over a later record. A record of another language replaces it whole.
    pub fn overlay(&mut self, change: &Self) {
        match (self, change) {
            (Self::Rs274(state), Self::Rs274(change)) => state.overlay(change),
            (Self::Nct(state), Self::Nct(change)) => state.overlay(change),
            (Self::Gpp(state), Self::Gpp(change)) => state.overlay(change),
            (state, change) => state.clone_from(change),
        }
    }

    /// Removes the values of these fields; other names are ignored.
    pub fn forget(&mut self, fields: &[String]) {
        match self {
            Self::Rs274(state) => state.forget(fields),
            Self::Nct(state) => state.forget(fields),
            Self::Gpp(state) => state.forget(fields),
        }
    }

    /// Reads one value by the field's name, in the form that `Display` of [`Value`] writes.
    ///
    /// # Errors
    /// There is no such field in this language, or its value is unreadable.
    #[cfg(feature = "text")]
    pub fn read(&mut self, field: &str, index: Option<&str>, text: &str) -> Result<(), TextError> {
        match self {
            Self::Rs274(state) => state.read(field, index, text),
            Self::Nct(state) => state.read(field, index, text),
            Self::Gpp(state) => state.read(field, index, text),
        }
    }
}
