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
use requests::{Reader, Requests, RunResult};

/// Steps of a batch.
const BATCH: usize = 100;

/// Bytes of an answer that is laid into a file rather than sent.
const LARGE: usize = 64 << 10;

/// Bytes of a line that comes over the network.
const LONGEST_REQUEST_BYTES: u64 = 64 << 20;

/// Most blocks or effects in the budget of a caller over the network: the outcome of a run is in memory.
const LARGEST_BUDGET: u32 = 1_000_000;

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
    /// From any program that reaches an address, a web page in a browser included: no file is written for this caller,
    /// and the session ends at the first line that is not JSON.
    Network,
}

impl Caller {
    /// Whether it can be offered this.
    fn can_use(self, extension: Extension) -> bool {
        self == Self::Parent || extension != Extension::Files
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
        if !serving.answer_line(&line)? {
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
    /// Buffer for an answer.
    line: Vec<u8>,
    /// Folder for answers in files.
    folder: Option<SharedFolder>,
    /// How many files were written.
    files: u32,
    /// The outcome of the last run, until the next reset.
    last: Option<Outcome>,
}

impl Serving<'_> {
    /// Answers a line. False if the session ends.
    fn answer_line(&mut self, line: &[u8]) -> Result<bool> {
        let Request { id, operation } =
            match self.reader.read(line).and_then(|it| self.within_bounds(it)) {
                Ok(request) => request,
                Err((id, why)) => {
                    self.send(id, Reply::Refused(why))?;
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
                // If the folder cannot be used, answers are sent in their lines.
                self.folder = folder.and_then(|folder| SharedFolder::open(Path::new(&folder)).ok());
                Reply::Hello(Box::new(self.declaration()))
            }
            // Each run begins on a fresh controller.
            Operation::Reset {} | Operation::Cancel {} | Operation::Bye {} => {
                self.last = None;
                Reply::Done {}
            }
            // It was sent before the answer to a run arrived, and has no effect now.
            Operation::Credit { .. } if self.offers(Extension::Stream) => return Ok(true),
            Operation::Run { scenario, modes } => return self.run(id, *scenario, modes),
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
                    record_samples(controller.as_ref(), &motion)
                };
                match self.requests.run(work)? {
                    RunResult::Done(Ok(samples)) => self.samples(&samples)?,
                    RunResult::Done(Err(reply)) => reply,
                    RunResult::Cancelled(by) => return self.confirm_cancel(by),
                    RunResult::SessionEnded => return Ok(false),
                }
            }
            Operation::Shows { scenario } if self.offers(Extension::Shows) => Reply::Shows(
                Box::new(Observables::of(&self.served.controller.observables(&scenario))),
            ),
            Operation::State {} if self.offers(Extension::State) => self.state(),
            Operation::Outcome {} if self.offers(Extension::Digest) => match self.last.take() {
                Some(outcome) => {
                    let goes_on = self.send_outcome(id, &outcome);
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
        self.send(id, reply)?;
        Ok(lasts)
    }

    /// Refuses a request over the network whose outcome may not fit into memory. The error has its id and the reason.
    fn within_bounds(&self, request: Request) -> std::result::Result<Request, (u64, String)> {
        let (Operation::Run { scenario, .. } | Operation::Move { scenario, .. }) =
            &request.operation
        else {
            return Ok(request);
        };
        let budget = &scenario.budget;
        let largest = budget.steps.max(budget.effects);
        if self.served.caller == Caller::Network && largest > LARGEST_BUDGET {
            let why =
                format!("a budget over the network is at most {LARGEST_BUDGET} steps and effects");
            return Err((request.id, why));
        }
        Ok(request)
    }

    fn offers(&self, extension: Extension) -> bool {
        self.served.offers.contains(&extension) && self.served.caller.can_use(extension)
    }

    fn declaration(&self) -> Declaration {
        let Served { controller, languages, offers, caller } = self.served;
        let offers =
            offers.iter().copied().filter(|extension| caller.can_use(*extension)).collect();
        let sessions = controller.best_jobs().and_then(|jobs| u16::try_from(jobs.get()).ok());
        let declaration = Declaration::of(controller.capabilities(), languages.clone());
        let (edition, observed) = (controller.own_edition(), controller.observed_edition());
        let (edition, observed) = (edition.map(str::to_owned), observed.map(str::to_owned));
        Declaration { sessions, edition, observed, offers, ..declaration }
    }

    /// Runs a scenario and sends its outcome as requested. False if the session ends.
    fn run(&mut self, id: u64, mut scenario: Scenario, modes: RunModes) -> Result<bool> {
        self.last = None;
        // The whole script has to be known before the run: requests for it are sent at the beginning.
        for place in 0..u32::try_from(modes.live.len()).unwrap_or(u32::MAX) {
            self.send(id, Reply::At(place))?;
            match self.next_within(id)? {
                Some(Operation::Operator { event }) => scenario.operator.push(event),
                Some(Operation::Cancel {}) => return self.confirm_cancel(id + 1),
                _ => return Ok(false),
            }
        }
        if let Err(why) = self.served.controller.supports(&scenario) {
            return self.send(id, Reply::Unsupported(why));
        }
        let controller = Arc::clone(&self.served.controller);
        let mut outcome = match self.requests.run(move || controller.run(&scenario))? {
            RunResult::Done(Ok(outcome)) => outcome,
            RunResult::Done(Err(error)) => return self.send(id, Reply::Refused(error.to_string())),
            RunResult::Cancelled(by) => return self.confirm_cancel(by),
            RunResult::SessionEnded => return Ok(false),
        };
        if self.offers(Extension::State) || modes.digest {
            self.last = Some(outcome.clone());
        }
        if modes.digest {
            return self.send(id, Reply::Digest(digest(&outcome)));
        }
        if let Some(stream) = modes.stream {
            let mut credit = stream.credit;
            while outcome.steps.len() > BATCH {
                if credit == 0 {
                    match self.next_within(id)? {
                        Some(Operation::Credit { batches }) => credit = batches,
                        Some(Operation::Cancel {}) => return self.confirm_cancel(id + 1),
                        _ => return Ok(false),
                    }
                    continue;
                }
                credit -= 1;
                let rest = outcome.steps.split_off(BATCH);
                let batch: Vec<Step> = std::mem::replace(&mut outcome.steps, rest);
                self.send(id, Reply::Steps(batch))?;
            }
        }
        self.send_outcome(id, &outcome)
    }

    /// Handles requests that arrive while a run is reported: credit for it, or its cancel.
    fn next_within(&mut self, id: u64) -> Result<Option<Operation>> {
        let Some(line) = self.requests.next()? else { return Ok(None) };
        let request = requests::read(&line).ok().filter(|request| {
            request.id == id || request.id == id + 1 && request.operation == Operation::Cancel {}
        });
        Ok(request.map(|request| request.operation))
    }

    fn confirm_cancel(&mut self, by: u64) -> Result<bool> {
        self.last = None;
        self.send(by, Reply::Done {})
    }

    /// Sends an outcome, or writes it into the folder. False if the session ends.
    fn send_outcome(&mut self, id: u64, outcome: &Outcome) -> Result<bool> {
        self.line.clear();
        write!(self.line, "{{\"id\":{id},\"outcome\":")?;
        let start = self.line.len();
        serde_json::to_writer(&mut self.line, outcome)?;
        if self.folder.is_some() && self.line.len() - start > LARGE {
            let bytes = self.line.split_off(start);
            let laid = self.write_answer_file(&bytes)?;
            return self.send(id, laid);
        }
        self.line.push(b'}');
        self.send_line()
    }

    fn samples(&mut self, samples: &Samples) -> Result<Reply> {
        let bytes = samples.to_bytes();
        if self.folder.is_some() && bytes.len() > LARGE {
            return self.write_answer_file(&bytes);
        }
        Ok(Reply::Samples(samples.to_csv()))
    }

    /// Writes an answer into the folder.
    fn write_answer_file(&mut self, bytes: &[u8]) -> Result<Reply> {
        self.files += 1;
        let name = format!("answer-{}", self.files);
        if let Some(folder) = &self.folder {
            folder.write_new(&name, bytes)?;
        }
        Ok(Reply::File(name))
    }

    /// The state after the last run, or after power-on.
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

    fn send(&mut self, id: u64, reply: Reply) -> Result<bool> {
        self.line.clear();
        serde_json::to_writer(&mut self.line, &Answer { id, reply })?;
        self.send_line()
    }

    /// Sends the line in one piece, so that the reader is woken once.
    fn send_line(&mut self) -> Result<bool> {
        self.line.push(b'\n');
        self.answers.write_all(&self.line)?;
        self.answers.flush()?;
        Ok(true)
    }
}

/// The samples of a run, or the reply that there are none.
fn record_samples(
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
