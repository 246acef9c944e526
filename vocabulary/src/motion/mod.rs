//! Motion: the programmed path, the limits of a machine, what an operator does, and servo samples.
//!
//! All positions are machine coordinates, millimetres and degrees; times are seconds. Interpreter and planner agree on
//! the path, any controller records samples, and the laws of motion compare one with the other. Path, limits and script
//! have a TOML and a JSON form, samples a table for people ([`Samples::to_csv`]) and a compact form
//! ([`Samples::to_bytes`]).
//!
//! **Invariant:** data and its forms only. Nothing here knows where an arc goes or how long a line is.

mod binary;
#[cfg(feature = "text")]
mod csv;
mod limits;
mod path;
mod samples;
mod script;

pub use binary::SamplesCheck;
#[cfg(feature = "text")]
pub use csv::push_csv_row;
pub use limits::MotionLimits;
pub use path::{Controls, Feed, OutputChange, PathElement, PathMode, ProgrammedPath, Shape};
pub use samples::{Column, Samples, SamplesError};
pub use script::{MotionAction, MotionEvent, MotionScript};
