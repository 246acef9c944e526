//! The production side: an interpreter and a trajectory planner for embedding in a controller.
//!
//! ```text
//! Source ─► Interpreter ─► Sink        program text to settings and effects, a block at a time
//! Segment ─► Planner ─► OutputParameter    canonical moves to servo samples, a cycle at a time
//! ```
//!
//! **State of this crate:** the interface stands, [`Interpreter::new`] and [`Planner::new`] answer [`Error::NotYet`].
//!
//! **Invariants.**
//! * It is written from the documents, without reading the reference model, and shares only the vocabulary with it.
//! * It has no `std`: there is no clock, no file, no environment and no thread to reach for.
//! * It never panics, on any program; the lints below refuse what could.
//! * A step of the interpreter is one block at most and a cycle of the planner is bounded, so that a caller can always stop.
#![no_std]
#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::unreachable,
        clippy::indexing_slicing,
        clippy::string_slice,
        clippy::arithmetic_side_effects,
        clippy::integer_division,
        clippy::as_conversions
    )
)]

extern crate alloc;

mod canon;
mod error;
mod interpret;
mod limits;
pub mod plan;
mod source;

pub use canon::{Reply, Sink};
pub use error::Error;
pub use interpret::{Interpreter, Progress};
pub use limits::{Limit, Limits};
pub use plan::Planner;
pub use source::{Line, Source, Unreadable};
