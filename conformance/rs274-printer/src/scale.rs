//! Lengths in another unit.

use gaugeblock_vocabulary::{LengthUnit, Position};

use super::codes::INCH;

/// From one length unit to another.
pub(super) fn scale(from: LengthUnit, to: LengthUnit) -> f64 {
    match (from, to) {
        (LengthUnit::Inch, LengthUnit::Millimetre) => INCH,
        (LengthUnit::Millimetre, LengthUnit::Inch) => INCH.recip(),
        (LengthUnit::Inch, LengthUnit::Inch) | (LengthUnit::Millimetre, LengthUnit::Millimetre) => {
            1.0
        }
    }
}

/// A position in another length unit.
pub(super) fn scaled(position: Position, scale: f64) -> Position {
    let [x, y, z, a, b, c, u, v, w] = position.to_array();
    let [x, y, z, u, v, w] = [x, y, z, u, v, w].map(|length| length * scale);
    Position::from([x, y, z, a, b, c, u, v, w])
}
