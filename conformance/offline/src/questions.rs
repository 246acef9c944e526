//! Which programs are exported, and in which order: those with the same setup one after the other.

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_suite::assertion::Claim;
use gaugeblock_suite::{Case, Edition, MotionCase, Rule, Suite, applies, scenario_of};
use gaugeblock_vocabulary::motion::MotionLimits;
use gaugeblock_vocabulary::scenario::Environment;
use gaugeblock_vocabulary::{Language, Options, Program, Scenario};

use super::exportable::check_exportable;
use super::requested::Requested;
use super::{ExportedProgram, digest, digest_of_motion};

/// A program with all that it depends on, and what its sheet requests.
#[derive(Clone, Debug)]
pub struct Question {
    /// What the sheet requests.
    pub exported: ExportedProgram,
    /// The scenario to run.
    pub scenario: Scenario,
    /// Limits of the axes, if samples are requested.
    pub limits: Option<MotionLimits>,
}

/// The programs of a suite under an edition, for the requested rules; and the number of cases that cannot be exported,
/// by reason.
pub fn questions(
    suite: &Suite,
    edition: &Edition,
    requested: &Requested,
) -> (Vec<Question>, BTreeMap<String, usize>) {
    let options = suite.options(edition);
    let mut left_out = BTreeMap::new();
    let mut found: BTreeMap<String, Question> = BTreeMap::new();
    let is_requested = requested.cases(suite, edition);
    for rule in suite.rules.iter().filter(|rule| rule.exists_in(edition)) {
        let plans = |case: &&MotionCase| !case.is_recorded() && is_requested(rule, &case.name);
        for case in rule.motion.iter().filter(plans) {
            match motion_question(rule, case, &options, edition) {
                Ok(question) => {
                    let key = question.exported.scenario.clone();
                    found.entry(key).or_insert(question).exported.cases += 1;
                }
                Err(why) => *left_out.entry(why.to_owned()).or_default() += 1,
            }
        }
        let runs = |case: &&Case| case.runs_in(edition) && is_requested(rule, &case.name);
        for case in rule.cases.iter().filter(runs) {
            let scenario = scenario_of(case, &options, edition);
            let expected = gaugeblock_reference::run(&scenario).0;
            if let Err(why) = check_exportable(&scenario, &expected) {
                *left_out.entry(why.to_owned()).or_default() += 1;
                continue;
            }
            let variables = case.parsed().into_iter();
            let variables = variables.filter(|claim| applies(claim, &options, &edition.id));
            let asserted: BTreeSet<u32> =
                variables.flat_map(|claim| asserted_variables(&claim.claim)).collect();
            let key = digest(&scenario);
            let question =
                found.entry(key.clone()).or_insert_with(|| new_question(key, rule, &scenario));
            question.exported.cases += 1;
            let all: BTreeSet<u32> =
                question.exported.variables.iter().copied().chain(asserted).collect();
            question.exported.variables = all.into_iter().collect();
        }
    }
    let mut questions: Vec<Question> = found.into_values().collect();
    questions.sort_by_cached_key(|question| {
        (setup_key(question), question.exported.chapter.clone(), question.exported.scenario.clone())
    });
    for (question, number) in questions.iter_mut().zip(1_u32..) {
        question.exported.folder = format!("{number:04}");
    }
    (questions, left_out)
}

fn new_question(scenario_digest: String, rule: &Rule, scenario: &Scenario) -> Question {
    let exported = ExportedProgram {
        folder: String::new(),
        scenario: scenario_digest,
        chapter: rule.chapter().to_owned(),
        cases: 0,
        axes: scenario.machine.axes.clone(),
        variables: named_variables(&scenario.program).into_iter().collect(),
        messages: has_messages(&scenario.program),
        samples: false,
    };
    Question { exported, scenario: scenario.clone(), limits: None }
}

/// A program whose samples are requested.
fn motion_question(
    rule: &Rule,
    case: &MotionCase,
    options: &Options,
    edition: &Edition,
) -> Result<Question, &'static str> {
    if !case.script().events.is_empty() {
        return Err("a person has to act at an exact moment of the run");
    }
    let exported =
        gaugeblock_motion::scenario_and_path(case, options, edition.environment.as_ref());
    let (scenario, _) = exported.map_err(|_| "the specification does not say it yet")?;
    let expected = gaugeblock_reference::run(&scenario).0;
    check_exportable(&scenario, &expected)?;
    let limits = case.limits().map_err(|_| "its machine is not known")?;
    let begun = new_question(digest_of_motion(&scenario, &limits), rule, &scenario);
    let exported =
        ExportedProgram { variables: Vec::new(), messages: false, samples: true, ..begun.exported };
    Ok(Question { exported, scenario, limits: Some(limits) })
}

/// What has to be set up, as a text that sorts: the usual first.
fn setup_key(question: &Question) -> (bool, bool, String) {
    let Question { scenario, limits, exported: _ } = question;
    let usual = Scenario::default();
    let Program { block_delete, start, .. } = &scenario.program;
    let is_usual = scenario.machine == usual.machine
        && Environment { name: None, ..scenario.environment.clone() } == usual.environment
        && !block_delete
        && *start == usual.program.start;
    let environment = Environment { name: None, ..scenario.environment.clone() };
    let text =
        serde_json::to_string(&(&scenario.machine, &environment, block_delete, start, limits));
    (limits.is_some(), !is_usual, text.unwrap_or_default())
}

fn texts(program: &Program) -> impl Iterator<Item = &str> {
    std::iter::once(program.main.as_str()).chain(program.files.values().map(String::as_str))
}

/// The numbers after a `#`.
fn named_variables(program: &Program) -> BTreeSet<u32> {
    let mut numbers = BTreeSet::new();
    for rest in texts(program).flat_map(|text| text.split('#').skip(1)) {
        let digits = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
        numbers.extend(rest[..digits].parse::<u32>());
    }
    numbers.retain(|number| (1..=9999).contains(number));
    numbers
}

/// The variables that are asserted of the end.
fn asserted_variables(claim: &Claim) -> Vec<u32> {
    let Claim::AtEnd(fields) = claim else { return Vec::new() };
    let parameters = fields.iter().filter(|field| field.field == "parameter");
    parameters.filter_map(|field| field.index.as_deref()?.parse().ok()).collect()
}

/// Whether a comment of the program may show something.
fn has_messages(program: &Program) -> bool {
    texts(program).any(|text| {
        let compact: String = text.chars().filter(|c| !c.is_whitespace()).collect();
        let compact = compact.to_lowercase();
        ["(msg,", "(debug,", "(print,", "(log,"].iter().any(|words| compact.contains(words))
    })
}

/// Checks that an edition's programs can be exported.
///
/// # Errors
/// The reason why not.
pub fn check_language(edition: &Edition) -> Result<(), String> {
    match edition.language {
        Language::Rs274 => Ok(()),
        Language::Nct | Language::Gpp => {
            Err(format!("{} is of another language than RS-274", edition.id))
        }
    }
}
