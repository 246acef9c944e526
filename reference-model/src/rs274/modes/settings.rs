//! The modes as they are recorded.

use gaugeblock_trace::{Indexed, Settings};

use super::{Modes, Spindle};

impl Modes {
    /// Everything that is in force, as it is recorded: every field is there.
    pub fn settings(&self) -> Settings {
        self.recorded(None)
    }

    /// What is in force and was not before, as it is recorded; nothing stands in the other fields.
    pub fn settings_since(&self, before: &Self) -> Settings {
        self.recorded(Some(before))
    }

    fn recorded(&self, before: Option<&Self>) -> Settings {
        macro_rules! of {
            ($mode:ident) => {
                (before.map(|before| before.$mode) != Some(self.$mode)).then_some(self.$mode)
            };
        }
        Settings {
            units: of!(units),
            plane: of!(plane),
            distance: of!(distance),
            arc_distance: of!(arc_distance),
            feed_mode: of!(feed_mode),
            feed_rate: of!(feed_rate),
            retract: of!(retract),
            compensation: of!(compensation),
            tool_length: of!(tool_length),
            tool_offset: of!(tool_offset),
            work_offset: of!(work_offset),
            g5x_offset: of!(g5x_offset),
            g92_offset: of!(g92_offset),
            rotation: of!(rotation),
            path: of!(path),
            blend_tolerance: of!(blend_tolerance),
            naive_cam_tolerance: of!(naive_cam_tolerance),
            lathe: of!(lathe),
            spindle_speed: self.of_each(before, |spindle| spindle.speed),
            spindle_mode: self.of_each(before, |spindle| spindle.mode),
            spindle_limit: self.of_each(before, |spindle| spindle.limit),
            spindle: self.of_each(before, |spindle| spindle.turn),
            mist: of!(mist),
            flood: of!(flood),
            feed_override: of!(feed_override),
            speed_override: self.of_each(before, |spindle| spindle.speed_override),
            adaptive_feed: of!(adaptive_feed),
            feed_stop: of!(feed_stop),
        }
    }

    /// One value of each spindle, by its number; of those alone that had another one before.
    fn of_each<T: PartialEq>(
        &self,
        before: Option<&Self>,
        value: impl Fn(&Spindle) -> T,
    ) -> Option<Indexed<u8, T>> {
        if before.is_some_and(|before| before.spindles == self.spindles) {
            return None;
        }
        let earlier = |place: usize| before.and_then(|before| before.spindles.get(place));
        let values = (0..=u8::MAX).zip(self.spindles.iter()).filter_map(|(number, spindle)| {
            let now = value(spindle);
            let same = earlier(usize::from(number)).is_some_and(|before| value(before) == now);
            (!same).then_some((number, now))
        });
        let values: Indexed<u8, T> = values.collect();
        (before.is_none() || !values.0.is_empty()).then_some(values)
    }
}
