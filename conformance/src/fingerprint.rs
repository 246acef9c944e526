//! Which option of each choice, and which quirk, a controller shows.

use std::collections::BTreeMap;

use gaugeblock_trace::Options;
use gaugeblock_trace::scenario::Bench;

use crate::adapters::Adapter;
use crate::judge::{Finding, judge};
use crate::observe::Observed;
use crate::suite::{Choice, Suite};

/// What a controller shows of a choice.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Shown {
    /// Exactly this option.
    Option(String),
    /// None of the options: it does something else.
    Nothing(Vec<String>),
    /// More than one: what tells them apart is not shown.
    Several(Vec<String>),
    /// The program could not be run.
    NotRun(String),
}

/// What a controller shows of every choice, in order.
pub fn fingerprint<'a>(
    suite: &'a Suite,
    options: &Options,
    bench: Option<&str>,
    controller: &dyn Adapter,
) -> Vec<(&'a Choice, Shown)> {
    suite.choices.iter().map(|choice| (choice, shown(choice, options, bench, controller))).collect()
}

/// What a controller shows of one choice.
pub fn shown(
    choice: &Choice,
    options: &Options,
    bench: Option<&str>,
    controller: &dyn Adapter,
) -> Shown {
    let mut scenario = choice.setup.scenario(&choice.program, options);
    if scenario.bench == Bench::default() {
        scenario.bench.name = bench.map(str::to_owned);
    }
    if let Err(why) = controller.supports(&scenario) {
        return Shown::NotRun(why);
    }
    let outcome = match controller.run(&scenario) {
        Ok(outcome) => outcome,
        Err(error) => return Shown::NotRun(error.to_string()),
    };
    let run = Observed::of(&outcome);
    let shows = controller.shows(&scenario);
    let mut holding = Vec::new();
    let mut reasons = Vec::new();
    for option in &choice.options {
        let failing =
            option.parsed().iter().find_map(|assertion| match judge(assertion, &run, &shows) {
                Finding::Fails(found) => {
                    Some(format!("{}: {} | found {found}", option.name, assertion.text))
                }
                Finding::Holds | Finding::Masked(_) => None,
            });
        match failing {
            None => holding.push(option.name.clone()),
            Some(reason) => reasons.push(reason),
        }
    }
    match holding.len() {
        0 => Shown::Nothing(reasons),
        1 => Shown::Option(holding.remove(0)),
        _ => Shown::Several(holding),
    }
}

/// The editions by how many of the shown options they have, the nearest first.
pub fn nearest(suite: &Suite, shown: &[(&Choice, Shown)]) -> Vec<(String, usize)> {
    let shown: BTreeMap<&str, &str> = shown
        .iter()
        .filter_map(|(choice, shown)| match shown {
            Shown::Option(option) => Some((choice.id.as_str(), option.as_str())),
            Shown::Nothing(_) | Shown::Several(_) | Shown::NotRun(_) => None,
        })
        .collect();
    let mut ranked: Vec<_> = suite
        .editions
        .iter()
        .map(|edition| {
            let options = suite.options(edition);
            let agree = shown.iter().filter(|(id, option)| options.is(id, option)).count();
            (edition.id.clone(), agree)
        })
        .collect();
    ranked.sort_by(|a, b| b.1.cmp(&a.1).then_with(|| a.0.cmp(&b.0)));
    ranked
}
