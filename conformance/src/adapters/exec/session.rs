//! A session: requests and answers by turns, from `hello` to `bye`.

use std::io::pipe;
use std::time::Duration;

use gaugeblock_trace::{Options, Outcome, Scenario};
use serde::Serialize;

use super::lines::{Lines, NoLine};
use super::process::{Process, now};
use super::told::Teller;
use super::{HarnessError, Limits};
use crate::protocol::{Answer, Declaration, Operation, Reply, VERSION};

/// How long a controller may take to end once its output has, or once it was told to.
const GRACE: Duration = Duration::from_millis(500);

/// Most of a line that is shown to a person.
const SHOWN: usize = 200;

/// A controller that was started and has told what it is.
#[derive(Debug)]
pub(super) struct Session {
    lines: Lines,
    process: Process,
    limits: Limits,
    teller: Teller,
    /// Id of the last request.
    last: u64,
    has_run: bool,
}

impl Session {
    /// Starts the command and says hello.
    pub(super) fn begin(
        command: &str,
        limits: Limits,
    ) -> Result<(Self, Declaration), HarnessError> {
        let not_run = |error: std::io::Error| HarnessError::NotRun(error.to_string());
        let (input, our_input) = pipe().map_err(not_run)?;
        let (our_output, output) = pipe().map_err(not_run)?;
        let (our_errors, errors) = pipe().map_err(not_run)?;
        let process = Process::start(command, (input, output, errors), limits).map_err(not_run)?;
        let lines = Lines::new(our_input, our_output, our_errors)?;
        let teller = Teller::default();
        let mut session = Self { lines, process, limits, teller, last: 0, has_run: false };
        let referee = format!("gaugeblock {}", env!("CARGO_PKG_VERSION"));
        let hello = Operation::Hello { protocol: VERSION, referee };
        let reply = session.ask(&hello)?;
        if let Reply::Hello(declaration) = reply {
            return Ok((session, *declaration));
        }
        Err(session.amiss(hello.name(), &reply))
    }

    /// Scenarios are told without these options.
    pub(super) fn assume(&mut self, assumed: &Options) {
        self.teller = Teller::new(assumed.clone());
    }

    /// Whether a scenario has been run.
    pub(super) fn has_run(&self) -> bool {
        self.has_run
    }

    /// Sets the controller back.
    pub(super) fn reset(&mut self) -> Result<(), HarnessError> {
        let reset = Operation::Reset {};
        let reply = self.ask(&reset)?;
        if reply == (Reply::Done {}) { Ok(()) } else { Err(self.amiss(reset.name(), &reply)) }
    }

    /// Runs a scenario. After an error the session is of no use any more.
    pub(super) fn run(&mut self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        self.has_run = true;
        let line = self.teller.run(self.last + 1, scenario)?;
        let reply = self.ask_line(&line, "run")?;
        if let Some(unasked) = self.lines.unasked() {
            return Err(unreadable("it answers more than once", unasked));
        }
        match reply {
            Reply::Outcome(outcome) => Ok(*outcome),
            Reply::Unsupported(why) => Ok(unsupported(scenario, why)),
            Reply::Hello(_) | Reply::Done {} | Reply::Refused(_) => Err(self.amiss("run", &reply)),
        }
    }

    /// Asks for an operation that no version has, then for a reset.
    pub(super) fn ask_the_unknown(&mut self) -> Result<(), HarnessError> {
        let line =
            format!("{{\"id\":{},\"op\":\"gaugeblock-unknown\",\"later\":[1]}}\n", self.last + 1);
        let reply = self.ask_line(line.as_bytes(), "gaugeblock-unknown")?;
        if !matches!(reply, Reply::Refused(_)) {
            let what = format!("answered with `{}`", reply.name());
            return Err(HarnessError::Unreadable { what, line: String::new() });
        }
        self.reset()
    }

    fn ask(&mut self, operation: &Operation) -> Result<Reply, HarnessError> {
        let line = request(self.last + 1, operation)?;
        self.ask_line(&line, operation.name())
    }

    fn ask_line(&mut self, line: &[u8], name: &str) -> Result<Reply, HarnessError> {
        if let Some(unasked) = self.lines.unasked() {
            return Err(unreadable("it speaks without being asked", unasked));
        }
        self.last += 1;
        let deadline = now() + self.limits.time;
        let process = &mut self.process;
        let is_gone = || process.ends_within(Duration::ZERO).is_some();
        let answer = match self.lines.ask(line, self.limits.bytes, deadline, is_gone) {
            Ok(answer) => answer,
            Err(NoLine::Ended) => return Err(self.ended(name)),
            Err(NoLine::Late) => {
                return Err(HarnessError::TimedOut { seconds: self.limits.time.as_secs() });
            }
            Err(NoLine::TooLong) => {
                return Err(HarnessError::Flooded { bytes: self.limits.bytes });
            }
        };
        let answer: Answer = serde_json::from_slice(&answer)
            .map_err(|error| unreadable(&format!("answer to `{name}`: {error}"), &answer))?;
        if answer.id != self.last {
            let what = format!("answer to request {}, not to {}", answer.id, self.last);
            return Err(unreadable(&what, answer.reply.name().as_bytes()));
        }
        Ok(answer.reply)
    }

    /// Its output ended before it answered.
    fn ended(&mut self, name: &str) -> HarnessError {
        let status = self.process.ends_within(GRACE);
        let status = status.unwrap_or_else(|| "its output ended, and it runs on".to_owned());
        let stderr = self.lines.errors();
        HarnessError::Crashed { status: format!("{status}, asked to `{name}`"), stderr }
    }

    /// An answer that does not belong to what was asked.
    fn amiss(&mut self, asked: &str, reply: &Reply) -> HarnessError {
        match reply {
            Reply::Refused(why) => {
                HarnessError::NotRun(format!("the adapter refuses `{}`: {}", asked, shown(why)))
            }
            Reply::Hello(_) | Reply::Done {} | Reply::Outcome(_) | Reply::Unsupported(_) => {
                let what = format!("`{}` answered with `{}`", asked, reply.name());
                HarnessError::Unreadable { what, line: self.lines.errors() }
            }
        }
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        // Whatever it answers, it had its chance to end by itself.
        let asked = self.last;
        if let Ok(line) = request(asked + 1, &Operation::Bye {})
            && self.process.ends_within(Duration::ZERO).is_none()
        {
            let deadline = now() + GRACE;
            let answered = self.lines.ask(&line, SHOWN, deadline, || false);
            if answered.is_ok() {
                let _status = self.process.ends_within(GRACE);
            }
        }
    }
}

/// A request as a line.
fn request(id: u64, operation: &Operation) -> Result<Vec<u8>, HarnessError> {
    #[derive(Serialize)]
    struct Line<'a> {
        id: u64,
        #[serde(flatten)]
        operation: &'a Operation,
    }
    let mut line = serde_json::to_vec(&Line { id, operation })
        .map_err(|error| HarnessError::NotRun(error.to_string()))?;
    line.push(b'\n');
    Ok(line)
}

/// The outcome of a scenario that the controller did not run.
fn unsupported(scenario: &Scenario, why: String) -> Outcome {
    use gaugeblock_trace::{Block, End, Program, Settings};
    Outcome {
        language: scenario.program.language,
        start: Settings::default(),
        steps: Vec::new(),
        end: End::Unsupported { block: Block::new(Program::MAIN, 1), what: shown(&why) },
        parameters: None,
        pins: Vec::new(),
        samples: Vec::new(),
    }
}

fn unreadable(what: &str, line: &[u8]) -> HarnessError {
    HarnessError::Unreadable { what: shown(what), line: shown(&String::from_utf8_lossy(line)) }
}

/// As much of a controller's text as a person reads, in one line and without what a terminal would obey.
fn shown(text: &str) -> String {
    let plain = text.chars().map(|c| if c.is_control() { ' ' } else { c });
    let mut shown: String = plain.clone().take(SHOWN).collect();
    if plain.count() > SHOWN {
        shown.push('…');
    }
    shown
}
