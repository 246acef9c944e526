//! The law of outputs: when they switch.

use std::collections::BTreeMap;

use gaugeblock_vocabulary::Pin;
use gaugeblock_vocabulary::motion::Column;

use super::corner_passes::{CornerPass, corner_passes, rest_after};
use super::matching::Matching;
use super::record::Record;
use super::verdict::{Findings, Law, Verdict};
use crate::ids::choice::trajectory::MotionStart;
use crate::motion::recording::{Number, Paged};
use crate::motion::route::{Corner, CornerTolerance, Route, Task};
use crate::motion::vector::{count, distance};

/// A change of an output that the path requests.
#[derive(Clone, Debug)]
struct Expected {
    value: f64,
    /// First and last of the samples that may be the first with the new value, for each time at which it may happen.
    when: Vec<(usize, usize)>,
    /// Whether the point of the change was passed for sure.
    certain: bool,
}

impl Expected {
    fn first(&self) -> usize {
        self.when.first().map_or(0, |when| when.0)
    }

    fn last(&self) -> usize {
        self.when.last().map_or(0, |when| when.1)
    }

    /// How many samples a sample is too early or too late, and which.
    fn off(&self, sample: usize) -> (usize, &'static str) {
        let off = |(first, last): (usize, usize)| {
            if sample < first {
                (first - sample, "early")
            } else {
                (sample.saturating_sub(last), "late")
            }
        };
        self.when.iter().copied().map(off).min_by_key(|off| off.0).unwrap_or((0, "late"))
    }
}

/// Rule trajectory.outputs. An output of M62, M63 or M67 switches at the start of the next motion (sections 11.6.15 and
/// 11.6.17): in the sample that is nearest to the corner, or one cycle before or after it; if the motion rests at the
/// corner, within a cycle of the last sample there. Where a blend is a motion's start is a choice. Of several settings
/// before that motion the latest counts; one without a motion after it never switches. An output of M64, M65 or M68
/// switches at once: while the motion rests where it was programmed. Nothing else switches. A value that lasts for no
/// time may be missing, and so may what an abort came before.
pub(super) fn outputs(record: &Record<'_>) -> Verdict {
    let (route, matching) = match &record.matched {
        Ok(matched) => matched,
        Err(why) => return Verdict::NotJudged(why.clone()),
    };
    let mut expected: BTreeMap<Pin, Vec<Expected>> = BTreeMap::new();
    let corner_passes = corner_passes(record, route, matching);
    let spans = spans(record, route, &corner_passes);
    for (number, pass) in corner_passes.into_iter().enumerate() {
        let Some(pass) = pass else { break };
        for task in &route.corners[number].tasks {
            ask(record, (route, matching), number, (pass, spans[number]), task, &mut expected);
        }
    }
    let unrecorded = expected.keys().find(|pin| !record.recording.has(Column::Output(**pin)));
    if let Some(pin) = unrecorded {
        return Verdict::NotJudged(format!("{pin} is commanded to switch and is not recorded"));
    }
    let mut findings = Findings::of(Law::Outputs);
    let mut recorded = false;
    for column in record.recording.columns() {
        if let Column::Output(pin) = column {
            recorded = true;
            let Some(values) = record.recording.column(*column) else { continue };
            let requested = expected.remove(pin).unwrap_or_default();
            compare(*pin, values, &requested, &mut findings);
        }
    }
    if recorded { findings.verdict() } else { Verdict::NotApplicable }
}

/// From which sample on each corner is passed, since the one before it is passed then, and by which one, since the
/// next one is.
fn spans(
    record: &Record<'_>,
    route: &Route<'_>,
    corner_passes: &[Option<CornerPass>],
) -> Vec<(usize, usize)> {
    let end = record.len() - 1;
    let mut spans = vec![(0, end); corner_passes.len()];
    let near = |number: usize, span: (usize, usize)| {
        let corner = &route.corners[number];
        corner_passes[number].map(|pass| pass.latest().near_within(record, corner, span))
    };
    for number in 1..corner_passes.len() {
        let before = spans[number - 1].0;
        let since = near(number - 1, (before, end)).map_or(before, |near| near.0);
        spans[number].0 = since.max(before);
    }
    for number in (1..corner_passes.len()).rev() {
        let after = spans[number].1;
        let until = near(number, (0, after)).map_or(after, |near| near.1);
        spans[number - 1].1 = until.min(after);
    }
    spans
}

fn ask(
    record: &Record<'_>,
    (route, matching): (&Route<'_>, &Matching),
    number: usize,
    (pass, span): (CornerPass, (usize, usize)),
    task: &Task,
    expected: &mut BTreeMap<Pin, Vec<Expected>>,
) {
    let corner = &route.corners[number];
    let certain = pass.passed && !pass.is_aborted(record);
    let certain =
        |last: usize| certain && record.requests.aborted.is_none_or(|aborted| last < aborted);
    match task {
        Task::Dwell(_) | Task::Wait(_) => (),
        Task::AtOnce(switching) => {
            let when = at_once(record, corner, pass);
            let certain = when.last().is_some_and(|when| certain(when.1));
            let new = Expected { value: switching.value, when, certain };
            expected.entry(switching.pin).or_default().push(new);
        }
        Task::WithMotion(switches) | Task::InPlace(switches) => {
            // A motion that leads nowhere may start at any time of the rest.
            let stays = matches!(task, Task::InPlace(_));
            let when = pass.times().map(|time| {
                let (first, until) = start(record, (route, matching), number, (time, span));
                let near = time.at.filter(|_| stays).map_or(first, |at| at.0.min(first));
                (near.saturating_sub(1), until + 1)
            });
            let when: Vec<_> = when.collect();
            for switching in switches {
                let certain = when.last().is_some_and(|when| certain(when.1));
                let new = Expected { value: switching.value, when: when.clone(), certain };
                expected.entry(switching.pin).or_default().push(new);
            }
        }
    }
}

/// First and last of the samples with which the motion from a corner may start: where it comes nearest, or does so
/// after the corner before, or by the next one. Far from the path, the position of a sample does not determine its leg.
///
/// Choice trajectory.motion-start. At a rounded corner it starts nearest to the corner, or where the blend has ended:
/// at the first sample on its own path. Elsewhere these are the same.
fn start(
    record: &Record<'_>,
    (route, matching): (&Route<'_>, &Matching),
    number: usize,
    (pass, span): (CornerPass, (usize, usize)),
) -> (usize, usize) {
    let corner = &route.corners[number];
    let end = record.len() - 1;
    let near = [(0, end), (span.0, end), (0, span.1)]
        .map(|span| pass.near_within(record, corner, span))
        .into_iter()
        .fold((end, 0), |all, near| (all.0.min(near.0), all.1.max(near.1)));
    let rests = corner.tolerance == CornerTolerance::Rest;
    let leg = route.legs.get(number).filter(|_| pass.at.is_none() || !rests);
    let (Some(leg), MotionStart::BlendEnd) = (leg, record.choices.get::<MotionStart>()) else {
        return near;
    };
    let on_path = |sample: &usize| {
        let point = &record.point(*sample);
        // A blend is over within the first quarter of an arc.
        let quarters = (leg.curve.angle().abs() / std::f64::consts::FRAC_PI_2).ceil().max(1.0);
        let part = leg.curve.nearest(point, 0.0, 1.0 / quarters);
        distance(&leg.curve.at(part), point) <= record.slack && part > 0.0
    };
    let in_time = |sample: &usize| matching.legs(*sample).0 <= number;
    let blend_ends = |near: usize| {
        // A sample at the corner itself is on the path.
        let on_path = |sample: &usize| record.is_at(*sample, &corner.at) || on_path(sample);
        (near..record.len()).take_while(in_time).find(on_path).unwrap_or(near)
    };
    let first = if pass.at.is_some() { near.0 } else { blend_ends(near.0) };
    (first, blend_ends(near.1))
}

/// The samples that may be the first with the new value of an output that switches while the motion rests at a corner.
///
/// Each sample at the corner may be, for each time that the motion rests there. If the rest is between two samples, the
/// second one may be. If samples are farther apart than servo cycles, the rest may last longer than the last sample
/// there. If the motion runs back from the corner, for which it does not wait for outputs, the value of the last moment
/// is first in the next sample.
fn at_once(record: &Record<'_>, corner: &Corner, pass: CornerPass) -> Vec<(usize, usize)> {
    if pass.at.is_some() {
        let sparse = usize::from(record.period > record.limits.period * (1.0 + 1e-9));
        let after = |last: usize| {
            let turns = record.backwards.at(last + 1);
            sparse.max(usize::from(turns))
        };
        let stays = pass.stays(record, &corner.at);
        return stays.map(|(first, last)| (first, last + after(last))).collect();
    }
    // Without any rest the law of stops is broken, and the pair that passes the corner counts here.
    let near = pass.nearest(record, &corner.at);
    let (first, last) = rest_after(record, pass, &corner.at).unwrap_or((near, near));
    vec![(first + 1, last + 1)]
}

/// Compares the changes of a pin with the requested ones, one after the other.
fn compare(pin: Pin, values: &Paged<Number>, requested: &[Expected], findings: &mut Findings) {
    let same = |a: f64, b: f64| a.to_bits() == b.to_bits();
    let change = |sample: usize| {
        let value = values.get(sample);
        (!same(values.get(sample - 1), value)).then_some((sample, value))
    };
    let mut changes = (1..values.len()).filter_map(change).peekable();
    let mut now = values.iter().next().unwrap_or(0.0);
    for (place, wanted) in requested.iter().enumerate() {
        let brief = requested.get(place + 1).is_some_and(|next| next.first() <= wanted.last());
        let next = changes.peek().copied();
        if same(wanted.value, now) {
            continue;
        }
        match next {
            Some((sample, value))
                if same(value, wanted.value) && !(brief && sample > wanted.last()) =>
            {
                changes.next();
                now = value;
                let (off, when) = wanted.off(sample);
                let cycles = if off == 1 { "cycle" } else { "cycles" };
                let words = || {
                    format!("{pin} becomes {value} in cycle {sample}, {off} {cycles} too {when}")
                };
                findings.at_most(sample, None, (count(off), 0.0), (0.0, &words));
            }
            _ if brief || !wanted.certain => (),
            _ => {
                let words =
                    format!("{pin} does not become {} by cycle {}", wanted.value, wanted.last());
                findings.breaks(wanted.last(), None, (now, wanted.value), words);
            }
        }
    }
    for (sample, value) in changes {
        let words = format!("{pin} becomes {value} without a command");
        findings.breaks(sample, None, (value, now), words);
    }
}
