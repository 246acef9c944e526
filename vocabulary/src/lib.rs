//! The vocabulary of Gaugeblock: what goes into a run and what can be observed of it.
//!
//! Read it in this order: [`Scenario`] (all that a run depends on), [`Outcome`] (what can be observed), [`Effect`],
//! [`Settings`] and [`State`], [`Fault`]. The path, limits and servo samples of a motion are in [`motion`].
//!
//! The crate is `no_std` and needs an allocator. Its forms are features, all of them on by default:
//!
//! | feature | form |
//! | --- | --- |
//! | `text` | the line form of outcomes, the table form of samples |
//! | `serde` | JSON, by `Serialize` and `Deserialize` |
//! | `toml` | TOML files of scenarios, paths, limits and scripts |
//! | `schema` | JSON schemas, generated from the types |
//!
//! In source, read `words`, `position`, `field` and `record` first; everything else is declared with them.
//!
//! **Invariant:** this crate interprets nothing. It holds no block parser, no table of codes, no unit conversion and
//! no arithmetic on positions. The reference model and the interpreter share this crate and no other of the workspace.

#![no_std]

extern crate alloc;

mod block;
mod declared_language;
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
mod record;
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
pub use declared_language::{CommentKind, DeclaredLanguage, LanguageCheck, ParameterKind};
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
