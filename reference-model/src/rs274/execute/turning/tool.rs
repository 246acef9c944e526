//! The moves that a lathe cycle is rewritten into: traverses, feeds and arcs as of blocks of their own.

use gaugeblock_vocabulary::{Motion, Position};

use crate::rs274::evaluate::Words;
use crate::rs274::execute::{arc, feed, straight};
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;
use crate::rs274::task::Record;
use crate::rs274::turning::{Curve, Frame, Piece, Point};

/// A traverse to a position.
///
/// # Errors
/// What a traverse is refused for. The cycle does more than the budget of effects allows.
pub(crate) fn traverse(
    end: Position,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    lead_straight(Motion::Traverse, end, state, record)
}

fn lead_straight(
    motion: Motion,
    end: Position,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    if record.is_full() {
        return Err(StepError::TooManyEffects);
    }
    straight::lead_to(motion, end, &Words::default(), state, record)
}

/// The tool on its way along a profile, in the axes of the cycle.
pub(super) struct Tool<'a> {
    pub(super) frame: Frame,
    pub(super) state: &'a mut State,
    pub(super) record: &'a mut Record,
}

impl Tool<'_> {
    /// A point of the plane as a position: the axes that are not in the plane stay.
    fn position(&self, point: Point) -> Position {
        let Point { w, u } = self.frame.read(point);
        let here = crate::rs274::execute::compensation::programmed_point(self.state);
        Position { x: u, z: w, ..here }
    }

    /// A traverse to a point.
    pub(super) fn traverse(&mut self, end: Point) -> Result<(), StepError> {
        lead_straight(Motion::Traverse, self.position(end), self.state, self.record)
    }

    /// A line at feed rate to a point, also to where the tool is.
    ///
    /// # Errors
    /// Feed moves of a cycle have no F of their own.
    pub(super) fn feed(&mut self, end: Point) -> Result<(), StepError> {
        feed::check_feed_rate(&Words::default(), self.state)?;
        lead_straight(Motion::Feed, self.position(end), self.state, self.record)
    }

    /// A piece at feed rate from where it starts. An arc of no length is left out.
    pub(super) fn along(&mut self, piece: &Piece) -> Result<(), StepError> {
        let Curve::Arc { centre, sense } = piece.curve else { return self.feed(piece.end) };
        if piece.chord() == 0.0 {
            return Ok(());
        }
        if self.record.is_full() {
            return Err(StepError::TooManyEffects);
        }
        feed::check_feed_rate(&Words::default(), self.state)?;
        let Point { w, u } = self.frame.read(centre);
        let is_left = sense * self.frame.sense() > 0.0;
        let motion = if is_left { Motion::ArcCounterclockwise } else { Motion::ArcClockwise };
        arc::about((w, u), motion, self.position(piece.end), self.state, self.record)
    }
}
