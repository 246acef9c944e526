//! Selecting: planes, units, distance modes, feed modes, return modes, path control, diameter mode.

use gaugeblock_vocabulary::{
    Distance, Effect, FaultKind, FeedMode, Lathe, LengthUnit, PathControlMode, Plane, ReturnMode,
};

use crate::faults::{PlantedFault, planted};
use crate::words::Words;

use super::Modal;
use super::coordinates::{Conversion, Coordinates};
use super::feed_length::feed_length;
use super::refusal::{Refusal, refuse};
use super::values::not_negative;

impl Modal {
    /// F.
    #[inline]
    pub(super) fn set_feed(&mut self, feed: f64) -> Result<(), Refusal> {
        let feed = checked_feed(feed)?;
        if planted(PlantedFault::FeedNeverChanges) && self.active.now().feed_rate > 0.0 {
            return Ok(());
        }
        self.active.set_feed_rate(feed);
        Ok(())
    }

    /// G93, G94, G95. After a switch a new feed rate must be given (11.5.59); selecting the mode in force is not a
    /// switch.
    pub(super) fn select_feed_mode(&mut self, code: u16) {
        let mode = match code {
            930 => FeedMode::InverseTime,
            940 => FeedMode::PerMinute,
            _ => FeedMode::PerRevolution,
        };
        if self.active.now().feed_mode != mode {
            let before = self.active.now().feed_mode;
            if (before, mode) == (FeedMode::PerMinute, FeedMode::InverseTime) {
                self.rate_of_move = self.active.now().feed_rate;
            }
            let of_move = self.choices.feed_of_last_move
                && (before, mode) == (FeedMode::InverseTime, FeedMode::PerMinute);
            let rate = if of_move { self.rate_of_move } else { 0.0 };
            let modes = self.active.set();
            modes.feed_mode = mode;
            // A switch to G94 or G95 requires a new rate, one to G93 requires a rate in each block (11.5.59).
            if mode != FeedMode::InverseTime && !planted(PlantedFault::FeedKeptOverMode) {
                modes.feed_rate = rate;
            }
        }
    }

    /// Notes the feed rate per minute of a feed move under inverse time.
    pub(super) fn note_rate(&mut self, start: Coordinates, effect: &Effect) {
        let now = self.active.now();
        if now.feed_mode == FeedMode::InverseTime
            && let Some(length) = feed_length(start, effect, now.plane)
        {
            self.rate_of_move = length * now.feed_rate;
        }
    }

    /// G17 to G19.1. Whether G17, G18 and G19 may choose another plane while the cutter is compensated is a choice.
    pub(super) fn select_plane(&mut self, code: u16) -> Result<(), Refusal> {
        let plane = match code {
            170 => Plane::Xy,
            180 => Plane::Zx,
            190 if planted(PlantedFault::WrongPlane) => Plane::Zx,
            190 => Plane::Yz,
            171 => Plane::Uv,
            181 => Plane::Wu,
            _ => Plane::Vw,
        };
        let changes = self.active.now().plane != plane && matches!(code, 170 | 180 | 190);
        if changes && self.choices.plane_uncompensated {
            self.refuse_under_compensation("another plane")?;
        }
        self.active.put(|modes| &mut modes.plane, plane);
        Ok(())
    }

    /// G20, G21.
    pub(super) fn select_units(&mut self, code: u16) -> Result<(), Refusal> {
        if self.choices.units_uncompensated {
            self.refuse_under_compensation("a length unit")?;
        }
        self.change_units(unit_of(code));
        Ok(())
    }

    /// Converts every length to another unit.
    pub(super) fn change_units(&mut self, units: LengthUnit) {
        let conversion = Conversion::between(self.active.now().units, units);
        if self.active.now().units == units {
            return;
        }
        if !planted(PlantedFault::PositionKept) {
            self.position = self.position.converted(conversion);
        }
        self.series.convert(conversion);
        self.cutter = self.cutter.converted(conversion);
        self.compensation.convert(conversion);
        let keep_feed = self.choices.feed_number_kept || planted(PlantedFault::FeedNumber);
        if !keep_feed {
            self.rate_of_move = conversion.of(self.rate_of_move);
        }
        let keep_tool_offset = self.emulates_rs274;
        let modes = self.active.set();
        modes.units = units;
        if !keep_tool_offset {
            modes.tool_offset = modes.tool_offset.converted(conversion);
        }
        modes.g5x_offset = modes.g5x_offset.converted(conversion);
        modes.g92_offset = modes.g92_offset.converted(conversion);
        modes.blend_tolerance = conversion.of(modes.blend_tolerance);
        modes.naive_cam_tolerance = conversion.of(modes.naive_cam_tolerance);
        // Under inverse time F is no length.
        if modes.feed_mode != FeedMode::InverseTime && !keep_feed {
            modes.feed_rate = conversion.of(modes.feed_rate);
        }
    }

    /// G7, G8.
    pub(super) fn select_lathe_mode(&mut self, code: u16) {
        let lathe = if code == 70 { Lathe::Diameter } else { Lathe::Radius };
        self.active.put(|modes| &mut modes.lathe, lathe);
    }

    /// G90, G91.
    pub(super) fn select_distance(&mut self, code: u16) {
        let distance = if code == 900 { Distance::Absolute } else { Distance::Incremental };
        self.active.put(|modes| &mut modes.distance, distance);
        if code == 910 && planted(PlantedFault::IncrementsResetOffsets) {
            self.active.put(|modes| &mut modes.arc_distance, distance);
        }
    }

    /// G90.1, G91.1.
    pub(super) fn select_arc_distance(&mut self, code: u16) {
        let distance = if code == 901 { Distance::Absolute } else { Distance::Incremental };
        self.active.put(|modes| &mut modes.arc_distance, distance);
    }

    /// G98, G99.
    pub(super) fn select_retract(&mut self, code: u16) -> Result<(), Refusal> {
        if self.emulates_rs274 {
            self.refuse_under_compensation("a return mode is selected")?;
        }
        let retract = if code == 980 { ReturnMode::OldZ } else { ReturnMode::RPlane };
        self.active.put(|modes| &mut modes.retract, retract);
        Ok(())
    }

    /// G61, G61.1, G64. Q needs P, and is P where it is not given (11.5.37).
    pub(super) fn path(&mut self, words: &Words, code: u16) -> Result<(), Refusal> {
        if self.emulates_rs274 {
            self.refuse_under_compensation("a path control mode is selected")?;
        }
        if code != 640 {
            let path =
                if code == 610 { PathControlMode::ExactPath } else { PathControlMode::ExactStop };
            self.active.put(|modes| &mut modes.path, path);
            return Ok(());
        }
        let alone = words.get(b'P').is_none() && words.get(b'Q').is_some();
        if alone && !self.emulates_rs274 {
            return refuse(FaultKind::MissingWord, "Q of G64 without P");
        }
        let now = self.active.now();
        let again = now.path == PathControlMode::Continuous && now.blend_tolerance > 0.0;
        if again && words.get(b'P').is_some() && planted(PlantedFault::ToleranceOnce) {
            return Ok(());
        }
        let (blend, naive) = match (self.tolerance(words, b'P')?, self.tolerance(words, b'Q')?) {
            (None, None) if planted(PlantedFault::ToleranceKept) => {
                let now = self.active.now();
                (now.blend_tolerance, now.naive_cam_tolerance)
            }
            (None, naive) => (0.0, naive.unwrap_or(0.0)),
            (Some(blend), None) if planted(PlantedFault::NoNaiveTolerance) => (blend, 0.0),
            (Some(blend), Some(naive)) if naive <= 0.0 && planted(PlantedFault::ZeroQIsP) => {
                (blend, blend)
            }
            (Some(blend), naive) => (blend, naive.unwrap_or(blend)),
        };
        let modes = self.active.set();
        modes.path = PathControlMode::Continuous;
        modes.blend_tolerance = blend;
        modes.naive_cam_tolerance = naive;
        Ok(())
    }

    /// A tolerance of G64. What one below zero means, 11.5.37 does not say.
    fn tolerance(&self, words: &Words, letter: u8) -> Result<Option<f64>, Refusal> {
        match words.get(letter) {
            Some(value) if value < 0.0 && self.choices.negative_tolerance_none => Ok(None),
            Some(value) => not_negative(value, "a tolerance of G64").map(Some),
            None => Ok(None),
        }
    }
}

/// The length unit that G20 or G21 selects.
pub(super) const fn unit_of(code: u16) -> LengthUnit {
    if code == 200 { LengthUnit::Inch } else { LengthUnit::Millimetre }
}

/// The value of an F word.
#[inline]
pub(super) fn checked_feed(feed: f64) -> Result<f64, Refusal> {
    if feed < 0.0 && !planted(PlantedFault::NegativeFeed) {
        return refuse(FaultKind::WordOutOfRange, "F is negative");
    }
    Ok(feed)
}
