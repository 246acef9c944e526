//! Outcome: what can be observed of a run.

use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;

use crate::block::BlockLocation;
use crate::effect::Effect;
use crate::fault::Fault;
use crate::indexed::Indexed;
use crate::language::Language;
use crate::pin::PinChange;
use crate::position::Position;
#[cfg(feature = "serde")]
use crate::settings::{GppState, NctState, Rs274State};
use crate::settings::{Settings, State};
use crate::words::words;

/// What happened within a block, in order.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Event {
    /// Settings that changed here.
    Set(Box<Settings>),
    /// An effect, under the settings in force here.
    Do(Effect),
    /// Settings and fields of the state whose values are not known from here on, until they are reported again.
    Unknown(
        #[cfg_attr(feature = "serde", serde(deserialize_with = "read_field_names"))] Vec<String>,
    ),
}

#[cfg(feature = "serde")]
fn read_field_names<'de, D: serde::Deserializer<'de>>(
    deserializer: D,
) -> Result<Vec<String>, D::Error> {
    let names: Vec<String> = serde::Deserialize::deserialize(deserializer)?;
    let of_state = [Rs274State::FIELDS, NctState::FIELDS, GppState::FIELDS].concat();
    let is_known = |name: &str| Settings::FIELDS.contains(&name) || of_state.contains(&name);
    match names.iter().find(|name| !is_known(name)) {
        Some(name) => {
            Err(serde::de::Error::custom(alloc::format!("there is no field named `{name}`")))
        }
        None => Ok(names),
    }
}

/// One executed block: what it did and the state after it.
///
/// Settings and state hold what changed since the step before; absent means unchanged.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Step {
    /// The block.
    pub block: BlockLocation,
    /// Settings and effects in order.
    pub events: Vec<Event>,
    /// State after the block; absent for blocks after which none is recorded (O-words, M98, M99).
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub state: Option<State>,
}

words! {
    /// A bound of the budget.
    pub enum Bound {
        /// Executed blocks.
        Steps = "steps",
        /// Effects.
        Effects = "effects",
        /// Virtual time.
        Time = "time",
    }
}

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(tag = "end", rename_all = "snake_case", deny_unknown_fields)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum End {
    /// The program ended by M2 or M30.
    ProgramEnd,
    /// The second percent sign of a file.
    PercentEnd,
    /// All blocks were executed, and no block ended the program: what a controller reports that only reads a stream.
    StreamEnd,
    /// M99 in the main program would repeat it for ever.
    Endless,
    /// Waiting for the operator, and no operator event is left.
    Paused,
    /// The operator aborted the run.
    Aborted,
    /// A block was refused.
    Fault(Fault),
    /// A bound of the budget was reached: the outcome is a prefix of a longer one.
    BudgetExhausted {
        /// The bound that was reached.
        bound: Bound,
    },
    /// A feature that the interpreter does not support; everything before it counts.
    Unsupported {
        /// The block with the feature.
        block: BlockLocation,
        /// The feature.
        what: String,
    },
    /// The documents leave this open and no choice covers it; nothing is compared from here on.
    Unspecified {
        /// The block that is open.
        block: BlockLocation,
        /// What is open, and in which sentence.
        why: String,
    },
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for End {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(serde::Deserialize)]
        #[serde(rename_all = "snake_case", deny_unknown_fields)]
        enum Wire {
            ProgramEnd,
            PercentEnd,
            StreamEnd,
            Endless,
            Paused,
            Aborted,
            Fault(Fault),
            BudgetExhausted { bound: Bound },
            Unsupported { block: BlockLocation, what: String },
            Unspecified { block: BlockLocation, why: String },
        }
        Ok(match crate::json::tagged::read(deserializer, "end")? {
            Wire::ProgramEnd => Self::ProgramEnd,
            Wire::PercentEnd => Self::PercentEnd,
            Wire::StreamEnd => Self::StreamEnd,
            Wire::Endless => Self::Endless,
            Wire::Paused => Self::Paused,
            Wire::Aborted => Self::Aborted,
            Wire::Fault(fault) => Self::Fault(fault),
            Wire::BudgetExhausted { bound } => Self::BudgetExhausted { bound },
            Wire::Unsupported { block, what } => Self::Unsupported { block, what },
            Wire::Unspecified { block, why } => Self::Unspecified { block, why },
        })
    }
}

/// Why the end of a run leaves open what would follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Undetermined<'a> {
    /// The interpreter does not support it.
    Unsupported(&'a str),
    /// The documents leave it open, and no choice covers it.
    Unspecified(&'a str),
}

impl End {
    /// Why it is open what would follow; `None` if the run itself ended here.
    pub fn undetermined(&self) -> Option<Undetermined<'_>> {
        match self {
            Self::Unsupported { what, .. } => Some(Undetermined::Unsupported(what)),
            Self::Unspecified { why, .. } => Some(Undetermined::Unspecified(why)),
            Self::ProgramEnd
            | Self::PercentEnd
            | Self::StreamEnd
            | Self::Endless
            | Self::Paused
            | Self::Aborted
            | Self::Fault(_)
            | Self::BudgetExhausted { .. } => None,
        }
    }

    /// Turns of a main program that M99 repeats, after the last operator event; the last one ends as [`Self::Endless`].
    pub const TURNS: u32 = 10;

    /// The end's name as in JSON and text.
    pub fn name(&self) -> &'static str {
        match self {
            Self::ProgramEnd => "program_end",
            Self::PercentEnd => "percent_end",
            Self::StreamEnd => "stream_end",
            Self::Endless => "endless",
            Self::Paused => "paused",
            Self::Aborted => "aborted",
            Self::Fault(_) => "fault",
            Self::BudgetExhausted { .. } => "budget_exhausted",
            Self::Unsupported { .. } => "unsupported",
            Self::Unspecified { .. } => "unspecified",
        }
    }
}

/// A sample of the commanded motion, one per servo cycle.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Sample {
    /// Virtual time since the start, seconds.
    pub time: f64,
    /// Commanded machine position, millimetres and degrees.
    pub position: Position,
}

/// Everything that was observed of one run.
///
/// ```
/// use gaugeblock_vocabulary::{
///     BlockLocation, Effect, End, Event, Language, Outcome, Position, Settings, Step,
/// };
///
/// let end = Position { x: 1.0, ..Position::default() };
/// let outcome = Outcome {
///     language: Language::Rs274,
///     start: Settings::default(),
///     steps: vec![Step {
///         block: BlockLocation::new("main.ngc", 1),
///         events: vec![Event::Do(Effect::StraightTraverse { end })],
///         state: None,
///     }],
///     end: End::ProgramEnd,
///     parameters: None,
///     pins: Vec::new(),
///     samples: Vec::new(),
/// };
/// assert_eq!(outcome.end.name(), "program_end");
/// assert_eq!(outcome.steps[0].block.to_string(), "main.ngc:1");
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Outcome {
    /// The language of the program.
    pub language: Language,
    /// Settings in force before the first block.
    pub start: Settings,
    /// Executed blocks in order.
    pub steps: Vec<Step>,
    /// How it ended.
    pub end: End,
    /// All numbered parameters that are not zero at the end, if the controller reports them.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub parameters: Option<Indexed<u32, f64>>,
    /// Pins over virtual time.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub pins: Vec<PinChange>,
    /// Commanded motion.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub samples: Vec<Sample>,
}
