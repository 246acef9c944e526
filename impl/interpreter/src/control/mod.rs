//! Control: which block comes next. Lines come in, blocks are evaluated, and o-words, calls and M98 choose the way on.
//!
//! Loops, subs and numbered subprograms lie packed in segments; everything else is read, executed and forgotten. A
//! block that jumps knows its label only; where that leads is looked up among the definitions of the running call
//! level, because the documents speak of labels that are defined when a block is executed, and not of nested text.

mod calls;
mod direct;
mod evaluate;
mod execute;
mod files;
mod flow;
mod gather;
mod loops;
mod message;
mod operand;
mod reader;
mod refuse;
mod scope;
mod seek;

pub(crate) use evaluate::Calculator;
pub(crate) use message::{Logs, View};
pub(crate) use reader::Reader;
pub(crate) use scope::{Cursor, Definition, Frame, FrameKind, LOOP, PROGRAMS, STREAM, Scopes};
