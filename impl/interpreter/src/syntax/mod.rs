//! From characters to bytecode: a line becomes a block, once, and the block can then run any number of times.

pub(crate) mod arithmetic;
mod block;
pub(crate) mod bytecode;
mod choices;
mod code_number;
mod comment;
mod compiler;
mod cursor;
mod expression;
mod number;
mod o_word;
mod parameter;

use alloc::boxed::Box;

use gaugeblock_vocabulary::FaultKind;

pub(crate) use block::{LineKind, LinePlace, is_o_word, is_percent};
pub(crate) use bytecode::{CodeSegment, ParameterRef};
pub(crate) use choices::{AbsentName, Choices, DoLabel, PercentAlone, RepeatFraction, RoundHalf};
pub(crate) use code_number::{g_number, m_number};
pub(crate) use compiler::LineCompiler;
pub(crate) use expression::group;
pub(crate) use number::read_short_prefix;
pub(crate) use o_word::label_ops;
pub(crate) use parameter::{is_machine_state, is_position, parameter_number};

/// The result of reading a part of a line. The error is boxed to keep the path without one fast.
pub(crate) type Parsed<T> = Result<T, Box<LineError>>;

/// Why a line is not a valid block: reported when the block would be executed, not before.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct LineError {
    /// The kind of the fault.
    pub(crate) kind: FaultKind,
    /// For people.
    pub(crate) message: &'static str,
    /// First byte of the offending part of the line.
    pub(crate) start: u32,
    /// One past its last byte.
    pub(crate) end: u32,
}
