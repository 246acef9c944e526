//! What is known of the environment, as data.

use std::collections::BTreeMap;

use gaugeblock_vocabulary::scenario::{Environment, OrientAnswer};
use gaugeblock_vocabulary::{LengthUnit, Pin, PinChange, Position, Shared, Sorted};

/// The state of everything outside of the controller, and what the controller has put out there.
#[derive(Clone, Debug)]
pub struct EnvironmentState {
    /// How inputs, encoders, the tool changer and user-defined programs answer.
    pub(super) scenario: Shared<Environment>,
    /// Seconds since the start.
    pub(super) time: f64,
    /// The value of each pin that is not zero, or was not.
    pub(super) levels: Shared<Sorted<Pin, f64>>,
    /// Every change of a pin so far.
    pub(super) changes: Shared<Vec<PinChange>>,
    /// What outputs become when the next motion begins.
    pub(super) awaiting_motion: BTreeMap<Pin, f64>,
    /// Orientations that have begun and not ended, by spindle.
    pub(super) orienting: BTreeMap<usize, Orientation>,
    /// Whether the operator sends a request now: what else happens at this moment happens afterwards.
    pub(super) is_asked: bool,
    /// The last orientation of each spindle, ended or not.
    pub(super) last_orientations: BTreeMap<usize, Orientation>,
    /// Where the last probing move ended, and whether the probe touched there.
    pub(super) probed: Option<Probed>,
    /// What a program sees of HAL.
    pub(super) synchronised: Synchronised,
    /// The stub in place of a machine.
    pub(super) stub: Stub,
}

/// What was to be seen outside when the program was synchronised with the machine last.
#[derive(Clone, Debug, Default)]
pub(super) struct Synchronised {
    /// When, seconds since the start.
    pub(super) time: f64,
    /// The value of each pin that was not zero.
    pub(super) levels: Shared<Sorted<Pin, f64>>,
}

/// An orientation that has begun and not ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Orientation {
    /// When it began, seconds since the start.
    pub(crate) begun: f64,
    /// What the encoder answers.
    pub(crate) answer: OrientAnswer,
}

impl Orientation {
    /// When the spindle is at its angle, if it ever is.
    pub(crate) fn done(self) -> Option<f64> {
        match self.answer {
            OrientAnswer::After(seconds) => Some(self.begun + seconds.max(0.0)),
            OrientAnswer::Never | OrientAnswer::Fault(_) => None,
        }
    }
}

/// What the probe was at the end of the last probing move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Probed {
    pub(super) at: Position,
    pub(super) touching: bool,
}

/// The stub of a machine.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stub {
    /// The point of the last command.
    pub(super) stands: Stands,
    /// Whether a spline of three points has led it where X and Y have no numbers.
    pub(super) lost: bool,
    /// Whether another spline has led it to X0 Y0: to numbers that are as small as what memory happens to hold.
    pub(super) led: bool,
    /// Whether the block that is executed queries the point.
    pub(super) asked: bool,
    /// The tool that is known again at the end of a block with M61.
    pub(super) tool_after_block: Option<i32>,
}

/// A point as the stub received it: where neither unit nor offset has changed, it is the same to the last bit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stands {
    /// Program coordinates, as far as the stub knows of offsets.
    pub(super) point: Position,
    /// The offsets that it knew of.
    pub(super) offset: Position,
    /// The length unit of both.
    pub(super) units: LengthUnit,
}

impl Default for Stub {
    fn default() -> Self {
        let zero = Position::default();
        let stands = Stands { point: zero, offset: zero, units: LengthUnit::Millimetre };
        Self { stands, lost: false, led: false, asked: false, tool_after_block: None }
    }
}
