//! Variables: as they are declared, and what they hold.

use crate::ids::choice;
use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_vocabulary::FaultKind;

use super::formats::{self, CHARACTER, Format};
use super::refusal::{StepError, refuse_form};
use crate::Choices;
use crate::ids::choice::gpp::Tie;

/// Most variables, members of arrays counted.
pub const MOST_VARIABLES: usize = 25_000;
/// Most characters of a name.
pub const LONGEST_NAME: usize = 31;

/// What a variable holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A text.
    Text(String),
}

/// When the toolpath turns a system variable on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// When its value is another one, like `X_CURPOS`.
    Change,
    /// When it is there, like `PART_TOL`.
    Presence,
}

/// A variable as it is declared.
#[derive(Clone, Debug)]
pub struct Variable {
    /// Its name, in capitals.
    pub name: String,
    /// How many members it has, where it is an array.
    pub size: Option<u32>,
    /// The place of its cell, or of that of its first member.
    pub cell: usize,
    /// Its format's place.
    pub format: usize,
    /// Whether it is modal.
    pub modal: bool,
    /// Whether a declaration has said so; otherwise its format may.
    pub modality_is_declared: bool,
    /// What turns it on, where it is a system variable.
    pub class: Option<Class>,
    /// Whether FORMAT has named it.
    pub is_declared: bool,
}

/// Value and set status; identical variables share them.
#[derive(Clone, Debug, Default)]
pub struct Cell {
    /// The value, once it has one.
    pub value: Option<Value>,
    /// Whether the variable is set on.
    pub on: bool,
}

/// All variables of a program.
#[derive(Clone, Debug)]
pub struct Variables {
    /// The formats by their places.
    pub formats: Vec<Format>,
    /// The variables in the order of their declarations, system variables first.
    pub all: Vec<Variable>,
    /// What they hold.
    pub cells: Vec<Cell>,
    /// The variable that each cell was made for.
    owners: Vec<usize>,
    by_name: BTreeMap<String, usize>,
    /// The variables that share a cell, where there are several: all that are identical.
    identical: BTreeMap<usize, BTreeSet<usize>>,
}

impl Variables {
    /// No variables, and these formats.
    pub fn new(formats: Vec<Format>) -> Self {
        let (all, cells, owners) = (Vec::new(), Vec::new(), Vec::new());
        let (by_name, identical) = (BTreeMap::new(), BTreeMap::new());
        Self { formats, all, cells, owners, by_name, identical }
    }

    /// The place of a variable.
    pub fn place(&self, name: &str) -> Option<usize> {
        self.by_name.get(name).copied()
    }

    /// Declares a variable.
    ///
    /// # Errors
    /// There are too many.
    pub fn declare(
        &mut self,
        name: &str,
        size: Option<u32>,
        format: usize,
        class: Option<Class>,
        choices: &Choices,
    ) -> Result<(), StepError> {
        let members = usize::try_from(size.unwrap_or(1)).unwrap_or(usize::MAX);
        if members > MOST_VARIABLES.saturating_sub(self.cells.len()) {
            let message = format!("there are {MOST_VARIABLES} variables at most");
            return Err(refuse_form(FaultKind::TooManyVariables, message));
        }
        let place = self.all.len();
        self.by_name.insert(name.to_owned(), place);
        self.all.push(Variable {
            name: name.to_owned(),
            size,
            cell: self.cells.len(),
            format,
            modal: choices.is(choice::gpp::DefaultModality::ByFormat) && self.formats[format].modal,
            modality_is_declared: false,
            class,
            is_declared: class.is_none(),
        });
        self.cells.resize_with(self.cells.len() + members, Cell::default);
        self.owners.resize(self.cells.len(), place);
        Ok(())
    }

    /// Makes every variable as modal as its format is now, where formats have a modality.
    pub fn take_modality_of_formats(&mut self, choices: &Choices) {
        for variable in &mut self.all {
            variable.modal = choices.is(choice::gpp::DefaultModality::ByFormat)
                && self.formats[variable.format].modal;
        }
    }

    /// Whether a variable holds texts.
    pub fn is_text(&self, variable: usize) -> bool {
        self.all[variable].format == CHARACTER
    }

    /// Lets two variables share value and flag, and all that are identical to either of them.
    pub fn join(&mut self, one: usize, other: usize) {
        let (kept, left) = (self.all[one].cell, self.all[other].cell);
        if kept == left {
            return;
        }
        let mut taken = |cell: usize| {
            let alone = || BTreeSet::from([self.owners[cell]]);
            self.identical.remove(&cell).unwrap_or_else(alone)
        };
        let (mut sharing, mut moved) = (taken(kept), taken(left));
        // The fewer move, so that a chain of declarations costs little more than it has links.
        let mut kept = kept;
        if sharing.len() < moved.len() {
            std::mem::swap(&mut sharing, &mut moved);
            kept = left;
        }
        for variable in &moved {
            self.all[*variable].cell = kept;
        }
        sharing.extend(moved);
        self.identical.insert(kept, sharing);
    }

    /// The variables that a cell belongs to: one, or all that are identical.
    pub fn of_cell(&self, cell: usize) -> BTreeSet<usize> {
        let alone = || BTreeSet::from([self.owners[cell]]);
        self.identical.get(&cell).cloned().unwrap_or_else(alone)
    }

    /// Whether a cell is shared by identical variables.
    pub fn is_shared(&self, cell: usize) -> bool {
        self.identical.contains_key(&cell)
    }

    /// A variable's name as it is shown, with the number of a member: `AXIS(3)`.
    pub fn shown_name(&self, variable: usize, cell: usize) -> String {
        let Variable { name, size, cell: first, .. } = &self.all[variable];
        match size {
            Some(_) => format!("{name}({})", cell - first + 1),
            None => name.clone(),
        }
    }

    /// A value as a variable prints it.
    ///
    /// # Errors
    /// It has too many digits for the variable's format.
    pub fn text(
        &self,
        variable: usize,
        value: &Value,
        tie: Tie,
    ) -> Result<String, formats::TooLong> {
        match value {
            Value::Number(number) => self.formats[self.all[variable].format].text(*number, tie),
            Value::Text(text) => Ok(text.clone()),
        }
    }
}

/// Whether a name is a user's: letters and digits, beginning with a letter.
pub fn is_user_name(name: &str) -> bool {
    is_name(name) && !name.contains('_')
}

/// Whether a name is a system variable's: it has an underscore.
pub fn is_system_name(name: &str) -> bool {
    is_name(name) && name.contains('_')
}

fn is_name(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
        && name.len() <= LONGEST_NAME
}
