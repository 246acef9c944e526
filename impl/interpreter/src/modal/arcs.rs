//! Arcs and helices: G2 and G3 in centre and radius format (11.5.5).
//!
//! An arc lies in the selected plane, of which the axes are called first and second so that counterclockwise is from
//! the first to the second one: X Y, Z X, Y Z. Whatever else moves, moves along.

use gaugeblock_vocabulary::{Distance, Effect, FaultKind, Lathe, LengthUnit, Motion, Plane};

use crate::faults::{PlantedFault, planted};
use crate::math;
use crate::quirks;
use crate::words::Words;

use super::Modal;
use super::choices::ArcTolerance;
use super::coordinates::Coordinates;
use super::letters::{I, J, K, R, X, Y, Z};
use super::refusal::{Refusal, refuse};
use super::values::integer_in;

/// A point in the selected plane, or a distance in it: along the first and along the second axis.
#[derive(Clone, Copy, Debug)]
struct InPlane {
    first: f64,
    second: f64,
}

impl InPlane {
    fn minus(self, other: Self) -> Self {
        Self { first: self.first - other.first, second: self.second - other.second }
    }

    fn times(self, factor: f64) -> Self {
        Self { first: self.first * factor, second: self.second * factor }
    }

    fn divided(self, divisor: f64) -> Self {
        Self { first: self.first / divisor, second: self.second / divisor }
    }

    fn is_finite(self) -> bool {
        self.first.is_finite() && self.second.is_finite()
    }

    /// Its length. Only a length beyond the largest number is infinite, and only no length is zero.
    #[inline]
    fn length(self) -> f64 {
        let length = math::hypotenuse(self.first, self.second);
        if length > 0.0 && length < f64::INFINITY { length } else { self.extreme_length() }
    }

    /// The same where squares are too large or too small.
    #[cold]
    fn extreme_length(self) -> f64 {
        let longer = self.first.abs().max(self.second.abs());
        if longer > 0.0 && longer < f64::INFINITY {
            longer * math::hypotenuse(self.first / longer, self.second / longer)
        } else {
            longer
        }
    }
}

/// An arc along one of its axes.
struct Along {
    /// Letter of the offset along it, and its bit.
    offset: u8,
    offset_word: u32,
    /// The bit of the axis word.
    axis_word: u32,
    start: f64,
    end: f64,
}

/// The words of an arc in the selected plane.
struct ArcPlane {
    /// Letters of the offsets along the first and the second axis.
    offsets: [u8; 2],
    /// Their bits.
    offset_words: u32,
    /// The bits of its axis words.
    axis_words: u32,
    start: InPlane,
    end: InPlane,
}

/// The tolerances of an arc's words, in the active unit.
struct Tolerances {
    /// Radii that differ by more are never those of one arc (11.5.5.1).
    coarse: f64,
    /// Radii that differ by no more always are.
    fine: f64,
    /// The tolerance by which R may be too small for half a circle, because written numbers are rounded.
    radius: f64,
    /// Whether the larger radius counts instead of that of the start: quirk rs274.arc-radius-tolerance.
    of_larger: bool,
    /// The least radius of an arc: quirk rs274.arc-least-radius.
    least: f64,
}

impl Tolerances {
    /// The part of a radius by which two radii may differ.
    const RELATIVE: f64 = 0.001;

    fn of(units: LengthUnit) -> Self {
        match units {
            LengthUnit::Inch => {
                let fine = if planted(PlantedFault::FineLimitUnit) { 0.005 } else { 0.0005 };
                Self { coarse: 0.05, fine, radius: 0.000_05, of_larger: false, least: 0.0 }
            }
            LengthUnit::Millimetre => {
                Self { coarse: 0.5, fine: 0.005, radius: 0.001_27, of_larger: false, least: 0.0 }
            }
        }
    }

    /// The same by another option of `arcs.small-tolerance`.
    #[cold]
    fn chosen(self, option: ArcTolerance, units: LengthUnit) -> Self {
        match (option, units) {
            (ArcTolerance::Fine, LengthUnit::Inch) => Self { fine: 0.0001, ..self },
            (ArcTolerance::Fine, LengthUnit::Millimetre) => Self { fine: 0.001, ..self },
            (ArcTolerance::Millimetres, LengthUnit::Inch) => {
                Self { coarse: 0.5 / 25.4, fine: 0.005 / 25.4, ..self }
            }
            (ArcTolerance::TwoMicrometres, LengthUnit::Inch) => {
                Self { coarse: 0.0002, fine: 0.0002, ..self }
            }
            (ArcTolerance::TwoMicrometres, LengthUnit::Millimetre) => {
                Self { coarse: 0.002, fine: 0.002, ..self }
            }
            (ArcTolerance::Millimetres, LengthUnit::Millimetre) | (ArcTolerance::Coarse, _) => self,
        }
    }

    /// Whether the distances of both ends from the centre are radii of one arc: an error is "more than coarse, or
    /// more than fine and than a thousandth of the radius"; the radius is that of the start.
    fn agree(&self, start: f64, end: f64) -> bool {
        let difference = (start - end).abs();
        let radius = if self.of_larger { start.max(end) } else { start };
        (difference <= self.coarse || planted(PlantedFault::NoCoarseLimit))
            && (difference <= self.fine || difference <= Self::RELATIVE * radius)
    }
}

impl Modal {
    /// The arc from a point to where the point is now, as the words say.
    #[inline(always)]
    pub(super) fn arc(
        &self,
        words: &Words,
        motion: Motion,
        start: &Coordinates,
    ) -> Result<Effect, Refusal> {
        let plane = self.arc_plane(start)?;
        let counterclockwise = motion == Motion::ArcCounterclockwise;
        let tolerances = self.arc_tolerances();
        let centre = if words.present & R != 0 {
            let half_circle = self.choices.arc_half_circle;
            let slack = if half_circle { tolerances.radius } else { 0.0 };
            radius_centre(words, &plane, counterclockwise, (slack, self.emulates_rs274))?
        } else {
            self.offset_centre(words, &plane, &tolerances)?
        };
        let least = if self.choices.arc_turns_one { i32::MIN } else { 1 };
        let turns = words
            .get(b'P')
            .filter(|_| !planted(PlantedFault::OneTurn))
            .map(|p| if planted(PlantedFault::TurnsCut) { math::floor(p) } else { p })
            .map_or(Ok(1), |p| integer_in(p, least, i32::MAX, "P of an arc"))?
            .max(1);
        Ok(Effect::ArcFeed {
            end: self.position.position(),
            first_centre: centre.first,
            second_centre: centre.second,
            turns: if counterclockwise { turns } else { turns.wrapping_neg() },
        })
    }

    /// Refuses an arc whose ends have these distances from its centre, where they are not those of one arc.
    pub(super) fn check_radii(&self, start: f64, end: f64) -> Result<(), Refusal> {
        let tolerances = self.arc_tolerances();
        let none = start == 0.0 && !self.choices.arc_zero_radius;
        if none || start.min(end) < tolerances.least {
            return refuse(FaultKind::BadArc, "an arc without a radius");
        }
        if !tolerances.agree(start, end) && !planted(PlantedFault::AnyEnd) {
            return refuse(FaultKind::BadArc, "the radius to the end of the arc is another one");
        }
        Ok(())
    }

    #[inline(always)]
    fn arc_tolerances(&self) -> Tolerances {
        let mut tolerances = Tolerances::of(self.active.now().units);
        if self.choices.arc_tolerance != ArcTolerance::Coarse {
            tolerances = tolerances.chosen(self.choices.arc_tolerance, self.active.now().units);
        }
        if self.emulates_rs274 {
            tolerances.of_larger = true;
            tolerances.least = quirks::arc_least_radius(self.active.now().units);
            (tolerances.fine, tolerances.coarse) = quirks::arc_tolerances(self.active.now().units);
        }
        tolerances
    }

    /// The plane of the arc; UV, WU and VW do not support arcs (11.5.18).
    #[inline]
    fn arc_plane(&self, start: &Coordinates) -> Result<ArcPlane, Refusal> {
        let ([x, y, z, ..], [end_x, end_y, end_z, ..]) = (start.0, self.position.0);
        let x = Along { offset: b'I', offset_word: I, axis_word: X, start: x, end: end_x };
        let y = Along { offset: b'J', offset_word: J, axis_word: Y, start: y, end: end_y };
        let z = Along { offset: b'K', offset_word: K, axis_word: Z, start: z, end: end_z };
        let (first, second) = match self.active.now().plane {
            Plane::Xy => (x, y),
            Plane::Zx => (z, x),
            Plane::Yz => (y, z),
            Plane::Uv | Plane::Wu | Plane::Vw => {
                return refuse(FaultKind::ModalConflict, "an arc outside of XY, ZX and YZ");
            }
        };
        Ok(ArcPlane {
            offsets: [first.offset, second.offset],
            offset_words: first.offset_word | second.offset_word,
            axis_words: first.axis_word | second.axis_word,
            start: InPlane { first: first.start, second: second.start },
            end: InPlane { first: first.end, second: second.end },
        })
    }

    /// Whether one offset is enough under G90.1: a planted fault.
    fn takes_one_offset(&self) -> bool {
        planted(PlantedFault::OneAbsoluteOffset) && self.active.now().plane != Plane::Xy
    }

    /// Centre format (11.5.5.1). I is a radius in diameter mode too (2.6.6.2).
    #[inline]
    fn offset_centre(
        &self,
        words: &Words,
        plane: &ArcPlane,
        tolerances: &Tolerances,
    ) -> Result<InPlane, Refusal> {
        let given = words.present & (I | J | K);
        if given & !plane.offset_words != 0 && !planted(PlantedFault::ForeignOffset) {
            return refuse(FaultKind::UnusedWord, "an offset along the normal of the plane");
        }
        if given == 0 {
            return refuse(FaultKind::MissingWord, "an arc without offsets and without R");
        }
        let is_open = words.present & plane.axis_words != 0 || words.is_polar();
        if !is_open && self.choices.arc_needs_axis_word {
            return refuse(FaultKind::MissingWord, "an arc without an axis word of the plane");
        }
        if planted(PlantedFault::ArcReturnRefused)
            && words.present & plane.axis_words != 0
            && plane.end.minus(plane.start).length() <= 0.0
        {
            return refuse(FaultKind::BadArc, "an arc that ends where it begins");
        }
        let diameter =
            self.choices.arc_centre_diameter && self.active.now().lathe == Lathe::Diameter;
        let [first, second] = plane.offsets.map(|letter| {
            let offset = words.get(letter).unwrap_or(0.0);
            if diameter && letter == b'I' { offset / 2.0 } else { offset }
        });
        let centre = match self.active.now().arc_distance {
            Distance::Absolute if given != plane.offset_words && !self.takes_one_offset() => {
                return refuse(FaultKind::MissingWord, "G90.1 needs both offsets");
            }
            Distance::Absolute if !planted(PlantedFault::AbsoluteFromStart) => {
                InPlane { first, second }
            }
            Distance::Absolute | Distance::Incremental => {
                InPlane { first: plane.start.first + first, second: plane.start.second + second }
            }
        };
        let radius = plane.start.minus(centre).length();
        let to_end = plane.end.minus(centre).length();
        let none = radius == 0.0 && !self.choices.arc_zero_radius;
        if none || radius.min(to_end) < tolerances.least {
            return refuse(FaultKind::BadArc, "an arc without a radius");
        }
        if !tolerances.agree(radius, to_end) && !planted(PlantedFault::AnyEnd) {
            return refuse(FaultKind::BadArc, "the radius to the end of the arc is another one");
        }
        Ok(centre)
    }
}

/// Radius format (11.5.5.3): of the two centres the one that makes the arc less than half a circle, with a negative R
/// more.
fn radius_centre(
    words: &Words,
    plane: &ArcPlane,
    counterclockwise: bool,
    (slack, emulates_rs274): (f64, bool),
) -> Result<InPlane, Refusal> {
    if words.present & (I | J | K) != 0 {
        return refuse(FaultKind::UnusedWord, "offsets of an arc with R");
    }
    let asked = if planted(PlantedFault::RadiusNeedsXy) { X | Y } else { plane.axis_words };
    if words.present & asked == 0 && !words.is_polar() {
        return refuse(FaultKind::MissingWord, "R without an axis word of the plane");
    }
    let signed = words.get(b'R').unwrap_or(0.0);
    let format = RadiusFormat {
        radius: signed.abs(),
        // The centre of a counterclockwise arc below half a circle is on the left of the chord.
        left: counterclockwise == (signed > 0.0 || planted(PlantedFault::NegativeRadius)),
        slack,
        emulates_rs274,
    };
    format.centre(plane.start, plane.end)
}

/// The arc of a radius.
#[derive(Clone, Copy, Debug)]
struct RadiusFormat {
    radius: f64,
    /// Whether the centre is on the left of the chord.
    left: bool,
    /// The tolerance by which the radius may be too small.
    slack: f64,
    emulates_rs274: bool,
}

impl RadiusFormat {
    /// The centre of the arc between two points.
    #[inline]
    fn centre(&self, start: InPlane, end: InPlane) -> Result<InPlane, Refusal> {
        let chord = end.minus(start);
        let length = chord.length();
        if length == 0.0 && planted(PlantedFault::EqualPoints) {
            return Ok(InPlane { first: f64::NAN, second: f64::NAN });
        }
        if length == 0.0 {
            return refuse(FaultKind::BadArc, "an arc with R that ends where it begins");
        }
        let half = length / 2.0;
        // Not a number is no radius either.
        let reaches = half <= self.radius + self.slack || planted(PlantedFault::ShortRadius);
        if !(reaches && self.radius > 0.0) {
            return self.out_of_reach(start, end, length);
        }
        if self.emulates_rs274 {
            let (from, to) = ([start.first, start.second], [end.first, end.second]);
            let [first, second] = quirks::arc_centre(from, to, self.radius, self.left);
            return finite(InPlane { first, second });
        }
        let height = math::sqrt(((self.radius - half) * (self.radius + half)).max(0.0));
        let along = self.signed_height(height) / length;
        let centre = InPlane {
            first: start.first + chord.first / 2.0 - chord.second * along,
            second: start.second + chord.second / 2.0 + chord.first * along,
        };
        if centre.is_finite() { Ok(centre) } else { self.far_centre(start, chord, length) }
    }

    /// The signed distance of the centre from the chord, positive on its left.
    #[inline]
    fn signed_height(&self, height: f64) -> f64 {
        if self.left { height } else { -height }
    }

    /// The radius does not reach the end, or only seems not to because the chord is longer than the largest number. A
    /// quarter of every length decides it exactly.
    #[cold]
    fn out_of_reach(&self, start: InPlane, end: InPlane, length: f64) -> Result<InPlane, Refusal> {
        let (start, end) = (start.times(0.25), end.times(0.25));
        if length.is_finite() || !end.minus(start).length().is_finite() {
            return refuse(FaultKind::BadArc, "R is too small to reach the end");
        }
        let quarter = Self { radius: self.radius * 0.25, slack: self.slack * 0.25, ..*self };
        finite(quarter.centre(start, end)?.times(4.0))
    }

    /// The centre where the usual computation overflows.
    #[cold]
    fn far_centre(&self, start: InPlane, chord: InPlane, length: f64) -> Result<InPlane, Refusal> {
        let (radius, half) = (self.radius / 2.0, length / 4.0);
        let height = math::sqrt((radius - half).max(0.0)) * math::sqrt(radius + half) * 2.0;
        let (height, forward) = (self.signed_height(height), chord.divided(length));
        finite(InPlane {
            first: start.first + chord.first / 2.0 - forward.second * height,
            second: start.second + chord.second / 2.0 + forward.first * height,
        })
    }
}

/// The centre of an arc that has one.
fn finite(centre: InPlane) -> Result<InPlane, Refusal> {
    if centre.is_finite() {
        return Ok(centre);
    }
    refuse(FaultKind::BadArc, "the centre of the arc is farther away than the largest number")
}
