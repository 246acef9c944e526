//! The tables of a comparison.

use std::collections::{BTreeMap, BTreeSet};

use super::document::{
    Alone, Cell, CellVerdict, ChapterRow, Distance, LimitRow, ProfileRow, RuleCounts, RuleRow,
};
use super::read::ComparedReport;
use crate::json::MissingRule;

/// Each rule of one of the reports, ordered by id.
pub(super) fn rows(reports: &[&ComparedReport]) -> Vec<RuleRow> {
    let run = reports.iter().flat_map(|report| report.rules.keys());
    let void = reports.iter().flat_map(|report| &report.void);
    let ids: BTreeSet<&String> = run.chain(void).collect();
    ids.into_iter().map(|id| row(id, reports)).collect()
}

fn row(id: &str, reports: &[&ComparedReport]) -> RuleRow {
    let cells: Vec<Cell> = reports.iter().map(|report| cell(id, report)).collect();
    let judged = cells.iter().map(|cell| cell.verdict).filter(|verdict| verdict.is_judged());
    let verdicts: BTreeSet<CellVerdict> = judged.collect();
    let read = reports.iter().find_map(|report| report.rules.get(id));
    RuleRow {
        rule: id.to_owned(),
        chapter: id.split('.').next().unwrap_or_default().to_owned(),
        sentence: read.map(|rule| rule.sentence.clone()).unwrap_or_default(),
        profile: read.map(|rule| rule.profile.clone()).unwrap_or_default(),
        differs: verdicts.len() > 1,
        cells,
    }
}

fn cell(id: &str, report: &ComparedReport) -> Cell {
    let without = |verdict| Cell { verdict, pass: 0, diverges: 0, cases: 0, why: None };
    match report.rules.get(id) {
        Some(rule) => rule.cell.clone(),
        None => without(report.verdict(id)),
    }
}

/// How many rules of each chapter pass on so many controllers.
pub(super) fn chapters(rules: &[RuleRow], controllers: usize) -> Vec<ChapterRow> {
    let mut chapters: BTreeMap<&str, Vec<RuleCounts>> = BTreeMap::new();
    for row in rules {
        let none = || vec![RuleCounts::default(); controllers];
        let counts = chapters.entry(&row.chapter).or_insert_with(none);
        for (count, cell) in counts.iter_mut().zip(&row.cells) {
            count.add(cell.verdict);
        }
    }
    let row = |(chapter, counts): (&str, _)| ChapterRow { chapter: chapter.to_owned(), counts };
    chapters.into_iter().map(row).collect()
}

/// Each profile of the reports, in their order.
pub(super) fn profiles(reports: &[&ComparedReport]) -> Vec<ProfileRow> {
    let mut rows: Vec<ProfileRow> = Vec::new();
    for (place, report) in reports.iter().enumerate() {
        for judged in &report.profiles {
            let distance = Distance {
                version: judged.version,
                passes: judged.passes,
                pass: judged.pass,
                rules: judged.rules,
                missing: judged.missing.clone(),
            };
            let index = rows.iter().position(|row| row.profile == judged.profile);
            let index = index.unwrap_or_else(|| {
                rows.push(ProfileRow {
                    profile: judged.profile.clone(),
                    sentence: judged.sentence.clone(),
                    distances: vec![None; reports.len()],
                });
                rows.len() - 1
            });
            rows[index].distances[place] = Some(distance);
        }
    }
    rows
}

/// Each quantity that was measured of one of the controllers, with the results of all.
pub(super) fn limits(reports: &[&ComparedReport]) -> Vec<LimitRow> {
    let mut rows: Vec<LimitRow> = Vec::new();
    for (place, report) in reports.iter().enumerate() {
        for measurement in &report.measurements {
            let index = rows.iter().position(|row| row.id == measurement.id);
            let index = index.unwrap_or_else(|| {
                rows.push(LimitRow {
                    id: measurement.id.clone(),
                    title: measurement.title.clone(),
                    results: vec![None; reports.len()],
                });
                rows.len() - 1
            });
            rows[index].results[place] = Some(measurement.result());
        }
    }
    rows
}

/// What only one of so many controllers does, among those that were judged on the same rule.
pub(super) fn alone(rules: &[RuleRow], controllers: usize) -> Vec<Alone> {
    let mut alone = vec![Alone::default(); controllers];
    for row in rules {
        let judged = row.cells.iter().enumerate().filter(|(_, cell)| cell.verdict.is_judged());
        let (passing, failing): (Vec<_>, Vec<_>) =
            judged.partition(|(_, cell)| cell.verdict == CellVerdict::Pass);
        match (passing.as_slice(), failing.as_slice()) {
            ([], _) | (_, []) => {}
            ([(place, _)], _) => alone[*place].passes.push(row.rule.clone()),
            (_, [(place, cell)]) => alone[*place].fails.push(MissingRule {
                rule: row.rule.clone(),
                verdict: cell.verdict.word().to_owned(),
            }),
            _ => {}
        }
    }
    alone
}
