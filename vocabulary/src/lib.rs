//! The vocabulary of Gaugeblock: what goes into a run and what can be observed of it.
//!
//! Read it in this order: [`Scenario`] (all that a run depends on), [`Outcome`] (what can be observed), [`Effect`],
//! [`Settings`] and [`State`], [`Fault`]. Every type has a JSON form, whose schema is generated from it ([`schema`]);
//! a scenario also has a TOML form and an outcome a line form that a person reads ([`text`]). What is commanded of
//! the axes, cycle by cycle, has words of its own: [`motion`].
//!
//! **Invariant:** this crate interprets nothing. It holds no block parser, no table of codes, no unit conversion and
//! no arithmetic on positions; reference model and production interpreter share it and nothing else.

#![no_std]

extern crate alloc;

mod block;
mod effect;
mod error;
mod fault;
mod field;
mod indexed;
#[cfg(feature = "serde")]
mod json;
mod language;
mod modes;
pub mod motion;
mod outcome;
mod pin;
mod position;
pub mod scenario;
#[cfg(feature = "schema")]
pub mod schema;
mod settings;
mod shared;
mod sorted;
#[cfg(feature = "text")]
pub mod text;
#[cfg(feature = "toml")]
mod toml;
mod words;

pub use block::{BlockLocation, Span};
pub use effect::{Channel, Effect, OrientDirection, OutputTiming, Request, WaitMode};
pub use error::TextError;
pub use fault::{Fault, FaultKind};
pub use field::{Argument, Entry, Scalar, Value};
pub use indexed::Indexed;
pub use language::Language;
pub use modes::{
    Compensation, ControllerMode, Distance, FeedMode, Lathe, LengthUnit, Motion, PathControlMode,
    Plane, ReturnMode, SpindleMode, SpindleTurn, Switch,
};
pub use outcome::{Bound, End, Event, Outcome, Sample, Step, Undetermined};
pub use pin::{Pin, PinChange};
pub use position::{Axis, Position};
pub use scenario::{Machine, Options, Program, Scenario, Tool};
pub use settings::{
    GppState, MacroValue, NctState, Rs274State, Settings, SpindleLimit, State, Vacancy,
};
pub use shared::Shared;
pub use sorted::{Entries, Sorted};
pub use words::Word;
