//! Arcs: G2 and G3 round a centre, or with a radius.

use gaugeblock_vocabulary::{Effect, FaultKind, Motion, Plane};

use super::execute::Letters;
use super::program::{Stop, refuse};
use super::run::Runner;
use crate::math;
use crate::modal::Coordinates;

/// By how much the distances of both ends from the centre may differ.
const TOLERANCE: f64 = 0.01;

/// By which part of it a radius may be shorter than half the way between the ends: half a circle does not hang on the
/// last bit.
const CHORD_TOLERANCE: f64 = 1e-9;

/// A point in the selected plane: along the first and the second axis.
type InPlane = (f64, f64);

impl Runner {
    /// The arc from a point to where the point is now.
    pub(super) fn arc(&self, letters: &Letters, start: Coordinates) -> Result<Effect, Stop> {
        let ([x, y, z, ..], [to_x, to_y, to_z, ..]) = (start.0, self.position.0);
        let (from, to, offsets, third) = match self.modes.plane {
            Plane::Zx => ((z, x), (to_z, to_x), [b'K', b'I'], b'J'),
            Plane::Yz => ((y, z), (to_y, to_z), [b'J', b'K'], b'I'),
            Plane::Xy | Plane::Uv | Plane::Wu | Plane::Vw => {
                ((x, y), (to_x, to_y), [b'I', b'J'], b'K')
            }
        };
        if letters.get(third).is_some() {
            return refuse(FaultKind::UnusedWord, "an offset along the third axis");
        }
        let counterclockwise = self.motion == Motion::ArcCounterclockwise;
        let has_centre = letters.has(Letters::bits(&offsets));
        let (first_centre, second_centre) = match letters.get(b'R') {
            Some(_) if has_centre => return Err(Stop::Open("an arc with centre and radius")),
            Some(radius) => round_radius(from, to, radius, counterclockwise)?,
            None if has_centre => {
                let [first, second] = offsets.map(|letter| letters.get(letter).unwrap_or(0.0));
                round_centre(from, to, (from.0 + first, from.1 + second))?
            }
            None => return refuse(FaultKind::MissingWord, "an arc without centre and radius"),
        };
        if !(first_centre.is_finite() && second_centre.is_finite()) {
            return refuse(FaultKind::BadArc, "a centre that is too far away");
        }
        let turns = if counterclockwise { 1 } else { -1 };
        Ok(Effect::ArcFeed { end: self.position.position(), first_centre, second_centre, turns })
    }
}

fn distance(one: InPlane, other: InPlane) -> f64 {
    math::hypotenuse_of_any_size(one.0 - other.0, one.1 - other.1)
}

fn round_centre(from: InPlane, to: InPlane, centre: InPlane) -> Result<InPlane, Stop> {
    let radius = distance(from, centre);
    if !radius.is_finite() {
        return refuse(FaultKind::BadArc, "a radius that is too large");
    }
    let difference = (radius - distance(to, centre)).abs();
    // Not a number is no difference that may be.
    if difference <= TOLERANCE {
        return Ok(centre);
    }
    Err(Stop::Open("an arc with ends that are not equally far from the centre"))
}

/// The centre of the shorter arc, or of the longer one with a radius below zero.
fn round_radius(
    from: InPlane,
    to: InPlane,
    signed: f64,
    counterclockwise: bool,
) -> Result<InPlane, Stop> {
    // At a quarter of the size nothing on the way is too large where the centre is not.
    let quarter = |(first, second): InPlane| (first / 4.0, second / 4.0);
    let (from, to, radius) = (quarter(from), quarter(to), signed.abs() / 4.0);
    let (across, along) = (to.0 - from.0, to.1 - from.1);
    let chord = math::hypotenuse_of_any_size(across, along);
    if chord <= 0.0 {
        return Err(Stop::Open("an arc with a radius back to its start"));
    }
    let half = chord / 2.0;
    if half - radius > radius * CHORD_TOLERANCE {
        return refuse(FaultKind::BadArc, "a radius that is too small for the ends");
    }
    let height = math::other_leg(radius.max(half), half);
    // The centre of the shorter counterclockwise arc is on the left of the chord.
    let left = if counterclockwise == (signed > 0.0) { height } else { -height };
    let first = f64::midpoint(from.0, to.0) - along / chord * left;
    let second = f64::midpoint(from.1, to.1) + across / chord * left;
    Ok((first * 4.0, second * 4.0))
}
