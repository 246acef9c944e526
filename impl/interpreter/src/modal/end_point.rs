//! Where a move ends by its axis words: absolute and incremental (11.5.54), diameters (11.5.10), polar words
//! (11.4.12), machine coordinates (11.5.33).

use gaugeblock_vocabulary::{Distance, Lathe};

use crate::faults::{PlantedFault, planted};
use crate::words::Words;

use super::Modal;
use super::check::Block;
use super::codes::NON_MODAL;
use super::coordinates::Coordinates;
use super::letters::{A, AXES, B, C, X, Y};
use super::polar::Polar;
use super::refusal::Refusal;

/// The code of G53, in tenths.
const G53: u16 = 530;
/// Place of the X word in [`Words::values`].
const X_WORD: u8 = b'X' - b'A';

impl Words {
    /// Whether the block has a polar word; both together stand for X and Y.
    #[inline]
    pub(crate) fn is_polar(&self) -> bool {
        self.at.is_some() || self.caret.is_some()
    }

    /// The letters of its axis words, including X and Y if it has a polar word.
    pub(crate) fn axes(&self) -> u32 {
        let polar = if self.is_polar() { X | Y } else { 0 };
        self.present & AXES | polar
    }
}

impl Modal {
    /// The polar words of a block.
    pub(super) fn polar(&self, words: &Words, incremental: bool) -> Polar {
        Polar::of(words, incremental, self.emulates_rs274)
    }

    /// Where a plain move ends: one without diameters, polar words and machine coordinates.
    #[inline]
    pub(super) fn plain_end_point(&self, words: &Words) -> Coordinates {
        match self.active.now().distance {
            Distance::Absolute => self.position.replaced(words),
            Distance::Incremental => self.position.moved_by(words).rotary_fault(words),
        }
    }

    /// Makes a plain move: sets the controlled point to [`Self::plain_end_point`], without a copy of it.
    #[inline]
    pub(super) fn apply_axis_words(&mut self, words: &Words) {
        match self.active.now().distance {
            Distance::Absolute => self.position.replace(words),
            Distance::Incremental => {
                self.position.add(words);
                if planted(PlantedFault::RotaryAbsolute) {
                    self.position = self.position.rotary_fault(words);
                }
            }
        }
    }

    /// Makes the move of a block, plain or not: sets the controlled point to [`Self::block_end_point`].
    pub(super) fn move_to_end_point(&mut self, block: &Block<'_>) -> Result<(), Refusal> {
        let machine_coordinates = block.g(NON_MODAL) == Some(G53);
        let radius = self.active.now().lathe == Lathe::Radius;
        if radius && !block.words.is_polar() && !machine_coordinates {
            self.apply_axis_words(block.words);
        } else {
            self.position = self.block_end_point(block)?;
        }
        Ok(())
    }

    /// Whether the X word of a move is a diameter (11.5.10).
    pub(super) fn halves_x(&self, machine_coordinates: bool) -> bool {
        let absolute = machine_coordinates || !self.is_incremental();
        self.active.now().lathe == Lathe::Diameter
            && (absolute || !planted(PlantedFault::DiameterAbsoluteOnly))
    }

    /// Where the block's move ends, in program coordinates.
    pub(super) fn block_end_point(&self, block: &Block<'_>) -> Result<Coordinates, Refusal> {
        let radius;
        let machine_coordinates = block.g(NON_MODAL) == Some(G53);
        let diameter = self.halves_x(machine_coordinates);
        let words = if diameter && !planted(PlantedFault::DiameterAsRadius) {
            radius = with_radius(block.words);
            &radius
        } else {
            block.words
        };
        if machine_coordinates {
            return self.machine_end_point(words);
        }
        let incremental = self.active.now().distance == Distance::Incremental;
        let end = self.plain_end_point(words);
        if !words.is_polar() {
            return Ok(end);
        }
        self.polar(words, incremental).end(self.position, end)
    }

    /// Where a move with G53 ends. Its words are absolute in every distance mode (11.1.2.1). Axes without a word stay
    /// where they are on the machine, even in a rotated coordinate system.
    fn machine_end_point(&self, words: &Words) -> Result<Coordinates, Refusal> {
        let machine = self.active.now().machine_of(self.position);
        let adds = planted(PlantedFault::MachineIncremental)
            && self.active.now().distance == Distance::Incremental;
        let mut end = if adds { machine.moved_by(words) } else { machine.replaced(words) };
        if words.is_polar() {
            end = self.polar(words, false).end(machine, end)?;
        }
        if planted(PlantedFault::MachineKeepsTool) {
            end = end.plus(self.active.now().tool_offset);
        }
        Ok(self.with_machine(self.position, words.axes(), end))
    }

    /// `point`, with the axes of `letters` placed where `machine` is. `point` and the result are in program
    /// coordinates, `machine` is in machine coordinates.
    pub(super) fn with_machine(
        &self,
        point: Coordinates,
        letters: u32,
        machine: Coordinates,
    ) -> Coordinates {
        let now = self.active.now();
        let machine = now.machine_of(point).taking(letters, machine);
        // The conversion there and back would change the last bits of the other axes.
        point.taking(now.letters_moved_together(letters), now.program_of(machine))
    }
}

impl Coordinates {
    /// The end of an incremental move. With a planted fault words of rotary axes are absolute.
    #[inline]
    pub(super) fn rotary_fault(self, words: &Words) -> Self {
        if planted(PlantedFault::RotaryAbsolute) {
            let rotary = words.present & (A | B | C);
            return self.taking(rotary, Self::default().replaced(words));
        }
        self
    }
}

/// The words with the X word as a radius, where it is a diameter (11.5.10).
pub(super) fn with_radius(words: &Words) -> Words {
    let mut radius = words.clone();
    if let Some(x) = words.get(b'X') {
        radius.set(X_WORD, x / 2.0);
    }
    radius
}
