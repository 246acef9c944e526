//! The profile of a lathe cycle: which blocks of its subroutine are moves, and where they lead.

use gaugeblock_vocabulary::{Distance, FaultKind, Motion, Position};

use super::cycle::radial;
use crate::ids::{choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::execute::programmed_motion::is_arc;
use crate::rs274::execute::{arc, word};
use crate::rs274::modes::{ModalGroup, g_code, motion_mode};
use crate::rs274::order::has_axis_words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::turning::{Corner, Curve, Move, Piece, Point, is_tied};

/// A profile that is being read, block by block. The state has the motion mode in force in the subroutine, and the
/// distance modes, the unit and the lathe mode that were in force before the cycle.
#[derive(Clone, Debug)]
pub(crate) struct Reading {
    moves: Vec<Move>,
    /// Where the next move starts.
    here: Point,
}

impl Reading {
    /// Nothing has been read; the first move starts where the cycle does. A line is in force.
    pub(crate) fn begin(start: Position, state: &mut State) -> Self {
        state.modes.motion = Motion::Feed;
        Self { moves: Vec::new(), here: Point { w: start.z, u: start.x } }
    }

    /// The moves that were read.
    pub(crate) fn into_moves(self) -> Vec<Move> {
        self.moves
    }

    /// A block of the subroutine.
    ///
    /// Rule turning.profile-moves. A block with an axis word of the plane is a move if G0 to G3 is in force; G0 counts
    /// as G1. Rule turning.profile-ignored. All else in it is ignored.
    ///
    /// # Errors
    /// A move that its words do not describe. What is open.
    pub(crate) fn block(&mut self, words: &Words, state: &mut State) -> Result<(), StepError> {
        state.dialect().check_profile_block(words, state)?;
        let codes = || words.g_tenths.iter().filter_map(|code| g_code(*code));
        let mut motions = codes().filter(|code| code.group == Some(ModalGroup::Motion));
        let motion = motions.next();
        if motions.next().is_some() {
            let message = "two motion codes in a block of a profile";
            let rule = rule::modal_groups::MOTION_GROUP;
            return Err(refuse(rule, FaultKind::ModalConflict, message));
        }
        if let Some(mode) = motion.and_then(|code| motion_mode(code.number)) {
            state.modes.motion = mode;
        }
        let by_other =
            codes().any(|code| code.axis_words && code.group != Some(ModalGroup::Motion));
        let is_ignored = by_other && !state.dialect().moves_by_other_codes(state)
            || motion.is_some_and(|code| !matches!(code.number, 0 | 10 | 20 | 30));
        if is_ignored || !codes().all(|code| matches!(code.number, 0 | 10 | 20 | 30)) {
            state.coverage.accepted(rule::turning::PROFILE_IGNORED);
        }
        if is_ignored || !has_axis_words(words) {
            return Ok(());
        }
        check_open(words, state)?;
        if "xzuw".chars().any(|letter| word(words, letter).is_some()) {
            self.add(words, state)?;
        }
        Ok(())
    }

    /// Adds the move of a block. One of no length is dropped.
    fn add(&mut self, words: &Words, state: &mut State) -> Result<(), StepError> {
        let start = self.here;
        let end = end_of(start, words, state)?;
        let corner = corner(words)?;
        let curve = curve(start, end, words, state)?;
        self.here = end;
        state.dialect().profile_reaches(end, state);
        if start != end {
            self.moves.push(Move { piece: Piece { start, end, curve }, corner });
        }
        Ok(())
    }
}

/// What is open of a block with axis words.
fn check_open(words: &Words, state: &State) -> Result<(), StepError> {
    let is_move = matches!(
        state.modes.motion,
        Motion::Traverse | Motion::Feed | Motion::ArcClockwise | Motion::ArcCounterclockwise
    );
    let why = if !is_move {
        "axis words of a profile after another motion code than G0 to G3"
    } else if ['@', '^'].iter().any(|polar| word(words, *polar).is_some()) {
        "polar words in a profile"
    } else {
        return Ok(());
    };
    Err(StepError::Unspecified(why.to_owned()))
}

/// Where a move ends.
///
/// Rule turning.profile-displacements. In absolute distance mode U and W are displacements along X and Z; they exclude
/// X and Z. In incremental distance mode X and Z are displacements themselves, and U and W are refused.
fn end_of(start: Point, words: &Words, state: &mut State) -> Result<Point, StepError> {
    let is_incremental = state.modes.distance == Distance::Incremental;
    let rule = rule::turning::PROFILE_DISPLACEMENTS;
    let coordinate = |from: f64, [position, displacement]: [char; 2], state: &mut State| {
        let size = |value| if position == 'x' { radial(value, state) } else { value };
        match (word(words, position).map(size), word(words, displacement).map(size)) {
            (None, None) => Ok(from),
            (Some(value), None) => Ok(if is_incremental { from + value } else { value }),
            (None, Some(value)) if !is_incremental => {
                state.coverage.accepted(rule);
                Ok(from + value)
            }
            (_, Some(_)) => {
                let message = "a displacement U or W together with X or Z, or in increments";
                Err(refuse(rule, FaultKind::AxisWords, message))
            }
        }
    };
    let w = coordinate(start.w, ['z', 'w'], state)?;
    let u = coordinate(start.u, ['x', 'u'], state)?;
    Ok(Point { w, u })
}

/// What a block inserts at the end of its move.
///
/// Rules turning.profile-fillet and turning.profile-chamfer. A is the radius of a fillet, and C that of one whose chord
/// is inserted. Both together are refused.
fn corner(words: &Words) -> Result<Option<Corner>, StepError> {
    match (word(words, 'a'), word(words, 'c')) {
        (Some(_), Some(_)) => {
            let message = "a fillet and a chamfer at one corner";
            Err(refuse(rule::turning::PROFILE_CHAMFER, FaultKind::AxisWords, message))
        }
        (Some(radius), None) => Ok(Some(Corner::Fillet(radius))),
        (None, radius) => Ok(radius.map(Corner::Chamfer)),
    }
}

/// The form of a move, by the motion mode in force. The sign of R has no effect. A radius that does not reach the end
/// is refused when the arc is cut, not when it is read.
fn curve(start: Point, end: Point, words: &Words, state: &mut State) -> Result<Curve, StepError> {
    if !is_arc(state.modes.motion) {
        return Ok(Curve::Line);
    }
    let sense = if state.modes.motion == Motion::ArcClockwise { -1.0 } else { 1.0 };
    if word(words, 'p').is_some() {
        return Err(StepError::Unspecified("turns of an arc of a profile".to_owned()));
    }
    let centre = match (word(words, 'r'), offsets(words, state)) {
        (None, (None, None)) => {
            let message = "an arc of a profile without a radius or an offset of its centre";
            return Err(refuse(rule::arcs::NEEDS_OFFSETS, FaultKind::MissingWord, message));
        }
        (Some(_), (Some(_), _) | (_, Some(_))) => {
            let message = "an arc with an offset of its centre and a radius";
            return Err(refuse(rule::arcs::ONE_FORMAT, FaultKind::BadArc, message));
        }
        (Some(_), _) if start == end => start,
        (Some(radius), _) => {
            let half = start.distance(end) / 2.0;
            if is_just_short(radius.abs(), half, state) {
                let why = "an arc of a profile whose radius is just too small".to_owned();
                return Err(StepError::Unspecified(why));
            }
            if radius.abs() < half {
                return Ok(Curve::NoCircle);
            }
            let (from, to) = ((start.w, start.u), (end.w, end.u));
            let (w, u) = arc::centre_through(from, to, radius.abs(), sense < 0.0, state)?;
            Point { w, u }
        }
        (None, (along_x, along_z)) => centre(start, along_x, along_z, state)?,
    };
    Ok(Curve::Arc { centre, sense })
}

/// Whether rounding, of numbers as they are written or as they are computed, decides if a radius reaches half of a
/// chord.
fn is_just_short(radius: f64, half: f64, state: &State) -> bool {
    is_tied(radius, half) || radius < half && half - radius <= arc::rounding_tolerance(state)
}

/// I and K of an arc: the offsets of its centre along X and Z.
fn offsets(words: &Words, state: &State) -> (Option<f64>, Option<f64>) {
    let is_diameter = state.choices.is(choice::arcs::DiameterCentre::Diameter);
    let along_x =
        word(words, 'i').map(|offset| if is_diameter { radial(offset, state) } else { offset });
    (along_x, word(words, 'k'))
}

/// The centre of an arc from its offsets. Rule arcs.centre-absolute. In absolute arc distance mode both are needed.
fn centre(
    start: Point,
    along_x: Option<f64>,
    along_z: Option<f64>,
    state: &State,
) -> Result<Point, StepError> {
    if state.modes.arc_distance == Distance::Incremental {
        return Ok(Point {
            w: start.w + along_z.unwrap_or(0.0),
            u: start.u + along_x.unwrap_or(0.0),
        });
    }
    let (Some(u), Some(w)) = (along_x, along_z) else {
        let why = "an arc of a profile in absolute arc distance mode with one offset";
        return Err(StepError::Unspecified(why.to_owned()));
    };
    Ok(Point { w, u })
}
