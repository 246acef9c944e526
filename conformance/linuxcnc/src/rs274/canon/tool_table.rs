//! Writing into the tool table.
//!
//! The call prints an entry without its diameter, and lengths in the unit of the machine. The diameter is the one that
//! the table had, or twice the R of the block.

use gaugeblock_vocabulary::{Axis, Effect, LengthUnit, Position};

use super::{Call, Canon, Done, Mark, whole};

/// Millimetres in an inch.
const INCH: f64 = 25.4;

impl Canon {
    /// An entry of the tool table was written. Place 0 is the spindle's copy of it.
    pub(super) fn tool_entry(&mut self, call: &Call, numbers: &[f64]) -> Done {
        let &[place, number, x, y, z, a, b, c, u, v, w, front_angle, back_angle, orientation] =
            numbers
        else {
            return Err(call.unreadable("arguments of a tool"));
        };
        let (place, tool) = (whole(call, place)?, whole(call, number)?);
        if place == 0 {
            return Ok(Mark::None);
        }
        let active = self.now.units.unwrap_or(LengthUnit::Millimetre);
        let factor = size(self.table.unit) / size(active);
        let mut offset = Position::from([x, y, z, a, b, c, u, v, w]);
        for axis in [Axis::X, Axis::Y, Axis::Z, Axis::U, Axis::V, Axis::W] {
            *offset.get_mut(axis) *= factor;
        }
        let known =
            self.table.tools.iter_mut().find(|known| i64::from(known.number) == i64::from(tool));
        let Some(known) = known else { return Err(call.unreadable("tool")) };
        match radius(&self.block) {
            None => {}
            Some(Some(radius)) => known.diameter = 2.0 * radius / factor,
            Some(None) => {
                let what = "a radius of a tool that is not written as a number";
                return Ok(Mark::Unsupported(what.to_owned()));
            }
        }
        let diameter = known.diameter * factor;
        let orientation = whole(call, orientation)?;
        self.effect(Effect::SetToolEntry {
            tool,
            offset,
            diameter,
            front_angle,
            back_angle,
            orientation,
        })
    }
}

/// Millimetres in a unit.
fn size(unit: LengthUnit) -> f64 {
    match unit {
        LengthUnit::Inch => INCH,
        LengthUnit::Millimetre => 1.0,
    }
}

/// R of a block: none, or a value that may be no number.
fn radius(block: &str) -> Option<Option<f64>> {
    let (_, value) = block.split_once('r')?;
    let end = value.find(|character: char| !"+-.0123456789".contains(character));
    let next = end.and_then(|end| value.get(end..)).and_then(|rest| rest.chars().next());
    let number = value.get(..end.unwrap_or(value.len())).and_then(|number| number.parse().ok());
    Some(number.filter(|_| !next.is_some_and(|next| "[#".contains(next))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_radius_is_a_number_of_the_block() {
        assert_eq!(radius("g10l1p1z1"), None);
        let close = |block: &str, wanted: f64| {
            let found = radius(block).flatten().unwrap();
            assert!((found - wanted).abs() < 1e-12, "{block}");
        };
        close("g10l1p1r0.5z1", 0.5);
        close("g10l1r-.25", -0.25);
        assert_eq!(radius("g10l1p1r#5"), Some(None));
        assert_eq!(radius("g10l1p1r[1/2]"), Some(None));
    }
}
