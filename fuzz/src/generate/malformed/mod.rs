//! Malformed programs from bytes: almost valid, and often refused.
//!
//! Each byte chooses a row of a table, so that a small change of the bytes is a small change of the program; an
//! engine that mutates bytes and a library that shrinks them both work on it. Most blocks are well formed, since what
//! is refused at its first word tests little; some are broken on purpose.

mod tables;

use gaugeblock_vocabulary::scenario::Start;
use gaugeblock_vocabulary::{Language, Machine, Program, Scenario};
use tables::{LOOSE, NESTED, TABLES, TOP};

use super::{BUDGET, Entropy};

/// A scenario from bytes: the first few choose the machine and the switches, the rest the program.
pub fn scenario(bytes: &[u8]) -> Scenario {
    let mut choices = Choices { bytes };
    let switches = choices.next();
    let program = Program {
        language: Language::Rs274,
        block_delete: switches & 1 != 0,
        start: if switches & 0x3e == 0x3e { Start::Mdi } else { Start::Program },
        files: [("cave.ngc".to_owned(), cave(&mut choices))].into(),
        main: program(&mut choices, 60),
    };
    let machine = Machine {
        spindles: 1 + (switches >> 4 & 3),
        fanuc_subs: switches & 0xc0 != 0xc0,
        ..Machine::default()
    };
    Scenario { program, machine, budget: BUDGET, ..Scenario::default() }
}

/// A single block that is often refused.
pub(super) fn block(entropy: &mut Entropy<'_>) -> String {
    let bytes: Vec<u8> =
        (0..12).map(|_| u8::try_from(entropy.below(256)).unwrap_or_default()).collect();
    let mut choices = Choices { bytes: &bytes };
    let mut writer = Writer { choices: &mut choices, text: String::new(), last_label: 300 };
    writer.row(LOOSE, 0, 2);
    writer.text
}

/// Bytes as a sequence of choices; after the last one every choice is the first row.
struct Choices<'a> {
    bytes: &'a [u8],
}

impl Choices<'_> {
    fn next(&mut self) -> u8 {
        match self.bytes.split_first() {
            Some((first, rest)) => {
                self.bytes = rest;
                *first
            }
            None => 0,
        }
    }

    fn row<'t>(&mut self, table: &'t [&'t str]) -> &'t str {
        table[usize::from(self.next()) % table.len()]
    }
}

/// A program of up to so many statements, while there are bytes.
fn program(choices: &mut Choices<'_>, statements: usize) -> String {
    let mut writer = Writer { choices, text: String::new(), last_label: 100 };
    for _ in 0..statements {
        if writer.choices.bytes.is_empty() {
            break;
        }
        writer.statement(true, 3);
    }
    writer.text + "m2\no900\n#30 = [#30 + 1]\nm99\n"
}

/// A subroutine file.
fn cave(choices: &mut Choices<'_>) -> String {
    let mut writer = Writer { choices, text: "o<cave> sub\n".to_owned(), last_label: 50 };
    writer.body(2);
    writer.text + "o<cave> endsub\nm2\n"
}

struct Writer<'c, 'b> {
    choices: &'c mut Choices<'b>,
    text: String,
    last_label: u32,
}

impl Writer<'_, '_> {
    fn statement(&mut self, top: bool, depth: u32) {
        let kind = self.choices.next();
        match kind {
            0..12 => {
                self.row(LOOSE, 0, depth);
                self.text.push('\n');
            }
            12..48 if top => self.row(TOP, 0, depth),
            _ => self.row(NESTED, 0, depth),
        }
    }

    fn body(&mut self, depth: u32) {
        if depth > 0 {
            for _ in 0..self.choices.next() % 4 {
                self.statement(false, depth - 1);
            }
        }
    }

    /// Writes a chosen row of a table, or its first one where it is deep enough, with each placeholder filled.
    fn row(&mut self, table: &[&str], label: u32, depth: u32) {
        let row = if depth == 0 { table[0] } else { self.choices.row(table) };
        let label = if row.contains("{O}") && label == 0 { self.new_label() } else { label };
        let mut rest = row;
        while let Some((before, after)) = rest.split_once('{') {
            self.text.push_str(before);
            let (name, after) = after.split_once('}').unwrap_or((after, ""));
            match name {
                "B" => self.body(depth.saturating_sub(1)),
                "O" => self.text.push_str(&label.to_string()),
                _ => {
                    if let Some((_, table)) = TABLES.iter().find(|(known, _)| *known == name) {
                        self.row(table, label, depth.saturating_sub(1));
                    }
                }
            }
            rest = after;
        }
        self.text.push_str(rest);
    }

    fn new_label(&mut self) -> u32 {
        self.last_label += 1;
        self.last_label
    }
}
