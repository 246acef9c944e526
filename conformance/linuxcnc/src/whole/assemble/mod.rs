//! Assembles an outcome from blocks, issued commands and checkpoints.
//!
//! The controller reads ahead: checkpoints report what the interpreter did, and marks in the queue report what has been
//! executed since. Both come in the order of the program, so that the n-th checkpoint and the n-th mark belong
//! together. A block without its mark was read, but not executed.

mod ending;
mod entering;
mod entries;
mod waiting;

use std::collections::{BTreeMap, VecDeque};

use gaugeblock_adapter::HarnessError;
use gaugeblock_vocabulary::scenario::Start;
use gaugeblock_vocabulary::{
    Channel, ControllerMode, Effect, End, Event, Fault, Indexed, Language, Outcome, PinChange,
    Scenario, Settings,
};
use serde_json::Value;

use entering::Entering;
use waiting::Waiting;

use super::canon::Canon;
use super::stream::{Issued, Item};
use super::trace::Trace;
use crate::instrumentation::checkpoint::Checkpoint;
use crate::instrumentation::instrument::Plan;
use crate::instrumentation::refusal;
use crate::instrumentation::source::{Source, has_code};
use crate::instrumentation::steps::{self, Steps};

/// Codes that call a profile and read the position back from the machine.
const LATHE_CYCLES: &[&str] = &["g70", "g71", "g71.1", "g71.2", "g72", "g72.1", "g72.2"];

/// A block as it was read: what was printed meanwhile, and the checkpoint after it.
type ReadBlock = (Vec<Effect>, Checkpoint);

/// An outcome in the making.
#[derive(Debug)]
pub(super) struct Assembly<'a> {
    source: &'a Source,
    plan: &'a Plan,
    canon: Canon,
    steps: Steps<'a>,
    waiting: Waiting,
    trace: Trace,
    start: Settings,
    /// What was printed since the last checkpoint.
    printed: Vec<Effect>,
    /// Blocks that were read and not yet carried out.
    read: VecDeque<ReadBlock>,
    /// What was issued before the run, by the reset.
    reset: Vec<Issued>,
    /// What was issued since the last mark.
    issued: Vec<Issued>,
    /// What was issued up to each mark whose checkpoint is still to come.
    marked: VecDeque<Vec<Issued>>,
    /// Where the interpreter is.
    reading_at: Option<(usize, u32)>,
    log_is_open: bool,
    /// Whether the next user-defined code is a gate of ours.
    at_gate: bool,
    refused: Option<Fault>,
    /// A fault of the machine, from the error channel.
    stopped: Option<String>,
    aborted: bool,
    /// Whether another mode was requested, which a controller may take as an abort.
    asked_for_mode: bool,
    /// Whether the operator has requested a pause that has not reached the controller yet.
    asked_to_pause: bool,
    /// Whether each line of the program is entered by hand.
    by_hand: bool,
    /// The relation of the next checkpoint to a block that the operator enters by hand.
    entering: Option<Entering>,
    /// The mode in which the program ended.
    mode_at_end: Option<ControllerMode>,
    /// Whether its end has become a step.
    has_ended: bool,
    /// How often the operator started the program again, and how often it was seen to begin again.
    starts: usize,
    restarts: usize,
    pins: Vec<PinChange>,
    ends: Option<String>,
    /// Number of queued moves at the end of the run, and the kind of the current move.
    queued_moves: usize,
    moves_as: u64,
}

impl<'a> Assembly<'a> {
    /// The outcome of a run, from what was printed from its reset on.
    ///
    /// # Errors
    /// The output does not make sense, or an error message is unknown.
    pub(super) fn outcome(
        scenario: &Scenario,
        source: &'a Source,
        plan: &'a Plan,
        items: &[Item],
        parameters: Option<BTreeMap<u32, f64>>,
    ) -> Result<Outcome, HarnessError> {
        let mut assembly = Self {
            source,
            plan,
            canon: Canon::new(&scenario.machine),
            steps: Steps::new(source, plan, scenario),
            waiting: Waiting::default(),
            trace: Trace::new(source, plan),
            start: Settings::default(),
            printed: Vec::new(),
            read: VecDeque::new(),
            reset: Vec::new(),
            issued: Vec::new(),
            marked: VecDeque::new(),
            reading_at: None,
            log_is_open: false,
            at_gate: false,
            refused: None,
            stopped: None,
            aborted: false,
            asked_for_mode: false,
            asked_to_pause: false,
            by_hand: scenario.program.start == Start::Mdi,
            entering: None,
            has_ended: false,
            mode_at_end: None,
            starts: 0,
            restarts: 0,
            pins: Vec::new(),
            ends: None,
            queued_moves: 0,
            moves_as: 0,
        };
        let end = items.iter().position(Item::is_end).map_or(items.len(), |place| place + 1);
        let (run, after) = items.split_at(end);
        for item in run {
            assembly.item(item)?;
        }
        let end = assembly.end(assembly.state_after(after))?;
        let mut parameters = parameters;
        if let (End::Paused, false, Some(all)) = (&end, assembly.by_hand, &mut parameters) {
            // The driver lets the interpreter go, which may read on before it stops.
            all.extend(assembly.steps.numbered_parameters());
            all.retain(|_, value| *value != 0.0);
        }
        let mut outcome = Outcome {
            language: Language::Rs274,
            start: assembly.start,
            steps: assembly.steps.taken,
            end,
            parameters: parameters.map(|all| all.into_iter().collect::<Indexed<_, _>>()),
            pins: assembly.pins,
            samples: Vec::new(),
        };
        assembly.waiting.cut_off(&mut outcome);
        let is_exhausted = matches!(outcome.end, End::BudgetExhausted { .. });
        if steps::limit(&mut outcome, scenario.budget).is_none() && is_exhausted {
            return Err(HarnessError::Unreadable {
                what: "run cut off within the budget".to_owned(),
                line: String::new(),
            });
        }
        Ok(outcome)
    }

    fn item(&mut self, item: &Item) -> Result<(), HarnessError> {
        let print = |channel, text: &String| Effect::Message { channel, text: text.clone() };
        match item {
            Item::Block(text, line) => self.trace.block(text, *line),
            Item::Executed => self.trace.executed(),
            Item::Line(line) => self.trace.line(*line),
            Item::Issued(issued) => self.issued(issued)?,
            Item::Refused(message) if self.refused.is_none() => self.refused(message)?,
            Item::Refused(_) => {}
            Item::UserProgramFailed(status) => {
                self.stopped = Some(format!("user program: exit status {status}"));
            }
            Item::Checkpoint(checkpoint) => self.checkpoint(checkpoint)?,
            Item::Text(text) => self.printed.push(print(Channel::Print, text)),
            Item::Log(text) if self.log_is_open => self.printed.push(print(Channel::Log, text)),
            Item::Log(_) => {}
            Item::LogOpen(file, append) => {
                self.log_is_open = true;
                self.printed.push(Effect::LogOpen { file: file.clone(), append: *append });
            }
            // It prints the word of a program that closes what is not open.
            Item::LogClose if !self.log_is_open => {}
            Item::LogClose => {
                self.log_is_open = false;
                self.printed.push(Effect::LogClose {});
            }
            Item::Driver(report) => self.driver(report)?,
        }
        Ok(())
    }

    fn driver(&mut self, report: &Value) -> Result<(), HarnessError> {
        if report.get("begins").is_some() {
            // What the reset issued is the state before the first block.
            self.reset = std::mem::take(&mut self.issued);
            self.steps.mode = mode(report);
        } else if let Some(action) = report.get("operator").and_then(Value::as_str) {
            self.aborted = action == "abort" || self.aborted && action != "cycle_start";
            self.asked_for_mode |= action == "mode";
            self.asked_to_pause |= action == "pause";
            self.steps.count_turns_again();
        } else if report.get("starts_again").is_some() {
            self.starts += 1;
            self.has_ended = false;
        } else if let Some(moment) = report.get("entry").and_then(Value::as_str) {
            self.entry(moment, report);
        } else if let Some(mode) = mode(report) {
            self.steps.mode = Some(mode);
            self.issued.push(Issued::own("CONTROLLER_MODE", mode.to_string()));
        } else if let Some(request) = report.get("request_refused").and_then(Value::as_str) {
            // What the controller says about a request is no fault of the program.
            self.stopped = None;
            let held = report.get("held_moves").and_then(Value::as_u64).unwrap_or_default();
            let place = before_held_moves(&self.issued, held);
            self.issued.insert(place, Issued::own("REQUEST_REFUSED", request.to_owned()));
        } else if report.get("error").and_then(Value::as_bool) == Some(true)
            && self.refused.is_none()
        {
            let message = report.get("message").and_then(Value::as_str).unwrap_or_default();
            self.stopped.get_or_insert(message.to_owned());
        } else if let Some(ends) = report.get("ends").and_then(Value::as_str) {
            self.ends = Some(ends.to_owned());
            let queued = report.get("queued_moves").and_then(Value::as_u64).unwrap_or_default();
            self.queued_moves = usize::try_from(queued).unwrap_or(usize::MAX);
            self.moves_as = report.get("motion").and_then(Value::as_u64).unwrap_or_default();
            self.pins = pins(report.get("pins"))?;
        }
        Ok(())
    }

    fn issued(&mut self, issued: &Issued) -> Result<(), HarnessError> {
        let text = if issued.name == "OPERATOR_DISPLAY" { issued.text(1) } else { String::new() };
        if let Some(mark) = text.strip_prefix(&self.plan.marker) {
            self.at_gate = mark.starts_with('<');
            if !mark.starts_with(['+', '<', '>']) {
                self.marked.push_back(std::mem::take(&mut self.issued));
                self.block_executed()?;
            }
            return Ok(());
        }
        if issued.name == "SYSTEM_CMD" && std::mem::take(&mut self.at_gate) {
            return Ok(());
        }
        // The operator's pause has the name of the program's, and is no effect of a block.
        if issued.name == "TASK_PLAN_PAUSE" && std::mem::take(&mut self.asked_to_pause) {
            return Ok(());
        }
        if is_end(issued) {
            self.mode_at_end = self.steps.mode;
        }
        self.issued.push(issued.clone());
        Ok(())
    }

    fn checkpoint(&mut self, checkpoint: &Checkpoint) -> Result<(), HarnessError> {
        if let Some(entering) = self.entering.take() {
            return self.checkpoints_around_entry(entering, checkpoint);
        }
        if (checkpoint.file, checkpoint.line) == (0, 0)
            && self.reading_at.is_some()
            && self.restarts < self.starts
        {
            // What was read ahead before the program was started again is never carried out.
            self.read.clear();
        }
        self.reading_at = Some((checkpoint.file, checkpoint.line));
        self.trace.set_file(checkpoint.file);
        self.read.push_back((std::mem::take(&mut self.printed), checkpoint.clone()));
        self.block_executed()
    }

    /// Blocks that are both read and carried out become steps.
    fn block_executed(&mut self) -> Result<(), HarnessError> {
        while !self.marked.is_empty() && !self.read.is_empty() {
            let (Some(issued), Some((printed, checkpoint))) =
                (self.marked.pop_front(), self.read.pop_front())
            else {
                break;
            };
            if !self.steps.has_begun() {
                self.canon.begin("", &checkpoint, None);
                for issued in std::mem::take(&mut self.reset) {
                    self.canon.issue(&issued)?;
                }
                self.canon.finish(&checkpoint)?;
                self.start = self.canon.now.clone();
                self.waiting.begin(&checkpoint);
                self.steps.begin(&checkpoint)?;
                continue;
            }
            let mut events = self.events(printed, &issued, &checkpoint)?;
            if (checkpoint.file, checkpoint.line) == (0, 0) && self.restarts < self.starts {
                self.restarts += 1;
                if issued.iter().any(is_end) {
                    self.program_ended(&checkpoint, events)?;
                } else {
                    self.aborted(events);
                }
                self.steps.resume_at(&checkpoint);
                continue;
            }
            if self.by_hand && std::mem::take(&mut self.aborted) {
                // The block was broken off; the next one is entered all the same.
                self.aborted(events);
                self.steps.resume_at(&checkpoint);
                continue;
            }
            let (file, line) = self.steps.next().unwrap_or((0, 1));
            let block = || self.source.block(file, line);
            if has_code(self.source.line(file, line), LATHE_CYCLES) {
                // The interpreter now takes its position from the machine, which may still move.
                self.steps.reports_position = false;
                events.push(Event::Unknown(["position".to_owned()].into()));
            }
            self.waiting.block(&checkpoint, &events, self.steps.taken.len(), block);
            self.steps.record_block(&checkpoint, events, self.canon.tool)?;
        }
        Ok(())
    }

    /// The events of a block, under the settings of its checkpoint.
    fn events(
        &mut self,
        printed: Vec<Effect>,
        issued: &[Issued],
        checkpoint: &Checkpoint,
    ) -> Result<Vec<Event>, HarnessError> {
        let (file, line) = self.steps.next().unwrap_or((0, 1));
        self.events_of(self.source.line(file, line), printed, issued, checkpoint)
    }

    /// What a block of this text did.
    fn events_of(
        &mut self,
        text: &str,
        printed: Vec<Effect>,
        issued: &[Issued],
        checkpoint: &Checkpoint,
    ) -> Result<Vec<Event>, HarnessError> {
        let read = self.plan.parameters.iter().position(|name| name == "5399");
        let read = read.and_then(|place| checkpoint.parameters.get(place).copied().flatten());
        self.canon.begin(text, checkpoint, read);
        for effect in printed {
            self.canon.push(effect);
        }
        for issued in issued {
            self.canon.issue(issued)?;
        }
        self.canon.finish(checkpoint)
    }

    fn refused(&mut self, message: &str) -> Result<(), HarnessError> {
        let next = self.reading_at.map(|(file, line)| (file, line + 1)).or(Some((0, 1)));
        let echo = self.trace.refused_line();
        let stderr = format!("{message}\n{}\n", echo.unwrap_or_default());
        let mut fault = refusal::fault(&stderr, self.source, self.plan, next)?;
        if let Some(Entering::Block { line, .. }) = &self.entering {
            fault.block = Some(entering::block(*line));
        }
        // The controller executes the profile within the block of the cycle; which block it refuses is not reported.
        let in_cycle =
            next.is_some_and(|(file, line)| has_code(self.source.line(file, line), LATHE_CYCLES));
        fault.block = fault.block.filter(|_| !in_cycle);
        self.refused = Some(fault);
        Ok(())
    }
}

/// The place among commands before the moves that wait in the queue; the end if none does.
fn before_held_moves(issued: &[Issued], held: u64) -> usize {
    let is_move =
        |issued: &Issued| matches!(issued.name.as_str(), "TRAJ_LINEAR_MOVE" | "TRAJ_CIRCULAR_MOVE");
    let moves = (0..issued.len()).rev().filter(|place| is_move(&issued[*place]));
    let held = usize::try_from(held).unwrap_or(usize::MAX);
    moves.take(held).last().unwrap_or(issued.len())
}

/// Whether a command ends the program.
fn is_end(issued: &Issued) -> bool {
    issued.name == "TASK_PLAN_END"
}

fn mode(report: &Value) -> Option<ControllerMode> {
    match report.get("mode")?.as_str()? {
        "auto" => Some(ControllerMode::Auto),
        "mdi" => Some(ControllerMode::Mdi),
        "manual" => Some(ControllerMode::Manual),
        _ => None,
    }
}

fn pins(report: Option<&Value>) -> Result<Vec<PinChange>, HarnessError> {
    let changes = report.and_then(Value::as_array).into_iter().flatten();
    let change = |change: &Value| {
        let pin = change.get(1)?.as_str()?.parse().ok()?;
        Some(PinChange { time: change.get(0)?.as_f64()?, pin, value: change.get(2)?.as_f64()? })
    };
    let read = changes.map(|report| change(report).ok_or_else(|| unreadable(&report.to_string())));
    read.collect()
}

fn unreadable(what: &str) -> HarnessError {
    HarnessError::Unreadable { what: what.to_owned(), line: String::new() }
}
