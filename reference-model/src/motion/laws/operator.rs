//! Hold, abort, and what is left to stop on.

use gaugeblock_vocabulary::Axis;
use gaugeblock_vocabulary::motion::{Column, Feed};

use super::easing::least_distance_on_line;
use super::matching::Matching;
use super::record::Record;
use super::verdict::{Findings, Law, Verdict, figure};
use crate::motion::bound::{Shortest, Stop, shortest_stopping};
use crate::motion::route::{Leg, Route};
use crate::motion::vector::{AxisVector, direction, distance, minus};

/// Servo cycles within which a request takes effect.
const CYCLES: usize = 2;
/// The angle of an arc between two of its points, radians.
const STEP: f64 = 0.005;

impl Record<'_> {
    /// Whether the motion is held at a sample: by the operator, by the feed stop if M53 enables it, or by a feed
    /// override or adaptive feed of zero if M50 or M52 enables it. Section 11.6.12 says of the adaptive feed that zero
    /// is a feed hold. No section says that the feed override acts on rapid moves, which have an override of their own
    /// (section 13.3.4.17).
    pub(super) fn holds(&self, sample: usize) -> bool {
        let request = self.requests.at(sample);
        let Ok((route, matching)) = &self.matched else { return request.hold };
        let controls = route.legs[matching.place(sample).leg].element.controls;
        let (first, last) = matching.legs(sample);
        let mut legs = route.legs[first..=last].iter();
        let traverses = legs.any(|leg| leg.element.feed == Feed::Rapid);
        request.hold
            || controls.feed_stop && request.feed_stop
            || controls.feed_override && !traverses && request.feed_override <= 0.0
            || controls.adaptive_feed && request.adaptive == 0.0
    }
}

/// Rule trajectory.hold. A hold stops the motion on the path, within the distance in which it can stop and two
/// cycles, and it rests until nothing holds it any more. That it goes on along the path, deviation and progress say.
/// With a limit of jerk it is granted more (`easing`).
pub(super) fn hold(record: &Record<'_>) -> Verdict {
    let (route, matching) = match &record.matched {
        Ok(matched) => matched,
        Err(why) => return Verdict::NotJudged(why.clone()),
    };
    let mut findings = Findings::of(Law::Hold);
    let (mut asked, mut sample) = (false, 0);
    while sample < record.len() {
        if !record.holds(sample) {
            sample += 1;
            continue;
        }
        let from = sample;
        while sample < record.len() && record.holds(sample) {
            sample += 1;
        }
        asked = true;
        if let Some(why) = record.stopping_unknown() {
            return Verdict::NotJudged(why);
        }
        if from > 0 && record.requests.at(from - 1).adaptive < 0.0 {
            return Verdict::NotJudged("a hold while the path is run backwards".to_owned());
        }
        stops(record, (route, matching), (from, sample), &mut findings);
    }
    if asked { findings.verdict() } else { Verdict::NotApplicable }
}

/// Rule trajectory.abort. An abort stops the motion like a hold, and it never goes on.
pub(super) fn abort(record: &Record<'_>) -> Verdict {
    let Some(from) = record.requests.aborted else { return Verdict::NotApplicable };
    let (route, matching) = match &record.matched {
        Ok(matched) => matched,
        Err(why) => return Verdict::NotJudged(why.clone()),
    };
    if let Some(why) = record.stopping_unknown() {
        return Verdict::NotJudged(why);
    }
    let mut findings = Findings::of(Law::Abort);
    let back = from > 0 && record.requests.at(from - 1).adaptive < 0.0;
    if !back {
        stops(record, (route, matching), (from, record.len()), &mut findings);
    }
    let last = record.len() - 1;
    if !record.rests(last) {
        let speed = record.speed(last);
        let words = format!(
            "the motion still makes {speed} mm/s when the record ends",
            speed = figure(speed)
        );
        findings.breaks(last, None, (speed, 0.0), words);
    } else if back {
        return Verdict::NotJudged("an abort while the path is run backwards".to_owned());
    }
    findings.verdict()
}

/// The motion stops from a sample on, and rests until another one.
fn stops(
    record: &Record<'_>,
    (route, matching): (&Route<'_>, &Matching),
    (from, until): (usize, usize),
    findings: &mut Findings,
) {
    let latest = (from + CYCLES).min(record.len() - 1);
    let speed = (from..=latest).map(|sample| record.speed(sample)).fold(0.0, f64::max);
    let place = matching.place(from);
    let least = record.granted_stop((route, matching), from, speed).distance;
    let least = least.max(carried(record, route, (place.leg, place.part), (from, latest)));
    let two_cycles = 2.0 * speed * record.period;
    let allowed = least * (1.0 + 1e-6) + two_cycles + record.bulge + record.slack;
    let (mut way, mut rested) = (0.0, false);
    for sample in from + 1..until {
        let step = distance(&record.point(sample - 1), &record.point(sample));
        way += step;
        let words = || {
            format!(
                "the motion goes on for {way} mm from {speed} mm/s where {least} mm suffice",
                way = figure(way),
                speed = figure(speed),
                least = figure(least)
            )
        };
        findings.at_most(sample, None, (way, allowed), (0.0, &words));
        if rested && step > record.slack {
            let words =
                format!("the motion goes on by {step} mm while it is held", step = figure(step));
            findings.breaks(sample, None, (step, 0.0), words);
        }
        rested |= sample > latest && step <= record.slack;
    }
}

/// How far a motion goes on along a route at least, since each axis needs its way to brake: from a point, with what
/// the axes make from some samples to the next ones. On a leg on which an axis has a smaller share of the path, its
/// way is longer along that.
///
/// Where an axis turns round on the route, that brakes it, and this says nothing of it.
fn carried(
    record: &Record<'_>,
    route: &Route<'_>,
    (leg, part): (usize, f64),
    (first, last): (usize, usize),
) -> f64 {
    let samples = first.max(1)..=last;
    let axis = |place: usize| {
        let step = |sample: usize| record.point(sample)[place] - record.point(sample - 1)[place];
        let steps = samples.clone().map(step);
        let step = steps.max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(0.0);
        if step == 0.0 {
            return 0.0;
        }
        let speed = step / record.period;
        let needed = speed * speed / (2.0 * record.envelope.acceleration[place]);
        let (mut gained, mut way, mut part) = (0.0, 0.0, part);
        for leg in &route.legs[leg..] {
            let steps = (leg.curve.angle().abs() * (1.0 - part) / STEP).ceil().max(1.0);
            let (mut done, mut here) = (0.0, leg.curve.at(part)[place]);
            while done < steps {
                done += 1.0;
                let there = leg.curve.at(part + (1.0 - part) * done / steps)[place];
                let more = (there - here) * speed.signum();
                let long = leg.curve.length() * (1.0 - part) / steps;
                if gained + more >= needed {
                    return way + long * ((needed - gained) / more).min(1.0);
                }
                if more < 0.0 {
                    return 0.0;
                }
                (gained, way, here) = (gained + more, way + long, there);
            }
            part = 0.0;
        }
        0.0
    };
    (0..9).map(axis).fold(0.0, f64::max)
}

/// Rule trajectory.reserve. At each instant the motion can stop within the elements that the planner has received, so
/// that the input may end at any cycle (section 2.3.1.3: never at such a speed that it cannot come to an exact stop).
///
/// The speed from one sample to the next is that of some instant between them, at which the motion is no nearer than
/// at the first of them: from there the speed has to suffice. On the way through a blend each axis has to stop by
/// itself at least. On the last line that is queued a limit of jerk counts, too.
pub(super) fn stopping_distance(record: &Record<'_>) -> Verdict {
    let Some(queued) = record.recording.column(Column::Queued) else {
        return Verdict::NotJudged("what was queued is not recorded".to_owned());
    };
    let (route, matching) = match &record.matched {
        Ok(matched) => matched,
        Err(why) => return Verdict::NotJudged(why.clone()),
    };
    if let Some(why) = record.stopping_unknown() {
        return Verdict::NotJudged(why);
    }
    let mut ends = vec![0.0];
    let mut way = 0.0;
    for leg in &route.legs {
        way += leg.curve.length();
        ends.push(way);
    }
    let mut findings = Findings::of(Law::StoppingDistance);
    for (sample, queued) in queued.iter().enumerate().skip(1) {
        let (place, behind) = (matching.place(sample - 1), matching.place(sample));
        // A motion that runs back stops on elements that it has passed. So does one that may run back, if the path
        // returns along itself.
        let earlier = matching.legs(sample).0 < place.leg;
        if behind < place || record.backwards.at(sample) && earlier {
            continue;
        }
        let legs =
            route.legs.partition_point(|leg| crate::motion::vector::count(leg.place) < queued);
        let leg = &route.legs[place.leg];
        let here = ends[place.leg] + place.part * leg.curve.length();
        let left = (ends[legs] - here).max(0.0);
        let speed = record.speed(sample);
        let off = record.bulge + record.slack + leg.tolerance;
        if !record.envelope.limits_jerk() && speed * speed <= 2.0 * record.envelope.least() * left {
            continue;
        }
        let from = (place.leg, place.part);
        match shortest_stopping(route, &record.envelope, from, speed, legs) {
            Shortest::Within(Stop { distance, .. }) => {
                let is_last_line = place.leg + 1 == legs && leg.curve.is_straight();
                let step = minus(&leg.curve.end(), &leg.curve.start());
                let smooth = least_distance_on_line(&record.envelope, &step, speed);
                let distance = if is_last_line { distance.max(smooth) } else { distance };
                let words = || {
                    format!(
                        "{distance} mm are needed to stop from {speed} mm/s and {left} mm are queued",
                        speed = figure(speed),
                        distance = figure(distance),
                        left = figure(left)
                    )
                };
                findings.at_most(
                    sample,
                    None,
                    (distance, left * (1.0 + 1e-9) + off),
                    (0.0, &words),
                );
            }
            // The speed is that of the whole cycle, and may have been gained behind the corner.
            Shortest::Rounds { place, .. }
                if place != from && (behind.leg, behind.part) >= place => {}
            Shortest::Rounds { place, speed } => {
                let curve = &route.legs[place.0].curve;
                let onwards = direction(&curve.derivatives(place.1).0).unwrap_or_default();
                let (at, velocity) = if place == from {
                    let step = record.step(sample);
                    (record.point(sample - 1), step.map(|step| step / record.period))
                } else {
                    (curve.at(place.1), onwards.map(|share| share * speed))
                };
                let known = &route.legs[place.0..legs.max(place.0 + 1)];
                each_axis(record, sample, known, (&at, &velocity), &mut findings);
            }
        }
    }
    findings.verdict()
}

/// Holds each axis by itself to what some legs leave it from a point on: however corners are rounded, an axis moves
/// on for as long as it brakes.
fn each_axis(
    record: &Record<'_>,
    sample: usize,
    legs: &[Leg<'_>],
    (at, velocity): (&AxisVector, &AxisVector),
    findings: &mut Findings,
) {
    for axis in Axis::ALL.iter().copied() {
        let speed = velocity[axis.place()];
        let needed = speed * speed / (2.0 * record.envelope.acceleration[axis.place()]);
        let (mut left, mut off) = (0.0_f64, record.bulge + record.slack);
        for leg in legs {
            if needed <= left + off {
                break;
            }
            let steps = (leg.curve.angle().abs() / STEP).ceil().max(1.0);
            let mut done = 1.0;
            while done <= steps {
                let gained = leg.curve.at(done / steps)[axis.place()] - at[axis.place()];
                left = left.max(gained * speed.signum());
                done += 1.0;
            }
            // Between two of these points an arc is no farther from them than a share of its radius.
            let bow = if leg.curve.is_straight() { 0.0 } else { leg.curve.length() * STEP };
            off = off.max(record.bulge + record.slack + leg.tolerance + bow);
        }
        let words = || {
            format!(
                "{axis} needs {needed} mm to stop from {speed} mm/s and {left} mm are queued",
                speed = figure(speed),
                left = figure(left),
                needed = figure(needed)
            )
        };
        findings.at_most(sample, Some(axis), (needed, left * (1.0 + 1e-9) + off), (0.0, &words));
    }
}
