//! The programmed path.

use alloc::string::String;
use alloc::vec::Vec;

use crate::block::BlockLocation;
#[cfg(feature = "serde")]
use crate::json::number::read_finite;
use crate::pin::Pin;
use crate::position::Position;

/// The feed of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Feed {
    /// As fast as the axes can: G0.
    Rapid,
    /// G94: millimetres per second where X, Y, Z, or else U, V, W move, degrees per second where only A, B, C do.
    PerSecond(f64),
    /// G93: the whole element in so many seconds.
    InTime(f64),
    /// G95, G33, G33.1: a length, millimetres or degrees, per turn of a spindle.
    PerTurn {
        /// Spindle number.
        spindle: u8,
        /// Millimetres, or degrees where only A, B, C move.
        length: f64,
    },
}

/// How exactly an element is followed (G61, G61.1, G64).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum PathMode {
    /// G61.1: the path itself, and rest at the end of the element.
    ExactStop,
    /// G61: the path itself.
    ExactPath,
    /// G64 P Q: corners may be rounded by a tolerance, and nearly straight rows of lines merged by another.
    Within {
        /// P, millimetres; above zero.
        tolerance: f64,
        /// Q, millimetres; zero where nothing is merged.
        merge: f64,
    },
    /// G64 without P: corners may be rounded from the middle of one element to the middle of the next.
    BetweenMidpoints,
}

/// Which controls act on an element (M48 to M53).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields, default)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Controls {
    /// M50: feed and rapid override.
    pub feed_override: bool,
    /// M52: the adaptive feed input.
    pub adaptive_feed: bool,
    /// M53: the feed stop input.
    pub feed_stop: bool,
}

impl Default for Controls {
    /// As a controller starts: override and feed stop on, adaptive feed off.
    fn default() -> Self {
        Self { feed_override: true, adaptive_feed: false, feed_stop: true }
    }
}

/// An output and its new value, 0 or 1 for a digital one.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct OutputChange {
    /// The output.
    pub pin: Pin,
    /// Its value from here on.
    pub value: f64,
}

/// The geometry of an element, or what happens at rest.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case", deny_unknown_fields)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Shape {
    /// A straight line; all nine axes move evenly.
    Straight {
        /// Where it ends.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "read_finite"))]
        end: Position,
    },
    /// An arc or helix. The point goes about an axis of X, Y, Z while its distance from the axis, its place along
    /// the axis and the six other coordinates change evenly with the angle.
    Arc {
        /// Where it ends.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "read_finite"))]
        end: Position,
        /// A point of the axis: X, Y, Z.
        centre: [f64; 3],
        /// Direction of the axis: a unit vector of X, Y, Z.
        normal: [f64; 3],
        /// How far it goes about the axis: degrees, counterclockwise seen from where the normal points, else negative.
        angle: f64,
    },
    /// A straight line until a probe changes, from rest to rest.
    Probe {
        /// The farthest point.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "read_finite"))]
        end: Position,
        /// Where the probe changes, if it does.
        #[cfg_attr(feature = "serde", serde(default, deserialize_with = "read_finite"))]
        contact: Option<Position>,
    },
    /// A curve of which only the end is known: a spline.
    Curve {
        /// Where it ends.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "read_finite"))]
        end: Position,
    },
    /// Rest for a time: G4.
    Dwell {
        /// Seconds.
        seconds: f64,
    },
    /// Rest until something else is done, which takes a time of its own: an input, a tool, a spindle, the operator.
    Wait {
        /// What is waited for, in a word.
        for_what: String,
    },
    /// An output that switches at once, at rest: M64, M65, M68.
    AtOnce(OutputChange),
}

/// One element of a path.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PathElement {
    /// The block that commands it.
    pub block: BlockLocation,
    /// Its geometry.
    pub shape: Shape,
    /// How fast.
    pub feed: Feed,
    /// How exactly it is followed.
    pub mode: PathMode,
    /// Which controls act on it.
    #[cfg_attr(feature = "serde", serde(default))]
    pub controls: Controls,
    /// Outputs that switch where it starts (M62, M63, M67), one setting for each.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub switches: Vec<OutputChange>,
}

impl PathElement {
    /// End point; `None` for an element without motion.
    pub fn end(&self) -> Option<Position> {
        match &self.shape {
            Shape::Straight { end } | Shape::Arc { end, .. } | Shape::Curve { end } => Some(*end),
            Shape::Probe { end, contact } => Some(contact.unwrap_or(*end)),
            Shape::Dwell { .. } | Shape::Wait { .. } | Shape::AtOnce(_) => None,
        }
    }
}

/// What a program commands of the axes, in order, from rest to rest.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields, default)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ProgrammedPath {
    /// Where the machine is before it.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "read_finite"))]
    pub start: Position,
    /// The elements, in order.
    pub elements: Vec<PathElement>,
    /// Outputs that wait for a motion which never follows: they never switch.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    pub never: Vec<OutputChange>,
}
