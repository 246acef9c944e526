//! The matrix of `gaugeblock suite matrix`. A row is a section of a document: how its sentences are classified, the
//! rules that carry them, and each controller's verdicts on these rules with the kinds of value that were compared.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use gaugeblock_compare::{ComparedKind, Tally};
use gaugeblock_runner::certify::Scope;
use gaugeblock_suite::ledger::{Item, Ledger, Section};
use serde::Deserialize;
use serde_json::{Value, json};

use super::merge::read;
use super::{Report, RuleVerdict};

/// The verdicts of one run of the suite, by rule.
#[derive(Clone, Debug)]
pub struct Judged {
    /// The controller and its version.
    pub controller: String,
    /// The edition that it was compared with.
    pub edition: String,
    /// Verdict and compared kinds, by rule.
    rules: BTreeMap<String, (RuleVerdict, Tally)>,
}

/// The parts of a JSON report that the matrix reads.
#[derive(Deserialize)]
struct Written {
    controller: String,
    version: String,
    edition: String,
    #[serde(default)]
    scope: Scope,
    rules: Vec<WrittenRule>,
}

#[derive(Deserialize)]
struct WrittenRule {
    rule: String,
    verdict: RuleVerdict,
    compared: Tally,
}

impl Judged {
    /// The verdicts of a report.
    pub fn of(report: &Report<'_>) -> Self {
        let rules = report.rules().into_iter();
        Self {
            controller: format!("{} {}", report.header.controller, report.header.version),
            edition: report.run.edition.id.clone(),
            rules: rules
                .map(|rule| (rule.rule.id.clone(), (rule.verdict, rule.compared)))
                .collect(),
        }
    }

    /// Reads a report that `certify --format json` or `--report` wrote.
    ///
    /// # Errors
    /// The text is not such a report. The caller writes the name of the file before the message.
    pub fn read(text: &str) -> Result<Self, String> {
        let written: Written = read(text)?;
        if let Some(scope) = written.scope.note() {
            return Err(format!(
                "has the scope {scope:?}; expected a report without --assertions-only"
            ));
        }
        let rules = written.rules.into_iter();
        Ok(Self {
            controller: format!("{} {}", written.controller, written.version),
            edition: written.edition,
            rules: rules.map(|rule| (rule.rule, (rule.verdict, rule.compared))).collect(),
        })
    }
}

/// What became of the items of a section.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Items {
    all: usize,
    carried: usize,
    not_observable: usize,
    out_of_scope: usize,
    later: usize,
}

/// Verdicts on the rules of a section; rules that are void in the edition count nowhere.
#[derive(Clone, Debug, Default)]
struct Verdicts {
    pass: usize,
    diverges: usize,
    unsupported: usize,
    not_judged: usize,
    rests_on: Tally,
}

/// The matrix of some documents.
#[derive(Debug)]
pub struct Matrix<'a> {
    ledgers: &'a [Ledger],
    /// The model under the edition of each document, by edition.
    model: &'a BTreeMap<String, Judged>,
    judged: &'a [Judged],
}

impl<'a> Matrix<'a> {
    /// A matrix of documents, with a column for the model and one for each controller.
    pub fn new(
        ledgers: &'a [Ledger],
        model: &'a BTreeMap<String, Judged>,
        judged: &'a [Judged],
    ) -> Self {
        Self { ledgers, model, judged }
    }

    /// As tables for a person.
    pub fn text(&self) -> String {
        let mut text = String::new();
        for ledger in self.ledgers {
            self.table(&mut text, ledger);
        }
        self.legend(&mut text);
        text
    }

    /// As one JSON document.
    pub fn json(&self) -> Value {
        let documents: Vec<Value> = self
            .ledgers
            .iter()
            .map(|ledger| {
                let sections: Vec<Value> =
                    ledger.sections.iter().map(|section| self.section(ledger, section)).collect();
                json!({ "document": ledger.document, "title": ledger.title, "sections": sections })
            })
            .collect();
        let controllers: Vec<Value> = self
            .judged
            .iter()
            .map(|j| json!({ "controller": j.controller, "edition": j.edition }))
            .collect();
        json!({
            "gaugeblock": "matrix",
            "schema": gaugeblock_vocabulary::schema::VERSION,
            "controllers": controllers,
            "documents": documents,
        })
    }

    fn section(&self, ledger: &Ledger, section: &Section) -> Value {
        let rules = rules_of(&section.items);
        let items = count(&section.items);
        let verdicts: Vec<Value> =
            self.columns(ledger).map(|column| verdicts(column, &rules).json()).collect();
        json!({
            "section": section.name,
            "items": {
                "all": items.all, "carried": items.carried, "not_observable": items.not_observable,
                "out_of_scope": items.out_of_scope, "later": items.later,
            },
            "rules": rules,
            "model": verdicts.first(),
            "controllers": verdicts.get(1..),
        })
    }

    /// The model's column of a document, then one for each controller.
    fn columns(&self, ledger: &Ledger) -> impl Iterator<Item = Option<&Judged>> {
        std::iter::once(self.model.get(&ledger.edition)).chain(self.judged.iter().map(Some))
    }

    fn table(&self, text: &mut String, ledger: &Ledger) {
        let _infallible = writeln!(text, "{}: {}", ledger.document, ledger.title);
        let _infallible = write!(
            text,
            "{:<44}{:>6}{:>8}{:>8}{:>7}{:>6} {:>6}  {:<18}",
            "section", "items", "carried", "unseen", "scope", "later", "rules", "model"
        );
        for judged in self.judged {
            let _infallible =
                write!(text, "  {:<26}", format!("{} ({})", judged.controller, judged.edition));
        }
        text.push('\n');
        for section in &ledger.sections {
            self.row(text, ledger, &section.name, &section.items);
        }
        let all: Vec<Item> =
            ledger.sections.iter().flat_map(|section| section.items.clone()).collect();
        self.row(text, ledger, "all", &all);
        text.push('\n');
    }

    fn row(&self, text: &mut String, ledger: &Ledger, name: &str, items: &[Item]) {
        let rules = rules_of(items);
        let counts = count(items);
        let name: String = name.chars().take(43).collect();
        let dot = |count: usize| if count == 0 { "·".to_owned() } else { count.to_string() };
        let _infallible = write!(
            text,
            "{name:<44}{:>6}{:>8}{:>8}{:>7}{:>6} {:>6}",
            counts.all,
            dot(counts.carried),
            dot(counts.not_observable),
            dot(counts.out_of_scope),
            dot(counts.later),
            dot(rules.len())
        );
        for (place, column) in self.columns(ledger).enumerate() {
            let width = if place == 0 { 18 } else { 26 };
            let _infallible = write!(text, "  {:<width$}", verdicts(column, &rules).text());
        }
        let end = text.trim_end().len();
        text.truncate(end);
        text.push('\n');
    }

    fn legend(&self, text: &mut String) {
        let letters: Vec<String> = ComparedKind::ALL
            .iter()
            .map(|basis| format!("{} {}", basis.letter(), basis.words()))
            .collect();
        let _infallible = writeln!(
            text,
            "verdicts: rules that pass, then diverging +d, unsupported +u, not judged +n; and what they rest on: {}",
            letters.join(", ")
        );
    }
}

impl Verdicts {
    fn text(&self) -> String {
        if self.pass + self.diverges + self.unsupported + self.not_judged == 0 {
            return "·".to_owned();
        }
        let mut text = self.pass.to_string();
        for (count, letter) in
            [(self.diverges, 'd'), (self.unsupported, 'u'), (self.not_judged, 'n')]
        {
            if count > 0 {
                let _infallible = write!(text, "+{count}{letter}");
            }
        }
        let letters = self.rests_on.letters();
        if letters.is_empty() { text } else { format!("{text} {letters}") }
    }

    fn json(&self) -> Value {
        json!({
            "pass": self.pass, "diverges": self.diverges, "unsupported": self.unsupported,
            "not_judged": self.not_judged, "rests_on": self.rests_on,
        })
    }
}

fn rules_of(items: &[Item]) -> BTreeSet<&str> {
    items.iter().flat_map(|item| &item.rules).map(String::as_str).collect()
}

/// An item that rules carry in part counts as carried and as later.
fn count(items: &[Item]) -> Items {
    let mut counts = Items { all: items.len(), ..Items::default() };
    for item in items {
        counts.carried += usize::from(!item.rules.is_empty() || !item.choices.is_empty());
        counts.not_observable += usize::from(item.not_observable.is_some());
        counts.out_of_scope += usize::from(item.out_of_scope.is_some());
        counts.later += usize::from(item.later.is_some());
    }
    counts
}

fn verdicts(column: Option<&Judged>, rules: &BTreeSet<&str>) -> Verdicts {
    let mut verdicts = Verdicts::default();
    let known = rules.iter().filter_map(|rule| column?.rules.get(*rule));
    for (verdict, rests_on) in known {
        match verdict {
            RuleVerdict::Pass => verdicts.pass += 1,
            RuleVerdict::Diverges => verdicts.diverges += 1,
            RuleVerdict::Unsupported => verdicts.unsupported += 1,
            RuleVerdict::NotJudged => verdicts.not_judged += 1,
        }
        verdicts.rests_on.extend(rests_on);
    }
    verdicts
}
