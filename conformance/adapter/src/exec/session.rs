//! A session: requests and answers in turn, from `hello` to `bye`.

use std::collections::BTreeSet;
use std::time::Instant;

use gaugeblock_vocabulary::{Options, Outcome, Scenario};
use serde::Serialize;

use super::connection::{Connection, Endpoint, GRACE};
use super::exchange_folder::ExchangeFolder;
use super::limits::Limits;
use super::lines::{Lines, ReadLineError};
use super::pending_run::PrefetchedRun;
use super::scenario_encoder::ScenarioEncoder;
use crate::HarnessError;
use crate::clock::now;
use crate::protocol::{
    Answer, AnswerReader, ControllerState, Declaration, Extension, Operation, Reply, VERSION,
    read_json, with_suggestion,
};

/// Bytes of a line that a message quotes.
pub(super) const LINE_EXCERPT_BYTES: usize = 200;

/// A session with a controller that has declared itself.
#[derive(Debug)]
pub(super) struct Session {
    pub(super) lines: Lines,
    pub(super) peer: Connection,
    pub(super) limits: Limits,
    pub(super) encoder: ScenarioEncoder,
    /// Folder for answers in files, if the controller runs on this machine.
    pub(super) folder: Option<ExchangeFolder>,
    extensions: BTreeSet<Extension>,
    /// Whether it declares that it reports parameters at the end.
    reports_parameters: bool,
    /// Id of the last request.
    pub(super) last: u64,
    pub(super) has_run: bool,
    /// The unwritten part of a reset whose answer is still to come.
    pending_reset: Option<Vec<u8>>,
    /// Whether another run most likely follows, so that a reset may be sent right after the answer.
    pub(super) expects_another_run: bool,
    /// Whether it has failed. It then gets less time to exit.
    pub(super) has_failed: bool,
    /// The prefetched run, if there is one.
    pub(super) prefetched: Option<PrefetchedRun>,
    /// The state after the first reset, if the adapter reports it.
    reset_state: Option<Box<ControllerState>>,
    answers: AnswerReader,
}

impl Session {
    /// Connects and exchanges `hello`.
    pub(super) fn open(
        endpoint: &Endpoint,
        limits: Limits,
    ) -> Result<(Self, Declaration), HarnessError> {
        let folder = match endpoint {
            Endpoint::Command(_) => Some(
                ExchangeFolder::make()
                    .map_err(|error| HarnessError::NotRun(format!("a folder: {error}")))?,
            ),
            Endpoint::Address(_) => None,
        };
        let (peer, lines) = endpoint.open(limits)?;
        let mut session = Self {
            lines,
            peer,
            limits: Limits { time: limits.start, ..limits },
            encoder: ScenarioEncoder::default(),
            folder,
            extensions: BTreeSet::new(),
            reports_parameters: false,
            last: 0,
            has_run: false,
            pending_reset: None,
            expects_another_run: false,
            has_failed: false,
            prefetched: None,
            reset_state: None,
            answers: AnswerReader::default(),
        };
        let referee = format!("gaugeblock {}", env!("CARGO_PKG_VERSION"));
        let folder = session.folder.as_ref();
        let folder = folder.and_then(|folder| folder.path().to_str()).map(str::to_owned);
        let hello = Operation::Hello { protocol: VERSION, referee, folder };
        let reply = session.request(&hello)?;
        session.limits = limits;
        if let Reply::Hello(declaration) = reply {
            session.extensions.clone_from(&declaration.offers);
            session.reports_parameters = declaration.observables.final_parameters;
            return Ok((session, *declaration));
        }
        Err(session.unexpected_reply(hello.name(), &reply))
    }

    /// Whether the adapter declares an extension.
    pub(super) fn has_extension(&self, extension: Extension) -> bool {
        self.extensions.contains(&extension)
    }

    /// Leaves these options out of requests.
    pub(super) fn assume_options(&mut self, assumed: &Options) {
        self.encoder = ScenarioEncoder::new(assumed.clone());
    }

    /// Whether a scenario has been run.
    pub(super) fn has_run(&self) -> bool {
        self.has_run
    }

    /// Uses no extensions except these.
    pub(super) fn restrict_extensions(&mut self, offers: &[Extension]) {
        self.extensions.retain(|extension| offers.contains(extension));
    }

    /// Whether final parameters can be queried apart from the outcome.
    pub(super) fn can_query_parameters(&self) -> bool {
        self.reports_parameters && self.has_extension(Extension::State)
    }

    /// Whether the next run resets the controller, and no state is queried before.
    fn resets_on_run(&self) -> bool {
        self.has_run
            && self.has_extension(Extension::Fresh)
            && !self.has_extension(Extension::State)
    }

    /// Sends a reset whose answer [`Session::reset`] reads, so that the controller resets while the referee works.
    pub(super) fn send_reset(&mut self) {
        if self.resets_on_run() {
            return;
        }
        // Surplus output is found by the reset itself.
        if self.pending_reset.is_none() && self.lines.surplus().is_none() {
            self.last += 1;
            self.pending_reset = Some(self.lines.write_line(&reset(self.last)));
        }
    }

    /// Resets the controller. The state that it reports then has to equal the state after the first reset.
    pub(super) fn reset(&mut self) -> Result<(), HarnessError> {
        if self.resets_on_run() {
            return self.check_alive_and_silent();
        }
        let unsent = match self.pending_reset.take() {
            Some(unsent) => unsent,
            None => {
                self.begin_request()?;
                reset(self.last)
            }
        };
        let deadline = now() + self.limits.time;
        let reply = self.exchange(&unsent, RESET, deadline, None);
        let reply = reply.map_err(|late| late.into_error(self.limits))?;
        if reply != (Reply::Done {}) {
            return Err(self.unexpected_reply(RESET, &reply));
        }
        // The answer may have arrived long ago.
        self.check_alive_and_silent()?;
        if self.has_extension(Extension::State) {
            let state = self.state()?;
            let fresh = self.reset_state.get_or_insert_with(|| state.clone());
            if *fresh != state
                && let Some(difference) = first_difference(fresh, &state)
            {
                let what = "after `reset` the state differs from that after the first `reset`";
                return Err(unreadable(what, difference.as_bytes()));
            }
        }
        Ok(())
    }

    /// The state that it reports.
    pub(super) fn state(&mut self) -> Result<Box<ControllerState>, HarnessError> {
        let state = Operation::State {};
        let reply = self.request(&state)?;
        if let Reply::State(state) = reply {
            return Ok(state);
        }
        Err(self.unexpected_reply(state.name(), &reply))
    }

    pub(super) fn request(&mut self, operation: &Operation) -> Result<Reply, HarnessError> {
        let line = request(self.last + 1, operation)?;
        self.request_line(&line, operation.name())
    }

    pub(super) fn request_line(&mut self, line: &[u8], name: &str) -> Result<Reply, HarnessError> {
        self.begin_request()?;
        let deadline = now() + self.limits.time;
        self.exchange(line, name, deadline, None).map_err(|late| late.into_error(self.limits))
    }

    /// Begins a new request: its id is the next one.
    pub(super) fn begin_request(&mut self) -> Result<(), HarnessError> {
        self.check_silent()?;
        self.last += 1;
        Ok(())
    }

    /// Fails if the controller has ended or has written without a request.
    fn check_alive_and_silent(&mut self) -> Result<(), HarnessError> {
        self.check_silent()?;
        if self.lines.has_ended() { Err(self.ended_error(RESET)) } else { Ok(()) }
    }

    /// Fails if the controller has written without a request.
    fn check_silent(&mut self) -> Result<(), HarnessError> {
        let unasked = self.lines.unrequested();
        unasked.map_or(Ok(()), |line| Err(unreadable("it wrote a line without a request", line)))
    }

    /// Writes a request, which may be empty, and reads the answer to the last one. `expected` is the outcome that a run
    /// should have.
    pub(super) fn exchange(
        &mut self,
        line: &[u8],
        name: &str,
        deadline: Instant,
        expected: Option<&Outcome>,
    ) -> Result<Reply, NoReply> {
        let peer = &mut self.peer;
        let answer = match self.lines.exchange(line, self.limits.bytes, deadline, || peer.is_gone())
        {
            Ok(answer) => answer,
            Err(ReadLineError::Ended) => return Err(NoReply::Other(self.ended_error(name))),
            Err(ReadLineError::Late(all_said)) => return Err(NoReply::Late { all_said }),
            Err(ReadLineError::TooLong) => {
                return Err(NoReply::Other(HarnessError::Flooded { bytes: self.limits.bytes }));
            }
        };
        self.limits.check_objects(&answer).map_err(|why| {
            NoReply::Other(unreadable(&format!("answer to `{name}`: {why}"), &answer))
        })?;
        let sent = self.last;
        if name == RUN && self.has_single_answer() {
            // The controller resets while its answer is parsed here.
            self.send_reset();
        }
        let read = if name == RUN {
            self.answers.read(&answer, expected.map(|outcome| (sent, outcome)))
        } else {
            read_json::<Answer>(&answer)
        };
        let answer = read.map_err(|error| {
            let error = with_suggestion(&error.to_string());
            NoReply::Other(unreadable(&format!("answer to `{name}`: {error}"), &answer))
        })?;
        if answer.id != sent {
            let what = format!("answer to request {}; expected one to {sent}", answer.id);
            return Err(NoReply::Other(unreadable(&what, answer.reply.name().as_bytes())));
        }
        Ok(answer.reply)
    }

    /// Whether only a reset can follow the first answer to a run.
    fn has_single_answer(&self) -> bool {
        let has_no_more = |extension: &Extension| {
            matches!(extension, Extension::Cancel | Extension::Fresh | Extension::Motion)
        };
        self.expects_another_run && self.extensions.iter().all(has_no_more)
    }

    /// The error for an output that ended before the answer.
    fn ended_error(&mut self, name: &str) -> HarnessError {
        let status = self.peer.describe_end();
        let stderr = self.lines.stderr_tail();
        HarnessError::Crashed { status: format!("{status}, after the request `{name}`"), stderr }
    }

    /// The error for a reply that does not belong to the request.
    pub(super) fn unexpected_reply(&mut self, operation: &str, reply: &Reply) -> HarnessError {
        if let Reply::Refused(why) = reply {
            return HarnessError::NotRun(format!(
                "the adapter refuses `{operation}`: {}",
                shown(why)
            ));
        }
        let what = format!("`{}` answered with `{}`", operation, reply.name());
        HarnessError::Unreadable { what, line: self.lines.stderr_tail() }
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        if self.finish_prefetched().is_err_and(|stopped| !stopped.session_usable) {
            return;
        }
        // Whatever the answer is, it had the chance to exit.
        let ahead = self.pending_reset.take();
        let Ok(bye) = request(self.last + 1, &Operation::Bye {}) else { return };
        if self.peer.is_gone() {
            return;
        }
        let (line, peer) = ([ahead.clone().unwrap_or_default(), bye].concat(), &mut self.peer);
        let mut answered = true;
        if ahead.is_some() {
            let time = if self.has_failed { GRACE } else { self.limits.time };
            answered = self
                .lines
                .exchange(&line, LINE_EXCERPT_BYTES, now() + time, || peer.is_gone())
                .is_ok();
        }
        let line = if ahead.is_some() { &[] } else { line.as_slice() };
        if answered
            && self.lines.exchange(line, LINE_EXCERPT_BYTES, now() + GRACE, || false).is_ok()
        {
            peer.wait_for_end();
        }
    }
}

/// Why there is no reply.
#[derive(Debug)]
pub(super) enum NoReply {
    /// Not in time. The flag says whether the request was written completely.
    Late { all_said: bool },
    /// An error that ends the session.
    Other(HarnessError),
}

impl NoReply {
    pub(super) fn into_error(self, limits: Limits) -> HarnessError {
        match self {
            Self::Late { .. } => HarnessError::TimedOut { seconds: limits.time.as_secs() },
            Self::Other(error) => error,
        }
    }
}

pub(super) const RUN: &str = "run";

const RESET: &str = "reset";

/// A reset request as a line.
fn reset(id: u64) -> Vec<u8> {
    format!("{{\"id\":{id},\"op\":\"{RESET}\"}}\n").into_bytes()
}

/// A request as a line.
pub(super) fn request(id: u64, operation: &Operation) -> Result<Vec<u8>, HarnessError> {
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
pub(super) fn unsupported(scenario: &Scenario, why: String) -> Outcome {
    use gaugeblock_vocabulary::{BlockLocation, End, Program, Settings};
    Outcome {
        language: scenario.program.language,
        start: Settings::default(),
        steps: Vec::new(),
        end: End::Unsupported { block: BlockLocation::new(Program::MAIN, 1), what: shown(&why) },
        parameters: None,
        pins: Vec::new(),
        samples: Vec::new(),
    }
}

/// The first member in which two states differ. A number that is not a number does not differ from itself.
fn first_difference(fresh: &ControllerState, now: &ControllerState) -> Option<String> {
    let lines = |state: &ControllerState| {
        serde_json::to_string(state).unwrap_or_default().replace(",\"", "\n\"")
    };
    let (fresh, now) = (lines(fresh), lines(now));
    let other = now.lines().zip(fresh.lines()).find(|(now, fresh)| now != fresh);
    let first = other.map(|(now, fresh)| format!("{now}, not {fresh}"));
    first.or_else(|| (now != fresh).then_some(now))
}

pub(super) fn unreadable(what: &str, line: &[u8]) -> HarnessError {
    HarnessError::Unreadable { what: shown(what), line: shown(&String::from_utf8_lossy(line)) }
}

/// An excerpt of a controller's text for a message: one line, with terminal control sequences escaped.
pub(super) fn shown(text: &str) -> String {
    let plain = text.chars().map(|c| if c.is_control() { ' ' } else { c });
    let mut shown: String = plain.clone().take(LINE_EXCERPT_BYTES).collect();
    if plain.count() > LINE_EXCERPT_BYTES {
        shown.push('…');
    }
    shown
}
