//! Splines: G5, G5.1 and the data block of G5.2 and G5.3 (11.5.7 to 11.5.9). G codes are in tenths: 50 is G5, 52 is
//! G5.2.

use gaugeblock_vocabulary::{Effect, FaultKind, Motion, Plane};

use crate::canon::Sink;
use crate::faults::{PlantedFault, planted};
use crate::words::Words;

use super::Modal;
use super::cycles::{Curve, MotionSeries};
use super::letters::{AXES, I, J, X, Y};
use super::motion_codes::mode_of;
use super::refusal::{Refusal, refuse};
use super::values::integer;

impl Modal {
    /// G5 and G5.1: a curve to the end point. I, J, P and Q shape it and are not part of the effect.
    pub(super) fn spline<K: Sink>(
        &mut self,
        words: &Words,
        code: u16,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        self.refuse_under_compensation("a spline")?;
        self.check_spline(words)?;
        if code == 50 {
            self.check_cubic(words)?;
        } else {
            check_quadratic(words)?;
        }
        self.check_feed_move()?;
        self.motion = mode_of(code);
        self.series = MotionSeries::of_spline(code == 50);
        let end = self.end_point(words);
        let start = core::mem::replace(&mut self.position, end);
        let points = if code == 50 && !planted(PlantedFault::QuadraticOnly) { 4 } else { 3 };
        let effect = Effect::NurbsFeed { points, end: end.position() };
        self.perform_move(words.line, start, &effect, sink)
    }

    /// Refuses a plane other than XY, axis words other than X and Y, and cutter compensation.
    fn check_spline(&self, words: &Words) -> Result<(), Refusal> {
        if self.active.now().plane != Plane::Xy && !planted(PlantedFault::AnySplinePlane) {
            return refuse(FaultKind::ModalConflict, "a spline outside of the XY plane");
        }
        if words.present & AXES & !(X | Y) != 0 {
            return refuse(FaultKind::AxisWords, "a spline with an axis other than X and Y");
        }
        self.check_uncompensated_move()
    }

    /// Checks I and J of G5: both or neither, and both in the first G5 of a series.
    fn check_cubic(&self, words: &Words) -> Result<(), Refusal> {
        let given = words.present & (I | J);
        let contiguous =
            self.motion == Motion::CubicSpline || planted(PlantedFault::SeriesSurvives);
        let follows = contiguous && self.series.cubic;
        match given {
            0 if follows => Ok(()),
            0 => refuse(FaultKind::MissingWord, "the first G5 of a series without I and J"),
            _ if given == I | J => Ok(()),
            _ if follows && planted(PlantedFault::HalfOffsetInSeries) => Ok(()),
            _ => refuse(FaultKind::MissingWord, "just one of I and J"),
        }
    }

    /// Executes G5.2 and the blocks after it: G5.2 opens the data block, axis words add a control point.
    pub(super) fn add_control_point(&mut self, words: &Words) -> Result<(), Refusal> {
        self.check_spline(words)?;
        let open = self.series.curve.filter(|_| self.motion == Motion::Nurbs);
        if self.choices.nurbs_feed_at_opening {
            self.check_feed_move()?;
        }
        let mut curve = open.unwrap_or(Curve { points: 1, order: 3, last: self.position });
        if let Some(order) = words.get(b'L') {
            curve.order = integer(order, "L")?;
            if curve.order < 1 {
                return refuse(FaultKind::WordOutOfRange, "L is not positive");
            }
        }
        if words.has_axes() {
            let replaces = open.is_none() && planted(PlantedFault::OpeningPointReplaces);
            curve.points = curve.points.saturating_add(u32::from(!replaces));
            curve.last = self.point_from(curve.last, words);
        } else if words.has(b'P') && curve.points > 1 {
            return refuse(FaultKind::MissingWord, "a weight without its control point");
        } else if words.has(b'P') && planted(PlantedFault::WeightCounts) {
            curve.points = 2;
        }
        self.motion = Motion::Nurbs;
        self.series = MotionSeries::of_curve(curve);
        Ok(())
    }

    /// Ends the run as unspecified at another motion code within a data block: its effect on the curve is not
    /// documented.
    pub(super) fn check_open_curve(&self, code: u16) -> Result<(), Refusal> {
        if self.series.curve.is_none() || matches!(code, 52 | 53) {
            return Ok(());
        }
        let why = "a motion code within the data block of G5.2 (11.5.9)";
        Err(Refusal::Unspecified(why.into()))
    }

    /// Executes G5.3: feeds along the curve. No motion mode is active afterwards.
    pub(super) fn close_curve<K: Sink>(&mut self, line: u32, sink: &mut K) -> Result<(), Refusal> {
        let open = self.series.curve.filter(|_| self.motion == Motion::Nurbs);
        let Some(curve) = open else {
            return Err(Refusal::Unspecified("G5.3 where no data block is open (11.5.9)".into()));
        };
        if i64::from(curve.points) < i64::from(curve.order) {
            let why = "a curve with fewer control points than its order (11.5.9)";
            return Err(Refusal::Unspecified(why.into()));
        }
        if !self.choices.nurbs_feed_at_opening {
            self.check_feed_move()?;
        }
        self.motion = Motion::None;
        self.series = MotionSeries::default();
        let start = core::mem::replace(&mut self.position, curve.last);
        let end = curve.last.position();
        self.perform_move(line, start, &Effect::NurbsFeed { points: curve.points, end }, sink)
    }
}

/// I and J of G5.1: one or both, and not both zero.
fn check_quadratic(words: &Words) -> Result<(), Refusal> {
    if words.present & (I | J) == 0 {
        return refuse(FaultKind::MissingWord, "G5.1 without I and without J");
    }
    let is_zero = |letter| words.get(letter).unwrap_or(0.0).abs() <= 0.0;
    if is_zero(b'I') && is_zero(b'J') && !planted(PlantedFault::ZeroOffsets) {
        return refuse(FaultKind::WordOutOfRange, "I and J of G5.1 are zero");
    }
    Ok(())
}
