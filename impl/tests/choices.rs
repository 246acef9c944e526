//! Each option of each choice does what its page says: the page's program, run under the option, has the page's outcome.

#![expect(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test of files that belong to this repository"
)]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use gaugeblock_impl::{BlockDone, Error, Interpreter, Limits, Memory, Progress, Reply, Sink};
use gaugeblock_trace::scenario::Bench;
use gaugeblock_trace::{Effect, FaultKind, Machine, Options, Settings};
use toml::Value;

/// Editions under which a page may be meant; the first is the default.
const EDITIONS: &[&str] = &["linuxcnc-2.8", "linuxcnc-2.9", "emc2-2.5", "m70-draft"];

/// What a run shows.
#[derive(Default)]
struct Record {
    effects: Vec<(u32, String)>,
    messages: Vec<String>,
    after: BTreeMap<u32, BTreeMap<String, String>>,
    end: String,
    refused_at: Option<u32>,
    parameters: BTreeMap<u32, f64>,
    bench: Bench,
}

impl Sink for Record {
    fn set(&mut self, _line: u32, _changed: &Settings) {}

    fn perform(&mut self, line: u32, effect: &Effect) -> Reply {
        if let Effect::Message { text, .. } = effect {
            self.messages.push(text.clone());
        }
        let mut text = effect.name().to_owned();
        for (name, value) in effect.arguments() {
            text += &format!(" {name}={value}");
        }
        self.effects.push((line, text));
        if let Effect::UserCode { code, .. } = effect {
            let file = format!("M{code}");
            let there = self.bench.user_programs.iter().any(|program| program.file == file);
            return if there { Reply::Done } else { Reply::Failed(FaultKind::UnknownCode) };
        }
        Reply::Done
    }

    fn block_done(&mut self, done: &mut BlockDone<'_>) {
        let entries = done.settings().entries().into_iter().chain(done.state().entries());
        let values = entries.map(|entry| (entry.name(), entry.value.to_string()));
        self.after.insert(done.line(), values.collect());
    }
}

fn read(path: &Path) -> toml::Table {
    std::fs::read_to_string(path).unwrap().parse().unwrap()
}

/// The options of an edition: its own, else its base's.
fn edition(name: &str, editions: &[Value]) -> BTreeMap<String, String> {
    let page = editions.iter().find(|page| page.get("id").unwrap().as_str() == Some(name)).unwrap();
    let base = page
        .get("base")
        .map_or_else(BTreeMap::new, |base| edition(base.as_str().unwrap(), editions));
    let own = page.get("options").and_then(Value::as_table).cloned().unwrap_or_default();
    let own = own.into_iter().map(|(id, option)| (id, option.as_str().unwrap().to_owned()));
    base.into_iter().chain(own).collect()
}

fn run(page: &toml::Table, options: BTreeMap<String, String>) -> Record {
    let machine: Machine = page
        .get("machine")
        .map_or_else(Machine::default, |machine| machine.clone().try_into().unwrap());
    let bench: Bench =
        page.get("bench").map_or_else(Bench::default, |bench| bench.clone().try_into().unwrap());
    let mut record = Record { bench, ..Record::default() };
    let program = page.get("program").unwrap().as_str().unwrap();
    let mut interpreter = match Interpreter::new(machine, Options(options), Limits::default()) {
        Ok(interpreter) => interpreter,
        Err(error) => panic!("{error}"),
    };
    match interpreter.run(&mut Memory::new(program), &mut record, 10_000) {
        Ok(Progress::Ended(end)) => end.name().clone_into(&mut record.end),
        Ok(Progress::More | Progress::Stopped) => "unended".clone_into(&mut record.end),
        Err(Error::Fault(fault)) => {
            "fault".clone_into(&mut record.end);
            record.refused_at = fault.block.map(|block| block.line);
        }
        Err(error) => record.end = error.to_string(),
    }
    record.parameters = interpreter.parameters().into_iter().collect();
    let settings =
        interpreter.settings().entries().into_iter().chain(interpreter.state().entries());
    record
        .after
        .insert(u32::MAX, settings.map(|entry| (entry.name(), entry.value.to_string())).collect());
    record
}

impl Record {
    fn value(&self, line: u32, name: &str) -> String {
        match name.strip_prefix('#') {
            Some(number) => {
                let value = self.parameters.get(&number.parse().unwrap()).copied().unwrap_or(0.0);
                format!("{}", (value * 1e9).round() / 1e9)
            }
            None => self
                .after
                .get(&line)
                .and_then(|values| values.get(name))
                .cloned()
                .unwrap_or_default(),
        }
    }

    fn holds_at(&self, line: u32, values: &str) -> bool {
        values.split(", ").all(|pair| {
            let (name, value) = pair.split_once(" = ").unwrap();
            self.value(line, name) == value
        })
    }

    /// Whether an assertion of a page holds; `None` where this test cannot tell.
    fn holds(&self, assertion: &str) -> Option<bool> {
        let effects = |wanted: &dyn Fn(u32) -> bool| {
            let chosen: Vec<&str> = self
                .effects
                .iter()
                .filter(|(line, _)| wanted(*line))
                .map(|(_, text)| text.as_str())
                .collect();
            if chosen.is_empty() { "none".to_owned() } else { chosen.join("; ") }
        };
        Some(if assertion == "accepted" {
            self.end == "program_end" || self.end == "percent_end"
        } else if assertion == "refused" {
            self.end == "fault"
        } else if let Some(line) = assertion.strip_prefix("refused at ") {
            self.refused_at == line.parse().ok()
        } else if let Some(values) = assertion.strip_prefix("at end ") {
            self.holds_at(u32::MAX, values)
        } else if let Some(rest) = assertion.strip_prefix("after ") {
            let (line, values) = rest.split_once(' ')?;
            self.holds_at(line.parse().ok()?, values)
        } else if let Some(rest) = assertion.strip_prefix("effects at ") {
            let (line, expected) = rest.split_once(": ")?;
            let line: u32 = line.parse().ok()?;
            effects(&|at| at == line) == expected
        } else if let Some(rest) = assertion.strip_prefix("count ") {
            let (name, count) = rest.split_once(" = ")?;
            let found =
                self.effects.iter().filter(|(_, text)| text.split(' ').next() == Some(name));
            found.count() == count.parse::<usize>().ok()?
        } else if let Some(text) = assertion.strip_prefix("messages: ") {
            same_text(&self.messages.join("; "), if text == "none" { "" } else { text })
        } else if let Some(end) = assertion.strip_prefix("ends ") {
            self.end == end
        } else {
            return None;
        })
    }
}

/// Numbers in messages are compared as numbers, but a number of another precision is another text.
fn same_text(found: &str, expected: &str) -> bool {
    let number = |text: &str| text.parse::<f64>().ok().map(|number| format!("{number:.6}"));
    found == expected || number(found).is_some_and(|found| number(expected) == Some(found))
}

/// Pages of the task side, or of a bench that the sink of this test does not have.
fn is_left_out(page: &toml::Table) -> bool {
    let id = page.get("id").unwrap().as_str().unwrap();
    page.contains_key("operator")
        || ["task.", "abort."].iter().any(|prefix| id.starts_with(prefix))
        || [
            "orient.brake-otherwise",
            "outputs.at-once-over-waiting",
            "user-codes.exit-status",
            "user-codes.place",
            "pause.pallet-codes",
        ]
        .contains(&id)
}

#[test]
fn every_option_has_the_outcome_of_its_page() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../options");
    let editions = read(&folder.join("editions.toml"));
    let editions = editions.get("edition").unwrap().as_array().unwrap();
    let mut pages: Vec<PathBuf> = std::fs::read_dir(folder.join("choices"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    pages.sort();
    let (mut held, mut left_out, mut failed) = (0_u32, 0_u32, Vec::new());
    for path in pages {
        let page = read(&path);
        if is_left_out(&page) {
            left_out += 1;
            continue;
        }
        let id = page.get("id").unwrap().as_str().unwrap();
        for option in page.get("option").unwrap().as_array().unwrap() {
            let name = option.get("name").unwrap().as_str().unwrap();
            let assertions: Vec<&str> = option
                .get("assert")
                .unwrap()
                .as_array()
                .unwrap()
                .iter()
                .map(|text| text.as_str().unwrap())
                .collect();
            // A page tells options apart under the edition that it was written for, which it does not name.
            let holds = EDITIONS.iter().any(|base| {
                let mut options = edition(base, editions);
                options.insert(id.to_owned(), name.to_owned());
                let record = run(&page, options);
                assertions.iter().all(|assertion| record.holds(assertion) != Some(false))
            });
            if holds {
                held += 1;
            } else {
                failed.push(format!("{id} = {name}: {assertions:?}"));
            }
        }
    }
    println!("{held} options held, {left_out} pages left out");
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}
