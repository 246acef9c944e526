//! Applies the codes of a block: modes that they change, and actions that they require.

use gaugeblock_vocabulary::{
    Distance, FaultKind, FeedMode, LengthUnit, Motion, Plane, SpindleTurn, Switch,
};

use super::program::{Stop, refuse};
use super::run::Runner;
use crate::modal::Conversion;

impl Runner {
    /// Modes of the codes, G before M.
    pub(super) fn codes(&mut self) -> Result<Codes, Stop> {
        let mut codes = Codes::default();
        let (g, m) = (core::mem::take(&mut self.g), core::mem::take(&mut self.m));
        let mut done = Ok(());
        for code in &g {
            done = done.and_then(|()| self.g_code(*code, &mut codes));
        }
        for code in &m {
            done = done.and_then(|()| self.m_code(*code, &mut codes));
        }
        (self.g, self.m) = (g, m);
        done.map(|()| codes)
    }

    fn g_code(&mut self, code: u16, codes: &mut Codes) -> Result<(), Stop> {
        let group = match code {
            0 | 10 | 20 | 30 => Group::Motion,
            40 => Group::Dwell,
            170 | 180 | 190 => Group::Plane,
            200 | 210 => Group::Units,
            540 | 550 | 560 | 570 | 580 | 590 => Group::WorkOffset,
            900 | 910 => Group::Distance,
            940 | 950 => Group::FeedMode,
            _ => return Err(Stop::Unsupported(b'G', code)),
        };
        codes.takes(group)?;
        let modes = &mut self.modes;
        match code {
            0 => self.motion = Motion::Traverse,
            10 => self.motion = Motion::Feed,
            20 => self.motion = Motion::ArcClockwise,
            30 => self.motion = Motion::ArcCounterclockwise,
            40 => codes.dwells = true,
            170 => modes.plane = Plane::Xy,
            180 => modes.plane = Plane::Zx,
            190 => modes.plane = Plane::Yz,
            200 => self.select_units(LengthUnit::Inch)?,
            210 => self.select_units(LengthUnit::Millimetre)?,
            900 => modes.distance = Distance::Absolute,
            910 => modes.distance = Distance::Incremental,
            940 => self.select_feed_mode(FeedMode::PerMinute),
            950 => self.select_feed_mode(FeedMode::PerRevolution),
            // G54 to G59 are 1 to 6.
            _ => modes.work_offset = u32::from(code.wrapping_sub(530)).wrapping_div(10),
        }
        Ok(())
    }

    fn m_code(&mut self, code: u16, codes: &mut Codes) -> Result<(), Stop> {
        let group = match code {
            2 | 30 | 98 | 99 => Group::End,
            3..=5 => Group::Spindle,
            6 => Group::Tool,
            7..=9 => Group::Coolant,
            _ => return Err(Stop::Unsupported(b'M', code)),
        };
        codes.takes(group)?;
        let modes = &mut self.modes;
        match code {
            3 => modes.spindle = SpindleTurn::Clockwise,
            4 => modes.spindle = SpindleTurn::Counterclockwise,
            5 => modes.spindle = SpindleTurn::Stopped,
            6 => codes.changes_tool = true,
            7 => modes.mist = Switch::On,
            8 => modes.flood = Switch::On,
            9 => (modes.mist, modes.flood) = (Switch::Off, Switch::Off),
            _ => codes.end = Some(code),
        }
        Ok(())
    }

    /// Another unit converts lengths and needs another feed.
    fn select_units(&mut self, units: LengthUnit) -> Result<(), Stop> {
        if self.modes.units != units {
            let conversion = Conversion::between(self.modes.units, units);
            let position = self.position.converted(conversion);
            if !position.0.iter().all(|coordinate| coordinate.is_finite()) {
                return refuse(
                    FaultKind::OutOfDomain,
                    "a position that is too large for this unit",
                );
            }
            self.position = position;
            self.modes.units = units;
            self.modes.feed = 0.0;
        }
        Ok(())
    }

    fn select_feed_mode(&mut self, mode: FeedMode) {
        if self.modes.feed_mode != mode {
            self.modes.feed_mode = mode;
            self.modes.feed = 0.0;
        }
    }
}

/// A group of codes.
#[derive(Clone, Copy, Debug)]
enum Group {
    Motion,
    Dwell,
    Plane,
    Units,
    WorkOffset,
    Distance,
    FeedMode,
    End,
    Spindle,
    Tool,
    Coolant,
}

/// The actions of a block's codes in addition to modes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Codes {
    /// A bit for each group of which the block has a code.
    groups: u32,
    pub(super) dwells: bool,
    pub(super) changes_tool: bool,
    /// M2, M30, M98 or M99.
    pub(super) end: Option<u16>,
}

impl Codes {
    fn takes(&mut self, group: Group) -> Result<(), Stop> {
        let bit = match group {
            Group::Motion => 1,
            Group::Dwell => 2,
            Group::Plane => 4,
            Group::Units => 8,
            Group::WorkOffset => 16,
            Group::Distance => 32,
            Group::FeedMode => 64,
            Group::End => 128,
            Group::Spindle => 256,
            Group::Tool => 512,
            Group::Coolant => 1024,
        };
        if self.groups & bit != 0 {
            return refuse(FaultKind::ModalConflict, "two codes of one group");
        }
        self.groups |= bit;
        Ok(())
    }
}
