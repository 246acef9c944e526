//! The production planner, driven through the effects of a program.

mod effects;
mod stopped;

use std::collections::BTreeMap;

use gaugeblock_interpreter::path::{MotionRequest, Resolver};
use gaugeblock_planner::{
    Axes, Dynamics, Feed, Hold, InputParameter, NotQueued, OutputParameter, OutputSwitch, Path,
    Phase, Planner, Segment,
};
use gaugeblock_vocabulary::motion::{
    Column, Controls, MotionAction, MotionEvent, MotionLimits, MotionScript, Samples,
};
use gaugeblock_vocabulary::{
    Axis, Effect, Event, Outcome, OutputTiming, Pin, Position, Settings, Step, Switch,
};

pub use stopped::Stopped;

use effects::{follows_spindle, is_element, pins, spindle, switching};

/// How many segments the planner's queue holds.
const QUEUE: u32 = 2000;
/// Longest motion, servo cycles: a scratch file holds their samples. With a period of a millisecond it is 2 hours 46
/// minutes.
pub const SERVO_CYCLES_MAX: usize = 10_000_000;

/// Longest rest, in servo cycles, in addition to dwells.
const MOST_REST: f64 = 20_000.0;

/// Conditions of a simulated run.
#[derive(Clone, Debug, Default)]
pub struct RunConditions {
    /// The position of the machine before the run.
    pub start: Position,
    /// Servo cycles between segments that the planner gets; without it, as fast as it takes them.
    pub every: Option<u32>,
    /// What the operator and the machine's inputs do. Without speeds of a spindle it turns as programmed.
    pub script: MotionScript,
}

/// What a planner makes of one servo cycle.
#[derive(Clone, Copy, Debug)]
pub struct PlannedCycle<'a> {
    /// The sample: a value for each column.
    pub row: &'a [f64],
    /// Speed along the path of all axes, millimetres or degrees per second.
    pub speed: f64,
    /// The requested feed; see [`Planned::requested`].
    pub requested: f64,
}

/// What a planner makes of a program.
#[derive(Clone, Debug)]
pub struct Planned {
    /// A sample for each servo cycle, the first one before the motion.
    pub samples: Samples,
    /// Speed along the path of all axes by sample, millimetres or degrees per second.
    pub speed: Vec<f64>,
    /// The requested feed, by sample, in either direction: the programmed feed with overrides, and 0 in a hold. NaN in
    /// rapid moves, and where the feed follows from a time or a spindle.
    pub requested: Vec<f64>,
}

/// Plans a program from the machine's origin without an operator. With `feed_interval` the planner gets one segment in
/// so many cycles, else as many as it takes.
///
/// # Errors
/// As [`plan_with`].
pub fn plan(
    outcome: &Outcome,
    limits: &MotionLimits,
    every: Option<u32>,
) -> Result<Planned, Stopped> {
    plan_with(outcome, limits, &RunConditions { every, ..RunConditions::default() })
}

/// Plans what a program does under circumstances, to its end or to where the operator aborts it.
///
/// # Errors
/// An axis without limits moves, or the planner cannot plan the motion: a spline, a rigid tap, or a thread on a spindle
/// that does not turn. Or a hold never ends, or the motion takes more than [`SERVO_CYCLES_MAX`].
pub fn plan_with(
    outcome: &Outcome,
    limits: &MotionLimits,
    circumstances: &RunConditions,
) -> Result<Planned, Stopped> {
    let samples = sample_header(outcome, limits)?;
    let mut planned = Planned { samples, speed: Vec::new(), requested: Vec::new() };
    let keep = &mut |cycle: PlannedCycle<'_>| {
        planned.samples.push(cycle.row).map_err(|error| error.to_string())?;
        planned.speed.push(cycle.speed);
        planned.requested.push(cycle.requested);
        Ok(())
    };
    plan_cycles(outcome, limits, circumstances, keep)?;
    Ok(planned)
}

/// A table without samples, with the columns that planning a program reports.
///
/// # Errors
/// The machine has columns that a table of samples cannot have.
pub fn sample_header(outcome: &Outcome, limits: &MotionLimits) -> Result<Samples, Stopped> {
    let columns = limits.axes.keys().copied().map(Column::Position);
    let columns = columns.chain([Column::Line, Column::Queued]);
    let columns = columns.chain(pins(outcome).into_iter().map(Column::Output));
    let turning = follows_spindle(outcome);
    let columns = columns.chain(turning.then_some(Column::SpindleSpeed(0))).collect();
    Samples::new(limits.period, 0.0, columns).map_err(|error| Stopped::new(error.to_string()))
}

/// The same as [`plan_with`] for a motion that is too long to be kept: reports each servo cycle as it is planned. The
/// rows have the columns of [`sample_header`].
///
/// # Errors
/// As [`plan_with`], or an error of `report`.
pub fn plan_cycles(
    outcome: &Outcome,
    limits: &MotionLimits,
    circumstances: &RunConditions,
    report: &mut dyn FnMut(PlannedCycle<'_>) -> Result<(), String>,
) -> Result<(), Stopped> {
    let mut drive = Simulation::new(outcome, limits, circumstances, report)?;
    drive.record()?;
    for (place, step) in outcome.steps.iter().enumerate() {
        drive.step = place;
        for event in &step.events {
            let done = match event {
                Event::Set(change) => drive.set(change),
                Event::Do(effect) => drive.perform(step.block.line, effect),
                Event::Unknown(_) => Ok(()),
            };
            done.map_err(|stopped| drive.at_block(stopped, outcome, Some(step)))?;
            if drive.operator.abort {
                break;
            }
        }
    }
    drive.rest().map_err(|stopped| drive.at_block(stopped, outcome, None))
}

struct Simulation<'a> {
    limits: &'a MotionLimits,
    every: Option<u32>,
    /// What is still to happen.
    events: &'a [MotionEvent],
    /// The operator's requests, before M48 to M53 apply.
    operator: Operator,
    /// Cycles without motion, and seconds of all dwells so far.
    rests: f64,
    dwells: f64,
    resolver: Resolver,
    settings: Settings,
    planner: Planner,
    /// Whether anything that is queued may still follow the spindle.
    follows: bool,
    /// Whether turns are recorded, and turns per second in the last cycle.
    turning: bool,
    turns: f64,
    input: InputParameter,
    output: OutputParameter,
    outputs: BTreeMap<Pin, f64>,
    /// The feed of each segment by its number.
    feeds: Vec<f64>,
    /// The lines of the segments, and their steps of the outcome.
    lines: Vec<u32>,
    origins: Vec<usize>,
    /// The step of the outcome whose effects the planner gets.
    step: usize,
    /// What acts on the segments (M48 to M53).
    controls: Vec<Controls>,
    /// How many elements of the path the planner has been given, moves and rests.
    given: u32,
    /// How many cycles have been reported.
    cycles: usize,
    /// The sample of a cycle.
    row: Vec<f64>,
    report: &'a mut dyn FnMut(PlannedCycle<'_>) -> Result<(), String>,
}

/// Requests of an operator and of the inputs of a machine.
#[derive(Clone, Copy, Debug)]
struct Operator {
    feed: f64,
    rapid: f64,
    adaptive: f64,
    feed_stop: bool,
    hold: bool,
    abort: bool,
    /// The first spindle's turns per second, once they are given.
    turns: Option<f64>,
}

impl Operator {
    const AWAY: Self = Self {
        feed: 1.0,
        rapid: 1.0,
        adaptive: 1.0,
        feed_stop: false,
        hold: false,
        abort: false,
        turns: None,
    };

    fn does(&mut self, action: MotionAction) {
        match action {
            MotionAction::FeedOverride(factor) => self.feed = factor,
            MotionAction::RapidOverride(factor) => self.rapid = factor,
            MotionAction::AdaptiveFeed(factor) => self.adaptive = factor,
            MotionAction::FeedStop(on) => self.feed_stop = on,
            MotionAction::Hold(on) => self.hold = on,
            MotionAction::Abort => self.abort = true,
            MotionAction::SpindleSpeed { spindle: 0, turns } => self.turns = Some(turns.abs()),
            MotionAction::SpindleSpeed { .. } => {}
        }
    }
}

impl<'a> Simulation<'a> {
    fn new(
        outcome: &Outcome,
        limits: &'a MotionLimits,
        circumstances: &'a RunConditions,
        report: &'a mut dyn FnMut(PlannedCycle<'_>) -> Result<(), String>,
    ) -> Result<Self, Stopped> {
        // What is not listed does not move, which is checked; a number there must be.
        let mut dynamics = Dynamics {
            velocity: [1.0; 9],
            acceleration: [1.0; 9],
            jerk: limits
                .axes
                .values()
                .any(|limit| limit.jerk.is_some())
                .then_some([f64::INFINITY; 9]),
            cycle: limits.period,
            queue: QUEUE,
        };
        for (axis, limit) in &limits.axes {
            let missing = |what: &str| Stopped::new(format!("the {what} of {axis} is not known"));
            dynamics.velocity[axis.place()] = limit.velocity.ok_or_else(|| missing("velocity"))?;
            dynamics.acceleration[axis.place()] =
                limit.acceleration.ok_or_else(|| missing("acceleration"))?;
            if let (Some(jerk), Some(limit)) = (&mut dynamics.jerk, limit.jerk) {
                jerk[axis.place()] = limit;
            }
        }
        let start = circumstances.start.to_array();
        let planner =
            Planner::new(dynamics, start).map_err(|error| Stopped::new(error.to_string()))?;
        let outputs = pins(outcome).into_iter().map(|pin| (pin, 0.0)).collect::<BTreeMap<_, _>>();
        let turning = follows_spindle(outcome);
        let mut resolver = Resolver::new(start);
        resolver.set(&outcome.start);
        Ok(Self {
            limits,
            every: circumstances.every,
            events: &circumstances.script.events,
            operator: Operator::AWAY,
            rests: 0.0,
            dwells: 0.0,
            resolver,
            settings: outcome.start.clone(),
            planner,
            follows: false,
            turning,
            turns: 0.0,
            input: InputParameter::default(),
            output: OutputParameter { position: start, ..OutputParameter::default() },
            outputs,
            feeds: vec![f64::NAN],
            lines: vec![0],
            origins: vec![0],
            step: 0,
            controls: Vec::new(),
            given: 0,
            cycles: 0,
            row: Vec::new(),
            report,
        })
    }

    /// Why it stopped, with the block: of a motion that takes too long the one in motion, else the one that was given.
    fn at_block(&self, stopped: Stopped, outcome: &Outcome, given: Option<&Step>) -> Stopped {
        let number = usize::try_from(self.output.segment).unwrap_or(0);
        let origin = self.origins.get(number).and_then(|place| outcome.steps.get(*place));
        let step = origin.filter(|_| stopped.too_long).or(given);
        Stopped { block: step.map(|step| step.block.clone()), ..stopped }
    }

    /// A spindle turns on until all is done that follows it: else nothing would bring the last of that to its end.
    fn set(&mut self, change: &Settings) -> Result<(), Stopped> {
        if self.follows {
            let mut after = self.settings.clone();
            after.overlay(change);
            if spindle(&after).to_bits() != spindle(&self.settings).to_bits() {
                self.rest()?;
            }
        }
        self.settings.overlay(change);
        self.resolver.set(change);
        Ok(())
    }

    fn perform(&mut self, line: u32, effect: &Effect) -> Result<(), Stopped> {
        let number = u32::try_from(self.lines.len()).unwrap_or(u32::MAX);
        let requested = self.resolver.resolve(number, effect);
        let is_element = is_element(effect);
        let done = self.ask(line, effect, requested);
        self.given += u32::from(is_element);
        done
    }

    fn ask(&mut self, line: u32, effect: &Effect, requested: MotionRequest) -> Result<(), Stopped> {
        match requested {
            MotionRequest::Move(segment) => self.queue(line, &segment),
            MotionRequest::WithNextMove(_) => self.with_next_move(effect),
            MotionRequest::Rest => {
                self.rest()?;
                self.apply_immediately(effect)
            }
            MotionRequest::Nothing => Ok(()),
            MotionRequest::Unplanned => {
                Err(Stopped::new(format!("{}: this motion cannot be planned", effect.name())))
            }
        }
    }

    /// The planner knows an output by its place among those of the program.
    fn with_next_move(&mut self, effect: &Effect) -> Result<(), Stopped> {
        let Some((pin, value, _)) = switching(effect) else { return Ok(()) };
        let place = self.outputs.keys().position(|known| *known == pin);
        let Some(output) = place.and_then(|place| u16::try_from(place).ok()) else { return Ok(()) };
        while !self.operator.abort
            && self.planner.queue_output(OutputSwitch { output, value }).is_err()
        {
            self.cycle()?;
        }
        Ok(())
    }

    fn queue(&mut self, line: u32, segment: &Segment) -> Result<(), Stopped> {
        self.check_axes(segment)?;
        if let Path::Dwell { seconds } = segment.path {
            self.dwells += seconds;
        }
        self.follows |= matches!(segment.feed, Feed::PerTurn(_));
        self.lines.push(line);
        self.origins.push(self.step);
        let controls = self.in_force();
        if self.controls.last() != Some(&controls) {
            self.planner.prevent_merge();
        }
        self.controls.push(controls);
        self.feeds.push(if let Feed::PerSecond(feed) = segment.feed { feed } else { f64::NAN });
        // Who rests while the next segment is still to come is not held by anybody.
        self.rests = 0.0;
        for _ in 0..self.every.unwrap_or(0) {
            self.cycle()?;
        }
        while !self.operator.abort {
            match self.planner.queue(segment) {
                Ok(()) => return Ok(()),
                Err(NotQueued::Full) => {
                    self.cycle()?;
                }
                Err(NotQueued::Malformed) => {
                    return Err(Stopped::new("a move without a feed, or beyond all numbers"));
                }
            }
        }
        Ok(())
    }

    /// What acts on a segment that is queued now. Nothing does on a thread, whose pitch follows the spindle.
    fn in_force(&self) -> Controls {
        if self.resolver.is_synchronised() {
            return Controls { feed_override: false, adaptive_feed: false, feed_stop: false };
        }
        let on = |switch: Option<Switch>| switch == Some(Switch::On);
        Controls {
            feed_override: on(self.settings.feed_override),
            adaptive_feed: on(self.settings.adaptive_feed),
            feed_stop: on(self.settings.feed_stop),
        }
    }

    /// Whether limits are known of all axes that a segment moves.
    fn check_axes(&self, segment: &Segment) -> Result<(), Stopped> {
        let (Path::Straight { end } | Path::Arc { end, .. }) = &segment.path else { return Ok(()) };
        let unknown =
            |axis: &&Axis| end[axis.place()].abs() > 0.0 && !self.limits.axes.contains_key(axis);
        match Axis::ALL.iter().find(unknown) {
            Some(axis) => {
                let letter = axis.to_string().to_ascii_uppercase();
                let why = format!("axis {letter} moves, but the machine has no limits for it");
                Err(Stopped { unlimited: Some(*axis), ..Stopped::new(why) })
            }
            None => Ok(()),
        }
    }

    /// Runs until everything that was requested is done.
    fn rest(&mut self) -> Result<(), Stopped> {
        while self.cycle()? != Phase::Idle {}
        self.follows = false;
        Ok(())
    }

    fn apply_immediately(&mut self, effect: &Effect) -> Result<(), Stopped> {
        if let Some((pin, value, OutputTiming::AtOnce)) = switching(effect)
            && !self.operator.abort
        {
            self.outputs.insert(pin, value);
            self.cycle()?;
        }
        Ok(())
    }

    fn cycle(&mut self) -> Result<Phase, Stopped> {
        if self.cycles >= SERVO_CYCLES_MAX {
            let why = format!("the motion takes more than {SERVO_CYCLES_MAX} servo cycles");
            return Err(Stopped { too_long: true, ..Stopped::endless(why) });
        }
        self.operate();
        let turns = self.operator.turns.unwrap_or_else(|| spindle(&self.settings));
        self.turns = turns;
        self.input.spindle_turns += turns * self.limits.period;
        let phase = self.planner.update(&self.input, &mut self.output);
        self.rests = if self.output.speed <= 0.0 { self.rests + 1.0 } else { 0.0 };
        if self.rests > MOST_REST + self.dwells / self.limits.period && self.events.is_empty() {
            return Err(Stopped::endless("it rests, and no event resumes it"));
        }
        let dwells = self.rests <= self.dwells / self.limits.period + 2.0;
        let stands = turns <= 0.0 && self.events.is_empty();
        if phase == Phase::Waiting && stands && self.follows && !dwells {
            return Err(Stopped::endless("it waits for a spindle that does not turn"));
        }
        while let Some(switch) = self.planner.next_switched_output() {
            if let Some((_, value)) = self.outputs.iter_mut().nth(usize::from(switch.output)) {
                *value = switch.value;
            }
        }
        self.record()?;
        Ok(phase)
    }

    /// The operator's requests for the next cycle, as far as the segment in execution admits them.
    fn operate(&mut self) {
        let cycle = self.cycles;
        while let Some((event, later)) = self.events.split_first()
            && usize::try_from(event.cycle).is_ok_and(|at| at <= cycle)
        {
            self.operator.does(event.action);
            self.events = later;
        }
        let number = usize::try_from(self.output.segment).unwrap_or(0).saturating_sub(1);
        let controls = self.controls.get(number).copied().unwrap_or_default();
        let operator = self.operator;
        self.input.feed_override = if controls.feed_override { operator.feed } else { 1.0 };
        self.input.rapid_override = operator.rapid;
        self.input.adaptive_feed = if controls.adaptive_feed { operator.adaptive } else { 1.0 };
        self.input.hold = if operator.abort {
            Hold::Abort
        } else if operator.hold || controls.feed_stop && operator.feed_stop {
            Hold::Hold
        } else {
            Hold::Run
        };
    }

    fn record(&mut self) -> Result<(), Stopped> {
        let number = usize::try_from(self.output.segment).unwrap_or(0);
        let line = self.lines.get(number).copied().unwrap_or(0);
        let position: &Axes = &self.output.position;
        self.row.clear();
        self.row.extend(self.limits.axes.keys().map(|axis| position[axis.place()]));
        self.row.extend([f64::from(line), f64::from(self.given)]);
        self.row.extend(self.outputs.values());
        self.row.extend(self.turning.then_some(self.turns));
        let overridden = match self.input.hold {
            Hold::Run => self.input.feed_override * self.input.adaptive_feed.abs().min(1.0),
            Hold::Hold | Hold::Abort => 0.0,
        };
        let requested = self.feeds.get(number).map_or(f64::NAN, |feed| feed * overridden);
        self.cycles += 1;
        let cycle = PlannedCycle { row: &self.row, speed: self.output.speed, requested };
        (self.report)(cycle).map_err(Stopped::new)
    }
}
