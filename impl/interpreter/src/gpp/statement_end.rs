//! The state that a sink receives after each step of a post-processor.

use gaugeblock_vocabulary::Program;

use super::variables::{Change, Variables};

/// The file that a step is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum File {
    Program,
    Toolpath,
}

impl File {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Program => Program::MAIN,
            Self::Toolpath => TOOLPATH,
        }
    }
}

/// The file name of the toolpath.
pub const TOOLPATH: &str = "toolpath";

/// A step that was made, and what it made of the variables.
#[derive(Clone, Copy, Debug)]
pub struct StatementEnd<'a> {
    file: File,
    line: u32,
    variables: Option<&'a Variables>,
    is_first: bool,
}

impl<'a> StatementEnd<'a> {
    pub(super) fn of_warning(line: u32) -> Self {
        Self { file: File::Program, line, variables: None, is_first: false }
    }

    pub(super) fn new(file: File, line: u32, variables: &'a Variables, is_first: bool) -> Self {
        Self { file, line, variables: Some(variables), is_first }
    }

    /// The file's name; [`TOOLPATH`] for the toolpath.
    pub fn file(&self) -> &'static str {
        self.file.name()
    }

    /// The line in that file, from 1, at which the statement begins.
    pub fn line(&self) -> u32 {
        self.line
    }

    /// Whether it was executed; a warning of the compilation is reported before anything is executed.
    pub fn was_executed(&self) -> bool {
        self.variables.is_some()
    }

    /// The variables that the step has changed, each once.
    pub fn changes(&self) -> impl Iterator<Item = Change<'a>> {
        self.variables.into_iter().flat_map(Variables::changes)
    }

    /// Each variable, an array as one, and whether it is modal; they are reported after the first step that was
    /// executed.
    pub fn modalities(&self) -> impl Iterator<Item = (&'a str, bool)> {
        let variables = self.variables.filter(|_| self.is_first);
        let variables = variables.into_iter().flat_map(|all| &all.variables);
        variables.map(|variable| (variable.name.as_str(), variable.modal))
    }
}
