//! Scenario: all that a run depends on. No clock, no environment, no random source, no file system.

mod environment;
mod machine;
mod operator;

use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;

pub use environment::{Environment, Folder, InputChange, OrientAnswer, ProbeContact, UserProgram};
pub use machine::{AxisLimits, Machine, Tool, ToolChange};
pub use operator::{Action, OperatorEvent, RunPoint};

use crate::block::{BlockLocation, MAIN_FILE};
use crate::language::Language;
use crate::shared::Shared;

/// All that a run depends on.
///
/// ```
/// use gaugeblock_vocabulary::Scenario;
/// use gaugeblock_vocabulary::scenario::Budget;
///
/// let scenario = Scenario {
///     budget: Budget { steps: 1_000, ..Budget::default() },
///     ..Scenario::of("g21 g0 x1\nm2\n")
/// };
/// assert_eq!(scenario.machine.spindles, 1);
/// assert_eq!(scenario.budget.effects, 100_000);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields, default)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Scenario {
    /// The program, and how it is started.
    pub program: Program,
    /// Which reading of the documents applies.
    pub options: Options,
    /// The machine that runs it.
    pub machine: Machine,
    /// How everything outside of the controller answers it.
    pub environment: Environment,
    /// What a person does, and when.
    pub operator: Vec<OperatorEvent>,
    /// When to stop a run that does not end.
    pub budget: Budget,
}

impl Scenario {
    /// A scenario with this main program and the defaults of everything else.
    pub fn of(program: impl Into<String>) -> Self {
        Self { program: Program { main: program.into(), ..Program::default() }, ..Self::default() }
    }
}

/// How a program is started.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Start {
    /// The file is run as a program.
    #[default]
    Program,
    /// The operator enters each line (manual data input).
    Mdi,
}

/// The program of a run: its language, its text, and how it is started.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields, default)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Program {
    /// Language of the program.
    pub language: Language,
    /// Text of the main program, whose file name is `main.ngc`. A scenario
    /// cannot hold bytes that are not UTF-8. The command refuses a NUL, since controllers need not agree on it.
    pub main: String,
    /// Text of subroutine files, by file name. No controller searches the folder `elsewhere/`.
    pub files: BTreeMap<String, String>,
    /// Whether blocks that begin with a slash are skipped.
    pub block_delete: bool,
    /// Whether it is started as a program or block by block.
    pub start: Start,
}

impl Program {
    /// File name of the main program.
    pub const MAIN: &'static str = MAIN_FILE;

    /// The text of a block, without its line end; `None` if the program has no such file or line.
    pub fn line(&self, block: &BlockLocation) -> Option<&str> {
        let text =
            if block.file == Self::MAIN { &self.main } else { self.files.get(&*block.file)? };
        self.language.lines(text).nth(usize::try_from(block.line).ok()?.checked_sub(1)?)
    }

    /// The lines of all files, to look up many of them.
    pub fn lines(&self) -> ProgramLines<'_> {
        let lines = |text| self.language.lines(text).collect();
        let files = self.files.iter().map(|(name, text)| (name.as_str(), lines(text)));
        // As in `line`, no other file has the name of the main program.
        ProgramLines(files.chain([(Self::MAIN, lines(&self.main))]).collect())
    }
}

/// The lines of a program by file, each without its line end ([`Program::lines`]).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProgramLines<'a>(BTreeMap<&'a str, Vec<&'a str>>);

impl<'a> ProgramLines<'a> {
    /// The text of a block, as [`Program::line`] gives it.
    pub fn line(&self, block: &BlockLocation) -> Option<&'a str> {
        let place = usize::try_from(block.line).ok()?.checked_sub(1)?;
        self.0.get(&*block.file)?.get(place).copied()
    }
}

impl Default for Program {
    fn default() -> Self {
        Self {
            language: Language::Rs274,
            main: String::new(),
            files: BTreeMap::new(),
            block_delete: false,
            start: Start::Program,
        }
    }
}

/// Options of choices and quirks, by id: `"saved-state.motion-mode" = "restored"`.
///
/// A choice that is not listed has its default. This crate knows none of the ids: they are pages of the suite, and each
/// interpreter declares the ids that it reads. Scenarios share one set of options, so that cloning one is cheap.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(transparent))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Options(pub Shared<BTreeMap<String, String>>);

impl Options {
    /// The option of a choice, if it is listed.
    pub fn get(&self, id: &str) -> Option<&str> {
        self.0.get(id).map(String::as_str)
    }

    /// Whether a choice is listed with this option.
    pub fn is(&self, id: &str, option: &str) -> bool {
        self.get(id) == Some(option)
    }
}

/// When to stop a run that does not end.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields, default)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Budget {
    /// Executed blocks. A `while` executes its first block in each pass, a `do` only in the first pass.
    pub steps: u32,
    /// Effects.
    pub effects: u32,
    /// Virtual time, seconds.
    pub time: f64,
}

impl Default for Budget {
    fn default() -> Self {
        Self { steps: 100_000, effects: 100_000, time: 86_400.0 }
    }
}

#[cfg(test)]
mod tests {
    use alloc::borrow::ToOwned as _;

    use super::*;

    #[test]
    fn block_line_exists_in_its_file() {
        let files = BTreeMap::from([("cave.ngc".to_owned(), "g1\ng2".to_owned())]);
        let program = Program { main: "g0\rm2".to_owned(), files, ..Program::default() };
        let line = |file, line| program.line(&BlockLocation::new(file, line));
        assert_eq!(line(Program::MAIN, 2), Some("m2"));
        assert_eq!(line("cave.ngc", 1), Some("g1"));
        assert_eq!([line(Program::MAIN, 3), line(Program::MAIN, 0), line("absent", 1)], [None; 3]);
        let lines = program.lines();
        for (file, number) in
            [(Program::MAIN, 0), (Program::MAIN, 2), (Program::MAIN, 3), ("cave.ngc", 1)]
        {
            assert_eq!(
                lines.line(&BlockLocation::new(file, number)),
                line(file, number),
                "{file}:{number}"
            );
        }
    }
}
