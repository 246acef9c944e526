//! The length of a move as it is programmed, which decides its speed under inverse time: where the cutter is
//! compensated, it moves along another path.

use gaugeblock_vocabulary::{Compensation, Distance, FeedMode, Lathe, Plane, Position};

use super::block::Printed;
use super::codes::MOTIONS;
use super::modes::Modes;
use super::motion::{arc_length, distance};
use super::plane::in_plane;
use super::words::Words;

impl Printed<'_> {
    /// Under inverse time and compensation the speed of a move is printed before all that the block puts out.
    pub(super) fn speed_of_programmed(&mut self) {
        if self.after.compensation == Compensation::Off
            || self.after.feed_mode != FeedMode::InverseTime
        {
            return;
        }
        let Some(feed) = self.words.get(b'F') else { return };
        let length = match self.words.g_of(&MOTIONS).unwrap_or(self.motion) {
            10 => distance(&self.programmed.0, &self.programmed.1),
            20 => self.programmed_arc(-1),
            30 => self.programmed_arc(1),
            _ => return,
        };
        if length > 0.0 {
            self.out.call_with("SET_FEED_RATE", length * feed);
        }
    }

    /// The length of the programmed arc; it is counterclockwise with a sense of 1, and clockwise with one of -1.
    fn programmed_arc(&self, sense: i32) -> f64 {
        let plane = self.after.plane;
        let (start, end) = self.programmed;
        let offsets = match plane {
            Plane::Zx => [b'K', b'I'],
            Plane::Yz => [b'J', b'K'],
            Plane::Xy | Plane::Uv | Plane::Wu | Plane::Vw => [b'I', b'J'],
        };
        let turns = self.words.get(b'P').map_or(1.0, libm::rint);
        #[expect(clippy::cast_possible_truncation, reason = "an accepted P is a small integer")]
        let turns = sense.saturating_mul(turns as i32);
        if let Some(radius) = self.words.get(b'R') {
            return by_radius(plane, &start, &end, radius);
        }
        let (from, _) = in_plane(plane, &start);
        let absolute = self.after.arc_distance == Distance::Absolute;
        let mut centre = from;
        for (place, letter) in centre.iter_mut().zip(offsets) {
            match self.words.get(letter) {
                Some(offset) if absolute => *place = offset,
                Some(offset) => *place += offset,
                None => {}
            }
        }
        arc_length(plane, &start, &end, centre, turns)
    }
}

/// The programmed point after a block: the reached one, unless the cutter is compensated.
pub(super) fn programmed_end(
    start: Position,
    reached: Position,
    after: &Modes,
    words: &Words,
) -> Position {
    if after.compensation == Compensation::Off {
        return reached;
    }
    let mut end = start;
    let scale = if after.lathe == Lathe::Diameter { 0.5 } else { 1.0 };
    let axes = [(b'X', &mut end.x, scale), (b'Y', &mut end.y, 1.0), (b'Z', &mut end.z, 1.0)];
    for (letter, place, scale) in axes {
        match words.get(letter).map(|value| value * scale) {
            Some(value) if after.distance == Distance::Incremental => *place += value,
            Some(value) => *place = value,
            None => {}
        }
    }
    end
}

/// The length of an arc with R between two points.
fn by_radius(plane: Plane, start: &Position, end: &Position, radius: f64) -> f64 {
    let ([x, y], z) = in_plane(plane, start);
    let ([end_x, end_y], end_z) = in_plane(plane, end);
    let half = libm::hypot(end_x - x, end_y - y) / 2.0;
    let angle = 2.0 * libm::asin((half / radius.abs()).min(1.0));
    let angle = if radius < 0.0 { std::f64::consts::TAU - angle } else { angle };
    libm::hypot(radius * angle, end_z - z)
}
