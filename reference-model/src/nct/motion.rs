//! G0 to G3: where a move ends, and round which centre.

use gaugeblock_vocabulary::{Axis, Distance, Effect, FaultKind, Motion, Plane, Position};

use super::modes::{Modes, within_reach};
use super::refusal::{StepError, open, refuse};
use super::words::{Words, word};
use crate::ids::rule;
use crate::math;

/// How far the radii of an arc may be apart, active length unit.
const RADIUS_TOLERANCE: f64 = 0.01;
/// How much longer than the radius half the chord may be, as a part of it: half a circle does not hang on the last
/// bit of its numbers.
const CHORD_TOLERANCE: f64 = 1e-9;

/// An axis by its letter.
pub(super) fn axis(letter: char) -> Option<Axis> {
    Axis::ALL
        .iter()
        .copied()
        .find(|axis| axis.word().eq_ignore_ascii_case(letter.encode_utf8(&mut [0; 4])))
}

/// The letters of a move besides those of axes: what an arc goes round.
pub(super) const OF_ARC: &str = "IJKR";

/// The move of a block with axis words, or of one that goes round a circle without.
///
/// Rule nct.motion. In absolute distance mode a word says where the axis goes, in incremental mode how far.
///
/// # Errors
/// There is no motion mode or feed, the machine lacks the axis, or the words give no arc.
pub(super) fn perform(
    modes: &mut Modes,
    words: &Words,
    axes: &[Axis],
) -> Result<Effect, StepError> {
    let mut end = modes.position;
    for (letter, value) in words {
        let Some(axis) = axis(*letter) else { continue };
        if !axes.contains(&axis) {
            let message = format!("the machine has no axis {letter}");
            return Err(refuse(rule::nct::MOTION, FaultKind::NoSuchAxis, message));
        }
        let coordinate = end.get_mut(axis);
        *coordinate = match modes.distance {
            Distance::Absolute => *value,
            Distance::Incremental => *coordinate + value,
        };
    }
    within_reach(&end)?;
    let is_feed = modes.motion != Motion::Traverse;
    if modes.motion == Motion::None {
        return Err(open("axis words before any of G0 to G3"));
    }
    if is_feed && modes.feed_rate.abs().to_bits() == 0 {
        return Err(open("a feed move without F"));
    }
    let effect = if is_arc(modes.motion) {
        arc(modes, end, words)?
    } else if is_feed {
        Effect::StraightFeed { end }
    } else {
        Effect::StraightTraverse { end }
    };
    modes.position = end;
    Ok(effect)
}

/// Whether a motion mode is that of an arc.
pub(super) fn is_arc(motion: Motion) -> bool {
    matches!(motion, Motion::ArcClockwise | Motion::ArcCounterclockwise)
}

/// The axes of the selected plane and the letters of its centre.
fn plane(plane: Plane) -> [(Axis, char); 2] {
    match plane {
        Plane::Zx | Plane::Wu => [(Axis::Z, 'K'), (Axis::X, 'I')],
        Plane::Yz | Plane::Vw => [(Axis::Y, 'J'), (Axis::Z, 'K')],
        Plane::Xy | Plane::Uv => [(Axis::X, 'I'), (Axis::Y, 'J')],
    }
}

/// Rule nct.arc. The centre counts from the start; R is the radius of the shorter arc, or, below zero, of the longer
/// one.
fn arc(modes: &Modes, end: Position, words: &Words) -> Result<Effect, StepError> {
    let rule = rule::nct::ARC;
    let [(first, of_first), (second, of_second)] = plane(modes.plane);
    if let Some((letter, _)) = words
        .iter()
        .find(|(letter, _)| "IJK".contains(*letter) && *letter != of_first && *letter != of_second)
    {
        let message = format!("{letter} is not an offset in the selected plane");
        return Err(refuse(rule, FaultKind::UnusedWord, message));
    }
    let from = (modes.position.get(first), modes.position.get(second));
    let to = (end.get(first), end.get(second));
    let offsets = (word(words, of_first), word(words, of_second));
    let (first_centre, second_centre) = match (word(words, 'R'), offsets) {
        (None, (None, None)) => {
            let message = "an arc without a centre or a radius";
            return Err(refuse(rule, FaultKind::MissingWord, message));
        }
        (Some(_), (Some(_), _) | (_, Some(_))) => {
            return Err(open("an arc with a centre and a radius"));
        }
        (None, (along, across)) => {
            of_offsets(from, to, (along.unwrap_or(0.0), across.unwrap_or(0.0)))?
        }
        (Some(radius), (None, None)) => {
            of_radius(from, to, radius, modes.motion == Motion::ArcClockwise)?
        }
    };
    let turns = if modes.motion == Motion::ArcClockwise { -1 } else { 1 };
    Ok(Effect::ArcFeed { end, first_centre, second_centre, turns })
}

/// The centre by its offsets from the start.
fn of_offsets(
    from: (f64, f64),
    to: (f64, f64),
    offsets: (f64, f64),
) -> Result<(f64, f64), StepError> {
    let centre = (from.0 + offsets.0, from.1 + offsets.1);
    let radius = |point: (f64, f64)| math::hypotenuse(point.0 - centre.0, point.1 - centre.1);
    let (at_start, at_end) = (radius(from), radius(to));
    // No point is at a finite distance from a centre that is not finite.
    if !at_start.is_finite() {
        return Err(bad_arc("a centre that is too far away"));
    }
    if (at_start - at_end).abs() > RADIUS_TOLERANCE {
        return Err(open("an arc whose ends are not equally far from its centre"));
    }
    Ok(centre)
}

/// The centre by the radius: beside the middle of the chord.
///
/// All is computed at a quarter of its size, so that no length on the way to a finite centre is too large for a
/// number; that rounds nothing but what is close to the smallest numbers.
fn of_radius(
    from: (f64, f64),
    to: (f64, f64),
    radius: f64,
    clockwise: bool,
) -> Result<(f64, f64), StepError> {
    let quarter = |point: (f64, f64)| (point.0 / 4.0, point.1 / 4.0);
    let (from, to) = (quarter(from), quarter(to));
    let (along, across) = (to.0 - from.0, to.1 - from.1);
    let chord = math::hypotenuse(along, across);
    if chord.to_bits() == 0 {
        return Err(open("an arc with a radius that ends where it begins"));
    }
    let too_small = || {
        bad_arc(format!(
            "radius {} is too small: the points are {} apart, at least {} is needed",
            radius.abs(),
            4.0 * chord,
            2.0 * chord
        ))
    };
    let beside = beside_chord(radius.abs() / 4.0, chord / 2.0).ok_or_else(too_small)?;
    // At the left when the shorter arc goes counterclockwise.
    let left = if clockwise == (radius < 0.0) { beside } else { -beside };
    let centre = (
        4.0 * (from.0 + along / 2.0 - left * (across / chord)),
        4.0 * (from.1 + across / 2.0 + left * (along / chord)),
    );
    if centre.0.is_finite() && centre.1.is_finite() {
        return Ok(centre);
    }
    Err(bad_arc("a centre that is too far away"))
}

/// How far the centre is from the middle of the chord; none where the radius is too small for it.
///
/// r² - d² in factors: a difference of squares would cancel, and a square overflow.
fn beside_chord(radius: f64, half: f64) -> Option<f64> {
    if half - radius > radius * CHORD_TOLERANCE {
        return None;
    }
    Some(math::square_root((radius - half).max(0.0)) * math::square_root(radius + half))
}

fn bad_arc(message: impl Into<String>) -> StepError {
    refuse(rule::nct::ARC, FaultKind::BadArc, message)
}
