//! What each phase of a block does.

pub mod compensation;
pub mod coolant;
pub mod dwell;
pub mod feed;
pub mod message;
pub mod motion;
pub mod offsets;
pub mod overrides;
pub mod path;
pub mod program_end;
pub(crate) mod restore;
pub mod saved_state;
pub mod spindle;
pub mod stop;
mod target;
pub mod tool;
pub mod tool_length;
pub mod units_planes;
mod word;

pub(crate) use target::letter;
pub(crate) use word::{whole, word};
