//! Where axis words lead to.

use gaugeblock_vocabulary::{Axis, Distance, FaultKind, Lathe, Position};

use super::compensation::programmed_point;
use super::word;
use crate::ids::{choice, rule};
use crate::math;
use crate::rs274::evaluate::Words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// The axis words of a block with their values.
fn axis_words(words: &Words) -> Vec<(Axis, f64)> {
    let letters = Axis::ALL.iter().copied();
    letters.filter_map(|axis| Some((axis, word(words, letter(axis))?))).collect()
}

/// The axis words of a block as values of an offset.
///
/// Rule units-planes.diameter-offsets. Whether diameter mode halves X there too is a choice: the documents speak of
/// moves.
pub(crate) fn offset_words(words: &Words, state: &mut State) -> Vec<(Axis, f64)> {
    let rule = rule::units_planes::DIAMETER_OFFSETS;
    if state.modes.lathe == Lathe::Diameter {
        state.coverage.accepted(rule);
        if state.choices.is(choice::units_planes::DiameterOffsets::EveryWord) {
            return moved(words, state);
        }
    }
    axis_words(words)
}

/// The letter of an axis.
pub(crate) fn letter(axis: Axis) -> char {
    match axis {
        Axis::X => 'x',
        Axis::Y => 'y',
        Axis::Z => 'z',
        Axis::A => 'a',
        Axis::B => 'b',
        Axis::C => 'c',
        Axis::U => 'u',
        Axis::V => 'v',
        Axis::W => 'w',
    }
}

/// The axis words as a move reads them.
///
/// Rule units-planes.diameter. In diameter mode an X word is a diameter, and X moves half of it; no other axis is
/// concerned (units-planes.diameter-x-only).
pub(super) fn moved(words: &Words, state: &State) -> Vec<(Axis, f64)> {
    let mut values = axis_words(words);
    if state.modes.lathe == Lathe::Diameter {
        for (axis, value) in &mut values {
            if *axis == Axis::X {
                *value /= 2.0;
            }
        }
    }
    values
}

/// The end point of a move in program coordinates, active length unit.
///
/// Rule motion.omitted-axes. An axis without a word keeps its value.
/// Rules units-planes.absolute and units-planes.incremental. A word is a position, or is added to the current one.
///
/// # Errors
/// Rules motion.polar-mixed and motion.polar-from-origin.
pub(crate) fn end_point(words: &Words, state: &mut State) -> Result<Position, StepError> {
    let mut end = polar(words, state)?.unwrap_or(programmed_point(state));
    let incremental = state.modes.distance == Distance::Incremental;
    state.coverage.accepted(if incremental {
        rule::units_planes::INCREMENTAL
    } else {
        rule::units_planes::ABSOLUTE
    });
    state.coverage.accepted(rule::motion::OMITTED_AXES);
    let lathe = state.modes.lathe;
    if lathe == Lathe::Diameter {
        state.coverage.accepted(rule::units_planes::DIAMETER_X_ONLY);
    }
    for (axis, value) in moved(words, state) {
        let named = state.dialect().named_coordinate(axis, value, words, state);
        let place = end.get_mut(axis);
        *place = if incremental { *place + value } else { named };
    }
    Ok(end)
}

/// The end point of a move in machine coordinates, as program coordinates.
///
/// Rule offsets.machine-coordinates. The words of G53 are machine coordinates, whatever offsets are active.
pub(crate) fn machine_end_point(words: &Words, state: &mut State) -> Position {
    let mut end = state.modes.machine_point(state.position);
    let moved = moved(words, state);
    for (axis, value) in &moved {
        *end.get_mut(*axis) = state.dialect().reached(*axis, *value, state);
    }
    let mut there = state.modes.program_point(end);
    // An axis that does not move stays where it is to the last bit; in a rotated system X and Y move together.
    let turned = |axis: Axis| state.modes.rotation != 0.0 && matches!(axis, Axis::X | Axis::Y);
    let moves = |axis: Axis| moved.iter().any(|(by, _)| *by == axis || turned(*by) && turned(axis));
    let stays = |axis: &Axis| !moves(*axis) && state.dialect().keeps_unmoved_axes(state);
    for axis in Axis::ALL.iter().copied().filter(stays) {
        *there.get_mut(axis) = state.position.get(axis);
    }
    there
}

/// The point that polar words name.
///
/// Rule motion.polar. @ is the distance from the XY origin, ^ the angle counterclockwise from the X axis.
/// Rule motion.polar-partial. A word that is left out keeps its value.
/// Rule motion.polar-incremental. In incremental mode both are added to those of the current point.
/// Rule motion.polar-mixed. A block with polar words has no X and Y.
pub(super) fn polar(words: &Words, state: &mut State) -> Result<Option<Position>, StepError> {
    let (distance, angle) = (word(words, '@'), word(words, '^'));
    if distance.is_none() && angle.is_none() {
        return Ok(None);
    }
    if word(words, 'x').is_some() || word(words, 'y').is_some() {
        let message = "polar words together with X or Y";
        return Err(refuse(rule::motion::POLAR_MIXED, FaultKind::AxisWords, message));
    }
    state.dialect().check_polar(words, state)?;
    let here = programmed_point(state);
    let incremental = state.modes.distance == Distance::Incremental;
    let from = if incremental { 1.0 } else { 0.0 };
    let current_distance = math::hypotenuse(here.x, here.y);
    let current_angle = math::degrees_of(here.y, here.x);
    let distance = distance.map_or(current_distance, |value| from * current_distance + value);
    let angle = angle.map_or(current_angle, |value| from * current_angle + value);
    state.coverage.accepted(rule::motion::POLAR);
    if incremental {
        state.coverage.accepted(rule::motion::POLAR_INCREMENTAL);
    }
    if word(words, '@').is_none() || word(words, '^').is_none() {
        state.coverage.accepted(rule::motion::POLAR_PARTIAL);
    }
    let (distance, angle) = state.modes.rounding.of_polar(distance, angle);
    let (sine, cosine) = math::sine_and_cosine_of_degrees(angle);
    let there = Position { x: distance * cosine, y: distance * sine, ..here };
    Ok(Some(state.modes.rounding.of(there, Position { x: distance, y: distance, ..here })))
}
