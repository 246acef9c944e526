//! G5, G5.1, and the blocks between G5.2 and G5.3: splines in the XY plane. G codes are in tenths: 52 is G5.2.

use gaugeblock_vocabulary::{Compensation, Distance, Effect, FaultKind, FeedMode, Motion, Plane};

use super::target::end_point;
use super::{whole, word};
use crate::ids::{choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::order::has_axis_words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::{Nurbs, State};
use crate::rs274::task::Record;

/// Control points of G5, start and end among them.
const CUBIC: u32 = 4;

/// Control points of G5.1.
const QUADRATIC: u32 = 3;

/// The order of a NURBS without L.
const DEFAULT_ORDER: u32 = 3;

/// Moves along a cubic or quadratic spline.
///
/// Rule splines.cubic. I and J lead from the start to the first control point, P and Q from the end to the second one.
/// Rule splines.cubic-continued. Without I and J a G5 begins in the direction in which the last one ended.
/// Rule splines.quadratic. I and J of G5.1 lead from the start to the control point; an omitted one is zero.
///
/// # Errors
/// Rules splines.plane, splines.xy-only, splines.cubic-end-direction, splines.cubic-half-direction,
/// splines.cubic-first-direction, splines.quadratic-offset.
pub(super) fn perform(
    motion: Motion,
    in_data_block: bool,
    words: &Words,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    in_xy(words, state)?;
    if motion == Motion::CubicSpline {
        cubic(words, state)?;
    } else {
        quadratic(words, state)?;
    }
    if state.modes.compensation != Compensation::Off {
        let message = "a spline while cutter compensation is on";
        let rule = rule::tool::COMPENSATION;
        return Err(refuse(rule, FaultKind::CompensationActive, message));
    }
    if !has_axis_words(words) {
        return Err(StepError::Unspecified("a spline without X and Y".to_owned()));
    }
    if in_data_block {
        return Err(StepError::Unspecified("another spline in an open data block".to_owned()));
    }
    super::feed::check_feed_rate(words, state)?;
    let end = end_point(words, state)?;
    state.dialect().set_spline_mode(motion, state);
    state.curve.continues = motion == Motion::CubicSpline;
    state.position = end;
    let points = if motion == Motion::CubicSpline { CUBIC } else { QUADRATIC };
    record.effect(state, Effect::NurbsFeed { points, end });
    Ok(())
}

/// Rule splines.plane. Splines are in the XY plane. Rule splines.xy-only. They move no other axis.
fn in_xy(words: &Words, state: &mut State) -> Result<(), StepError> {
    if state.modes.plane != Plane::Xy {
        let message = "a spline in another plane than XY";
        return Err(refuse(rule::splines::PLANE, FaultKind::ModalConflict, message));
    }
    if let Some(other) = "zabcuvw".chars().find(|axis| word(words, *axis).is_some()) {
        let message = format!("a spline with {}", other.to_ascii_uppercase());
        return Err(refuse(rule::splines::XY_ONLY, FaultKind::AxisWords, message));
    }
    state.coverage.accepted(rule::splines::PLANE);
    state.coverage.accepted(rule::splines::XY_ONLY);
    Ok(())
}

/// Rule splines.cubic-end-direction. Each G5 needs P and Q. Rule splines.cubic-half-direction. It has I and J, or
/// neither. Rule splines.cubic-first-direction. The first one of a row needs them.
fn cubic(words: &Words, state: &mut State) -> Result<(), StepError> {
    let has = |letter| word(words, letter).is_some();
    if !has('p') || !has('q') {
        let message = "G5 needs P and Q";
        return Err(refuse(rule::splines::CUBIC_END_DIRECTION, FaultKind::MissingWord, message));
    }
    if has('i') != has('j') {
        let message = "G5 with only one of I and J";
        return Err(refuse(rule::splines::CUBIC_HALF_DIRECTION, FaultKind::MissingWord, message));
    }
    if !has('i') && state.dialect().needs_first_direction(state) {
        let message = "the first G5 needs I and J";
        return Err(refuse(rule::splines::CUBIC_FIRST_DIRECTION, FaultKind::MissingWord, message));
    }
    state.coverage.accepted(rule::splines::CUBIC);
    if !has('i') {
        state.coverage.accepted(rule::splines::CUBIC_CONTINUED);
    }
    Ok(())
}

/// The rules of splines that a controller may follow differently.
pub(crate) trait SplineRules {
    /// Rule motion.mode-change. G5 and G5.1 are motion modes.
    fn set_spline_mode(&self, motion: Motion, state: &mut State) {
        state.modes.motion = motion;
    }

    /// Rule splines.cubic-first-direction. Whether this G5 needs I and J: the first one of a row does.
    fn needs_first_direction(&self, state: &State) -> bool {
        !state.curve.continues
    }

    /// Rule splines.quadratic-offset. One of I and J of G5.1 is not zero.
    fn check_quadratic_offset(&self, words: &Words, _state: &State) -> Result<(), StepError> {
        let offset = |letter| word(words, letter).unwrap_or(0.0);
        if offset('i') == 0.0 && offset('j') == 0.0 {
            let message = "G5.1 without an offset to its control point";
            return Err(refuse(rule::splines::QUADRATIC_OFFSET, FaultKind::MissingWord, message));
        }
        Ok(())
    }

    /// Rule splines.nurbs-default-weight. The weight of a control point is P, and 1 without it.
    fn control_point_weight(&self, words: &Words, _state: &State) -> Result<f64, StepError> {
        Ok(word(words, 'p').unwrap_or(1.0))
    }

    /// A NURBS has at least as many control points as its order says.
    fn check_control_points(
        &self,
        points: u32,
        order: u32,
        _state: &State,
    ) -> Result<(), StepError> {
        if points < order {
            let what = "a NURBS of fewer control points than its order";
            return Err(StepError::Unspecified(what.to_owned()));
        }
        Ok(())
    }
}

/// Rule splines.quadratic-offset. One of I and J of G5.1 is not zero.
/// Rule splines.quadratic-one-offset. The other one may be left out, and is zero then.
fn quadratic(words: &Words, state: &mut State) -> Result<(), StepError> {
    state.dialect().check_quadratic_offset(words, state)?;
    state.coverage.accepted(rule::splines::QUADRATIC);
    state.coverage.accepted(rule::splines::QUADRATIC_OFFSET);
    if word(words, 'i').is_none() || word(words, 'j').is_none() {
        state.coverage.accepted(rule::splines::QUADRATIC_ONE_OFFSET);
    }
    Ok(())
}

/// G5.2, the blocks after it, and G5.3.
///
/// Rule splines.nurbs. G5.2 opens a data block; each X and Y is a control point, and G5.3 executes the curve through
/// all of them, the current point first. Choice splines.nurbs-feed: where a missing feed rate is refused. Rule
/// splines.nurbs-first-weight. G5.2 without X and Y names no point.
pub(super) fn nurbs(
    words: &Words,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    let closes = words.g_tenths.contains(&53);
    let opens = words.g_tenths.contains(&52);
    let unspecified = |what: &str| StepError::Unspecified(what.to_owned());
    if state.modes.plane != Plane::Xy || state.modes.distance == Distance::Incremental {
        return Err(unspecified("a NURBS in another plane than XY, or in increments"));
    }
    let is_open = state.curve.open.is_some();
    if opens && is_open {
        return Err(unspecified("a G5.2 in an open data block"));
    }
    if closes && !is_open {
        return Err(unspecified("a G5.3 without an open data block"));
    }
    if closes && has_axis_words(words) {
        return Err(unspecified("a G5.3 with a point"));
    }
    if state.modes.feed_mode == FeedMode::InverseTime {
        return Err(unspecified("which block of a NURBS has the F of inverse time"));
    }
    let at_opening = state.choices.is(choice::splines::NurbsFeed::AtOpening);
    if at_opening != closes {
        super::feed::check_feed_rate(words, state)?;
    }
    let mut nurbs = match state.curve.open.take() {
        Some(nurbs) => nurbs,
        None => Nurbs { points: Vec::new(), order: DEFAULT_ORDER },
    };
    if closes {
        return close(&nurbs, state, record);
    }
    if let Some(order) = word(words, 'l') {
        nurbs.order = whole(order)
            .and_then(|order| u32::try_from(order).ok())
            .filter(|order| *order > 1)
            .ok_or_else(|| unspecified("a NURBS of an order below two"))?;
    }
    if state.dialect().control_point_weight(words, state)? <= 0.0 {
        return Err(unspecified("a control point whose weight is not positive"));
    }
    if has_axis_words(words) {
        if word(words, 'x').is_none() || word(words, 'y').is_none() {
            return Err(unspecified("a control point without X or without Y"));
        }
        if "zabcuvw".chars().any(|axis| word(words, axis).is_some()) {
            return Err(unspecified("another axis in a NURBS"));
        }
        nurbs.points.push(end_point(words, state)?);
    } else {
        state.coverage.accepted(rule::splines::NURBS_FIRST_WEIGHT);
    }
    if word(words, 'p').is_none() {
        state.coverage.accepted(rule::splines::NURBS_DEFAULT_WEIGHT);
    }
    state.modes.motion = Motion::Nurbs;
    state.curve.open = Some(nurbs);
    Ok(())
}

/// Executes the curve. It ends the motion mode, and a row of G5 before it.
fn close(nurbs: &Nurbs, state: &mut State, record: &mut Record) -> Result<(), StepError> {
    let points = u32::try_from(nurbs.points.len() + 1).unwrap_or(u32::MAX);
    state.dialect().check_control_points(points, nurbs.order, state)?;
    let end = *nurbs.points.last().expect("splines: a NURBS of order two has a second point");
    state.modes.motion = Motion::None;
    state.curve.continues = false;
    state.position = end;
    record.effect(state, Effect::NurbsFeed { points, end });
    state.coverage.accepted(rule::splines::NURBS);
    if nurbs.order == DEFAULT_ORDER {
        state.coverage.accepted(rule::splines::NURBS_DEFAULT_ORDER);
    }
    Ok(())
}
