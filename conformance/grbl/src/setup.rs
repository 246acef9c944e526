//! What the name of a controller says: where it is, and what the adapter may do to it.

use std::path::{Path, PathBuf};

/// Where the controller is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Address {
    /// A serial device or a pseudo-terminal.
    Device(PathBuf),
    /// `HOST:PORT`, at which the controller or its simulator listens.
    Socket(String),
}

/// Whether axes move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// Programs run in check mode (`$C`).
    Checked,
    /// Axes move, the spindle turns, coolant flows.
    Real,
}

/// A controller, and what the adapter may do to it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Setup {
    /// Where it is.
    pub address: Address,
    /// Whether axes move.
    pub motion: Motion,
    /// Whether motion is confirmed in the name of the controller, so that no person at the terminal has to confirm it.
    pub confirmed: bool,
    /// Whether an alarm lock is released with `$X`.
    pub unlock: bool,
    /// Whether programs run that write coordinate systems into the EEPROM, which are restored after each program.
    pub eeprom: bool,
    /// The file that gets what goes over the link, if any.
    pub transcript: Option<PathBuf>,
}

impl Setup {
    /// The options of a name, for messages and help.
    pub const OPTIONS: &str = "motion=real, yes, unlock, eeprom=restore, transcript=FILE";

    /// Reads what follows `grbl:` in the name of a controller: `DEVICE` or `HOST:PORT`, then `?` and options that are
    /// separated by `&`.
    ///
    /// # Errors
    /// What is wrong with it, and what was expected.
    pub fn read(text: &str) -> Result<Self, String> {
        let (place, options) = text.split_once('?').unwrap_or((text, ""));
        let mut setup = Self {
            address: address(place)?,
            motion: Motion::Checked,
            confirmed: false,
            unlock: false,
            eeprom: false,
            transcript: None,
        };
        for option in options.split('&').filter(|option| !option.is_empty()) {
            match option {
                "motion=check" => setup.motion = Motion::Checked,
                "motion=real" => setup.motion = Motion::Real,
                "yes" => setup.confirmed = true,
                "unlock" => setup.unlock = true,
                "eeprom=restore" => setup.eeprom = true,
                _ if option.starts_with("transcript=") => {
                    let name = &option["transcript=".len()..];
                    if name.is_empty() {
                        return Err("missing file: expected transcript=FILE".to_owned());
                    }
                    setup.transcript = Some(PathBuf::from(name));
                }
                _ => {
                    let known = Self::OPTIONS;
                    return Err(format!("invalid option `{option}`: expected one of {known}"));
                }
            }
        }
        Ok(setup)
    }
}

/// A name with a port at its end is a socket, unless it begins like a path.
fn address(place: &str) -> Result<Address, String> {
    let device = || Address::Device(PathBuf::from(place));
    if place.is_empty() {
        return Err("missing address: expected DEVICE or HOST:PORT".to_owned());
    }
    if place.starts_with(['/', '.']) {
        return Ok(device());
    }
    match place.rsplit_once(':') {
        Some((host, port)) if !host.is_empty() && port.parse::<u16>().is_ok() => {
            Ok(Address::Socket(place.to_owned()))
        }
        None if Path::new(place).exists() => Ok(device()),
        _ => Err(format!(
            "invalid address `{place}`: expected DEVICE, such as /dev/ttyUSB0, or HOST:PORT"
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Setup {
        Setup::read(text).unwrap_or_else(|error| panic!("{text}: {error}"))
    }

    #[test]
    fn nothing_is_permitted_unless_it_is_named() {
        let setup = read("/dev/ttyUSB0");
        assert_eq!(setup.address, Address::Device("/dev/ttyUSB0".into()));
        assert_eq!(setup.motion, Motion::Checked);
        assert!(!setup.confirmed && !setup.unlock && !setup.eeprom);
        assert_eq!(setup.transcript, None);
    }

    #[test]
    fn options_follow_a_question_mark() {
        let setup = read("cnc.local:23?motion=real&yes&unlock&eeprom=restore&transcript=a/b.txt");
        assert_eq!(setup.address, Address::Socket("cnc.local:23".to_owned()));
        assert_eq!(setup.motion, Motion::Real);
        assert!(setup.confirmed && setup.unlock && setup.eeprom);
        assert_eq!(setup.transcript, Some("a/b.txt".into()));
    }

    #[test]
    fn wrong_name_is_refused_with_what_was_expected() {
        for (text, words) in [
            ("", "missing address"),
            ("no-such-device", "expected DEVICE"),
            ("host:port", "expected DEVICE"),
            ("/dev/ttyUSB0?motion=fast", "invalid option `motion=fast`"),
        ] {
            let error = Setup::read(text).expect_err(text);
            assert!(error.contains(words), "{text}: {error}");
        }
    }
}
