//! What is judged: samples, path, limits and script, and what all laws need of them.

use gaugeblock_vocabulary::motion::{
    MotionAction, MotionLimits, MotionScript, ProgrammedPath, Samples,
};

use super::easing::Easing;
use super::matching::{self, Matching, Measure};
use crate::Choices;
use crate::ids::choice::trajectory::ToleranceAtChange;
use crate::motion::envelope::Envelope;
use crate::motion::route::Route;
use crate::motion::vector::{AxisVector, distance, last_place};

/// How far a position may be off for its size: what positions lose on the way through a controller's arithmetic.
const RELATIVE: f64 = 1e-9;

/// Samples of one run and what they are held to.
pub(super) struct Record<'a> {
    /// Which reading of the documents holds.
    pub(super) choices: Choices,
    pub(super) samples: &'a Samples,
    pub(super) path: &'a ProgrammedPath,
    pub(super) limits: &'a MotionLimits,
    pub(super) envelope: Envelope,
    /// Positions, sample by sample.
    pub(super) points: Vec<AxisVector>,
    /// Seconds between samples.
    pub(super) period: f64,
    /// The requests, sample by sample.
    pub(super) requests: Requests,
    /// How far a position may be off because of how it is computed and written.
    pub(super) slack: f64,
    /// How far a motion can be from the chord between two samples: a·h²/8.
    pub(super) bulge: f64,
    /// Whether the path may be followed backwards at a sample.
    pub(super) backwards: Vec<bool>,
    /// Legs and corners, and the samples matched to them; or why they are not known.
    pub(super) matched: Result<(Route<'a>, Matching), String>,
}

/// The requests of the operator and the inputs, sample by sample.
#[derive(Clone, Debug, Default)]
pub(super) struct Requests {
    pub(super) feed_override: Vec<f64>,
    pub(super) rapid_override: Vec<f64>,
    pub(super) adaptive: Vec<f64>,
    pub(super) feed_stop: Vec<bool>,
    pub(super) hold: Vec<bool>,
    /// The sample from which on the run is aborted.
    pub(super) aborted: Option<usize>,
    /// Changes of spindle speeds: sample, spindle, turns per second.
    pub(super) spindles: Vec<(usize, u8, f64)>,
}

impl Requests {
    fn of(script: &MotionScript, cycles_per_sample: f64, samples: usize) -> Self {
        let mut requests = Self::default();
        let mut events = script.events.iter().peekable();
        let (mut feed, mut rapid, mut adaptive, mut stop, mut hold) = (1.0, 1.0, 1.0, false, false);
        let mut cycle = 0.0;
        for sample in 0..samples {
            while let Some(event) = events.next_if(|event| f64::from(event.cycle) <= cycle) {
                match event.action {
                    MotionAction::FeedOverride(factor) => feed = factor,
                    MotionAction::RapidOverride(factor) => rapid = factor,
                    MotionAction::AdaptiveFeed(factor) => adaptive = factor,
                    MotionAction::FeedStop(on) => stop = on,
                    MotionAction::Hold(on) => hold = on,
                    MotionAction::Abort => requests.aborted = requests.aborted.or(Some(sample)),
                    MotionAction::SpindleSpeed { spindle, turns } => {
                        requests.spindles.push((sample, spindle, turns));
                    }
                }
            }
            requests.feed_override.push(feed);
            requests.rapid_override.push(rapid);
            requests.adaptive.push(adaptive);
            requests.feed_stop.push(stop);
            requests.hold.push(hold);
            cycle += cycles_per_sample;
        }
        requests
    }
}

impl<'a> Record<'a> {
    /// Prepares a record that has a sample.
    pub(super) fn new(
        choices: Choices,
        samples: &'a Samples,
        path: &'a ProgrammedPath,
        limits: &'a MotionLimits,
        script: &MotionScript,
    ) -> Self {
        let positions = samples.positions(path.start);
        let points: Vec<AxisVector> =
            positions.iter().map(|position| position.to_array()).collect();
        let (period, envelope) = (samples.period(), Envelope::of(limits));
        let size = points.iter().flatten().fold(1.0_f64, |size, value| size.max(value.abs()));
        let slack = 3.0 * samples.resolution() + RELATIVE * size + 2.0 * last_place(size);
        let bulge = bulge(&points, &envelope, period);
        let requests = Requests::of(script, period / limits.period, points.len());
        let backwards = backwards(&points, &requests, &envelope, period);
        let matched = Route::under(choices.get::<ToleranceAtChange>(), path).and_then(|route| {
            if route.legs.is_empty() {
                return Err("the path leads nowhere".to_owned());
            }
            let finished = requests.aborted.is_none();
            let measure =
                Measure { points: &points, slack, bulge, backwards: &backwards, finished };
            let matching = matching::matched(&route, measure);
            Ok((route, matching))
        });
        Self {
            choices,
            samples,
            path,
            limits,
            envelope,
            points,
            period,
            requests,
            slack,
            bulge,
            backwards,
            matched,
        }
    }

    /// The speed from the sample before to this one, in all nine coordinates.
    pub(super) fn speed(&self, sample: usize) -> f64 {
        if sample == 0 {
            return 0.0;
        }
        distance(&self.points[sample - 1], &self.points[sample]) / self.period
    }

    /// Whether an axis moves.
    pub(super) fn moves(&self, axis: usize) -> bool {
        self.points.iter().any(|point| point[axis].to_bits() != self.points[0][axis].to_bits())
    }

    /// Whether the motion rests from the sample before to this one.
    pub(super) fn rests(&self, sample: usize) -> bool {
        sample > 0 && distance(&self.points[sample - 1], &self.points[sample]) <= self.slack
    }

    /// Whether a sample is at a point.
    pub(super) fn is_at(&self, sample: usize, point: &AxisVector) -> bool {
        distance(&self.points[sample], point) <= self.slack
    }

    /// Why the distance in which a motion can stop is not known, if it is not.
    pub(super) fn stopping_unknown(&self) -> Option<String> {
        let axis = self.envelope.unstated(|axis| self.moves(axis))?;
        Some(format!("no velocity and acceleration of {axis} are stated"))
    }
}

/// How far a motion under these limits can be from the chord between two samples. Where an axis moves that has no
/// limit: as far as the chord is long.
fn bulge(points: &[AxisVector], envelope: &Envelope, period: f64) -> f64 {
    let moves =
        |axis: usize| points.iter().any(|point| point[axis].to_bits() != points[0][axis].to_bits());
    if envelope.unstated(moves).is_some() {
        let chords = points.windows(2).map(|pair| distance(&pair[0], &pair[1]));
        return chords.fold(0.0, f64::max);
    }
    let square: f64 = (0..9)
        .filter(|axis| moves(*axis))
        .map(|axis| envelope.acceleration[axis])
        .map(|a| a * a)
        .sum();
    crate::math::square_root(square) * period * period / 8.0
}

/// How much longer it takes to stop on a circle whose turning takes all of the acceleration at first than on a line:
/// the integral of 1/√(1 - u⁴) from 0 to 1.
const TURNING: f64 = 1.311_028_777;

/// Where the path may be followed backwards: while the adaptive feed requests it, and as long afterwards as it takes
/// to stop.
fn backwards(
    points: &[AxisVector],
    requests: &Requests,
    envelope: &Envelope,
    period: f64,
) -> Vec<bool> {
    let moves =
        |axis: usize| points.iter().any(|point| point[axis].to_bits() != points[0][axis].to_bits());
    let moved: [bool; 9] = std::array::from_fn(moves);
    let mut left: f64 = 0.0;
    let mut allowed = Vec::with_capacity(points.len());
    for (sample, adaptive) in requests.adaptive.iter().enumerate() {
        if *adaptive < 0.0 {
            let speed = if sample == 0 {
                0.0
            } else {
                distance(&points[sample - 1], &points[sample]) / period
            };
            let easing = Easing::of(envelope, speed, |axis| moved[axis]);
            let braking = TURNING * easing.speed / easing.envelope.least();
            left = ((braking + easing.seconds) / period).ceil() + 2.0;
            if !left.is_finite() {
                left = 0.0;
            }
            allowed.push(true);
        } else {
            allowed.push(left > 0.0);
            left -= 1.0;
        }
    }
    allowed
}
