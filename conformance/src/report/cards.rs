//! A card for each divergence on the page: what was demanded, what happened, and where the two part.

use serde::Serialize;

use super::Report;
use super::terminal::without_guard;
use crate::certify::{CaseResult, Departure, Traces};
use crate::compare::StateDifference;

/// Bytes of programs and traces that all cards together may have; what is beyond is in the JSON report alone.
const MOST: usize = 1 << 20;

/// What the page shows of a divergence.
#[derive(Debug, Serialize)]
pub(super) struct Card<'a> {
    rule: &'a str,
    case: &'a str,
    word: &'static str,
    class: String,
    /// Who knows of it, or answers for it.
    excuse: Option<&'a str>,
    sentence: &'a str,
    sources: String,
    assertion: Option<(&'a str, &'a str)>,
    divergence: Option<&'a str>,
    explanation: String,
    repeated: bool,
    program: &'a str,
    shrunk: Option<&'a str>,
    state: Option<&'a StateDifference>,
    sides: Vec<Side<'a>>,
    /// Whether the traces are left out, since the page would be too large.
    short: bool,
    /// A picture of the motion, made of nothing but numbers.
    picture: Option<String>,
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

/// A verdict's word as the page's style sheet names it.
pub(super) fn class(word: &str) -> String {
    word.replace(' ', "-")
}

/// The worst first: what nobody knows of, of that what nothing explains.
pub(super) fn cards<'a>(report: &'a Report<'_>) -> Vec<Card<'a>> {
    let departed = |result: &'a CaseResult<'_>| Some((result, result.verdict.own_departure()?));
    let mut all: Vec<_> = report.run.cases.iter().filter_map(departed).collect();
    all.sort_by_key(|(result, departure)| {
        (result.verdict.excuse().is_some(), !departure.explanation.is_empty())
    });
    let mut left = MOST;
    let card = |(result, departure)| {
        let mut card = card(result, departure);
        let traces = departure.traces.as_ref();
        let size = traces.map_or(0, |traces| traces.expected.len() + traces.found.len());
        match left.checked_sub(size + result.program.len()) {
            Some(rest) => {
                left = rest;
                card.sides = traces.map(sides).unwrap_or_default();
            }
            None => card.short = true,
        }
        card
    };
    all.into_iter().map(card).collect()
}

fn card<'a>(result: &'a CaseResult<'_>, departure: &'a Departure) -> Card<'a> {
    let sources = result.rule.sources.iter().map(ToString::to_string);
    let assertion = departure.assertion.as_ref();
    let word = result.verdict.word();
    Card {
        rule: &result.rule.id,
        case: result.name,
        word,
        class: class(word),
        excuse: result.verdict.excuse(),
        sentence: &result.rule.sentence,
        sources: sources.collect::<Vec<_>>().join("; "),
        assertion: assertion.map(|(said, found)| (without_guard(said), found.as_str())),
        divergence: departure.divergence.as_deref(),
        explanation: departure.explanation.join(" and "),
        repeated: result.repeated,
        program: result.program,
        shrunk: departure.shrunk.as_deref(),
        state: departure.state.as_ref(),
        sides: Vec::new(),
        short: false,
        picture: result.sketch.as_ref().map(crate::motion::Sketch::svg),
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
