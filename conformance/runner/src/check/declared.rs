//! Checks that each declared observable occurs in an outcome: a misspelt member, or one of another form, is found
//! before a campaign.

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_adapter::Adapter;
use gaugeblock_adapter::exec::Exec;
use gaugeblock_suite::{DEFAULT_EDITION, Edition, Suite, options_of, scenario_of};
use gaugeblock_vocabulary::{End, Entry, Event, Outcome, Scenario, Settings, State};

use super::result::{Check, CheckResult};

/// Programs to run for one word, at most, until an outcome has it.
const TRIES: usize = 6;

/// Programs to request, at most; unsupported ones are not run.
const ASKED: usize = 300;

/// Mistakes to report.
const TOLD: usize = 4;

/// A kind of observable, and its words in an outcome.
type Kind = (&'static str, fn(&Outcome) -> BTreeSet<&'static str>);

const KINDS: [Kind; 3] = [("effects", effects), ("fields", fields), ("pins", pins)];

/// Checks each declared effect, field and pin in the outcomes of programs of the suite.
pub(super) fn checks(adapter: &Exec, suite: &Suite) -> Vec<Check> {
    let observables = &adapter.declaration().observables;
    let mut looked = Looked { adapter, programs: programs(adapter, suite), came: BTreeMap::new() };
    let declared = [&observables.effects, &observables.fields, &observables.pins];
    let checks = KINDS.into_iter().zip(declared).filter(|(_, words)| !words.is_empty());
    checks
        .map(|((what, told), words)| Check { name: what, result: looked.all(told, words) })
        .collect()
}

/// The programs that it supports and the documents define, the smallest first, with their specified outcomes.
fn programs(adapter: &Exec, suite: &Suite) -> Vec<(Scenario, Outcome)> {
    let languages = &adapter.declaration().languages;
    let own = adapter.own_edition().and_then(|id| suite.edition(id));
    let usual = [DEFAULT_EDITION, "gpp2", "nct-99m"].map(|id| suite.edition(id));
    let editions = languages.iter().filter_map(|language| {
        let mut editions = own.into_iter().chain(usual.into_iter().flatten());
        editions.find(|edition| edition.language == *language)
    });
    let mut programs: Vec<_> =
        editions.flat_map(|edition| of_edition(adapter, suite, edition)).collect();
    programs.sort_by_key(|(scenario, _)| scenario.program.main.len());
    programs
}

fn of_edition(adapter: &Exec, suite: &Suite, edition: &Edition) -> Vec<(Scenario, Outcome)> {
    let options = options_of(suite, edition, &adapter.options());
    let rules = suite.rules.iter().filter(|rule| rule.exists_in(edition));
    let cases = rules.flat_map(|rule| &rule.cases).filter(|case| case.runs_in(edition));
    let scenarios = cases.map(|case| scenario_of(case, &options, edition));
    let scenarios = scenarios.filter(|scenario| adapter.supports(scenario).is_ok());
    let with_outcome = scenarios.map(|scenario| {
        let mut outcome = gaugeblock_reference::run(&scenario).0;
        // Words that are set from the start are no reason to run a program.
        outcome.start = Settings::default();
        (scenario, outcome)
    });
    with_outcome.filter(|(_, outcome)| outcome.end.undetermined().is_none()).collect()
}

/// What was checked.
struct Looked<'a> {
    adapter: &'a Exec,
    programs: Vec<(Scenario, Outcome)>,
    /// Results of programs, by their places: an outcome, or what is wrong with the answer.
    came: BTreeMap<usize, Result<Outcome, String>>,
}

impl Looked<'_> {
    fn all(
        &mut self,
        told: fn(&Outcome) -> BTreeSet<&'static str>,
        words: &BTreeSet<String>,
    ) -> CheckResult {
        let (mut wrong, mut not_seen) = (BTreeSet::new(), Vec::new());
        for word in words {
            match self.word(told, word) {
                CheckResult::Passed(_) => {}
                CheckResult::Failed(why) => {
                    wrong.insert(why);
                }
                CheckResult::Skipped(word) => not_seen.push(word),
            }
            if wrong.len() >= TOLD {
                break;
            }
        }
        if !wrong.is_empty() {
            return CheckResult::Failed(wrong.into_iter().collect::<Vec<_>>().join("\n"));
        }
        let (seen, all) = (words.len() - not_seen.len(), words.len());
        let but = match not_seen.as_slice() {
            [] => String::new(),
            words => format!("; no program that it runs exposes {}", words.join(", ")),
        };
        let says = format!("{seen} of the {all} that it declares were reported{but}");
        if seen == 0 { CheckResult::Skipped(says) } else { CheckResult::Passed(says) }
    }

    fn word(&mut self, told: fn(&Outcome) -> BTreeSet<&'static str>, word: &str) -> CheckResult {
        let Self { adapter, programs, came } = self;
        let (mut lacking, mut tries) = (None, 0);
        let observables = |outcome: &Outcome| told(outcome).contains(word);
        let programs = programs.iter().enumerate().filter(|(_, (_, outcome))| observables(outcome));
        for (place, (scenario, expected)) in programs.take(ASKED) {
            if tries == TRIES {
                break;
            }
            let program = &scenario.program.main;
            let run = || adapter.run(scenario).map_err(|error| error.to_string());
            match came.entry(place).or_insert_with(run) {
                Ok(Outcome { end: End::Unsupported { .. }, .. }) => continue,
                Ok(found) if told(found).contains(word) => {
                    return CheckResult::Passed(String::new());
                }
                // A program that it does not support, or refuses, says nothing about what it reports.
                Ok(Outcome { end, .. }) if end.name() != expected.end.name() => {}
                Ok(Outcome { end: End::Fault(_), .. }) => {}
                Ok(_) => lacking = lacking.or_else(|| Some(program.to_string())),
                Err(why) => return CheckResult::Failed(format!("{program:?}: {why}")),
            }
            tries += 1;
        }
        match lacking {
            None => CheckResult::Skipped(word.to_owned()),
            Some(program) => CheckResult::Failed(format!(
                "`{word}` is declared, but the answer to {program:?} does not have it; by the documents it should"
            )),
        }
    }
}

fn effects(outcome: &Outcome) -> BTreeSet<&'static str> {
    let events = outcome.steps.iter().flat_map(|step| &step.events);
    let effects = events.filter_map(|event| match event {
        Event::Do(effect) => Some(effect.name()),
        Event::Set(_) | Event::Unknown(_) => None,
    });
    effects.collect()
}

/// Settings that were set, and reported members of the state.
fn fields(outcome: &Outcome) -> BTreeSet<&'static str> {
    let events = outcome.steps.iter().flat_map(|step| &step.events);
    let set = events.filter_map(|event| match event {
        Event::Set(settings) => Some(settings.entries()),
        Event::Do(_) | Event::Unknown(_) => None,
    });
    let states = outcome.steps.iter().filter_map(|step| step.state.as_ref()).map(State::entries);
    let all = set.chain(states).chain([Settings::entries(&outcome.start)]).flatten();
    all.map(|Entry { field, .. }| field).collect()
}

fn pins(outcome: &Outcome) -> BTreeSet<&'static str> {
    outcome.pins.iter().map(|change| change.pin.name()).collect()
}
