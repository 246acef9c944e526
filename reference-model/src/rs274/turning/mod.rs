//! The profile of a lathe cycle as geometry: pieces in their plane, without a controller.
//!
//! | room | what it settles |
//! | --- | --- |
//! | [`point`] | points of the plane, and the axes in which a cycle looks at them |
//! | [`piece`] | a line or an arc of a profile: where it falls, where it has a depth, its parts |
//! | [`fillet`] | fillets and chamfers at the corners of a profile |
//! | [`monotonic`] | which way a profile leads along an axis |
//! | [`offset`] | the profile at a distance |
//!
//! The facts are in docs/turning.md. The travel axis is w and the depth axis u. A profile is read with Z as w and X as
//! u; a cycle then looks at it in its own [`Frame`]. Lengths are in the active length unit, X is a radius.

mod fillet;
mod monotonic;
mod offset;
mod piece;
mod point;

pub(crate) use fillet::{Corner, Move, Profile, check_corners, pieces};
pub(crate) use monotonic::Travel;
pub(crate) use offset::{left_of, offset};
pub(crate) use piece::{Curve, Piece, is_tied};
pub(crate) use point::{Frame, Point};

/// Distance, active length unit, up to which two values are equal within rounding.
pub(crate) const ROUNDING: f64 = 1e-9;

/// Shortest piece of a profile, active length unit: a shorter one is dropped.
const SHORTEST: f64 = 0.001;

/// How far apart along the travel axis two offset ends are at least, active length unit, where an arc joins them.
const SHORTEST_JOIN: f64 = 0.01;

/// A step that the documents leave open.
fn open(what: &str) -> super::refusal::StepError {
    super::refusal::StepError::Unspecified(what.to_owned())
}
