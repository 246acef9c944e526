//! Controllers that are wrong now and then, or that declare away what is wrong: none of them gets a certificate.

use std::num::NonZero;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

use gaugeblock_adapter::{Adapter, HarnessError};
use gaugeblock_compare::Capabilities;
use gaugeblock_controllers::Reference;
use gaugeblock_report::terminal::Detail;
use gaugeblock_report::{Header, Report, html, markdown, terminal};
use gaugeblock_runner::certify::{CaseResult, Cause, Plan, Scope, Verdict, certify};
use gaugeblock_runner::shard::Shard;
use gaugeblock_suite::Suite;
use gaugeblock_vocabulary::{
    Axis, BlockLocation, Effect, End, Event, Fault, Outcome, Program, Scenario, State,
};

/// How a controller is wrong.
#[derive(Clone, Copy, Debug)]
enum Behaviour {
    /// In so many of a thousand runs.
    Seldom(u64),
    /// In each run of a session except the first.
    UsedSession,
    /// All coordinates differ by up to this.
    Coordinates(f64),
    /// All values of pins differ by up to this.
    Pins(f64),
}

/// The model, which is right, with answers that are not.
#[derive(Debug)]
struct Proxy {
    model: Reference,
    capabilities: Capabilities,
    behaviour: Behaviour,
    seed: u64,
    runs: AtomicU64,
    /// How many answers were wrong.
    wrong: AtomicUsize,
}

impl Proxy {
    fn new(behaviour: Behaviour, seed: u64, capabilities: Capabilities) -> Self {
        let (runs, wrong) = (AtomicU64::new(0), AtomicUsize::new(0));
        Self { model: Reference::default(), capabilities, behaviour, seed, runs, wrong }
    }

    fn answer(&self, scenario: &Scenario, is_fresh: bool) -> Result<Outcome, HarnessError> {
        let number = self.runs.fetch_add(1, Ordering::Relaxed);
        let mut random = Random(self.seed << 32 | number);
        let mut outcome = self.model.run(scenario)?;
        match self.behaviour {
            Behaviour::Seldom(per_mille) if random.next() % 1000 < per_mille => {
                end_otherwise(&mut outcome);
            }
            Behaviour::Seldom(_) => return Ok(outcome),
            Behaviour::UsedSession if is_fresh || number == 0 => return Ok(outcome),
            Behaviour::UsedSession => end_otherwise(&mut outcome),
            Behaviour::Coordinates(error) => move_coordinates(&mut outcome, &mut random, error),
            Behaviour::Pins(error) => {
                outcome.pins.iter_mut().for_each(|pin| pin.value += random.within(error));
            }
        }
        self.wrong.fetch_add(1, Ordering::Relaxed);
        Ok(outcome)
    }
}

impl Adapter for Proxy {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        self.model.supports(scenario)
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        self.answer(scenario, false)
    }

    fn run_fresh(&self, scenario: &Scenario) -> Option<Result<Outcome, HarnessError>> {
        Some(self.answer(scenario, true))
    }
}

/// Numbers that a seed fixes: `SplitMix64`.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// A number from half the bound to the bound, of either sign.
    fn within(&mut self, bound: f64) -> f64 {
        let part = f64::from(u32::try_from(self.next() >> 33).unwrap_or_default())
            / f64::from(1_u32 << 31);
        let size = bound * (0.5 + part / 2.0);
        if self.next().is_multiple_of(2) { size } else { -size }
    }
}

fn end_otherwise(outcome: &mut Outcome) {
    outcome.end = if matches!(outcome.end, End::Fault(_)) {
        End::ProgramEnd
    } else {
        let block = Some(BlockLocation::new(Program::MAIN, 1));
        End::Fault(Fault { kind: None, block, span: None, message: "no reason".to_owned() })
    };
}

fn move_coordinates(outcome: &mut Outcome, random: &mut Random, error: f64) {
    for step in &mut outcome.steps {
        let ends = step.events.iter_mut().filter_map(|event| {
            let Event::Do(Effect::StraightTraverse { end } | Effect::StraightFeed { end }) = event
            else {
                return None;
            };
            Some(end)
        });
        let state = match &mut step.state {
            Some(State::Rs274(state)) => state.position.as_mut(),
            _ => None,
        };
        for position in ends.chain(state) {
            for axis in Axis::ALL {
                *position.get_mut(*axis) += random.within(error);
            }
        }
    }
}

/// What a caller takes from the report of some chapters on a controller.
fn certified<T>(controller: &Proxy, only: &[&str], look: impl Fn(&Report<'_>) -> T) -> T {
    static SUITE: OnceLock<Suite> = OnceLock::new();
    let suite = SUITE.get_or_init(|| {
        Suite::read(&gaugeblock_embedded_suite::files().expect("the suite")).expect("the suite")
    });
    let edition = suite.edition("linuxcnc-2.9").expect("the edition");
    let only: Vec<String> = only.iter().map(|rule| (*rule).to_owned()).collect();
    let plan =
        Plan { suite, edition, only: &only, jobs: NonZero::<usize>::MIN, scope: Scope::Full };
    let run = certify(plan, controller, &|| {});
    let header = Header::of(plan, controller, Shard::WHOLE);
    let report = Report::of(suite, &run, header);
    look(&report)
}

#[test]
fn controller_that_is_seldom_wrong_is_certified_only_if_it_was_never_seen_to_be() {
    let everything = Capabilities::everything("proxy", "1");
    let (mut seen, mut campaigns) = (0, 0);
    for per_mille in [10, 3, 1] {
        for seed in 0..20 {
            let proxy = Proxy::new(Behaviour::Seldom(per_mille), seed, everything.clone());
            let status = certified(&proxy, &["modal-groups", "feed"], |report| {
                let word =
                    |case: &&CaseResult<'_>| case.verdict.word() == Cause::Nondeterministic.word();
                let named = report.run.cases.iter().filter(word).count();
                (report.exit_status(), named)
            });
            let wrong = proxy.wrong.load(Ordering::Relaxed);
            assert_eq!(status.0 == 0, wrong == 0, "{per_mille} of 1000, seed {seed}: {status:?}");
            assert!(wrong == 0 || status.1 > 0 || status.0 == 1, "{per_mille}, {seed}: {status:?}");
            seen += usize::from(wrong > 0);
            campaigns += 1;
        }
    }
    assert!(seen > 20 && seen < campaigns, "{seen} of {campaigns} campaigns saw it wrong");
}

#[test]
fn controller_that_is_right_on_the_first_run_of_a_session_leaks_state() {
    let everything = Capabilities::everything("proxy", "1");
    let proxy = Proxy::new(Behaviour::UsedSession, 1, everything);
    certified(&proxy, &["feed"], |report| {
        assert_eq!(report.exit_status(), 3);
        let run = report.run;
        let leaks = run.cases.iter().filter(|case| case.leaked_failure.is_some()).count();
        assert!(leaks > run.cases.len() / 2, "{leaks} of {}", run.cases.len());
    });
}

#[test]
fn declared_resolution_buys_no_certificate() {
    let everything = Capabilities::everything("proxy", "1");
    let huge = Capabilities { resolution: 1e300, relative_resolution: 1.0, ..everything.clone() };
    let proxy = Proxy::new(Behaviour::Coordinates(1e6), 1, huge);
    certified(&proxy, &["motion"], |report| assert_ne!(report.exit_status(), 0));
    // Within the bound, the declared resolution hides the difference. A case with such an assertion does not pass.
    let coarse = Capabilities { resolution: 0.1, ..everything };
    let proxy = Proxy::new(Behaviour::Coordinates(0.05), 1, coarse);
    certified(&proxy, &["motion.traverse", "motion.mode-holds"], |report| {
        let run = report.run;
        let passes = run.cases.iter().filter(|case| case.verdict == Verdict::Pass);
        assert!(passes.clone().all(|case| case.compared.unjudged() > 0), "{:?}", run.cases);
        let count = passes.count();
        assert!(count < run.cases.len() / 2);
        let page = html::html(report).expect("a page");
        let texts =
            [terminal::terminal(report, Detail::Findings), markdown::markdown(report), page];
        for text in texts {
            assert!(text.contains(&format!("{count} of them (100.0 %)")), "{text}");
            assert!(text.contains("numbers within 0.1"), "{text}");
        }
    });
}

#[test]
fn declared_clock_buys_no_certificate() {
    let everything = Capabilities::everything("proxy", "1");
    let slow = Capabilities { pin_period: 1e300, ..everything };
    let proxy = Proxy::new(Behaviour::Pins(10.0), 1, slow);
    certified(&proxy, &["coolant", "outputs"], |report| assert_eq!(report.exit_status(), 1));
}
