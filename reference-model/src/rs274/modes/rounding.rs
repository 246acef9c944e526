//! The last bits of positions that are computed.

use gaugeblock_vocabulary::Position;

use super::units::each;

/// What becomes of the last bits of a coordinate that a conversion of units, an offset or a polar word has computed.
///
/// The documents do not say how exactly a controller computes, so that nothing can be said of a program whose meaning
/// depends on it: there the model's own answer changes with this.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rounding {
    /// They stay.
    #[default]
    AsComputed,
    /// The coordinate is the number of few decimals that it misses by its last bits, if it misses one.
    ToDecimals,
    /// It is larger by its last bit.
    Up,
    /// It is smaller by its last bit.
    Down,
}

impl Rounding {
    /// A position that was computed from another one; a coordinate that is as it was has no bits to lose.
    pub(crate) fn of(self, computed: Position, from: Position) -> Position {
        if self == Self::AsComputed {
            return computed;
        }
        each(computed, from, |computed, from| {
            if (computed - from).abs() > 0.0 { self.coordinate(computed, from) } else { computed }
        })
    }

    /// The distance and the angle of a polar point, of which either may have been computed from another point: each
    /// time they are moved on by more than the rounding error of a point, so that two points that may be one become
    /// different.
    pub(crate) fn of_polar(self, distance: f64, angle: f64) -> (f64, f64) {
        let part = match self {
            Self::AsComputed | Self::ToDecimals => return (distance, angle),
            Self::Up => 4.0 * f64::EPSILON,
            Self::Down => -4.0 * f64::EPSILON,
        };
        (distance + distance * part, angle + 360.0 * part)
    }

    /// By how much of a length, or of a radian, a bound is moved at which the last bits of what is computed decide.
    pub(crate) fn margin(self) -> f64 {
        match self {
            Self::AsComputed | Self::ToDecimals => 0.0,
            Self::Up => 1e-12,
            Self::Down => -1e-12,
        }
    }

    /// A coordinate that is 0, or some very small number.
    pub(crate) fn of_nothing(self) -> f64 {
        match self {
            Self::AsComputed | Self::ToDecimals => 0.0,
            Self::Up => 1e-300,
            Self::Down => -1e-300,
        }
    }

    fn coordinate(self, computed: f64, from: f64) -> f64 {
        let last_bit = computed.abs().max(from.abs()) * f64::EPSILON;
        match self {
            Self::AsComputed => computed,
            Self::ToDecimals => {
                let decimals = (computed * 1e6).round() / 1e6;
                if (decimals - computed).abs() < 64.0 * last_bit { decimals } else { computed }
            }
            Self::Up => computed + last_bit,
            Self::Down => computed - last_bit,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_was_computed_is_rounded() {
        let from = Position { x: 3.0, y: 2.0, z: 1.0, ..Position::default() };
        let computed = Position { x: 3.0, y: 0.1 + 0.2, z: 1.0 / 3.0, ..Position::default() };
        let moved = |rounding: Rounding| {
            let apart = each(rounding.of(computed, from), computed, |a, b| (a - b).abs());
            [apart.x, apart.y, apart.z].map(|distance| distance > 0.0)
        };
        assert_eq!(moved(Rounding::AsComputed), [false; 3]);
        assert_eq!(moved(Rounding::ToDecimals), [false, true, false]);
        assert_eq!(moved(Rounding::Up), [false, true, true]);
        assert_eq!(moved(Rounding::Down), [false, true, true]);
    }
}
