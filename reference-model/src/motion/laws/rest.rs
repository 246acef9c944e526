//! Where the motion rests: exact stops, ends, dwells.

use gaugeblock_trace::Axis;

use super::record::Record;
use super::verdict::{Findings, Law, Verdict};
use super::visits::{EARLY, Visit, visits};
use crate::math;
use crate::motion::route::{Passing, Task};
use crate::motion::vector::{Nine, count, distance};

const RELATIVE: f64 = 1e-9;

/// Rule trajectory.stop. The motion rests at the end of each element that asks for it: under exact stop (G61.1, section 11.5.36:
/// movement stops at the end of each segment), before a dwell (section 2.5.2.7), a wait, a probe, and an output at once, which
/// breaks blending (section 11.6.15).
///
/// The moment of rest may lie between two samples: from rest an axis is a·t²/2 away after t, so that the times that both samples
/// are away from the point at least, by each axis, fit into a period.
pub(super) fn stop(record: &Record<'_>) -> Verdict {
    let (route, matching) = match &record.matched {
        Ok(matched) => matched,
        Err(why) => return Verdict::NotJudged(why.clone()),
    };
    if let Some(why) = unstated(record) {
        return Verdict::NotJudged(why);
    }
    let mut findings = Findings::of(Law::Stop);
    let mut asked = false;
    let inner = visits(record, route, matching).into_iter().enumerate();
    for (number, visit) in inner.skip(1).take(route.legs.len() - 1) {
        if route.corners[number].passing != Passing::Rest {
            continue;
        }
        asked = true;
        let Some(visit) = visit else { continue };
        let corner = &route.corners[number].at;
        let needed = (visit.before.saturating_sub(EARLY)..=visit.after + EARLY)
            .filter(|sample| sample + 1 < record.points.len())
            .map(|sample| time_away(record, corner, sample))
            .fold(f64::INFINITY, f64::min);
        let block = &route.legs[number - 1].element.block;
        let words = || {
            format!(
                "no rest at the end of {block}: its samples are {needed} s apart by rest, at least"
            )
        };
        let limit = record.period;
        findings.at_most(visit.after, None, (needed, limit * (1.0 + RELATIVE)), (limit, &words));
    }
    if asked { findings.verdict() } else { Verdict::NothingAsked }
}

/// The least time between two neighbouring samples with rest at a point in between.
fn time_away(record: &Record<'_>, corner: &Nine, sample: usize) -> f64 {
    let away = |point: &Nine, axis: usize| {
        let off = ((point[axis] - corner[axis]).abs() - record.slack).max(0.0);
        if off == 0.0 {
            0.0
        } else {
            math::square_root(2.0 * off / record.envelope.acceleration[axis])
        }
    };
    let (one, other) = (&record.points[sample], &record.points[sample + 1]);
    (0..9).map(|axis| away(one, axis) + away(other, axis)).fold(0.0, f64::max)
}

fn unstated(record: &Record<'_>) -> Option<String> {
    let moves = |axis: usize| {
        record.points.iter().any(|point| point[axis].to_bits() != record.points[0][axis].to_bits())
    };
    let axis = record.envelope.unstated(moves)?;
    Some(format!("{axis} moves and no limit of it is stated"))
}

/// Rule trajectory.ends. The first sample is where the path starts, the last one where it ends, exactly; at both the motion
/// rests, so that its neighbour is no farther away than an axis comes from rest in a period. After an abort it ends anywhere, at
/// rest.
pub(super) fn ends(record: &Record<'_>) -> Verdict {
    let last = record.points.len() - 1;
    let mut findings = Findings::of(Law::Ends);
    let start = record.path.start.to_array();
    let away = distance(&record.points[0], &start);
    let words = || format!("the first sample is {away} mm from where the path starts");
    findings.at_most(0, None, (away, record.slack), (0.0, &words));
    if record.requests.aborted.is_none() {
        let end = record.path.elements.iter().rev().find_map(|element| element.end());
        let end = end.map_or(start, |end| end.to_array());
        let away = distance(&record.points[last], &end);
        let words = || format!("the last sample is {away} mm from where the path ends");
        findings.at_most(last, None, (away, record.slack), (0.0, &words));
    }
    if let Some(why) = unstated(record) {
        return if findings.clone().verdict() == (Verdict::Held { share: None }) {
            Verdict::NotJudged(why)
        } else {
            findings.verdict()
        };
    }
    let pairs = [(0, 1, "starts"), (last.saturating_sub(1), last, "ends")];
    for (one, other, what) in pairs {
        if other > last {
            return Verdict::NotJudged("one sample tells of no rest".to_owned());
        }
        for axis in Axis::ALL.iter().copied() {
            let place = axis.place();
            let step = (record.points[other][place] - record.points[one][place]).abs();
            let limit = record.envelope.acceleration[place] * record.period * record.period / 2.0;
            if step == 0.0 {
                continue;
            }
            let words = || {
                format!(
                    "{axis} makes {step} in the sample with which the record {what}: it is no rest"
                )
            };
            findings.at_most(
                other,
                Some(axis),
                (step, limit * (1.0 + RELATIVE) + record.slack),
                (0.0, &words),
            );
        }
    }
    findings.verdict()
}

/// Rule trajectory.dwell. The axes stand for the time of a dwell (G4), to the cycle; where something else is waited for or held
/// there too, at least so long.
pub(super) fn dwell(record: &Record<'_>) -> Verdict {
    let (route, matching) = match &record.matched {
        Ok(matched) => matched,
        Err(why) => return Verdict::NotJudged(why.clone()),
    };
    let mut findings = Findings::of(Law::Dwell);
    let mut asked = false;
    let last = record.points.len() - 1;
    for (number, visit) in visits(record, route, matching).into_iter().enumerate() {
        let tasks = &route.corners[number].tasks;
        let seconds: f64 = tasks
            .iter()
            .map(|task| if let Task::Dwell(seconds) = task { *seconds } else { 0.0 })
            .sum();
        let Some(visit) = visit.filter(|_| seconds > 0.0) else { continue };
        asked = true;
        let cycles = visit.at.map_or(0.0, |(first, last)| count(last - first + 1));
        let (least, most) =
            ((cycles - 1.0).max(0.0) * record.period, (cycles + 1.0) * record.period);
        let words = || format!("rest for less than {most} s where {seconds} s are asked for");
        findings.at_most(visit.after, None, (seconds * (1.0 - RELATIVE), most), (0.0, &words));
        let alone = tasks.iter().all(|task| matches!(task, Task::Dwell(_) | Task::WithMotion(_)));
        let open =
            number == 0 || visit.at.is_none_or(|(_, end)| end == last) || held(record, visit);
        if alone && !open {
            let words = || format!("rest for at least {least} s where {seconds} s are asked for");
            let allowed = (seconds + record.period) * (1.0 + RELATIVE);
            findings.at_most(visit.after, None, (least, allowed), (0.0, &words));
        }
    }
    if asked { findings.verdict() } else { Verdict::NothingAsked }
}

/// Whether somebody holds the motion during a visit.
fn held(record: &Record<'_>, visit: Visit) -> bool {
    (visit.before..=visit.after).any(|sample| record.holds(sample))
}
