//! Where the motion rests: exact stops, ends, dwells.

use gaugeblock_vocabulary::Axis;
use gaugeblock_vocabulary::motion::{Column, Feed};

use super::corner_passes::{CornerPass, Rests, corner_passes, to_rest};
use super::record::{Record, Request};
use super::verdict::{Findings, Law, Verdict, figure};
use crate::motion::route::{CornerTolerance, Leg, Task};
use crate::motion::vector::{AxisVector, count, distance};

const RELATIVE: f64 = 1e-9;

/// Rule trajectory.stop. The motion rests at the end of each element that requires it: under exact stop (G61.1,
/// section 11.5.36: movement stops at the end of each segment), before a dwell (section 2.5.2.7), a wait, a probe,
/// and an output at once, which breaks blending (section 11.6.15).
///
/// The moment of rest may lie between two samples: then the times that both are away from the point at least fit into
/// a period. Only samples count that match points on both sides of the corner, and rests come in the order of
/// the corners.
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
    let mut rests = Rests::of(record);
    let inner = corner_passes(record, route, matching).into_iter().enumerate();
    for (number, pass) in inner.skip(1).take(route.legs.len() - 1) {
        let corner = &route.corners[number];
        if corner.tolerance != CornerTolerance::Rest {
            continue;
        }
        asked = true;
        let Some(pass) = pass.filter(|pass| pass.passed) else { continue };
        let Some((sample, needed)) = rests.next(pass, &corner.at) else { continue };
        let block = &route.legs[number - 1].element.block;
        let words = || {
            format!(
                "no rest at the end of {block}: its samples are {needed} s apart by rest, at least",
                needed = figure(needed)
            )
        };
        let limit = record.period;
        findings.at_most(sample + 1, None, (needed, limit * (1.0 + RELATIVE)), (limit, &words));
    }
    if asked { findings.verdict() } else { Verdict::NotApplicable }
}

fn unstated(record: &Record<'_>) -> Option<String> {
    let axis = record.envelope.unstated(|axis| record.moves(axis))?;
    Some(format!("{axis} moves and no limit of it is stated"))
}

/// Rule trajectory.ends. The first sample is where the path starts, the last one where it ends, exactly; at both the
/// motion rests, so that its neighbour is no farther away than an axis comes from rest in a period. After an abort it
/// ends anywhere, at rest.
pub(super) fn ends(record: &Record<'_>) -> Verdict {
    let last = record.len() - 1;
    let mut findings = Findings::of(Law::Ends);
    let start = record.path.start.to_array();
    let away = distance(&record.point(0), &start);
    let words =
        || format!("the first sample is {away} mm from where the path starts", away = figure(away));
    findings.at_most(0, None, (away, record.slack), (0.0, &words));
    if record.requests.aborted.is_none() {
        let end = record.path.elements.iter().rev().find_map(|element| element.end());
        let end = end.map_or(start, |end| end.to_array());
        let away = distance(&record.point(last), &end);
        let words = || {
            format!("the last sample is {away} mm from where the path ends", away = figure(away))
        };
        findings.at_most(last, None, (away, record.slack), (0.0, &words));
    }
    if let Some(why) = unstated(record) {
        return if findings.clone().verdict() == (Verdict::Satisfied { share: None }) {
            Verdict::NotJudged(why)
        } else {
            findings.verdict()
        };
    }
    let pairs = [(0, 1, "starts"), (last.saturating_sub(1), last, "ends")];
    for (one, other, what) in pairs {
        if other > last {
            return Verdict::NotJudged("one sample is not enough to judge rest".to_owned());
        }
        for axis in Axis::ALL.iter().copied() {
            let place = axis.place();
            let step = (record.point(other)[place] - record.point(one)[place]).abs();
            let limit = record.envelope.acceleration[place] * record.period * record.period / 2.0;
            if step == 0.0 {
                continue;
            }
            let words = || {
                format!(
                    "{axis} makes {step} in the sample with which the record {what}: it is not at rest",
                    step = figure(step)
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

/// Rule trajectory.dwell. The axes rest for the time of a dwell (G4), within a cycle. They rest at least that long if
/// the motion also waits or is held there, or if the planner does not have the next element yet. An abort ends the
/// dwell. After the motion has run back out of a dwell and returned, it makes the rest of the dwell, or all of it. If
/// several rests can be the dwell, one of the right length is enough.
pub(super) fn dwell(record: &Record<'_>) -> Verdict {
    let (route, matching) = match &record.matched {
        Ok(matched) => matched,
        Err(why) => return Verdict::NotJudged(why.clone()),
    };
    let mut findings = Findings::of(Law::Dwell);
    let (mut asked, mut earliest) = (false, 0);
    let last = record.len() - 1;
    for (number, pass) in corner_passes(record, route, matching).into_iter().enumerate() {
        let tasks = &route.corners[number].tasks;
        let seconds: f64 = tasks
            .iter()
            .map(|task| if let Task::Dwell(seconds) = task { *seconds } else { 0.0 })
            .sum();
        let Some(pass) = pass.filter(|pass| pass.passed && seconds > 0.0) else { continue };
        asked = true;
        let turned = runs_back(record, pass);
        let alone = tasks
            .iter()
            .all(|task| matches!(task, Task::Dwell(_) | Task::WithMotion(_) | Task::InPlace(_)));
        let next = route.legs.get(number);
        let open = !alone || number == 0 || turned || is_held(record, pass);
        let open = |rest: &Rest| {
            open || rest.at.is_none_or(|(_, end)| end == last || kept(record, next, end))
                || starves(record, next, rest.at)
        };
        let shortest = (seconds - record.period) * (1.0 - RELATIVE);
        let longest = (seconds + record.period) * (1.0 + RELATIVE);
        let rests = rests(record, pass, &route.corners[number].at);
        let rest = if turned {
            // Who runs back comes again: all stays count.
            rests.into_iter().reduce(Rest::and)
        } else {
            let fits = |rest: &&Rest| {
                rest.since(earliest)
                    && rest.most >= shortest
                    && (open(rest) || rest.least <= longest)
            };
            let most = || rests.iter().rev().max_by(|a, b| a.most.total_cmp(&b.most)).copied();
            rests.iter().find(fits).copied().or_else(most)
        };
        let rest = rest.unwrap_or(Rest { at: None, least: 0.0, most: record.period });
        earliest = rest.at.map_or(earliest, |(first, _)| first);
        let Rest { at, least, most } = rest;
        let after = at.map_or(pass.after(record), |(_, end)| (end + 1).min(last));
        let words = || {
            format!(
                "rest for less than {most} s where {seconds} s are programmed",
                most = figure(most),
                seconds = figure(seconds)
            )
        };
        let open_ended = pass.is_aborted(record);
        if !open_ended && record.requests.aborted.is_none_or(|cycle| cycle > after) {
            findings.at_most(after, None, (shortest, most), (0.0, &words));
        }
        if !open(&rest) {
            let words = || {
                format!(
                    "rest for at least {least} s where {seconds} s are programmed",
                    least = figure(least),
                    seconds = figure(seconds)
                )
            };
            findings.at_most(after, None, (least, longest), (0.0, &words));
        }
    }
    if asked { findings.verdict() } else { Verdict::NotApplicable }
}

/// Whether a planner was still without the leg that comes next when it rested.
fn starves(record: &Record<'_>, next: Option<&Leg<'_>>, at: Option<(usize, usize)>) -> bool {
    let (Some(next), Some((first, _))) = (next, at) else { return false };
    let queued = record.recording.column(Column::Queued);
    queued.is_some_and(|queued| queued.get(first) <= count(next.place))
}

/// Whether a feed of zero keeps the motion from beginning the leg that comes next, at the last sample of a rest.
fn kept(record: &Record<'_>, next: Option<&Leg<'_>>, end: usize) -> bool {
    let feeds =
        |leg: &&Leg<'_>| leg.element.controls.feed_override && leg.element.feed != Feed::Rapid;
    let none = |request: &Request| request.feed_override <= 0.0;
    next.filter(feeds).is_some() && record.requests.any((end.saturating_sub(2), end), none)
}

/// A rest at a corner.
#[derive(Clone, Copy, Debug)]
struct Rest {
    /// First and last sample there, or those between which it was.
    at: Option<(usize, usize)>,
    /// How long it may have been, at least and at most, seconds: from the first to the last sample there, and beyond
    /// them as long as the axes do not need to come and to go.
    least: f64,
    most: f64,
}

impl Rest {
    /// Both in one, the later one's end being its end.
    fn and(self, later: Self) -> Self {
        Self { at: later.at, least: self.least + later.least, most: self.most + later.most }
    }

    /// Whether it does not begin before a sample.
    fn since(&self, sample: usize) -> bool {
        self.at.is_none_or(|(first, _)| first >= sample)
    }
}

/// All rests at a corner: those with samples at the corner, then those that fit between two samples away from it.
fn rests(record: &Record<'_>, pass: CornerPass, corner: &AxisVector) -> Vec<Rest> {
    let lingers = record.lingers();
    let rest = |(first, last): (usize, usize)| {
        let all = count(last - first) * record.period;
        let least = (all - lingers).max(0.0);
        let spare = |sample: Option<usize>| {
            let sample = sample.filter(|sample| *sample < record.len());
            let away = sample.map_or(0.0, |sample| to_rest(record, sample, corner));
            (record.period - away).max(0.0)
        };
        let most = all + spare(first.checked_sub(1)) + spare(Some(last + 1));
        Rest { at: Some((first, last)), least, most }
    };
    let is_away = |sample: &usize| !(*sample..=sample + 1).any(|s| record.is_at(s, corner));
    let between = pass.pairs(record).filter(is_away).filter_map(|sample| {
        let needed = to_rest(record, sample, corner) + to_rest(record, sample + 1, corner);
        let most = record.period - needed;
        (most >= 0.0).then_some(Rest { at: Some((sample, sample + 1)), least: 0.0, most })
    });
    pass.stays(record, corner).map(rest).chain(between).collect()
}

/// Whether a reversal of the motion is requested while a corner is passed.
fn runs_back(record: &Record<'_>, pass: CornerPass) -> bool {
    record.requests.any((pass.first, pass.after(record)), |request| request.adaptive < 0.0)
}

/// Whether the motion is held while a corner is passed.
fn is_held(record: &Record<'_>, pass: CornerPass) -> bool {
    (pass.first.saturating_sub(1)..=pass.after(record)).any(|sample| record.holds(sample))
}
