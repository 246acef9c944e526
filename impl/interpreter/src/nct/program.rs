//! Compiled programs: blocks, words and operations in rows, and places in these rows.

use alloc::vec::Vec;
use core::cmp::Ordering;

use gaugeblock_vocabulary::FaultKind;

use crate::index_range::IndexRange;

/// All programs of a text. Nothing in it is looked up by its text any more.
#[derive(Clone, Debug, Default)]
pub(super) struct Code {
    pub(super) blocks: Vec<Block>,
    pub(super) words: Vec<Word>,
    pub(super) operations: Vec<Operation>,
    /// In the order of the text; the first one is the main program.
    pub(super) programs: Vec<Program>,
    /// Program numbers, sorted, and the place of each among the programs.
    pub(super) numbers: Vec<(u32, usize)>,
    /// Sequence numbers by program, sorted, and the block of each.
    pub(super) labels: Vec<(usize, u32, usize)>,
    /// The blocks of each loop, from the one after its WHILE up to its END.
    pub(super) loops: Vec<IndexRange>,
}

/// A program: its blocks, and the line of its O.
#[derive(Clone, Copy, Debug)]
pub(super) struct Program {
    pub(super) line: u32,
    pub(super) blocks: IndexRange,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    /// Its line, from 1.
    pub(super) line: u32,
    /// The innermost loop that it is in.
    pub(super) within: Option<usize>,
    pub(super) kind: Kind,
}

/// The kind of a block.
#[derive(Clone, Copy, Debug)]
pub(super) enum Kind {
    /// Block delete skips it.
    Skipped,
    Words(IndexRange),
    Assign {
        to: Target,
        from: Value,
    },
    Goto(Value),
    If {
        condition: Condition,
        to: Value,
    },
    /// A WHILE, and the block after its END.
    While {
        condition: Condition,
        behind: usize,
    },
    /// An END, and its WHILE.
    End(usize),
    /// It is not valid, or the documents leave it open.
    Stop(Stop),
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Word {
    /// In upper case.
    pub(super) letter: u8,
    pub(super) value: Value,
}

/// Where a value comes from.
#[derive(Clone, Copy, Debug)]
pub(super) enum Value {
    Number(f64),
    Variable(Slot),
    Expression(IndexRange),
}

/// Which variable is assigned.
#[derive(Clone, Copy, Debug)]
pub(super) enum Target {
    Variable(Slot),
    /// The one whose number this is.
    Indirect(IndexRange),
}

/// A comparison.
#[derive(Clone, Copy, Debug)]
pub(super) struct Condition {
    pub(super) left: Value,
    pub(super) compare: Compare,
    pub(super) right: Value,
}

/// How two values are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Compare {
    Equal,
    NotEqual,
    Greater,
    Less,
    GreaterOrEqual,
    LessOrEqual,
}

impl Compare {
    /// Whether it holds for two values in this order.
    pub(super) fn says(self, order: Ordering) -> bool {
        match self {
            Self::Equal => order.is_eq(),
            Self::NotEqual => order.is_ne(),
            Self::Greater => order.is_gt(),
            Self::Less => order.is_lt(),
            Self::GreaterOrEqual => order.is_ge(),
            Self::LessOrEqual => order.is_le(),
        }
    }
}

/// A variable that there is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Slot {
    /// #0.
    Vacant,
    /// #1 to #33, from 0.
    Local(u8),
    /// #100 to #199 and #500 to #599, by number.
    Common(u16),
}

/// An operation of an expression, after its operands.
#[derive(Clone, Copy, Debug)]
pub(super) enum Operation {
    Number(f64),
    Variable(Slot),
    /// The variable whose number comes before.
    Indirect,
    /// A plus sign: a vacant value is zero after it.
    Plus,
    Minus,
    One(Function),
    Two(Operator),
}

/// A function of one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Function {
    Cos,
    Not,
    Sin,
    Tan,
    Asin,
    Acos,
    Atan,
    Sqrt,
    Abs,
    Round,
    Fix,
    Fup,
    Ln,
    Exp,
}

/// An operation on two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operator {
    Add,
    Subtract,
    Multiply,
    Divide,
    Modulus,
    Bits(Bits),
}

/// An operation on bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bits {
    And,
    Or,
    Xor,
}

/// Why a block is not executed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stop {
    /// It is refused.
    Refused(FaultKind, &'static str),
    /// The documents leave it open.
    Open(&'static str),
    /// A code that this interpreter does not have: its letter, and ten times its number.
    Unsupported(u8, u16),
    /// A variable beyond the common ones: a system variable, which this interpreter does not have.
    SystemVariable(i64),
}

/// A refusal.
pub(super) fn refuse<T>(kind: FaultKind, why: &'static str) -> Result<T, Stop> {
    Err(Stop::Refused(kind, why))
}

/// The greatest number of a common variable.
const LAST_COMMON: i64 = 599;

/// The variable of a number.
pub(super) fn slot(number: Option<f64>) -> Result<Slot, Stop> {
    let Some(number) = number else { return Err(Stop::Open("a vacant number of a variable")) };
    let out = Stop::Refused(FaultKind::ParameterOutOfRange, "there is no such variable");
    match crate::math::whole(number) {
        Some(0) => Ok(Slot::Vacant),
        Some(place @ 1..=33) => {
            u8::try_from(place.wrapping_sub(1)).map(Slot::Local).map_err(|_| out)
        }
        Some(number @ (100..=199 | 500..=599)) => {
            u16::try_from(number).map(Slot::Common).map_err(|_| out)
        }
        Some(number) if number > LAST_COMMON => Err(Stop::SystemVariable(number)),
        Some(_) => Err(out),
        None if number > 9.0e15 => Err(Stop::SystemVariable(i64::MAX)),
        None if number < -9.0e15 => Err(out),
        None => Err(Stop::Open("a number of a variable that is not whole")),
    }
}
