//! Which way a profile leads along an axis.

use super::piece::Piece;
use super::{ROUNDING, open};
use crate::rs274::refusal::StepError;

/// How far a piece may run back and still be taken for one that does not, active length unit; how a program takes what
/// is between rounding and this length is open.
const LEVEL: f64 = 1e-6;

/// How a profile leads along its travel axis w.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Travel {
    /// Whether it moves nowhere towards smaller w.
    pub(crate) never_back: bool,
    /// Whether it moves nowhere towards greater w.
    pub(crate) never_forth: bool,
}

impl Travel {
    /// That of the pieces after the lead. A level piece leads neither back nor forth, and an arc leads both ways if it
    /// turns inside.
    ///
    /// # Errors
    /// A piece that is nearly level.
    pub(crate) fn of(pieces: &[Piece]) -> Result<Self, StepError> {
        let (mut back, mut forth) = (0.0_f64, 0.0_f64);
        for piece in pieces {
            let mut from = piece.start.w;
            for to in piece.furthest_inside().map(|point| point.w).chain([piece.end.w]) {
                back = back.max(from - to);
                forth = forth.max(to - from);
                from = to;
            }
        }
        if [back, forth].iter().any(|way| *way > ROUNDING && *way <= LEVEL) {
            return Err(open("a profile that is level within a millionth"));
        }
        Ok(Self { never_back: back <= ROUNDING, never_forth: forth <= ROUNDING })
    }

    /// Whether the profile leads one way only.
    pub(crate) fn is_monotonic(self) -> bool {
        self.never_back || self.never_forth
    }
}
