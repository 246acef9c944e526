//! The planner: its state, and what a servo cycle does.

mod queueing;
mod smoothed;

use crate::chord::ChordCorners;
use crate::chord_row::ChordRow;
use crate::entry_speed::OverrideScale;
use crate::error::{Error, NotQueued};
use crate::limits::{LimitTable, Limits, squared};
use crate::look_ahead::LookAhead;
use crate::math;
use crate::motion::{CycleRequest, MotionState};
use crate::parameters::{Axes, Dynamics, Hold, InputParameter, OutputParameter, Phase, lead};
use crate::path_builder::PathBuilder;
use crate::path_element::{AccelerationModel, FeedBasis, PathElement};
use crate::path_smoothing::PathSmoothing;
use crate::retrace::Retrace;
use crate::ring::Ring;
use crate::row_end::{NEAR_END_ELEMENTS, REVERSE_ELEMENTS_MIN, RowEnd};
use crate::segment::{OutputSwitch, PathControl};

/// Work of look-ahead per cycle: a blend takes two units, any other element one.
const LOOK_AHEAD_WORK_PER_CYCLE: u32 = 4;
/// How far the spindle speed may differ from the planned one before look-ahead plans again, and how much faster it
/// then plans.
const SPINDLE_SPEED_TOLERANCE_RATIO: f64 = 0.02;

/// A planner for nine axes in machine coordinates.
///
/// ```
/// use gaugeblock_planner::{Dynamics, Feed, InputParameter, OutputParameter, Path, PathControl};
/// use gaugeblock_planner::{Phase, Planner, Segment};
///
/// let dynamics = Dynamics {
///     velocity: [250.0; 9],
///     acceleration: [2000.0; 9],
///     jerk: None,
///     cycle: 0.001,
///     queue: 100,
/// };
/// let mut planner = Planner::new(dynamics, [0.0; 9])?;
/// let mut end = [0.0; 9];
/// end[0] = 10.0;
/// let segment = Segment {
///     number: 1,
///     path: Path::Straight { end },
///     feed: Feed::PerSecond(50.0),
///     path_control: PathControl::ExactStop,
///     probing: false,
/// };
/// assert_eq!(planner.queue(&segment), Ok(()));
/// let (input, mut output) = (InputParameter::default(), OutputParameter::default());
/// while planner.update(&input, &mut output) != Phase::Idle {}
/// assert_eq!(output.position, end);
/// # Ok::<(), gaugeblock_planner::Error>(())
/// ```
#[derive(Debug)]
pub struct Planner {
    dynamics: Dynamics,
    table: LimitTable,
    /// Those of the end of the path.
    limits: Limits,
    smoothing: Option<PathSmoothing>,
    elements: Ring<PathElement>,
    row: ChordRow,
    corners: ChordCorners,
    row_end: RowEnd,
    /// That of the last segment.
    last_path_control: PathControl,
    builder: PathBuilder,
    look_ahead: LookAhead,
    motion: MotionState,
    /// The machine's position while there are no elements.
    position: Axes,
    /// Outputs, each with the number of the segment that it waits for.
    switches: Ring<(u64, OutputSwitch)>,
    /// Outputs before this one wait for a segment that moves nothing: they also switch at the end of the path.
    switches_due_at_end: u64,
    /// How many segments that move have been queued.
    queued_count: u64,
    aborting: bool,
    retrace: Retrace,
    spindle_turns: f64,
    /// The end of the last element that follows the spindle.
    spindle_sync_end: u64,
    probe: bool,
    /// Whether the next segment must begin where it is programmed to.
    next_is_separate: bool,
    /// Whether the motion may be faster than planned, since an override has changed.
    motion_exceeds_plan: bool,
}

impl Planner {
    /// A planner at rest at a position. It allocates all its memory here.
    ///
    /// # Errors
    /// [`Error::Configuration`] for limits that are not above 0. A limit of jerk may be infinite.
    pub fn new(dynamics: Dynamics, position: Axes) -> Result<Self, Error> {
        let mut limits = dynamics.velocity.iter().chain(&dynamics.acceleration);
        if !limits.all(|limit| *limit > 0.0 && limit.is_finite()) {
            return Err(Error::Configuration("a limit of an axis is not a finite number above 0"));
        }
        if !dynamics.jerk.iter().flatten().all(|limit| *limit > 0.0) {
            return Err(Error::Configuration("a limit of jerk is not a number above 0"));
        }
        if !(dynamics.cycle > 0.0 && dynamics.cycle.is_finite()) {
            return Err(Error::Configuration("the servo cycle is not a finite time above 0"));
        }
        if !position.iter().all(|place| place.is_finite()) {
            return Err(Error::Configuration("the position is not finite"));
        }
        let queue = usize::try_from(dynamics.queue.max(4)).unwrap_or(usize::MAX);
        let remembered = usize::try_from(REVERSE_ELEMENTS_MIN).unwrap_or(0).saturating_mul(2);
        let table = LimitTable::new(&dynamics);
        let smoothing = PathSmoothing::new(&table, position);
        // Without smoothing these are the limits of the machine.
        let limits = *table.smoothed_over(1);
        Ok(Self {
            dynamics,
            table,
            limits,
            smoothing,
            elements: Ring::new(queue.saturating_mul(3).saturating_add(remembered)),
            row: ChordRow::new(),
            corners: ChordCorners::default(),
            row_end: RowEnd::Open,
            last_path_control: PathControl::ExactStop,
            builder: PathBuilder::new(position),
            look_ahead: LookAhead::new(OverrideScale { feed: 1.0, rapid: 1.0, spindle_speed: 0.0 }),
            motion: MotionState::default(),
            position,
            switches: Ring::new(queue),
            switches_due_at_end: 0,
            queued_count: 0,
            aborting: false,
            retrace: Retrace::default(),
            spindle_turns: 0.0,
            spindle_sync_end: 0,
            probe: false,
            next_is_separate: false,
            motion_exceeds_plan: false,
        })
    }

    /// Keeps the next segment from being merged with those before it, for instance where other overrides apply to it.
    /// Without this call, short segments are merged within their tolerance.
    pub fn prevent_merge(&mut self) {
        self.next_is_separate = true;
    }

    /// Switches an output when the next segment that is queued begins: in the cycle in which the commanded point
    /// passes the start of the segment, or on a blend its middle. A segment that moves nothing begins with the one
    /// after it, or where the path ends. Without such a segment the output never switches.
    ///
    /// # Errors
    /// [`NotQueued::Full`] if as many outputs wait as the queue holds segments.
    pub fn queue_output(&mut self, switch: OutputSwitch) -> Result<(), NotQueued> {
        if self.aborting || self.switches.room() == 0 {
            return Err(NotQueued::Full);
        }
        self.switches.push(&(self.queued_count.saturating_add(1), switch));
        Ok(())
    }

    /// The next output that has switched, in the order of queueing. Call it after each cycle until it returns `None`.
    pub fn next_switched_output(&mut self) -> Option<OutputSwitch> {
        let first = self.switches.first();
        let (segment, switch) = *self.switches.get(first)?;
        if segment > self.begun() && !(first < self.switches_due_at_end && self.is_at_end()) {
            return None;
        }
        self.switches.drop_first();
        Some(switch)
    }

    /// Moves by one servo cycle.
    pub fn update(&mut self, input: &InputParameter, output: &mut OutputParameter) -> Phase {
        if self.smoothing.is_some() {
            return self.update_smoothed(input, output);
        }
        let request = self.cycle_request(input);
        self.motion.advance_cycle(&self.elements, &self.limits, &request);
        self.advance_path(&request, input);
        self.follow_probe(input, output);
        self.write_output(output);
        output.phase = self.phase(&request);
        if output.phase == Phase::Idle {
            // What comes next begins at rest here, even if the motion reverses first.
            self.builder.close();
        }
        if self.aborting && self.motion.speed <= 0.0 {
            self.clear_queue(&output.position);
        }
        output.phase
    }

    /// Advances the end of the path, or look-ahead.
    #[inline(always)]
    fn advance_path(&mut self, request: &CycleRequest, input: &InputParameter) {
        let is_short = !self.has_no_row()
            && self.elements.end().saturating_sub(self.motion.at) <= NEAR_END_ELEMENTS;
        if !(is_short && self.end_row_in_cycles()) {
            self.advance_look_ahead(request, input);
        }
    }

    #[inline(always)]
    fn follow_probe(&mut self, input: &InputParameter, output: &mut OutputParameter) {
        output.probe_tripped = self.probe_tripped(input.probe);
        self.aborting |= output.probe_tripped;
    }

    /// The limits of the machine.
    pub fn dynamics(&self) -> &Dynamics {
        &self.dynamics
    }

    /// Reads the input of a cycle.
    #[inline(always)]
    fn cycle_request(&mut self, input: &InputParameter) -> CycleRequest {
        let back = input.adaptive_feed < 0.0;
        // NaN counts as 0.
        let adaptive = math::min(1.0, math::max(0.0, input.adaptive_feed.abs()));
        let feed = math::max(0.0, input.feed_override * adaptive);
        let rapid = math::min(1.0, math::max(0.0, input.rapid_override)) * adaptive;
        let follows = self.motion.at < self.spindle_sync_end;
        let spindle_speed = if follows {
            math::max(
                0.0,
                feed * (input.spindle_turns - self.spindle_turns).abs() / self.limits.cycle,
            )
        } else {
            0.0
        };
        self.spindle_turns = input.spindle_turns;
        self.aborting |= input.hold == Hold::Abort;
        self.update_direction(back);
        let reverses = self.motion.is_reversed != back;
        let must_stop =
            self.aborting || input.hold != Hold::Run || reverses || feed <= 0.0 && rapid <= 0.0;
        let is_planned = !follows && self.look_ahead.plans_for(feed, rapid, self.motion.at);
        let speed_sq_factor = if is_planned {
            1.0
        } else {
            self.speed_sq_factor(feed, rapid, follows.then_some(spindle_speed))
        };
        CycleRequest { feed, rapid, spindle_speed, must_stop, is_planned, speed_sq_factor }
    }

    /// The factor for squared speeds of look-ahead.
    #[cold]
    #[inline(never)]
    fn speed_sq_factor(&self, feed: f64, rapid: f64, spindle_speed: Option<f64>) -> f64 {
        let planned = self.look_ahead.highest_scale();
        let spindle_speed = spindle_speed.unwrap_or(planned.spindle_speed);
        OverrideScale { feed, rapid, spindle_speed }.speed_sq_factor(planned)
    }

    /// Reverses the motion when it is at rest and its speeds in the new direction are known.
    #[inline]
    fn update_direction(&mut self, back: bool) {
        if back || self.motion.is_reversed {
            self.change_direction(back);
        } else {
            self.retrace.forget();
        }
    }

    #[cold]
    #[inline(never)]
    fn change_direction(&mut self, back: bool) {
        if back && !self.motion.is_reversed {
            let may_turn = self.retrace.may_turn(&mut self.elements, self.motion.at);
            self.motion.is_reversed = may_turn && self.motion.speed <= 0.0;
        } else if !back && self.motion.speed <= 0.0 {
            self.motion.is_reversed = false;
            self.look_ahead.resume_after_retrace(&self.elements, self.motion.at);
            self.retrace.forget();
        }
        self.motion.reverse_end = self.retrace.reverse_end();
    }

    /// Advances look-ahead, and the plan for reverse motion; usually there is nothing to do.
    #[inline]
    fn advance_look_ahead(&mut self, request: &CycleRequest, input: &InputParameter) {
        let at = self.motion.at;
        let planned = request.is_planned && at >= self.spindle_sync_end;
        if !(planned && self.look_ahead.is_quiet(at) && !self.retrace.is_requested()) {
            self.advance_look_ahead_and_retrace(request, input);
        }
    }

    /// Does less where the motion itself has cost more.
    #[inline(never)]
    fn advance_look_ahead_and_retrace(&mut self, request: &CycleRequest, input: &InputParameter) {
        let (work, back) = match self.motion.work {
            0..=3 => (LOOK_AHEAD_WORK_PER_CYCLE, 2),
            4 | 5 => (LOOK_AHEAD_WORK_PER_CYCLE - 1, 1),
            6 | 7 => (LOOK_AHEAD_WORK_PER_CYCLE - 2, 1),
            _ => return,
        };
        let at = self.motion.at;
        self.look_ahead.refresh(&self.elements, at);
        let scale = OverrideScale {
            feed: request.feed,
            rapid: request.rapid,
            spindle_speed: self.spindle_speed_to_plan(request.spindle_speed),
        };
        let other = input.adaptive_feed >= 0.0 && scale != self.look_ahead.scale;
        if other && self.look_ahead.may_rescale(at) {
            self.look_ahead.rescale(scale, &self.elements, at);
            self.motion_exceeds_plan = true;
        } else if self.look_ahead.is_urgent(at) {
            self.look_ahead.advance(&mut self.elements, at, &self.table, (work, true));
        } else {
            self.look_ahead.note_quiet();
        }
        if !self.retrace.is_requested() {
            return;
        }
        for _ in 0..back {
            let motion = (at, self.motion.is_reversed);
            self.retrace.advance(&mut self.elements, motion, self.look_ahead.scale, &self.table);
        }
    }

    /// The spindle speed to plan for. It changes only while something follows the spindle and its speed differs by
    /// more than the tolerance.
    fn spindle_speed_to_plan(&self, spindle_speed: f64) -> f64 {
        let planned = self.look_ahead.scale.spindle_speed;
        let near = spindle_speed <= planned
            && spindle_speed >= planned * (1.0 - 2.0 * SPINDLE_SPEED_TOLERANCE_RATIO);
        if near || self.motion.at >= self.spindle_sync_end {
            planned
        } else {
            spindle_speed * (1.0 + SPINDLE_SPEED_TOLERANCE_RATIO)
        }
    }

    /// Whether the probe has changed in a probing segment.
    #[inline(always)]
    fn probe_tripped(&mut self, probe: bool) -> bool {
        let changed = probe != self.probe;
        self.probe = probe;
        changed && self.elements.get(self.motion.at).is_some_and(|element| element.probing)
    }

    #[inline(always)]
    fn write_output(&self, output: &mut OutputParameter) {
        output.segment = self.motion.number;
        match self.elements.get(self.motion.at) {
            Some(element) if element.axis_count <= 3 => self.write_output_on::<3>(element, output),
            Some(element) => self.write_output_on::<9>(element, output),
            None => {
                output.position = self.position;
                (output.velocity, output.acceleration) = (Axes::default(), Axes::default());
                output.speed = 0.0;
            }
        }
    }

    /// Writes position, velocity and acceleration on an element with N leading axes.
    #[inline(always)]
    fn write_output_on<const N: usize>(&self, element: &PathElement, output: &mut OutputParameter) {
        let motion = &self.motion;
        let sense = if motion.is_reversed { -1.0 } else { 1.0 };
        let (speed, change) = (sense * motion.speed, sense * motion.acceleration);
        let square = squared(speed);
        let mut sum = 0.0;
        let [place, mut first, mut second] = element.derivatives::<N>(motion.x);
        for (first, second) in first.iter_mut().zip(&mut second) {
            *second = *first * change + *second * square;
            *first *= speed;
            sum += *first * *first;
        }
        output.speed = math::sqrt(sum);
        (output.velocity, output.acceleration) = (Axes::default(), Axes::default());
        lead(&mut output.velocity, &first);
        lead(&mut output.acceleration, &second);
        // Axes that take no part are at the element's end.
        output.position = element.end;
        if motion.x.to_bits() != element.length.to_bits() {
            lead(&mut output.position, &place);
        }
    }

    #[inline(always)]
    fn phase(&self, request: &CycleRequest) -> Phase {
        let motion = &self.motion;
        if motion.speed > 0.0 {
            return if request.must_stop { Phase::Holding } else { Phase::Moving };
        }
        let Some(element) = self.elements.get(motion.at) else {
            return if self.has_no_row() { Phase::Idle } else { Phase::Moving };
        };
        if self.is_at_end() {
            return Phase::Idle;
        }
        let dwells = matches!(element.model, AccelerationModel::Dwell(_));
        match element.feed_basis {
            _ if request.must_stop => Phase::Holding,
            _ if dwells => Phase::Waiting,
            FeedBasis::PerTurn if request.spindle_speed <= 0.0 && request.feed > 0.0 => {
                Phase::Waiting
            }
            FeedBasis::PerTurn | FeedBasis::PerSecond | FeedBasis::Rapid => Phase::Moving,
        }
    }

    /// Whether the motion is at rest at the end of all that is queued.
    fn is_at_end(&self) -> bool {
        let motion = &self.motion;
        let Some(element) = self.elements.get(motion.at) else {
            return self.has_no_row() && self.is_settled();
        };
        let over = match element.model {
            AccelerationModel::Dwell(seconds) => motion.dwell_elapsed >= seconds,
            AccelerationModel::Constant { .. }
            | AccelerationModel::Blend { .. }
            | AccelerationModel::Arc { .. }
            | AccelerationModel::BlendedArc { .. } => motion.remaining(element) <= 0.0,
        };
        let last = motion.at.saturating_add(1) == self.elements.end();
        motion.speed <= 0.0
            && over
            && last
            && !motion.is_reversed
            && self.has_no_row()
            && self.is_settled()
    }

    /// Whether no chords wait.
    fn has_no_row(&self) -> bool {
        self.row.is_empty() && matches!(self.row_end, RowEnd::Open | RowEnd::Near)
    }

    /// Clears the queue, at rest.
    fn clear_queue(&mut self, position: &Axes) {
        self.position = *position;
        self.elements.clear();
        self.switches.clear();
        self.look_ahead = LookAhead::new(self.look_ahead.scale);
        self.motion = MotionState {
            at: self.elements.end(),
            begun: self.queued_count,
            number: self.motion.number,
            ..MotionState::default()
        };
        self.builder = PathBuilder::new(self.position);
        self.row.clear();
        self.row_end = RowEnd::Open;
        self.aborting = false;
        self.retrace.forget();
    }
}
