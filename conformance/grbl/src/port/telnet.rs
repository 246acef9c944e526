//! Leaves the commands of the telnet protocol out of a stream.

/// Introduces a command.
const COMMAND: u8 = 255;
/// Begins a negotiation, which ends with [`COMMAND`] and [`NEGOTIATION_END`].
const NEGOTIATION: u8 = 250;
const NEGOTIATION_END: u8 = 240;
/// WILL, WONT, DO and DONT: an option follows.
const OPTION_COMMANDS: std::ops::RangeInclusive<u8> = 251..=254;

/// Where in a command the stream is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Place {
    #[default]
    Text,
    Command,
    Option,
    Negotiation,
    CommandInNegotiation,
}

/// Reads a stream that may contain commands, in pieces.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Telnet(Place);

impl Telnet {
    /// The text among these bytes.
    pub(super) fn text(&mut self, bytes: &[u8]) -> Vec<u8> {
        bytes.iter().copied().filter(|byte| self.is_text(*byte)).collect()
    }

    fn is_text(&mut self, byte: u8) -> bool {
        let (next, is_text) = match (self.0, byte) {
            (Place::Text, COMMAND) => (Place::Command, false),
            (Place::Text, _) => (Place::Text, true),
            (Place::Command, NEGOTIATION) => (Place::Negotiation, false),
            (Place::Command, byte) if OPTION_COMMANDS.contains(&byte) => (Place::Option, false),
            // A doubled byte is text.
            (Place::Command, COMMAND) => (Place::Text, true),
            (Place::Command | Place::Option, _) => (Place::Text, false),
            (Place::Negotiation, COMMAND) => (Place::CommandInNegotiation, false),
            (Place::CommandInNegotiation, NEGOTIATION_END) => (Place::Text, false),
            (Place::Negotiation | Place::CommandInNegotiation, _) => (Place::Negotiation, false),
        };
        self.0 = next;
        is_text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_are_left_out_wherever_the_stream_is_cut() {
        let stream = b"ok\xff\xfb\x03\xff\xfa\x18\x01\xff\xf0\r\n\xff\xf1<Idle>\xff\xff";
        for cut in 0..=stream.len() {
            let mut telnet = Telnet::default();
            let mut text = telnet.text(&stream[..cut]);
            text.extend(telnet.text(&stream[cut..]));
            assert_eq!(text, b"ok\r\n<Idle>\xff", "cut at {cut}");
        }
    }
}
