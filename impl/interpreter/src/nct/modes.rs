//! The modes that are in force.

use gaugeblock_vocabulary::{
    Distance, FeedMode, Indexed, LengthUnit, Plane, Settings, SpindleTurn, Switch,
};

/// The modes in force, except the motion mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Modes {
    pub(super) units: LengthUnit,
    pub(super) plane: Plane,
    pub(super) distance: Distance,
    pub(super) feed_mode: FeedMode,
    /// Active length unit per minute or revolution; zero until set.
    pub(super) feed: f64,
    pub(super) work_offset: u32,
    pub(super) speed: f64,
    pub(super) spindle: SpindleTurn,
    pub(super) mist: Switch,
    pub(super) flood: Switch,
}

impl Default for Modes {
    /// G17 G90 G94 G21 G54.
    fn default() -> Self {
        Self {
            units: LengthUnit::Millimetre,
            plane: Plane::Xy,
            distance: Distance::Absolute,
            feed_mode: FeedMode::PerMinute,
            feed: 0.0,
            work_offset: 1,
            speed: 0.0,
            spindle: SpindleTurn::Stopped,
            mist: Switch::Off,
            flood: Switch::Off,
        }
    }
}

impl Modes {
    /// All of them, as reported to a sink.
    pub(super) fn settings(&self) -> Settings {
        Settings {
            units: Some(self.units),
            plane: Some(self.plane),
            distance: Some(self.distance),
            feed_mode: Some(self.feed_mode),
            feed_rate: Some(self.feed),
            work_offset: Some(self.work_offset),
            spindle_speed: Some(Indexed::one(0, self.speed)),
            spindle: Some(Indexed::one(0, self.spindle)),
            mist: Some(self.mist),
            flood: Some(self.flood),
            ..Settings::default()
        }
    }
}
