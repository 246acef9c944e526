//! The modes as they are recorded.

use gaugeblock_trace::{Indexed, Settings};

use super::{Modes, Spindle};

impl Modes {
    /// Everything that is in force, as it is recorded: every field is there.
    pub fn settings(&self) -> Settings {
        Settings {
            units: Some(self.units),
            plane: Some(self.plane),
            distance: Some(self.distance),
            arc_distance: Some(self.arc_distance),
            feed_mode: Some(self.feed_mode),
            feed_rate: Some(self.feed_rate),
            retract: Some(self.retract),
            compensation: Some(self.compensation),
            tool_length: Some(self.tool_length),
            tool_offset: Some(self.tool_offset),
            work_offset: Some(self.work_offset),
            g5x_offset: Some(self.g5x_offset),
            g92_offset: Some(self.g92_offset),
            rotation: Some(self.rotation),
            path: Some(self.path),
            blend_tolerance: Some(self.blend_tolerance),
            naive_cam_tolerance: Some(self.naive_cam_tolerance),
            lathe: Some(self.lathe),
            spindle_speed: Some(self.of_each(|spindle| spindle.speed)),
            spindle_mode: Some(self.of_each(|spindle| spindle.mode)),
            spindle_limit: Some(self.of_each(|spindle| spindle.limit)),
            spindle: Some(self.of_each(|spindle| spindle.turn)),
            mist: Some(self.mist),
            flood: Some(self.flood),
            feed_override: Some(self.feed_override),
            speed_override: Some(self.of_each(|spindle| spindle.speed_override)),
            adaptive_feed: Some(self.adaptive_feed),
            feed_stop: Some(self.feed_stop),
        }
    }

    /// One value of each spindle, by its number.
    fn of_each<T>(&self, value: impl Fn(&Spindle) -> T) -> Indexed<u8, T> {
        (0..=u8::MAX).zip(self.spindles.iter().map(value)).collect()
    }
}
