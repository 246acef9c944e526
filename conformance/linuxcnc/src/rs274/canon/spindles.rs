//! Spindles, coolant and override controls.

use gaugeblock_adapter::HarnessError;
use gaugeblock_vocabulary::{
    Effect, Indexed, OrientDirection, Settings, SpindleLimit, SpindleMode, SpindleTurn, Switch,
};

use super::{Call, Canon, Done, Mark, whole};

/// Speed limit that stands for none.
const NO_LIMIT: f64 = 1e29;

impl Canon {
    pub(super) fn spindle(&mut self, call: &Call, numbers: &[f64]) -> Done {
        let of = |spindle: f64| spindle_number(call, spindle);
        let change = match (call.name.as_str(), numbers) {
            ("SET_SPINDLE_SPEED", &[spindle, speed]) => Settings {
                spindle_speed: Some(Indexed::one(of(spindle)?, speed)),
                ..Settings::default()
            },
            ("SET_SPINDLE_MODE", &[spindle, limit]) => spindle_mode(of(spindle)?, limit),
            ("START_SPINDLE_CLOCKWISE", &[spindle]) => turn(of(spindle)?, SpindleTurn::Clockwise),
            ("START_SPINDLE_COUNTERCLOCKWISE", &[spindle]) => {
                turn(of(spindle)?, SpindleTurn::Counterclockwise)
            }
            ("STOP_SPINDLE_TURNING", &[spindle]) => turn(of(spindle)?, SpindleTurn::Stopped),
            ("ENABLE_SPEED_OVERRIDE", &[spindle]) => speed_override(of(spindle)?, Switch::On),
            ("DISABLE_SPEED_OVERRIDE", &[spindle]) => speed_override(of(spindle)?, Switch::Off),
            ("ORIENT_SPINDLE", &[spindle, angle, direction]) => {
                self.set(turn(of(spindle)?, SpindleTurn::Oriented));
                let direction = orient_direction(call, direction)?;
                let spindle = u32::from(of(spindle)?);
                return self.effect(Effect::OrientSpindle { spindle, angle, direction });
            }
            _ => return self.switch(call),
        };
        self.set(change);
        Ok(Mark::None)
    }

    fn switch(&mut self, call: &Call) -> Done {
        let none = Settings::default();
        let change = match call.name.as_str() {
            "MIST_ON" => Settings { mist: Some(Switch::On), ..none },
            "MIST_OFF" => Settings { mist: Some(Switch::Off), ..none },
            "FLOOD_ON" => Settings { flood: Some(Switch::On), ..none },
            "FLOOD_OFF" => Settings { flood: Some(Switch::Off), ..none },
            "ENABLE_FEED_OVERRIDE" => Settings { feed_override: Some(Switch::On), ..none },
            "DISABLE_FEED_OVERRIDE" => Settings { feed_override: Some(Switch::Off), ..none },
            "ENABLE_ADAPTIVE_FEED" => Settings { adaptive_feed: Some(Switch::On), ..none },
            "DISABLE_ADAPTIVE_FEED" => Settings { adaptive_feed: Some(Switch::Off), ..none },
            "ENABLE_FEED_HOLD" => Settings { feed_stop: Some(Switch::On), ..none },
            "DISABLE_FEED_HOLD" => Settings { feed_stop: Some(Switch::Off), ..none },
            _ => return self.other(call),
        };
        self.set(change);
        Ok(Mark::None)
    }
}

fn spindle_mode(spindle: u8, limit: f64) -> Settings {
    let (mode, limit) = if limit > 0.0 {
        let limit = if limit > NO_LIMIT { SpindleLimit::None } else { SpindleLimit::Rpm(limit) };
        (SpindleMode::SurfaceSpeed, limit)
    } else {
        (SpindleMode::Rpm, SpindleLimit::None)
    };
    Settings {
        spindle_mode: Some(Indexed::one(spindle, mode)),
        spindle_limit: Some(Indexed::one(spindle, limit)),
        ..Settings::default()
    }
}

fn turn(spindle: u8, turn: SpindleTurn) -> Settings {
    Settings { spindle: Some(Indexed::one(spindle, turn)), ..Settings::default() }
}

fn speed_override(spindle: u8, switch: Switch) -> Settings {
    Settings { speed_override: Some(Indexed::one(spindle, switch)), ..Settings::default() }
}

fn orient_direction(call: &Call, direction: f64) -> Result<OrientDirection, HarnessError> {
    match whole(call, direction)? {
        0 => Ok(OrientDirection::Shortest),
        1 => Ok(OrientDirection::Clockwise),
        2 => Ok(OrientDirection::Counterclockwise),
        _ => Err(call.unreadable("orient direction")),
    }
}

fn spindle_number(call: &Call, number: f64) -> Result<u8, HarnessError> {
    u8::try_from(whole(call, number)?).map_err(|_| call.unreadable("spindle number"))
}
