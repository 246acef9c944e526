//! How fast the path is passed.

use gaugeblock_vocabulary::Axis;
use gaugeblock_vocabulary::motion::{Column, Feed};

use super::matching::Matching;
use super::record::Record;
use super::verdict::{Findings, Law, Verdict, figure};
use crate::motion::route::{Leg, Route};
use crate::motion::vector::{AxisVector, minus};

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
    let settled = Settled::of(record, route, matching);
    let hidden = 4.0 * record.samples.resolution() / record.period;
    let mut findings = Findings::of(Law::Feed);
    for sample in 1..record.points.len() {
        let chord = minus(&record.points[sample], &record.points[sample - 1]);
        let (first, last) = matching.legs[sample - 1];
        let legs = first.min(matching.legs[sample].0)..=last.max(matching.legs[sample].1);
        let legs: Vec<&Leg<'_>> = route.legs[legs].iter().collect();
        let is_rapid = |leg: &&Leg<'_>| leg.element.feed == Feed::Rapid;
        let spindle = |number| spindles.turns(number, sample);
        let allowed_speeds = legs.iter().filter(|leg| !is_rapid(leg)).map(|leg| {
            let measured = leg.curve.counted().length(&chord) / record.period;
            (measured, settled.factor(leg, sample) * speed(leg, spindle), leg)
        });
        // It is enough if one leg allows it: between two of them the chord is neither's.
        let excess = |(measured, limit, _): &(f64, f64, &&Leg<'_>)| measured - limit;
        let off = 4.0 * (record.samples.resolution() + RELATIVE * 1e-3) / record.period;
        let least = allowed_speeds.min_by(|a, b| excess(a).total_cmp(&excess(b)));
        let allows =
            least.is_some_and(|(measured, limit, _)| measured <= limit * (1.0 + RELATIVE) + off);
        if !allows && legs.iter().any(is_rapid) {
            rapid(record, sample, &chord, settled.rapid[sample], &mut findings);
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
        let off = 2.0 * (record.samples.resolution() + RELATIVE * 1e-3) / record.period;
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
struct Settled {
    feed: Vec<f64>,
    adaptive: Vec<f64>,
    rapid: Vec<f64>,
}

impl Settled {
    fn of(record: &Record<'_>, route: &Route<'_>, matching: &Matching) -> Self {
        let requests = &record.requests;
        let settle = |factors: &[f64]| {
            let mut settled: Vec<f64> = factors.iter().map(|factor| factor.abs()).collect();
            for sample in 1..factors.len() {
                if factors[sample].abs() >= factors[sample - 1].abs() {
                    continue;
                }
                let fastest = record.speed(sample).max(record.speed(sample - 1));
                let stop = record.granted_stop((route, matching), sample, fastest);
                let cycles = (stop.seconds / record.period).ceil() + 2.0;
                let before = settled[sample - 1];
                let mut passed = 0.0;
                for later in settled[sample..].iter_mut() {
                    if passed >= cycles {
                        break;
                    }
                    *later = later.max(before);
                    passed += 1.0;
                }
            }
            settled
        };
        Self {
            feed: settle(&requests.feed_override),
            adaptive: settle(&requests.adaptive),
            rapid: settle(&requests.rapid_override),
        }
    }

    /// Rules overrides.feed-no-influence and overrides.adaptive-feed-no-influence. What is disabled has no influence.
    fn factor(&self, leg: &Leg<'_>, sample: usize) -> f64 {
        let controls = leg.element.controls;
        let of = |acts: bool, factors: &[f64]| if acts { factors[sample] } else { 1.0 };
        of(controls.feed_override, &self.feed) * of(controls.adaptive_feed, &self.adaptive)
    }
}

/// Speeds of the spindles that legs follow.
struct Spindles {
    speeds: Vec<(u8, Vec<f64>)>,
}

impl Spindles {
    fn of(record: &Record<'_>, route: &Route<'_>) -> Result<Self, String> {
        let mut speeds: Vec<(u8, Vec<f64>)> = Vec::new();
        for leg in &route.legs {
            let Feed::PerTurn { spindle, .. } = leg.element.feed else { continue };
            if speeds.iter().any(|(known, _)| *known == spindle) {
                continue;
            }
            let Some(turns) = Self::recorded(record, spindle) else {
                return Err(format!(
                    "the speed of spindle {spindle}, which the feed follows, is not recorded"
                ));
            };
            speeds.push((spindle, turns));
        }
        Ok(Self { speeds })
    }

    fn recorded(record: &Record<'_>, spindle: u8) -> Option<Vec<f64>> {
        if let Some(turns) = record.samples.column(Column::SpindleSpeed(spindle)) {
            return Some(turns.iter().map(|turns| turns.abs()).collect());
        }
        let changes: Vec<_> =
            record.requests.spindles.iter().filter(|(_, number, _)| *number == spindle).collect();
        changes.first()?;
        let mut now = 0.0;
        let mut turns = Vec::with_capacity(record.points.len());
        let mut changes = changes.into_iter().peekable();
        for sample in 0..record.points.len() {
            while let Some((_, _, speed)) = changes.next_if(|(from, _, _)| *from <= sample) {
                now = speed.abs();
            }
            turns.push(now);
        }
        Some(turns)
    }

    fn turns(&self, spindle: u8, sample: usize) -> f64 {
        let known = self.speeds.iter().find(|(number, _)| *number == spindle);
        known.map_or(0.0, |(_, speeds)| speeds[sample].max(speeds[sample.saturating_sub(1)]))
    }
}
