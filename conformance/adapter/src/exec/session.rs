//! A session: requests and answers by turns, from `hello` to `bye`.

use std::collections::BTreeSet;
use std::time::Instant;

use gaugeblock_vocabulary::{Options, Outcome, Scenario};
use serde::Serialize;

use super::begun::Begun;
use super::limits::Limits;
use super::lines::{Lines, NoLine};
use super::peer::{Door, GRACE, Peer};
use super::side::Folder;
use super::told::Teller;
use crate::HarnessError;
use crate::clock::now;
use crate::protocol::{
    Alike, Answer, Declaration, Offer, Operation, Reply, Standing, VERSION, with_meant,
};

/// Most of a line that is shown to a person.
pub(super) const SHOWN: usize = 200;

/// A controller that was started, or connected to, and has told what it is.
#[derive(Debug)]
pub(super) struct Session {
    pub(super) lines: Lines,
    pub(super) peer: Peer,
    pub(super) limits: Limits,
    pub(super) teller: Teller,
    /// What it may lay answers into, where it runs on this machine.
    pub(super) folder: Option<Folder>,
    offers: BTreeSet<Offer>,
    /// Whether it says that parameters are told at the end.
    tells_parameters: bool,
    /// Id of the last request.
    pub(super) last: u64,
    pub(super) has_run: bool,
    /// What is still to be said of a reset that was asked for and not answered yet, if there is one.
    ahead: Option<Vec<u8>>,
    /// Whether the next run most likely follows, so that it may be set back as soon as it has answered.
    pub(super) has_a_next: bool,
    /// Whether it has failed: it is not waited for any more.
    pub(super) has_failed: bool,
    /// A run that nobody waits for yet, if there is one.
    pub(super) begun: Option<Begun>,
    /// What was in force after the first reset, where it can tell.
    fresh: Option<Box<Standing>>,
    alike: Alike,
}

impl Session {
    /// Opens a door and says hello.
    pub(super) fn begin(door: &Door, limits: Limits) -> Result<(Self, Declaration), HarnessError> {
        let folder = match door {
            Door::Command(_) => Some(
                Folder::make()
                    .map_err(|error| HarnessError::NotRun(format!("a folder: {error}")))?,
            ),
            Door::Address(_) => None,
        };
        let (peer, lines) = door.open(limits)?;
        let mut session = Self {
            lines,
            peer,
            limits: Limits { time: limits.start, ..limits },
            teller: Teller::default(),
            folder,
            offers: BTreeSet::new(),
            tells_parameters: false,
            last: 0,
            has_run: false,
            ahead: None,
            has_a_next: false,
            has_failed: false,
            begun: None,
            fresh: None,
            alike: Alike::default(),
        };
        let referee = format!("gaugeblock {}", env!("CARGO_PKG_VERSION"));
        let folder = session.folder.as_ref();
        let folder = folder.and_then(|folder| folder.path().to_str()).map(str::to_owned);
        let hello = Operation::Hello { protocol: VERSION, referee, folder };
        let reply = session.ask(&hello)?;
        session.limits = limits;
        if let Reply::Hello(declaration) = reply {
            session.offers.clone_from(&declaration.offers);
            session.tells_parameters = declaration.observables.final_parameters;
            return Ok((session, *declaration));
        }
        Err(session.amiss(hello.name(), &reply))
    }

    /// Whether it can do something that not each adapter can.
    pub(super) fn offers(&self, offer: Offer) -> bool {
        self.offers.contains(&offer)
    }

    /// Scenarios are told without these options.
    pub(super) fn assume(&mut self, assumed: &Options) {
        self.teller = Teller::new(assumed.clone());
    }

    /// Whether a scenario has been run.
    pub(super) fn has_run(&self) -> bool {
        self.has_run
    }

    /// Makes no more use of other offers than these.
    pub(super) fn keep_to(&mut self, offers: &[Offer]) {
        self.offers.retain(|offer| offers.contains(offer));
    }

    /// Whether parameters at the end can be had apart from the outcome.
    pub(super) fn can_be_asked_for_parameters(&self) -> bool {
        self.tells_parameters && self.offers(Offer::State)
    }

    /// Whether the next run sets the controller back by itself, and nobody asks what is in force before.
    fn is_set_back_by_running(&self) -> bool {
        self.has_run && self.offers(Offer::Fresh) && !self.offers(Offer::State)
    }

    /// Asks for a reset whose answer [`Session::reset`] takes: the controller is set back while something else is
    /// done here.
    pub(super) fn reset_ahead(&mut self) {
        if self.is_set_back_by_running() {
            return;
        }
        // Whoever has said more than it was asked for is found out by the reset itself.
        if self.ahead.is_none() && self.lines.left().is_none() {
            self.last += 1;
            self.ahead = Some(self.lines.say(&reset(self.last)));
        }
    }

    /// Sets the controller back. What it tells to be in force then has to be what was in force after the first reset.
    pub(super) fn reset(&mut self) -> Result<(), HarnessError> {
        if self.is_set_back_by_running() {
            return self.is_there_and_silent();
        }
        let unsent = match self.ahead.take() {
            Some(unsent) => unsent,
            None => {
                self.begin_to_ask()?;
                reset(self.last)
            }
        };
        let deadline = now() + self.limits.time;
        let reply = self.exchange(&unsent, RESET, deadline, None);
        let reply = reply.map_err(|late| late.into_error(self.limits))?;
        if reply != (Reply::Done {}) {
            return Err(self.amiss(RESET, &reply));
        }
        // It may be long ago that it answered.
        self.is_there_and_silent()?;
        if self.offers(Offer::State) {
            let standing = self.state()?;
            let fresh = self.fresh.get_or_insert_with(|| standing.clone());
            if *fresh != standing {
                let what = "after `reset` something else is in force than after the first one";
                return Err(unreadable(what, told(fresh, &standing).as_bytes()));
            }
        }
        Ok(())
    }

    /// What it tells to be in force.
    pub(super) fn state(&mut self) -> Result<Box<Standing>, HarnessError> {
        let state = Operation::State {};
        let reply = self.ask(&state)?;
        if let Reply::State(standing) = reply {
            return Ok(standing);
        }
        Err(self.amiss(state.name(), &reply))
    }

    pub(super) fn ask(&mut self, operation: &Operation) -> Result<Reply, HarnessError> {
        let line = request(self.last + 1, operation)?;
        self.ask_line(&line, operation.name())
    }

    pub(super) fn ask_line(&mut self, line: &[u8], name: &str) -> Result<Reply, HarnessError> {
        self.begin_to_ask()?;
        let deadline = now() + self.limits.time;
        self.exchange(line, name, deadline, None).map_err(|late| late.into_error(self.limits))
    }

    /// A new request is about to be made: its id is the next one.
    pub(super) fn begin_to_ask(&mut self) -> Result<(), HarnessError> {
        self.is_silent()?;
        self.last += 1;
        Ok(())
    }

    /// It has neither ended nor said anything that it was not asked for.
    fn is_there_and_silent(&mut self) -> Result<(), HarnessError> {
        self.is_silent()?;
        if self.lines.has_ended() { Err(self.ended(RESET)) } else { Ok(()) }
    }

    /// It has said nothing that it was not asked for.
    fn is_silent(&mut self) -> Result<(), HarnessError> {
        let unasked = self.lines.unasked();
        unasked.map_or(Ok(()), |line| Err(unreadable("it speaks without being asked", line)))
    }

    /// Writes what is to be said, if anything, and reads an answer to the last request; of a run, perhaps this
    /// outcome is expected.
    pub(super) fn exchange(
        &mut self,
        line: &[u8],
        name: &str,
        deadline: Instant,
        expected: Option<&Outcome>,
    ) -> Result<Reply, NoReply> {
        let peer = &mut self.peer;
        let answer = match self.lines.ask(line, self.limits.bytes, deadline, || peer.is_gone()) {
            Ok(answer) => answer,
            Err(NoLine::Ended) => return Err(NoReply::Other(self.ended(name))),
            Err(NoLine::Late(all_said)) => return Err(NoReply::Late { all_said }),
            Err(NoLine::TooLong) => {
                return Err(NoReply::Other(HarnessError::Flooded { bytes: self.limits.bytes }));
            }
        };
        let asked = self.last;
        if name == RUN && self.is_answered_at_once() {
            // It is set back while its answer is read here.
            self.reset_ahead();
        }
        let read = if name == RUN {
            self.alike.read(&answer, expected.map(|outcome| (asked, outcome)))
        } else {
            serde_json::from_slice::<Answer>(&answer)
        };
        let answer = read.map_err(|error| {
            let error = with_meant(&error.to_string());
            NoReply::Other(unreadable(&format!("answer to `{name}`: {error}"), &answer))
        })?;
        if answer.id != asked {
            let what = format!("answer to request {}, not to {asked}", answer.id);
            return Err(NoReply::Other(unreadable(&what, answer.reply.name().as_bytes())));
        }
        Ok(answer.reply)
    }

    /// Whether nothing but a reset comes behind the first answer to a run.
    fn is_answered_at_once(&self) -> bool {
        let has_no_more =
            |offer: &Offer| matches!(offer, Offer::Cancel | Offer::Fresh | Offer::Motion);
        self.has_a_next && self.offers.iter().all(has_no_more)
    }

    /// Its output ended before it answered.
    fn ended(&mut self, name: &str) -> HarnessError {
        let status = self.peer.ended();
        let stderr = self.lines.errors();
        HarnessError::Crashed { status: format!("{status}, asked to `{name}`"), stderr }
    }

    /// An answer that does not belong to what was asked.
    pub(super) fn amiss(&mut self, asked: &str, reply: &Reply) -> HarnessError {
        if let Reply::Refused(why) = reply {
            return HarnessError::NotRun(format!("the adapter refuses `{asked}`: {}", shown(why)));
        }
        let what = format!("`{}` answered with `{}`", asked, reply.name());
        HarnessError::Unreadable { what, line: self.lines.errors() }
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        if self.let_run_end().is_err_and(|stopped| !stopped.goes_on) {
            return;
        }
        // Whatever it answers, it had its chance to end by itself.
        let ahead = self.ahead.take();
        let Ok(bye) = request(self.last + 1, &Operation::Bye {}) else { return };
        if self.peer.is_gone() {
            return;
        }
        let (line, peer) = ([ahead.clone().unwrap_or_default(), bye].concat(), &mut self.peer);
        let mut answered = true;
        if ahead.is_some() {
            let time = if self.has_failed { GRACE } else { self.limits.time };
            answered = self.lines.ask(&line, SHOWN, now() + time, || peer.is_gone()).is_ok();
        }
        let line = if ahead.is_some() { &[] } else { line.as_slice() };
        if answered && self.lines.ask(line, SHOWN, now() + GRACE, || false).is_ok() {
            peer.let_end();
        }
    }
}

/// Why there is no reply.
#[derive(Debug)]
pub(super) enum NoReply {
    /// Not in time; whether all that was to be said could be written.
    Late { all_said: bool },
    /// Something that no session survives.
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

/// Name of the operation.
pub(super) const RUN: &str = "run";

/// Name of the operation.
const RESET: &str = "reset";

/// The request to be as after power-on.
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

/// The first member in which what is in force differs.
fn told(fresh: &Standing, now: &Standing) -> String {
    let lines = |standing: &Standing| {
        serde_json::to_string(standing).unwrap_or_default().replace(",\"", "\n\"")
    };
    let (fresh, now) = (lines(fresh), lines(now));
    let other = now.lines().zip(fresh.lines()).find(|(now, fresh)| now != fresh);
    other.map(|(now, fresh)| format!("{now}, not {fresh}")).unwrap_or(now)
}

pub(super) fn unreadable(what: &str, line: &[u8]) -> HarnessError {
    HarnessError::Unreadable { what: shown(what), line: shown(&String::from_utf8_lossy(line)) }
}

/// As much of a controller's text as a person reads, in one line and without what a terminal would obey.
pub(super) fn shown(text: &str) -> String {
    let plain = text.chars().map(|c| if c.is_control() { ' ' } else { c });
    let mut shown: String = plain.clone().take(SHOWN).collect();
    if plain.count() > SHOWN {
        shown.push('…');
    }
    shown
}
