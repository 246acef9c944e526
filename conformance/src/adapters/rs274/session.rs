//! The runs that one outcome takes: under observation, without, and beyond the end.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsString;
use std::path::Path;

use gaugeblock_trace::{FaultKind, Program, Scenario};

use super::output::{self, Line};
use super::process::{self, Limits, Output, Stop};
use crate::adapters::HarnessError;
use crate::adapters::probing::faults;
use crate::adapters::probing::instrument::{Plan, is_plain};
use crate::adapters::probing::probe::Probe;
use crate::adapters::probing::source::{DEBUG_SWITCH, Form, Source, form};
use crate::adapters::probing::workspace::{INI, PARAMETERS, TOOLS, Workspace};

/// One scenario on one binary.
#[derive(Debug)]
pub(super) struct Session<'a> {
    /// The binary.
    pub(super) binary: &'a Path,
    /// What each run may cost.
    pub(super) limits: Limits,
    /// What is run.
    pub(super) scenario: &'a Scenario,
    /// Its files.
    pub(super) source: &'a Source,
}

/// What the runs showed.
#[derive(Debug)]
pub(super) struct Observed {
    /// What the probes print.
    pub(super) plan: Plan,
    /// How the run under observation stopped, and its error output.
    pub(super) output: Output,
    /// Its calls, texts and probes.
    pub(super) lines: Vec<Line>,
    /// Error output of the run without probes, whose line numbers are those of the program; empty without such a run.
    pub(super) plain_stderr: String,
    /// Numbered parameters that are not zero at the end.
    pub(super) parameters: BTreeMap<u32, f64>,
    /// What was shown after the program's end, if it reached its end.
    pub(super) after_end: Option<Probe>,
}

impl Session<'_> {
    /// Runs the program under observation and without; both must do the same.
    ///
    /// # Errors
    /// It could not be run, was not understood, or did something else under observation.
    pub(super) fn observe(&self) -> Result<Observed, HarnessError> {
        let mut observed = self.run_probed()?;
        let Stop::Exited(status) = observed.output.stop else { return Ok(observed) };
        let last = observed.lines.iter().rev().find_map(|line| match line {
            Line::Probe(probe) => Some(probe.as_ref().clone()),
            Line::Call(_) | Line::Text(_) => None,
        });
        let beyond = match last.filter(|_| status == 0) {
            Some(last) => self.run_beyond(&observed.plan, &last)?,
            None => None,
        };
        if let Some(beyond) = beyond {
            observed.after_end = Some(beyond.probe);
            // That run had no probes before the end, and so has answered for the plain run.
            if beyond.in_main
                && !self.source.names_line()
                && beyond.doings == output::doings(&observed.lines)
            {
                observed.parameters = beyond.parameters;
                return Ok(observed);
            }
        }
        self.run_plain(&mut observed)?;
        Ok(observed)
    }

    /// The run with probes; once more where it turns out that a parameter was written that no probe showed.
    fn run_probed(&self) -> Result<Observed, HarnessError> {
        let mut more = BTreeSet::new();
        loop {
            let plan = Plan::new(self.source, &more);
            let (output, workspace) = self.run(&[], "", |file, lines| plan.probed(file, lines))?;
            let exited = matches!(output.stop, Stop::Exited(_));
            let parameters = if exited { workspace.read_parameters()? } else { BTreeMap::new() };
            let is_unseen = |number: &u32| {
                let shown = plan.parameters.contains(&number.to_string());
                is_plain(*number) && *number != DEBUG_SWITCH && !shown
            };
            let unseen: BTreeSet<_> = parameters.keys().copied().filter(is_unseen).collect();
            if !self.source.parameters().indirect || unseen.is_subset(&more) {
                let lines = output::lines(&output.stdout, &plan, !exited)?;
                return Ok(Observed {
                    plan,
                    output,
                    lines,
                    parameters,
                    plain_stderr: String::new(),
                    after_end: None,
                });
            }
            more.extend(unseen);
        }
    }

    /// The run as the program stands. What it leaves in the parameters counts.
    fn run_plain(&self, observed: &mut Observed) -> Result<(), HarnessError> {
        let plain =
            |_: usize, lines: &[String]| lines.iter().map(|line| format!("{line}\n")).collect();
        let (output, workspace) = self.run(&[], "", plain)?;
        let exited = matches!(output.stop, Stop::Exited(_));
        let lines = output::lines(&output.stdout, &observed.plan, !exited)?;
        if self.source.names_line() {
            output::adopt(&mut observed.lines, &lines);
        }
        if exited {
            observed.parameters = workspace.read_parameters()?;
        }
        let end = |output: &Output| [format!("{:?} {:?}", output.stop, kinds(&output.stderr))];
        let with = output::doings(&observed.lines).into_iter().chain(end(&observed.output));
        let without = output::doings(&lines).into_iter().chain(end(&output));
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

    /// Beyond the program's end no probe is reached: the program is stopped by an error before its last block, with its
    /// state alive; that block and a probe are then entered by hand.
    fn run_beyond(&self, plan: &Plan, last: &Probe) -> Result<Option<Beyond>, HarnessError> {
        let block = self.source.line(last.file, last.line + 1);
        if form(block) != Form::End {
            return Ok(None);
        }
        let block = block.trim_start().trim_start_matches('/');
        let input = format!("{block}\n{}quit\n", plan.probe(0, 0));
        let stop = |file: usize, lines: &[String]| {
            let after = if file == last.file { last.line } else { u32::MAX };
            plan.stopped(lines, after)
        };
        let (output, workspace) = self.run(&["-n", "1"], &input, stop)?;
        let lines = output::lines(&output.stdout, plan, false)?;
        let doings = output::doings(&lines);
        let probe = lines.into_iter().rev().find_map(|line| match line {
            Line::Probe(probe) => Some(*probe),
            Line::Call(_) | Line::Text(_) => None,
        });
        let probe = probe.ok_or_else(|| HarnessError::Unreadable {
            what: "no state after the end".to_owned(),
            line: output.stderr_tail(),
        })?;
        let parameters = workspace.read_parameters()?;
        let in_main = last.mode("_call_level") == 0;
        Ok(Some(Beyond { probe, doings, parameters, in_main }))
    }

    /// One run of the files that `text` makes of the program's.
    fn run(
        &self,
        how: &[&str],
        input: &str,
        text: impl Fn(usize, &[String]) -> String,
    ) -> Result<(Output, Workspace), HarnessError> {
        let workspace = Workspace::new("rs274")?;
        workspace.write_machine(&self.scenario.machine, &self.source.listed())?;
        for (file, (name, lines)) in self.source.files().iter().enumerate() {
            workspace.write(name, &text(file, lines))?;
        }
        let mut arguments: Vec<OsString> = vec!["-g".into()];
        arguments.extend(["-i", INI, "-t", TOOLS, "-v", PARAMETERS].map(OsString::from));
        if self.scenario.program.block_delete {
            arguments.push("-b".into());
        }
        arguments.extend(how.iter().map(OsString::from));
        arguments.push(Program::MAIN.into());
        let output = process::run(self.binary, &arguments, workspace.path(), input, self.limits)?;
        Ok((output, workspace))
    }
}

/// A run up to the last block, that block, and a probe.
struct Beyond {
    probe: Probe,
    doings: Vec<String>,
    parameters: BTreeMap<u32, f64>,
    /// Whether the last block stands in the main program: stopping within a sub leaves the sub, with its parameters.
    in_main: bool,
}

/// The kinds of fault that an error output names: its words may hold a line number, which probes change.
fn kinds(stderr: &str) -> Vec<FaultKind> {
    stderr.lines().take(2).filter_map(faults::kind).collect()
}
