//! Control: which block comes next. Lines come in, blocks are evaluated, and o-words, calls and M98 choose the way on.
//!
//! Loops, subs and numbered subprograms are compiled into segments; everything else is read, executed and forgotten.
//! A block that jumps knows its label only; where that leads is looked up among the definitions of the running call
//! level, because the documents define labels when a block is executed, and not by nested text.

mod call_stack;
mod calls;
mod compile;
mod evaluate;
mod execute;
mod fast_path;
mod files;
mod label_search;
mod loops;
mod message;
mod o_words;
mod profile;
mod reader;
mod refuse;

pub(crate) use call_stack::{
    CallStack, Cursor, Definition, Frame, FrameKind, LOOP, PROGRAMS, STREAM,
};
pub(crate) use evaluate::Evaluator;
pub(crate) use message::{Logs, View};
pub(crate) use reader::Reader;
