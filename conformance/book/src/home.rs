//! The first page: what the site is, and the ways into it.

use std::collections::BTreeMap;

use gaugeblock_report::comparison::LimitRow;
use serde::Serialize;

use super::address;
use super::contents::Book;
use super::site::Site;

#[derive(Debug, Serialize)]
struct Home {
    rules: usize,
    cases: usize,
    choices: usize,
    documents: usize,
    chapters: Vec<Chapter>,
    profiles: Vec<Profile>,
    /// The measured limits of the controllers.
    limits: Vec<LimitRow>,
    /// The controllers of the reports, in the order of the shares.
    controllers: Vec<String>,
}

#[derive(Debug, Serialize)]
struct Chapter {
    name: String,
    address: String,
    rules: usize,
    cases: usize,
    /// Share of the rules that each controller passes, in percent.
    shares: Vec<String>,
}

#[derive(Debug, Serialize)]
struct Profile {
    name: String,
    sentence: String,
    rules: usize,
}

pub(super) fn add(book: &Book<'_>, site: &mut Site) -> Result<(), String> {
    let suite = book.suite;
    let count = |rule: &gaugeblock_suite::Rule| rule.cases.len() + rule.motion.len();
    let mut chapters: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
    for rule in &suite.rules {
        let (rules, cases) = chapters.entry(rule.chapter()).or_default();
        *rules += 1;
        *cases += count(rule);
    }
    let shares = |chapter: &str| {
        let comparison = book.comparison?;
        let row = comparison.chapters.iter().find(|row| row.chapter == chapter)?;
        let share = |counts: &gaugeblock_report::comparison::RuleCounts| match counts.rules {
            0 => String::new(),
            rules => format!("{} %", 100 * counts.pass / rules),
        };
        Some(row.counts.iter().map(share).collect())
    };
    let home = Home {
        rules: suite.rules.len(),
        cases: suite.rules.iter().map(count).sum(),
        choices: suite.choices.len() + suite.motion_choices.len(),
        documents: book.ledgers.len(),
        chapters: chapters
            .into_iter()
            .map(|(name, (rules, cases))| Chapter {
                name: name.to_owned(),
                address: address::chapter(name),
                rules,
                cases,
                shares: shares(name).unwrap_or_default(),
            })
            .collect(),
        profiles: suite
            .profiles
            .iter()
            .map(|profile| Profile {
                name: profile.id.clone(),
                sentence: profile.sentence.clone(),
                rules: suite.rules_of(profile).len(),
            })
            .collect(),
        limits: book.comparison.map_or_else(Vec::new, |comparison| comparison.limits.clone()),
        controllers: book.comparison.map_or_else(Vec::new, |comparison| {
            comparison.controllers.iter().map(|column| column.name.clone()).collect()
        }),
    };
    site.add("index.html", "home.html", ["home", "Gaugeblock: the rules"], home)
}
