//! The programmed path: what effects require of the axes, in machine coordinates.
//!
//! ```text
//! Sink::set ─────► Frame, feed, path mode       what is in force
//! Sink::perform ─► Resolver ─► MotionRequest    a segment to plan, an output to switch, or a wait for rest
//! ```
//!
//! Effects carry program coordinates in the active length unit. A planner takes machine coordinates: millimetres for
//! X Y Z U V W, degrees for A B C. The offsets, the rotation, the units, the plane, and the meaning of F are in
//! between.
//!
//! **Invariant:** nothing here looks ahead. A request follows from the effect and the settings in force.

mod arc;
mod frame;
#[cfg(test)]
mod tests;

use gaugeblock_vocabulary::{
    Effect, FeedMode, LengthUnit, OutputTiming, PathControlMode, Plane, Settings,
};

use gaugeblock_planner::{Axes, Feed, OutputSwitch, Path, PathControl, Segment};

use frame::Frame;

/// Axes that move less than this do not move, millimetres or degrees: offsets that are added and subtracted again
/// leave such a rest.
const MOTION_MIN: f64 = 1e-9;

/// A request to the motion planner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MotionRequest {
    /// To go along a segment, after those before it.
    Move(Segment),
    /// To switch an output with the start of the next segment (M62, M63, M67).
    WithNextMove(OutputSwitch),
    /// To come to rest first: what the effect does then is the caller's.
    Rest,
    /// Nothing; motion continues as if the effect were not there.
    Nothing,
    /// A motion whose effect does not include the path (G5 to G5.3), or which follows a spindle there and back
    /// (G33.1, G84).
    Unplanned,
}

/// Turns effects into requests to the axes.
///
/// ```
/// use gaugeblock_interpreter::path::{MotionRequest, Resolver};
/// use gaugeblock_planner::{PathControl, Feed, Path};
/// use gaugeblock_vocabulary::{Effect, FeedMode, LengthUnit, PathControlMode, Plane, Settings};
///
/// let mut resolver = Resolver::new([0.0; 9]);
/// resolver.set(&Settings {
///     units: Some(LengthUnit::Inch),
///     feed_rate: Some(6.0),
///     path: Some(PathControlMode::ExactStop),
///     ..Settings::default()
/// });
/// let end = [1.0, 0.0, 0.0, 90.0, 0.0, 0.0, 0.0, 0.0, 0.0];
/// let MotionRequest::Move(segment) = resolver.resolve(7, &Effect::StraightFeed { end: end.into() }) else { panic!() };
/// assert_eq!(segment.number, 7);
/// assert_eq!(segment.path, Path::Straight { end: [25.4, 0.0, 0.0, 90.0, 0.0, 0.0, 0.0, 0.0, 0.0] });
/// assert_eq!(segment.feed, Feed::PerSecond(6.0 * 25.4 / 60.0));
/// assert_eq!(segment.path_control, PathControl::ExactStop);
/// ```
#[derive(Clone, Debug)]
pub struct Resolver {
    frame: Frame,
    /// The controlled point, machine coordinates.
    at: Axes,
    feed_mode: FeedMode,
    /// As programmed: active unit per minute or per turn, or the inverse of minutes.
    feed_rate: f64,
    path: PathControlMode,
    /// Active unit; zero where G64 had no P.
    tolerance: f64,
    /// Millimetres a turn, between the start and the end of synchronised motion (G33, G76).
    pitch: Option<f64>,
}

impl Resolver {
    /// The settings after a controller is switched on: millimetres, XY, G94 without a rate, G64 without P, no offset.
    /// The controlled point is at `at`, machine coordinates.
    pub fn new(at: Axes) -> Self {
        Self {
            frame: Frame::default(),
            at,
            feed_mode: FeedMode::PerMinute,
            feed_rate: 0.0,
            path: PathControlMode::Continuous,
            tolerance: 0.0,
            pitch: None,
        }
    }

    /// The controlled point after all that was resolved, machine coordinates.
    pub fn position(&self) -> Axes {
        self.at
    }

    /// Whether moves follow the spindle turn by turn, so that no override may act on them (G33, G76).
    pub fn is_synchronised(&self) -> bool {
        self.pitch.is_some()
    }

    /// Sets the point: a probe has stopped a move on its way, or a run was aborted.
    pub fn set_position(&mut self, at: Axes) {
        self.at = at;
    }

    /// Takes over settings: those that are set in `changed`.
    pub fn set(&mut self, changed: &Settings) {
        self.frame.set(changed);
        self.feed_mode = changed.feed_mode.unwrap_or(self.feed_mode);
        self.feed_rate = changed.feed_rate.unwrap_or(self.feed_rate);
        self.path = changed.path.unwrap_or(self.path);
        self.tolerance = changed.blend_tolerance.unwrap_or(self.tolerance);
    }

    /// Returns what an effect requires. `line` becomes the segment's number.
    #[expect(clippy::wildcard_enum_match_arm, reason = "the other effects ask nothing of motion")]
    pub fn resolve(&mut self, line: u32, effect: &Effect) -> MotionRequest {
        match effect {
            Effect::StraightTraverse { end } => {
                let end = self.frame.machine_of(end.to_array());
                self.straight(line, end, Feed::Rapid, false)
            }
            Effect::StraightFeed { end } => {
                let end = self.frame.machine_of(end.to_array());
                let feed = self.feed(end);
                self.straight(line, end, feed, false)
            }
            Effect::StraightProbe { end, contact } => {
                let end = self.frame.machine_of(end.to_array());
                let feed = self.feed(end);
                let request = self.straight(line, end, feed, true);
                if let Some(contact) = contact {
                    self.at = self.frame.machine_of(contact.to_array());
                }
                request
            }
            Effect::ArcFeed { end, first_centre, second_centre, turns } => {
                let end = end.to_array();
                let path = self.frame.arc(&self.at, end, (*first_centre, *second_centre), *turns);
                let end = self.frame.machine_of(end);
                // An arc moves X Y Z, also where it ends at its start.
                let feed = self.feed_along(true);
                self.segment(line, path, end, feed, false)
            }
            Effect::Dwell { seconds } => {
                let path = Path::Dwell { seconds: *seconds };
                self.segment(line, path, self.at, Feed::Rapid, false)
            }
            Effect::SetDigitalOutput { output, on, timing } => {
                switch(*output, if *on { 1.0 } else { 0.0 }, *timing)
            }
            Effect::SetAnalogOutput { output, to, timing } => switch(*output, *to, *timing),
            Effect::StartSpindleSynchronisation { pitch, .. } => {
                self.pitch = Some(self.frame.millimetres(*pitch));
                MotionRequest::Rest
            }
            Effect::StopSpindleSynchronisation {} => {
                self.pitch = None;
                MotionRequest::Rest
            }
            Effect::NurbsFeed { end, .. } => {
                self.at = self.frame.machine_of(end.to_array());
                MotionRequest::Unplanned
            }
            Effect::RigidTap { .. } => MotionRequest::Unplanned,
            Effect::PrepareTool { .. }
            | Effect::SetToolEntry { .. }
            | Effect::Message { .. }
            | Effect::LogOpen { .. }
            | Effect::LogClose {}
            | Effect::ProbeLogOpen { .. }
            | Effect::ProbeLogClose {}
            | Effect::RequestRefused { .. } => MotionRequest::Nothing,
            _ => MotionRequest::Rest,
        }
    }

    fn straight(&mut self, line: u32, end: Axes, feed: Feed, probing: bool) -> MotionRequest {
        self.segment(line, Path::Straight { end }, end, feed, probing)
    }

    fn segment(
        &mut self,
        line: u32,
        path: Path,
        end: Axes,
        feed: Feed,
        probing: bool,
    ) -> MotionRequest {
        self.at = end;
        let path_control = self.path_control();
        MotionRequest::Move(Segment { number: line.into(), path, feed, path_control, probing })
    }

    fn path_control(&self) -> PathControl {
        match self.path {
            PathControlMode::ExactStop => PathControl::ExactStop,
            PathControlMode::ExactPath => PathControl::ExactPath,
            PathControlMode::Continuous if self.tolerance > 0.0 => {
                PathControl::Within(self.frame.millimetres(self.tolerance))
            }
            PathControlMode::Continuous => PathControl::BetweenMidpoints,
        }
    }

    /// The feed of a straight move to a point.
    fn feed(&self, end: Axes) -> Feed {
        let [x, y, z, _, _, _, u, v, w] = end;
        let [from_x, from_y, from_z, _, _, _, from_u, from_v, from_w] = self.at;
        let ways = [x - from_x, y - from_y, z - from_z, u - from_u, v - from_v, w - from_w];
        self.feed_along(ways.iter().any(|way| way.abs() > MOTION_MIN))
    }

    /// The meaning of F for a move (2.5.2.5, 11.5.59): a length of X Y Z where one of them moves, else of U V W, else
    /// degrees, which no unit changes.
    fn feed_along(&self, is_linear: bool) -> Feed {
        let along = |rate: f64| if is_linear { self.frame.millimetres(rate) } else { rate };
        if let Some(pitch) = self.pitch {
            return Feed::PerTurn(pitch);
        }
        match self.feed_mode {
            FeedMode::PerMinute => Feed::PerSecond(along(self.feed_rate) / 60.0),
            FeedMode::PerRevolution => Feed::PerTurn(along(self.feed_rate)),
            // "The move should be completed in [one divided by the F number] minutes."
            FeedMode::InverseTime => Feed::InTime(60.0 / self.feed_rate),
        }
    }
}

/// The request of an output's setting. M64, M65 and M68 act at once and interrupt the motion.
fn switch(output: i32, value: f64, timing: OutputTiming) -> MotionRequest {
    match (timing, u16::try_from(output)) {
        (OutputTiming::WithMotion, Ok(output)) => {
            MotionRequest::WithNextMove(OutputSwitch { output, value })
        }
        (OutputTiming::WithMotion, Err(_)) | (OutputTiming::AtOnce, _) => MotionRequest::Rest,
    }
}
