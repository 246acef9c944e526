//! HAL items: the pins of the machine under the names that a program can read.

use gaugeblock_vocabulary::{Machine, Pin};

use super::state::Synchronised;
use super::{EnvironmentState, Input};

/// What a program can read of HAL.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Item {
    /// A pin that the controller drives.
    Driven(Pin),
    /// A digital or analog input.
    Read(Input),
    /// The adaptive feed input.
    AdaptiveFeed,
    /// The feed stop input.
    FeedStop,
}

impl Item {
    /// The item of a name. A machine has its inputs, outputs, spindles and coolant, under the names of the manual,
    /// and no other item.
    pub(crate) fn of(name: &str, machine: &Machine) -> Option<Self> {
        match name {
            "motion.adaptive-feed" => return Some(Self::AdaptiveFeed),
            "motion.feed-hold" => return Some(Self::FeedStop),
            "iocontrol.0.coolant-mist" => return Some(Self::Driven(Pin::CoolantMist)),
            "iocontrol.0.coolant-flood" => return Some(Self::Driven(Pin::CoolantFlood)),
            _ => {}
        }
        if let Some(rest) = name.strip_prefix("spindle.") {
            let (number, pin) = rest.split_once('.')?;
            let number = index(number, 1, u16::from(machine.spindles))?;
            return spindle_pin(number, pin).map(Self::Driven);
        }
        let (kind, number) = name.strip_prefix("motion.")?.rsplit_once('-')?;
        let digital = || index(number, 2, machine.digital_io);
        let analog = || index(number, 2, machine.analog_io);
        match kind {
            "digital-in" => digital().map(|number| Self::Read(Input::Digital(number.into()))),
            "analog-in" => analog().map(|number| Self::Read(Input::Analog(number.into()))),
            "digital-out" => digital().map(|number| Self::Driven(Pin::DigitalOut(number))),
            "analog-out" => analog().map(|number| Self::Driven(Pin::AnalogOut(number))),
            _ => None,
        }
    }
}

fn spindle_pin(number: u16, pin: &str) -> Option<Pin> {
    Some(match pin {
        "on" => Pin::SpindleOn(number),
        "forward" => Pin::SpindleForward(number),
        "reverse" => Pin::SpindleReverse(number),
        "speed-out" => Pin::SpindleSpeed(number),
        "brake" => Pin::SpindleBrake(number),
        "locked" => Pin::SpindleLocked(number),
        "orient" => Pin::SpindleOrient(number),
        "orient-angle" => Pin::SpindleOrientAngle(number),
        "orient-mode" => Pin::SpindleOrientMode(number),
        _ => return None,
    })
}

/// A number of so many digits at least, below what the machine has.
fn index(text: &str, digits: usize, of_machine: u16) -> Option<u16> {
    let number = text.parse().ok().filter(|number| *number < of_machine)?;
    (format!("{number:0digits$}") == text).then_some(number)
}

impl EnvironmentState {
    /// A program begins, or has waited for the machine: from now on it sees what is there now.
    pub(crate) fn synchronise(&mut self) {
        self.synchronised = Synchronised { time: self.time, levels: self.levels.clone() };
    }

    /// Rule parameters.hal-time. The value of an item when the program was synchronised with the machine last.
    pub(crate) fn item(&self, item: Item) -> f64 {
        let seen = &self.synchronised;
        let level = |pin| seen.levels.get(&pin).copied().unwrap_or(0.0);
        match item {
            Item::Driven(pin) => level(pin),
            Item::Read(input) => {
                self.wire(input).map_or_else(|| self.input_at(input, seen.time), level)
            }
            Item::AdaptiveFeed => self.feed_input_at("adaptive_feed", seen.time).unwrap_or(1.0),
            Item::FeedStop => self.feed_input_at("feed_hold", seen.time).unwrap_or(0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_are_those_that_the_machine_has() {
        let machine = Machine { spindles: 2, digital_io: 12, ..Machine::default() };
        let item = |name| Item::of(name, &machine);
        assert_eq!(item("motion.digital-in-11"), Some(Item::Read(Input::Digital(11))));
        assert_eq!(item("motion.analog-out-03"), Some(Item::Driven(Pin::AnalogOut(3))));
        assert_eq!(item("spindle.1.speed-out"), Some(Item::Driven(Pin::SpindleSpeed(1))));
        for absent in [
            "motion.digital-in-12",
            "motion.digital-in-1",
            "motion.digital-in-001",
            "motion.analog-in-04",
            "motion.digital-in",
            "spindle.2.on",
            "spindle.00.on",
            "spindle.0.door",
            "door.open",
        ] {
            assert_eq!(item(absent), None, "{absent}");
        }
    }
}
