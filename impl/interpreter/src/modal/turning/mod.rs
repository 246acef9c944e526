//! Lathe cycles: G70 (11.5.38), and G71, G71.1, G71.2, G72, G72.1, G72.2 (11.5.39).
//!
//! ```text
//! Words ─► Cycle, first motion ─► control runs the sub ─► reading ─► profile ─► offset ─► passes
//! ```
//!
//! The formulas, and what of them is open, are in `docs/turning.md`.
//!
//! **Invariants.**
//! * A step reads a block of the sub, or makes a bounded number of rounds of the offset and of moves.
//! * A profile has no more moves than [`Limits`](crate::Limits) allows.
//! * Where `docs/turning.md` lists an open point, the run ends as not specified.

mod cycle;
mod finishing;
mod frame;
mod motions;
mod numbers;
mod offset;
mod piece;
mod profile;
mod profile_words;
mod reading;
mod roughing;
mod rounding;
mod state;
mod steps;

pub(crate) use state::ProfileStage;
pub(super) use state::Turning;
