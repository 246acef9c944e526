//! The referee itself: it does not trust a controller, and its verdict does not depend on the order of work.

use std::num::NonZero;

use gaugeblock_adapter::{Adapter, HarnessError};
use gaugeblock_compare::judge::{Finding, judge};
use gaugeblock_compare::observe::Observed;
use gaugeblock_compare::{Capabilities, compare};
use gaugeblock_controllers::Reference;
use gaugeblock_report::merge::Stored;
use gaugeblock_report::terminal::Detail;
use gaugeblock_report::{Header, Report, html, json, junit, profiles, terminal};
use gaugeblock_runner::certify::{CaseResult, Plan, Run, Scope, Verdict, certify};
use gaugeblock_runner::expectations::{ExpectationMismatch, Expectations};
use gaugeblock_runner::fingerprint::{ObservedOption, fingerprint};
use gaugeblock_runner::shard::Shard;
use gaugeblock_runner::waivers::Waivers;
use gaugeblock_suite::Suite;
use gaugeblock_vocabulary::{BlockLocation, Effect, End, Event, Outcome, Program, Scenario};

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
    Suite::read(&gaugeblock_embedded_suite::files().expect("the suite"))
        .unwrap_or_else(|errors| panic!("{}", errors.join("\n")))
}

fn run<'a>(suite: &'a Suite, controller: &dyn Adapter, only: &'a [String], jobs: usize) -> Run<'a> {
    let edition = suite.edition("linuxcnc-2.9").expect("an edition of the suite");
    let jobs = NonZero::new(jobs).expect("at least one");
    certify(Plan { suite, edition, only, jobs, scope: Scope::Full }, controller, &|| {})
}

fn header(suite: &Suite, controller: &dyn Adapter, only: &[String]) -> Header {
    let edition = suite.edition("linuxcnc-2.9").expect("an edition of the suite");
    let plan = Plan { suite, edition, only, jobs: NonZero::<usize>::MIN, scope: Scope::Full };
    Header::of(plan, controller, Shard::WHOLE)
}

fn diverging(run: &Run<'_>) -> usize {
    run.cases.iter().filter(|result| matches!(result.verdict, Verdict::Diverges(_))).count()
}

/// How many cases differ in anything.
fn differing(run: &Run<'_>) -> usize {
    run.cases.iter().filter(|result| result.verdict.divergence().is_some()).count()
}

fn faulty(fault: fn(Outcome) -> Result<Outcome, HarnessError>) -> Faulty {
    Faulty { model: Reference::default(), fault }
}

/// It reports no effects.
fn silent(mut outcome: Outcome) -> Result<Outcome, HarnessError> {
    outcome.steps.iter_mut().for_each(|step| step.events.clear());
    Ok(outcome)
}

/// It does not have what the program requires.
fn without(outcome: Outcome) -> Result<Outcome, HarnessError> {
    let (block, what) = (BlockLocation::new(Program::MAIN, 1), "it has none".to_owned());
    Ok(Outcome { end: End::Unsupported { block, what }, ..outcome })
}

/// It does not have what it should refuse.
fn without_faults(outcome: Outcome) -> Result<Outcome, HarnessError> {
    if matches!(outcome.end, End::Fault(_)) { without(outcome) } else { Ok(outcome) }
}

#[test]
fn the_order_of_work_changes_nothing() {
    let suite = suite();
    let only = ["saved-state".to_owned()];
    let text = |jobs| {
        let run = run(&suite, &Reference::default(), &only, jobs);
        let model = Reference::default();
        let report = Report::of(&suite, &run, header(&suite, &model, &only));
        (
            terminal::terminal(&report, Detail::Everything),
            json::json(&report),
            junit::junit(&report).expect("XML"),
        )
    };
    assert_eq!(text(1).0, text(3).0);
    assert_eq!(text(1).1, text(2).1);
}

#[test]
fn crash_is_not_a_pass_and_the_report_is_complete() {
    let suite = suite();
    let only = ["saved-state".to_owned()];
    let crashing = faulty(|_| {
        Err(HarnessError::Crashed { status: "signal 11".to_owned(), stderr: String::new() })
    });
    let run = run(&suite, &crashing, &only, 2);
    assert!(run.cases.iter().all(|result| result.verdict.word() == "crash"));
    let report = Report::of(&suite, &run, header(&suite, &crashing, &only));
    assert_eq!(report.exit_status(), 3);
}

#[test]
fn report_has_the_notes_of_the_run() {
    let suite = suite();
    let only = ["saved-state".to_owned()];
    let model = Reference::default();
    let run = run(&suite, &model, &only, 2);
    let report = Report {
        notes: vec!["it was slow".to_owned()],
        ..Report::of(&suite, &run, header(&suite, &model, &only))
    };
    assert_eq!(terminal::terminal(&report, Detail::Findings).matches("it was slow").count(), 1);
    assert_eq!(json::json(&report)["notes"][0], "it was slow");
    assert_eq!(report.exit_status(), 0, "a note is no verdict");
}

#[test]
fn an_unsupported_rule_fails_a_profile_that_is_claimed() {
    let suite = suite();
    let only = ["saved-state".to_owned()];
    let status = |controller: &dyn Adapter, claimed: &[String]| {
        let run = run(&suite, controller, &only, 2);
        let profiles = profiles::profiles(&suite, &run, claimed);
        let passed = profiles.iter().filter(|profile| profile.passes());
        let passed: Vec<_> = passed.map(|profile| profile.profile.id.clone()).collect();
        let header = header(&suite, controller, &only);
        let notes = Vec::new();
        (passed, Report { notes, profiles, ..Report::of(&suite, &run, header) }.exit_status())
    };
    let (modal_save, task) = ("modal-save".to_owned(), "task".to_owned());
    let modest = faulty(without_faults);
    assert_eq!(status(&modest, &[]), (vec![], 0));
    assert_eq!(status(&modest, std::slice::from_ref(&modal_save)), (vec![], 1));
    // Where nothing is judged, a profile need not be claimed.
    let mute = faulty(without);
    assert_eq!(status(&mute, &[]), (vec![], 3));
    assert_eq!(status(&mute, std::slice::from_ref(&modal_save)), (vec![], 1));
    let model = Reference::default();
    assert_eq!(status(&model, std::slice::from_ref(&modal_save)), (vec![modal_save.clone()], 0));
    // What was not run is not passed.
    assert_eq!(status(&model, &[task]), (vec![modal_save], 1));
}

#[test]
fn unsupported_program_is_neither_accepted_nor_refused() {
    let suite = suite();
    let leaves_all_alone = faulty(|mut outcome| {
        let block = BlockLocation::new(Program::MAIN, 1);
        outcome.end = End::Unsupported { block, what: "it has no such code".to_owned() };
        outcome.steps.clear();
        Ok(outcome)
    });
    let edition = suite.edition("linuxcnc-2.9").expect("an edition of the suite");
    let shown = fingerprint(&suite, &suite.options(edition), None, &leaves_all_alone);
    assert!(!shown.is_empty());
    for (choice, shown) in shown {
        assert_eq!(
            shown,
            ObservedOption::NotRun("it has no such code".to_owned()),
            "{}",
            choice.id
        );
    }
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
fn repeated_setting_is_not_a_difference() {
    let suite = suite();
    let only = ["saved-state".to_owned()];
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

/// A run that ends so, with these changes of pins.
fn with_pins(end: &str, changes: &[(f64, &str, f64)]) -> Observed {
    let mut text =
        format!("gaugeblock outcome 0\nlanguage rs274\nstart\nblock main.ngc:1\n{end}\n");
    for (time, pin, value) in changes {
        text.push_str(&format!("pin {pin} time={time} value={value}\n"));
    }
    Observed::of(&Outcome::from_text(&text).unwrap_or_else(|error| panic!("{error}")))
}

#[test]
fn values_of_pins_are_compared_and_their_times_are_not() {
    let end = "end program_end";
    let all = Capabilities::everything("any", "0");
    let expected = with_pins(end, &[(0.0, "digital_out[0]", 1.0), (1.0, "digital_out[0]", 0.0)]);
    let divergence = |found: &Observed, observables: &Capabilities| {
        compare(&expected, found, observables).divergence.map(|divergence| divergence.to_string())
    };
    let late =
        [(2.0, "digital_out[0]", 1.0), (2.5, "digital_out[0]", 1.0), (3.0, "digital_out[0]", 0.0)];
    assert_eq!(divergence(&with_pins(end, &late), &all), None);

    let stuck = with_pins(end, &late[..1]);
    let said = "pin digital_out[0]: expected 1, 0, found 1";
    assert_eq!(divergence(&stuck, &all).as_deref(), Some(said));
    let other = with_pins(end, &[late[0], late[2], (4.0, "coolant_mist", 1.0)]);
    let said = "pin coolant_mist: expected none, found 1";
    assert_eq!(divergence(&other, &all).as_deref(), Some(said));

    let mut blind = all.clone();
    blind.pins.clear();
    let comparison = compare(&expected, &stuck, &all.and(&blind));
    assert!(comparison.divergence.is_none() && comparison.masked.contains("digital_out"));

    let fault = "end fault file=\"main.ngc\" line=2 message=\"\"";
    let refused = compare(&with_pins(fault, &[]), &with_pins(fault, &late), &all);
    assert!(refused.divergence.is_none(), "what a refused block did is unspecified");
}

#[test]
fn missing_field_differs_if_all_fields_are_reported() {
    let run = |state: &str| {
        let text = format!(
            "gaugeblock outcome 0\nlanguage nct\nstart\nblock main.ngc:1\n  state {state}\nend program_end\n"
        );
        Observed::of(&Outcome::from_text(&text).unwrap_or_else(|error| panic!("{error}")))
    };
    let (expected, found) = (run("macro_level=0 motion=feed"), run("macro_level=0"));
    let all = Capabilities::everything("any", "0");
    let said = compare(&expected, &found, &all).divergence.map(|divergence| divergence.to_string());
    assert_eq!(said.as_deref(), Some("main.ngc:1: motion: expected feed, found nothing"));

    let some = Capabilities { reports_all_fields: false, ..all };
    let comparison = compare(&expected, &found, &some);
    assert!(comparison.divergence.is_none() && comparison.masked.contains("motion"));
}

#[test]
fn assertions_on_pins() {
    let all = Capabilities::everything("any", "0");
    let changes = [(0.0, "analog_out[2]", 1.5), (0.0, "analog_out[2]", -1.0)];
    let run = with_pins("end program_end", &changes);
    let finding = |text: &str, observables: &Capabilities| {
        judge(&text.parse().unwrap_or_else(|error| panic!("{text}: {error}")), &run, observables)
    };
    assert_eq!(finding("pin analog_out[2]: 1.5, -1", &all), Finding::Holds);
    assert_eq!(finding("pin analog_out[1]: none", &all), Finding::Holds);
    let found = Finding::Fails("pin analog_out[2]: 1.5, -1".to_owned());
    assert_eq!(finding("pin analog_out[2]: 1.5", &all), found);
    let mut blind = all.clone();
    blind.pins.remove("analog_out");
    assert_eq!(finding("pin analog_out[2]: 7", &blind), Finding::Masked("analog_out".to_owned()));
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
    assert_eq!(listed.compare(&seen, false), [], "exactly what is listed");

    let mut shorter = listed.clone();
    let taken = shorter.known.pop().expect("one is listed");
    let mismatches = shorter.compare(&seen, false);
    assert!(
        matches!(&mismatches[..], [ExpectationMismatch::New { rule, .. }] if *rule == taken.rule),
        "{mismatches:?}"
    );

    let mut other = listed.clone();
    other.known[0].found = "something else".to_owned();
    assert!(matches!(&other.compare(&seen, false)[..], [ExpectationMismatch::Changed { .. }]));

    let mended = run(&suite, &Reference::default(), &only, 1);
    assert_eq!(
        listed.compare(&mended, false).len(),
        listed.known.len(),
        "a mended divergence is stale"
    );

    let mut strange = listed.clone();
    strange.known[0].case = "no such case".to_owned();
    assert!(
        strange
            .compare(&seen, true)
            .iter()
            .any(|mismatch| matches!(mismatch, ExpectationMismatch::Stale { .. }))
    );
}

#[test]
fn the_page_has_what_a_controller_says_as_text() {
    let suite = suite();
    let only = ["inputs".to_owned()];
    let evil = "<script>alert(1)</script>\"' onload=x";
    let controller = faulty(|mut outcome| {
        outcome.steps.truncate(1);
        outcome.end = End::ProgramEnd;
        outcome.steps.iter_mut().for_each(|step| {
            let text = "<img src=x onerror=alert(1)>".to_owned();
            let channel = gaugeblock_vocabulary::Channel::Display;
            step.events.push(Event::Do(Effect::Message { channel, text }));
        });
        Ok(outcome)
    });
    let run = run(&suite, &controller, &only, 2);
    assert!(diverging(&run) > 50, "{}", diverging(&run));
    let header = Header { controller: evil.to_owned(), ..header(&suite, &controller, &only) };
    let notes = vec![evil.to_owned()];
    let profiles = profiles::profiles(&suite, &run, &only);
    let report = Report { notes, profiles, ..Report::of(&suite, &run, header) };
    let page = html::html(&report).expect("a page");
    assert_eq!(page.matches("<script").count(), 1, "the page's own");
    assert!(!page.contains("<img") && page.contains("&lt;img src=x"));
    let named = ["class=\"card row diverges\"", "<li class=\"row\" data-verdict=\"diverges\""];
    let named: usize = named.iter().map(|one| page.matches(one).count()).sum();
    assert_eq!(named, diverging(&run));
    let of_rules = page.matches("<tr class=\"row\"").count();
    assert_eq!(of_rules, report.rules().len());
    for address in ["http:", "https:", "src=\""] {
        assert!(!page.contains(address), "it needs nothing beside it: {address}");
    }
    assert_eq!(page.matches("href=").count(), page.matches("href=\"#").count(), "nor does a link");
}

#[test]
fn the_page_of_a_controller_without_fault_says_so() {
    let suite = suite();
    let only = ["saved-state".to_owned()];
    let model = Reference::default();
    let run = run(&suite, &model, &only, 2);
    let header = header(&suite, &model, &only);
    let report = Report { mismatches: Some(Vec::new()), ..Report::of(&suite, &run, header) };
    let page = html::html(&report).expect("a page");
    assert!(
        page.contains("nothing that is known has changed") && page.contains("Everything was run.")
    );
    assert!(!page.contains("class=\"card row"));
}

#[test]
fn baseline_fails_only_new_and_changed_results() {
    let suite = suite();
    let only = ["coolant".to_owned()];
    let (silent, whole) = (faulty(silent), Reference::default());
    let stored = |controller: &dyn Adapter| {
        let run = run(&suite, controller, &only, 2);
        let header = header(&suite, controller, &only);
        let report = Report::of(&suite, &run, header);
        Stored::read(&json::json(&report).to_string()).expect("a report")
    };
    let (before, after) = (run(&suite, &whole, &only, 2), run(&suite, &silent, &only, 2));
    let (mismatches, mended) = stored(&whole).compare(&after);
    assert_eq!(mismatches.len(), differing(&after));
    assert!(mended.is_empty() && differing(&after) > 10);
    let (mismatches, mended) = stored(&silent).compare(&before);
    assert!(mismatches.is_empty());
    assert_eq!(mended.len(), differing(&after));
    assert_eq!(stored(&silent).compare(&after), (Vec::new(), Vec::new()));

    // Unknown is no pass: what passed and is not judged any more has changed. What departed is neither mended nor
    // broken, and told.
    let without = run(&suite, &faulty(without), &only, 2);
    let (mismatches, told) = stored(&whole).compare(&without);
    assert!(told.is_empty() && mismatches.len() == before.cases.len(), "{told:?}");
    let is_lost = |mismatch: &ExpectationMismatch| {
        let ExpectationMismatch::Changed { listed, found, .. } = mismatch else { return false };
        listed == "pass" && found == "unsupported: it has none"
    };
    assert!(mismatches.iter().all(is_lost), "{}", mismatches[0]);
    let (lost, told) = stored(&silent).compare(&without);
    assert!(lost.iter().all(is_lost));
    assert_eq!(told.len(), diverging(&after));
    assert!(
        told.iter().all(|told| told.contains("not judged any more") && told.contains(": was "))
    );
    assert_eq!(lost.len() + told.len(), before.cases.len());
}

#[test]
fn waiver_needs_owner_reason_and_day() {
    let suite = suite();
    let only = ["coolant".to_owned()];
    let (before, after) =
        (run(&suite, &Reference::default(), &only, 2), run(&suite, &faulty(silent), &only, 2));
    let diverges = |result: &&CaseResult<'_>| matches!(result.verdict, Verdict::Diverges(_));
    let rule = after.cases.iter().find(diverges).expect("a divergence").rule.id.clone();
    let today = "2026-11-23".parse().expect("a day");
    let waiver = |rule: &str, expires: &str| {
        let text = format!(
            "[[waiver]]\nrule = {rule:?}\nreason = \"as agreed\"\nowner = \"Ann\"\nexpires = {expires:?}\n"
        );
        Waivers::read(&text).expect("waivers")
    };
    let of_rule = |mismatches: &[ExpectationMismatch]| {
        mismatches.iter().filter(|mismatch| mismatch.place().0 == rule).count()
    };
    let hold = |waivers: Waivers, run: &Run<'_>| waivers.apply(run, None, today);
    let (left, waived) = hold(waiver(&rule, "2026-11-23"), &after);
    assert_eq!((of_rule(&left), waived.is_empty()), (0, false), "its last day counts");
    let (left, waived) = hold(waiver(&rule, "2026-11-22"), &after);
    assert!(
        waived.is_empty()
            && left.iter().any(|mismatch| mismatch.to_string().contains("which is over"))
    );
    let (left, _) = hold(waiver(&rule, "2027-01-01"), &before);
    assert!(left[0].to_string().contains("nothing to waive"), "{}", left[0]);
    let elsewhere = hold(waiver("dwell.negative-time", "2027-01-01"), &before);
    assert_eq!(elsewhere, (Vec::new(), Vec::new()), "nobody has asked for that rule");
    // What is not judged any more does not depart: nobody can answer for it.
    let without = run(&suite, &faulty(without), &only, 2);
    let lost = without.cases.iter().filter(|result| result.rule.id == rule).map(|result| {
        let (rule, case) = (rule.clone(), result.name.to_owned());
        let (listed, found) = ("pass".to_owned(), result.verdict.to_string());
        ExpectationMismatch::Changed { rule, case, listed, found }
    });
    let lost: Vec<_> = lost.collect();
    let (left, waived) = waiver(&rule, "2027-01-01").apply(&without, Some(lost.clone()), today);
    assert!(waived.is_empty() && left.len() == lost.len() + 1, "and there is nothing to waive");
    assert_eq!(waiver(&rule, "2027-01-01").first_unknown(&suite), None);
    let unknown = waiver("saved-state.no-such", "2027-01-01").first_unknown(&suite).expect("why");
    assert!(unknown.contains("saved-state.no-such: there is no such rule"), "{unknown}");
    for wrong in [
        "[[waiver]]\nrule = \"a\"\n",
        "[[waiver]]\nrule = \"a\"\nreason = \"c\"\nowner = \"b\"\nexpires = \"2027-02-31\"\n",
        "[[waiver]]\nrule = \"a\"\nreason = \" \"\nowner = \"b\"\nexpires = \"2026-01-01\"\n",
    ] {
        assert!(Waivers::read(wrong).is_err());
    }
}
