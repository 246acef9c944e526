//! Length units, and positions axis by axis.

use gaugeblock_vocabulary::{Axis, LengthUnit, Position};

/// Millimetres in a length unit.
pub fn unit_size(unit: LengthUnit) -> f64 {
    match unit {
        LengthUnit::Inch => 25.4,
        LengthUnit::Millimetre => 1.0,
    }
}

/// Whether an axis counts in degrees.
pub(crate) fn is_rotary(axis: Axis) -> bool {
    matches!(axis, Axis::A | Axis::B | Axis::C)
}

/// Two positions, axis by axis.
pub(crate) fn each(a: Position, b: Position, value: impl Fn(f64, f64) -> f64) -> Position {
    let (a, b) = (a.to_array(), b.to_array());
    Position::from(std::array::from_fn::<f64, 9, _>(|place| value(a[place], b[place])))
}

/// A position in another length unit; degrees stay.
pub fn converted(position: Position, from: LengthUnit, to: LengthUnit) -> Position {
    if from == to {
        return position;
    }
    let mut converted = position;
    for axis in Axis::ALL.iter().copied().filter(|axis| !is_rotary(*axis)) {
        *converted.get_mut(axis) = position.get(axis) * unit_size(from) / unit_size(to);
    }
    converted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degrees_are_no_lengths() {
        let inches = Position { x: 1.0, b: 90.0, ..Position::default() };
        let millimetres = Position { x: 25.4, b: 90.0, ..Position::default() };
        assert_eq!(converted(inches, LengthUnit::Inch, LengthUnit::Millimetre), millimetres);
        assert_eq!(converted(millimetres, LengthUnit::Millimetre, LengthUnit::Inch), inches);
    }
}
