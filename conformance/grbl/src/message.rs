//! The lines that a controller of the family sends, as its interface document lists them.

/// A line from the controller.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Message {
    /// `ok`: the line before was executed, or is queued.
    Ok,
    /// `error:N`: the line before was refused.
    Error(u16),
    /// `ALARM:N`: the controller has stopped and locked itself.
    Alarm(u16),
    /// The controller has started or restarted.
    Welcome(Welcome),
    /// `<…>`: the answer to `?`.
    Status(Status),
    /// `[NAME:VALUE]`.
    Report(String, String),
    /// `$N=VALUE`: number or name of a setting, and its value.
    Setting(String, String),
    /// `>LINE:ok`: a startup line was executed.
    StartupLine(String),
    /// Anything else.
    Unknown,
}

/// The line with which a controller starts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Welcome {
    /// The program: `Grbl` or `GrblHAL`.
    pub(crate) name: String,
    /// Its version, such as `1.1f`.
    pub(crate) version: String,
}

/// A status report.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Status {
    /// `Idle`, `Run`, `Hold`, `Check`, `Alarm` and so on, without the part after a colon.
    pub(crate) state: String,
    /// Machine position, if reported.
    pub(crate) machine: Option<Vec<f64>>,
    /// Work position, if reported.
    pub(crate) work: Option<Vec<f64>>,
    /// Work coordinate offset, if reported: machine position minus work position.
    pub(crate) offset: Option<Vec<f64>>,
}

impl Message {
    /// Reads a line without its end.
    pub(crate) fn read(line: &str) -> Self {
        if line == "ok" {
            return Self::Ok;
        }
        let number = |text: &str| text.parse::<u16>().ok();
        if let Some(code) = line.strip_prefix("error:") {
            return number(code).map_or(Self::Unknown, Self::Error);
        }
        if let Some(code) = line.strip_prefix("ALARM:") {
            return number(code).map_or(Self::Unknown, Self::Alarm);
        }
        let read = match line.as_bytes().first() {
            Some(b'<') => status(line).map(Self::Status),
            Some(b'[') => report(line),
            Some(b'$') => line[1..]
                .split_once('=')
                .map(|(name, value)| Self::Setting(name.to_owned(), value.to_owned())),
            Some(b'>') => Some(Self::StartupLine(line[1..].to_owned())),
            Some(b'G') => welcome(line).map(Self::Welcome),
            _ => None,
        };
        read.unwrap_or(Self::Unknown)
    }
}

/// `Grbl 1.1f ['$' for help]`, `GrblHAL 1.1f ['$' or '$HELP' for help]`.
fn welcome(line: &str) -> Option<Welcome> {
    let mut words = line.split_whitespace();
    let name = words.next().filter(|name| name.to_lowercase().starts_with("grbl"))?;
    let version = words.next()?;
    let is_welcome = line.ends_with("for help]");
    is_welcome.then(|| Welcome { name: name.to_owned(), version: version.to_owned() })
}

fn report(line: &str) -> Option<Message> {
    let (name, value) = line.strip_prefix('[')?.strip_suffix(']')?.split_once(':')?;
    let is_name =
        !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || ". ".contains(c));
    is_name.then(|| Message::Report(name.to_owned(), value.to_owned()))
}

fn status(line: &str) -> Option<Status> {
    let mut parts = line.strip_prefix('<')?.strip_suffix('>')?.split('|');
    let state = parts.next()?.split(':').next()?.to_owned();
    let is_state = !state.is_empty() && state.chars().all(|c| c.is_ascii_alphabetic());
    let mut status = Status { state: is_state.then_some(state)?, ..Status::default() };
    for part in parts {
        let (name, values) = part.split_once(':')?;
        match name {
            "MPos" => status.machine = Some(numbers(values)?),
            "WPos" => status.work = Some(numbers(values)?),
            "WCO" => status.offset = Some(numbers(values)?),
            _ => {}
        }
    }
    Some(status)
}

/// Numbers that are separated by commas.
pub(crate) fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split(',').map(number).collect()
}

/// A finite number in digits.
pub(crate) fn number(text: &str) -> Option<f64> {
    let is_number = text.bytes().all(|byte| byte.is_ascii_digit() || b".-+".contains(&byte));
    text.parse::<f64>().ok().filter(|number| is_number && number.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn documented_lines_are_read() {
        assert_eq!(Message::read("ok"), Message::Ok);
        assert_eq!(Message::read("error:20"), Message::Error(20));
        assert_eq!(Message::read("ALARM:2"), Message::Alarm(2));
        let welcome = |name: &str| Welcome { name: name.to_owned(), version: "1.1f".to_owned() };
        let started = Message::read("Grbl 1.1f ['$' for help]");
        assert_eq!(started, Message::Welcome(welcome("Grbl")));
        let started = Message::read("GrblHAL 1.1f ['$' or '$HELP' for help]");
        assert_eq!(started, Message::Welcome(welcome("GrblHAL")));
        let message = Message::Report("MSG".to_owned(), "Pgm End".to_owned());
        assert_eq!(Message::read("[MSG:Pgm End]"), message);
        let storage = Message::Report("NVS STORAGE".to_owned(), "*EEPROM".to_owned());
        assert_eq!(Message::read("[NVS STORAGE:*EEPROM]"), storage);
        let setting = Message::Setting("13".to_owned(), "0".to_owned());
        assert_eq!(Message::read("$13=0"), setting);
        assert_eq!(Message::read(">G54G20:ok"), Message::StartupLine("G54G20:ok".to_owned()));
    }

    #[test]
    fn status_has_a_state_and_positions() {
        let line = "<Hold:1|MPos:1.000,-2.500,0.000|FS:0,0|WCO:1.000,0.000,0.000>";
        let Message::Status(status) = Message::read(line) else { panic!("{line}") };
        assert_eq!(status.state, "Hold");
        assert_eq!(status.machine, Some(vec![1.0, -2.5, 0.0]));
        assert_eq!(status.offset, Some(vec![1.0, 0.0, 0.0]));
        assert_eq!(status.work, None);
    }

    #[test]
    fn a_line_of_no_documented_form_is_unknown() {
        for line in [
            "okay",
            "error:",
            "error:x",
            "ALARM:-1",
            "Grbl",
            "Grblish",
            "[MSG",
            "[:x]",
            "<>",
            "<Idle|MPos:nan,0,0>",
            "<Idle|MPos:1,,2>",
            "<Idle|x>",
            "$G",
            "\u{fffd}",
        ] {
            assert_eq!(Message::read(line), Message::Unknown, "{line}");
        }
    }
}
