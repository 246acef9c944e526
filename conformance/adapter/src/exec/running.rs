//! A run within a session: told at once, in batches, in a file or by its digest; fed with what an operator does;
//! cancelled when it takes too long.

use gaugeblock_vocabulary::motion::Samples;
use gaugeblock_vocabulary::scenario::OperatorEvent;
use gaugeblock_vocabulary::{Outcome, Scenario, Step};

use super::begun::{Asked, Before};
use super::peer::GRACE;
use super::session::{NoReply, RUN, Session, request, shown, unreadable, unsupported};
use crate::clock::now;
use crate::protocol::digest::digest;
use crate::protocol::{Answer, Offer, Operation, Reply, Stream, Ways};
use crate::{Expected, HarnessError, Motion, NotMoved};

/// How many batches may come before the referee has looked at them.
const CREDIT: u32 = 8;

/// Why a run has no outcome, and whether the session can go on.
#[derive(Debug)]
pub(super) struct Stopped {
    pub(super) error: HarnessError,
    pub(super) goes_on: bool,
}

impl From<HarnessError> for Stopped {
    fn from(error: HarnessError) -> Self {
        Self { error, goes_on: false }
    }
}

impl Session {
    /// Runs a scenario. `expected` is what the specification says, where somebody wants to know: it is found out
    /// while the controller runs, and may save that the outcome is sent.
    pub(super) fn run(
        &mut self,
        scenario: &Scenario,
        expected: Option<&Expected<'_>>,
    ) -> Result<Outcome, Stopped> {
        let line = self.request_to_run(scenario, expected.is_some())?;
        let asked = self.ask_to_run(line);
        self.outcome_of(asked, scenario, expected)
    }

    /// The next request, to run a scenario; `by_digest` where a digest will do for an answer.
    pub(super) fn request_to_run(
        &mut self,
        scenario: &Scenario,
        by_digest: bool,
    ) -> Result<(Vec<u8>, Ways), HarnessError> {
        let digest = by_digest && self.offers(Offer::Digest);
        let stream = (self.offers(Offer::Stream) && !digest).then_some(Stream { credit: CREDIT });
        let (live, at_once) = self.told_of(&scenario.operator);
        let live = live.iter().map(|event| event.when.clone()).collect();
        let ways = Ways { stream, digest, live };
        let line = self.teller.run(self.last + 1, (scenario, at_once), &ways)?;
        Ok((line, ways))
    }

    /// Asks for a run. Its reset has just found that nothing more is said.
    pub(super) fn ask_to_run(&mut self, (line, ways): (Vec<u8>, Ways)) -> Asked {
        self.has_run = true;
        self.last += 1;
        let credit = ways.stream.map_or(0, |stream| stream.credit);
        let before = Before { credit, ..Before::default() };
        Asked { unsent: self.lines.say(&line), by_digest: ways.digest, before }
    }

    /// What comes of a run that was asked for. It has its time from now on: whoever asks early may do something else
    /// meanwhile.
    #[expect(clippy::wildcard_enum_match_arm, reason = "whatever else is answered is amiss")]
    pub(super) fn outcome_of(
        &mut self,
        Asked { unsent, by_digest, before }: Asked,
        scenario: &Scenario,
        expected: Option<&Expected<'_>>,
    ) -> Result<Outcome, Stopped> {
        // It is found out while the controller runs.
        let expected: Option<&Outcome> = expected.map(|expected| &**expected);
        let (live, _) = self.told_of(&scenario.operator);
        let (reply, steps) = self.long((RUN, expected), unsent, live, before)?;
        let mut outcome = match reply {
            Reply::Unsupported(why) => return Ok(unsupported(scenario, why)),
            Reply::Digest(told) if by_digest => self.by_digest(&told, expected)?,
            reply => self.outcome(RUN, reply)?,
        };
        outcome.steps.splice(0..0, steps);
        if outcome.parameters.is_none() && self.can_be_asked_for_parameters() {
            outcome.parameters = self.state()?.parameters;
        }
        Ok(outcome)
    }

    /// What of an operator's script is told while the controller runs, and what at once.
    fn told_of<'a>(
        &self,
        script: &'a [OperatorEvent],
    ) -> (&'a [OperatorEvent], &'a [OperatorEvent]) {
        if self.offers(Offer::LiveOperator) { (script, &[]) } else { (&[], script) }
    }

    /// Servo samples of a run.
    #[expect(clippy::wildcard_enum_match_arm, reason = "whatever else is answered is amiss")]
    pub(super) fn moves(
        &mut self,
        motion: &Motion<'_>,
    ) -> Result<Result<Samples, NotMoved>, Stopped> {
        let asked = Operation::Move {
            scenario: Box::new(motion.scenario.clone()),
            limits: motion.limits.clone(),
            script: motion.script.clone(),
            every: motion.every,
        };
        let line = request(self.last + 1, &asked)?;
        let Asked { unsent, before, .. } = self.ask_to_run((line, Ways::default()));
        let (reply, _) = self.long((asked.name(), None), unsent, &[], before)?;
        let samples = match reply {
            Reply::Unsupported(why) => return Ok(Err(NotMoved::Unsupported(shown(&why)))),
            // It is the controller that has none, and not the session that is broken.
            Reply::Refused(why) => {
                return Ok(Err(NotMoved::Failed(HarnessError::NotRun(shown(&why)))));
            }
            Reply::Samples(text) => Samples::from_csv(&text),
            Reply::File(name) => {
                let bytes = self.file(&name)?;
                match std::str::from_utf8(&bytes) {
                    Ok(text) if text.starts_with('#') => Samples::from_csv(text),
                    Ok(_) | Err(_) => Samples::from_bytes(&bytes),
                }
            }
            reply => return Err(self.amiss(asked.name(), &reply).into()),
        };
        let wrong = |error| unreadable("samples", format!("{error}").as_bytes());
        Ok(Ok(samples.map_err(wrong)?))
    }

    /// The outcome itself, where its digest is not the expected one's.
    fn by_digest(
        &mut self,
        told: &str,
        expected: Option<&Outcome>,
    ) -> Result<Outcome, HarnessError> {
        if let Some(expected) = expected
            && told == digest(expected)
        {
            return Ok(expected.clone());
        }
        let whole = Operation::Outcome {};
        let reply = self.ask(&whole)?;
        self.outcome(whole.name(), reply)
    }

    /// The outcome that a reply is, or names.
    #[expect(clippy::wildcard_enum_match_arm, reason = "whatever else is answered is amiss")]
    fn outcome(&mut self, asked: &str, reply: Reply) -> Result<Outcome, HarnessError> {
        match reply {
            Reply::Outcome(outcome) => Ok(*outcome),
            Reply::File(name) => {
                let bytes = self.file(&name)?;
                serde_json::from_slice(&bytes)
                    .map_err(|error| unreadable(&format!("file of `{asked}`: {error}"), &bytes))
            }
            reply => Err(self.amiss(asked, &reply)),
        }
    }

    /// What a file of the session's folder holds.
    fn file(&self, name: &str) -> Result<Vec<u8>, HarnessError> {
        let folder = self.folder.as_ref().filter(|_| self.offers(Offer::Files));
        let folder = folder.ok_or_else(|| {
            unreadable("it names a file, but has declared none or has no folder", name.as_bytes())
        })?;
        folder
            .take(name, self.limits.whole)
            .map_err(|why| unreadable(&format!("file of its answer: {why}"), name.as_bytes()))
    }

    /// Asks for something that takes time: the answer proper, and the steps that came before it.
    #[expect(clippy::wildcard_enum_match_arm, reason = "any other answer is the answer proper")]
    fn long(
        &mut self,
        (name, expected): (&str, Option<&Outcome>),
        mut line: Vec<u8>,
        events: &[OperatorEvent],
        mut before: Before,
    ) -> Result<(Reply, Vec<Step>), Stopped> {
        let streams = before.credit > 0;
        let deadline = now() + self.limits.time;
        let mut left = self.limits.whole;
        loop {
            let reply = match self.exchange(&line, name, deadline, expected) {
                Ok(reply) => reply,
                Err(NoReply::Late { all_said: true }) => return Err(self.late()),
                Err(no_reply) => return Err(no_reply.into_error(self.limits).into()),
            };
            line.clear();
            match reply {
                Reply::Steps(steps) if streams => {
                    if before.credit == 0 {
                        let what = "it sends more batches than it had credit for";
                        return Err(unreadable(what, b"steps").into());
                    }
                    before.credit -= 1;
                    left = left
                        .checked_sub(self.lines.taken())
                        .ok_or(HarnessError::Flooded { bytes: self.limits.whole })?;
                    before.steps.extend(steps);
                }
                Reply::At(place) if !events.is_empty() => {
                    let event = usize::try_from(place).ok().filter(|place| *place == before.told);
                    let event = event.and_then(|place| events.get(place)).ok_or_else(|| {
                        let what = "it is at a place of the operator that is not the next one";
                        unreadable(what, place.to_string().as_bytes())
                    })?;
                    before.told += 1;
                    line = request(self.last, &Operation::Operator { event: event.clone() })?;
                }
                reply => {
                    if let Some(unasked) = self.lines.left() {
                        return Err(unreadable("it answers more than once", unasked).into());
                    }
                    return Ok((reply, before.steps));
                }
            }
            // There is always one more batch of who does not stop.
            if now() >= deadline {
                return Err(self.late());
            }
            // What has come without credit is looked at first.
            if streams && before.credit == 0 && self.lines.unasked().is_none() {
                before.credit = CREDIT;
                line.extend(request(self.last, &Operation::Credit { batches: CREDIT })?);
            }
        }
    }

    /// A run that takes too long is cancelled, where that can be done.
    fn late(&mut self) -> Stopped {
        let error = NoReply::Late { all_said: true }.into_error(self.limits);
        let goes_on = self.offers(Offer::Cancel) && self.cancel(Vec::new());
        Stopped { error, goes_on }
    }

    /// Says what is still to be said, and ends the run that is going on; whether the session can go on.
    pub(super) fn cancel(&mut self, mut line: Vec<u8>) -> bool {
        let run = self.last;
        self.last += 1;
        let Ok(cancel) = request(self.last, &Operation::Cancel {}) else { return false };
        line.extend(cancel);
        let deadline = now() + self.limits.time.min(4 * GRACE);
        loop {
            let peer = &mut self.peer;
            let answer = self.lines.ask(&line, self.limits.bytes, deadline, || peer.is_gone());
            let Some(answer) = answer.ok().and_then(|line| serde_json::from_slice(&line).ok())
            else {
                return false;
            };
            line.clear();
            match answer {
                // There is always one more line of who does not stop.
                _ if now() >= deadline => return false,
                Answer { id, reply } if id == self.last => return reply == (Reply::Done {}),
                // It was on its way already.
                Answer { id, .. } if id == run => (),
                Answer { .. } => return false,
            }
        }
    }
}
