//! The planner of `gaugeblock-impl`, from the same files and without the rest: it needs `core`, `alloc` and `libm`.
//!
//! The gate builds it for a processor without an operating system, where a use of `std` anywhere in it has nothing to
//! link to, and runs its samples on a second processor, where they must be the same to the last bit. The interpreter
//! beside it speaks the vocabulary of `gaugeblock-vocabulary`, whose files are read with `std`.
#![no_std]

extern crate alloc;

#[expect(dead_code, reason = "the interpreter uses the others")]
#[path = "../../src/math.rs"]
mod math;
#[path = "../../src/plan/mod.rs"]
pub mod plan;

pub use plan::Planner;

/// What the planner needs of the reasons that the whole crate has.
mod error {
    /// Why a planner is not made.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Error {
        /// This version does not do it yet; what, for people.
        NotYet(&'static str),
        /// A value of the machine is not usable; which and why, for people.
        Configuration(&'static str),
    }
}

pub use error::Error;
