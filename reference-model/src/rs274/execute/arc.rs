//! G2 and G3: arcs and helices.
//!
//! A block gives a centre and an end point, or a radius and an end point. Both formats define a circle in the selected
//! plane and a number of turns.

use gaugeblock_vocabulary::{
    Axis, Distance, Effect, FaultKind, Lathe, LengthUnit, Motion, Position,
};

use super::compensation::{self, programmed_point};
use super::feed::record_rate;
use super::plane_axes::{Axes, axes};
use super::target::{end_point, letter};
use super::{whole, word};
use crate::ids::{choice, rule};
use crate::math;
use crate::rs274::evaluate::Words;
use crate::rs274::modes::unit_size;
pub(crate) use crate::rs274::planar::InPlane;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// Moves along an arc.
///
/// Rule arcs.direction. G2 goes clockwise and G3 counterclockwise, seen from the positive end of the normal
/// axis. Rule arcs.helix. The normal axis moves to its own word at the same time, and so do rotary axes
/// (arcs.rotary-axes).
///
/// # Errors
/// An arc that its words do not describe.
pub(super) fn perform(
    motion: Motion,
    words: &Words,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    let axes = axes(state)?;
    let turns = turns(words, state)?;
    one_format(axes, words)?;
    let end = end_point(words, state)?;
    let clockwise = motion == Motion::ArcClockwise;
    let centre = match word(words, 'r') {
        Some(radius) => centre_of_radius(axes, radius, clockwise, end, words, state)?,
        None => centre_of_offsets(axes, end, words, state)?,
    };
    let turns = if clockwise { -turns } else { turns };
    cut(motion, axes, end, (centre, turns), state, record)
}

/// Moves along an arc whose end and centre are found already, less than a full turn.
///
/// # Errors
/// Rules arcs.unequal-radii and arcs.zero-radius.
pub(super) fn about(
    centre: InPlane,
    motion: Motion,
    end: Position,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    let axes = axes(state)?;
    let start = axes.in_plane(programmed_point(state));
    same_radius(start, centre, axes.in_plane(end), state)?;
    let turns = if motion == Motion::ArcClockwise { -1 } else { 1 };
    cut(motion, axes, end, (centre, turns), state, record)
}

/// Moves along an arc that is checked.
fn cut(
    motion: Motion,
    axes: Axes,
    end: Position,
    (centre, turns): (InPlane, i32),
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    let start = programmed_point(state);
    check_after_compensation(state)?;
    report_accepted(axes, start, end, state);
    if compensation::applies(state) {
        return compensation::arc(motion, end, axes, (centre, turns), state, record);
    }
    record_rate(helix_length(axes, (start, end), centre, turns), state);
    state.modes.motion = motion;
    let is_skipped = state.dialect().skips_arc(distance(centre, axes.in_plane(start)), state);
    state.position = end;
    if !is_skipped {
        let (first_centre, second_centre) = centre;
        record.effect(state, Effect::ArcFeed { end, first_centre, second_centre, turns });
    }
    Ok(())
}

/// The length of an arc or helix; an arc that ends where it starts is a full circle. Turns are signed.
fn helix_length(axes: Axes, ends: (Position, Position), centre: InPlane, turns: i32) -> f64 {
    let (start, end) = (axes.in_plane(ends.0), axes.in_plane(ends.1));
    let angle = |point: InPlane| math::angle(point.1 - centre.1, point.0 - centre.0);
    let sense = f64::from(turns.signum());
    let swept = (angle(end) - angle(start)) * sense;
    let swept = if swept > 0.0 { swept } else { swept + std::f64::consts::TAU };
    let whole = f64::from(turns.abs() - 1) * std::f64::consts::TAU;
    let along = ends.1.get(axes.normal) - ends.0.get(axes.normal);
    math::hypotenuse(distance(centre, start) * (swept + whole), along)
}

/// Rule compensation.exit-arc. The next move after compensation is not an arc, not even a compensated one.
fn check_after_compensation(state: &State) -> Result<(), StepError> {
    if state.contour.exit.is_some() {
        let message = "an arc as first move after compensation";
        return Err(refuse(rule::compensation::EXIT_ARC, FaultKind::ModalConflict, message));
    }
    Ok(())
}

/// The number of turns, 1 for up to a full circle.
///
/// Rule arcs.turns. P is the number of turns, including a partial one; without P it is 1.
/// Rule arcs.turns-integer. P must be an integer.
/// Rule arcs.turns-below-one. Whether P below 1 is refused or counts as 1 is a choice.
fn turns(words: &Words, state: &mut State) -> Result<i32, StepError> {
    let Some(number) = word(words, 'p') else { return Ok(1) };
    let rule = rule::arcs::TURNS_INTEGER;
    let message = || format!("P{number} is not a number of turns");
    let turns = whole(number).ok_or_else(|| refuse(rule, FaultKind::NotAnInteger, message()))?;
    if turns < 1 {
        let rule = rule::arcs::TURNS_BELOW_ONE;
        if state.choices.is(choice::arcs::TurnsBelowOne::Refused) {
            return Err(refuse(rule, FaultKind::WordOutOfRange, message()));
        }
        state.coverage.accepted(rule);
        return Ok(1);
    }
    state.coverage.accepted(rule::arcs::TURNS);
    Ok(turns)
}

/// The letter of the offset of the centre along an axis.
fn offset_letter(axis: Axis) -> char {
    match axis {
        Axis::Y => 'j',
        Axis::Z => 'k',
        Axis::X | Axis::A | Axis::B | Axis::C | Axis::U | Axis::V | Axis::W => 'i',
    }
}

/// Rule arcs.one-format. An arc has a centre or a radius, not both.
/// Rule arcs.other-offset. The normal axis has no offset.
fn one_format(axes: Axes, words: &Words) -> Result<(), StepError> {
    let offsets = "ijk".chars().any(|offset| word(words, offset).is_some());
    if offsets && word(words, 'r').is_some() {
        let message = "an arc with an offset of its centre and a radius";
        return Err(refuse(rule::arcs::ONE_FORMAT, FaultKind::BadArc, message));
    }
    let other = offset_letter(axes.normal);
    if word(words, other).is_some() {
        let message = format!("{} is not an offset in the selected plane", other.to_uppercase());
        return Err(refuse(rule::arcs::OTHER_OFFSET, FaultKind::BadArc, message));
    }
    Ok(())
}

/// The centre in program coordinates, from its offsets.
///
/// Rule arcs.centre. An offset is measured from the start of the arc; an omitted offset is zero.
/// Rule arcs.centre-absolute. In absolute arc distance mode it is measured from the zero of its axis.
/// Rule arcs.full-circle. An arc without axis words, or that ends at its start, is a full circle.
/// Rule arcs.diameter-centre. Whether I is a diameter in diameter mode is a choice.
///
/// # Errors
/// Rules arcs.needs-offsets, arcs.without-axis-words, arcs.absolute-needs-both, arcs.unequal-radii, arcs.zero-radius.
fn centre_of_offsets(
    axes: Axes,
    end: Position,
    words: &Words,
    state: &mut State,
) -> Result<InPlane, StepError> {
    let mut offset = |axis: Axis| {
        let offset = word(words, offset_letter(axis))?;
        let diameter = axis == Axis::X && state.modes.lathe == Lathe::Diameter;
        if diameter {
            state.coverage.accepted(rule::arcs::DIAMETER_CENTRE);
        }
        let is_halved = diameter && state.choices.is(choice::arcs::DiameterCentre::Diameter);
        Some(if is_halved { offset / 2.0 } else { offset })
    };
    let offsets = (offset(axes.first), offset(axes.second));
    if let (None, None) = offsets {
        let message = "an arc without a radius or an offset of its centre";
        return Err(refuse(rule::arcs::NEEDS_OFFSETS, FaultKind::MissingWord, message));
    }
    check_axis_words(axes, words, state)?;
    let start = axes.in_plane(programmed_point(state));
    let centre = if state.modes.arc_distance == Distance::Absolute {
        let (Some(first), Some(second)) = offsets else {
            let message = "in absolute arc distance mode both offsets of the centre are needed";
            let rule = rule::arcs::ABSOLUTE_NEEDS_BOTH;
            return Err(refuse(rule, FaultKind::MissingWord, message));
        };
        state.coverage.accepted(rule::arcs::CENTRE_ABSOLUTE);
        (first, second)
    } else {
        state.coverage.accepted(rule::arcs::CENTRE);
        (start.0 + offsets.0.unwrap_or(0.0), start.1 + offsets.1.unwrap_or(0.0))
    };
    same_radius(start, centre, axes.in_plane(end), state)?;
    Ok(centre)
}

/// Rule arcs.without-axis-words. Whether offsets of a centre without a word of an axis of the plane are refused is a
/// choice. A word of the normal axis alone does not count.
fn check_axis_words(axes: Axes, words: &Words, state: &mut State) -> Result<(), StepError> {
    if names_axis(axes, words) || names_polar(words) {
        return Ok(());
    }
    let rule = rule::arcs::WITHOUT_AXIS_WORDS;
    if state.choices.is(choice::arcs::WithoutAxisWords::Refused) {
        let message =
            "an arc with offsets of its centre needs a word of an axis of the selected plane";
        return Err(refuse(rule, FaultKind::MissingWord, message));
    }
    state.coverage.accepted(rule);
    Ok(())
}

/// The distance between two points of the plane.
fn distance(from: InPlane, to: InPlane) -> f64 {
    math::hypotenuse(to.0 - from.0, to.1 - from.1)
}

/// Operations on arcs that a dialect can replace.
pub(crate) trait ArcRules {
    /// Rule arcs.radius-same-point. Whether an arc with a radius ends where it starts, in the plane of `axes`.
    fn ends_where_it_starts(
        &self,
        start: Position,
        end: Position,
        axes: Axes,
        _state: &State,
    ) -> bool {
        axes.in_plane(start) == axes.in_plane(end)
    }

    /// Rule arcs.radius. Whether the machine skips an arc of this radius.
    fn skips_arc(&self, _radius: f64, _state: &mut State) -> bool {
        false
    }

    /// The tolerances for the difference between the radius at the start and the radius at the end, active length unit.
    /// The first one applies to every arc, the second one if the difference is more than a thousandth of the radius.
    ///
    /// Choice arcs.small-tolerance: LinuxCNC's manual has two numbers for the second one; Grbl has both tolerances in
    /// millimetres, whatever the unit. Rule arcs.equal-radii. NIST has one tolerance, whatever the radius.
    fn radius_tolerances(&self, state: &State) -> (f64, f64) {
        use choice::arcs::SmallTolerance::{Coarse, Fine, Millimetres, TwoMicrometres};
        let units = state.modes.units;
        match (state.choices.get(), units) {
            (Coarse, LengthUnit::Inch) => (0.05, 0.000_5),
            (Fine, LengthUnit::Inch) => (0.05, 0.000_1),
            (Coarse, LengthUnit::Millimetre) => (0.5, 0.005),
            (Fine, LengthUnit::Millimetre) => (0.5, 0.001),
            (Millimetres, _) => (0.5 / unit_size(units), 0.005 / unit_size(units)),
            (TwoMicrometres, LengthUnit::Inch) => (0.000_2, 0.000_2),
            (TwoMicrometres, LengthUnit::Millimetre) => (0.002, 0.002),
        }
    }

    /// Rule arcs.zero-radius. Whether an arc whose centre is its start is accepted is a choice. `to_start` and `to_end`
    /// are the radii at the start and at the end.
    fn check_radius(
        &self,
        to_start: f64,
        _to_end: f64,
        state: &mut State,
    ) -> Result<(), StepError> {
        if to_start == 0.0 {
            let rule = rule::arcs::ZERO_RADIUS;
            if state.choices.is(choice::arcs::ZeroRadius::Refused) {
                return Err(refuse(rule, FaultKind::BadArc, "an arc without a radius"));
            }
            state.coverage.accepted(rule);
        }
        Ok(())
    }

    /// Rule arcs.radius-needs-axis. Whether a word of an arc with a radius names an axis of the selected plane; polar
    /// words do.
    fn names_axis_of_plane(&self, axes: Axes, words: &Words, _state: &State) -> bool {
        names_axis(axes, words) || names_polar(words)
    }

    /// The centre of an arc with a radius, from its start and half of its chord.
    ///
    /// Rule arcs.radius. The circle has this radius and goes through both points.
    /// Rule arcs.radius-sign. A positive radius is that of the shorter arc, a negative one of the longer.
    fn centre_from_radius(
        &self,
        start: InPlane,
        chord: (f64, InPlane),
        radius: f64,
        clockwise: bool,
        state: &mut State,
    ) -> Result<InPlane, StepError> {
        let (half, _) = chord;
        if half > radius.abs() {
            short_radius(radius, half, state)?;
        }
        let centre = centre_from_chord(start, chord, radius, clockwise);
        check_finite(centre, radius)?;
        state.coverage.accepted(rule::arcs::RADIUS);
        state.coverage.accepted(rule::arcs::RADIUS_SIGN);
        Ok(centre)
    }
}

/// Whether a word names an axis of the plane.
pub(crate) fn names_axis(axes: Axes, words: &Words) -> bool {
    [axes.first, axes.second].iter().any(|axis| word(words, letter(*axis)).is_some())
}

/// Whether there is a polar word, which names a point of the plane.
fn names_polar(words: &Words) -> bool {
    ['@', '^'].iter().any(|polar| word(words, *polar).is_some())
}

/// Rule arcs.radius-too-small. A radius of less than half the chord is refused.
/// Rule arcs.radius-just-too-small. Whether it is refused if it is too small by no more than the rounding tolerance is
/// a choice. A radius of zero is always refused: rounding does not make a radius zero.
fn short_radius(radius: f64, half: f64, state: &mut State) -> Result<(), StepError> {
    let rule = rule::arcs::RADIUS_JUST_TOO_SMALL;
    let just = radius != 0.0 && half - radius.abs() <= rounding_tolerance(state);
    if just && state.choices.is(choice::arcs::RadiusJustTooSmall::HalfCircle) {
        state.coverage.accepted(rule);
        return Ok(());
    }
    if just {
        state.coverage.refused(rule);
    }
    let message = format!(
        "radius {} is too small: the points are {} apart, at least {half} is needed",
        radius.abs(),
        2.0 * half
    );
    Err(refuse(rule::arcs::RADIUS_TOO_SMALL, FaultKind::BadArc, message))
}

/// The rounding tolerance of written numbers, active length unit: 0.00005 inch, half of the fourth decimal, and the
/// same length in millimetres.
pub(crate) fn rounding_tolerance(state: &State) -> f64 {
    match state.modes.units {
        LengthUnit::Inch => 0.000_05,
        LengthUnit::Millimetre => 0.001_27,
    }
}

/// Rule arcs.unequal-radii. Refuses a centre or radius that is not a finite number: it has no equal distance from the
/// ends of the arc.
fn check_finite(centre: InPlane, radius: f64) -> Result<(), StepError> {
    if [centre.0, centre.1, radius].into_iter().all(f64::is_finite) {
        return Ok(());
    }
    let message = "an arc whose centre or radius is beyond all numbers";
    Err(refuse(rule::arcs::UNEQUAL_RADII, FaultKind::BadArc, message))
}

/// Rule arcs.unequal-radii. The distances of the centre from the start and from the end are equal, within a tolerance.
/// Choice arcs.small-tolerance: Grbl's thousandth is of the radius at the start.
fn same_radius(
    start: InPlane,
    centre: InPlane,
    end: InPlane,
    state: &mut State,
) -> Result<(), StepError> {
    let (to_start, to_end) = (distance(centre, start), distance(centre, end));
    check_finite(centre, to_start.max(to_end))?;
    let (large, small) = state.dialect().radius_tolerances(state);
    let apart = (to_start - to_end).abs();
    let by_start = state.choices.is(choice::arcs::SmallTolerance::Millimetres);
    let radius = if by_start { to_start } else { to_start.max(to_end) };
    let is_one_bound = state.choices.is(choice::arcs::SmallTolerance::TwoMicrometres);
    let rule = if is_one_bound { rule::arcs::EQUAL_RADII } else { rule::arcs::UNEQUAL_RADII };
    if apart > large || apart > small && apart > 0.001 * radius {
        let message = format!("the radius is {to_start} at the start and {to_end} at the end");
        return Err(refuse(rule, FaultKind::BadArc, message));
    }
    state.coverage.accepted(rule);
    state.dialect().check_radius(to_start, to_end, state)
}

/// The centre of an arc with a radius, in program coordinates.
///
/// # Errors
/// Rules arcs.radius-needs-axis, arcs.radius-same-point, arcs.radius-too-small.
fn centre_of_radius(
    axes: Axes,
    radius: f64,
    clockwise: bool,
    end: Position,
    words: &Words,
    state: &mut State,
) -> Result<InPlane, StepError> {
    if !state.dialect().names_axis_of_plane(axes, words, state) {
        let message = "an arc with a radius needs a word of an axis of the selected plane";
        return Err(refuse(rule::arcs::RADIUS_NEEDS_AXIS, FaultKind::MissingWord, message));
    }
    state.coverage.accepted(rule::arcs::RADIUS_NEEDS_AXIS);
    let start = programmed_point(state);
    let ends = state.dialect().ends_where_it_starts(start, end, axes, state);
    let (start, end) = (axes.in_plane(start), axes.in_plane(end));
    if ends {
        let message = "an arc with a radius that ends where it starts";
        return Err(refuse(rule::arcs::RADIUS_SAME_POINT, FaultKind::BadArc, message));
    }
    state.dialect().centre_from_radius(start, half_chord(start, end), radius, clockwise, state)
}

/// The centre of the arc with a radius from a start to another point.
///
/// # Errors
/// Rule arcs.radius-too-small.
pub(super) fn centre_through(
    start: InPlane,
    end: InPlane,
    radius: f64,
    clockwise: bool,
    state: &mut State,
) -> Result<InPlane, StepError> {
    state.dialect().centre_from_radius(start, half_chord(start, end), radius, clockwise, state)
}

/// Half of the chord from a start to an end: its length and its components. The whole chord can be too long for a
/// number.
fn half_chord(start: InPlane, end: InPlane) -> (f64, InPlane) {
    let half = (end.0 / 2.0 - start.0 / 2.0, end.1 / 2.0 - start.1 / 2.0);
    (math::hypotenuse(half.0, half.1), half)
}

/// The centre, from half of the chord and the radius. It is on the perpendicular through the middle of the chord, on
/// the left if the shorter arc goes counterclockwise.
fn centre_from_chord(
    start: InPlane,
    (half, (along, across)): (f64, InPlane),
    radius: f64,
    clockwise: bool,
) -> InPlane {
    let distance = math::other_leg(radius.abs(), half);
    let to_left = if clockwise == (radius < 0.0) { distance } else { -distance };
    let scaled = |component: f64| math::portion(to_left, component, half);
    (start.0 + along - scaled(across), start.1 + across + scaled(along))
}

/// Reports the rules that an accepted arc covers.
fn report_accepted(axes: Axes, start: Position, end: Position, state: &mut State) {
    let mut rules = vec![
        rule::arcs::DIRECTION,
        rule::arcs::PLANE,
        rule::arcs::NEEDS_FEED_RATE,
        rule::feed::MODE_HOLDS,
        rule::offsets::SELECT_HOLDS,
        rule::path_control::MODE_HOLDS,
        rule::units_planes::MOTION_IN_ACTIVE_UNIT,
    ];
    if axes.in_plane(start) == axes.in_plane(end) {
        rules.push(rule::arcs::FULL_CIRCLE);
    }
    let moves = |axis: &Axis| start.get(*axis).to_bits() != end.get(*axis).to_bits();
    if moves(&axes.normal) {
        rules.push(rule::arcs::HELIX);
    }
    if [Axis::A, Axis::B, Axis::C].iter().any(moves) {
        rules.push(rule::arcs::ROTARY_AXES);
        rules.push(rule::motion::ROTARY_AXES);
    }
    if state.modes.lathe == Lathe::Diameter {
        rules.push(rule::arcs::DIAMETER);
    }
    rules.into_iter().for_each(|rule| state.coverage.accepted(rule));
}
