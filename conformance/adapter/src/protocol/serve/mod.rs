//! The controller's side of the protocol, for a controller of this project.

mod requests;
#[cfg(test)]
mod tests;

use std::collections::BTreeSet;
use std::io::{BufRead, Result, Write};
use std::path::Path;
use std::sync::Arc;

use gaugeblock_compare::observe::Observed;
use gaugeblock_filesystem::SharedFolder;
use gaugeblock_vocabulary::motion::{MotionLimits, Samples};
use gaugeblock_vocabulary::{Language, Outcome, Scenario, Step};
use serde::de::IgnoredAny;

use super::digest::digest;
use super::{
    Answer, ControllerState, Declaration, Extension, Observables, Operation, Reply, Request,
    RunModes,
};
use crate::{Adapter, MotionRequest, NoSamples};
use requests::{Ran, Reader, Requests};

/// Steps of a batch.
const BATCH: usize = 100;

/// Bytes of an answer that is laid into a file rather than sent.
const LARGE: usize = 64 << 10;

/// Bytes of a line that comes over the network.
const LONGEST_REQUEST_BYTES: u64 = 64 << 20;

/// What is served.
#[derive(Clone, Debug)]
pub struct Served {
    /// The controller. Each of its runs begins as after power-on, whatever ran before or still runs.
    pub controller: Arc<dyn Adapter>,
    /// The languages that it speaks.
    pub languages: Vec<Language>,
    /// What is declared beyond the operations that each adapter has to know.
    pub offers: BTreeSet<Extension>,
    /// Where requests come from.
    pub caller: Caller,
}

/// Where requests come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Caller {
    /// From the process that started this one, with the same rights.
    Parent,
    /// From any program that reaches an address, a web page in a browser included: no file is written for this caller, and
    /// the session ends at the first line that is not JSON.
    Network,
}

impl Caller {
    /// Whether it can be offered this.
    fn can_use(self, offer: Extension) -> bool {
        self == Self::Parent || offer != Extension::Files
    }
}

/// Answers requests until `bye`, or until there are no more.
///
/// # Errors
/// A stream that cannot be read or written.
pub fn serve(
    served: &Served,
    requests: Box<dyn BufRead + Send>,
    answers: &mut dyn Write,
) -> Result<()> {
    let longest = match served.caller {
        Caller::Parent => u64::MAX,
        Caller::Network => LONGEST_REQUEST_BYTES,
    };
    let requests = Requests::of(requests, longest, served.offers.contains(&Extension::Cancel));
    let (folder, last) = (None, None);
    let (reader, line) = (Reader::default(), Vec::new());
    let mut serving = Serving { served, requests, reader, answers, line, folder, files: 0, last };
    while let Some(line) = serving.requests.next()? {
        if !serving.answered(&line)? {
            break;
        }
    }
    Ok(())
}

/// A session.
struct Serving<'a> {
    served: &'a Served,
    requests: Requests,
    reader: Reader,
    answers: &'a mut dyn Write,
    /// Room for an answer.
    line: Vec<u8>,
    /// Where answers may be laid.
    folder: Option<SharedFolder>,
    /// How many were.
    files: u32,
    /// What the last run came to, until the next reset.
    last: Option<Outcome>,
}

impl Serving<'_> {
    /// Answers a line; whether the session goes on.
    fn answered(&mut self, line: &[u8]) -> Result<bool> {
        let Request { id, operation } = match self.reader.read(line) {
            Ok(request) => request,
            Err((id, why)) => {
                self.say(id, Reply::Refused(why))?;
                let is_json = serde_json::from_slice::<IgnoredAny>(line).is_ok();
                return Ok(is_json || self.served.caller == Caller::Parent);
            }
        };
        let lasts = operation != Operation::Bye {};
        let reply = match operation {
            Operation::Hello { folder: Some(_), .. } if self.served.caller == Caller::Network => {
                Reply::Refused("no folder is written to over the network".to_owned())
            }
            Operation::Hello { folder, .. } => {
                let folder = folder.filter(|_| self.offers(Extension::Files));
                // Where there is no such folder, answers are told in their lines.
                self.folder = folder.and_then(|folder| SharedFolder::open(Path::new(&folder)).ok());
                Reply::Hello(Box::new(self.declaration()))
            }
            // Each run begins on a controller as after power-on.
            Operation::Reset {} | Operation::Cancel {} | Operation::Bye {} => {
                self.last = None;
                Reply::Done {}
            }
            // It was said before the answer of a run had come, and is of no use any more.
            Operation::Credit { .. } if self.offers(Extension::Stream) => return Ok(true),
            Operation::Run { scenario, ways } => return self.run(id, *scenario, ways),
            Operation::Move { scenario, limits, script, every }
                if self.offers(Extension::Motion) =>
            {
                let controller = Arc::clone(&self.served.controller);
                let work = move || {
                    let motion = MotionRequest {
                        scenario: &scenario,
                        limits: &limits,
                        script: &script,
                        feed_interval: every,
                    };
                    moved(controller.as_ref(), &motion)
                };
                match self.requests.run(work)? {
                    Ran::Done(Ok(samples)) => self.samples(&samples)?,
                    Ran::Done(Err(reply)) => reply,
                    Ran::Cancelled(by) => return self.cancelled(by),
                    Ran::Alone => return Ok(false),
                }
            }
            Operation::Shows { scenario } if self.offers(Extension::Shows) => Reply::Shows(
                Box::new(Observables::of(&self.served.controller.observables(&scenario))),
            ),
            Operation::State {} if self.offers(Extension::State) => self.state(),
            Operation::Outcome {} if self.offers(Extension::Digest) => match self.last.take() {
                Some(outcome) => {
                    let goes_on = self.tell(id, &outcome);
                    self.last = Some(outcome);
                    return goes_on;
                }
                None => Reply::Refused("nothing was run".to_owned()),
            },
            Operation::Move { .. }
            | Operation::Shows { .. }
            | Operation::State {}
            | Operation::Outcome {}
            | Operation::Credit { .. }
            | Operation::Operator { .. } => {
                Reply::Refused("it was not offered, or has no place here".to_owned())
            }
        };
        self.say(id, reply)?;
        Ok(lasts)
    }

    fn offers(&self, offer: Extension) -> bool {
        self.served.offers.contains(&offer) && self.served.caller.can_use(offer)
    }

    fn declaration(&self) -> Declaration {
        let Served { controller, languages, offers, caller } = self.served;
        let offers = offers.iter().copied().filter(|offer| caller.can_use(*offer)).collect();
        let sessions = controller.best_jobs().and_then(|jobs| u16::try_from(jobs.get()).ok());
        let declaration = Declaration::of(controller.capabilities(), languages.clone());
        let (edition, observed) = (controller.own_edition(), controller.observed_edition());
        let (edition, observed) = (edition.map(str::to_owned), observed.map(str::to_owned));
        Declaration { sessions, edition, observed, offers, ..declaration }
    }

    /// Runs a scenario and tells its outcome in the way that is asked for; whether the session goes on.
    fn run(&mut self, id: u64, mut scenario: Scenario, ways: RunModes) -> Result<bool> {
        self.last = None;
        // The whole script has to be known before the run: it asks for all of it at the beginning.
        for place in 0..u32::try_from(ways.live.len()).unwrap_or(u32::MAX) {
            self.say(id, Reply::At(place))?;
            match self.next_within(id)? {
                Some(Operation::Operator { event }) => scenario.operator.push(event),
                Some(Operation::Cancel {}) => return self.cancelled(id + 1),
                _ => return Ok(false),
            }
        }
        if let Err(why) = self.served.controller.supports(&scenario) {
            return self.say(id, Reply::Unsupported(why));
        }
        let controller = Arc::clone(&self.served.controller);
        let mut outcome = match self.requests.run(move || controller.run(&scenario))? {
            Ran::Done(Ok(outcome)) => outcome,
            Ran::Done(Err(error)) => return self.say(id, Reply::Refused(error.to_string())),
            Ran::Cancelled(by) => return self.cancelled(by),
            Ran::Alone => return Ok(false),
        };
        if self.offers(Extension::State) || ways.digest {
            self.last = Some(outcome.clone());
        }
        if ways.digest {
            return self.say(id, Reply::Digest(digest(&outcome)));
        }
        if let Some(stream) = ways.stream {
            let mut credit = stream.credit;
            while outcome.steps.len() > BATCH {
                if credit == 0 {
                    match self.next_within(id)? {
                        Some(Operation::Credit { batches }) => credit = batches,
                        Some(Operation::Cancel {}) => return self.cancelled(id + 1),
                        _ => return Ok(false),
                    }
                    continue;
                }
                credit -= 1;
                let rest = outcome.steps.split_off(BATCH);
                let batch: Vec<Step> = std::mem::replace(&mut outcome.steps, rest);
                self.say(id, Reply::Steps(batch))?;
            }
        }
        self.tell(id, &outcome)
    }

    /// What the referee says while a run is told: of this run, or to cancel it.
    fn next_within(&mut self, id: u64) -> Result<Option<Operation>> {
        let Some(line) = self.requests.next()? else { return Ok(None) };
        let request = requests::read(&line).ok().filter(|request| {
            request.id == id || request.id == id + 1 && request.operation == Operation::Cancel {}
        });
        Ok(request.map(|request| request.operation))
    }

    fn cancelled(&mut self, by: u64) -> Result<bool> {
        self.last = None;
        self.say(by, Reply::Done {})
    }

    /// Tells an outcome, or lays it into the folder; whether the session goes on.
    fn tell(&mut self, id: u64, outcome: &Outcome) -> Result<bool> {
        self.line.clear();
        write!(self.line, "{{\"id\":{id},\"outcome\":")?;
        let start = self.line.len();
        serde_json::to_writer(&mut self.line, outcome)?;
        if self.folder.is_some() && self.line.len() - start > LARGE {
            let bytes = self.line.split_off(start);
            let laid = self.laid(&bytes)?;
            return self.say(id, laid);
        }
        self.line.push(b'}');
        self.end_line()
    }

    fn samples(&mut self, samples: &Samples) -> Result<Reply> {
        let bytes = samples.to_bytes();
        if self.folder.is_some() && bytes.len() > LARGE {
            return self.laid(&bytes);
        }
        Ok(Reply::Samples(samples.to_csv()))
    }

    /// Lays an answer into the folder.
    fn laid(&mut self, bytes: &[u8]) -> Result<Reply> {
        self.files += 1;
        let name = format!("answer-{}", self.files);
        if let Some(folder) = &self.folder {
            folder.write_new(&name, bytes)?;
        }
        Ok(Reply::File(name))
    }

    /// What is in force after the last run, or after power-on.
    fn state(&self) -> Reply {
        let power_on = || self.served.controller.run(&Scenario::default());
        let outcome = match self.last.clone().map_or_else(power_on, Ok) {
            Ok(outcome) => outcome,
            Err(error) => return Reply::Refused(error.to_string()),
        };
        let observed = Observed::of(&outcome);
        let (settings, state) = match observed.steps.into_iter().next_back() {
            Some(step) => (step.settings, step.state),
            None => (observed.start, None),
        };
        Reply::State(Box::new(ControllerState { settings, state, parameters: outcome.parameters }))
    }

    fn say(&mut self, id: u64, reply: Reply) -> Result<bool> {
        self.line.clear();
        serde_json::to_writer(&mut self.line, &Answer { id, reply })?;
        self.end_line()
    }

    /// Says the line. In one piece: whoever waits for it is woken once.
    fn end_line(&mut self) -> Result<bool> {
        self.line.push(b'\n');
        self.answers.write_all(&self.line)?;
        self.answers.flush()?;
        Ok(true)
    }
}

/// The samples of a run, or what is answered instead.
fn moved(
    controller: &dyn Adapter,
    motion: &MotionRequest<'_>,
) -> std::result::Result<Samples, Reply> {
    let checked = motion.limits.to_text().and_then(|text| MotionLimits::from_text(&text));
    checked.map_err(|error| Reply::Refused(error.to_string()))?;
    controller.supports(motion.scenario).map_err(Reply::Unsupported)?;
    controller.record_motion(motion).map_err(|none| match none {
        NoSamples::Unsupported(why) => Reply::Unsupported(why),
        NoSamples::Failed(why) => Reply::Refused(why.to_string()),
    })
}
