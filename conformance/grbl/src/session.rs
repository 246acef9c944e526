//! A session with the controller: commands, their answers, resets.

use std::time::{Duration, Instant};

use gaugeblock_adapter::HarnessError;
use gaugeblock_adapter::clock::now;
use gaugeblock_vocabulary::LengthUnit;

use crate::interrupt::Interrupt;
use crate::message::{Message, Status, Welcome};
use crate::modes::Modes;
use crate::port::{Port, Traffic, Transcript, timed_out};
use crate::setup::{Motion, Setup};
use crate::stored::Stored;

/// Resets the controller at once.
const SOFT_RESET: &[u8] = &[0x18];

/// Silence after which a controller that starts counts as quiet.
const QUIET: Duration = Duration::from_millis(500);

/// Silence after which a reset is repeated while the controller starts: a boot loader may have swallowed it.
const RESET_INTERVAL: Duration = Duration::from_millis(1500);

/// Reports in one answer; the longest documented answer has some hundred.
const REPORTS_MAX: usize = 4096;

/// Bytes of the shortest report, with the end of its line.
const REPORT_BYTES_MIN: usize = 6;

/// How often a moving machine is queried.
const STATUS_INTERVAL: Duration = Duration::from_millis(200);

/// How long the controller may take.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// For an answer.
    pub answer: Duration,
    /// To start.
    pub start: Duration,
    /// For the motion of one block.
    pub motion: Duration,
}

impl Default for Limits {
    fn default() -> Self {
        let seconds = Duration::from_secs;
        Self { answer: seconds(5), start: seconds(10), motion: seconds(600) }
    }
}

/// The end of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Answer {
    /// `ok`.
    Accepted,
    /// `error:N`.
    Error(u16),
    /// `ALARM:N`.
    Alarm(u16),
    /// None: the program has paused.
    Paused,
}

/// An answer and the reports before its end.
#[derive(Clone, Debug)]
pub(crate) struct Exchange {
    /// Names and values, in order.
    pub(crate) reports: Vec<(String, String)>,
    /// The end of the answer.
    pub(crate) answer: Answer,
}

impl Exchange {
    /// The value of a report.
    pub(crate) fn value(&self, name: &str) -> Option<&str> {
        let mut found = self.reports.iter().filter(|(known, _)| known == name);
        found.next().map(|(_, value)| value.as_str())
    }

    /// The end of the answer, or none after a report, which is kept.
    fn take(&mut self, message: Message) -> Result<Option<Answer>, HarnessError> {
        let (name, value) = match message {
            Message::Ok => return Ok(Some(Answer::Accepted)),
            Message::Error(number) => return Ok(Some(Answer::Error(number))),
            Message::Alarm(number) => return Ok(Some(Answer::Alarm(number))),
            Message::Report(name, value) => (name, value),
            Message::Setting(name, value) => (format!("${name}"), value),
            Message::Status(_)
            | Message::StartupLine(_)
            | Message::Welcome(_)
            | Message::Unknown => return Ok(None),
        };
        if self.reports.len() == REPORTS_MAX {
            return Err(flooded());
        }
        self.reports.push((name, value));
        Ok(None)
    }

    /// Whether the message that the program has ended is among the reports.
    pub(crate) fn ends_program(&self) -> bool {
        self.reports.iter().any(|(name, value)| name == "MSG" && value == "Pgm End")
    }
}

/// A connection and what is known of the controller at its end.
#[derive(Debug)]
pub(crate) struct Session {
    port: Port,
    limits: Limits,
    /// Unit of lengths in reports.
    pub(crate) unit: LengthUnit,
    /// Machine position minus work position, as last reported.
    work_offset: Option<Vec<f64>>,
    /// Whether what arrives next may belong to a run that failed.
    is_out_of_step: bool,
}

impl Session {
    /// Connects, and resets the controller until it answers.
    pub(crate) fn open(
        setup: &Setup,
        limits: Limits,
        interrupt: Interrupt,
        transcript: Option<Transcript>,
    ) -> Result<(Self, Welcome), HarnessError> {
        let port = Port::open(&setup.address, limits.start, interrupt, transcript)?;
        let unit = LengthUnit::Millimetre;
        let mut session = Self { port, limits, unit, work_offset: None, is_out_of_step: false };
        let welcome = session.start()?;
        Ok((session, welcome))
    }

    /// Bytes that went over the link so far.
    pub(crate) fn traffic(&self) -> Traffic {
        self.port.traffic()
    }

    /// Whether the connection has ended.
    pub(crate) fn is_closed(&self) -> bool {
        self.port.is_closed()
    }

    /// Notes a failure: the next reset first waits until the link is silent.
    pub(crate) fn fail(&mut self) {
        self.is_out_of_step = true;
    }

    /// Stops everything at once, whatever the controller does.
    pub(crate) fn halt(&mut self) -> Result<(), HarnessError> {
        self.is_out_of_step = true;
        self.port.send(SOFT_RESET, self.limits.answer)
    }

    /// Resets a controller that may still be starting.
    fn start(&mut self) -> Result<Welcome, HarnessError> {
        let mut waited = Duration::ZERO;
        while waited < self.limits.start {
            self.port.send(SOFT_RESET, self.limits.answer)?;
            let wait = RESET_INTERVAL.min(self.limits.start);
            if let Some(welcome) = self.welcome(wait)? {
                // A reset that came late starts it once more.
                self.port.drain(QUIET, self.limits.start)?;
                self.barrier()?;
                return Ok(welcome);
            }
            waited += wait;
        }
        Err(timed_out(self.limits.start))
    }

    /// Resets the controller. It is idle or locked then, and nothing is left to be read.
    pub(crate) fn reset(&mut self) -> Result<(), HarnessError> {
        let silence = if self.is_out_of_step { QUIET } else { Duration::ZERO };
        self.port.drain(silence, self.limits.start)?;
        self.port.send(SOFT_RESET, self.limits.answer)?;
        self.started()
    }

    /// Waits for the end of a reset.
    fn started(&mut self) -> Result<(), HarnessError> {
        self.work_offset = None;
        if self.welcome(self.limits.start)?.is_none() {
            return Err(timed_out(self.limits.start));
        }
        self.barrier()?;
        self.is_out_of_step = false;
        Ok(())
    }

    /// Waits for the welcome line. What comes before it belongs to what was reset, and may be anything.
    fn welcome(&mut self, wait: Duration) -> Result<Option<Welcome>, HarnessError> {
        let deadline = now() + wait;
        while let Some(line) = self.port.line(deadline)? {
            if let Message::Welcome(welcome) = Message::read(&line) {
                return Ok(Some(welcome));
            }
        }
        Ok(None)
    }

    /// Sends an empty line and waits for its answer: everything that was sent before has been answered then.
    fn barrier(&mut self) -> Result<(), HarnessError> {
        self.accepted("").map(|_| ())
    }

    /// Makes a controller that was reset ready for a program: it leaves check mode and, if permitted, its lock.
    pub(crate) fn make_ready(&mut self, unlock: bool) -> Result<(), HarnessError> {
        let mut state = self.status()?.state;
        if state == "Check" {
            self.write("$C")?;
            self.started()?;
            state = self.status()?.state;
        }
        if state == "Alarm" && unlock {
            self.accepted("$X")?;
            state = self.status()?.state;
        }
        match state.as_str() {
            "Idle" => Ok(()),
            "Alarm" => Err(HarnessError::NotRun(
                "the controller is locked by an alarm; hint: home the machine, or permit `$X` with the option `unlock`"
                    .to_owned(),
            )),
            other => Err(HarnessError::NotRun(format!(
                "the controller is not idle after a reset, but in the state {other}"
            ))),
        }
    }

    /// Enters check mode, in which nothing moves.
    pub(crate) fn enter_check_mode(&mut self) -> Result<(), HarnessError> {
        self.accepted("$C")?;
        match self.status()?.state.as_str() {
            "Check" => Ok(()),
            other => Err(HarnessError::NotRun(format!(
                "`$C` does not lead to check mode; the controller is in the state {other}"
            ))),
        }
    }

    /// Sends a command that the controller must accept.
    pub(crate) fn accepted(&mut self, command: &str) -> Result<Exchange, HarnessError> {
        let exchange = self.command(command)?;
        if exchange.answer == Answer::Accepted {
            return Ok(exchange);
        }
        Err(unexpected(command, exchange.answer))
    }

    /// The modes in force.
    pub(crate) fn modes(&mut self) -> Result<Modes, HarnessError> {
        let exchange = self.accepted("$G")?;
        let text = exchange.value("GC").unwrap_or_default();
        Modes::read(text, self.unit).ok_or_else(|| unreadable("modes", text))
    }

    /// The offsets, or none if the controller does not report them in its state.
    pub(crate) fn stored(&mut self) -> Result<Option<Stored>, HarnessError> {
        let exchange = self.command("$#")?;
        match exchange.answer {
            Answer::Accepted => {}
            Answer::Error(_) => return Ok(None),
            Answer::Alarm(_) | Answer::Paused => return Err(unexpected("$#", exchange.answer)),
        }
        let mut stored = Stored::default();
        for (name, value) in &exchange.reports {
            if !stored.take(name, value) && name != "MSG" {
                return Err(unreadable("offsets", &format!("[{name}:{value}]")));
            }
        }
        Ok(Some(stored))
    }

    /// Where the machine is, and in which state the controller is.
    pub(crate) fn status(&mut self) -> Result<Status, HarnessError> {
        let deadline = now() + self.limits.answer;
        self.port.send(b"?", self.limits.answer)?;
        loop {
            let Some(message) = self.message(deadline)? else {
                return Err(timed_out(self.limits.answer));
            };
            if let Message::Status(status) = message {
                return Ok(status);
            }
            if !matches!(message, Message::Report(..)) {
                return Err(unreadable("instead of a status", &format!("{message:?}")));
            }
        }
    }

    /// The work position of a status.
    pub(crate) fn work_position(&self, status: &Status) -> Option<Vec<f64>> {
        if status.work.is_some() {
            return status.work.clone();
        }
        let (machine, offset) = (status.machine.as_ref()?, self.work_offset.as_ref()?);
        Some(machine.iter().zip(offset).map(|(at, offset)| at - offset).collect())
    }

    /// Sends a line and waits for its answer.
    pub(crate) fn command(&mut self, line: &str) -> Result<Exchange, HarnessError> {
        let deadline = now() + self.limits.answer;
        self.write(line)?;
        let mut exchange = Exchange { reports: Vec::new(), answer: Answer::Paused };
        while let Some(message) = self.message(deadline)? {
            if let Some(answer) = exchange.take(message)? {
                exchange.answer = answer;
                return Ok(exchange);
            }
        }
        Err(timed_out(self.limits.answer))
    }

    /// Sends a block, and waits for its answer. With motion, also until the machine has stopped.
    pub(crate) fn block(
        &mut self,
        line: &str,
        dwell: Duration,
        motion: Motion,
    ) -> Result<Exchange, HarnessError> {
        self.check_unrequested()?;
        match motion {
            Motion::Checked => self.command(line),
            Motion::Real => {
                self.write(line)?;
                let exchange = self.answer_of_motion(dwell)?;
                if exchange.answer == Answer::Accepted {
                    self.rest()?;
                }
                Ok(exchange)
            }
        }
    }

    /// Waits for the answer of a block while the machine moves.
    fn answer_of_motion(&mut self, dwell: Duration) -> Result<Exchange, HarnessError> {
        let mut exchange = Exchange { reports: Vec::new(), answer: Answer::Paused };
        let mut is_queried = false;
        let end_of_motion = now() + self.limits.motion;
        let mut silent_since = now();
        let mut idle_since = now();
        while now() < end_of_motion {
            let Some(message) = self.message(now() + STATUS_INTERVAL)? else {
                if is_queried && now() >= silent_since + self.limits.answer {
                    return Err(timed_out(self.limits.answer));
                }
                if !is_queried {
                    self.port.send(b"?", self.limits.answer)?;
                    (is_queried, silent_since) = (true, now());
                }
                continue;
            };
            let Message::Status(status) = message else {
                if let Some(answer) = exchange.take(message)? {
                    exchange.answer = answer;
                    return Ok(exchange);
                }
                continue;
            };
            is_queried = false;
            match status.state.as_str() {
                "Hold" => return Ok(exchange),
                "Run" => idle_since = now(),
                _ if now() >= idle_since + self.limits.answer + dwell => {
                    return Err(timed_out(self.limits.answer + dwell));
                }
                _ => {}
            }
        }
        Err(timed_out(self.limits.motion))
    }

    /// Waits until the machine has stopped.
    pub(crate) fn rest(&mut self) -> Result<Status, HarnessError> {
        let end = now() + self.limits.motion;
        while now() < end {
            let status = self.status()?;
            match status.state.as_str() {
                "Run" => {}
                "Idle" => return Ok(status),
                other => {
                    return Err(HarnessError::NotRun(format!(
                        "the machine has stopped in the state {other}"
                    )));
                }
            }
            if let Some(Message::Alarm(number)) = self.message(now() + STATUS_INTERVAL)? {
                return Err(HarnessError::NotRun(format!("alarm {number} after a block")));
            }
        }
        Err(timed_out(self.limits.motion))
    }

    /// Checks that the controller has not restarted since its last answer: a block would be executed then.
    fn check_unrequested(&mut self) -> Result<(), HarnessError> {
        let at_once = now();
        for _ in 0..REPORTS_MAX {
            let Some(message) = self.message(at_once)? else { return Ok(()) };
            if !matches!(message, Message::Report(..) | Message::Status(_)) {
                return Err(unreadable("an answer to nothing", &format!("{message:?}")));
            }
        }
        Err(flooded())
    }

    fn write(&mut self, line: &str) -> Result<(), HarnessError> {
        self.port.send(format!("{line}\n").as_bytes(), self.limits.answer)
    }

    /// The next line, which has one of the documented forms and does not report a restart.
    fn message(&mut self, deadline: Instant) -> Result<Option<Message>, HarnessError> {
        let Some(line) = self.port.line(deadline)? else { return Ok(None) };
        let message = Message::read(&line);
        if message == Message::Unknown {
            return Err(unreadable("a line of no documented form", &line));
        }
        if matches!(message, Message::Welcome(_)) {
            let status = "the controller restarted".to_owned();
            return Err(HarnessError::Crashed { status, stderr: self.port.recent() });
        }
        if let Message::Status(Status { offset: Some(offset), .. }) = &message {
            self.work_offset = Some(offset.clone());
        }
        Ok(Some(message))
    }
}

fn unexpected(to: &str, answer: Answer) -> HarnessError {
    let answer = match answer {
        Answer::Accepted => "ok".to_owned(),
        Answer::Error(number) => format!("error:{number}"),
        Answer::Alarm(number) => format!("ALARM:{number}"),
        Answer::Paused => "a pause".to_owned(),
    };
    HarnessError::NotRun(format!("the controller answers `{to}` with {answer}; expected ok"))
}

fn unreadable(what: &str, line: &str) -> HarnessError {
    HarnessError::Unreadable { what: what.to_owned(), line: line.to_owned() }
}

fn flooded() -> HarnessError {
    HarnessError::Flooded { bytes: REPORTS_MAX * REPORT_BYTES_MIN }
}
