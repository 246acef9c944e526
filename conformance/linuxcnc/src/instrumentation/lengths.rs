//! Settings that are lengths. The calls print them once, in the unit that is active then; the vocabulary has them in
//! the unit that is active now.

use gaugeblock_vocabulary::{Axis, FeedMode, LengthUnit, Position, Settings};

/// Millimetres in an inch.
const INCH: f64 = 25.4;

/// By how much a number with four decimals may be off, with room for those of the parameter.
const ROUNDING: f64 = 5.1e-5;

/// Lengths as they were printed, each with its unit.
#[derive(Clone, Debug)]
pub(crate) struct Lengths {
    unit: LengthUnit,
    feed: Option<(f64, LengthUnit)>,
    blend: Option<(f64, LengthUnit)>,
    naive_cam: Option<(f64, LengthUnit)>,
    g5x: Option<(Position, LengthUnit)>,
    g92: Option<(Position, LengthUnit)>,
    tool: Option<(Position, LengthUnit)>,
}

impl Default for Lengths {
    fn default() -> Self {
        Self {
            unit: LengthUnit::Millimetre,
            feed: None,
            blend: None,
            naive_cam: None,
            g5x: None,
            g92: None,
            tool: None,
        }
    }
}

impl Lengths {
    /// Another unit: every length, in that unit.
    pub(crate) fn use_unit(&mut self, unit: LengthUnit) -> Settings {
        self.unit = unit;
        Settings {
            feed_rate: self.feed.map(|length| self.number(length)),
            blend_tolerance: self.blend.map(|length| self.number(length)),
            naive_cam_tolerance: self.naive_cam.map(|length| self.number(length)),
            g5x_offset: self.g5x.map(|length| self.position(length)),
            g92_offset: self.g92.map(|length| self.position(length)),
            tool_offset: self.tool.map(|length| self.position(length)),
            ..Settings::default()
        }
    }

    /// F was set. Under inverse time it is not a length.
    pub(crate) fn feed(&mut self, rate: f64, mode: Option<FeedMode>) -> Settings {
        let is_length = mode != Some(FeedMode::InverseTime);
        self.feed = is_length.then_some((rate, self.unit));
        Settings { feed_rate: Some(rate), ..Settings::default() }
    }

    /// F as a parameter reports it, with more decimals than the call has. If they differ by more than those, the
    /// parameter means something else.
    pub(crate) fn precise_feed(&mut self, precise: f64) {
        if let Some((rate, unit)) = &mut self.feed
            && *unit == self.unit
            && (*rate - precise).abs() <= ROUNDING
        {
            *rate = precise;
        }
    }

    /// Inverse time was set: the number of F stays, and is no longer a length.
    pub(crate) fn feed_is_no_length(&mut self) {
        self.feed = None;
    }

    /// P of G64 was set.
    pub(crate) fn blend(&mut self, tolerance: f64) -> Settings {
        self.blend = Some((tolerance, self.unit));
        Settings { blend_tolerance: Some(tolerance), ..Settings::default() }
    }

    /// Q of G64 was set.
    pub(crate) fn naive_cam(&mut self, tolerance: f64) -> Settings {
        self.naive_cam = Some((tolerance, self.unit));
        Settings { naive_cam_tolerance: Some(tolerance), ..Settings::default() }
    }

    /// The offset of the work coordinate system was set.
    pub(crate) fn g5x(&mut self, offset: Position) -> Settings {
        self.g5x = Some((offset, self.unit));
        Settings { g5x_offset: Some(offset), ..Settings::default() }
    }

    /// The offset of G92 was set.
    pub(crate) fn g92(&mut self, offset: Position) -> Settings {
        self.g92 = Some((offset, self.unit));
        Settings { g92_offset: Some(offset), ..Settings::default() }
    }

    /// The tool offset was set.
    pub(crate) fn tool(&mut self, offset: Position) -> Settings {
        self.tool = Some((offset, self.unit));
        Settings { tool_offset: Some(offset), ..Settings::default() }
    }

    fn number(&self, (length, unit): (f64, LengthUnit)) -> f64 {
        match (unit, self.unit) {
            (LengthUnit::Inch, LengthUnit::Millimetre) => length * INCH,
            (LengthUnit::Millimetre, LengthUnit::Inch) => length / INCH,
            (LengthUnit::Inch, LengthUnit::Inch)
            | (LengthUnit::Millimetre, LengthUnit::Millimetre) => length,
        }
    }

    fn position(&self, (mut position, unit): (Position, LengthUnit)) -> Position {
        for axis in [Axis::X, Axis::Y, Axis::Z, Axis::U, Axis::V, Axis::W] {
            let length = position.get_mut(axis);
            *length = self.number((*length, unit));
        }
        position
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_follow_the_unit_and_come_back() {
        let mut lengths = Lengths::default();
        lengths.g5x(Position { x: 25.4, a: 90.0, ..Position::default() });
        lengths.feed(254.0, Some(FeedMode::PerMinute));
        let inch = lengths.use_unit(LengthUnit::Inch);
        let offset = inch.g5x_offset.unwrap();
        assert_eq!([offset.x, offset.a].map(f64::to_bits), [1.0, 90.0].map(f64::to_bits));
        assert_eq!(inch.feed_rate.map(f64::to_bits), Some(10.0_f64.to_bits()));
        let back = lengths.use_unit(LengthUnit::Millimetre);
        assert_eq!(back.g5x_offset.unwrap().x.to_bits(), 25.4_f64.to_bits());
    }

    #[test]
    fn inverse_time_is_not_a_length() {
        let mut lengths = Lengths::default();
        lengths.feed(30.0, Some(FeedMode::InverseTime));
        assert_eq!(lengths.use_unit(LengthUnit::Inch).feed_rate, None);
    }
}
