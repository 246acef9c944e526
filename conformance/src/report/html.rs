//! The report as one page that needs nothing beside it: worst first, with a search, and what each divergence is.
//!
//! What a controller says stands in it as text, whatever it is: the template escapes everything.

use minijinja::Environment;
use minijinja::value::Serde;
use serde::Serialize;

use super::terminal::without_guard;
use super::{Report, RuleVerdict, json};
use crate::certify::{CaseResult, Departure, Traces, Verdict};

const PAGE: &str = include_str!("page.html");

/// The report as HTML.
///
/// # Errors
/// The template does not fit: a fault of this program.
pub fn html(report: &Report<'_>) -> Result<String, String> {
    let render = || {
        let mut environment = Environment::new();
        environment.add_template("page.html", PAGE)?;
        environment.get_template("page.html")?.render(Serde(page(report)))
    };
    render().map_err(|error: minijinja::Error| format!("{error:#}"))
}

/// What the page shows.
#[derive(Debug, Serialize)]
struct Page<'a> {
    controller: &'a str,
    version: &'a str,
    edition: &'a str,
    sentence: &'a str,
    says: &'static str,
    notes: &'a [String],
    counts: Vec<Count>,
    troubles: Option<Vec<String>>,
    profiles: serde_json::Value,
    divergences: Vec<Card<'a>>,
    rules: Vec<Row<'a>>,
    not_judged: Vec<Open<'a>>,
    unsupported: Vec<Unsupported<'a>>,
    void: serde_json::Value,
    basis: String,
    masked: String,
    gaugeblock_version: &'a str,
    suite: &'a str,
    options: String,
}

fn page<'a>(report: &'a Report<'_>) -> Page<'a> {
    let header = &report.header;
    let mut json = json::json(report);
    let masked: Vec<_> = report.masked().into_keys().collect();
    let reasons = report.unsupported().into_iter();
    let mut unsupported: Vec<_> = reasons.map(|(why, cases)| Unsupported { why, cases }).collect();
    unsupported.sort_by(|a, b| b.cases.cmp(&a.cases).then_with(|| a.why.cmp(b.why)));
    let troubles = report.troubles.as_ref();
    let options = header.options.0.iter().map(|(id, option)| format!("{id} = {option}"));
    Page {
        controller: &header.controller,
        version: &header.version,
        edition: &header.edition,
        sentence: &report.run.edition.sentence,
        says: says(report),
        notes: &report.notes,
        counts: counts(report),
        troubles: troubles.map(|all| all.iter().map(ToString::to_string).collect()),
        profiles: json["profiles"].take(),
        divergences: divergences(report),
        rules: rules(report),
        not_judged: not_judged(report),
        unsupported,
        void: json["void"].take(),
        basis: basis(report),
        masked: if masked.is_empty() { "nothing".to_owned() } else { masked.join(", ") },
        gaugeblock_version: &header.gaugeblock_version,
        suite: &header.suite,
        options: options.collect::<Vec<_>>().join(", "),
    }
}

#[derive(Debug, Serialize)]
struct Count {
    name: &'static str,
    count: usize,
    class: &'static str,
}

#[derive(Debug, Serialize)]
struct Unsupported<'a> {
    why: &'a str,
    cases: usize,
}

#[derive(Debug, Serialize)]
struct Card<'a> {
    rule: &'a str,
    case: &'a str,
    sentence: &'a str,
    sources: String,
    assertion: Option<(&'a str, &'a str)>,
    divergence: &'a Option<String>,
    explanation: String,
    program: &'a str,
    sides: Vec<Side<'a>>,
}

#[derive(Debug, Serialize)]
struct Side<'a> {
    name: &'static str,
    blocks: Vec<Part<'a>>,
}

#[derive(Debug, Serialize)]
struct Part<'a> {
    text: &'a str,
    differs: bool,
}

#[derive(Debug, Serialize)]
struct Row<'a> {
    rule: &'a str,
    verdict: &'static str,
    class: &'static str,
    sentence: &'a str,
    sources: String,
    cases: usize,
}

#[derive(Debug, Serialize)]
struct Open<'a> {
    rule: &'a str,
    case: &'a str,
    why: &'a str,
}

/// What the whole comes to, in a sentence.
pub(super) fn says(report: &Report<'_>) -> &'static str {
    match report.exit_status() {
        0 if report.troubles.is_some() => "It does what is known of it, and nothing else.",
        0 => "It does what the documents say, in everything that was judged.",
        1 => "It departs from what it is held to.",
        _ => "Something could not be judged: this is no certificate.",
    }
}

fn counts(report: &Report<'_>) -> Vec<Count> {
    let counts = report.counts();
    let count = |name, count, class| Count { name, count, class };
    vec![
        count("cases", counts.all(), ""),
        count("pass", counts.pass, "pass"),
        count("diverge", counts.diverges, "diverges"),
        count("pass but for a quirk of other rules", counts.charged_elsewhere, "charged"),
        count("unsupported", counts.unsupported, "unsupported"),
        count("not judged", counts.not_judged, "not-judged"),
    ]
}

/// The divergences that nothing explains first.
fn divergences<'a>(report: &'a Report<'_>) -> Vec<Card<'a>> {
    let departed = |result: &'a CaseResult<'_>| match &result.verdict {
        Verdict::Diverges(departure) => Some((result, departure)),
        Verdict::Pass
        | Verdict::ChargedElsewhere(_)
        | Verdict::Unsupported(_)
        | Verdict::Inconclusive(_)
        | Verdict::NotJudged(_) => None,
    };
    let mut all: Vec<_> = report.run.cases.iter().filter_map(departed).collect();
    all.sort_by_key(|(_, departure)| !departure.explanation.is_empty());
    all.into_iter().map(|(result, departure)| card(result, departure)).collect()
}

fn card<'a>(result: &'a CaseResult<'_>, departure: &'a Departure) -> Card<'a> {
    let sources = result.rule.sources.iter().map(ToString::to_string);
    let assertion = departure.assertion.as_ref();
    Card {
        rule: &result.rule.id,
        case: result.name,
        sentence: &result.rule.sentence,
        sources: sources.collect::<Vec<_>>().join("; "),
        assertion: assertion.map(|(said, found)| (without_guard(said), found.as_str())),
        divergence: &departure.divergence,
        explanation: departure.explanation.join(" and "),
        program: result.program,
        sides: departure.traces.as_ref().map(sides).unwrap_or_default(),
    }
}

/// Both traces, block by block; those that are not the same at the same place are marked.
fn sides(traces: &Traces) -> Vec<Side<'_>> {
    let (expected, found) = (blocks(&traces.expected), blocks(&traces.found));
    let marked = |own: &[&'_ str], other: &[&str]| -> Vec<bool> {
        own.iter().enumerate().map(|(at, text)| other.get(at) != Some(text)).collect()
    };
    let differs = (marked(&expected, &found), marked(&found, &expected));
    [("by the documents", expected, differs.0), ("on the controller", found, differs.1)]
        .into_iter()
        .map(|(name, blocks, differs)| {
            let parts = blocks.into_iter().zip(differs);
            Side { name, blocks: parts.map(|(text, differs)| Part { text, differs }).collect() }
        })
        .collect()
}

/// The parts of a trace: what stands before the first block, the blocks, and what stands behind them.
fn blocks(trace: &str) -> Vec<&str> {
    let mut parts = Vec::new();
    let mut begin = 0;
    for (at, _) in trace.match_indices('\n') {
        let rest = &trace[at + 1..];
        if !rest.starts_with(' ') {
            parts.push(&trace[begin..at]);
            begin = at + 1;
        }
    }
    parts.push(trace[begin..].trim_end());
    parts.retain(|part| !part.is_empty());
    parts
}

/// The worst first.
fn rules<'a>(report: &'a Report<'_>) -> Vec<Row<'a>> {
    let mut rules = report.rules();
    let class = |verdict| match verdict {
        RuleVerdict::Diverges => (0, "diverges"),
        RuleVerdict::NotJudged => (1, "not-judged"),
        RuleVerdict::Unsupported => (2, "unsupported"),
        RuleVerdict::Pass => (3, "pass"),
    };
    rules.sort_by_key(|result| class(result.verdict));
    let row = |result: super::RuleResult<'a>| Row {
        rule: &result.rule.id,
        verdict: result.verdict.word(),
        class: class(result.verdict).1,
        sentence: &result.rule.sentence,
        sources: result.rule.sources.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "),
        cases: result.counts.all(),
    };
    rules.into_iter().map(row).collect()
}

fn not_judged<'a>(report: &'a Report<'_>) -> Vec<Open<'a>> {
    let why = |result: &'a CaseResult<'_>| match &result.verdict {
        Verdict::Inconclusive(why) | Verdict::NotJudged(why) => {
            Some(Open { rule: &result.rule.id, case: result.name, why })
        }
        Verdict::Pass
        | Verdict::Diverges(_)
        | Verdict::ChargedElsewhere(_)
        | Verdict::Unsupported(_) => None,
    };
    report.run.cases.iter().filter_map(why).collect()
}

/// How many values of each kind were compared.
fn basis(report: &Report<'_>) -> String {
    let mut all = crate::compare::Tally::default();
    report.run.cases.iter().for_each(|result| all.extend(&result.compared));
    format!(
        "{} values were compared: assertions of people, and everything else that happens.",
        all.total()
    )
}
