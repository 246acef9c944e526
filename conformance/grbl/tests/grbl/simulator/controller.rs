//! The protocol: lines, answers, real-time commands, states; and ways to break it.

use super::Device;
use super::toy::Toy;

/// A member of the family.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Member {
    /// Grbl 1.1, which refuses `$#` in check mode.
    Grbl,
    /// grblHAL.
    GrblHal,
}

/// What the controller does once, at a block with the comment `(trip)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Misbehaviour {
    /// It answers nothing until it is reset.
    Silence,
    /// It sends bytes that the protocol does not have.
    Garbage,
    /// It restarts.
    Restart,
    /// It executes the block and does not answer.
    LostOk,
    /// It raises an alarm, and is locked from then on.
    AlarmLock,
    /// It is locked by an alarm that it has not reported.
    LockUnseen,
    /// It sends reports without an end.
    Flood,
}

/// The comment at which a controller misbehaves.
const TRIP: &str = "(trip)";

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Idle,
    Check,
    Alarm,
    Silent,
}

/// A controller of the family.
#[derive(Debug)]
pub(crate) struct Controller {
    member: Member,
    misbehaviour: Option<Misbehaviour>,
    state: State,
    line: Vec<u8>,
    toy: Toy,
    /// Status reports that still say `Run`.
    moving: u32,
}

impl Controller {
    pub(crate) fn new(member: Member) -> Self {
        Self {
            member,
            misbehaviour: None,
            state: State::Idle,
            line: Vec::new(),
            toy: Toy::default(),
            moving: 0,
        }
    }

    /// The same, with one misbehaviour.
    pub(crate) fn that(misbehaviour: Misbehaviour) -> Self {
        Self { misbehaviour: Some(misbehaviour), ..Self::new(Member::Grbl) }
    }

    /// The same, locked when it starts.
    pub(crate) fn locked() -> Self {
        Self { state: State::Alarm, ..Self::new(Member::Grbl) }
    }

    /// The same, with a coordinate system that is not zero: its number from 1, and its X.
    pub(crate) fn with_system(mut self, system: usize, x: f64) -> Self {
        self.toy.systems[system - 1][0] = x;
        self
    }

    fn welcome(&self) -> &'static str {
        match self.member {
            Member::Grbl => "\r\nGrbl 1.1h ['$' for help]",
            Member::GrblHal => "\r\nGrblHAL 1.1f ['$' or '$HELP' for help]",
        }
    }

    fn reset(&mut self) -> String {
        self.line.clear();
        self.toy.reset();
        self.moving = 0;
        let mut text = format!("{}\r\n", self.welcome());
        if self.state == State::Alarm {
            text.push_str("[MSG:'$H'|'$X' to unlock]\r\n");
        } else {
            self.state = State::Idle;
        }
        text
    }

    fn byte(&mut self, byte: u8) -> String {
        match byte {
            0x18 => self.reset(),
            _ if self.state == State::Silent => String::new(),
            b'?' => self.status(),
            b'\n' => {
                let line = String::from_utf8_lossy(&self.line).into_owned();
                self.line.clear();
                self.execute(&line)
            }
            b'\r' | b'!' | b'~' => String::new(),
            byte => {
                self.line.push(byte);
                String::new()
            }
        }
    }

    fn status(&mut self) -> String {
        let state = match self.state {
            State::Idle if self.moving > 0 => "Run",
            State::Idle => "Idle",
            State::Check => "Check",
            State::Alarm | State::Silent => "Alarm",
        };
        self.moving = self.moving.saturating_sub(1);
        let (at, offset) = (list(&self.toy.machine), list(&self.toy.offset()));
        format!("<{state}|MPos:{at}|FS:0,0|WCO:{offset}>\r\n")
    }

    fn execute(&mut self, line: &str) -> String {
        match line.strip_prefix('$') {
            Some(command) => self.command(command),
            None if line.contains(TRIP) && self.misbehaviour.is_some() => self.misbehave(line),
            None => self.block(line),
        }
    }

    fn misbehave(&mut self, line: &str) -> String {
        let Some(misbehaviour) = self.misbehaviour.take() else { return String::new() };
        match misbehaviour {
            Misbehaviour::Silence => {
                self.state = State::Silent;
                String::new()
            }
            Misbehaviour::Garbage => "\u{1}\u{2}oK\u{fffd}[\r\n".to_owned(),
            Misbehaviour::Restart => self.reset(),
            Misbehaviour::LostOk => {
                let _unsent = self.block(line);
                String::new()
            }
            Misbehaviour::AlarmLock => {
                self.state = State::Alarm;
                "ALARM:2\r\n[MSG:Reset to continue]\r\n".to_owned()
            }
            Misbehaviour::LockUnseen => {
                self.state = State::Alarm;
                "error:9\r\n".to_owned()
            }
            Misbehaviour::Flood => "[MSG:again]\r\n".repeat(10_000),
        }
    }

    fn block(&mut self, line: &str) -> String {
        if line.trim().is_empty() {
            return "ok\r\n".to_owned();
        }
        if self.state == State::Alarm {
            return "error:9\r\n".to_owned();
        }
        match self.toy.execute(line, self.state == State::Check) {
            Err(error) => format!("error:{error}\r\n"),
            Ok(is_end) => {
                self.moving = u32::from(self.state == State::Idle);
                let end = if is_end { "[MSG:Pgm End]\r\n" } else { "" };
                format!("{end}ok\r\n")
            }
        }
    }

    fn command(&mut self, command: &str) -> String {
        let text = match command {
            "G" => format!("[GC:{}]\r\n", self.toy.modes(self.member == Member::GrblHal)),
            "I" => self.build(),
            "$" => "$0=10\r\n$10=1\r\n$13=0\r\n$100=250.000\r\n$101=250.000\r\n$102=250.000\r\n"
                .to_owned(),
            "C" if self.state == State::Check => {
                self.state = State::Idle;
                return format!("[MSG:Disabled]\r\nok\r\n{}", self.reset());
            }
            "C" if self.state == State::Idle => {
                self.state = State::Check;
                "[MSG:Enabled]\r\n".to_owned()
            }
            "X" => {
                self.state = State::Idle;
                "[MSG:Caution: Unlocked]\r\n".to_owned()
            }
            "#" if self.state == State::Check && self.member == Member::Grbl => {
                return "error:8\r\n".to_owned();
            }
            "#" => self.offsets(),
            _ => return "error:3\r\n".to_owned(),
        };
        format!("{text}ok\r\n")
    }

    fn build(&self) -> String {
        match self.member {
            Member::Grbl => "[VER:1.1h.20190825:]\r\n[OPT:V,15,128]\r\n".to_owned(),
            Member::GrblHal => {
                "[VER:1.1f.20260818:]\r\n[OPT:VNMSL,100,1024,3,0]\r\n[AXS:3:XYZ]\r\n\
                                [NEWOPT:ENUMS,RT+]\r\n[FIRMWARE:grblHAL]\r\n"
                    .to_owned()
            }
        }
    }

    fn offsets(&self) -> String {
        let mut text = String::new();
        for (number, system) in (54..).zip(&self.toy.systems) {
            text.push_str(&format!("[G{number}:{}]\r\n", list(system)));
        }
        let zero = list(&[0.0; 3]);
        text.push_str(&format!("[G28:{zero}]\r\n[G30:{zero}]\r\n"));
        text.push_str(&format!("[G92:{}]\r\n", list(&self.toy.g92)));
        text.push_str(&format!("[TLO:{:.3}]\r\n[PRB:{zero}:0]\r\n", self.toy.tool_length));
        text
    }
}

impl Device for Controller {
    fn connected(&mut self) -> Vec<u8> {
        Vec::new()
    }

    fn receive(&mut self, bytes: &[u8]) -> Vec<u8> {
        bytes.iter().map(|byte| self.byte(*byte)).collect::<String>().into_bytes()
    }
}

fn list(numbers: &[f64; 3]) -> String {
    let [x, y, z] = numbers;
    format!("{x:.3},{y:.3},{z:.3}")
}
