//! The modal side: what the words of a block mean under the modes in force, in the documents' order of execution.
//!
//! ```text
//! Words ─► check (groups, missing and unused words) ─► execute (11.4.23, phase by phase) ─► Sink
//!                                                         └─► motion_dispatch ─► cycles/, a few moves at a time
//! ```
//!
//! **Invariants.**
//! * The codes are in one table, [`codes`]; no other file says which group a code is in or which words it takes.
//! * A refused block leaves the modes as they were, [`undo`], unless its probe has moved and found nothing.
//! * A setting is reported to the sink when it changed, and before the next effect.
//! * Positions are program coordinates in the active length unit; only an offset, a unit or G53 goes through machine
//!   coordinates.

mod arcs;
mod check;
mod choices;
mod codes;
mod compensation;
mod coolant_and_overrides;
mod coordinates;
mod cycles;
mod end;
mod end_point;
mod execute;
mod fast_path;
mod feed_length;
mod initial;
mod io;
pub(crate) mod letters;
mod mode_select;
mod modes;
mod motion;
mod motion_codes;
mod motion_dispatch;
pub(crate) mod offsets;
mod polar;
mod predefined;
mod probe;
mod read_ahead;
mod refusal;
mod report;
mod saved;
mod saved_states;
mod snapshots;
mod spindle;
mod splines;
mod stand_alone;
mod state;
mod stored_positions;
mod threads;
mod tool;
mod tool_table;
mod transforms;
mod turning;
mod undo;
mod values;
mod vector;
mod work_offsets;

#[cfg(test)]
mod tests;

pub(crate) use choices::Choices;
pub(crate) use coordinates::{Conversion, Coordinates};
pub(crate) use modes::Modes;
pub(crate) use refusal::{Flow, Refusal};
pub(crate) use state::Modal;
pub(crate) use turning::ProfileStage;
