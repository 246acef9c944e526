//! How fast the path is passed.

use gaugeblock_vocabulary::Axis;
use gaugeblock_vocabulary::motion::{Column, Feed};

use super::matching::Matching;
use super::record::{Record, Request, Requests};
use super::verdict::{Findings, Law, Verdict, figure};
use crate::motion::recording::{Number, Paged};
use crate::motion::route::{Leg, Route};
use crate::motion::vector::{AxisVector, count};

const RELATIVE: f64 = 1e-9;

/// Rule trajectory.feed. The commanded point is no faster than the feed of the legs that it may be on, times the
/// overrides that act there: feed override (M50) and the size of the adaptive feed (M52). Under inverse time a leg
/// takes its time at least; per turn the spindle's speed counts. On a rapid leg no axis is faster than its limit
/// times the rapid override. What lowers an override lowers the allowed speed after the time that braking takes, and
/// two cycles.
pub(super) fn feed(record: &Record<'_>) -> Verdict {
    let (route, matching) = match &record.matched {
        Ok(matched) => matched,
        Err(why) => return Verdict::NotJudged(why.clone()),
    };
    let spindles = match Spindles::of(record, route) {
        Ok(spindles) => spindles,
        Err(why) => return Verdict::NotJudged(why),
    };
    let settled = Settled::of(record, (route, matching));
    let hidden = 4.0 * record.recording.resolution() / record.period;
    let mut findings = Findings::of(Law::Feed);
    for sample in 1..record.len() {
        let chord = record.step(sample);
        let ((first, last), here) = (matching.legs(sample - 1), matching.legs(sample));
        let legs = first.min(here.0)..=last.max(here.1);
        let legs: Vec<&Leg<'_>> = route.legs[legs].iter().collect();
        let is_rapid = |leg: &&Leg<'_>| leg.element.feed == Feed::Rapid;
        let spindle = |number| spindles.turns(number, sample);
        let allowed_speeds = legs.iter().filter(|leg| !is_rapid(leg)).map(|leg| {
            let measured = leg.curve.counted().length(&chord) / record.period;
            (measured, settled.factor(leg, sample) * speed(leg, spindle), leg)
        });
        // It is enough if one leg allows it: between two of them the chord is neither's.
        let excess = |(measured, limit, _): &(f64, f64, &&Leg<'_>)| measured - limit;
        let off = 4.0 * (record.recording.resolution() + RELATIVE * 1e-3) / record.period;
        let least = allowed_speeds.min_by(|a, b| excess(a).total_cmp(&excess(b)));
        let allows =
            least.is_some_and(|(measured, limit, _)| measured <= limit * (1.0 + RELATIVE) + off);
        if !allows && legs.iter().any(is_rapid) {
            rapid(record, sample, &chord, settled.rapid.at(sample), &mut findings);
            continue;
        }
        let Some((measured, limit, leg)) = least else { continue };
        // A feed per turn changes with the spindle, and an override may be zero.
        findings.hides(hidden, speed(leg, |_| 0.0), &|| "per second".to_owned());
        let words = || {
            format!(
                "{measured} per second at {} where {limit} are allowed",
                leg.element.block,
                measured = figure(measured),
                limit = figure(limit)
            )
        };
        findings.at_most(sample, None, (measured, limit * (1.0 + RELATIVE) + off), (limit, &words));
    }
    findings.verdict()
}

/// The programmed speed of a leg, millimetres or degrees per second.
fn speed(leg: &Leg<'_>, turns: impl Fn(u8) -> f64) -> f64 {
    match leg.element.feed {
        Feed::Rapid => f64::INFINITY,
        Feed::PerSecond(rate) => rate,
        Feed::InTime(seconds) => leg.curve.feed_length() / seconds,
        Feed::PerTurn { spindle, length } => length * turns(spindle),
    }
}

fn rapid(
    record: &Record<'_>,
    sample: usize,
    chord: &AxisVector,
    factor: f64,
    findings: &mut Findings,
) {
    for axis in Axis::ALL.iter().copied() {
        let limit = record.envelope.velocity[axis.place()] * factor;
        let measured = chord[axis.place()].abs() / record.period;
        if measured == 0.0 || !limit.is_finite() {
            continue;
        }
        let off = 2.0 * (record.recording.resolution() + RELATIVE * 1e-3) / record.period;
        let words = || {
            format!(
                "{axis} makes {measured} per second in a rapid where {limit} are allowed",
                measured = figure(measured),
                limit = figure(limit)
            )
        };
        findings.at_most(
            sample,
            Some(axis),
            (measured, limit * (1.0 + RELATIVE) + off),
            (limit, &words),
        );
    }
}

/// Overrides after what braking takes.
struct Settled<'a> {
    feed: Factor<'a>,
    adaptive: Factor<'a>,
    rapid: Factor<'a>,
}

/// The size of an override, which counts as it was for as long as braking takes.
struct Factor<'a> {
    requests: &'a Requests,
    of: fn(&Request) -> f64,
    kept: Vec<Kept>,
}

/// A size that counts from a sample on, for so many samples.
struct Kept {
    from: usize,
    samples: f64,
    size: f64,
}

impl<'a> Factor<'a> {
    fn of(
        record: &'a Record<'_>,
        matched: (&Route<'_>, &Matching),
        of: fn(&Request) -> f64,
    ) -> Self {
        let mut factor = Self { requests: &record.requests, of, kept: Vec::new() };
        for pair in record.requests.changes().windows(2) {
            if of(&pair[1]).abs() >= of(&pair[0]).abs() {
                continue;
            }
            let sample = pair[1].from;
            let fastest = record.speed(sample).max(record.speed(sample - 1));
            let stop = record.granted_stop(matched, sample, fastest);
            let samples = (stop.seconds / record.period).ceil() + 2.0;
            let size = factor.at(sample - 1);
            factor.kept.push(Kept { from: sample, samples, size });
        }
        factor
    }

    fn at(&self, sample: usize) -> f64 {
        let counts = |kept: &&Kept| kept.from <= sample && count(sample - kept.from) < kept.samples;
        let now = (self.of)(self.requests.at(sample)).abs();
        self.kept.iter().filter(counts).map(|kept| kept.size).fold(now, f64::max)
    }
}

impl<'a> Settled<'a> {
    fn of(record: &'a Record<'_>, matched: (&Route<'_>, &Matching)) -> Self {
        let settle = |of: fn(&Request) -> f64| Factor::of(record, matched, of);
        Self {
            feed: settle(|request| request.feed_override),
            adaptive: settle(|request| request.adaptive),
            rapid: settle(|request| request.rapid_override),
        }
    }

    /// Rules overrides.feed-no-influence and overrides.adaptive-feed-no-influence. What is disabled has no influence.
    fn factor(&self, leg: &Leg<'_>, sample: usize) -> f64 {
        let controls = leg.element.controls;
        let of = |acts: bool, factor: &Factor<'_>| if acts { factor.at(sample) } else { 1.0 };
        of(controls.feed_override, &self.feed) * of(controls.adaptive_feed, &self.adaptive)
    }
}

/// Speeds of the spindles that legs follow.
struct Spindles<'a> {
    speeds: Vec<(u8, Turns<'a>)>,
}

/// Turns per second of a spindle.
enum Turns<'a> {
    Recorded(&'a Paged<Number>),
    /// From a sample on.
    Requested(Vec<(usize, f64)>),
}

impl Turns<'_> {
    fn at(&self, sample: usize) -> f64 {
        match self {
            Turns::Recorded(turns) => turns.get(sample).abs(),
            Turns::Requested(changes) => {
                let later = changes.partition_point(|(from, _)| *from <= sample);
                changes[..later].last().map_or(0.0, |(_, speed)| speed.abs())
            }
        }
    }
}

impl<'a> Spindles<'a> {
    fn of(record: &'a Record<'_>, route: &Route<'_>) -> Result<Self, String> {
        let mut speeds: Vec<(u8, Turns<'a>)> = Vec::new();
        for leg in &route.legs {
            let Feed::PerTurn { spindle, .. } = leg.element.feed else { continue };
            if speeds.iter().any(|(known, _)| *known == spindle) {
                continue;
            }
            let Some(turns) = Self::known(record, spindle) else {
                return Err(format!(
                    "the speed of spindle {spindle}, which the feed follows, is not recorded"
                ));
            };
            speeds.push((spindle, turns));
        }
        Ok(Self { speeds })
    }

    fn known(record: &'a Record<'_>, spindle: u8) -> Option<Turns<'a>> {
        if let Some(turns) = record.recording.column(Column::SpindleSpeed(spindle)) {
            return Some(Turns::Recorded(turns));
        }
        let changes = record.requests.spindles.iter().filter(|(_, number, _)| *number == spindle);
        let changes: Vec<_> = changes.map(|(from, _, speed)| (*from, *speed)).collect();
        (!changes.is_empty()).then_some(Turns::Requested(changes))
    }

    fn turns(&self, spindle: u8, sample: usize) -> f64 {
        let known = self.speeds.iter().find(|(number, _)| *number == spindle);
        known.map_or(0.0, |(_, turns)| turns.at(sample).max(turns.at(sample.saturating_sub(1))))
    }
}
