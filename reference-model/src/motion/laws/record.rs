//! What is judged: samples, path, limits and script, and what all laws need of them.

use gaugeblock_vocabulary::motion::{MotionAction, MotionLimits, MotionScript, ProgrammedPath};

use super::backwards::Backwards;
use super::easing::Easing;
use super::matching::{self, Matching, Measure};
use crate::Choices;
use crate::ids::choice::trajectory::ToleranceAtChange;
use crate::motion::envelope::Envelope;
use crate::motion::recording::Recording;
use crate::motion::route::Route;
use crate::motion::vector::{AxisVector, distance, last_place, minus};

/// How far a position may be off for its size: what positions lose on the way through a controller's arithmetic.
const RELATIVE: f64 = 1e-9;

/// Samples of one run and what they are held to.
pub(super) struct Record<'a> {
    /// Which reading of the documents holds.
    pub(super) choices: Choices,
    pub(super) recording: &'a Recording,
    pub(super) path: &'a ProgrammedPath,
    pub(super) limits: &'a MotionLimits,
    pub(super) envelope: Envelope,
    /// Seconds between samples.
    pub(super) period: f64,
    pub(super) requests: Requests,
    /// How far a position may be off because of how it is computed and written.
    pub(super) slack: f64,
    /// How far a motion can be from the chord between two samples: a·h²/8.
    pub(super) bulge: f64,
    /// Where the path may be followed backwards.
    pub(super) backwards: Backwards,
    /// Legs and corners, and the samples matched to them; or why they are not known.
    pub(super) matched: Result<(Route<'a>, Matching), String>,
}

/// The requests of the operator and the inputs that are in force from a sample on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Request {
    pub(super) from: usize,
    pub(super) feed_override: f64,
    pub(super) rapid_override: f64,
    pub(super) adaptive: f64,
    pub(super) feed_stop: bool,
    pub(super) hold: bool,
}

/// The requests of the operator and the inputs.
#[derive(Clone, Debug)]
pub(super) struct Requests {
    /// One from the first sample on, and one for each sample at which something changes.
    changes: Vec<Request>,
    /// The sample from which on the run is aborted.
    pub(super) aborted: Option<usize>,
    /// Changes of spindle speeds: sample, spindle, turns per second.
    pub(super) spindles: Vec<(usize, u8, f64)>,
}

impl Requests {
    fn of(script: &MotionScript, cycles_per_sample: f64, samples: usize) -> Self {
        let mut now = Request {
            from: 0,
            feed_override: 1.0,
            rapid_override: 1.0,
            adaptive: 1.0,
            feed_stop: false,
            hold: false,
        };
        let mut requests = Self { changes: vec![now], aborted: None, spindles: Vec::new() };
        let mut events = script.events.iter().peekable();
        let mut cycle = 0.0;
        for sample in 0..samples {
            if events.peek().is_none() {
                break;
            }
            let mut is_changed = false;
            while let Some(event) = events.next_if(|event| f64::from(event.cycle) <= cycle) {
                is_changed = true;
                match event.action {
                    MotionAction::FeedOverride(factor) => now.feed_override = factor,
                    MotionAction::RapidOverride(factor) => now.rapid_override = factor,
                    MotionAction::AdaptiveFeed(factor) => now.adaptive = factor,
                    MotionAction::FeedStop(on) => now.feed_stop = on,
                    MotionAction::Hold(on) => now.hold = on,
                    MotionAction::Abort => requests.aborted = requests.aborted.or(Some(sample)),
                    MotionAction::SpindleSpeed { spindle, turns } => {
                        requests.spindles.push((sample, spindle, turns));
                    }
                }
            }
            if is_changed {
                now.from = sample;
                let _replaced = requests.changes.pop_if(|earlier| earlier.from == sample);
                requests.changes.push(now);
            }
            cycle += cycles_per_sample;
        }
        requests
    }

    /// All of them: one from the first sample on, and one for each sample at which something changes.
    pub(super) fn changes(&self) -> &[Request] {
        &self.changes
    }

    /// Those in force at a sample.
    pub(super) fn at(&self, sample: usize) -> &Request {
        let later = self.changes.partition_point(|change| change.from <= sample);
        &self.changes[later.saturating_sub(1)]
    }

    /// Whether some of those in force between two samples, both included, are such.
    pub(super) fn any(&self, samples: (usize, usize), is_such: impl Fn(&Request) -> bool) -> bool {
        let (first, last) = samples;
        let later = self.changes.iter().filter(|change| first < change.from && change.from <= last);
        first <= last && std::iter::once(self.at(first)).chain(later).any(is_such)
    }
}

impl<'a> Record<'a> {
    /// Prepares a record that has a sample.
    pub(super) fn new(
        choices: Choices,
        recording: &'a Recording,
        path: &'a ProgrammedPath,
        limits: &'a MotionLimits,
        script: &MotionScript,
    ) -> Self {
        let (period, envelope) = (recording.period(), Envelope::of(limits));
        let size = recording.size();
        let slack = 3.0 * recording.resolution() + RELATIVE * size + 2.0 * last_place(size);
        let bulge = bulge(recording, &envelope);
        let requests = Requests::of(script, period / limits.period, recording.len());
        let backwards = backwards(recording, &requests, &envelope);
        let matched = Route::under(choices.get::<ToleranceAtChange>(), path).and_then(|route| {
            if route.legs.is_empty() {
                return Err("the path leads nowhere".to_owned());
            }
            let finished = requests.aborted.is_none();
            let measure = Measure { recording, slack, bulge, backwards: &backwards, finished };
            let matching = matching::matched(&route, measure);
            Ok((route, matching))
        });
        Self {
            choices,
            recording,
            path,
            limits,
            envelope,
            period,
            requests,
            slack,
            bulge,
            backwards,
            matched,
        }
    }

    /// How many samples there are.
    pub(super) fn len(&self) -> usize {
        self.recording.len()
    }

    /// The position at a sample.
    pub(super) fn point(&self, sample: usize) -> AxisVector {
        self.recording.point(sample)
    }

    /// The change of the position from the sample before to this one.
    pub(super) fn step(&self, sample: usize) -> AxisVector {
        minus(&self.point(sample), &self.point(sample - 1))
    }

    /// The speed from the sample before to this one, in all nine coordinates.
    pub(super) fn speed(&self, sample: usize) -> f64 {
        speed(self.recording, sample)
    }

    /// Whether an axis moves.
    pub(super) fn moves(&self, axis: usize) -> bool {
        self.recording.moved()[axis]
    }

    /// Whether the motion rests from the sample before to this one.
    pub(super) fn rests(&self, sample: usize) -> bool {
        sample > 0 && distance(&self.point(sample - 1), &self.point(sample)) <= self.slack
    }

    /// Whether a sample is at a point.
    pub(super) fn is_at(&self, sample: usize, point: &AxisVector) -> bool {
        distance(&self.point(sample), point) <= self.slack
    }

    /// Why the distance in which a motion can stop is not known, if it is not.
    pub(super) fn stopping_unknown(&self) -> Option<String> {
        let axis = self.envelope.unstated(|axis| self.moves(axis))?;
        Some(format!("no velocity and acceleration of {axis} are stated"))
    }
}

fn speed(recording: &Recording, sample: usize) -> f64 {
    if sample == 0 {
        return 0.0;
    }
    distance(&recording.point(sample - 1), &recording.point(sample)) / recording.period()
}

/// How far a motion under these limits can be from the chord between two samples. Where an axis moves that has no
/// limit: as far as the chord is long.
fn bulge(recording: &Recording, envelope: &Envelope) -> f64 {
    let moved = recording.moved();
    if envelope.unstated(|axis| moved[axis]).is_some() {
        let chord = |sample| distance(&recording.point(sample - 1), &recording.point(sample));
        return (1..recording.len()).map(chord).fold(0.0, f64::max);
    }
    let square: f64 = (0..9)
        .filter(|axis| moved[*axis])
        .map(|axis| envelope.acceleration[axis])
        .map(|a| a * a)
        .sum();
    let period = recording.period();
    crate::math::square_root(square) * period * period / 8.0
}

/// How much longer it takes to stop on a circle whose turning takes all of the acceleration at first than on a line:
/// the integral of 1/√(1 - u⁴) from 0 to 1.
const TURNING: f64 = 1.311_028_777;

/// Where the path may be followed backwards: while the adaptive feed requests it, and as long afterwards as it takes
/// to stop.
fn backwards(recording: &Recording, requests: &Requests, envelope: &Envelope) -> Backwards {
    let mut allowed = Backwards::default();
    if !requests.changes().iter().any(|request| request.adaptive < 0.0) {
        return allowed;
    }
    let moved = recording.moved();
    let mut left: f64 = 0.0;
    for sample in 0..recording.len() {
        if requests.at(sample).adaptive < 0.0 {
            let speed = speed(recording, sample);
            let easing = Easing::of(envelope, speed, |axis| moved[axis]);
            let braking = TURNING * easing.speed / easing.envelope.least();
            left = ((braking + easing.seconds) / recording.period()).ceil() + 2.0;
            if !left.is_finite() {
                left = 0.0;
            }
            allowed.add(sample);
        } else {
            if left > 0.0 {
                allowed.add(sample);
            }
            left -= 1.0;
        }
    }
    allowed
}
