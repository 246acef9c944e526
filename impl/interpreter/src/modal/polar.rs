//! Polar words: X and Y by a distance from the origin and an angle (11.4.12).

use gaugeblock_vocabulary::FaultKind;

use crate::faults::{PlantedFault, planted};
use crate::math;
use crate::quirks;
use crate::words::Words;

use super::coordinates::Coordinates;
use super::refusal::{Refusal, refuse};

/// The polar words of a block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Polar {
    /// Length units; a word that is left out keeps the distance.
    distance: Option<f64>,
    /// Degrees; a word that is left out keeps the angle.
    angle: Option<f64>,
    /// Whether the words are added to distance and angle of the point before.
    incremental: bool,
    emulates_rs274: bool,
}

impl Polar {
    /// The polar words of a block.
    pub(super) fn of(words: &Words, incremental: bool, emulates_rs274: bool) -> Self {
        Self { distance: words.at, angle: words.caret, incremental, emulates_rs274 }
    }

    /// The point with X and Y of the words, after `from`; the other axes are those of `others`.
    pub(super) fn end(
        self,
        from: Coordinates,
        mut others: Coordinates,
    ) -> Result<Coordinates, Refusal> {
        let [from_x, from_y, ..] = from.0;
        let there = self.after([from_x, from_y])?;
        let [x, y, ..] = &mut others.0;
        [*x, *y] = there;
        Ok(others)
    }

    /// X and Y of the words, after a point.
    pub(super) fn after(self, [x, y]: [f64; 2]) -> Result<[f64; 2], Refusal> {
        let distance = math::hypotenuse(x, y);
        if self.incremental && distance <= 0.0 {
            return refuse(FaultKind::OutOfDomain, "an incremental polar move from the origin");
        }
        let from_zero = self.angle.is_some() && planted(PlantedFault::PolarAngleAbsolute);
        let (first, turned) = if self.incremental { (distance, !from_zero) } else { (0.0, false) };
        if self.emulates_rs274 {
            let of_point = math::hypotenuse_of_any_size(x, y);
            let first = if self.incremental { of_point } else { 0.0 };
            let distance = self.distance.map_or(of_point, |more| first + more);
            return Ok(quirks::at_distance([x, y], distance, self.angle, turned));
        }
        let distance = self.distance.map_or(distance, |more| first + more);
        // `+ 0.0` makes a negative zero positive: the angle of (−0, −0) would be −180° and not 0.
        let angle = math::arctangent(y + 0.0, x + 0.0);
        let first = if turned { angle } else { 0.0 };
        let (sine, cosine) = math::direction(self.angle.map_or(angle, |more| first + more));
        Ok([distance * cosine, distance * sine])
    }
}
