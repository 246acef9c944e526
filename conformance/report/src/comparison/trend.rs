//! The runs of one controller over time.

use std::collections::BTreeSet;

use super::document::{CellVerdict, Trend, TrendRun};
use super::read::ComparedReport;
use crate::json::MissingRule;

/// The trend of each column with several runs.
pub(super) fn trends(columns: &[Vec<&ComparedReport>]) -> Vec<Trend> {
    columns.iter().filter_map(|runs| trend(runs)).collect()
}

fn trend(runs: &[&ComparedReport]) -> Option<Trend> {
    let [first, _, ..] = runs else { return None };
    let before = std::iter::once(None).chain(runs.iter().map(Some));
    Some(Trend {
        name: first.name.clone(),
        edition: first.header.edition.clone(),
        runs: runs.iter().zip(before).map(|(run, before)| trend_run(run, before)).collect(),
    })
}

fn trend_run(run: &ComparedReport, before: Option<&&ComparedReport>) -> TrendRun {
    let passing = |report: &ComparedReport| -> BTreeSet<String> {
        let pass = report.rules.iter().filter(|(_, rule)| rule.cell.verdict == CellVerdict::Pass);
        pass.map(|(id, _)| id.clone()).collect()
    };
    let now = passing(run);
    let earlier = before.map(|report| passing(report));
    let earlier = earlier.as_ref().unwrap_or(&now);
    let lost = earlier.difference(&now).map(|rule| MissingRule {
        rule: rule.clone(),
        verdict: run.verdict(rule).word().to_owned(),
    });
    TrendRun {
        date: run.date.to_string(),
        version: run.header.version.clone(),
        suite: run.header.suite.clone(),
        counts: run.counts(),
        gained: now.difference(earlier).cloned().collect(),
        lost: lost.collect(),
    }
}
