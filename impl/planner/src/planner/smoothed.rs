//! What a planner with limits of jerk does in addition: segments become stretches, each with a moving average of its
//! own, and the output is the averaged motion.

use crate::feed_path::FeedPath;
use crate::limits::squared;
use crate::math;
use crate::motion::MotionState;
use crate::parameters::{Axes, InputParameter, OutputParameter, Phase, lead};
use crate::path_element::{AccelerationModel, Averaged, PathElement};
use crate::planner::Planner;
use crate::ring::Ring;
use crate::segment::{Feed, Path, PathControl, Segment};
use crate::sign_changes::SignChanges;
use crate::smoothing::Smoothed;
use crate::stretch::{MovingAxes, Stretch, TOLERANCE_SHARE, Way, deviation};
use crate::vector::{dot, norm_of};

/// How many dwells in a row are looked through for the next motion.
const DWELLS_MAX: u32 = 8;
/// A shorter segment moves nothing.
const MOTION_LENGTH_MIN_MM: f64 = 1e-10;

impl Planner {
    /// The last segment that the motion has begun.
    pub(super) fn begun(&self) -> u64 {
        self.smoothing.as_ref().map_or(self.motion.begun, |smoothing| smoothing.smoother.begun)
    }

    /// Whether the output is at rest where the planned motion is.
    pub(super) fn is_settled(&self) -> bool {
        self.smoothing.as_ref().is_none_or(|smoothing| smoothing.smoother.is_settled())
    }

    /// A cycle of a planner that smooths motions.
    #[inline(never)]
    pub(super) fn update_smoothed(
        &mut self,
        input: &InputParameter,
        output: &mut OutputParameter,
    ) -> Phase {
        let request = self.cycle_request(input);
        self.motion.is_settled = self.is_settled();
        self.motion.has_just_settled =
            self.smoothing.as_ref().is_some_and(|smoothing| smoothing.smoother.has_just_settled());
        self.motion.speed_before = self.motion.speed;
        self.motion.has_moved = self.motion.speed > 0.0;
        if self.motion.has_moved {
            self.motion.rest_time_left = 0.0;
        }
        if self.motion.is_settled {
            self.begin_stretch();
        }
        self.motion.avoids_fast_path = self.motion.is_on_lone_line || self.motion.speed <= 0.0;
        let begun = self.motion.begun;
        let limits = self.table.smoothed_over(self.motion.smoothing.limits);
        self.motion.advance_cycle(&self.elements, limits, &request);
        self.advance_path(&request, input);
        self.follow_probe(input, output);
        self.write_smoothed_output(begun, output);
        output.phase = match self.phase(&request) {
            Phase::Idle | Phase::Waiting if !self.is_settled() => Phase::Moving,
            phase @ (Phase::Idle | Phase::Moving | Phase::Waiting | Phase::Holding) => phase,
        };
        if output.phase == Phase::Idle {
            self.builder.close();
        }
        if self.aborting && self.motion.speed <= 0.0 && self.is_settled() {
            self.clear_queue(&output.position);
            if let Some(smoothing) = &mut self.smoothing {
                smoothing.open = None;
                smoothing.smoother.begin_all(&self.motion);
            }
        }
        output.phase
    }

    /// At rest: sets the average for the element on which the motion goes on.
    fn begin_stretch(&mut self) {
        let Some((place, element)) = self.element_ahead() else { return };
        let next = element.smoothing;
        let x = if place == self.motion.at {
            self.motion.x
        } else if self.motion.is_reversed {
            element.length
        } else {
            0.0
        };
        self.motion.smoothing = next;
        self.motion.is_on_lone_line = next.averaged == Averaged::LoneLine;
        let Some(smoothing) = &mut self.smoothing else { return };
        if !smoothing.smoother.is_set_for(next, place) {
            smoothing.smoother.begin_all(&self.motion);
            smoothing.smoother.restart(next, (place, x));
            self.motion.sign_changes = SignChanges::default();
        }
    }

    /// The element on which a motion at rest goes on.
    fn element_ahead(&self) -> Option<(u64, &PathElement)> {
        let mut place = self.motion.at;
        for _ in 0..DWELLS_MAX {
            let element = self.elements.get(place)?;
            let is_dwell = matches!(element.model, AccelerationModel::Dwell(_));
            let is_over = place == self.motion.at && self.motion.remaining(element) <= 0.0;
            if !is_dwell && !is_over {
                return Some((place, element));
            }
            place = if self.motion.is_reversed {
                place.checked_sub(1).filter(|before| *before >= self.motion.reverse_end)?
            } else {
                place.saturating_add(1)
            };
        }
        None
    }

    /// Writes the averaged motion, after a cycle before which another segment may have been begun.
    fn write_smoothed_output(&mut self, begun: u64, output: &mut OutputParameter) {
        self.write_output(output);
        let Some(smoothing) = &mut self.smoothing else { return };
        let motion = &self.motion;
        let after_begin = (motion.begun != begun).then(|| way_since_begin(&self.elements, motion));
        let parameter = match smoothing.smoother.lone() {
            Some(lone) if lone == motion.at => motion.x,
            Some(lone) if lone < motion.at => {
                self.elements.get(lone).map_or(0.0, |lone| lone.length)
            }
            Some(_) | None => 0.0,
        };
        let Smoothed { mut position, parameter } =
            smoothing.smoother.add(&output.position, parameter, motion, after_begin);
        let lone = smoothing.smoother.lone().and_then(|lone| self.elements.get(lone));
        if let (Some(lone), Some(x)) = (lone, parameter) {
            position = lone.end;
            if lone.axis_count <= 3 {
                lead(&mut position, &lone.derivatives::<3>(x)[0]);
            } else {
                [position, _, _] = lone.derivatives::<9>(x);
            }
        }
        let per_cycle = 1.0 / self.limits.cycle;
        let mut sum = 0.0;
        let places = position.iter().zip(&smoothing.position);
        let rates = output.velocity.iter_mut().zip(&mut output.acceleration);
        for (((place, before), last), (velocity, acceleration)) in
            places.zip(&mut smoothing.velocity).zip(rates)
        {
            *velocity = (place - before) * per_cycle;
            *acceleration = (*velocity - *last) * per_cycle;
            *last = *velocity;
            sum += squared(*velocity);
        }
        output.speed = math::sqrt(sum);
        if smoothing.smoother.has_rested() && self.motion.speed_before > 0.0 {
            // The position came to rest in an earlier cycle, except for rounding.
            self.motion.rest_time_left = 0.0;
        }
        (output.position, smoothing.position) = (position, position);
        output.segment = smoothing.smoother.number;
    }

    /// What is queued for a segment: ends the last stretch if the segment cannot join it, and leaves a part of the
    /// tolerance to the average.
    pub(super) fn in_stretch(&mut self, segment: &Segment) -> Segment {
        let start = *self.row.end(&self.builder.end);
        let Some(way) = way_of(segment, &start) else {
            // A dwell, and what moves nothing.
            let ends = matches!(segment.path, Path::Dwell { .. })
                || segment.path_control == PathControl::ExactStop;
            if let Some(smoothing) = self.smoothing.as_mut().filter(|_| ends) {
                smoothing.open = None;
            }
            return *segment;
        };
        if let PathControl::Within(tolerance) = segment.path_control
            && (tolerance.is_nan() || tolerance < 0.0)
        {
            return *segment;
        }
        let is_arc = matches!(segment.path, Path::Arc { .. });
        let (axes, feed_path) = (MovingAxes::of(&way.direction), feed_path(&way.direction));
        let Some(smoothing) = &mut self.smoothing else { return *segment };
        if let Some(open) = smoothing.open
            && !self.next_is_separate
            && !segment.probing
            && open.requested == segment.path_control
            && open.feed == segment.feed
            // Segments of the same time have unequal speeds.
            && !matches!(segment.feed, Feed::InTime(_))
            && open.feed_path == feed_path
            && open.axes.contains(axes)
            && !(is_arc && open.path_control == PathControl::ExactPath)
        {
            return Segment { path_control: open.path_control, ..*segment };
        }
        let within = match segment.path_control {
            PathControl::Within(tolerance) => {
                let limits = self.table.within(TOLERANCE_SHARE * tolerance, axes);
                limits.map(|limits| (*limits, tolerance - deviation(limits, axes)))
            }
            PathControl::ExactStop | PathControl::ExactPath | PathControl::BetweenMidpoints => None,
        };
        let is_lone = segment.probing
            || segment.path_control == PathControl::ExactStop
            || is_arc && within.is_none();
        let (limits, path_control) = match within {
            _ if is_lone && is_arc => (self.table.lone_arc(&way), PathControl::ExactStop),
            _ if is_lone => (self.table.lone_line(&way), PathControl::ExactStop),
            Some((limits, tolerance)) => (limits, PathControl::Within(tolerance)),
            None => (self.table.exact(&way), PathControl::ExactPath),
        };
        let stretch = Stretch {
            requested: segment.path_control,
            path_control,
            feed: segment.feed,
            feed_path,
            axes,
        };
        smoothing.open = (!is_lone).then_some(stretch);
        self.end_row();
        self.builder.rest_at_end();
        self.limits = limits;
        self.limits.smoothing.has_more_axes = axes.has_more_than_three();
        self.next_is_separate = true;
        Segment { path_control, ..*segment }
    }
}

/// How far the motion has gone since the segment began that it is on: that was on its element or on the one before.
fn way_since_begin(elements: &Ring<PathElement>, motion: &MotionState) -> f64 {
    let start_on = |place: u64| {
        let element = elements.get(place).filter(|element| element.index == motion.begun)?;
        element.segment_start.map(|start| (start, element.length))
    };
    let before = motion.at.checked_sub(1).and_then(start_on);
    match (start_on(motion.at), before) {
        (Some((start, _)), _) => motion.x - start,
        (None, Some((start, length))) => motion.x + length - start,
        (None, None) => motion.x,
    }
}

/// The way of a segment, if it moves.
fn way_of(segment: &Segment, start: &Axes) -> Option<Way> {
    let (end, turned, radius) = match &segment.path {
        Path::Straight { end } => (end, 0.0, f64::INFINITY),
        Path::Arc { end, centre, angle, .. } => {
            let mut from = [0.0; 3];
            for ((from, start), centre) in from.iter_mut().zip(start).zip(centre) {
                *from = start - centre;
            }
            let radius = math::sqrt(dot(&from, &from));
            (end, radius * angle.abs(), radius)
        }
        Path::Dwell { .. } => return None,
    };
    let mut direction = *end;
    for (share, start) in direction.iter_mut().zip(start) {
        *share -= start;
    }
    let far = norm_of(&direction, 9);
    let length = math::max(far, turned);
    if length.is_nan() || length <= MOTION_LENGTH_MIN_MM {
        return None;
    }
    if turned > far {
        // In its plane an arc has all directions.
        let shares = direction.iter_mut().take(3);
        shares.for_each(|share| *share = length);
    }
    direction = direction.map(|share| share / length);
    let speed = match segment.feed {
        Feed::PerSecond(feed) => feed,
        Feed::InTime(seconds) => length / seconds,
        Feed::Rapid | Feed::PerTurn(_) => f64::INFINITY,
    };
    Some(Way { length, direction, speed, radius })
}

/// The axes along which a feed in a direction is measured.
fn feed_path(direction: &Axes) -> FeedPath {
    let [x, y, z, _, _, _, u, v, w] = direction.map(f64::abs);
    if x + y + z > 0.0 {
        FeedPath::Linear
    } else if u + v + w > 0.0 {
        FeedPath::Secondary
    } else {
        FeedPath::Rotary
    }
}
