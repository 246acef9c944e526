//! The settings in force as the printer keeps them: small enough to be copied for each block.

use gaugeblock_vocabulary::{
    Compensation, Distance, FeedMode, Lathe, LengthUnit, PathControlMode, Plane, Position,
    ReturnMode, Settings, SpindleLimit, SpindleMode, SpindleTurn, Switch,
};

use super::words::Words;

/// Most spindles that a machine has.
pub(super) const SPINDLES: usize = 8;

/// What is set for one spindle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spindle {
    pub(super) speed: f64,
    pub(super) mode: SpindleMode,
    pub(super) limit: SpindleLimit,
    pub(super) turn: SpindleTurn,
    pub(super) speed_override: Switch,
}

macro_rules! modes {
    ($($field:ident: $type:ty = $initial:expr),* ; $($indexed:ident => $spindle:ident),*) => {
        /// All settings; lengths in the active unit.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub(super) struct Modes {
            $(pub(super) $field: $type,)*
            pub(super) spindles: [Spindle; SPINDLES],
        }

        impl Default for Modes {
            fn default() -> Self {
                let spindle = Spindle {
                    speed: 0.0,
                    mode: SpindleMode::Rpm,
                    limit: SpindleLimit::None,
                    turn: SpindleTurn::Stopped,
                    speed_override: Switch::On,
                };
                Self { $($field: $initial,)* spindles: [spindle; SPINDLES] }
            }
        }

        impl Modes {
            /// Takes over what changed.
            pub(super) fn apply(&mut self, changed: &Settings) {
                $(if let Some(value) = changed.$field { self.$field = value; })*
                $(for (place, value) in changed.$indexed.iter().flat_map(|values| &values.0) {
                    if let Some(spindle) = self.spindles.get_mut(usize::from(*place)) {
                        spindle.$spindle = *value;
                    }
                })*
            }
        }
    };
}

impl Modes {
    /// Takes over what the words of a refused block set and the interpreter does not report: modes without lengths.
    pub(super) fn assume(&mut self, words: &Words) {
        for code in &words.m {
            match code {
                7 => self.mist = Switch::On,
                8 => self.flood = Switch::On,
                9 => (self.mist, self.flood) = (Switch::Off, Switch::Off),
                48 => self.feed_override = Switch::On,
                49 => self.feed_override = Switch::Off,
                _ => {}
            }
        }
        for code in &words.g {
            match code {
                170 => self.plane = Plane::Xy,
                180 => self.plane = Plane::Zx,
                190 => self.plane = Plane::Yz,
                171 => self.plane = Plane::Uv,
                181 => self.plane = Plane::Wu,
                191 => self.plane = Plane::Vw,
                200 => self.units = LengthUnit::Inch,
                210 => self.units = LengthUnit::Millimetre,
                70 => self.lathe = Lathe::Diameter,
                80 => self.lathe = Lathe::Radius,
                900 => self.distance = Distance::Absolute,
                910 => self.distance = Distance::Incremental,
                901 => self.arc_distance = Distance::Absolute,
                911 => self.arc_distance = Distance::Incremental,
                980 => self.retract = ReturnMode::OldZ,
                990 => self.retract = ReturnMode::RPlane,
                610 => self.path = PathControlMode::ExactPath,
                611 => self.path = PathControlMode::ExactStop,
                640 => {
                    self.path = PathControlMode::Continuous;
                    self.blend_tolerance = words.get(b'P').unwrap_or(0.0);
                    self.naive_cam_tolerance = words.get(b'Q').unwrap_or(self.blend_tolerance);
                }
                _ => {}
            }
        }
    }
}

modes! {
    units: LengthUnit = LengthUnit::Millimetre,
    plane: Plane = Plane::Xy,
    distance: Distance = Distance::Absolute,
    arc_distance: Distance = Distance::Incremental,
    feed_mode: FeedMode = FeedMode::PerMinute,
    feed_rate: f64 = 0.0,
    retract: ReturnMode = ReturnMode::RPlane,
    compensation: Compensation = Compensation::Off,
    tool_offset: Position = Position::default(),
    work_offset: u32 = 1,
    g5x_offset: Position = Position::default(),
    g92_offset: Position = Position::default(),
    rotation: f64 = 0.0,
    path: PathControlMode = PathControlMode::Continuous,
    blend_tolerance: f64 = 0.0,
    naive_cam_tolerance: f64 = 0.0,
    lathe: Lathe = Lathe::Radius,
    mist: Switch = Switch::Off,
    flood: Switch = Switch::Off,
    feed_override: Switch = Switch::On,
    adaptive_feed: Switch = Switch::Off,
    feed_stop: Switch = Switch::On;
    spindle_speed => speed, spindle_mode => mode, spindle_limit => limit, spindle => turn,
    speed_override => speed_override
}
