//! The planner: the queue of segments, and what a servo cycle does.

use crate::entry_speed::OverrideScale;
use crate::error::{Error, NotQueued};
use crate::limits::{Limits, squared};
use crate::look_ahead::LookAhead;
use crate::math;
use crate::motion::{CycleRequest, MotionState};
use crate::nominal_segment::{ResolvedSegment, resolve};
use crate::parameters::{Axes, Dynamics, Hold, InputParameter, OutputParameter, Phase, lead};
use crate::path_builder::{PathBuilder, PathEdit};
use crate::path_element::{AccelerationModel, FeedBasis, PathElement};
use crate::retrace::Retrace;
use crate::ring::Ring;
use crate::segment::{Blend, OutputSwitch, Segment};

/// How many pieces behind the motion are remembered at least, for running back.
const REVERSE_ELEMENTS_MIN: u64 = 128;
/// Work of look-ahead for a queued segment, and for a cycle: a bend takes two of it, any other piece one.
const LOOK_AHEAD_WORK_PER_SEGMENT: u32 = 24;
const LOOK_AHEAD_WORK_PER_CYCLE: u32 = 4;
/// How many pieces may be made when a segment is queued, at most.
const ELEMENTS_PER_SEGMENT_MAX: u64 = 8;
/// How much slower or faster than planned a spindle may turn before look-ahead plans anew, and how much faster it
/// plans then.
const SPINDLE_SPEED_TOLERANCE_RATIO: f64 = 0.02;

/// A planner for nine axes in machine coordinates.
#[derive(Debug)]
pub struct Planner {
    dynamics: Dynamics,
    limits: Limits,
    ring: Ring<PathElement>,
    course: PathBuilder,
    ahead: LookAhead,
    motion: MotionState,
    /// Where the machine is while there are no pieces.
    position: Axes,
    /// Outputs that wait for the segment of that number.
    switches: Ring<(u64, OutputSwitch)>,
    /// The first switch behind the last segment that moves nothing: those before it need not wait for one that does.
    met: u64,
    /// How many segments that move have been queued.
    queued: u64,
    aborting: bool,
    retrace: Retrace,
    turns: f64,
    /// The end of the last piece that follows the spindle.
    followed: u64,
    probe: bool,
    /// Whether the next segment is to begin where it is programmed to.
    apart: bool,
    /// Whether the motion may be faster than it is planned, since an override has changed.
    late: bool,
}

impl Planner {
    /// A planner that stands still at a position, with all its memory taken.
    ///
    /// # Errors
    /// [`Error::Unimplemented`] for limits of jerk, [`Error::Configuration`] for limits that are no numbers above 0.
    pub fn new(dynamics: Dynamics, position: Axes) -> Result<Self, Error> {
        if dynamics.jerk.is_some() {
            return Err(Error::Unimplemented("a planner that is limited in jerk"));
        }
        let mut limits = dynamics.velocity.iter().chain(&dynamics.acceleration);
        if !limits.all(|limit| *limit > 0.0 && limit.is_finite()) {
            return Err(Error::Configuration("a limit of an axis is no number above 0"));
        }
        if !(dynamics.cycle > 0.0 && dynamics.cycle.is_finite()) {
            return Err(Error::Configuration("a servo cycle lasts longer than 0"));
        }
        if !position.iter().all(|place| place.is_finite()) {
            return Err(Error::Configuration("the position is no number"));
        }
        let queue = usize::try_from(dynamics.queue.max(4)).unwrap_or(usize::MAX);
        let remembered = usize::try_from(REVERSE_ELEMENTS_MIN).unwrap_or(0).saturating_mul(2);
        Ok(Self {
            dynamics,
            limits: Limits::new(&dynamics),
            ring: Ring::new(queue.saturating_mul(3).saturating_add(remembered)),
            course: PathBuilder::new(position),
            ahead: LookAhead::new(OverrideScale { feed: 1.0, rapid: 1.0, turns: 0.0 }),
            motion: MotionState::default(),
            position,
            switches: Ring::new(queue),
            met: 0,
            queued: 0,
            aborting: false,
            retrace: Retrace::default(),
            turns: 0.0,
            followed: 0,
            probe: false,
            apart: false,
            late: false,
        })
    }

    /// Queues a segment that begins where the last one ends.
    ///
    /// # Errors
    /// The queue is full, or the segment is none.
    pub fn queue(&mut self, segment: &Segment) -> Result<(), NotQueued> {
        self.make_room();
        let waiting = self.queued.saturating_sub(self.motion.begun);
        if self.aborting || self.ring.room() < 8 || waiting > u64::from(self.dynamics.queue) {
            return Err(NotQueued::Full);
        }
        let resolved = resolve(segment, self.course.new_segment(), &self.limits)?;
        if self.late && self.ahead.is_ready(self.motion.at) {
            self.late = !self.motion.can_follow(&self.ring, &self.limits);
        }
        let mut queue = PathEdit {
            ring: &mut self.ring,
            ahead: &mut self.ahead,
            motion: &self.motion,
            limits: &self.limits,
            changed: u64::MAX,
            late: self.late,
        };
        if let ResolvedSegment::ZeroLength = resolved {
            self.met = self.switches.end();
        }
        match resolved {
            ResolvedSegment::ZeroLength if segment.blend == Blend::ExactStop => {
                self.course.stop_at_end()
            }
            ResolvedSegment::ZeroLength => {}
            ResolvedSegment::Dwell(seconds) => self.course.dwell(seconds, &mut queue),
            ResolvedSegment::Moves => {
                self.queued = self.queued.saturating_add(1);
                let last = self.switches.get(self.switches.end().wrapping_sub(1));
                let awaited = last.is_some_and(|(segment, _)| *segment == self.queued);
                let (leg, _) = self.course.new_segment();
                (leg.whole.index, leg.apart) = (self.queued, self.apart || awaited);
                self.apart = false;
                if segment.probing {
                    self.course.stop_at_end();
                }
                self.course.add(&mut queue);
                if self.course.follows_spindle() {
                    self.note_spindle_sync();
                }
            }
        }
        self.ahead.advance(
            &mut self.ring,
            self.motion.at,
            &self.limits,
            (LOOK_AHEAD_WORK_PER_SEGMENT, false),
        );
        self.ahead.note_quiet_after_queueing(self.motion.at);
        Ok(())
    }

    /// Keeps the next segment from becoming one with those before it, which short ones may within their tolerance:
    /// for instance where other overrides act on it.
    pub fn keep_apart(&mut self) {
        self.apart = true;
    }

    /// Lets an output switch when the next segment that is not queued yet begins: in the cycle in which the commanded
    /// point passes the start of the segment, or on a blend its middle. A segment that moves nothing begins with the
    /// one after it, or where the path ends. Without such a segment it never switches.
    ///
    /// # Errors
    /// As many wait as the queue holds segments.
    pub fn switch(&mut self, switch: OutputSwitch) -> Result<(), NotQueued> {
        if self.aborting || self.switches.room() == 0 {
            return Err(NotQueued::Full);
        }
        self.switches.push(&(self.queued.saturating_add(1), switch));
        Ok(())
    }

    /// The next output that has switched, in the order of queueing; to be asked after each cycle until there is none.
    pub fn switched(&mut self) -> Option<OutputSwitch> {
        let first = self.switches.first();
        let (segment, switch) = *self.switches.get(first)?;
        if segment > self.motion.begun && !(first < self.met && self.is_at_end()) {
            return None;
        }
        self.switches.drop_first();
        Some(switch)
    }

    /// Moves on by one servo cycle.
    pub fn update(&mut self, input: &InputParameter, output: &mut OutputParameter) -> Phase {
        let wish = self.cycle_request(input);
        self.motion.advance_cycle(&self.ring, &self.limits, &wish);
        self.advance_look_ahead(&wish, input);
        output.tripped = self.probe_tripped(input.probe);
        self.aborting |= output.tripped;
        self.write_output(output);
        output.phase = self.phase(&wish);
        if output.phase == Phase::Idle {
            // Whatever comes next begins at rest here, also if the motion has run back by then.
            self.course.close();
        }
        if self.aborting && self.motion.speed <= 0.0 {
            self.clear_queue(&output.position);
        }
        output.phase
    }

    /// What the machine can do.
    pub fn dynamics(&self) -> &Dynamics {
        &self.dynamics
    }

    /// Finds the last piece that follows the spindle: a leg takes the corner with it, which is made with the next leg
    /// and anew with the one after.
    fn note_spindle_sync(&mut self) {
        let end = self.ring.end();
        let follows =
            |place: &u64| self.ring.get(*place).is_some_and(|p| p.pace == FeedBasis::PerTurn);
        if let Some(last) = (end.saturating_sub(ELEMENTS_PER_SEGMENT_MAX)..end).rev().find(follows)
        {
            self.followed = last.saturating_add(1);
        }
    }

    /// Forgets pieces that lie far behind the motion, if there is need.
    fn make_room(&mut self) {
        while self.ring.room() < 16
            && !self.retrace.is_requested()
            && !self.motion.backwards
            && self.ring.first().saturating_add(REVERSE_ELEMENTS_MIN) < self.motion.at
        {
            self.ring.drop_first();
        }
    }

    /// What the outside asks for.
    fn cycle_request(&mut self, input: &InputParameter) -> CycleRequest {
        let back = input.adaptive_feed < 0.0;
        // What is no number is 0.
        let adaptive = math::min(1.0, math::max(0.0, input.adaptive_feed.abs()));
        let feed = math::max(0.0, input.feed_override * adaptive);
        let rapid = math::min(1.0, math::max(0.0, input.rapid_override)) * adaptive;
        let follows = self.motion.at < self.followed;
        let turns = if follows {
            math::max(0.0, feed * (input.spindle_turns - self.turns).abs() / self.limits.cycle)
        } else {
            0.0
        };
        self.turns = input.spindle_turns;
        self.aborting |= input.hold == Hold::Abort;
        self.update_direction(back);
        let turning = self.motion.backwards != back;
        let rest =
            self.aborting || input.hold != Hold::Run || turning || feed <= 0.0 && rapid <= 0.0;
        let planned = !follows && self.ahead.plans_for(feed, rapid, self.motion.at);
        let ease =
            if planned { 1.0 } else { self.speed_sq_factor(feed, rapid, follows.then_some(turns)) };
        CycleRequest { feed, rapid, turns, rest, planned, ease }
    }

    /// What speeds of look-ahead are multiplied by, squared.
    #[cold]
    #[inline(never)]
    fn speed_sq_factor(&self, feed: f64, rapid: f64, turns: Option<f64>) -> f64 {
        let planned = self.ahead.highest_scale();
        let turns = turns.unwrap_or(planned.turns);
        OverrideScale { feed, rapid, turns }.speed_sq_factor(planned)
    }

    /// Turns the motion round when it is at rest and knows how fast it may go.
    #[inline]
    fn update_direction(&mut self, back: bool) {
        if back || self.motion.backwards {
            self.change_direction(back);
        } else {
            self.retrace.forget();
        }
    }

    #[cold]
    #[inline(never)]
    fn change_direction(&mut self, back: bool) {
        if back && !self.motion.backwards {
            let may_turn = self.retrace.may_turn(&mut self.ring, self.motion.at);
            self.motion.backwards = may_turn && self.motion.speed <= 0.0;
        } else if !back && self.motion.speed <= 0.0 {
            self.motion.backwards = false;
            self.ahead.resume_after_retrace(&self.ring, self.motion.at);
            self.retrace.forget();
        }
        self.motion.back_to = self.retrace.reverse_end();
    }

    /// Look-ahead, and look-back while the motion is to run back: mostly there is nothing to do.
    #[inline]
    fn advance_look_ahead(&mut self, wish: &CycleRequest, input: &InputParameter) {
        let at = self.motion.at;
        let planned = wish.planned && at >= self.followed;
        if !(planned && self.ahead.is_quiet(at) && !self.retrace.is_requested()) {
            self.advance_look_ahead_and_retrace(wish, input);
        }
    }

    /// Does less where the motion itself has had more to do.
    #[inline(never)]
    fn advance_look_ahead_and_retrace(&mut self, wish: &CycleRequest, input: &InputParameter) {
        let (work, back) = match self.motion.effort {
            0..=3 => (LOOK_AHEAD_WORK_PER_CYCLE, 2),
            4 | 5 => (LOOK_AHEAD_WORK_PER_CYCLE - 1, 1),
            6 | 7 => (LOOK_AHEAD_WORK_PER_CYCLE - 2, 1),
            _ => return,
        };
        let at = self.motion.at;
        self.ahead.refresh(&self.ring, at);
        let scale = OverrideScale {
            feed: wish.feed,
            rapid: wish.rapid,
            turns: self.spindle_speed_to_plan(wish.turns),
        };
        let other = input.adaptive_feed >= 0.0 && scale != self.ahead.scale;
        if other && self.ahead.may_rescale(at) {
            self.ahead.rescale(scale, &self.ring, at);
            self.late = true;
        } else if self.ahead.is_urgent(at) {
            self.ahead.advance(&mut self.ring, at, &self.limits, (work, true));
        } else {
            self.ahead.note_quiet();
        }
        if !self.retrace.is_requested() {
            return;
        }
        for _ in 0..back {
            let motion = (at, self.motion.backwards);
            self.retrace.advance(&mut self.ring, motion, self.ahead.scale, &self.limits);
        }
    }

    /// Turns per second to plan for: others than before where something follows the spindle, and its speed has
    /// changed by more than it wavers.
    fn spindle_speed_to_plan(&self, turns: f64) -> f64 {
        let planned = self.ahead.scale.turns;
        let near =
            turns <= planned && turns >= planned * (1.0 - 2.0 * SPINDLE_SPEED_TOLERANCE_RATIO);
        if near || self.motion.at >= self.followed {
            planned
        } else {
            turns * (1.0 + SPINDLE_SPEED_TOLERANCE_RATIO)
        }
    }

    /// Whether the probe has changed in a probing segment.
    fn probe_tripped(&mut self, probe: bool) -> bool {
        let changed = probe != self.probe;
        self.probe = probe;
        changed && self.ring.get(self.motion.at).is_some_and(|piece| piece.probing)
    }

    fn write_output(&self, output: &mut OutputParameter) {
        output.segment = self.motion.number;
        match self.ring.get(self.motion.at) {
            Some(piece) if piece.axes <= 3 => self.write_output_on::<3>(piece, output),
            Some(piece) => self.write_output_on::<9>(piece, output),
            None => {
                output.position = self.position;
                (output.velocity, output.acceleration) = (Axes::default(), Axes::default());
                output.speed = 0.0;
            }
        }
    }

    /// Where the motion is on a piece on which so many leading axes may move.
    #[inline]
    fn write_output_on<const N: usize>(&self, piece: &PathElement, output: &mut OutputParameter) {
        let motion = &self.motion;
        let sense = if motion.backwards { -1.0 } else { 1.0 };
        let (speed, change) = (sense * motion.speed, sense * motion.acceleration);
        let square = squared(speed);
        let mut sum = 0.0;
        let [place, mut first, mut second] = piece.derivatives::<N>(motion.x);
        for (first, second) in first.iter_mut().zip(&mut second) {
            *second = *first * change + *second * square;
            *first *= speed;
            sum += *first * *first;
        }
        output.speed = math::sqrt(sum);
        (output.velocity, output.acceleration) = (Axes::default(), Axes::default());
        lead(&mut output.velocity, &first);
        lead(&mut output.acceleration, &second);
        // Axes that take no part lie where the piece ends.
        output.position = piece.end;
        if motion.x.to_bits() != piece.length.to_bits() {
            lead(&mut output.position, &place);
        }
    }

    fn phase(&self, wish: &CycleRequest) -> Phase {
        let motion = &self.motion;
        if motion.speed > 0.0 {
            return if wish.rest { Phase::Holding } else { Phase::Moving };
        }
        let Some(piece) = self.ring.get(motion.at) else { return Phase::Idle };
        if self.is_at_end() {
            return Phase::Idle;
        }
        let dwells = matches!(piece.law, AccelerationModel::Dwell(_));
        match piece.pace {
            _ if wish.rest => Phase::Holding,
            _ if dwells => Phase::Waiting,
            FeedBasis::PerTurn if wish.turns <= 0.0 && wish.feed > 0.0 => Phase::Waiting,
            FeedBasis::PerTurn | FeedBasis::PerSecond | FeedBasis::Rapid => Phase::Moving,
        }
    }

    /// Whether the motion rests at the end of all that is queued.
    fn is_at_end(&self) -> bool {
        let motion = &self.motion;
        let Some(piece) = self.ring.get(motion.at) else { return true };
        let over = match piece.law {
            AccelerationModel::Dwell(seconds) => motion.dwelt >= seconds,
            AccelerationModel::Constant { .. }
            | AccelerationModel::Blend { .. }
            | AccelerationModel::Arc { .. }
            | AccelerationModel::BlendedArc { .. } => motion.remaining(piece) <= 0.0,
        };
        let last = motion.at.saturating_add(1) == self.ring.end();
        motion.speed <= 0.0 && over && last && !motion.backwards
    }

    /// Forgets the queue, at rest.
    fn clear_queue(&mut self, position: &Axes) {
        self.position = *position;
        self.ring.clear();
        self.switches.clear();
        self.ahead = LookAhead::new(self.ahead.scale);
        self.motion = MotionState {
            at: self.ring.end(),
            begun: self.queued,
            number: self.motion.number,
            ..MotionState::default()
        };
        self.course = PathBuilder::new(self.position);
        self.aborting = false;
        self.retrace.forget();
    }
}
