//! LinuxCNC's stand-alone interpreter `rs274`, version 2.9.
//!
//! `rs274` prints canonical calls and error messages, but neither blocks nor modes. The program therefore runs with
//! checkpoint lines after each line (`instrument`), which print the place and the modes. A sample of the programs, or
//! all, run again without checkpoints, to check that observation changes nothing (`session`). A run is a fork of a
//! started process (`fork`). Programs of the sample run in processes of their own, which checks forking, too. Calls
//! become settings and effects (`canon`), checkpoints the rest of the state (`state`), and the error message a fault
//! (`refusal`, `faults`).
//!
//! Not observable: the tool length mode apart from the offset, F in inverse time mode (it is computed from the moves),
//! and everything that `rs274` stubs: pins, inputs, probing, user-defined codes, pauses, M99 in the main program.

mod assemble;
mod canon;
mod command;
mod fork;
mod hal;
mod inches;
mod output;
mod process;
mod python;
mod session;
mod streams;
mod supports;
mod version;
mod waiting;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::time::Duration;

use gaugeblock_adapter::{Adapter, ControllerError, HarnessError};
use gaugeblock_compare::Capabilities;
use gaugeblock_vocabulary::{Effect, LengthUnit, Outcome, Rs274State, Scenario, Settings};

use crate::instrumentation::source::Source;
use assemble::CapturedRun;
use command::Started;
use fork::Servers;
use hal::Hal;
pub use inches::in_inches;
use process::Limits;
use python::Home;
use session::{Session, Uninstrumented};
use streams::Stop;

/// Wall time and output of one run; ordinary ones take ten milliseconds and some kilobytes.
const LIMITS: Limits = Limits { time: Duration::from_secs(10), bytes: 64 << 20 };

/// Calls have four decimals, and checkpoints show a value below a ten-thousandth as zero.
const RESOLUTION: f64 = 1.0e-4;

/// Lengths that are printed when they are set and not when the length unit changes: set in inches, they have the error
/// of inches.
const CARRIED: &[&str] = &[
    "feed_rate",
    "blend_tolerance",
    "naive_cam_tolerance",
    "g5x_offset",
    "g92_offset",
    "tool_offset",
];

/// Exit status of a refused program.
const REFUSED: i32 = 1;

/// Fields that the output does not show.
const HIDDEN_FIELDS: &[&str] = &["tool_length", "controller_mode"];

/// Effects that the output does not show, or not all of.
const HIDDEN_EFFECTS: &[&str] = &[
    "set_tool_entry",
    "prompt_tool",
    "wait_input",
    "user_code",
    "controller_mode",
    "request_refused",
    "probe_log_open",
    "probe_log_close",
];

/// The controller.
#[derive(Debug)]
pub struct Rs274 {
    binary: PathBuf,
    python: Option<Home>,
    servers: Servers,
    capabilities: Capabilities,
    limits: Limits,
    uninstrumented: Uninstrumented,
}

impl Rs274 {
    /// Finds the binary, at `path` or on the search path, and queries its version.
    ///
    /// # Errors
    /// It is missing, does not run, or is not of version 2.9.
    pub fn find(path: Option<&Path>) -> Result<Self, ControllerError> {
        let binary = version::find(path)?;
        let (version, python) = version::query(&binary, LIMITS)?;
        let capabilities = capabilities(version);
        Ok(Self {
            binary,
            python,
            servers: Servers::new(),
            capabilities,
            limits: LIMITS,
            uninstrumented: Uninstrumented::Sample,
        })
    }

    /// What is started.
    fn program(&self) -> Started<'_> {
        Started { binary: &self.binary, python: self.python.as_ref().map(Home::path) }
    }
}

impl Adapter for Rs274 {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    /// Stored data of a millimetre machine stay hidden: this controller stores inches. Where a program asks for the
    /// number of a line, checkpoints change what it computes, and where its moves lead. F under inverse time is had
    /// from the text, or back from the moves, if they lead anywhere.
    fn observables(&self, scenario: &Scenario) -> Capabilities {
        let mut observables = self.capabilities.clone();
        let source = Source::new(&scenario.program);
        if source.names_line() {
            observables.fields.remove("position");
        }
        if source.has_code(&["g93"]) && source.computes_word('f') {
            observables.fields.remove("feed_rate");
            observables.fields_at_effects.remove("feed_rate");
        }
        if source.has_code(&["g20"]) {
            let coarser = observables.resolution * 25.4;
            observables
                .unconverted_lengths
                .extend(CARRIED.iter().map(|field| ((*field).to_owned(), coarser)));
        }
        if scenario.machine.length_unit == LengthUnit::Millimetre {
            observables.hidden_parameters.extend([5161..=5219, 5221..=5390]);
        }
        observables
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        supports::supports(scenario)
    }

    fn observables_vary(&self) -> bool {
        true
    }

    fn files(&self) -> Vec<PathBuf> {
        vec![self.binary.clone()]
    }

    fn own_edition(&self) -> Option<&str> {
        Some("linuxcnc-2.9")
    }

    fn observed_edition(&self) -> Option<&str> {
        Some("rs274-2.9-observed")
    }

    fn check_observation(&mut self) {
        self.uninstrumented = Uninstrumented::All;
    }

    fn notes(&self) -> Vec<String> {
        self.servers.trouble().into_iter().collect()
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        // What is refused here could reach the host: it must not run even if nobody asked before.
        self.supports(scenario).map_err(HarnessError::NotRun)?;
        let source = Source::new(&scenario.program);
        let hal = Hal::of(&source).map_err(|error| HarnessError::NotRun(error.to_string()))?;
        let machine = hal.machine(&scenario.machine);
        let session = Session {
            program: self.program(),
            servers: &self.servers,
            limits: self.limits,
            uninstrumented: self.uninstrumented,
            scenario,
            machine: &machine,
            source: &source,
        };
        let observed = match session.observe() {
            Err(HarnessError::ObservationDisturbs { .. }) if source.names_line() => {
                return Ok(assemble::decided_by_line(&source));
            }
            Err(disturbs @ HarnessError::ObservationDisturbs { .. }) => {
                let block = source.end_of_compensated_path().ok_or(disturbs)?;
                return Ok(assemble::put_out_before_end(block));
            }
            observed => observed?,
        };
        let status = match observed.output.stop {
            Stop::Exited(status) => Some(status),
            Stop::TimedOut | Stop::Flooded => None,
        };
        if let Some(status) = status.filter(|status| ![0, REFUSED].contains(status)) {
            return Err(HarnessError::Crashed {
                status: format!("exit status {status}"),
                stderr: observed.output.stderr_tail(),
            });
        }
        let seen = CapturedRun {
            lines: &observed.lines,
            stderr: &observed.output.stderr,
            plain_stderr: &observed.plain_stderr,
            refused: observed.refused,
            cut_off: status.is_none(),
            after_end: observed.after_end.as_ref(),
            parameters: status.is_some().then_some(&observed.parameters),
        };
        let parameters =
            status.is_some().then(|| hidden_parameters(scenario, &observed.parameters));
        let outcome = assemble::outcome(scenario, &source, &observed.plan, &seen, parameters);
        match (outcome, observed.output.stop) {
            (Err(_), Stop::TimedOut) => {
                Err(HarnessError::TimedOut { seconds: self.limits.time.as_secs() })
            }
            (Err(_), Stop::Flooded) => Err(HarnessError::Flooded { bytes: self.limits.bytes }),
            (outcome, _) => outcome,
        }
    }
}

/// Parameters at the end, without those of probing, which are not stored, those that only repeat position and tool,
/// and without stored lengths on a machine whose unit is not the one in which this controller stores them.
fn hidden_parameters(scenario: &Scenario, parameters: &BTreeMap<u32, f64>) -> BTreeMap<u32, f64> {
    let inch = scenario.machine.length_unit == LengthUnit::Inch;
    let shown = |number: &u32| match *number {
        5061..=5070 | 5400..=5428 => false,
        5220 => true,
        5161..=5390 => inch,
        _ => true,
    };
    parameters
        .iter()
        .filter(|(number, _)| shown(number))
        .map(|(number, value)| (*number, *value))
        .collect()
}

fn capabilities(version: String) -> Capabilities {
    let owned = |names: &[&str], hidden: &[&str]| -> BTreeSet<String> {
        names.iter().filter(|name| !hidden.contains(name)).map(|name| (*name).to_owned()).collect()
    };
    let fields = [Settings::FIELDS, Rs274State::FIELDS].concat();
    Capabilities {
        name: "rs274".to_owned(),
        version,
        resolution: RESOLUTION,
        relative_resolution: 0.0,
        unconverted_lengths: BTreeMap::new(),
        fields: owned(&fields, HIDDEN_FIELDS),
        reports_all_fields: false,
        effects: owned(Effect::NAMES, HIDDEN_EFFECTS),
        moves_in_place: true,
        blocks: true,
        refuses: true,
        faults_have_blocks: true,
        faults_have_kinds: true,
        final_parameters: true,
        fields_at_effects: owned(Settings::FIELDS, HIDDEN_FIELDS),
        hidden_parameters: vec![5061..=5070, 5400..=5428],
        pins: BTreeSet::new(),
        pin_period: 0.0,
    }
}

#[cfg(test)]
mod tests;
