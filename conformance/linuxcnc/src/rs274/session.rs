//! The runs that one outcome takes: one under observation and beyond the end, and one without where it is needed.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsString;

use gaugeblock_adapter::HarnessError;
use gaugeblock_vocabulary::{FaultKind, Machine, Program, Scenario};

use super::command::Started;
use super::fork::{Servers, Start};
use super::output::{self, Line};
use super::process::{Limits, Output, Process, Run};
use super::streams::Stop;
use crate::instrumentation::checkpoint::Checkpoint;
use crate::instrumentation::instrument::{Ends, Plan, is_plain};
use crate::instrumentation::source::{DEBUG_SWITCH, Source};
use crate::instrumentation::workspace::{INI, PARAMETERS, TOOLS, Workspace, tool_table};
use crate::instrumentation::{faults, refusal};

/// What the program says when an error has stopped it and it takes blocks from standard input.
const BY_HAND: &str = "starting MDI";

/// Stop at an error and take blocks from standard input.
pub(super) const MANUAL_INPUT: &[&str] = &["-n", "1"];

/// One program in this many also runs without checkpoints, in a process of its own.
const PROGRAMS_PER_SAMPLE: u64 = 32;

/// One scenario on one binary.
#[derive(Debug)]
pub(super) struct Session<'a> {
    /// The binary, and how it is started.
    pub(super) program: Started<'a>,
    /// The processes from which runs are forked.
    pub(super) servers: &'a Servers,
    /// The limits of each run.
    pub(super) limits: Limits,
    /// Which programs are also run without checkpoints.
    pub(super) uninstrumented: Uninstrumented,
    /// The scenario of the runs.
    pub(super) scenario: &'a Scenario,
    /// The scenario's machine, with HAL or without.
    pub(super) machine: &'a Machine,
    /// The files of the program.
    pub(super) source: &'a Source,
}

/// Which programs also run without checkpoints, to check that observation changes nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Uninstrumented {
    /// One in [`PROGRAMS_PER_SAMPLE`], always the same ones, and those whose outcome cannot be determined in another
    /// way.
    Sample,
    /// All.
    All,
}

/// How the process of a run is started.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum From {
    /// A start of its own.
    Start,
    /// A fork of a started process; a start of its own if forking is not possible.
    Fork,
}

/// The output of the runs.
#[derive(Debug)]
pub(super) struct Observed {
    /// The plan of the checkpoints.
    pub(super) plan: Plan,
    /// How the run under observation stopped, and its error output.
    pub(super) output: Output,
    /// Its calls, texts and checkpoints.
    pub(super) lines: Vec<Line>,
    /// Whether an error stopped the program.
    pub(super) refused: bool,
    /// Error output of the run without checkpoints, with the line numbers of the program; empty if there was no such
    /// run.
    pub(super) plain_stderr: String,
    /// Numbered parameters that are not zero at the end.
    pub(super) parameters: BTreeMap<u32, f64>,
    /// The output after the program's end, if it reached its end.
    pub(super) after_end: Option<Checkpoint>,
    /// Whether the program was stopped before a supposed end that did not end it when it was entered by hand.
    pub(super) stopped_before_no_end: bool,
}

impl Session<'_> {
    /// Runs the program under observation and, if needed or requested, without; both must do the same.
    ///
    /// # Errors
    /// The program could not be run, its output was not understood, or it differs under observation.
    pub(super) fn observe(&self) -> Result<Observed, HarnessError> {
        let mut ends = Ends::new(self.source, self.scenario.program.block_delete);
        let mut observed = self.run_instrumented(&ends)?;
        // A block that looks like an end, and is not one, is executed in the program instead.
        while observed.stopped_before_no_end && ends.count() > 0 {
            let last =
                last_checkpoint(&observed.lines).map_or((0, 0), |last| (last.file, last.line));
            let others = ends.without(self.source.line(last.0, last.1 + 1));
            ends = if others.count() < ends.count() { others } else { Ends::default() };
            observed = self.run_instrumented(&ends)?;
        }
        let end_entered_anyway = observed.refused && !ends.has_substitutions();
        let exited = matches!(observed.output.stop, Stop::Exited(_));
        if exited && (end_entered_anyway || self.needs_plain(&observed)) {
            self.run_plain(&mut observed)?;
        }
        Ok(observed)
    }

    /// Whether the run without checkpoints is needed: the parameters of a sub no longer exist after an error has
    /// stopped the program, and line numbers count checkpoint lines, too.
    fn needs_plain(&self, observed: &Observed) -> bool {
        let in_sub =
            last_checkpoint(&observed.lines).is_some_and(|last| last.mode("_call_level") > 0);
        let message = refusal::message(&observed.output.stderr).unwrap_or_default();
        let may_tell_line = message.contains(|c: char| c.is_ascii_digit());
        self.uninstrumented == Uninstrumented::All
            || in_sub
            || self.source.names_line()
            || self.source.end_of_compensated_path().is_some()
            || (observed.refused && may_tell_line)
            || self.is_sampled()
    }

    /// Whether this program is one of the sample.
    fn is_sampled(&self) -> bool {
        let bytes = self.source.all().flat_map(|(_, _, line)| line.bytes());
        let digest =
            bytes.fold(0_u64, |sum, byte| sum.wrapping_mul(31).wrapping_add(u64::from(byte)));
        digest.is_multiple_of(PROGRAMS_PER_SAMPLE)
    }

    /// Runs the program with checkpoints. No checkpoint is reached after the program's end. An error therefore stops
    /// the program before its last block, without ending the interpreter; that block and a checkpoint are entered by
    /// hand.
    ///
    /// The program runs again if it wrote a parameter that no checkpoint printed.
    fn run_instrumented(&self, ends: &Ends) -> Result<Observed, HarnessError> {
        let mut more = BTreeSet::new();
        loop {
            let plan = Plan::new(self.source, &more);
            let input = plan.mdi_checkpoint(ends);
            let text = |file: usize, lines: &[String]| plan.with_checkpoints(file, lines, ends);
            let (output, workspace) = self.run(From::Fork, MANUAL_INPUT, &input, text)?;
            let exited = matches!(output.stop, Stop::Exited(_));
            let parameters =
                if exited { workspace.read_parameters(PARAMETERS)? } else { BTreeMap::new() };
            let is_unseen = |number: &u32| {
                let shown = plan.parameters.contains(&number.to_string());
                is_plain(*number) && *number != DEBUG_SWITCH && !shown
            };
            let unseen: BTreeSet<_> = parameters.keys().copied().filter(is_unseen).collect();
            if !self.source.parameters().indirect || unseen.is_subset(&more) {
                return observed(plan, output, parameters);
            }
            more.extend(unseen);
        }
    }

    /// Runs the unchanged program, and takes the parameters at the end from this run.
    fn run_plain(&self, observed: &mut Observed) -> Result<(), HarnessError> {
        let plain =
            |_: usize, lines: &[String]| lines.iter().map(|line| format!("{line}\n")).collect();
        let sampled = self.uninstrumented == Uninstrumented::All || self.is_sampled();
        let from = if sampled { From::Start } else { From::Fork };
        let (output, workspace) = self.run(from, &[], "", plain)?;
        let exited = matches!(output.stop, Stop::Exited(_));
        let lines = output::lines(&output.stdout, &observed.plan, !exited)?;
        if self.source.names_line() {
            output::adopt(&mut observed.lines, &lines);
        }
        if exited {
            observed.parameters = workspace.read_parameters(PARAMETERS)?;
        }
        let end = |refused: bool, stderr: &str| [format!("{refused} {:?}", kinds(stderr))];
        let with = output::calls_and_texts(&observed.lines)
            .into_iter()
            .chain(end(observed.refused, &observed.output.stderr));
        let refused = matches!(output.stop, Stop::Exited(status) if status != 0);
        let without =
            output::calls_and_texts(&lines).into_iter().chain(end(refused, &output.stderr));
        match with.zip(without).find(|(with, without)| with != without) {
            None => {
                observed.plain_stderr = output.stderr;
                Ok(())
            }
            Some((observed, unobserved)) => {
                Err(HarnessError::ObservationDisturbs { observed, unobserved })
            }
        }
    }

    /// One run of the files that `text` makes of the program's.
    pub(super) fn run(
        &self,
        from: From,
        how: &[&str],
        input: &str,
        text: impl Fn(usize, &[String]) -> String,
    ) -> Result<(Output, Workspace), HarnessError> {
        let workspace = Workspace::in_memory("rs274")?;
        workspace.write_machine(self.machine, &self.source.listed())?;
        for (file, (name, lines)) in self.source.files().iter().enumerate() {
            workspace.write(name, text(file, lines))?;
        }
        let start = self.start(how);
        let forked = match from {
            From::Fork => {
                let forked = self.servers.run(self.program, &start, workspace.path());
                forked.map(|(fork, streams)| Run { process: Process::Forked(fork), streams })
            }
            From::Start => None,
        };
        let is_forked = forked.is_some();
        let run = match forked {
            Some(run) => run,
            None => self.program.run(&start.arguments, workspace.path())?,
        };
        match run.watch(input, self.limits) {
            Err(HarnessError::NotRun(_)) if is_forked => self.run(From::Start, how, input, text),
            output => Ok((output?, workspace)),
        }
    }

    /// What the controller is started with.
    fn start(&self, how: &[&str]) -> Start {
        let mut arguments: Vec<OsString> = vec!["-g".into()];
        arguments.extend(["-i", INI, "-t", TOOLS, "-v", PARAMETERS].map(OsString::from));
        if self.scenario.program.block_delete {
            arguments.push("-b".into());
        }
        arguments.extend(how.iter().map(OsString::from));
        arguments.push(Program::MAIN.into());
        Start { arguments, tools: tool_table(self.machine) }
    }
}

/// Takes apart what the program did itself and what was entered by hand.
fn observed(
    plan: Plan,
    mut output: Output,
    parameters: BTreeMap<u32, f64>,
) -> Result<Observed, HarnessError> {
    let exited = matches!(output.stop, Stop::Exited(_));
    let errors: Vec<_> = output.stderr.lines().collect();
    let stopped = errors.iter().rposition(|line| *line == BY_HAND);
    let own_stop = plan.stop();
    let at_end = stopped.is_some_and(|at| errors[..at].last() == Some(&own_stop.as_str()));
    if let Some(at) = stopped {
        output.stderr = errors[..at].join("\n");
    }
    let sign = plan.mdi_sign();
    let is_sign = |line: &&str| line.trim_end() == sign;
    let printed = output.stdout.split_inclusive('\n');
    let kept: String = match stopped {
        None => printed.collect(),
        Some(_) if at_end => printed.filter(|line| !is_sign(line)).collect(),
        Some(_) => printed.take_while(|line| !is_sign(line)).collect(),
    };
    let mut lines = output::lines(&kept, &plan, !exited)?;
    let last = lines.iter().rposition(|line| matches!(line, Line::Checkpoint(_)));
    let after_end = match last.filter(|_| at_end).map(|at| lines.remove(at)) {
        Some(Line::Checkpoint(checkpoint)) => Some(*checkpoint),
        _ => None,
    };
    let is_end = |line: &Line| matches!(line, Line::Call(call) if call.name == "PROGRAM_END");
    Ok(Observed {
        stopped_before_no_end: at_end && !lines.iter().any(is_end),
        refused: stopped.is_some() && !at_end,
        plain_stderr: String::new(),
        plan,
        output,
        lines,
        parameters,
        after_end,
    })
}

/// The last checkpoint of a run.
fn last_checkpoint(lines: &[Line]) -> Option<&Checkpoint> {
    lines.iter().rev().find_map(|line| match line {
        Line::Checkpoint(checkpoint) => Some(checkpoint.as_ref()),
        Line::Call(_) | Line::Text(_) | Line::Passed => None,
    })
}

/// The kinds of fault that an error output names: its words may hold a line number, which checkpoints change.
fn kinds(stderr: &str) -> Vec<FaultKind> {
    stderr.lines().take(2).filter_map(faults::kind).collect()
}
