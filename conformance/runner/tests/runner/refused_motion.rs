//! Cases of motion whose program the controller refuses.

use std::num::NonZero;

use gaugeblock_adapter::{Adapter, HarnessError, MotionRequest, NoSamples};
use gaugeblock_compare::Capabilities;
use gaugeblock_controllers::Production;
use gaugeblock_runner::certify::{Plan, Scope, Verdict, certify};
use gaugeblock_suite::Suite;
use gaugeblock_vocabulary::motion::Samples;
use gaugeblock_vocabulary::{BlockLocation, End, Fault, Outcome, Program, Scenario};

/// What a controller answers to a request for samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Recording {
    /// The samples of another program.
    Other,
    /// It fails.
    Fails,
    /// It never reports samples.
    Unsupported,
}

/// Production that refuses every program.
#[derive(Debug)]
struct Refusing {
    production: Production,
    recording: Recording,
}

impl Adapter for Refusing {
    fn capabilities(&self) -> &Capabilities {
        self.production.capabilities()
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        self.production.supports(scenario)
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        let mut outcome = self.production.run(scenario)?;
        let block = Some(BlockLocation::new(Program::MAIN, 1));
        let message = "error:20".to_owned();
        outcome.end = End::Fault(Fault { kind: None, block, span: None, message });
        Ok(outcome)
    }

    fn record_motion(&self, motion: &MotionRequest<'_>) -> Result<Samples, NoSamples> {
        match self.recording {
            Recording::Other => {}
            Recording::Fails => {
                return Err(NoSamples::Failed(HarnessError::NotRun("no samples".to_owned())));
            }
            Recording::Unsupported => {
                return Err(NoSamples::Unsupported("it reports no servo samples".to_owned()));
            }
        }
        let mut scenario = motion.scenario.clone();
        scenario.program.main = "g21 g90 f100\ng1 x0.01\nm2\n".to_owned();
        self.production.record_motion(&MotionRequest { scenario: &scenario, ..*motion })
    }
}

#[test]
fn refused_program_of_a_motion_case_is_a_refusal_and_names_its_law() {
    let suite = Suite::read(&gaugeblock_embedded_suite::files().expect("the suite"))
        .unwrap_or_else(|errors| panic!("{}", errors.join("\n")));
    let edition = suite.edition("linuxcnc-2.9").expect("an edition of the suite");
    let only = ["trajectory.ends".to_owned()];
    for recording in [Recording::Other, Recording::Fails, Recording::Unsupported] {
        let controller = Refusing { production: Production::default(), recording };
        let plan = Plan {
            suite: &suite,
            edition,
            only: &only,
            jobs: NonZero::<usize>::MIN,
            scope: Scope::Full,
        };
        let run = certify(plan, &controller, &|| {});
        let mut refused = 0;
        for result in &run.cases {
            if let Verdict::Diverges(divergence) = &result.verdict {
                let (asserted, found) = divergence.assertion.clone().expect("an assertion");
                assert!(asserted.starts_with("trajectory."), "{asserted}");
                assert_eq!(found, "the program is refused at main.ngc:1: error:20");
                refused += 1;
            }
        }
        let verdicts: Vec<_> = run.cases.iter().map(|case| &case.verdict).collect();
        // A controller without samples is not tested about motion, whatever it refuses.
        assert_eq!(refused > 0, recording != Recording::Unsupported, "{recording:?}: {verdicts:?}");
    }
}
