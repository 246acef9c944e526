//! Quirks of moves.

use gaugeblock_vocabulary::{FeedMode, Motion, Position};

use super::{LinuxCnc, Shows};
use crate::ids::quirk;
use crate::math;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::motion::MotionRules;
use crate::rs274::modes::each;
use crate::rs274::state::State;
use crate::rs274::task::Record;

impl MotionRules for LinuxCnc {
    fn move_straight(
        &self,
        motion: Motion,
        end: Position,
        words: &Words,
        state: &mut State,
        record: &mut Record,
    ) {
        feed_of_move(motion, end, state);
        Documented.move_straight(motion, end, words, state, record);
    }
}

/// Quirk rs274.feed-name-inverse-time. Under inverse time a straight feed leaves its own feed rate: the length of its
/// way, of X, Y and Z where one of them moves, times F, and a tenth at least.
fn feed_of_move(motion: Motion, end: Position, state: &mut State) {
    if motion != Motion::Feed
        || state.modes.feed_mode != FeedMode::InverseTime
        || !state.shows(quirk::rs274::FEED_NAME_INVERSE_TIME)
    {
        return;
    }
    let way = each(end, state.position, |end, start| end - start);
    let length = |[x, y, z]: [f64; 3]| math::hypotenuse(math::hypotenuse(x, y), z);
    let lengths = [[way.x, way.y, way.z], [way.u, way.v, way.w], [way.a, way.b, way.c]].map(length);
    let length = lengths.into_iter().find(|length| *length > 0.0).unwrap_or_default();
    let modes = &mut state.modes;
    modes.memory.get_mut().feed_number = (length * modes.feed_rate).max(0.1);
}
