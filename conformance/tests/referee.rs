//! The referee itself: it does not trust a controller, and its verdict does not depend on the order of work.

use std::num::NonZero;

use gaugeblock::adapters::reference::Reference;
use gaugeblock::adapters::{Adapter, Capabilities, HarnessError};
use gaugeblock::certify::{Plan, Run, Verdict, certify};
use gaugeblock::expectations::{Expectations, Trouble};
use gaugeblock::report::{Report, json, junit, terminal};
use gaugeblock::suite::{Suite, files};
use gaugeblock_trace::{Effect, Event, Outcome, Scenario};

/// The model with one fault planted.
#[derive(Debug)]
struct Faulty {
    model: Reference,
    fault: fn(Outcome) -> Result<Outcome, HarnessError>,
}

impl Adapter for Faulty {
    fn capabilities(&self) -> &Capabilities {
        self.model.capabilities()
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        self.model.supports(scenario)
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        (self.fault)(self.model.run(scenario)?)
    }
}

fn suite() -> Suite {
    Suite::read(&files::built_in()).unwrap_or_else(|errors| panic!("{}", errors.join("\n")))
}

fn run<'a>(suite: &'a Suite, controller: &dyn Adapter, only: &'a [String], jobs: usize) -> Run<'a> {
    let edition = suite.edition("linuxcnc-2.9").expect("an edition of the suite");
    let jobs = NonZero::new(jobs).expect("at least one");
    certify(Plan { suite, edition, only, jobs }, controller, &|| {})
}

fn diverging(run: &Run<'_>) -> usize {
    run.cases.iter().filter(|result| matches!(result.verdict, Verdict::Diverges(_))).count()
}

fn faulty(fault: fn(Outcome) -> Result<Outcome, HarnessError>) -> Faulty {
    Faulty { model: Reference::default(), fault }
}

#[test]
fn the_order_of_work_changes_nothing() {
    let suite = suite();
    let only = ["saved-state".to_owned()];
    let text = |jobs| {
        let run = run(&suite, &Reference::default(), &only, jobs);
        let model = Reference::default();
        let report = Report { run: &run, controller: model.capabilities(), troubles: None };
        (
            terminal::terminal(&report, true),
            json::json(&report),
            junit::junit(&report).expect("XML"),
        )
    };
    assert_eq!(text(1).0, text(3).0);
    assert_eq!(text(1).1, text(2).1);
}

#[test]
fn a_crash_is_no_pass_and_the_report_is_complete() {
    let suite = suite();
    let only = ["saved-state".to_owned()];
    let crashing = faulty(|_| {
        Err(HarnessError::Crashed { status: "signal 11".to_owned(), stderr: String::new() })
    });
    let run = run(&suite, &crashing, &only, 2);
    assert!(run.cases.iter().all(|result| matches!(result.verdict, Verdict::NotJudged(_))));
    let report = Report { run: &run, controller: crashing.capabilities(), troubles: None };
    assert_eq!(report.exit_status(), 3);
}

#[test]
fn a_move_left_out_is_found() {
    let suite = suite();
    let only = ["motion".to_owned()];
    let lazy = faulty(|mut outcome| {
        for step in &mut outcome.steps {
            step.events.retain(|event| !matches!(event, Event::Do(Effect::StraightFeed { .. })));
        }
        Ok(outcome)
    });
    assert!(diverging(&run(&suite, &lazy, &only, 2)) > 0);
}

#[test]
fn a_setting_repeated_is_no_difference() {
    let suite = suite();
    let only = ["feed".to_owned()];
    let wordy = faulty(|mut outcome| {
        for step in &mut outcome.steps {
            step.events = step.events.drain(..).flat_map(|event| [event.clone(), event]).collect();
            let mut last = None;
            step.events.retain(|event| {
                let repeated_effect = matches!(event, Event::Do(_)) && last.as_ref() == Some(event);
                last = if repeated_effect { None } else { Some(event.clone()) };
                !repeated_effect
            });
        }
        Ok(outcome)
    });
    assert_eq!(diverging(&run(&suite, &wordy, &only, 2)), 0);
}

#[test]
fn expectations_are_strict() {
    let suite = suite();
    let only = ["coolant".to_owned()];
    let dry = faulty(|mut outcome| {
        for step in &mut outcome.steps {
            for event in &mut step.events {
                if let Event::Set(settings) = event {
                    settings.flood = None;
                }
            }
        }
        Ok(outcome)
    });
    let seen = run(&suite, &dry, &only, 1);
    assert!(diverging(&seen) > 0, "flood is left off");
    let listed = Expectations::of(&seen, "reference", "0");
    assert_eq!(Expectations::read(&listed.to_text().expect("TOML")).expect("readable"), listed);
    assert_eq!(listed.hold(&seen, false), [], "exactly what is listed");

    let mut shorter = listed.clone();
    let taken = shorter.known.pop().expect("one is listed");
    let troubles = shorter.hold(&seen, false);
    assert!(
        matches!(&troubles[..], [Trouble::New { rule, .. }] if *rule == taken.rule),
        "{troubles:?}"
    );

    let mut other = listed.clone();
    other.known[0].found = "something else".to_owned();
    assert!(matches!(&other.hold(&seen, false)[..], [Trouble::Changed { .. }]));

    let mended = run(&suite, &Reference::default(), &only, 1);
    assert_eq!(
        listed.hold(&mended, false).len(),
        listed.known.len(),
        "a mended divergence is stale"
    );

    let mut strange = listed.clone();
    strange.known[0].case = "no such case".to_owned();
    assert!(
        strange.hold(&seen, true).iter().any(|trouble| matches!(trouble, Trouble::Stale { .. }))
    );
}
