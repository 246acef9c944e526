//! The production interpreter held to every edition of the documents: it passes all that it claims.

use std::collections::BTreeSet;
use std::num::NonZero;

use gaugeblock_adapter::Adapter;
use gaugeblock_controllers::Production;
use gaugeblock_runner::certify::{Plan, Run, Scope, Verdict, certify};
use gaugeblock_runner::fingerprint::{ObservedOption, observe_choice};
use gaugeblock_suite::{ChoiceKind, Edition, Suite};

/// Why cases are unsupported: they are about what another controller only stubs.
const OTHERS: &[&str] = &["the environment \"stand-alone rs274\" is another controller's"];

fn suite() -> Suite {
    gaugeblock_runner::language::read_suite(&gaugeblock_embedded_suite::files().expect("the suite"))
        .unwrap_or_else(|errors| panic!("{}", errors.join("\n")))
}

/// Editions of documents, not of what a real controller does.
fn editions(suite: &Suite) -> Vec<&Edition> {
    let honoured =
        |edition: &&Edition| Production::default().accepts_options(&suite.options(edition)).is_ok();
    suite.editions.iter().filter(honoured).collect()
}

fn run<'a>(suite: &'a Suite, edition: &'a Edition) -> Run<'a> {
    let jobs = NonZero::new(2).expect("two");
    certify(
        Plan { suite, edition, only: &[], jobs, scope: Scope::Full },
        &Production::default(),
        &|| {},
    )
}

#[test]
fn it_is_compared_with_editions_of_documents() {
    let suite = suite();
    let ids: Vec<_> = editions(&suite).iter().map(|edition| edition.id.as_str()).collect();
    assert_eq!(
        ids,
        [
            "emc2-2.5",
            "m70-draft",
            "linuxcnc-2.8",
            "linuxcnc-2.9",
            "gpp2",
            "gpp-classic",
            "nct-99m",
            "grbl-1.1",
            "grblhal",
            "nist-rs274ngc-3"
        ]
    );
}

#[test]
fn it_passes_what_it_claims() {
    let suite = suite();
    let mut reasons = BTreeSet::new();
    for edition in editions(&suite) {
        let run = run(&suite, edition);
        let mut wrong = Vec::new();
        for result in &run.cases {
            let place = format!("{} / {}", result.rule.id, result.name);
            if let Verdict::Unsupported(why) = &result.verdict
                && OTHERS.contains(&why.as_str())
            {
                reasons.insert(why.clone());
            } else if result.verdict != Verdict::Pass {
                wrong.push(format!("{place}: {}", result.verdict));
            }
            // An edition that lists its codes has none for these modes.
            let modes = ["arc_distance", "lathe", "retract", "spindle_mode"];
            let is_judged =
                |name: &&String| edition.has.is_none() || !modes.contains(&name.as_str());
            if let Some(hidden) = result.masked.iter().find(is_judged) {
                wrong.push(format!("{place}: {hidden} is not shown"));
            }
        }
        let id = edition.id.as_str();
        assert!(wrong.is_empty(), "{id}:\n{}", wrong.join("\n"));
    }
    let listed: BTreeSet<String> = OTHERS.iter().map(|why| (*why).to_owned()).collect();
    assert_eq!(reasons, listed, "a reason that no case meets any more");
}

/// Pages of choices that can be told only where a quirk of another controller is shown.
const UNDER_QUIRKS: &[&str] = &["threading.slide-end"];

/// Options whose refusal has another kind on production. No document names it, and the block has no lawful neighbours.
const REFUSED_IN_OTHER_WORDS: &[&str] = &["control.comment-after-o-word = refused"];

#[test]
fn it_does_what_each_option_says() {
    let suite = suite();
    let editions = editions(&suite);
    let production = Production::default();
    let (mut wrong, mut left_out) = (Vec::new(), Vec::new());
    let choices = suite.choices.iter().filter(|choice| choice.kind == ChoiceKind::Choice);
    for choice in choices {
        let observed = |edition: &Edition, option: &str| {
            let mut options = suite.options(edition);
            options.0.insert(choice.id.clone(), option.to_owned());
            observe_choice(choice, &options, None, &production, false)
        };
        if choice.under.values().any(|option| option == "observed") {
            left_out.push(choice.id.as_str());
            continue;
        }
        for option in &choice.options {
            // A page tells its options apart under some edition, which it does not name.
            let editions = editions.iter().filter(|edition| edition.language == choice.language);
            let under: Vec<_> = editions.map(|edition| observed(edition, &option.name)).collect();
            if under.contains(&ObservedOption::Option(option.name.clone())) {
                continue;
            }
            let name = format!("{} = {}", choice.id, option.name);
            let is_refused = |shown: &ObservedOption| matches!(shown, ObservedOption::Refused(_));
            if REFUSED_IN_OTHER_WORDS.contains(&name.as_str()) && under.iter().all(is_refused) {
                continue;
            }
            wrong.push(format!("{name}: {under:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert_eq!(left_out, UNDER_QUIRKS);
}
