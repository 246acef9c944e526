//! A compiled program: statements, expressions and texts in rows, and places in these rows.

use alloc::string::String;
use alloc::vec::Vec;

pub(super) use crate::index_range::IndexRange;

use super::words::Compare;

/// A program. Nothing in it is looked up by name any more.
#[derive(Clone, Debug, Default)]
pub(super) struct Program {
    pub(super) statements: Vec<Statement>,
    pub(super) operations: Vec<Operation>,
    pub(super) items: Vec<Item>,
    pub(super) targets: Vec<Target>,
    pub(super) tests: Vec<Test>,
    pub(super) texts: Vec<String>,
    /// Where the statements of the newline procedure begin.
    pub(super) newline: Option<usize>,
    /// Warnings that are reported before anything runs, with their lines.
    pub(super) warnings: Vec<(u32, String)>,
}

/// A statement, or a part of one that is a step of its own.
#[derive(Clone, Copy, Debug)]
pub(super) enum Statement {
    Assign {
        line: u32,
        to: VariableRef,
        source: Source,
    },
    /// OUTPUT and PRINT.
    Print {
        line: u32,
        items: IndexRange,
        is_output: bool,
    },
    Switch {
        line: u32,
        on: bool,
        targets: IndexRange,
    },
    /// Goes on elsewhere where the tests do not hold; warns where the variable of an `IF_SET` is not modal.
    Test {
        line: u32,
        tests: IndexRange,
        otherwise: usize,
        warns: bool,
    },
    Jump(usize),
    /// The end of a block or of the newline procedure.
    End,
}

/// A variable.
#[derive(Clone, Copy, Debug)]
pub(super) enum VariableRef {
    /// A slot.
    Alone(usize),
    /// A member of an array, by the variable and the expression of its index.
    Member { variable: usize, index: IndexRange },
}

/// Where a value comes from.
#[derive(Clone, Copy, Debug)]
pub(super) enum Source {
    /// A place among the texts.
    Text(usize),
    Variable(VariableRef),
    Expression(IndexRange),
}

/// An operation of an expression, after its operands.
#[derive(Clone, Copy, Debug)]
pub(super) enum Operation {
    Number(f64),
    /// The value of a slot.
    Value(usize),
    /// The value of the member whose index is on the stack.
    Member(usize),
    Negate,
    Two(Sum),
}

/// An operation on two numbers.
#[derive(Clone, Copy, Debug)]
pub(super) enum Sum {
    Add,
    Subtract,
    Multiply,
    Divide,
}

/// An item that is printed.
#[derive(Clone, Copy, Debug)]
pub(super) enum Item {
    /// The symbol of the newline procedure.
    Symbol,
    LineFeed,
    /// A place among the texts.
    Text(usize),
    Variable(VariableRef),
}

/// A target that is switched.
#[derive(Clone, Copy, Debug)]
pub(super) enum Target {
    VariableRef(VariableRef),
    /// A whole array.
    Array(usize),
    All,
}

/// One of the tests of a condition.
#[derive(Clone, Copy, Debug)]
pub(super) enum Test {
    Flag { place: VariableRef, on: bool },
    Numbers { left: Source, compare: Compare, right: Source },
    Texts { left: Source, compare: Compare, right: Source },
}
