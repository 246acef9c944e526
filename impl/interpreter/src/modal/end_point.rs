//! The end point of a move's axis words: absolute and incremental (11.5.54), diameters (11.5.10), polar words
//! (11.4.12), machine coordinates (11.5.33).

use gaugeblock_vocabulary::{Distance, FaultKind, Lathe};

use crate::faults::{PlantedFault, planted};
use crate::math;
use crate::words::Words;

use super::Modal;
use super::check::Block;
use super::codes::NON_MODAL;
use super::coordinates::Coordinates;
use super::letters::{AXES, X, Y};
use super::refusal::{Refusal, refuse};

impl Words {
    /// Whether the block has a polar word; both together stand for X and Y.
    #[inline]
    pub(crate) fn is_polar(&self) -> bool {
        self.at.is_some() || self.caret.is_some()
    }

    /// The letters of its axis words, those among them that polar words stand for.
    pub(crate) fn axes(&self) -> u32 {
        let polar = if self.is_polar() { X | Y } else { 0 };
        self.present & AXES | polar
    }
}

impl Modal {
    /// The point after the axis words of a plain move: no diameters, no polar words, no machine coordinates.
    #[inline]
    pub(super) fn moved(&self, words: &Words) -> Coordinates {
        match self.active.now().distance {
            Distance::Absolute => self.position.replaced(words),
            Distance::Incremental => self.position.moved_by(words),
        }
    }

    /// Moves the point, likewise, in place.
    #[inline]
    pub(super) fn move_by(&mut self, words: &Words) {
        match self.active.now().distance {
            Distance::Absolute => self.position.replace(words),
            Distance::Incremental => self.position.add(words),
        }
    }

    /// Moves the point to the end of the block's move.
    pub(super) fn move_point(&mut self, block: &Block<'_>) -> Result<(), Refusal> {
        let machine_coordinates = block.g(NON_MODAL) == Some(530);
        let radius = self.active.now().lathe == Lathe::Radius;
        if radius && !block.words.is_polar() && !machine_coordinates {
            self.move_by(block.words);
        } else {
            self.position = self.block_end_point(block)?;
        }
        Ok(())
    }

    /// The end of the block's move, in program coordinates.
    pub(super) fn block_end_point(&self, block: &Block<'_>) -> Result<Coordinates, Refusal> {
        let radius;
        let diameter = self.active.now().lathe == Lathe::Diameter;
        let words = if diameter && !planted(PlantedFault::DiameterAsRadius) {
            radius = with_radius(block.words);
            &radius
        } else {
            block.words
        };
        if block.g(NON_MODAL) == Some(530) {
            return self.machine_end_point(words);
        }
        let incremental = self.active.now().distance == Distance::Incremental;
        let end = self.moved(words);
        if words.is_polar() { end.at_polar(self.position, words, incremental) } else { Ok(end) }
    }

    /// G53: absolute positions whatever the distance mode says (11.1.2.1). Axes without a word stay where they are on
    /// the machine, also where the system of the program is turned.
    fn machine_end_point(&self, words: &Words) -> Result<Coordinates, Refusal> {
        let machine = self.active.now().machine_of(self.position);
        let adds = planted(PlantedFault::MachineIncremental)
            && self.active.now().distance == Distance::Incremental;
        let mut end = if adds { machine.moved_by(words) } else { machine.replaced(words) };
        if words.is_polar() {
            end = end.at_polar(machine, words, false)?;
        }
        Ok(self.with_machine(self.position, words.axes(), end))
    }

    /// A point in program coordinates, of which some axes are put where a point in machine coordinates is.
    pub(super) fn with_machine(
        &self,
        point: Coordinates,
        letters: u32,
        machine: Coordinates,
    ) -> Coordinates {
        let now = self.active.now();
        let machine = now.machine_of(point).taking(letters, machine);
        // The others keep their coordinates to the last bit.
        point.taking(now.turned_letters(letters), now.program_of(machine))
    }
}

impl Coordinates {
    /// With X and Y of the polar words (11.4.12). In incremental mode distance and angle are added to those of the
    /// point.
    pub(super) fn at_polar(
        mut self,
        from: Self,
        words: &Words,
        incremental: bool,
    ) -> Result<Self, Refusal> {
        let [from_x, from_y, ..] = from.0;
        let distance = math::hypotenuse(from_x, from_y);
        if incremental && distance <= 0.0 {
            return refuse(FaultKind::OutOfDomain, "an incremental polar move from the origin");
        }
        // A zero has no sign.
        let angle = math::arctangent(from_y + 0.0, from_x + 0.0);
        let (distance, angle) = if incremental {
            (distance + words.at.unwrap_or(0.0), angle + words.caret.unwrap_or(0.0))
        } else {
            // What has no word stays as it is (11.5.1).
            (words.at.unwrap_or(distance), words.caret.unwrap_or(angle))
        };
        let (sine, cosine) = math::direction(angle);
        let [x, y, ..] = &mut self.0;
        (*x, *y) = (distance * cosine, distance * sine);
        Ok(self)
    }
}

/// The words with the X word as a radius: diameter mode (11.5.10).
pub(super) fn with_radius(words: &Words) -> Words {
    let mut radius = words.clone();
    if let Some(x) = words.get(b'X') {
        radius.set(23, x / 2.0);
    }
    radius
}
