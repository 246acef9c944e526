//! HAL items that a program can read (11.4.3.7): the inputs and pins of the machine, under the manual's names
//! (5.6.1.2, 5.6.2.1, 5.6.4.1).

use gaugeblock_vocabulary::{Machine, Pin};

use super::machine::Input;
use crate::parameters::ItemName;

/// The names of all items: inputs, then pins in the order of [`pins`].
pub(super) fn names(machine: &Machine) -> impl Iterator<Item = ItemName> + use<> {
    let inputs = inputs(machine.digital_io, machine.analog_io).map(input_name);
    inputs.chain(pins(machine).map(pin_name))
}

/// The inputs of a machine.
pub(super) fn inputs(digital: u16, analog: u16) -> impl Iterator<Item = Input> {
    let digital = (0..digital).map(Input::Digital);
    let analog = (0..analog).map(Input::Analog);
    digital.chain(analog).chain([Input::AdaptiveFeed, Input::FeedHold])
}

/// The pins of a machine.
pub(super) fn pins(machine: &Machine) -> impl Iterator<Item = Pin> + use<> {
    let digital = (0..machine.digital_io).map(Pin::DigitalOut);
    let analog = (0..machine.analog_io).map(Pin::AnalogOut);
    let spindles = (0..u16::from(machine.spindles)).flat_map(|spindle| {
        [
            Pin::SpindleOn(spindle),
            Pin::SpindleForward(spindle),
            Pin::SpindleReverse(spindle),
            Pin::SpindleSpeed(spindle),
            Pin::SpindleBrake(spindle),
            Pin::SpindleLocked(spindle),
            Pin::SpindleOrient(spindle),
            Pin::SpindleOrientAngle(spindle),
            Pin::SpindleOrientMode(spindle),
        ]
    });
    digital.chain(analog).chain(spindles).chain([Pin::CoolantMist, Pin::CoolantFlood])
}

fn input_name(input: Input) -> ItemName {
    match input {
        Input::Digital(number) => ItemName::numbered("motion.digital-in-", number, 2, ""),
        Input::Analog(number) => ItemName::numbered("motion.analog-in-", number, 2, ""),
        Input::AdaptiveFeed => ItemName::plain("motion.adaptive-feed"),
        Input::FeedHold => ItemName::plain("motion.feed-hold"),
    }
}

fn pin_name(pin: Pin) -> ItemName {
    let of_spindle = |spindle, pin| ItemName::numbered("spindle.", spindle, 1, pin);
    match pin {
        Pin::DigitalOut(number) => ItemName::numbered("motion.digital-out-", number, 2, ""),
        Pin::AnalogOut(number) => ItemName::numbered("motion.analog-out-", number, 2, ""),
        Pin::SpindleOn(spindle) => of_spindle(spindle, ".on"),
        Pin::SpindleForward(spindle) => of_spindle(spindle, ".forward"),
        Pin::SpindleReverse(spindle) => of_spindle(spindle, ".reverse"),
        Pin::SpindleSpeed(spindle) => of_spindle(spindle, ".speed-out"),
        Pin::SpindleBrake(spindle) => of_spindle(spindle, ".brake"),
        Pin::SpindleLocked(spindle) => of_spindle(spindle, ".locked"),
        Pin::SpindleOrient(spindle) => of_spindle(spindle, ".orient"),
        Pin::SpindleOrientAngle(spindle) => of_spindle(spindle, ".orient-angle"),
        Pin::SpindleOrientMode(spindle) => of_spindle(spindle, ".orient-mode"),
        Pin::CoolantMist => ItemName::plain("iocontrol.0.coolant-mist"),
        Pin::CoolantFlood => ItemName::plain("iocontrol.0.coolant-flood"),
    }
}
