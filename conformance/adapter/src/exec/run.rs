//! A run within a session. Its answer comes as one line, in batches, in a file or as a digest. Operator's events are
//! sent while it runs, and a run that takes too long is cancelled.

use gaugeblock_vocabulary::motion::Samples;
use gaugeblock_vocabulary::scenario::OperatorEvent;
use gaugeblock_vocabulary::{Outcome, Scenario, Step};

use super::connection::GRACE;
use super::pending_run::{PendingRun, ReceivedSoFar};
use super::session::{NoReply, RUN, Session, request, shown, unreadable, unsupported};
use crate::clock::now;
use crate::protocol::digest::digest;
use crate::protocol::{Answer, Extension, Operation, Reply, RunModes, Stream, read_json};
use crate::{Expected, HarnessError, MotionRequest, NoSamples};

/// Batches of steps that the adapter may send before it needs new credit.
const BATCHES_PER_CREDIT: u32 = 8;

/// Why a run has no outcome, and whether the session is still usable.
#[derive(Debug)]
pub(super) struct Stopped {
    pub(super) error: HarnessError,
    pub(super) session_usable: bool,
}

impl From<HarnessError> for Stopped {
    fn from(error: HarnessError) -> Self {
        Self { error, session_usable: false }
    }
}

impl Session {
    /// Runs a scenario. `expected` is the specified outcome, if the caller has one. It is computed while the controller
    /// runs, and an equal outcome need not be sent.
    pub(super) fn run(
        &mut self,
        scenario: &Scenario,
        expected: Option<&Expected<'_>>,
    ) -> Result<Outcome, Stopped> {
        let line = self.encode_run(scenario, expected.is_some())?;
        let pending = self.send_run(line);
        self.receive_outcome(pending, scenario, expected)
    }

    /// Encodes a request to run a scenario. With `by_digest` the answer may be a digest.
    pub(super) fn encode_run(
        &mut self,
        scenario: &Scenario,
        by_digest: bool,
    ) -> Result<(Vec<u8>, RunModes), HarnessError> {
        let digest = by_digest && self.has_extension(Extension::Digest);
        let stream = (self.has_extension(Extension::Stream) && !digest)
            .then_some(Stream { credit: BATCHES_PER_CREDIT });
        let (live, at_once) = self.split_operator_events(&scenario.operator);
        let live = live.iter().map(|event| event.when.clone()).collect();
        let modes = RunModes { stream, digest, live };
        let line = self.encoder.encode_run(self.last + 1, (scenario, at_once), &modes)?;
        Ok((line, modes))
    }

    /// Sends the request. The reset before it has checked that no surplus output was left.
    pub(super) fn send_run(&mut self, (line, modes): (Vec<u8>, RunModes)) -> PendingRun {
        self.has_run = true;
        self.last += 1;
        let credit = modes.stream.map_or(0, |stream| stream.credit);
        let received = ReceivedSoFar { credit, ..ReceivedSoFar::default() };
        PendingRun { unsent: self.lines.write_line(&line), accepts_digest: modes.digest, received }
    }

    /// Receives the outcome of a run. The time limit begins here: a thread that prefetched may have done something else
    /// since.
    #[expect(clippy::wildcard_enum_match_arm, reason = "whatever else is answered is amiss")]
    pub(super) fn receive_outcome(
        &mut self,
        PendingRun { unsent, accepts_digest, received }: PendingRun,
        scenario: &Scenario,
        expected: Option<&Expected<'_>>,
    ) -> Result<Outcome, Stopped> {
        // The expected outcome is computed here, while the controller runs.
        let expected: Option<&Outcome> = expected.map(|expected| &**expected);
        let (live, _) = self.split_operator_events(&scenario.operator);
        let (reply, steps) = self.await_reply((RUN, expected), unsent, live, received)?;
        let mut outcome = match reply {
            Reply::Unsupported(why) => return Ok(unsupported(scenario, why)),
            Reply::Digest(reported) if accepts_digest => {
                self.outcome_by_digest(&reported, expected)?
            }
            reply => self.outcome_from_reply(RUN, reply)?,
        };
        outcome.steps.splice(0..0, steps);
        if outcome.parameters.is_none() && self.can_query_parameters() {
            outcome.parameters = self.state()?.parameters;
        }
        Ok(outcome)
    }

    /// The operator's events to send while the controller runs, and those to send with the request.
    fn split_operator_events<'a>(
        &self,
        script: &'a [OperatorEvent],
    ) -> (&'a [OperatorEvent], &'a [OperatorEvent]) {
        if self.has_extension(Extension::LiveOperator) { (script, &[]) } else { (&[], script) }
    }

    /// Records the servo samples of a run.
    #[expect(clippy::wildcard_enum_match_arm, reason = "whatever else is answered is amiss")]
    pub(super) fn record_motion(
        &mut self,
        motion: &MotionRequest<'_>,
    ) -> Result<Result<Samples, NoSamples>, Stopped> {
        let operation = Operation::Move {
            scenario: Box::new(motion.scenario.clone()),
            limits: motion.limits.clone(),
            script: motion.script.clone(),
            every: motion.feed_interval,
        };
        let line = request(self.last + 1, &operation)?;
        let PendingRun { unsent, received, .. } = self.send_run((line, RunModes::default()));
        let (reply, _) = self.await_reply((operation.name(), None), unsent, &[], received)?;
        let samples = match reply {
            Reply::Unsupported(why) => return Ok(Err(NoSamples::Unsupported(shown(&why)))),
            // The controller has no samples; the session is still usable.
            Reply::Refused(why) => {
                return Ok(Err(NoSamples::Failed(HarnessError::NotRun(shown(&why)))));
            }
            Reply::Samples(text) => Samples::from_csv(&text),
            Reply::File(name) => {
                let bytes = self.take_answer_file(&name)?;
                match std::str::from_utf8(&bytes) {
                    Ok(text) if text.starts_with('#') => Samples::from_csv(text),
                    Ok(_) | Err(_) => Samples::from_bytes(&bytes),
                }
            }
            reply => return Err(self.unexpected_reply(operation.name(), &reply).into()),
        };
        let invalid = |error| unreadable("samples", format!("{error}").as_bytes());
        Ok(Ok(samples.map_err(invalid)?))
    }

    /// The expected outcome if the digest is equal, or the one that the controller sends on request.
    fn outcome_by_digest(
        &mut self,
        reported: &str,
        expected: Option<&Outcome>,
    ) -> Result<Outcome, HarnessError> {
        if let Some(expected) = expected
            && reported == digest(expected)
        {
            return Ok(expected.clone());
        }
        let operation = Operation::Outcome {};
        let reply = self.request(&operation)?;
        self.outcome_from_reply(operation.name(), reply)
    }

    /// The outcome in a reply, or in the file that it names.
    #[expect(clippy::wildcard_enum_match_arm, reason = "whatever else is answered is amiss")]
    fn outcome_from_reply(
        &mut self,
        operation: &str,
        reply: Reply,
    ) -> Result<Outcome, HarnessError> {
        match reply {
            Reply::Outcome(outcome) => Ok(*outcome),
            Reply::File(name) => {
                let bytes = self.take_answer_file(&name)?;
                self.limits
                    .check_objects(&bytes)
                    .and_then(|()| read_json(&bytes).map_err(|error| error.to_string()))
                    .map_err(|error| unreadable(&format!("file of `{operation}`: {error}"), &bytes))
            }
            reply => Err(self.unexpected_reply(operation, &reply)),
        }
    }

    /// The content of a file in the exchange folder.
    fn take_answer_file(&self, name: &str) -> Result<Vec<u8>, HarnessError> {
        let folder = self.folder.as_ref().filter(|_| self.has_extension(Extension::Files));
        let folder = folder.ok_or_else(|| {
            unreadable(
                "it names a file, but has not declared the extension `files` or has no folder",
                name.as_bytes(),
            )
        })?;
        folder
            .take(name, self.limits.whole)
            .map_err(|why| unreadable(&format!("file of its answer: {why}"), name.as_bytes()))
    }

    /// Waits for the final answer to a long request. Returns it with the steps that came before it.
    #[expect(clippy::wildcard_enum_match_arm, reason = "any other answer is the answer proper")]
    fn await_reply(
        &mut self,
        (operation, expected): (&str, Option<&Outcome>),
        mut unsent: Vec<u8>,
        events: &[OperatorEvent],
        mut received: ReceivedSoFar,
    ) -> Result<(Reply, Vec<Step>), Stopped> {
        let streams = received.credit > 0;
        let deadline = now() + self.limits.time;
        let mut bytes_left = self.limits.whole;
        let mut objects_left = self.limits.objects;
        loop {
            let reply = match self.exchange(&unsent, operation, deadline, expected) {
                Ok(reply) => reply,
                Err(NoReply::Late { all_said: true }) => return Err(self.cancel_late_run()),
                Err(no_reply) => return Err(no_reply.into_error(self.limits).into()),
            };
            unsent.clear();
            match reply {
                Reply::Steps(steps) if streams => {
                    if received.credit == 0 {
                        let what = "it sends more batches than it had credit for";
                        return Err(unreadable(what, b"steps").into());
                    }
                    received.credit -= 1;
                    bytes_left = bytes_left
                        .checked_sub(self.lines.last_line_length())
                        .ok_or(HarnessError::Flooded { bytes: self.limits.whole })?;
                    let objects: usize = steps.iter().map(|step| 1 + step.events.len()).sum();
                    objects_left = objects_left.checked_sub(objects).ok_or_else(|| {
                        let what = format!("more than {} steps and events", self.limits.objects);
                        unreadable(&what, b"steps")
                    })?;
                    received.steps.extend(steps);
                }
                Reply::At(index) if !events.is_empty() => {
                    let event = usize::try_from(index)
                        .ok()
                        .filter(|index| *index == received.operator_events_sent);
                    let event = event.and_then(|index| events.get(index)).ok_or_else(|| {
                        let what = "it requests an operator's event that is not the next one";
                        unreadable(what, index.to_string().as_bytes())
                    })?;
                    received.operator_events_sent += 1;
                    unsent = request(self.last, &Operation::Operator { event: event.clone() })?;
                }
                reply => {
                    if let Some(surplus) = self.lines.surplus() {
                        return Err(unreadable("it answers more than once", surplus).into());
                    }
                    return Ok((reply, received.steps));
                }
            }
            // A controller that never stops could always send one more batch.
            if now() >= deadline {
                return Err(self.cancel_late_run());
            }
            // Output without credit is an error: it is detected before new credit is sent.
            if streams && received.credit == 0 && self.lines.unrequested().is_none() {
                received.credit = BATCHES_PER_CREDIT;
                let credit = Operation::Credit { batches: BATCHES_PER_CREDIT };
                unsent.extend(request(self.last, &credit)?);
            }
        }
    }

    /// Cancels a run that takes too long, if the adapter can.
    fn cancel_late_run(&mut self) -> Stopped {
        let error = NoReply::Late { all_said: true }.into_error(self.limits);
        let session_usable = self.has_extension(Extension::Cancel) && self.cancel(Vec::new());
        Stopped { error, session_usable }
    }

    /// Sends the rest of a request and cancels the run. True if the session is still usable.
    pub(super) fn cancel(&mut self, mut unsent: Vec<u8>) -> bool {
        let run = self.last;
        self.last += 1;
        let Ok(cancel) = request(self.last, &Operation::Cancel {}) else { return false };
        unsent.extend(cancel);
        let deadline = now() + self.limits.time.min(4 * GRACE);
        loop {
            let peer = &mut self.peer;
            let answer =
                self.lines.exchange(&unsent, self.limits.bytes, deadline, || peer.is_gone());
            let Some(answer) = answer.ok().and_then(|line| serde_json::from_slice(&line).ok())
            else {
                return false;
            };
            unsent.clear();
            match answer {
                // A controller that never stops could always send one more line.
                _ if now() >= deadline => return false,
                Answer { id, reply } if id == self.last => return reply == (Reply::Done {}),
                // The adapter sent this answer before it read the cancel.
                Answer { id, .. } if id == run => (),
                Answer { .. } => return false,
            }
        }
    }
}
