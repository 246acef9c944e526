//! HAL items that a program can read (11.4.3.7): the inputs and pins of the machine, under the manual's names (5.6.1.2, 5.6.2.1, 5.6.4.1).

use alloc::string::{String, ToString};

use gaugeblock_trace::{Machine, Pin};

use super::machine::Input;

/// The names of all items: inputs, then pins in the order of [`pins`].
pub(super) fn names(machine: &Machine) -> impl Iterator<Item = String> + use<> {
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

fn input_name(input: Input) -> String {
    match input {
        Input::Digital(number) => with_number("motion.digital-in-", number),
        Input::Analog(number) => with_number("motion.analog-in-", number),
        Input::AdaptiveFeed => "motion.adaptive-feed".into(),
        Input::FeedHold => "motion.feed-hold".into(),
    }
}

fn pin_name(pin: Pin) -> String {
    match pin {
        Pin::DigitalOut(number) => with_number("motion.digital-out-", number),
        Pin::AnalogOut(number) => with_number("motion.analog-out-", number),
        Pin::SpindleOn(spindle) => of_spindle(spindle, ".on"),
        Pin::SpindleForward(spindle) => of_spindle(spindle, ".forward"),
        Pin::SpindleReverse(spindle) => of_spindle(spindle, ".reverse"),
        Pin::SpindleSpeed(spindle) => of_spindle(spindle, ".speed-out"),
        Pin::SpindleBrake(spindle) => of_spindle(spindle, ".brake"),
        Pin::SpindleLocked(spindle) => of_spindle(spindle, ".locked"),
        Pin::SpindleOrient(spindle) => of_spindle(spindle, ".orient"),
        Pin::SpindleOrientAngle(spindle) => of_spindle(spindle, ".orient-angle"),
        Pin::SpindleOrientMode(spindle) => of_spindle(spindle, ".orient-mode"),
        Pin::CoolantMist => "iocontrol.0.coolant-mist".into(),
        Pin::CoolantFlood => "iocontrol.0.coolant-flood".into(),
    }
}

/// A name that ends in a number of two digits at least.
fn with_number(name: &str, number: u16) -> String {
    let mut text = room(name);
    if number < 10 {
        text.push('0');
    }
    push_number(&mut text, number);
    text
}

fn of_spindle(spindle: u16, pin: &str) -> String {
    let mut text = room("spindle.");
    push_number(&mut text, spindle);
    text.push_str(pin);
    text
}

/// A text that has room for what stands behind its beginning.
fn room(beginning: &str) -> String {
    let mut text = String::with_capacity(32);
    text.push_str(beginning);
    text
}

/// Most numbers have one digit.
fn push_number(text: &mut String, number: u16) {
    match u8::try_from(number) {
        Ok(digit @ 0..=9) => text.push(char::from(b'0'.wrapping_add(digit))),
        _ => text.push_str(&number.to_string()),
    }
}
