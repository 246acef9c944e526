//! A card for each divergence on the page: the sentence, what happened, and the first difference.

use gaugeblock_compare::StateDifference;
use gaugeblock_runner::certify::{CaseResult, RuleDivergence};
use gaugeblock_suite::only_case;
use serde::Serialize;

use super::Report;
use super::abridge::abridged;
use super::grouping::{explain, size, title, without_guard};
use super::side_by_side::{Row, side_by_side};

/// Bytes of programs and traces of all cards together; the rest is only in the JSON report.
const TRACE_BYTES_MAX: usize = 1 << 20;

/// What the page adds to each line of a trace.
const LINE_MARKUP_BYTES: usize = 16;

/// Most cards of a finding. Its other cases are listed by name: their cards would repeat the difference.
const CARDS_MAX: usize = 16;

/// A divergence on the page.
#[derive(Debug, Serialize)]
pub(super) struct Card<'a> {
    rule: &'a str,
    case: &'a str,
    word: &'static str,
    class: String,
    /// What accepts it: expectations, baseline or waiver.
    excuse: Option<&'a str>,
    sentence: &'a str,
    sources: String,
    assertion: Option<(String, String)>,
    divergence: Option<&'a str>,
    explanation: Option<String>,
    repeated: bool,
    program: &'a str,
    shrunk: Option<&'a str>,
    /// The call that runs the case again.
    command: String,
    state: Option<&'a StateDifference>,
    /// Both traces, aligned.
    rows: Vec<Row<'a>>,
    /// Whether the traces are left out, because the page would be too large.
    short: bool,
    /// A picture of the motion, made of numbers only.
    picture: Option<String>,
}

/// A verdict's word in the style sheet of the page.
pub(super) fn class(word: &str) -> String {
    word.replace(' ', "-")
}

/// The cards of a finding.
#[derive(Debug, Serialize)]
pub(super) struct Kind<'a> {
    /// What differs, or what explains it.
    what: String,
    /// The rule that is broken; none if the cause is unknown.
    rule: Option<&'a str>,
    severity: &'static str,
    /// Other rules of which an assertion fails by it.
    touched: Vec<&'a str>,
    size: String,
    class: String,
    /// The one with the smallest program first.
    cases: Vec<Card<'a>>,
    /// The cases that are listed by name.
    others: Vec<Other<'a>>,
}

/// A case that is listed by name.
#[derive(Debug, Serialize)]
struct Other<'a> {
    rule: &'a str,
    case: &'a str,
    word: &'static str,
    class: String,
}

impl Kind<'_> {
    /// Whether it has a case of a rule.
    pub(super) fn has(&self, rule: &str) -> bool {
        let cards = self.cases.iter().map(|card| card.rule);
        cards.chain(self.others.iter().map(|other| other.rule)).any(|other| other == rule)
    }
}

/// All findings, the worst first.
pub(super) fn kinds<'a>(report: &'a Report<'_>) -> Vec<Kind<'a>> {
    let mut left = TRACE_BYTES_MAX;
    let mut card = |(result, divergence): (&'a CaseResult<'_>, &'a RuleDivergence)| {
        let mut card = card(report, result, divergence);
        let traces = divergence.traces.as_ref();
        let texts = traces.map_or(["", ""], |traces| [traces.expected.as_str(), &traces.found]);
        let size: usize =
            texts.iter().map(|text| text.len() + LINE_MARKUP_BYTES * text.lines().count()).sum();
        match left.checked_sub(size + result.program.len()) {
            Some(rest) => {
                left = rest;
                card.rows =
                    traces.map(|traces| side_by_side(traces, &result.masked)).unwrap_or_default();
            }
            None => card.short = true,
        }
        card
    };
    let controller = &report.header.controller;
    let kinds = report.findings().iter().map(|finding| {
        let cases: Vec<_> = finding.divergent().take(CARDS_MAX).map(&mut card).collect();
        let others = finding.divergent().skip(CARDS_MAX).map(|(result, _)| {
            let word = result.verdict.word();
            Other { rule: &result.rule.id, case: result.name, word, class: class(word) }
        });
        let class = cases.first().map(|card| card.class.clone()).unwrap_or_default();
        Kind {
            what: title(controller, finding),
            rule: finding.rule.map(|rule| rule.id.as_str()),
            severity: finding.severity.heading(),
            touched: finding.touched_rules().into_iter().collect(),
            size: size(finding),
            class,
            cases,
            others: others.collect(),
        }
    });
    kinds.collect()
}

fn card<'a>(
    report: &Report<'_>,
    result: &'a CaseResult<'_>,
    divergence: &'a RuleDivergence,
) -> Card<'a> {
    let assertion = divergence.assertion.as_ref();
    let word = result.verdict.word();
    Card {
        rule: &result.rule.id,
        case: result.name,
        word,
        class: class(word),
        excuse: result.verdict.accepted_by(),
        sentence: &result.rule.sentence,
        sources: report.sections(result.rule).join("; "),
        assertion: assertion.map(|(said, found)| abridged(without_guard(said), found)),
        divergence: divergence.difference.as_deref(),
        explanation: explain(&report.header.controller, divergence)
            .map(|explanation| explanation.text),
        repeated: result.rerun,
        command: format!(
            "gaugeblock certify --controller CONTROLLER --edition {} --only '{}' -v",
            report.run.edition.id,
            only_case(&result.rule.id, result.name).replace('\'', r"'\''")
        ),
        program: result.program,
        shrunk: divergence.shrunk.as_deref(),
        state: divergence.state.as_ref(),
        rows: Vec::new(),
        short: false,
        picture: result.sketch.as_ref().map(gaugeblock_motion::Sketch::svg),
    }
}
