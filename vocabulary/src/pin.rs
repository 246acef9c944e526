//! Pins: the electrical signals between a controller and its machine, and when they change.

use alloc::format;
use alloc::string::{String, ToString as _};
use core::fmt;
use core::str::FromStr;

use crate::error::TextError;
#[cfg(feature = "serde")]
use crate::json::number::{read, write};

macro_rules! pins {
    (
        each { $($(#[$about:meta])* $name:literal $variant:ident,)* }
        single { $($(#[$about_single:meta])* $single_name:literal $single:ident,)* }
    ) => {
        /// A pin, by the index of its output or spindle where there are several, from 0.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        #[cfg_attr(
            feature = "serde",
            derive(serde::Serialize, serde::Deserialize),
            serde(try_from = "String", into = "String")
        )]
        pub enum Pin {
            $($(#[$about])* $variant(u16),)*
            $($(#[$about_single])* $single,)*
        }

        impl Pin {
            /// Names of the pins that exist once per output or spindle.
            pub const INDEXED_NAMES: &'static [&'static str] = &[$($name),*];

            /// Names of the pins that exist once.
            pub const SINGLE_NAMES: &'static [&'static str] = &[$($single_name),*];

            /// The name without index, such as `digital_out`.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant(_) => $name,)*
                    $(Self::$single => $single_name,)*
                }
            }

            /// Number of the output or spindle, from 0.
            pub fn index(self) -> Option<u16> {
                match self {
                    $(Self::$variant(index) => Some(index),)*
                    $(Self::$single => None,)*
                }
            }

            fn of(name: &str, index: Option<u16>) -> Option<Self> {
                match (name, index) {
                    $(($name, Some(index)) => Some(Self::$variant(index)),)*
                    $(($single_name, None) => Some(Self::$single),)*
                    _ => None,
                }
            }
        }
    };
}

pins! {
    each {
        /// A digital output.
        "digital_out" DigitalOut,
        /// An analog output.
        "analog_out" AnalogOut,
        /// Whether a spindle is commanded to turn.
        "spindle_on" SpindleOn,
        /// Whether a spindle is commanded to turn clockwise.
        "spindle_forward" SpindleForward,
        /// Whether a spindle is commanded to turn counterclockwise.
        "spindle_reverse" SpindleReverse,
        /// The commanded speed of a spindle, revolutions per minute, negative counterclockwise.
        "spindle_speed" SpindleSpeed,
        /// Whether the brake of a spindle is applied.
        "spindle_brake" SpindleBrake,
        /// Whether a spindle is at its angle and locked.
        "spindle_locked" SpindleLocked,
        /// Whether a spindle is commanded to turn to an angle.
        "spindle_orient" SpindleOrient,
        /// The commanded angle of a spindle, degrees.
        "spindle_orient_angle" SpindleOrientAngle,
        /// Direction in which a spindle turns to its angle: 0 the shortest, 1 clockwise, 2 counterclockwise.
        "spindle_orient_mode" SpindleOrientMode,
    }
    single {
        /// Mist coolant.
        "coolant_mist" CoolantMist,
        /// Flood coolant.
        "coolant_flood" CoolantFlood,
    }
}

impl Pin {
    /// The names of all pins without index.
    pub fn names() -> impl Iterator<Item = &'static str> {
        Self::INDEXED_NAMES.iter().chain(Self::SINGLE_NAMES).copied()
    }
}

impl fmt::Display for Pin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())?;
        self.index().map_or(Ok(()), |index| write!(f, "[{index}]"))
    }
}

impl FromStr for Pin {
    type Err = TextError;

    fn from_str(text: &str) -> Result<Self, TextError> {
        let pin = match text.strip_suffix(']').and_then(|text| text.split_once('[')) {
            Some((name, digits)) => {
                let index = digits.parse().ok().filter(|index: &u16| index.to_string() == digits);
                index.and_then(|index| Self::of(name, Some(index)))
            }
            None => Self::of(text, None),
        };
        pin.ok_or_else(|| {
            let indexed = Self::INDEXED_NAMES.join("[n], ");
            let single = Self::SINGLE_NAMES.join(", ");
            TextError::new(format!("{text} is none of {indexed}[n], {single}"))
        })
    }
}

impl TryFrom<String> for Pin {
    type Error = TextError;

    fn try_from(text: String) -> Result<Self, TextError> {
        text.parse()
    }
}

impl From<Pin> for String {
    fn from(pin: Pin) -> Self {
        pin.to_string()
    }
}

/// A pin of the machine that changed. The value that it has before the run is not recorded.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PinChange {
    /// Virtual time since the start, seconds.
    #[cfg_attr(feature = "serde", serde(serialize_with = "write", deserialize_with = "read"))]
    pub time: f64,
    /// Which pin.
    pub pin: Pin,
    /// New value; 0 and 1 for digital pins.
    #[cfg_attr(feature = "serde", serde(serialize_with = "write", deserialize_with = "read"))]
    pub value: f64,
}
