//! The production planner, driven through the effects of a program.

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_impl::Planner;
use gaugeblock_impl::path::{Asked, Resolver};
use gaugeblock_impl::plan::{Axes, Dynamics, Feed, InputParameter, NotQueued, OutputParameter};
use gaugeblock_impl::plan::{OutputSwitch, Path, Phase, Segment};
use gaugeblock_trace::motion::{Column, MotionLimits, Samples};
use gaugeblock_trace::{
    Axis, Block, Effect, Event, FeedMode, Outcome, OutputTiming, Pin, Settings, SpindleTurn,
};

/// How many segments the planner's queue holds.
const QUEUE: u32 = 2000;
/// Longest motion, servo cycles: more than a day of milliseconds.
const MOST_CYCLES: usize = 100_000_000;

/// What a planner makes of a program.
#[derive(Clone, Debug)]
pub struct Planned {
    /// A sample for each servo cycle, the first one before the motion.
    pub samples: Samples,
    /// Speed along the path of all axes by sample, millimetres or degrees per second.
    pub speed: Vec<f64>,
    /// The feed that is programmed for the segment, likewise; not a number in rapid moves and where it follows from a time or a spindle.
    pub asked: Vec<f64>,
}

/// Why a program is not planned to its end, and at which block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stopped {
    /// Where.
    pub block: Option<Block>,
    /// Why.
    pub why: String,
}

impl Stopped {
    fn new(why: impl Into<String>) -> Self {
        Self { block: None, why: why.into() }
    }
}

/// Plans what a program does, from the machine's origin. With `every` the planner gets one segment in so many cycles, else as many as it takes.
///
/// # Errors
/// An axis moves of which no limits are known, or what is asked for is no motion of a planner: a spline, a rigid tap, a thread on a spindle
/// that stands.
pub fn plan(
    outcome: &Outcome,
    limits: &MotionLimits,
    every: Option<u32>,
) -> Result<Planned, Stopped> {
    let mut drive = Drive::new(outcome, limits, every)?;
    for step in &outcome.steps {
        for event in &step.events {
            let done = match event {
                Event::Set(change) => {
                    drive.set(change);
                    Ok(())
                }
                Event::Do(effect) => drive.perform(step.block.line, effect),
            };
            done.map_err(|stopped| Stopped { block: Some(step.block.clone()), ..stopped })?;
        }
    }
    drive.rest()?;
    Ok(Planned { samples: drive.samples, speed: drive.speed, asked: drive.asked })
}

struct Drive<'a> {
    limits: &'a MotionLimits,
    every: Option<u32>,
    resolver: Resolver,
    settings: Settings,
    planner: Planner,
    input: InputParameter,
    output: OutputParameter,
    outputs: BTreeMap<Pin, f64>,
    /// The feed of each segment by its number.
    feeds: Vec<f64>,
    /// The lines of the segments.
    lines: Vec<u32>,
    /// How many elements of the path the planner has been given, moves and rests.
    given: u32,
    samples: Samples,
    speed: Vec<f64>,
    asked: Vec<f64>,
}

impl<'a> Drive<'a> {
    fn new(
        outcome: &Outcome,
        limits: &'a MotionLimits,
        every: Option<u32>,
    ) -> Result<Self, Stopped> {
        // What is not listed does not move, which is checked; a number there must be.
        let mut dynamics = Dynamics {
            velocity: [1.0; 9],
            acceleration: [1.0; 9],
            jerk: None,
            cycle: limits.period,
            queue: QUEUE,
        };
        for (axis, limit) in &limits.axes {
            let missing = |what: &str| Stopped::new(format!("the {what} of {axis} is not known"));
            dynamics.velocity[axis.place()] = limit.velocity.ok_or_else(|| missing("velocity"))?;
            dynamics.acceleration[axis.place()] =
                limit.acceleration.ok_or_else(|| missing("acceleration"))?;
        }
        let planner =
            Planner::new(dynamics, [0.0; 9]).map_err(|error| Stopped::new(error.to_string()))?;
        let outputs = pins(outcome).into_iter().map(|pin| (pin, 0.0)).collect::<BTreeMap<_, _>>();
        let columns = limits.axes.keys().copied().map(Column::Position);
        let columns = columns.chain([Column::Line, Column::Queued]);
        let columns = columns.chain(outputs.keys().copied().map(Column::Output)).collect();
        let samples = Samples::new(limits.period, 0.0, columns)
            .map_err(|error| Stopped::new(error.to_string()))?;
        let mut resolver = Resolver::new([0.0; 9]);
        resolver.set(&outcome.start);
        let mut drive = Self {
            limits,
            every,
            resolver,
            settings: outcome.start.clone(),
            planner,
            input: InputParameter::default(),
            output: OutputParameter::default(),
            outputs,
            feeds: vec![f64::NAN],
            lines: vec![0],
            given: 0,
            samples,
            speed: Vec::new(),
            asked: Vec::new(),
        };
        drive.record()?;
        Ok(drive)
    }

    fn set(&mut self, change: &Settings) {
        self.settings.overlay(change);
        self.resolver.set(change);
    }

    fn perform(&mut self, line: u32, effect: &Effect) -> Result<(), Stopped> {
        let number = u32::try_from(self.lines.len()).unwrap_or(u32::MAX);
        let asked = self.resolver.resolve(number, effect);
        let is_element = is_element(effect);
        let done = self.ask(line, effect, asked);
        self.given += u32::from(is_element);
        done
    }

    fn ask(&mut self, line: u32, effect: &Effect, asked: Asked) -> Result<(), Stopped> {
        match asked {
            Asked::Move(segment) => self.queue(line, &segment),
            Asked::WithNextMove(_) => self.with_next_move(effect),
            Asked::Rest => {
                self.rest()?;
                self.at_once(effect)
            }
            Asked::Nothing => Ok(()),
            Asked::Unplanned => {
                Err(Stopped::new(format!("{} is no motion that can be planned", effect.name())))
            }
        }
    }

    /// The planner knows an output by its place among those of the program.
    fn with_next_move(&mut self, effect: &Effect) -> Result<(), Stopped> {
        let Some((pin, value, _)) = switching(effect) else { return Ok(()) };
        let place = self.outputs.keys().position(|known| *known == pin);
        let Some(output) = place.and_then(|place| u16::try_from(place).ok()) else { return Ok(()) };
        while self.planner.switch(OutputSwitch { output, value }).is_err() {
            self.cycle()?;
        }
        Ok(())
    }

    fn queue(&mut self, line: u32, segment: &Segment) -> Result<(), Stopped> {
        self.check_axes(segment)?;
        self.lines.push(line);
        self.feeds.push(if let Feed::PerSecond(feed) = segment.feed { feed } else { f64::NAN });
        for _ in 0..self.every.unwrap_or(0) {
            self.cycle()?;
        }
        loop {
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
    }

    /// Whether limits are known of all axes that a segment moves.
    fn check_axes(&self, segment: &Segment) -> Result<(), Stopped> {
        let (Path::Straight { end } | Path::Arc { end, .. }) = &segment.path else { return Ok(()) };
        let unknown =
            |axis: &&Axis| end[axis.place()].abs() > 0.0 && !self.limits.axes.contains_key(axis);
        match Axis::ALL.iter().find(unknown) {
            Some(axis) => Err(Stopped::new(format!("{axis} moves, and its limits are not known"))),
            None => Ok(()),
        }
    }

    /// Goes on until everything is done that was asked for.
    fn rest(&mut self) -> Result<(), Stopped> {
        while self.cycle()? != Phase::Idle {}
        Ok(())
    }

    fn at_once(&mut self, effect: &Effect) -> Result<(), Stopped> {
        if let Some((pin, value, OutputTiming::AtOnce)) = switching(effect) {
            self.outputs.insert(pin, value);
            self.cycle()?;
        }
        Ok(())
    }

    fn cycle(&mut self) -> Result<Phase, Stopped> {
        if self.speed.len() >= MOST_CYCLES {
            return Err(Stopped::new("it takes more than a hundred million servo cycles"));
        }
        let turns = self.spindle();
        self.input.spindle_turns += turns * self.limits.period;
        let phase = self.planner.update(&self.input, &mut self.output);
        if phase == Phase::Waiting && turns <= 0.0 && !self.dwells() {
            return Err(Stopped::new("it follows a spindle that stands"));
        }
        while let Some(switch) = self.planner.switched() {
            if let Some((_, value)) = self.outputs.iter_mut().nth(usize::from(switch.output)) {
                *value = switch.value;
            }
        }
        self.record()?;
        Ok(phase)
    }

    /// Turns per second of the first spindle.
    fn spindle(&self) -> f64 {
        let turn = self.settings.spindle.as_ref().and_then(|spindles| spindles.0.get(&0));
        let speed = self.settings.spindle_speed.as_ref().and_then(|speeds| speeds.0.get(&0));
        let turns = matches!(turn, Some(SpindleTurn::Clockwise | SpindleTurn::Counterclockwise));
        if turns { speed.copied().unwrap_or(0.0).abs() / 60.0 } else { 0.0 }
    }

    /// Whether the segment that is executed follows no spindle.
    fn dwells(&self) -> bool {
        self.settings.feed_mode != Some(FeedMode::PerRevolution)
    }

    fn record(&mut self) -> Result<(), Stopped> {
        let number = usize::try_from(self.output.segment).unwrap_or(0);
        let line = self.lines.get(number).copied().unwrap_or(0);
        let position: &Axes = &self.output.position;
        let mut row: Vec<f64> =
            self.limits.axes.keys().map(|axis| position[axis.place()]).collect();
        row.push(f64::from(line));
        row.push(f64::from(self.given));
        row.extend(self.outputs.values());
        self.samples.push(&row).map_err(|error| Stopped::new(error.to_string()))?;
        self.speed.push(self.output.speed);
        self.asked.push(self.feeds.get(number).copied().unwrap_or(f64::NAN));
        Ok(())
    }
}

/// Whether an effect is an element of the path: a move, or something for which the motion rests.
fn is_element(effect: &Effect) -> bool {
    match effect {
        Effect::StraightTraverse { .. }
        | Effect::StraightFeed { .. }
        | Effect::ArcFeed { .. }
        | Effect::NurbsFeed { .. }
        | Effect::StraightProbe { .. }
        | Effect::RigidTap { .. }
        | Effect::Dwell { .. }
        | Effect::PromptTool { .. }
        | Effect::ChangeTool { .. }
        | Effect::WaitOrient { .. }
        | Effect::WaitInput { .. }
        | Effect::UserCode { .. }
        | Effect::Stop { .. }
        | Effect::PalletShuttle {}
        | Effect::ProgramEnd {} => true,
        Effect::SetDigitalOutput { timing, .. } | Effect::SetAnalogOutput { timing, .. } => {
            *timing == OutputTiming::AtOnce
        }
        Effect::StartSpindleSynchronisation { .. }
        | Effect::StopSpindleSynchronisation {}
        | Effect::PrepareTool { .. }
        | Effect::SetToolNumber { .. }
        | Effect::SetToolEntry { .. }
        | Effect::OrientSpindle { .. }
        | Effect::Message { .. }
        | Effect::LogOpen { .. }
        | Effect::LogClose {}
        | Effect::ProbeLogOpen { .. }
        | Effect::ProbeLogClose {}
        | Effect::ChangeControllerMode { .. }
        | Effect::RequestRefused { .. } => false,
    }
}

/// The outputs that a program switches.
fn pins(outcome: &Outcome) -> BTreeSet<Pin> {
    let events = outcome.steps.iter().flat_map(|step| &step.events);
    let effects =
        events.filter_map(|event| if let Event::Do(effect) = event { Some(effect) } else { None });
    effects.filter_map(switching).map(|(pin, ..)| pin).collect()
}

/// Which output an effect switches, to what, and when.
#[expect(clippy::wildcard_enum_match_arm, reason = "the other effects switch no output")]
fn switching(effect: &Effect) -> Option<(Pin, f64, OutputTiming)> {
    let (pin, output, value, timing): (fn(u16) -> Pin, _, _, _) = match effect {
        Effect::SetDigitalOutput { output, on, timing } => {
            (Pin::DigitalOut, *output, f64::from(u8::from(*on)), *timing)
        }
        Effect::SetAnalogOutput { output, to, timing } => (Pin::AnalogOut, *output, *to, *timing),
        _ => return None,
    };
    Some((pin(u16::try_from(output).ok()?), value, timing))
}
