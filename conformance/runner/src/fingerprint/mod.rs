//! Fingerprints: which option of each choice, and which quirk, a controller has.

mod refusal;

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_adapter::Adapter;
use gaugeblock_compare::judge::{Finding, judge};
use gaugeblock_compare::observe::Observed;
use gaugeblock_compare::{REFUSALS, compare};
use gaugeblock_suite::{Choice, Edition, Suite, options_of};
use gaugeblock_vocabulary::scenario::Environment;
use gaugeblock_vocabulary::{End, Options, Scenario};
use refusal::RefusalReason;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The option of a choice that is observed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ObservedOption {
    /// Exactly this option.
    Option(String),
    /// None of the options: it does something else.
    #[serde(rename = "none")]
    Nothing(Vec<String>),
    /// One of several: the controller does not report what separates them.
    #[serde(rename = "any_of")]
    Several(Vec<String>),
    /// Refused, and not for the reason of an option.
    #[serde(rename = "refused")]
    Refused(String),
    /// The program could not be run.
    NotRun(String),
}

impl std::fmt::Display for ObservedOption {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Option(option) => write!(f, "{option}"),
            Self::Nothing(why) => write!(f, "none of the options: {}", why.join("; ")),
            Self::Several(options) => write!(f, "undecided: {}", options.join(" or ")),
            Self::Refused(why) => write!(f, "undecided: {why}"),
            Self::NotRun(why) => write!(f, "not run: {why}"),
        }
    }
}

/// A choice or quirk: the expected and the observed option.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct FingerprintEntry {
    /// The choice or quirk.
    pub choice: String,
    /// The expected option.
    #[serde(rename = "held_to")]
    pub expected: String,
    /// Whether that is its own declaration, and not the edition's.
    pub declared: bool,
    /// What is observed.
    #[serde(rename = "shown")]
    pub observed: ObservedOption,
}

impl FingerprintEntry {
    /// Whether it certainly has the expected option.
    pub fn agrees(&self) -> bool {
        matches!(&self.observed, ObservedOption::Option(option) if *option == self.expected)
    }

    /// Whether it certainly has another option.
    pub fn differs(&self) -> bool {
        match &self.observed {
            ObservedOption::Option(option) => *option != self.expected,
            ObservedOption::Several(options) => !options.contains(&self.expected),
            ObservedOption::Nothing(_) => true,
            ObservedOption::Refused(_) | ObservedOption::NotRun(_) => false,
        }
    }
}

/// The observed option of every choice, with the expected one.
pub fn fingerprint_entries(
    suite: &Suite,
    options: &Options,
    environment: Option<&str>,
    controller: &dyn Adapter,
) -> Vec<FingerprintEntry> {
    let declared = controller.options();
    let observed = fingerprint(suite, options, environment, controller).into_iter();
    let beside = observed.map(|(choice, observed)| FingerprintEntry {
        choice: choice.id.clone(),
        expected: options.get(&choice.id).unwrap_or_default().to_owned(),
        declared: declared.get(&choice.id).is_some(),
        observed,
    });
    beside.collect()
}

/// The observed options of open choices, where they are not those of the comparison and not `declared`.
///
/// No document decides an open choice, so that no option of it is a divergence: the comparison uses the observed option.
/// An option counts only if the whole outcome of its program equals that of the model. Another difference, such as a
/// refusal for another reason, could look like the option. A controller that never refuses and has no other option is
/// compared under the option that [refuses](may_be_refused): then its cases are not judged. The result is empty for a
/// controller that an observed edition describes.
pub fn shown_open_options(
    suite: &Suite,
    edition: &Edition,
    declared: &Options,
    controller: &dyn Adapter,
) -> Options {
    let options = &options_of(suite, edition, declared);
    let mut shown = Options::default();
    if controller.observed_edition().is_some() {
        return shown;
    }
    let asked = suite.choices.iter().filter(|choice| {
        options.get(&choice.id).is_some()
            && declared.get(&choice.id).is_none()
            && suite.is_open(choice, edition)
            && choice.under.iter().all(|(id, option)| options.is(id, option))
    });
    for choice in asked {
        let environment = edition.environment.as_deref();
        let used = observe_choice(choice, options, environment, controller, false);
        let is_settled = match &used {
            ObservedOption::Option(option) => options.is(&choice.id, option),
            ObservedOption::NotRun(_) => true,
            ObservedOption::Nothing(_)
            | ObservedOption::Several(_)
            | ObservedOption::Refused(_) => false,
        };
        if is_settled {
            continue;
        }
        // Another option has to be confirmed in a fresh session, as an earlier program may have left something.
        let observed = observe_choice(choice, options, environment, controller, true);
        let option = match observed {
            ObservedOption::Option(option)
                if does_as_the_model(choice, &option, options, environment, controller) =>
            {
                Some(option)
            }
            ObservedOption::Nothing(_) if !controller.capabilities().refuses => {
                refusing_option(choice).map(str::to_owned)
            }
            ObservedOption::Option(_)
            | ObservedOption::Nothing(_)
            | ObservedOption::Several(_)
            | ObservedOption::Refused(_)
            | ObservedOption::NotRun(_) => None,
        };
        if let Some(option) = option
            && !options.is(&choice.id, &option)
        {
            shown.0.insert(choice.id.clone(), option);
        }
    }
    shown
}

/// Whether a program may be refused under this option of a choice.
pub fn may_be_refused(suite: &Suite, choice: &str, option: &str) -> bool {
    let mut choices = suite.choices.iter().filter(|known| known.id == choice);
    choices.any(|choice| refusing_option(choice) == Some(option))
}

/// The option of a choice under which its program is refused.
fn refusing_option(choice: &Choice) -> Option<&str> {
    let refuses = |assertion: &String| assertion.starts_with("refused");
    let mut options = choice.options.iter();
    let option = options.find(|option| option.assertions.iter().any(refuses))?;
    Some(&option.name)
}

/// Whether the whole outcome of a choice's program is that of the model under an option.
fn does_as_the_model(
    choice: &Choice,
    option: &str,
    options: &Options,
    environment: Option<&str>,
    controller: &dyn Adapter,
) -> bool {
    let scenario = scenario_of_choice(choice, &with(options, choice, option), environment);
    let expected = Observed::of(&gaugeblock_reference::run(&scenario).0);
    let found = controller.run_fresh(&scenario).unwrap_or_else(|| controller.run(&scenario));
    found.is_ok_and(|found| {
        let observables = controller.observables(&scenario);
        compare(&expected, &Observed::of(&found), &observables).is_equal()
    })
}

/// The program of a choice, with its machine and environment.
fn scenario_of_choice(choice: &Choice, options: &Options, environment: Option<&str>) -> Scenario {
    let mut scenario = choice.setup.scenario(&choice.program, options);
    scenario.program.language = choice.language;
    if scenario.environment == Environment::default() {
        scenario.environment.name = environment.map(str::to_owned);
    }
    scenario
}

/// The observed option of every choice, in order.
pub fn fingerprint<'a>(
    suite: &'a Suite,
    options: &Options,
    environment: Option<&str>,
    controller: &dyn Adapter,
) -> Vec<(&'a Choice, ObservedOption)> {
    let known = controller.observed_edition().and_then(|id| suite.edition(id));
    let known = known.map(|edition| suite.options(edition));
    let of = |choice: &'a Choice| {
        let used = observe_choice(choice, options, environment, controller, false);
        // An unknown observation has to be confirmed in a fresh session.
        let is_known = known.as_ref().is_none_or(
            |known| matches!(&used, ObservedOption::Option(option) if known.is(&choice.id, option)),
        );
        let observed = if is_known {
            used
        } else {
            observe_choice(choice, options, environment, controller, true)
        };
        (choice, observed)
    };
    // Choices in another language do not belong to the edition.
    let listed = suite.choices.iter().filter(|choice| options.get(&choice.id).is_some());
    let mut all: Vec<_> = listed.map(of).collect();
    widen_inconclusive(&mut all);
    all
}

/// Some pages distinguish their options only under an option of another choice. If the controller has another option
/// there, the page decides nothing.
fn widen_inconclusive(all: &mut [(&Choice, ObservedOption)]) {
    let others: BTreeMap<String, ObservedOption> =
        all.iter().map(|(choice, observed)| (choice.id.clone(), observed.clone())).collect();
    for (choice, observed) in all {
        let told = choice.under.iter().all(|(id, option)| {
            others.get(id).is_none_or(|other| *other == ObservedOption::Option(option.clone()))
        });
        if !told && matches!(observed, ObservedOption::Option(_) | ObservedOption::Nothing(_)) {
            *observed =
                ObservedOption::Several(choice.options.iter().map(|o| o.name.clone()).collect());
        }
    }
}

/// The observed option of one choice.
pub fn observe_choice(
    choice: &Choice,
    options: &Options,
    environment: Option<&str>,
    controller: &dyn Adapter,
    anew: bool,
) -> ObservedOption {
    let scenario = scenario_of_choice(choice, options, environment);
    if let Err(why) = controller.supports(&scenario) {
        return ObservedOption::NotRun(why);
    }
    let on_a_new_one = if anew { controller.run_fresh(&scenario) } else { None };
    let outcome = match on_a_new_one.unwrap_or_else(|| controller.run(&scenario)) {
        Ok(outcome) => outcome,
        Err(error) => return ObservedOption::NotRun(error.to_string()),
    };
    if let End::Unsupported { what, .. } = &outcome.end {
        // An unsupported program is neither accepted nor refused.
        return ObservedOption::NotRun(what.clone());
    }
    let run = Observed::of(&outcome);
    let observables = controller.observables(&scenario);
    let mut holding = Vec::new();
    let mut reasons = Vec::new();
    for option in &choice.options {
        let failing = option.parsed().iter().find_map(|assertion| {
            match judge(assertion, &run, &observables) {
                Finding::Fails(found) => {
                    Some(format!("{}: {} | found {found}", option.name, assertion.text))
                }
                // A controller that never refuses does not have an option that does.
                Finding::Masked(what) if what == REFUSALS => {
                    Some(format!("{}: {} | it never refuses", option.name, assertion.text))
                }
                Finding::Holds | Finding::Masked(_) => None,
            }
        });
        match failing {
            None => holding.push(option.name.clone()),
            Some(reason) => reasons.push(reason),
        }
    }
    if let End::Fault(fault) = &outcome.end {
        let mut other_reasons = Vec::new();
        holding.retain(|option| {
            let scenario = scenario_of_choice(choice, &with(options, choice, option), environment);
            match refusal::reason(controller, &scenario, fault) {
                RefusalReason::Option => true,
                RefusalReason::Other(why) => {
                    other_reasons.push(why);
                    false
                }
            }
        });
        if let (true, Some(why)) = (holding.is_empty(), other_reasons.pop()) {
            return ObservedOption::Refused(why);
        }
    }
    match holding.len() {
        0 => ObservedOption::Nothing(reasons),
        1 => ObservedOption::Option(holding.remove(0)),
        _ => ObservedOption::Several(holding),
    }
}

/// These options, with another option of one choice.
fn with(options: &Options, choice: &Choice, option: &str) -> Options {
    let mut options = options.clone();
    options.0.insert(choice.id.clone(), option.to_owned());
    options
}

/// How many of the observed options an edition has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Agreement {
    /// The edition.
    pub edition: String,
    /// The number of observed options that are those of the edition.
    pub agree: usize,
    /// Its place, from 1; editions that agree equally have the same.
    pub rank: usize,
}

/// The editions by how many of the observed options they have, the nearest first. Editions that agree equally are in
/// the order of the suite.
pub fn nearest(suite: &Suite, observed: &[(&Choice, ObservedOption)]) -> Vec<Agreement> {
    let agree = |edition: &Edition| {
        let options = suite.options(edition);
        let agrees = |choice: &Choice, observed: &ObservedOption| match observed {
            ObservedOption::Option(option) => options.is(&choice.id, option),
            ObservedOption::Nothing(_)
            | ObservedOption::Several(_)
            | ObservedOption::Refused(_)
            | ObservedOption::NotRun(_) => false,
        };
        observed.iter().filter(|(choice, observed)| agrees(choice, observed)).count()
    };
    let mut ranked: Vec<_> = suite
        .editions
        .iter()
        .map(|edition| Agreement { edition: edition.id.clone(), agree: agree(edition), rank: 0 })
        .collect();
    ranked.sort_by_key(|agreement| Reverse(agreement.agree));
    let counts: Vec<_> = ranked.iter().map(|agreement| agreement.agree).collect();
    for agreement in &mut ranked {
        agreement.rank = 1 + counts.iter().filter(|count| **count > agreement.agree).count();
    }
    ranked
}

/// The choices that would separate the nearest editions if their options were observed.
pub fn undecided<'a>(
    suite: &Suite,
    observed: &[(&'a Choice, ObservedOption)],
    nearest: &[Agreement],
) -> Vec<&'a str> {
    let first = nearest.iter().filter(|agreement| agreement.rank == 1);
    let editions = first.filter_map(|agreement| suite.edition(&agreement.edition));
    let options: Vec<_> = editions.map(|edition| suite.options(edition)).collect();
    let separates = |choice: &Choice| {
        let of_each: BTreeSet<_> = options.iter().map(|options| options.get(&choice.id)).collect();
        of_each.len() > 1
    };
    let is_open = |observed: &ObservedOption| !matches!(observed, ObservedOption::Option(_));
    let open = observed.iter().filter(|(choice, observed)| is_open(observed) && separates(choice));
    open.map(|(choice, _)| choice.id.as_str()).collect()
}
