//! A case on a page: its program line by line beside what the documents demand of each line.

use std::collections::BTreeMap;

use gaugeblock_suite::{Case, Edition, MotionCase, Rule, Setup, Suite, scenario_of};
use gaugeblock_vocabulary::{Language, Options, Outcome, Scenario};
use serde::Serialize;

use super::settings::{motion_settings, setting_lines, setup_settings};

/// Most executed blocks that a page lists.
const BLOCKS_MAX: usize = 60;

/// The edition of a trace, where it has the case: the one with most rules.
const USUAL_EDITION: &str = "linuxcnc-2.9";

/// A case.
#[derive(Debug, Default, Serialize)]
pub(super) struct CaseView {
    /// Its place in the page; empty where it has none.
    anchor: String,
    pub(super) name: String,
    why: String,
    /// The editions that alone have it.
    only: Vec<String>,
    /// The numbered program, if what is executed is not one block after the other.
    program: Vec<Line>,
    files: Vec<FileView>,
    settings: Vec<String>,
    /// Which edition the trace is of.
    edition: Option<String>,
    blocks: Vec<Block>,
    /// Number of executed blocks that are left out.
    further: usize,
    end: Option<String>,
    assertions: Vec<String>,
    command: String,
}

/// A line of a program.
#[derive(Debug, Serialize)]
pub(super) struct Line {
    number: usize,
    text: String,
}

#[derive(Debug, Serialize)]
struct FileView {
    name: String,
    lines: Vec<Line>,
}

/// An executed block.
#[derive(Debug, Serialize)]
struct Block {
    /// File and line, or the line alone in the main program.
    place: String,
    text: String,
    events: Vec<Event>,
}

/// A line of what a block does.
#[derive(Debug, Serialize)]
struct Event {
    /// `do`, `set` or `state`.
    kind: String,
    text: String,
}

/// The lines of a program, numbered as its blocks are.
pub(super) fn numbered(language: Language, program: &str) -> Vec<Line> {
    let line = |(at, text): (usize, &str)| Line { number: at + 1, text: text.to_owned() };
    language.lines(program).enumerate().map(line).collect()
}

/// Runs cases on the model and lays them out.
pub(super) struct Cases<'a> {
    /// The editions that the model of this build runs, the usual one first.
    editions: Vec<(&'a Edition, Options)>,
}

impl<'a> Cases<'a> {
    pub(super) fn new(suite: &'a Suite) -> Self {
        let mut editions: Vec<(&Edition, Options)> = suite
            .editions
            .iter()
            .map(|edition| (edition, suite.options(edition)))
            .filter(|(_, options)| gaugeblock_reference::accepts_options(options).is_ok())
            .collect();
        editions.sort_by_key(|(edition, _)| edition.id != USUAL_EDITION);
        Self { editions }
    }

    /// A case of a rule with what the model does in the first edition that has it.
    pub(super) fn view(&self, rule: &Rule, case: &Case) -> CaseView {
        let edition = self
            .editions
            .iter()
            .find(|(edition, _)| rule.exists_in(edition) && case.runs_in(edition));
        let mut view = CaseView {
            name: case.name.clone(),
            why: case.why.clone(),
            only: case.editions.clone(),
            files: files(rule.language, &case.setup),
            settings: setting_lines(&setup_settings(&case.setup)),
            assertions: case.assertions.clone(),
            command: format!(
                "gaugeblock certify --only {} --case \"{}\" --controller CONTROLLER",
                rule.id, case.name
            ),
            ..CaseView::default()
        };
        match edition {
            Some((edition, options)) => {
                let scenario = scenario_of(case, options, edition);
                view.trace(&scenario, &edition.id);
            }
            None => view.program = numbered(rule.language, &case.program),
        }
        view
    }

    /// A program of a choice, as the model runs it with one option.
    pub(super) fn view_under(
        &self,
        language: Language,
        program: &str,
        setup: &Setup,
        options: &BTreeMap<String, String>,
    ) -> CaseView {
        let mut view = CaseView {
            files: files(language, setup),
            settings: setting_lines(&setup_settings(setup)),
            ..CaseView::default()
        };
        let edition = self.editions.iter().find(|(edition, _)| edition.language == language);
        let mut all = edition.map(|(_, options)| options.clone()).unwrap_or_default();
        for (id, option) in options {
            all.0.insert(id.clone(), option.clone());
        }
        if gaugeblock_reference::accepts_options(&all).is_ok() {
            let mut scenario = setup.scenario(program, &all);
            scenario.program.language = language;
            view.trace(&scenario, "");
        } else {
            view.program = numbered(language, program);
        }
        view
    }
}

/// A case of motion: samples, or a program that a planner plans.
pub(super) fn motion_view(rule: &Rule, case: &MotionCase) -> CaseView {
    CaseView {
        name: case.name.clone(),
        why: case.why.clone(),
        program: numbered(Language::Rs274, &case.program),
        settings: setting_lines(&motion_settings(case)),
        assertions: case.assertions.clone(),
        command: format!(
            "gaugeblock certify --only {} --case \"{}\" --controller CONTROLLER",
            rule.id, case.name
        ),
        ..CaseView::default()
    }
}

fn files(language: Language, setup: &Setup) -> Vec<FileView> {
    let file = |(name, text): (&String, &String)| FileView {
        name: name.clone(),
        lines: numbered(language, text),
    };
    setup.files.iter().map(file).collect()
}

impl CaseView {
    /// The same at a place of its page.
    pub(super) fn at(self, anchor: String) -> Self {
        Self { anchor, ..self }
    }

    /// Runs the scenario on the model and takes over what it does.
    fn trace(&mut self, scenario: &Scenario, edition: &str) {
        let (outcome, _) = gaugeblock_reference::run(scenario);
        self.edition = (!edition.is_empty()).then(|| edition.to_owned());
        self.blocks = blocks(&outcome, scenario);
        self.further = self.blocks.len().saturating_sub(BLOCKS_MAX);
        self.blocks.truncate(BLOCKS_MAX);
        let text = outcome.to_text();
        let end = text.lines().find_map(|line| line.strip_prefix("end "));
        self.end = end.map(str::to_owned);
        let program = numbered(scenario.program.language, &scenario.program.main);
        let places = self.blocks.iter().map(|block| block.place.parse::<usize>().ok());
        let is_straight = places.eq(program.iter().map(|line| Some(line.number)));
        if !is_straight {
            self.program = program;
        }
    }
}

fn blocks(outcome: &Outcome, scenario: &Scenario) -> Vec<Block> {
    let program = &scenario.program;
    let text_of = |file: &str, line: usize| {
        let text = program.files.get(file).unwrap_or(&program.main);
        let place = line.checked_sub(1);
        place.and_then(|place| program.language.lines(text).nth(place).map(str::to_owned))
    };
    let mut blocks: Vec<Block> = Vec::new();
    for line in outcome.to_text().lines() {
        if let Some(place) = line.strip_prefix("block ") {
            let (file, number) = place.rsplit_once(':').unwrap_or(("", place));
            let text = number.parse().ok().and_then(|number| text_of(file, number));
            let place = if program.files.contains_key(file) { place } else { number };
            let text = text.unwrap_or_default();
            blocks.push(Block { place: place.to_owned(), text, events: Vec::new() });
        } else if let (Some(block), Some(event)) = (blocks.last_mut(), line.strip_prefix("  ")) {
            // A state without fields is that before it.
            if let Some((kind, text)) = event.split_once(' ') {
                block.events.push(Event { kind: kind.to_owned(), text: text.to_owned() });
            }
        }
    }
    blocks
}
