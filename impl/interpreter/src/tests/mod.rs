//! Tests of text, expressions, parameters and control: whole programs against what comes of them.

mod calls;
mod comments;
mod cycles;
mod expressions;
mod fast_path;
mod grbl;
mod loops;
mod nist;
mod numbered;
mod parameters;
mod property;
mod refused;
mod text;
mod turning;

use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::{String, ToString as _};
use alloc::vec::Vec;

use gaugeblock_vocabulary::{Effect, End, Machine, Options, Rs274State, Settings};

use crate::{BlockEnd, BlockKind, Error, Interpreter, Limits, Memory, Progress, Reply, Sink};

/// Writes down what it hears.
#[derive(Default)]
struct Recorder {
    effects: Vec<(u32, String)>,
    messages: Vec<String>,
    named: BTreeMap<String, f64>,
    /// The same from changes alone.
    taken: BTreeMap<String, f64>,
    settings: Settings,
    done: Vec<(String, u32)>,
}

impl Sink for Recorder {
    fn set(&mut self, _line: u32, changed: &Settings) {
        self.settings.overlay(changed);
    }

    fn perform(&mut self, line: u32, effect: &Effect) -> Reply {
        let mut text = String::from(effect.name());
        for (name, value) in effect.arguments() {
            text += &format!(" {name}={value}");
        }
        self.effects.push((line, text));
        if let Effect::Message { text, .. } = effect {
            self.messages.push(text.clone());
        }
        Reply::Done
    }

    fn end_block(&mut self, done: &mut BlockEnd<'_>) {
        let is_first = self.done.is_empty();
        self.done.push((done.file().into(), done.line()));
        self.named = done.named().map(|(name, value)| (name.into(), value)).collect();
        if matches!(
            done.kind(),
            BlockKind::Call
                | BlockKind::Return
                | BlockKind::NumberedCall
                | BlockKind::NumberedReturn
                | BlockKind::End
        ) {
            self.taken.retain(|name, _| name.starts_with('_'));
            self.taken.extend(done.locals().map(|(name, value)| (name.into(), value)));
        }
        if is_first {
            // The interpreter may have run before.
            self.taken = self.named.clone();
        }
        let taken = &mut self.taken;
        done.take_named(|name, value| {
            taken.insert(name.into(), value);
        });
        let bits = |(name, value): (&String, &f64)| (name.clone(), value.to_bits());
        assert!(
            self.taken.iter().map(bits).eq(self.named.iter().map(bits)),
            "{:?} is taken for {:?}",
            self.taken,
            self.named
        );
    }
}

/// A program with everything that it depends on.
#[derive(Default)]
struct Case<'a> {
    options: Vec<(&'a str, &'a str)>,
    files: Vec<(&'a str, &'a str)>,
    machine: Option<Machine>,
    block_delete: bool,
    limits: Limits,
}

/// What came of a program.
struct Outcome {
    recorder: Recorder,
    parameters: BTreeMap<u32, f64>,
    settings: Settings,
    state: Rs274State,
    end: Result<End, Error>,
}

/// Most blocks of a test.
const BLOCKS: u64 = 20_000;

impl Case<'_> {
    fn run(&self, program: &[u8]) -> Outcome {
        let mut source = Memory::new(program);
        for (name, text) in &self.files {
            source = source.with_file(*name, *text);
        }
        let options = self.options.iter().map(|(id, option)| ((*id).into(), (*option).into()));
        let machine = self.machine.clone().unwrap_or_default();
        let mut interpreter =
            Interpreter::new(machine, Options(options.collect()), self.limits).unwrap();
        interpreter.set_block_delete(self.block_delete);
        let mut recorder = Recorder::default();
        let end = loop {
            match interpreter.run(&mut source, &mut recorder, BLOCKS) {
                Ok(Progress::More) => panic!("the program does not end"),
                Ok(Progress::Stopped | Progress::Aborted) => {}
                Ok(Progress::Ended(end)) => break Ok(end),
                Err(error) => break Err(error),
            }
        };
        Outcome {
            recorder,
            parameters: interpreter.parameters().into_iter().collect(),
            settings: interpreter.settings(),
            state: interpreter.state(),
            end,
        }
    }

    #[track_caller]
    fn check(&self, program: &str, expectations: &str) {
        let outcome = self.run(program.as_bytes());
        for expectation in expectations.split("; ") {
            assert!(outcome.meets(expectation), "{expectation}\n{}\n{program}", outcome.show());
        }
    }
}

/// Runs a program and compares what came of it with expectations, separated by `; `: `accepted`, `refused at 3`,
/// `refused at 3 unknown_sub`, `refused missing_end`, `ends endless`, `#31 = 4`, `#<_x> = 4`, `no #<x>`, `messages: a
/// | b`, `count straight_feed = 3`, `at 2 straight_feed end=(x1)`.
#[track_caller]
fn check(program: &str, expectations: &str) {
    Case::default().check(program, expectations);
}

/// Checks each program of a table.
#[track_caller]
fn check_all(table: &[(&str, &str)]) {
    for (program, expectations) in table {
        check(program, expectations);
    }
}

impl Outcome {
    fn meets(&self, expectation: &str) -> bool {
        let words: Vec<&str> = expectation.split_whitespace().collect();
        match words.as_slice() {
            ["accepted"] => matches!(self.end, Ok(End::ProgramEnd | End::PercentEnd)),
            ["refused", "at", line] => self.refused_at(line, None),
            ["refused", "at", line, kind] => self.refused_at(line, Some(kind)),
            ["refused"] => matches!(self.end, Err(Error::Fault(_))),
            ["refused", kind] => matches!(&self.end, Err(Error::Fault(fault))
                if fault.kind.is_some_and(|found| found.word() == *kind)),
            ["ends", name] => self.end.as_ref().is_ok_and(|end| end.name() == *name),
            ["beyond"] => matches!(self.end, Err(Error::LimitExceeded { .. })),
            ["no", name] => !self.recorder.named.contains_key(bare(name)),
            ["count", effect, "=", count] => {
                let named = |text: &str| text.split(' ').next() == Some(effect);
                let found = self.recorder.effects.iter().filter(|(_, text)| named(text)).count();
                found.to_string() == *count
            }
            ["at", line, ..] => {
                let wanted = expectation.splitn(3, ' ').nth(2).unwrap();
                let line: u32 = line.parse().unwrap();
                self.recorder.effects.iter().any(|(at, text)| *at == line && text == wanted)
            }
            ["messages:", ..] => {
                let wanted = expectation.strip_prefix("messages: ").unwrap();
                let found = self.recorder.messages.join(" | ");
                let same_number =
                    found.parse::<f64>().is_ok_and(|found| wanted.parse() == Ok(found));
                found == wanted || same_number || found.is_empty() && wanted == "none"
            }
            [name, "=", value] => {
                let value: f64 = value.parse().unwrap();
                let found = match name.strip_prefix('#').map(str::parse::<u32>) {
                    Some(Ok(number)) => self.parameters.get(&number).copied().unwrap_or(0.0),
                    _ => self.recorder.named.get(bare(name)).copied().unwrap_or(f64::NAN),
                };
                (found - value).abs() < 1e-9
            }
            _ => panic!("what is expected? {expectation}"),
        }
    }

    fn refused_at(&self, place: &str, kind: Option<&str>) -> bool {
        let Err(Error::Fault(fault)) = &self.end else { return false };
        let Some(block) = &fault.block else { return false };
        let place = if place.contains(':') { place.into() } else { format!("main.ngc:{place}") };
        block.to_string() == place
            && kind.is_none_or(|kind| fault.kind.is_some_and(|found| found.word() == kind))
    }

    fn show(&self) -> String {
        format!(
            "end {:?}\neffects {:?}\nparameters {:?}\nnamed {:?}\ndone {:?}",
            self.end,
            self.recorder.effects,
            self.parameters,
            self.recorder.named,
            self.recorder.done
        )
    }
}

/// A name without `#<` and `>`.
fn bare(name: &str) -> &str {
    name.trim_start_matches("#<").trim_end_matches('>')
}
