//! The modes as they are recorded.

use gaugeblock_vocabulary::{Indexed, Settings};

use super::{Modes, Spindle};

impl Modes {
    /// Everything that is in force, as it is recorded: every field is there.
    pub fn settings(&self) -> Settings {
        self.recorded::<true>(self)
    }

    /// What is in force and was not before, as it is recorded; nothing stands in the other fields.
    pub fn settings_since(&self, before: &Self) -> Settings {
        self.recorded::<false>(before)
    }

    /// What is in force and was not before; all of it where it is asked for.
    fn recorded<const ALL: bool>(&self, before: &Self) -> Settings {
        macro_rules! of {
            ($mode:ident) => {
                (ALL || Some(before.$mode) != Some(self.$mode)).then_some(self.$mode)
            };
        }
        let spindles = ALL || before.spindles != self.spindles;
        macro_rules! of_each {
            ($value:expr) => {
                spindles
                    .then(|| self.of_each::<ALL, _>(before, $value))
                    .filter(|values| ALL || !values.0.is_empty())
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
            spindle_speed: of_each!(|spindle: &Spindle| spindle.speed),
            spindle_mode: of_each!(|spindle: &Spindle| spindle.mode),
            spindle_limit: of_each!(|spindle: &Spindle| spindle.limit),
            spindle: of_each!(|spindle: &Spindle| spindle.turn),
            mist: of!(mist),
            flood: of!(flood),
            feed_override: of!(feed_override),
            speed_override: of_each!(|spindle: &Spindle| spindle.speed_override),
            adaptive_feed: of!(adaptive_feed),
            feed_stop: of!(feed_stop),
        }
    }

    /// One value of each spindle, by its number; of those that had another one before, or of all.
    fn of_each<const ALL: bool, T: PartialEq>(
        &self,
        before: &Self,
        value: impl Fn(&Spindle) -> T,
    ) -> Indexed<u8, T> {
        let earlier = |number: u8| before.spindles.get(usize::from(number)).map(&value);
        let values = (0..=u8::MAX).zip(self.spindles.iter()).filter_map(|(number, spindle)| {
            let now = value(spindle);
            (ALL || earlier(number).as_ref() != Some(&now)).then_some((number, now))
        });
        values.collect()
    }
}
