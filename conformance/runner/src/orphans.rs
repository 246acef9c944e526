//! Choices and quirks that no rule owns: a controller that differs by one of them would break no rule.
//!
//! A rule owns an option if its page names the choice or quirk, and if one of its cases fails under another option than
//! that of the edition. A build without dialects cannot run all editions: it checks only that rules name them.

use gaugeblock_compare::Capabilities;
use gaugeblock_compare::judge::{Finding, judge};
use gaugeblock_compare::observe::Observed;
use gaugeblock_suite::{Case, Choice, Edition, Rule, Suite, applies, scenario_of};

use crate::model_run::editions_of;

/// Each choice and quirk that no rule owns, as a sentence.
pub(crate) fn orphans(suite: &Suite) -> Vec<String> {
    let everything = Capabilities::everything("model", "0");
    let is_run = |edition| gaugeblock_reference::accepts_options(&suite.options(edition)).is_ok();
    let runs_all = suite.editions.iter().all(is_run);
    let orphaned = suite.choices.iter().filter_map(|choice| {
        let mut named =
            suite.rules.iter().filter(|rule| rule.options.contains(&choice.id)).peekable();
        if named.peek().is_none() {
            return Some(format!("{}: no rule names it", choice.id));
        }
        let is_owned = !runs_all || named.any(|rule| owns(suite, rule, choice, &everything));
        (!is_owned).then(|| {
            format!("{}: no case of a rule that names it fails under another option", choice.id)
        })
    });
    orphaned.collect()
}

fn owns(suite: &Suite, rule: &Rule, choice: &Choice, everything: &Capabilities) -> bool {
    rule.cases.iter().any(|case| {
        editions_of(suite, rule, case)
            .into_iter()
            .any(|edition| fails_under_another(suite, (case, edition), choice, everything))
    })
}

/// Whether an assertion that an edition makes fails under another option of a choice.
fn fails_under_another(
    suite: &Suite,
    (case, edition): (&Case, &Edition),
    choice: &Choice,
    everything: &Capabilities,
) -> bool {
    let options = suite.options(edition);
    let others = choice.options.iter().filter(|option| !options.is(&choice.id, &option.name));
    others.into_iter().any(|other| {
        let mut changed = options.clone();
        for (id, option) in &choice.under {
            changed.0.insert(id.clone(), option.clone());
        }
        changed.0.insert(choice.id.clone(), other.name.clone());
        let (outcome, _) = gaugeblock_reference::run(&scenario_of(case, &changed, edition));
        if outcome.end.undetermined().is_some() {
            return false;
        }
        let found = Observed::of(&outcome);
        let assertions = case.parsed().into_iter();
        assertions
            .filter(|assertion| applies(assertion, &options, &edition.id))
            .any(|assertion| matches!(judge(&assertion, &found, everything), Finding::Fails(_)))
    })
}
