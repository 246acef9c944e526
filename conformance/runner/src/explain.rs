//! Explains a divergence by quirks, or by other options of choices.

use std::borrow::Cow;
use std::collections::BTreeSet;

use gaugeblock_adapter::Adapter;
use gaugeblock_compare::compare;
use gaugeblock_compare::observe::Observed;
use gaugeblock_suite::{Case, Choice, ChoiceKind, Edition, Rule, Suite, scenario_of};
use gaugeblock_vocabulary::{Options, Outcome, Scenario};

use crate::observables::judged_observables;

/// An option of a choice or quirk that is not selected.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AlternativeOption<'a> {
    /// The choice or quirk.
    pub(crate) choice: &'a Choice,
    option: &'a str,
}

/// Returns the name of another controller whose quirk this is; none for a quirk of this controller.
///
/// `name` is a quirk's id, or a choice with an option: a choice belongs to none.
pub fn other_controller(controller: &str, name: &str) -> Option<&'static str> {
    let named = controller.to_ascii_lowercase();
    match name.split_once('.')?.0 {
        "rs274" | "linuxcnc" if !matches!(named.as_str(), "rs274" | "linuxcnc") => Some("LinuxCNC"),
        "grbl" if !named.starts_with("grbl") => Some("Grbl"),
        "grblhal" if !named.starts_with("grblhal") => Some("grblHAL"),
        "nist" if !named.contains("nist") => Some("NIST's interpreter"),
        _ => None,
    }
}

impl AlternativeOption<'_> {
    /// Its name in a report: a quirk by its id, a choice with the option.
    pub(crate) fn name(&self) -> String {
        match self.choice.kind {
            ChoiceKind::Quirk => self.choice.id.clone(),
            ChoiceKind::Choice => format!("{} = {}", self.choice.id, self.option),
        }
    }

    fn is(&self, other: &Self) -> bool {
        (&self.choice.id, self.option) == (&other.choice.id, other.option)
    }

    /// A scenario under this option.
    pub(crate) fn applied_to(&self, scenario: &Scenario) -> Scenario {
        let mut scenario = scenario.clone();
        scenario.options.0.insert(self.choice.id.clone(), self.option.to_owned());
        scenario
    }
}

/// The ids of the choices and quirks that a run of the model consults; none if they are not known.
struct Consulted(Option<BTreeSet<&'static str>>);

impl Consulted {
    /// Whether another option can change anything of the run.
    fn includes(&self, other: &AlternativeOption<'_>) -> bool {
        self.0.as_ref().is_none_or(|ids| ids.contains(other.choice.id.as_str()))
    }
}

/// A divergence with all that its explanation depends on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DivergenceContext<'a> {
    /// The suite.
    pub(crate) suite: &'a Suite,
    /// The rule.
    pub(crate) rule: &'a Rule,
    /// Its case.
    pub(crate) case: &'a Case,
    /// The case under the edition.
    pub(crate) scenario: &'a Scenario,
    /// The controller's outcome.
    pub(crate) found: &'a Outcome,
    /// The controller.
    pub(crate) controller: &'a dyn Adapter,
    /// The edition.
    pub(crate) edition: &'a Edition,
}

impl<'a> DivergenceContext<'a> {
    /// The other options under which the model has the controller's outcome; empty if none are found.
    ///
    /// The search tries, in this order: each option that the rule names, each quirk and then each choice that it does
    /// not name, as few as possible of the controller's known quirks, and pairs with an option that the rule names. A
    /// quirk of another controller is the explanation where no other option is. If the outcomes are equal and only an
    /// assertion fails, nothing explains it.
    pub(crate) fn explain(self) -> Vec<AlternativeOption<'a>> {
        let found = Observed::of(self.found);
        let observables = judged_observables(self.controller, self.scenario, self.edition);
        let (specified, consulted) = self.model_under(&[]);
        let explains = |outcome: &Outcome| {
            // Most options do not concern the program: the outcome is the one that differs already.
            *outcome != specified
                && compare(&Observed::of(outcome), &found, &observables).is_equal()
        };
        let mut tried = Vec::new();
        let mut of_another = None;
        let controller = &self.controller.capabilities().name;
        for one in self.candidates().into_iter().filter(|one| consulted.includes(one)) {
            let (outcome, consulted) = self.model_under(&[one]);
            if explains(&outcome) {
                if other_controller(controller, &one.choice.id).is_none() {
                    return vec![one];
                }
                of_another = of_another.or(Some(one));
            }
            tried.push((one, consulted));
        }
        if let Some(one) = of_another {
            return vec![one];
        }
        let mut known = self.observed_options();
        let (outcome, consulted) = self.model_under(&known);
        let explained = |options: &[AlternativeOption<'_>]| explains(&self.model_under(options).0);
        if explains(&outcome) {
            known.retain(|one| consulted.includes(one));
            let mut few = minimal(known, explained);
            few.sort_by_key(|other| !self.rule_names(other));
            return few;
        }
        self.pairs(&tried)
            .into_iter()
            .find(|pair| explained(pair))
            .map(Vec::from)
            .unwrap_or_default()
    }

    /// The pairs of an option that the rule names and another one that concern the program together: under one of
    /// them, which the run consults, it consults the other.
    fn pairs(
        &self,
        tried: &[(AlternativeOption<'a>, Consulted)],
    ) -> Vec<[AlternativeOption<'a>; 2]> {
        let all = self.candidates();
        let under = |one: &AlternativeOption<'_>| tried.iter().find(|(it, _)| it.is(one));
        let mut pairs = Vec::new();
        for one in all.iter().filter(|one| self.rule_names(one)) {
            let others = all.iter().filter(|other| other.choice.id != one.choice.id);
            let together = others.filter(|other| {
                under(one).is_some_and(|(_, consulted)| consulted.includes(other))
                    || under(other).is_some_and(|(_, consulted)| consulted.includes(one))
            });
            pairs.extend(together.map(|other| [*one, *other]));
        }
        pairs
    }

    /// The model's run under other options.
    fn model_under(&self, others: &[AlternativeOption<'_>]) -> (Outcome, Consulted) {
        let mut scenario = Cow::Borrowed(self.scenario);
        for other in others {
            scenario = Cow::Owned(other.applied_to(&scenario));
        }
        let (outcome, consulted) = gaugeblock_reference::run_consulting(&scenario);
        (outcome, Consulted(consulted))
    }

    /// Whether the rule names this choice or quirk.
    pub(crate) fn rule_names(&self, other: &AlternativeOption<'_>) -> bool {
        self.rule.options.contains(&other.choice.id)
    }

    /// All other options: of what the rule names, then of each quirk, then of each choice.
    fn candidates(&self) -> Vec<AlternativeOption<'a>> {
        let is_named = |choice: &&Choice| self.rule.options.contains(&choice.id);
        let choices = self.suite.choices.iter().filter(|c| c.language == self.rule.language);
        let named = choices.clone().filter(is_named);
        let others = choices.filter(|choice| !is_named(choice));
        let quirks = others.clone().filter(|choice| choice.kind == ChoiceKind::Quirk);
        let others = others.filter(|choice| choice.kind == ChoiceKind::Choice);
        let in_force = &self.scenario.options;
        named
            .chain(quirks)
            .chain(others)
            .flat_map(|choice| alternatives(choice, in_force))
            .collect()
    }

    /// Quirks of the controller that the edition does not have, those that the rule names last.
    fn observed_options(&self) -> Vec<AlternativeOption<'a>> {
        let observed = self.controller.observed_edition().and_then(|id| self.suite.edition(id));
        let Some(observed) = observed else { return Vec::new() };
        let options = self.suite.options(observed);
        let choices = self.suite.choices.iter();
        let others = choices.flat_map(|choice| alternatives(choice, &self.scenario.options));
        let mut known: Vec<_> =
            others.filter(|other| options.is(&other.choice.id, other.option)).collect();
        known.sort_by_key(|other| self.rule_names(other));
        known
    }

    /// Whether the controller's observed edition predicts this outcome.
    pub(crate) fn matches_observed_edition(&self, edition: &str) -> bool {
        let observed = self.controller.observed_edition().filter(|id| *id != edition);
        let Some(observed) = observed.and_then(|id| self.suite.edition(id)) else { return false };
        let scenario = scenario_of(self.case, &self.suite.options(observed), observed);
        let expected = Observed::of(&gaugeblock_reference::run(&scenario).0);
        let observables = judged_observables(self.controller, self.scenario, self.edition);
        compare(&expected, &Observed::of(self.found), &observables).is_equal()
    }
}

/// Removes options that are not needed, from the last to the first.
fn minimal<'a>(
    mut all: Vec<AlternativeOption<'a>>,
    explains: impl Fn(&[AlternativeOption<'_>]) -> bool,
) -> Vec<AlternativeOption<'a>> {
    for place in (0..all.len()).rev() {
        let mut fewer = all.clone();
        fewer.remove(place);
        if explains(&fewer) {
            all = fewer;
        }
    }
    all
}

fn alternatives<'a>(
    choice: &'a Choice,
    in_force: &Options,
) -> impl Iterator<Item = AlternativeOption<'a>> {
    let in_force = in_force.get(&choice.id).map(str::to_owned);
    let options = choice.options.iter().map(|option| option.name.as_str());
    let others = options.filter(move |name| in_force.as_deref() != Some(*name));
    others.map(move |option| AlternativeOption { choice, option })
}
