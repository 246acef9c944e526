//! From characters to the packed form: a line becomes a block, once, and the block can then run any number of times.

pub(crate) mod arithmetic;
mod block;
mod choices;
mod comment;
mod cursor;
mod expression;
mod number;
mod oword;
pub(crate) mod packed;
mod packer;
mod parameter;

use alloc::boxed::Box;

use gaugeblock_vocabulary::FaultKind;

pub(crate) use block::{LinePlace, Taken, code_number, is_oword, is_percent};
pub(crate) use choices::{AbsentName, Choices, DoLabel, PercentAlone, RepeatFraction, RoundHalf};
pub(crate) use expression::group;
pub(crate) use number::plain as plain_number;
pub(crate) use oword::label_ops;
pub(crate) use packed::{Place, Segment};
pub(crate) use packer::Packer;
pub(crate) use parameter::{is_position, is_told, parameter_number};

/// What becomes of a part of a line. A refusal is boxed because the way without one must be short.
pub(crate) type Packed<T> = Result<T, Box<Refused>>;

/// Why a line is no block: raised when the block would be executed, not before.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Refused {
    /// The kind of the fault.
    pub(crate) kind: FaultKind,
    /// For people.
    pub(crate) message: &'static str,
    /// First byte of the offending part of the line.
    pub(crate) start: u32,
    /// One past its last byte.
    pub(crate) end: u32,
}
