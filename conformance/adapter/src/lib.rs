//! Adapters: each turns a scenario into an outcome by running one controller.
//!
//! **Invariant:** an adapter does nothing that an adapter in another language could not do: it knows the vocabulary and
//! its controller, and no model of the language.

pub mod clock;
pub mod exec;
pub mod protocol;
pub mod templates;

use std::fmt;
use std::num::NonZero;
use std::ops::Deref;
use std::path::PathBuf;

use gaugeblock_compare::Capabilities;
use gaugeblock_vocabulary::motion::{MotionLimits, MotionScript, Samples};
use gaugeblock_vocabulary::{Options, Outcome, Scenario};

/// A request for servo samples of a run.
#[derive(Clone, Copy, Debug)]
pub struct MotionRequest<'a> {
    /// The program and what it depends on.
    pub scenario: &'a Scenario,
    /// What the axes can do.
    pub limits: &'a MotionLimits,
    /// What the operator and the inputs do.
    pub script: &'a MotionScript,
    /// Servo cycles between two segments that are sent to the planner. Without it, segments are sent as fast as the
    /// planner accepts them.
    pub feed_interval: Option<u32>,
}

/// Why there are no samples.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoSamples {
    /// It records none, or none of such a run.
    Unsupported(String),
    /// It failed.
    Failed(HarnessError),
}

/// The specified outcome. It is computed when it is first read.
pub type Expected<'a> = dyn Deref<Target = Outcome> + 'a;

/// A controller under test.
pub trait Adapter: fmt::Debug + Send + Sync {
    /// What is observable on the controller.
    fn capabilities(&self) -> &Capabilities;

    /// What is observable when it runs this scenario. It can be less than for other scenarios, for example when stored
    /// data have another unit.
    fn observables(&self, scenario: &Scenario) -> Capabilities {
        let _same_for_all = scenario;
        self.capabilities().clone()
    }

    /// Whether some scenarios expose less than others.
    fn observables_vary(&self) -> bool {
        false
    }

    /// Whether it can be compared with documents that are read with these options.
    ///
    /// # Errors
    /// The reason why not. None of its scenarios is then supported.
    fn accepts_options(&self, options: &Options) -> Result<(), String> {
        let _whatever_they_are = options;
        Ok(())
    }

    /// Whether it can run the scenario at all.
    ///
    /// # Errors
    /// The reason why it cannot; such a case counts as unsupported.
    fn supports(&self, scenario: &Scenario) -> Result<(), String>;

    /// Why the outcome is not available yet. Programs of such a controller run elsewhere; people bring the answers.
    fn pending(&self, scenario: &Scenario) -> Option<String> {
        let _runs_here = scenario;
        None
    }

    /// Digest of the suite and the edition from which its programs were exported. Its answers fit nothing else.
    fn exported_from(&self) -> Option<(&str, &str)> {
        None
    }

    /// Scenarios with equal keys run fastest one after the other, in the order of their keys, because an expensive
    /// setup is reused.
    fn order_key(&self, scenario: &Scenario) -> String {
        let _in_any_order = scenario;
        String::new()
    }

    /// How many scenarios it should run at once, if the number of processors does not decide it.
    fn best_jobs(&self) -> Option<NonZero<usize>> {
        None
    }

    /// Makes each program also run without observation, if observation could change it. Without this call, only a
    /// sample runs so.
    fn check_observation(&mut self) {}

    /// Notes about the run for the report, a sentence each.
    fn notes(&self) -> Vec<String> {
        Vec::new()
    }

    /// The files that decide what it does, such as its binary: their digests identify it. None where they are out of
    /// reach, for example at a socket.
    fn files(&self) -> Vec<PathBuf> {
        Vec::new()
    }

    /// Runs the scenario.
    ///
    /// # Errors
    /// The run has no outcome to judge: the controller crashed, hung, flooded its output, or gave an invalid answer.
    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError>;

    /// Whether it runs in this process, so that a run costs no communication.
    fn is_in_process(&self) -> bool {
        false
    }

    /// Whether it runs in another process, so that the specified outcome is best computed while it runs.
    fn is_out_of_process(&self) -> bool {
        false
    }

    /// Runs the scenario, whose specified outcome is known. If the controller's outcome equals it, it need not be sent.
    ///
    /// # Errors
    /// Those of [`Adapter::run`].
    fn run_expecting(
        &self,
        scenario: &Scenario,
        expected: &Expected<'_>,
    ) -> Result<Outcome, HarnessError> {
        let _sent_anyway = expected;
        self.run(scenario)
    }

    /// Names the scenario that this thread most likely runs next. A controller in another process can begin with it
    /// while the referee judges the previous one. Only the thread that runs the scenario gets the result.
    fn prefetch(&self, scenario: &Scenario) {
        let _when_it_is_run = scenario;
    }

    /// Options of choices that it declares. They configure the specification that it is compared with.
    fn options(&self) -> Options {
        Options::default()
    }

    /// The edition that it is compared with by default, if it names one.
    fn own_edition(&self) -> Option<&str> {
        None
    }

    /// The edition that describes the controller's observed behaviour, if there is one.
    fn observed_edition(&self) -> Option<&str> {
        None
    }

    /// Whether it judges recorded samples by laws of motion instead of moving axes.
    fn has_laws_of_motion(&self) -> bool {
        false
    }

    /// Records the servo samples that it commands while it runs a program.
    ///
    /// # Errors
    /// It records no samples, or none of such a run, or it fails.
    fn record_motion(&self, motion: &MotionRequest<'_>) -> Result<Samples, NoSamples> {
        let _whatever_it_is = motion;
        Err(NoSamples::Unsupported("it reports no servo samples".to_owned()))
    }

    /// Runs the scenario in a fresh session. None if each run has one anyway.
    fn run_fresh(&self, scenario: &Scenario) -> Option<Result<Outcome, HarnessError>> {
        let _always_anew = scenario;
        None
    }
}

/// The controller cannot be used at all.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ControllerError {
    /// It is not installed.
    Missing {
        /// What was searched, and where.
        searched: String,
    },
    /// It is installed, but the adapter does not support its version.
    WrongVersion {
        /// The version that it reports.
        found: String,
        /// The required version.
        required: &'static str,
    },
    /// It does not run.
    Broken(HarnessError),
}

impl fmt::Display for ControllerError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing { searched: sought } => write!(f, "controller not found: {sought}"),
            Self::WrongVersion { found, required: wanted } => {
                write!(f, "controller of version {found}, but {wanted} is needed")
            }
            Self::Broken(HarnessError::NotRun(why)) => write!(f, "controller does not run: {why}"),
            Self::Broken(error) => write!(f, "controller does not run: {error}"),
        }
    }
}

impl std::error::Error for ControllerError {}

/// Why a run has no outcome. Never an outcome, never a pass.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum HarnessError {
    /// The controller could not be started or queried, or its private files could not be written.
    NotRun(String),
    /// The scenario has not been run: the controller neither answered nor failed.
    Absent(String),
    /// A signal ended it, or it exited with an undocumented status.
    Crashed {
        /// How it ended.
        status: String,
        /// The end of its standard error.
        stderr: String,
    },
    /// It did not end in time and was killed.
    TimedOut {
        /// The time limit in seconds.
        seconds: u64,
    },
    /// It wrote more than the limit and was killed.
    Flooded {
        /// The limit in bytes.
        bytes: usize,
    },
    /// A line of its output is not valid.
    Unreadable {
        /// What is wrong.
        what: String,
        /// The line.
        line: String,
    },
    /// An error message that is not in the table of faults.
    UnknownMessage(String),
    /// Observing the program changed what it did. The fields have the first difference.
    ObservationDisturbs {
        /// What happened with probes.
        observed: String,
        /// What happened without.
        unobserved: String,
    },
}

impl fmt::Display for HarnessError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotRun(why) => write!(f, "not run: {why}"),
            Self::Absent(why) => write!(f, "{why}"),
            Self::Crashed { status, stderr } if stderr.trim().is_empty() => {
                write!(f, "ended without an answer ({status}, nothing on stderr)")
            }
            Self::Crashed { status, stderr } => {
                write!(f, "ended without an answer ({status}): {stderr}")
            }
            Self::TimedOut { seconds } => write!(f, "no end after {seconds} s"),
            Self::Flooded { bytes } => write!(f, "more than {bytes} bytes of output"),
            Self::Unreadable { what, line } => write!(f, "unreadable output ({what}): {line}"),
            Self::UnknownMessage(message) => write!(f, "unknown error message: {message}"),
            Self::ObservationDisturbs { observed, unobserved } => write!(
                f,
                "observing changes the run: {observed:?} with probes, {unobserved:?} without"
            ),
        }
    }
}

impl std::error::Error for HarnessError {}
