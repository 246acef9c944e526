//! The settings in force, and which of them have not been reported yet.

use gaugeblock_vocabulary::{
    Compensation, Distance, FeedMode, Lathe, LengthUnit, PathControlMode, Plane, ReturnMode,
    Settings, SpindleLimit, SpindleMode, SpindleTurn, Switch,
};

use super::coordinates::Coordinates;

/// Most spindles that a machine has.
pub(crate) const SPINDLES: usize = 8;

/// A set of spindles: bit n for spindle n.
pub(crate) type Spindles = u8;
/// Spindle 0.
pub(crate) const FIRST: Spindles = 1;

/// The settings of one spindle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spindle {
    /// S: revolutions per minute or surface speed.
    pub(crate) speed: f64,
    /// The meaning of S.
    pub(crate) mode: SpindleMode,
    /// D of G96.
    pub(crate) limit: SpindleLimit,
    /// Its commanded state.
    pub(crate) turn: SpindleTurn,
    /// Whether its speed override is enabled.
    pub(crate) speed_override: Switch,
}

impl Spindle {
    /// Whether M3 or M4 is in force.
    pub(crate) fn turns(&self) -> bool {
        matches!(self.turn, SpindleTurn::Clockwise | SpindleTurn::Counterclockwise)
    }
}

/// Every setting; lengths in the active unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Modes {
    pub(crate) units: LengthUnit,
    pub(crate) plane: Plane,
    pub(crate) distance: Distance,
    pub(crate) arc_distance: Distance,
    pub(crate) feed_mode: FeedMode,
    /// Zero until set.
    pub(crate) feed_rate: f64,
    pub(crate) retract: ReturnMode,
    pub(crate) compensation: Compensation,
    pub(crate) tool_length: Switch,
    pub(crate) tool_offset: Coordinates,
    /// 1 to 9.
    pub(crate) work_offset: u32,
    pub(crate) g5x_offset: Coordinates,
    pub(crate) g92_offset: Coordinates,
    /// Degrees.
    pub(crate) rotation: f64,
    pub(crate) path: PathControlMode,
    pub(crate) blend_tolerance: f64,
    pub(crate) naive_cam_tolerance: f64,
    pub(crate) lathe: Lathe,
    pub(crate) mist: Switch,
    pub(crate) flood: Switch,
    pub(crate) feed_override: Switch,
    pub(crate) adaptive_feed: Switch,
    pub(crate) feed_stop: Switch,
    pub(crate) spindles: [Spindle; SPINDLES],
}

impl Default for Modes {
    /// The state at power-up, as far as documents define it; machine and options set the rest.
    fn default() -> Self {
        let spindle = Spindle {
            speed: 0.0,
            mode: SpindleMode::Rpm,
            limit: SpindleLimit::None,
            turn: SpindleTurn::Stopped,
            speed_override: Switch::On,
        };
        Self {
            units: LengthUnit::Millimetre,
            plane: Plane::Xy,
            distance: Distance::Absolute,
            arc_distance: Distance::Incremental,
            feed_mode: FeedMode::PerMinute,
            feed_rate: 0.0,
            retract: ReturnMode::RPlane,
            compensation: Compensation::Off,
            tool_length: Switch::Off,
            tool_offset: Coordinates::default(),
            work_offset: 1,
            g5x_offset: Coordinates::default(),
            g92_offset: Coordinates::default(),
            rotation: 0.0,
            path: PathControlMode::Continuous,
            blend_tolerance: 0.0,
            naive_cam_tolerance: 0.0,
            lathe: Lathe::Radius,
            mist: Switch::Off,
            flood: Switch::Off,
            feed_override: Switch::On,
            adaptive_feed: Switch::Off,
            feed_stop: Switch::On,
            spindles: [spindle; SPINDLES],
        }
    }
}

/// The modes, and which of them were reported to the sink.
#[derive(Clone, Debug)]
pub(crate) struct ActiveSettings {
    /// As they are now.
    pub(super) now: Modes,
    /// As reported to the sink, where `changed` is set.
    pub(super) reported: Modes,
    /// Whether anything except F was touched since the last report.
    pub(super) changed: bool,
    /// Whether F was.
    pub(super) feed_changed: bool,
    /// As they were before the block, where `noted` is set.
    before: Modes,
    /// Whether the block has set anything but F.
    noted: bool,
    /// F before the block.
    feed_before: f64,
    /// How many spindles the machine has.
    pub(super) spindles: usize,
}

impl ActiveSettings {
    /// Nothing has to be reported yet: a run begins with all settings known.
    pub(crate) fn new(now: Modes, spindles: usize) -> Self {
        Self {
            now,
            reported: now,
            changed: false,
            feed_changed: false,
            before: now,
            noted: true,
            feed_before: 0.0,
            spindles,
        }
    }

    /// The settings in force.
    #[inline]
    pub(crate) fn now(&self) -> &Modes {
        &self.now
    }

    /// F, of which every block may have another.
    #[inline]
    pub(crate) fn set_feed_rate(&mut self, feed_rate: f64) {
        self.now.feed_rate = feed_rate;
        self.feed_changed = true;
    }

    /// Sets one setting.
    #[inline]
    pub(crate) fn put<T: PartialEq>(&mut self, of: impl Fn(&mut Modes) -> &mut T, value: T) {
        if *of(&mut self.now) != value {
            *of(self.set()) = value;
        }
    }

    /// For setting several at once.
    #[inline]
    pub(crate) fn set(&mut self) -> &mut Modes {
        self.changed = true;
        if !self.noted {
            self.noted = true;
            self.before = self.now;
        }
        &mut self.now
    }

    /// Begins a block that can be rolled back.
    #[inline]
    pub(crate) fn begin_notes(&mut self) {
        self.noted = false;
        self.feed_before = self.now.feed_rate;
    }

    /// Restores what the block set; reports to the sink stay.
    #[cold]
    pub(crate) fn roll_back(&mut self) {
        let feed = self.feed_before;
        if self.noted {
            self.now = self.before;
            self.changed = true;
        }
        self.set_feed_rate(feed);
    }

    /// All settings.
    pub(crate) fn settings(&self) -> Settings {
        everything(&self.now, self.spindles)
    }
}

/// The value where it is another one.
pub(super) fn since<T: PartialEq, U>(now: T, reported: T, record: impl Fn(T) -> U) -> Option<U> {
    (now != reported).then(|| record(now))
}

macro_rules! settings {
    ($($field:ident => $record:expr),* ; $($indexed:ident => $spindle:ident),*) => {
        pub(super) fn difference(now: &Modes, reported: &Modes, spindles: usize) -> Settings {
            let mut settings = Settings::default();
            $(settings.$field = since(now.$field, reported.$field, $record);)*
            if now.spindles != reported.spindles {
                for ((place, now), reported) in (0_u8..).zip(&now.spindles).zip(&reported.spindles).take(spindles) {
                    $(if let Some(value) = since(now.$spindle, reported.$spindle, |value| value) {
                        settings.$indexed.get_or_insert_default().0.insert(place, value);
                    })*
                }
            }
            settings
        }

        fn everything(now: &Modes, spindles: usize) -> Settings {
            let mut settings = Settings::default();
            $(settings.$field = Some($record(now.$field));)*
            for (place, now) in (0_u8..).zip(&now.spindles).take(spindles) {
                $(settings.$indexed.get_or_insert_default().0.insert(place, now.$spindle);)*
            }
            settings
        }
    };
}

settings! {
    units => |value| value, plane => |value| value, distance => |value| value, arc_distance => |value| value,
    feed_mode => |value| value, feed_rate => |value| value, retract => |value| value, compensation => |value| value,
    tool_length => |value| value, tool_offset => Coordinates::position, work_offset => |value| value,
    g5x_offset => Coordinates::position, g92_offset => Coordinates::position, rotation => |value| value,
    path => |value| value, blend_tolerance => |value| value, naive_cam_tolerance => |value| value,
    lathe => |value| value, mist => |value| value, flood => |value| value, feed_override => |value| value,
    adaptive_feed => |value| value, feed_stop => |value| value;
    spindle_speed => speed, spindle_mode => mode, spindle_limit => limit, spindle => turn,
    speed_override => speed_override
}
