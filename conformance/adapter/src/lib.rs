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

use gaugeblock_compare::Capabilities;
use gaugeblock_vocabulary::motion::{MotionLimits, MotionScript, Samples};
use gaugeblock_vocabulary::{Options, Outcome, Scenario};

/// A run whose servo samples are asked for.
#[derive(Clone, Copy, Debug)]
pub struct MotionRequest<'a> {
    /// The program and what it depends on.
    pub scenario: &'a Scenario,
    /// What the axes can do.
    pub limits: &'a MotionLimits,
    /// What a person and the inputs do.
    pub script: &'a MotionScript,
    /// The planner is given a segment in so many servo cycles; as many as it takes where nothing is said.
    pub feed_interval: Option<u32>,
}

/// Why there are no samples.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoSamples {
    /// It shows none, or not of such a run.
    Unsupported(String),
    /// It failed.
    Failed(HarnessError),
}

/// What a controller does if it does what it should; it may be found out only when it is looked at.
pub type Expected<'a> = dyn Deref<Target = Outcome> + 'a;

/// A controller under test, behind the vocabulary.
pub trait Adapter: fmt::Debug + Send + Sync {
    /// What it shows.
    fn capabilities(&self) -> &Capabilities;

    /// What it shows of this scenario; less than of others where, say, its stored data have another unit.
    fn observables(&self, scenario: &Scenario) -> Capabilities {
        let _same_for_all = scenario;
        self.capabilities().clone()
    }

    /// Whether it shows less of some scenarios than of others.
    fn observables_vary(&self) -> bool {
        false
    }

    /// Whether it can be held to documents that are read with these options at all.
    ///
    /// # Errors
    /// The reason why not: then none of its scenarios is supported.
    fn accepts_options(&self, options: &Options) -> Result<(), String> {
        let _whatever_they_are = options;
        Ok(())
    }

    /// Whether it can run the scenario at all.
    ///
    /// # Errors
    /// The reason why it cannot; such a case counts as unsupported.
    fn supports(&self, scenario: &Scenario) -> Result<(), String>;

    /// Why there is nothing to judge of the scenario yet, where somebody runs it elsewhere and brings what came of it.
    fn pending(&self, scenario: &Scenario) -> Option<String> {
        let _runs_here = scenario;
        None
    }

    /// Digest of the suite, and the edition, that it has been asked by, where it was asked before: it can be held to
    /// nothing else.
    fn exported_from(&self) -> Option<(&str, &str)> {
        None
    }

    /// Scenarios with equal keys run fastest one after the other, in the order of their keys: a controller with much to
    /// set up can be kept between them.
    fn order_key(&self, scenario: &Scenario) -> String {
        let _in_any_order = scenario;
        String::new()
    }

    /// How many scenarios it best runs at once, where that does not follow from the number of processors.
    fn best_jobs(&self) -> Option<NonZero<usize>> {
        None
    }

    /// From now on each program also runs unobserved, where observing it could change it; otherwise a sample does.
    fn check_observation(&mut self) {}

    /// What a person should know of how it has been run, a sentence each.
    fn notes(&self) -> Vec<String> {
        Vec::new()
    }

    /// Runs the scenario.
    ///
    /// # Errors
    /// There is no outcome to judge: the controller crashed, hung, flooded, or was not understood.
    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError>;

    /// Whether it runs within this process, so that to ask it costs no more than what it does.
    fn is_in_process(&self) -> bool {
        false
    }

    /// Whether it runs in a process of its own, so that what is expected of it is best found out while it does.
    fn is_out_of_process(&self) -> bool {
        false
    }

    /// Runs the scenario, whose outcome is known if the controller does what it should: where it does, the outcome
    /// need not be sent.
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

    /// Told what this thread most likely lets it run next, before that is asked for: a controller in a process of its
    /// own can begin with it while what it did before is judged. What comes of it is known to whoever runs it then,
    /// and to nobody else.
    fn prefetch(&self, scenario: &Scenario) {
        let _when_it_is_run = scenario;
    }

    /// Options of choices that it declares to read the documents by: they configure the specification that it is held
    /// to.
    fn options(&self) -> Options {
        Options::default()
    }

    /// The edition that it is held to where none is named, if it says so itself.
    fn own_edition(&self) -> Option<&str> {
        None
    }

    /// The edition that says what it really does, if there is one.
    fn observed_edition(&self) -> Option<&str> {
        None
    }

    /// Whether it judges samples of others by laws of motion, instead of moving itself.
    fn has_laws_of_motion(&self) -> bool {
        false
    }

    /// What it commands of the axes while it runs a program.
    ///
    /// # Errors
    /// It shows no samples at all or not of such a run, or it fails.
    fn record_motion(&self, motion: &MotionRequest<'_>) -> Result<Samples, NoSamples> {
        let _whatever_it_is = motion;
        Err(NoSamples::Unsupported("it shows no servo samples".to_owned()))
    }

    /// Runs the scenario on a controller that nothing ran on before. None where each run is such a one anyway.
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
        /// What was looked for, and where.
        searched: String,
    },
    /// It is there, but not the version that the adapter understands.
    WrongVersion {
        /// What it says of itself.
        found: String,
        /// What is needed.
        required: &'static str,
    },
    /// It is there, but does not run.
    Broken(HarnessError),
}

impl fmt::Display for ControllerError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing { searched: sought } => write!(f, "controller not found: {sought}"),
            Self::WrongVersion { found, required: wanted } => {
                write!(f, "controller of version {found}, but {wanted} is needed")
            }
            Self::Broken(error) => write!(f, "controller does not run: {error}"),
        }
    }
}

impl std::error::Error for ControllerError {}

/// Why a run has no outcome. Never an outcome, never a pass.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum HarnessError {
    /// The controller could not be started or asked, or its private files not be written.
    NotRun(String),
    /// Nobody has run it: there is no answer, and no fault either.
    Absent(String),
    /// It was ended by a signal, or with a status that it does not document.
    Crashed {
        /// How it ended.
        status: String,
        /// The end of its error output.
        stderr: String,
    },
    /// It did not end in time and was ended.
    TimedOut {
        /// Seconds that it had.
        seconds: u64,
    },
    /// It wrote more than it may and was ended.
    Flooded {
        /// Bytes that it may write.
        bytes: usize,
    },
    /// A line of its output was not understood.
    Unreadable {
        /// What is wrong.
        what: String,
        /// The line.
        line: String,
    },
    /// An error message that no row of the fault table explains.
    UnknownMessage(String),
    /// The program did something else while it was observed: the first difference.
    ObservationDisturbs {
        /// What happened under observation.
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
            Self::Crashed { status, stderr } => write!(f, "crashed ({status}): {stderr}"),
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
