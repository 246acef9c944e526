//! G and M codes: modal groups, the modes in force.
//!
//! No document at hand says this part; it is what macros need to be seen, and the README beside the rules marks it so.

use gaugeblock_vocabulary::{
    Axis, Distance, FaultKind, FeedMode, Indexed, LengthUnit, Motion, Plane, Position, Settings,
    SpindleTurn, Switch,
};

use super::refusal::{StepError, refuse, refuse_form};
use crate::ids::rule;

/// What is in force.
#[derive(Clone, Debug)]
pub struct Modes {
    /// G0 to G3, or none.
    pub motion: Motion,
    /// Where the controlled point is, program coordinates, active length unit and degrees.
    pub position: Position,
    /// G20, G21.
    pub units: LengthUnit,
    /// G17 to G19.
    pub plane: Plane,
    /// G90, G91.
    pub distance: Distance,
    /// G94, G95.
    pub feed_mode: FeedMode,
    /// F; zero where none is set, or where what it meant has changed.
    pub feed_rate: f64,
    /// 1 to 6 for G54 to G59.
    pub work_offset: u32,
    /// S, revolutions per minute.
    pub spindle_speed: f64,
    /// M3 to M5.
    pub spindle: SpindleTurn,
    /// M7.
    pub mist: Switch,
    /// M8.
    pub flood: Switch,
    /// T since the last change, or the tool that was changed last.
    pub tool: i32,
}

/// The codes of a block.
#[derive(Clone, Debug, Default)]
pub struct Codes {
    /// G codes in tenths: 661 for G66.1.
    pub g: Vec<i64>,
    /// M codes.
    pub m: Vec<i64>,
}

/// The codes of a block by what they do.
#[derive(Clone, Copy, Debug, Default)]
pub struct Block {
    /// G0 to G3.
    pub motion: Option<Motion>,
    /// G4.
    pub dwell: bool,
    /// M6.
    pub tool_change: bool,
    /// M2, M30.
    pub end: bool,
    /// M98.
    pub sub: bool,
    /// M99.
    pub back: bool,
}

/// The axes whose words are lengths.
const LINEAR: [Axis; 6] = [Axis::X, Axis::Y, Axis::Z, Axis::U, Axis::V, Axis::W];
/// Millimetres in an inch.
const INCH: f64 = 25.4;

impl Modes {
    /// A fresh controller.
    pub fn new() -> Self {
        Self {
            motion: Motion::None,
            position: Position::default(),
            units: LengthUnit::Millimetre,
            plane: Plane::Xy,
            distance: Distance::Absolute,
            feed_mode: FeedMode::PerMinute,
            feed_rate: 0.0,
            work_offset: 1,
            spindle_speed: 0.0,
            spindle: SpindleTurn::Stopped,
            mist: Switch::Off,
            flood: Switch::Off,
            tool: 0,
        }
    }

    /// The settings in force.
    pub fn settings(&self) -> Settings {
        Settings {
            units: Some(self.units),
            plane: Some(self.plane),
            distance: Some(self.distance),
            feed_mode: Some(self.feed_mode),
            feed_rate: Some(self.feed_rate),
            work_offset: Some(self.work_offset),
            spindle_speed: Some(Indexed::one(0, self.spindle_speed)),
            spindle: Some(Indexed::one(0, self.spindle)),
            mist: Some(self.mist),
            flood: Some(self.flood),
            ..Settings::default()
        }
    }

    /// Takes over the codes of a block that set modes, and says what the others are.
    ///
    /// Rule nct.modes. One code of a group may stand in a block.
    ///
    /// # Errors
    /// Two codes of a group, one that this edition does not hold, or a position that the other unit has no number for.
    pub fn set(&mut self, codes: &Codes) -> Result<Block, StepError> {
        let mut block = Block::default();
        let mut groups = std::collections::BTreeSet::new();
        for (code, letter) in
            codes.g.iter().map(|g| (*g, 'G')).chain(codes.m.iter().map(|m| (*m, 'M')))
        {
            let group = if letter == 'G' {
                self.set_g(code, &mut block)?
            } else {
                self.set_m(code, &mut block)
            };
            let group = group.ok_or_else(|| {
                let number = if letter == 'G' { tenths(code) } else { code.to_string() };
                StepError::Unsupported(format!("{letter}{number}"))
            })?;
            if !groups.insert((letter, group)) {
                let message = format!("two {letter} codes of one group");
                return Err(refuse(rule::nct::MODES, FaultKind::ModalConflict, message));
            }
        }
        if block.end && (block.sub || block.back) {
            let message = "an end with a call or a return";
            return Err(refuse_form(FaultKind::ModalConflict, message));
        }
        Ok(block)
    }

    /// The group of a G code in tenths, which takes effect.
    fn set_g(&mut self, code: i64, block: &mut Block) -> Result<Option<u32>, StepError> {
        match code {
            0 => block.motion = Some(Motion::Traverse),
            10 => block.motion = Some(Motion::Feed),
            20 => block.motion = Some(Motion::ArcClockwise),
            30 => block.motion = Some(Motion::ArcCounterclockwise),
            40 => block.dwell = true,
            170 => self.plane = Plane::Xy,
            180 => self.plane = Plane::Zx,
            190 => self.plane = Plane::Yz,
            200 => self.set_units(LengthUnit::Inch)?,
            210 => self.set_units(LengthUnit::Millimetre)?,
            900 => self.distance = Distance::Absolute,
            910 => self.distance = Distance::Incremental,
            940 => self.set_feed_mode(FeedMode::PerMinute),
            950 => self.set_feed_mode(FeedMode::PerRevolution),
            540 | 550 | 560 | 570 | 580 | 590 => {
                self.work_offset = u32::try_from(code / 10 - 53).unwrap_or_default();
            }
            _ => return Ok(None),
        }
        Ok(Some(match code {
            0..=30 => 1,
            40 => 0,
            170..=190 => 2,
            200..=210 => 6,
            900..=910 => 3,
            940..=950 => 5,
            _ => 12,
        }))
    }

    /// The group of an M code, which takes effect.
    fn set_m(&mut self, code: i64, block: &mut Block) -> Option<u32> {
        match code {
            2 | 30 => block.end = true,
            3 => self.spindle = SpindleTurn::Clockwise,
            4 => self.spindle = SpindleTurn::Counterclockwise,
            5 => self.spindle = SpindleTurn::Stopped,
            6 => block.tool_change = true,
            7 => self.mist = Switch::On,
            8 => self.flood = Switch::On,
            9 => (self.mist, self.flood) = (Switch::Off, Switch::Off),
            98 => block.sub = true,
            99 => block.back = true,
            _ => return None,
        }
        Some(match code {
            3..=5 => 7,
            6 => 6,
            7..=9 => 8,
            _ => 4,
        })
    }

    /// A feed in another unit would be another feed: it has to be programmed again.
    fn set_units(&mut self, units: LengthUnit) -> Result<(), StepError> {
        if self.units == units {
            return Ok(());
        }
        self.units = units;
        self.feed_rate = 0.0;
        for axis in LINEAR {
            let coordinate = self.position.get_mut(axis);
            *coordinate = match units {
                LengthUnit::Inch => *coordinate / INCH,
                LengthUnit::Millimetre => *coordinate * INCH,
            };
        }
        within_reach(&self.position)
    }

    fn set_feed_mode(&mut self, feed_mode: FeedMode) {
        if self.feed_mode != feed_mode {
            self.feed_mode = feed_mode;
            self.feed_rate = 0.0;
        }
    }
}

impl Default for Modes {
    fn default() -> Self {
        Self::new()
    }
}

/// A position is made of numbers, in whichever unit.
///
/// # Errors
/// A coordinate is not finite.
pub(super) fn within_reach(position: &Position) -> Result<(), StepError> {
    if position.to_array().iter().all(|coordinate| coordinate.is_finite()) {
        return Ok(());
    }
    Err(refuse_form(FaultKind::OutOfDomain, "a position that is too far away"))
}

fn tenths(code: i64) -> String {
    if code % 10 == 0 { (code / 10).to_string() } else { format!("{}.{}", code / 10, code % 10) }
}
