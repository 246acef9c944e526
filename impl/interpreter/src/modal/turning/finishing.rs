//! G70: passes along the profile.

use crate::faults::{PlantedFault, planted};
use crate::math;

use super::motions::CycleMotion;
use super::numbers::Contour;
use super::offset::Offset;

/// G70 under way.
#[derive(Clone, Debug)]
pub(super) struct Finishing {
    /// D, E and P.
    distances: (f64, f64, f64),
    /// The passes that are left, the one in progress included.
    pub(super) passes: u64,
    /// The offset of this pass.
    pub(super) offset: Offset,
    /// Whether it is complete.
    pub(super) is_ready: bool,
    place: Place,
}

/// The next move of a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    /// The traverse to where the cycle starts.
    Start,
    /// The traverse to the profile.
    Profile,
    /// A piece.
    Piece(usize),
}

impl Finishing {
    /// The passes of D, E and P. The tool is at the start already where `at_start` is set.
    pub(super) fn new(
        contour: &Contour,
        distances: (f64, f64, f64),
        (at_start, pieces_max): (bool, u32),
    ) -> Self {
        let passes = math::to_count(distances.2);
        let place = if at_start { Place::Profile } else { Place::Start };
        let offset = Offset::new(&[], 0.0, (pieces_max, contour.joins_parallels));
        let mut finishing = Self { distances, passes, offset, is_ready: false, place };
        finishing.begin_pass(contour, pieces_max);
        finishing
    }

    /// The distance of the pass in progress.
    pub(super) fn distance(&self) -> f64 {
        let (from, to, passes) = self.distances;
        let mut pass = self.passes.saturating_sub(1);
        if planted(PlantedFault::PassesAscend) {
            pass = math::to_count(passes).saturating_sub(self.passes);
        } else if planted(PlantedFault::PassCountsWhole) {
            pass = self.passes;
        }
        math::from_u64(pass) * (from - to) / passes + to
    }

    fn begin_pass(&mut self, contour: &Contour, pieces_max: u32) {
        let distance = self.distance() * contour.side.unwrap_or(1.0);
        let bounds = (pieces_max, contour.joins_parallels);
        self.offset = Offset::new(&contour.pieces, distance, bounds);
        self.is_ready = false;
    }

    /// The next move; none where the pass is over and another one begins, or the cycle is over.
    pub(super) fn next(&mut self, contour: &Contour, pieces_max: u32) -> Option<CycleMotion> {
        match self.place {
            Place::Start => {
                self.place = Place::Profile;
                Some(CycleMotion::Traverse(contour.start))
            }
            Place::Profile => {
                self.place = Place::Piece(0);
                let first = self.offset.pieces.first()?;
                Some(CycleMotion::Traverse(first.from))
            }
            Place::Piece(place) => {
                let Some(piece) = self.offset.pieces.get(place) else {
                    self.passes = self.passes.saturating_sub(1);
                    let is_straight = planted(PlantedFault::StraightToNextPass);
                    self.place = if is_straight { Place::Profile } else { Place::Start };
                    self.begin_pass(contour, pieces_max);
                    return None;
                };
                self.place = Place::Piece(place.saturating_add(1));
                Some(CycleMotion::along(piece.curve, piece.to))
            }
        }
    }
}
