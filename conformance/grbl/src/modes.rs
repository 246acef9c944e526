//! The modes that `$G` reports, as settings and state.

use gaugeblock_vocabulary::{
    Compensation, Distance, FeedMode, Indexed, Lathe, LengthUnit, Motion, PathControlMode, Plane,
    ReturnMode, Rs274State, Settings, SpindleMode, SpindleTurn, Switch,
};

use crate::dialect::Dialect;
use crate::message::number;

/// Millimetres of an inch.
pub(crate) const MM_PER_INCH: f64 = 25.4;

/// What `$G` reports.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Modes {
    /// Settings; lengths in the active length unit.
    pub(crate) settings: Settings,
    /// Motion mode and tool.
    pub(crate) state: Rs274State,
    /// Whether M2 or M30 is in force.
    pub(crate) is_ended: bool,
    /// Decimals of F and S.
    pub(crate) decimals: Decimals,
}

/// Decimals of the numbers that are printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Decimals {
    /// Of F.
    pub(crate) feed: usize,
    /// Of S.
    pub(crate) speed: usize,
}

impl Modes {
    /// Reads the value of a `[GC:]` report of a controller that reports lengths in this unit.
    pub(crate) fn read(text: &str, unit: LengthUnit) -> Option<Self> {
        let mut modes = Self::default();
        let mut feed = None;
        for word in text.split_whitespace() {
            let letter = word.chars().next().filter(char::is_ascii_uppercase)?;
            let digits = &word[1..];
            let value = number(digits)?;
            let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len());
            match letter {
                'G' => modes.g_code(tenths(digits)?),
                'M' => modes.m_code(tenths(digits)?),
                'T' => modes.state.tool = digits.parse().ok(),
                'F' => {
                    feed = Some(value);
                    modes.decimals.feed = decimals;
                }
                'S' => {
                    modes.settings.spindle_speed = Some(Indexed::one(0, value));
                    modes.decimals.speed = decimals;
                }
                // Words of extensions.
                _ => {}
            }
        }
        // Under inverse time F is not a length, and no document says how it is printed.
        let is_rate = modes.settings.feed_mode != Some(FeedMode::InverseTime);
        let units = modes.settings.units?;
        modes.settings.feed_rate =
            feed.filter(|_| is_rate).map(|feed| converted(feed, unit, units));
        Some(modes)
    }

    /// What these modes are on a member of the family.
    ///
    /// Grbl has no tool change: its T is the number that a program selected last, and names no tool in the spindle.
    pub(crate) fn of(mut self, dialect: Dialect) -> Self {
        if dialect == Dialect::Grbl {
            self.state.tool = None;
        }
        self
    }

    fn g_code(&mut self, tenths: u32) {
        let settings = &mut self.settings;
        match tenths {
            170 => settings.plane = Some(Plane::Xy),
            180 => settings.plane = Some(Plane::Zx),
            190 => settings.plane = Some(Plane::Yz),
            200 => settings.units = Some(LengthUnit::Inch),
            210 => settings.units = Some(LengthUnit::Millimetre),
            400 => settings.compensation = Some(Compensation::Off),
            430..=432 => settings.tool_length = Some(Switch::On),
            490 => settings.tool_length = Some(Switch::Off),
            540 | 550 | 560 | 570 | 580 | 590 => settings.work_offset = Some(tenths / 10 - 53),
            591..=593 => settings.work_offset = Some(tenths - 584),
            610 => settings.path = Some(PathControlMode::ExactPath),
            611 => settings.path = Some(PathControlMode::ExactStop),
            640 => settings.path = Some(PathControlMode::Continuous),
            70 => settings.lathe = Some(Lathe::Diameter),
            80 => settings.lathe = Some(Lathe::Radius),
            900 => settings.distance = Some(Distance::Absolute),
            910 => settings.distance = Some(Distance::Incremental),
            901 => settings.arc_distance = Some(Distance::Absolute),
            911 => settings.arc_distance = Some(Distance::Incremental),
            930 => settings.feed_mode = Some(FeedMode::InverseTime),
            940 => settings.feed_mode = Some(FeedMode::PerMinute),
            950 => settings.feed_mode = Some(FeedMode::PerRevolution),
            960 => settings.spindle_mode = Some(Indexed::one(0, SpindleMode::SurfaceSpeed)),
            970 => settings.spindle_mode = Some(Indexed::one(0, SpindleMode::Rpm)),
            980 => settings.retract = Some(ReturnMode::OldZ),
            990 => settings.retract = Some(ReturnMode::RPlane),
            _ => self.state.motion = motion(tenths).or(self.state.motion),
        }
    }

    fn m_code(&mut self, tenths: u32) {
        let turn = |turn| Some(Indexed::one(0, turn));
        let settings = &mut self.settings;
        let mut coolant = |mist: bool, flood: bool| {
            let switch = |on, before| if on { Switch::On } else { before };
            let is_set = |known: Option<Switch>| known.unwrap_or(Switch::Off);
            settings.mist = Some(switch(mist, is_set(settings.mist)));
            settings.flood = Some(switch(flood, is_set(settings.flood)));
        };
        match tenths {
            20 | 300 => self.is_ended = true,
            30 => self.settings.spindle = turn(SpindleTurn::Clockwise),
            40 => self.settings.spindle = turn(SpindleTurn::Counterclockwise),
            50 => self.settings.spindle = turn(SpindleTurn::Stopped),
            70 => coolant(true, false),
            80 => coolant(false, true),
            90 => coolant(false, false),
            _ => {}
        }
    }
}

/// A code in tenths: 382 for 38.2.
fn tenths(digits: &str) -> Option<u32> {
    let (whole, part) = digits.split_once('.').unwrap_or((digits, "0"));
    let (whole, part) = (whole.parse::<u32>().ok()?, part.parse::<u32>().ok()?);
    (part < 10).then_some(whole.checked_mul(10)?.checked_add(part)?)
}

fn motion(tenths: u32) -> Option<Motion> {
    Some(match tenths {
        0 => Motion::Traverse,
        10 => Motion::Feed,
        20 => Motion::ArcClockwise,
        30 => Motion::ArcCounterclockwise,
        50 => Motion::CubicSpline,
        51 => Motion::QuadraticSpline,
        330 => Motion::SpindleSynchronised,
        382 => Motion::ProbeTowardError,
        383 => Motion::ProbeToward,
        384 => Motion::ProbeAwayError,
        385 => Motion::ProbeAway,
        730 => Motion::Cycle73,
        760 => Motion::Thread76,
        800 => Motion::None,
        810 => Motion::Cycle81,
        820 => Motion::Cycle82,
        830 => Motion::Cycle83,
        850 => Motion::Cycle85,
        860 => Motion::Cycle86,
        890 => Motion::Cycle89,
        _ => return None,
    })
}

/// A length in another unit.
pub(crate) fn converted(length: f64, from: LengthUnit, to: LengthUnit) -> f64 {
    match (from, to) {
        (LengthUnit::Millimetre, LengthUnit::Inch) => length / MM_PER_INCH,
        (LengthUnit::Inch, LengthUnit::Millimetre) => length * MM_PER_INCH,
        (LengthUnit::Millimetre, LengthUnit::Millimetre) | (LengthUnit::Inch, LengthUnit::Inch) => {
            length
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Modes {
        Modes::read(text, LengthUnit::Millimetre).unwrap_or_else(|| panic!("{text}"))
    }

    #[test]
    fn modes_after_a_reset_are_read() {
        let modes = read("G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0");
        let settings = &modes.settings;
        assert_eq!(modes.state.motion, Some(Motion::Traverse));
        assert_eq!(modes.state.tool, Some(0));
        assert_eq!(settings.work_offset, Some(1));
        assert_eq!(settings.units, Some(LengthUnit::Millimetre));
        assert_eq!(settings.spindle, Some(Indexed::one(0, SpindleTurn::Stopped)));
        assert_eq!((settings.mist, settings.flood), (Some(Switch::Off), Some(Switch::Off)));
        assert_eq!((settings.tool_length, settings.path), (None, None));
        assert!(!modes.is_ended);
    }

    #[test]
    fn both_coolants_are_on_if_both_are_reported() {
        let settings = read("G38.2 G59.3 G18 G21 G91 G94 M30 M3 M7 M8 T2 F0 S1000.0");
        assert!(settings.is_ended && settings.decimals.speed == 1);
        assert_eq!(settings.state.motion, Some(Motion::ProbeTowardError));
        let settings = settings.settings;
        assert_eq!((settings.mist, settings.flood), (Some(Switch::On), Some(Switch::On)));
        assert_eq!(settings.work_offset, Some(9));
    }

    #[test]
    fn feed_is_reported_in_the_unit_of_reports() {
        let feed = |text| read(text).settings.feed_rate;
        assert_eq!(feed("G1 G20 G94 F254"), Some(10.0));
        assert_eq!(feed("G1 G21 G94 F254"), Some(254.0));
        assert_eq!(feed("G1 G21 G93 F254"), None);
    }

    #[test]
    fn a_report_of_another_form_is_not_read() {
        for text in ["G0 G54", "G0 g21", "G0 G21 M", "G0 G21 Fx", "G0 G21 é"] {
            assert_eq!(Modes::read(text, LengthUnit::Millimetre), None, "{text}");
        }
    }
}
