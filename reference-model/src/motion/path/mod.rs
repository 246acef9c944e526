//! The path that a program requests: effects with the active settings, in machine coordinates.
//!
//! An outcome has program coordinates in the active length unit; here offsets, rotation, tool offset, units, planes
//! and feed modes are resolved. What breaks the path (a dwell, a wait, an output that switches at once) is an element
//! of its own.

mod arc;
mod frame;
mod same;

use gaugeblock_vocabulary::motion::{
    Controls, Feed, OutputChange, PathElement, PathMode, ProgrammedPath, Shape,
};
use gaugeblock_vocabulary::{
    BlockLocation, Effect, Event, FeedMode, Outcome, OutputTiming, PathControlMode, Pin, Position,
    Settings, Switch,
};

use crate::motion::curve::{Counted, Curve};
pub use same::{Difference, differ};

/// The path that an outcome requests, from the position of the machine before it: machine coordinates, millimetres and
/// degrees.
///
/// An arc that no circle describes, and a spline, whose control points an outcome does not have, are curves of which
/// only the end is known. So is a rigid tap, which overshoots by what the spindle needs to reverse.
pub fn programmed(outcome: &Outcome, start: Position) -> ProgrammedPath {
    let mut walk = Walk {
        settings: outcome.start.clone(),
        here: start,
        pitch: None,
        waiting: Vec::new(),
        path: ProgrammedPath { start, ..ProgrammedPath::default() },
    };
    for step in &outcome.steps {
        for event in &step.events {
            match event {
                Event::Set(change) => walk.settings.overlay(change),
                Event::Do(effect) => walk.perform(effect, &step.block),
                Event::Unknown(_) => {}
            }
        }
    }
    walk.path.never = walk.waiting;
    walk.path
}

/// A walk through the effects of a run.
struct Walk {
    /// The settings in force.
    settings: Settings,
    /// Where the machine is.
    here: Position,
    /// Spindle and millimetres per turn while feed is synchronised with it.
    pitch: Option<(u8, f64)>,
    /// Outputs that wait for the next motion, one setting for each.
    waiting: Vec<OutputChange>,
    /// The path so far.
    path: ProgrammedPath,
}

impl Walk {
    fn perform(&mut self, effect: &Effect, block: &BlockLocation) {
        match effect {
            Effect::StraightTraverse { end } => {
                let end = self.to(*end);
                self.moves(Shape::Straight { end }, Feed::Rapid, block);
            }
            Effect::StraightFeed { end } => {
                let end = self.to(*end);
                self.feeds(Shape::Straight { end }, block);
            }
            Effect::ArcFeed { .. } => {
                self.feeds(arc::shape(self.here, effect, &self.settings), block);
            }
            Effect::NurbsFeed { end, .. } => {
                let end = self.to(*end);
                self.feeds(Shape::Curve { end }, block);
            }
            Effect::StraightProbe { end, contact } => {
                let (end, contact) = (self.to(*end), contact.map(|contact| self.to(contact)));
                self.feeds(Shape::Probe { end, contact }, block);
            }
            Effect::RigidTap { .. } => self.feeds(Shape::Curve { end: self.here }, block),
            Effect::StartSpindleSynchronisation { spindle, pitch } => {
                let spindle = u8::try_from(*spindle).unwrap_or(u8::MAX);
                self.pitch = Some((spindle, pitch * frame::unit(&self.settings)));
            }
            Effect::StopSpindleSynchronisation {} => self.pitch = None,
            Effect::Dwell { seconds } => self.stands(Shape::Dwell { seconds: *seconds }, block),
            Effect::SetDigitalOutput { output, on, timing } => {
                let value = if *on { 1.0 } else { 0.0 };
                self.output((*output, Pin::DigitalOut), value, *timing, block);
            }
            Effect::SetAnalogOutput { output, to, timing } => {
                self.output((*output, Pin::AnalogOut), *to, *timing, block);
            }
            // The axes rest until these are done; no document limits the time that they take.
            Effect::PromptTool { .. }
            | Effect::ChangeTool { .. }
            | Effect::WaitOrient { .. }
            | Effect::WaitInput { .. }
            | Effect::UserCode { .. }
            | Effect::Stop { .. }
            | Effect::PalletShuttle {}
            | Effect::ProgramEnd {} => {
                let for_what = effect.name().to_owned();
                self.stands(Shape::Wait { for_what }, block);
            }
            // These do not touch the axes.
            Effect::PrepareTool { .. }
            | Effect::SetToolNumber { .. }
            | Effect::SetToolEntry { .. }
            | Effect::OrientSpindle { .. }
            | Effect::Message { .. }
            | Effect::LogOpen { .. }
            | Effect::LogClose {}
            | Effect::ProbeLogOpen { .. }
            | Effect::ProbeLogClose {}
            | Effect::ChangeControllerMode { .. }
            | Effect::RequestRefused { .. } => (),
        }
    }

    /// Rules outputs.at-next-motion, outputs.latest-counts and outputs.without-motion. An output of M62, M63 or M67
    /// switches where the next motion starts, the latest setting of each counts, and one without a motion after it
    /// never switches. Rules outputs.on-at-once and outputs.off-at-once. One of M64, M65 or M68 switches before
    /// anything else moves.
    fn output(
        &mut self,
        (number, pin): (i32, fn(u16) -> Pin),
        value: f64,
        timing: OutputTiming,
        block: &BlockLocation,
    ) {
        let Ok(number) = u16::try_from(number) else { return };
        let switching = OutputChange { pin: pin(number), value };
        match timing {
            OutputTiming::AtOnce => self.stands(Shape::AtOnce(switching), block),
            OutputTiming::WithMotion => {
                self.waiting.retain(|earlier| earlier.pin != switching.pin);
                self.waiting.push(switching);
            }
        }
    }

    /// A program point on the machine, without the rounding of offsets.
    fn to(&self, program: Position) -> Position {
        frame::settled(self.here, frame::on_machine(program, &self.settings))
    }

    fn feeds(&mut self, shape: Shape, block: &BlockLocation) {
        let feed = self.feed(&shape);
        self.moves(shape, feed, block);
    }

    fn moves(&mut self, shape: Shape, feed: Feed, block: &BlockLocation) {
        let switches = std::mem::take(&mut self.waiting);
        let element = self.element(shape, feed, switches, block);
        self.here = element.end().unwrap_or(self.here);
        self.path.elements.push(element);
    }

    fn stands(&mut self, shape: Shape, block: &BlockLocation) {
        let element = self.element(shape, Feed::Rapid, Vec::new(), block);
        self.path.elements.push(element);
    }

    fn element(
        &self,
        shape: Shape,
        feed: Feed,
        switches: Vec<OutputChange>,
        block: &BlockLocation,
    ) -> PathElement {
        let on = |switch: Option<Switch>| switch == Some(Switch::On);
        let controls = Controls {
            feed_override: on(self.settings.feed_override),
            adaptive_feed: on(self.settings.adaptive_feed),
            feed_stop: on(self.settings.feed_stop),
        };
        PathElement { block: block.clone(), shape, feed, mode: self.mode(), controls, switches }
    }

    /// Rules feed.per-minute, feed.inverse-time and feed.per-revolution. G94 counts lengths or degrees a minute, G93
    /// gives the whole move a part of a minute, G95 counts lengths a turn of the spindle. No
    /// setting reports which spindle G95 follows: the first one is assumed.
    fn feed(&self, shape: &Shape) -> Feed {
        let rate = self.settings.feed_rate.unwrap_or(0.0);
        let turns_only = Curve::of(self.here, shape)
            .is_some_and(|curve| !curve.is_empty() && curve.counted() == Counted::Rotary);
        let size = if turns_only { 1.0 } else { frame::unit(&self.settings) };
        if let Some((spindle, length)) = self.pitch {
            return Feed::PerTurn { spindle, length };
        }
        match self.settings.feed_mode.unwrap_or(FeedMode::PerMinute) {
            FeedMode::PerMinute => Feed::PerSecond(rate * size / 60.0),
            FeedMode::InverseTime => Feed::InTime(60.0 / rate),
            FeedMode::PerRevolution => Feed::PerTurn { spindle: 0, length: rate * size },
        }
    }

    /// Rules path-control.exact-path, path-control.exact-stop, path-control.tolerance and
    /// path-control.without-tolerance.
    fn mode(&self) -> PathMode {
        let size = frame::unit(&self.settings);
        let tolerance = self.settings.blend_tolerance.unwrap_or(0.0) * size;
        match self.settings.path.unwrap_or(PathControlMode::Continuous) {
            PathControlMode::ExactStop => PathMode::ExactStop,
            PathControlMode::ExactPath => PathMode::ExactPath,
            PathControlMode::Continuous if tolerance > 0.0 => {
                let merge = self.settings.naive_cam_tolerance.unwrap_or(0.0) * size;
                PathMode::Within { tolerance, merge: merge.max(0.0) }
            }
            PathControlMode::Continuous => PathMode::BetweenMidpoints,
        }
    }
}

#[cfg(test)]
mod tests;
