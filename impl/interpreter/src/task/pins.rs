//! Pins as a function of what is in force: settings, the operator's overrides, and spindles that are on their way to
//! an angle.

use gaugeblock_vocabulary::{OrientDirection, Pin, Settings, SpindleMode, SpindleTurn, Switch};

use crate::faults::{PlantedFault, planted};

use super::panel::SPINDLES;

/// The value of a pin that motion sets and not the task: not a number.
const SET_BY_MOTION: f64 = f64::NAN;

/// The commanded state of a spindle, and its orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spindle {
    /// S: revolutions per minute, or a surface speed.
    speed: f64,
    turn: SpindleTurn,
    /// Under constant surface speed (G96) S is not a speed of the spindle: motion computes it from the position of
    /// the tool.
    surface_speed: bool,
    override_enabled: bool,
    orientation: Orientation,
    /// Degrees.
    angle: f64,
    /// 0 the shortest way, 1 clockwise, 2 counterclockwise.
    direction: f64,
}

/// The state of M19.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Orientation {
    /// It was not commanded, or M3, M4 or M5 cancelled it.
    None,
    /// The spindle is on its way.
    Requested,
    /// It is at its angle and held there.
    Locked,
}

/// The pins of a spindle, in the order of [`Spindle::pins`].
type SpindlePins = [(Pin, f64); 9];

/// Everything that pins follow from, besides outputs.
#[derive(Clone, Debug)]
pub(super) struct TrackedSettings {
    pub(super) spindles: [Spindle; SPINDLES],
    pub(super) mist: bool,
    pub(super) flood: bool,
    /// M48 to M53: which controls are enabled.
    pub(super) feed_override: bool,
    pub(super) adaptive_feed: bool,
    pub(super) feed_stop: bool,
}

impl TrackedSettings {
    /// From the settings in force.
    pub(super) fn new(settings: &Settings) -> Self {
        let spindle = Spindle {
            speed: 0.0,
            turn: SpindleTurn::Stopped,
            surface_speed: false,
            override_enabled: true,
            orientation: Orientation::None,
            angle: 0.0,
            direction: 0.0,
        };
        let mut tracked = Self {
            spindles: [spindle; SPINDLES],
            mist: false,
            flood: false,
            feed_override: true,
            adaptive_feed: false,
            feed_stop: true,
        };
        tracked.set(settings);
        tracked
    }

    /// Takes over settings that changed; whether a pin may have changed.
    pub(super) fn set(&mut self, changed: &Settings) -> bool {
        let switch = |to: &mut bool, switch: Option<Switch>| {
            *to = switch.map_or(*to, |switch| switch == Switch::On);
        };
        switch(&mut self.feed_override, changed.feed_override);
        switch(&mut self.adaptive_feed, changed.adaptive_feed);
        switch(&mut self.feed_stop, changed.feed_stop);
        switch(&mut self.mist, changed.mist);
        switch(&mut self.flood, changed.flood);
        for (place, spindle) in (0_u8..).zip(&mut self.spindles) {
            if let Some(speed) = changed.spindle_speed.as_ref().and_then(|by| by.0.get(&place)) {
                spindle.speed = *speed;
            }
            if let Some(mode) = changed.spindle_mode.as_ref().and_then(|by| by.0.get(&place)) {
                spindle.surface_speed = *mode == SpindleMode::SurfaceSpeed;
            }
            if let Some(turn) = changed.spindle.as_ref().and_then(|by| by.0.get(&place)) {
                spindle.turn = *turn;
                if *turn != SpindleTurn::Oriented {
                    // M3, M4 and M5 clear the request and unlock the spindle (11.6.8).
                    spindle.orientation = Orientation::None;
                }
            }
            if let Some(on) = changed.speed_override.as_ref().and_then(|by| by.0.get(&place)) {
                spindle.override_enabled = *on == Switch::On;
            }
        }
        let spindles = changed.spindle.is_some()
            || changed.spindle_mode.is_some()
            || changed.spindle_speed.is_some()
            || changed.speed_override.is_some();
        spindles || changed.mist.is_some() || changed.flood.is_some()
    }

    /// Takes over settings that were only read ahead: orientation was neither commanded nor cancelled. A spindle that
    /// turns now is not held at an angle.
    pub(super) fn apply_read_ahead(&mut self, changed: &Settings) {
        let orientations = self.spindles.map(|spindle| spindle.orientation);
        self.set(changed);
        for (spindle, orientation) in self.spindles.iter_mut().zip(orientations) {
            if matches!(spindle.turn, SpindleTurn::Clockwise | SpindleTurn::Counterclockwise) {
                continue;
            }
            spindle.orientation = orientation;
            if orientation == Orientation::None {
                spindle.turn = SpindleTurn::Stopped;
            }
        }
    }

    /// No spindle is held at an angle, or on its way to one.
    pub(super) fn release(&mut self) {
        for spindle in &mut self.spindles {
            spindle.orientation = Orientation::None;
        }
    }

    /// Whether a spindle is on its way to its angle.
    pub(super) fn is_orienting(&self, spindle: u32) -> bool {
        let place = usize::try_from(spindle).ok();
        let spindle = place.and_then(|place| self.spindles.get(place));
        spindle.is_some_and(|spindle| spindle.orientation == Orientation::Requested)
    }

    /// M19 begins.
    pub(super) fn orient(&mut self, spindle: u32, angle: f64, direction: OrientDirection) {
        let Some(spindle) = self.spindle(spindle) else { return };
        spindle.orientation = Orientation::Requested;
        spindle.angle = angle;
        spindle.direction = match direction {
            OrientDirection::Shortest => 0.0,
            OrientDirection::Clockwise => 1.0,
            OrientDirection::Counterclockwise => 2.0,
        };
    }

    /// Locks a spindle at its angle.
    pub(super) fn lock(&mut self, spindle: u32) {
        let Some(spindle) = self.spindle(spindle) else { return };
        spindle.orientation = Orientation::Locked;
    }

    fn spindle(&mut self, number: u32) -> Option<&mut Spindle> {
        usize::try_from(number).ok().and_then(|number| self.spindles.get_mut(number))
    }
}

impl Spindle {
    /// The pins of this spindle.
    pub(super) fn pins(&self, number: u16, factor: f64, brake_while_locked: bool) -> SpindlePins {
        let enabled = self.override_enabled || planted(PlantedFault::OverrideAlwaysCounts);
        let speed = if enabled { self.speed * factor } else { self.speed };
        let direction_sign = match self.turn {
            SpindleTurn::Clockwise => 1.0,
            SpindleTurn::Counterclockwise => -1.0,
            SpindleTurn::Stopped | SpindleTurn::Oriented => 0.0,
        };
        let turns = direction_sign != 0.0 && (speed > 0.0 || planted(PlantedFault::OnAtZero));
        let speed_out = match turns {
            true if self.surface_speed => SET_BY_MOTION,
            true => speed * direction_sign,
            false => 0.0,
        };
        let locked = self.orientation == Orientation::Locked;
        let requested = self.orientation == Orientation::Requested
            || locked && planted(PlantedFault::OrientRequestStays);
        // M19 reports the orientation just before the angle. A spindle that was started at a speed of zero is not
        // braked: a speed may follow at any time.
        let turning_to_angle = self.turn == SpindleTurn::Oriented && !locked;
        let brake = if brake_while_locked {
            locked
        } else {
            direction_sign == 0.0 && !requested && !turning_to_angle
        };
        [
            (Pin::SpindleOn(number), bit(turns)),
            (Pin::SpindleForward(number), bit(turns && direction_sign > 0.0)),
            (Pin::SpindleReverse(number), bit(turns && direction_sign < 0.0)),
            (Pin::SpindleSpeed(number), speed_out),
            (Pin::SpindleBrake(number), bit(brake)),
            (Pin::SpindleLocked(number), bit(locked)),
            (Pin::SpindleOrient(number), bit(requested)),
            (Pin::SpindleOrientAngle(number), self.angle),
            (Pin::SpindleOrientMode(number), self.direction),
        ]
    }
}

/// 1 or 0.
pub(super) fn bit(on: bool) -> f64 {
    f64::from(u8::from(on))
}
