//! Where the repeats of a canned cycle are.

use gaugeblock_vocabulary::{Axis, Distance, Plane};

use super::super::target::{moved, polar};
use super::cycle::Cycle;
use crate::ids::rule;
use crate::rs274::evaluate::Words;
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

/// Where in the plane the repeats of a cycle are.
#[derive(Debug)]
pub(crate) struct Places<'a> {
    words: &'a Words,
    axes: [Axis; 2],
    /// The numbers of the block for both axes.
    numbers: [Option<f64>; 2],
    left: u64,
    /// The place of the next repeat, where it is known.
    next: Option<[f64; 2]>,
    /// The place of the repeat before.
    last: [f64; 2],
}

impl<'a> Places<'a> {
    /// # Errors
    /// Rules motion.polar-mixed and motion.polar-from-origin.
    pub(super) fn new(
        words: &'a Words,
        state: &mut State,
        cycle: &Cycle,
        repeats: u64,
    ) -> Result<Self, StepError> {
        let [first, second, _] = cycle.axes;
        let values = moved(words, state);
        let value =
            |axis: Axis| values.iter().find(|(named, _)| *named == axis).map(|(_, value)| *value);
        let number = |axis: Axis| state.dialect().increment_in_plane(axis, value(axis), state);
        let numbers = [number(first), number(second)];
        let last = [state.position.get(first), state.position.get(second)];
        let axes = [first, second];
        let mut places = Self { words, axes, numbers, left: repeats, next: None, last };
        places.next = Some(places.following(state)?);
        state.coverage.accepted(if state.modes.distance == Distance::Incremental {
            rule::cycles::INCREMENTAL
        } else {
            rule::cycles::ABSOLUTE
        });
        Ok(places)
    }

    /// The place of the next repeat on the first and second axis; none after the last one.
    ///
    /// # Errors
    /// Rule motion.polar-from-origin: the repeat before was at the origin.
    pub(super) fn next(&mut self, state: &mut State) -> Result<Option<[f64; 2]>, StepError> {
        if self.left == 0 {
            return Ok(None);
        }
        let place = match self.next.take() {
            Some(place) => place,
            None => self.following(state)?,
        };
        self.left -= 1;
        self.last = place;
        Ok(Some(place))
    }

    /// Rule cycles.repeat. In incremental distance mode each repeat goes on from the one before by the same increments;
    /// in absolute distance mode all are in the same place. Polar words give the place as they do for a move.
    fn following(&self, state: &mut State) -> Result<[f64; 2], StepError> {
        let named = polar(self.words, state)?;
        if named.is_some() && state.modes.plane != Plane::Xy {
            let what = "polar words in a cycle of another plane";
            return Err(StepError::Unspecified(what.to_owned()));
        }
        let incremental = state.modes.distance == Distance::Incremental;
        let from = named.map_or(self.last, |point| self.axes.map(|axis| point.get(axis)));
        let mut place = from;
        for (place, number) in place.iter_mut().zip(self.numbers) {
            match number {
                Some(number) if incremental => *place += number,
                Some(number) => *place = number,
                None => {}
            }
        }
        Ok(place)
    }
}
