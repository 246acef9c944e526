//! A program as it is read: everything that is refused is refused here, but for what depends on values.

mod declarations;
mod expressions;
mod reader;
mod statements;

use std::cmp::Ordering;
use std::collections::BTreeMap;

use super::formats;
use super::variables::Variables;

pub use reader::read;

/// Statements, conditions and parentheses are nested so deep at most.
pub const DEEPEST: usize = 50;

/// The name of a block and its qualifier, in capitals, with one blank between words.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Heading {
    /// The name.
    pub name: String,
    /// The qualifier, if there is one.
    pub qualifier: Option<String>,
}

/// A program.
#[derive(Clone, Debug)]
pub struct Program {
    /// All variables, as they are before the run.
    pub variables: Variables,
    /// What a newline symbol does.
    pub procedure: Vec<Statement>,
    /// The blocks.
    pub blocks: BTreeMap<Heading, Vec<Statement>>,
    /// Warnings, each with the line of its statement.
    pub warnings: Vec<(u32, String)>,
}

/// A statement and the line where it begins.
#[derive(Clone, Debug)]
pub struct Statement {
    /// The line.
    pub line: u32,
    /// What it does.
    pub action: Action,
}

/// What a statement does.
#[derive(Clone, Debug)]
pub enum Action {
    /// A value is assigned.
    Assign(Reference, Side),
    /// OUTPUT, or PRINT.
    Print(Printer, Vec<Item>),
    /// `SET_ON`, or `SET_OFF`.
    Switch(bool, Vec<Target>),
    /// IF, or `IF_SET`.
    If {
        /// What is tested.
        condition: Condition,
        /// Executed where it holds.
        then: Vec<Statement>,
        /// Executed where it does not.
        otherwise: Vec<Statement>,
    },
    /// REPEAT.
    Repeat {
        /// Executed once, and again until the condition holds.
        body: Vec<Statement>,
        /// The line of UNTIL.
        line: u32,
        /// What is tested after it.
        until: Vec<Test>,
    },
}

/// Which statement prints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Printer {
    /// OUTPUT.
    Output,
    /// PRINT and its numbered kin.
    Print,
}

/// What is printed.
#[derive(Clone, Debug)]
pub enum Item {
    /// The newline symbol.
    Newline,
    /// `\J`.
    LineFeed,
    /// A text.
    Text(String),
    /// A variable.
    Variable(Reference),
}

/// What is switched on or off.
#[derive(Clone, Debug)]
pub enum Target {
    /// A variable, or a member of an array.
    Variable(Reference),
    /// All members of an array, by its place.
    Array(usize),
    /// Everything.
    All,
}

/// What an IF tests.
#[derive(Clone, Debug)]
pub enum Condition {
    /// Tests that must all hold.
    All(Vec<Test>),
    /// A flag, by `IF_SET`.
    Flag(Reference),
}

/// A test.
#[derive(Clone, Debug)]
pub enum Test {
    /// Whether a variable is on, or off.
    Is(bool, Reference),
    /// Two sides compared: they compare in one of these ways.
    Compare(Side, &'static [Ordering], Side),
}

/// A variable, or a member of an array.
#[derive(Clone, Debug)]
pub struct Reference {
    /// Its place among the variables.
    pub variable: usize,
    /// The number of the member.
    pub index: Option<Box<Expression>>,
}

impl Reference {
    /// Whether it refers to a text.
    pub fn is_text(&self, variables: &Variables) -> bool {
        variables.is_text(self.variable)
    }
}

/// What is assigned or compared.
#[derive(Clone, Debug)]
pub enum Side {
    /// A text as it is written.
    Text(String),
    /// A variable alone.
    Variable(Reference),
    /// A number.
    Expression(Expression),
}

/// An expression.
#[derive(Clone, Debug)]
pub enum Expression {
    /// A number.
    Number(f64),
    /// A variable.
    Variable(Reference),
    /// A minus sign before an operand.
    Negated(Box<Self>),
    /// Operands with operators of one precedence between them, from the left.
    Chain(Box<Self>, Vec<(Operator, Self)>),
}

/// An arithmetic operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `*`
    Multiply,
    /// `/`
    Divide,
}

/// Words that are no names.
const KEYWORDS: &[&str] = &[
    "FORMAT",
    "MODAL",
    "NON_MODAL",
    "IDENTICAL",
    "NEW_LINE_IS",
    "OUTPUT",
    "PRINT",
    "PRINT0",
    "PRINT1",
    "PRINT2",
    "PRINT3",
    "PRINT4",
    "PRINT5",
    "PRINT6",
    "PRINT7",
    "PRINT8",
    "PRINT9",
    "PRINT10",
    "SET_ON",
    "SET_OFF",
    "RESET",
    "IF",
    "IF_SET",
    "ELSE",
    "END_IF",
    "REPEAT",
    "UNTIL",
    "VAR_SET",
    "VAR_NOTSET",
    "ALL_VAR",
    "_EQ_",
    "_NE_",
    "_LT_",
    "_LE_",
    "_GT_",
    "_GE_",
];

/// Whether a word has a meaning of its own: keywords and the names of formats.
pub fn is_keyword(word: &str) -> bool {
    KEYWORDS.contains(&word) || formats::NAMES.contains(&word)
}
