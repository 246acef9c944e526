//! Where a move ends by its axis words: absolute and incremental (11.5.54), diameters (11.5.10), polar words
//! (11.4.12), machine coordinates (11.5.33).

use gaugeblock_vocabulary::{Distance, FaultKind, Lathe};

use crate::faults::{PlantedFault, planted};
use crate::math;
use crate::words::Words;

use super::Modal;
use super::check::Block;
use super::codes::NON_MODAL;
use super::coordinates::Coordinates;
use super::letters::{A, AXES, B, C, X, Y};
use super::refusal::{Refusal, refuse};

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
        if words.is_polar() { end.at_polar(self.position, words, incremental) } else { Ok(end) }
    }

    /// Where a move with G53 ends. Its words are absolute in every distance mode (11.1.2.1). Axes without a word stay
    /// where they are on the machine, even in a rotated coordinate system.
    fn machine_end_point(&self, words: &Words) -> Result<Coordinates, Refusal> {
        let machine = self.active.now().machine_of(self.position);
        let adds = planted(PlantedFault::MachineIncremental)
            && self.active.now().distance == Distance::Incremental;
        let mut end = if adds { machine.moved_by(words) } else { machine.replaced(words) };
        if words.is_polar() {
            end = end.at_polar(machine, words, false)?;
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

    /// The point with X and Y from the polar words (11.4.12). In incremental mode the words are added to the distance
    /// and angle of `from`.
    pub(super) fn at_polar(
        mut self,
        from: Self,
        words: &Words,
        incremental: bool,
    ) -> Result<Self, Refusal> {
        let [from_x, from_y, ..] = from.0;
        let there = if incremental {
            PolarIncrement::of(words).from([from_x, from_y])?
        } else {
            let (distance, angle) = distance_and_angle([from_x, from_y]);
            // A distance or angle without a word stays as it is (11.5.1).
            at_distance(words.at.unwrap_or(distance), words.caret.unwrap_or(angle))
        };
        let [x, y, ..] = &mut self.0;
        [*x, *y] = there;
        Ok(self)
    }
}

/// Polar words of an incremental move: how much further it goes, and by how many degrees it turns (11.4.12).
#[derive(Clone, Copy, Debug)]
pub(super) struct PolarIncrement {
    distance: f64,
    angle: f64,
    from_zero: bool,
}

impl PolarIncrement {
    /// The increment of a block's words.
    pub(super) fn of(words: &Words) -> Self {
        let from_zero = words.caret.is_some() && planted(PlantedFault::PolarAngleAbsolute);
        let (distance, angle) = (words.at.unwrap_or(0.0), words.caret.unwrap_or(0.0));
        Self { distance, angle, from_zero }
    }

    /// X and Y of the end of the move.
    pub(super) fn from(self, start: [f64; 2]) -> Result<[f64; 2], Refusal> {
        let (distance, angle) = distance_and_angle(start);
        if distance <= 0.0 {
            return refuse(FaultKind::OutOfDomain, "an incremental polar move from the origin");
        }
        let angle = if self.from_zero { 0.0 } else { angle };
        Ok(at_distance(distance + self.distance, angle + self.angle))
    }
}

/// The distance of a point from the origin, and its angle in degrees.
fn distance_and_angle([x, y]: [f64; 2]) -> (f64, f64) {
    // `+ 0.0` makes a negative zero positive: the angle of (−0, −0) would be −180° and not 0.
    (math::hypotenuse(x, y), math::arctangent(y + 0.0, x + 0.0))
}

/// X and Y of a point.
fn at_distance(distance: f64, angle: f64) -> [f64; 2] {
    let (sine, cosine) = math::direction(angle);
    [distance * cosine, distance * sine]
}

/// The words with the X word as a radius, where it is a diameter (11.5.10).
pub(super) fn with_radius(words: &Words) -> Words {
    let mut radius = words.clone();
    if let Some(x) = words.get(b'X') {
        radius.set(X_WORD, x / 2.0);
    }
    radius
}
