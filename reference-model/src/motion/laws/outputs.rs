//! When outputs switch.

use std::collections::BTreeMap;

use gaugeblock_trace::Pin;
use gaugeblock_trace::motion::Column;

use super::record::Record;
use super::verdict::{Findings, Law, Verdict};
use super::visits::{Visit, visits};
use crate::motion::route::{Corner, Task};
use crate::motion::vector::count;

/// A change of an output that the path asks for, and the samples that may show it first.
#[derive(Clone, Copy, Debug)]
struct Expected {
    value: f64,
    first: usize,
    last: usize,
}

/// Rule trajectory.outputs. An output of M62, M63 or M67 switches at the start of the next motion (sections 11.6.15 and
/// 11.6.17): in the sample that is nearest to the corner, or a cycle beside it; where the motion rests at the corner, beside the last
/// sample there. Of several settings before that motion the latest counts; one without a motion after it never switches.
/// An output of M64, M65 or M68 switches at once: while the motion rests where it was programmed. Nothing else switches. A value
/// that lasts for no time may be missing.
pub(super) fn outputs(record: &Record<'_>) -> Verdict {
    let (route, matching) = match &record.matched {
        Ok(matched) => matched,
        Err(why) => return Verdict::NotJudged(why.clone()),
    };
    let mut expected: BTreeMap<Pin, Vec<Expected>> = BTreeMap::new();
    for (corner, visit) in route.corners.iter().zip(visits(record, route, matching)) {
        let Some(visit) = visit else { break };
        for task in &corner.tasks {
            ask(record, corner, visit, task, &mut expected);
        }
    }
    let unrecorded = expected.keys().find(|pin| !record.samples.has(Column::Output(**pin)));
    if let Some(pin) = unrecorded {
        return Verdict::NotJudged(format!("{pin} is asked to switch and is not recorded"));
    }
    let mut findings = Findings::of(Law::Outputs);
    let mut recorded = false;
    for column in record.samples.columns() {
        if let Column::Output(pin) = column {
            recorded = true;
            let values = record.samples.column(*column).unwrap_or_default();
            let asked = expected.remove(pin).unwrap_or_default();
            compare(*pin, &values, &asked, &mut findings);
        }
    }
    if recorded { findings.verdict() } else { Verdict::NothingAsked }
}

fn ask(
    record: &Record<'_>,
    corner: &Corner,
    visit: Visit,
    task: &Task,
    expected: &mut BTreeMap<Pin, Vec<Expected>>,
) {
    match task {
        Task::Dwell(_) | Task::Wait(_) => (),
        Task::AtOnce(switching) => {
            // A moment of rest between two samples may be seen in either.
            let near = visit.nearest(record, &corner.at);
            let (first, last) = visit.at.unwrap_or((near.saturating_sub(1), near + 1));
            let new = Expected { value: switching.value, first, last };
            expected.entry(switching.pin).or_default().push(new);
        }
        Task::WithMotion(switches) => {
            let near = visit.nearest(record, &corner.at);
            for switching in switches {
                let (first, last) = (near.saturating_sub(1), near + 1);
                let new = Expected { value: switching.value, first, last };
                expected.entry(switching.pin).or_default().push(new);
            }
        }
    }
}

/// Holds the changes of a pin against those that are asked for, one after the other.
fn compare(pin: Pin, values: &[f64], asked: &[Expected], findings: &mut Findings) {
    let same = |a: f64, b: f64| a.to_bits() == b.to_bits();
    let changes = values.windows(2).enumerate().filter(|(_, pair)| !same(pair[0], pair[1]));
    let mut changes = changes.map(|(sample, pair)| (sample + 1, pair[1])).peekable();
    let mut now = values.first().copied().unwrap_or(0.0);
    for (place, wanted) in asked.iter().enumerate() {
        let brief = asked.get(place + 1).is_some_and(|next| next.first <= wanted.last);
        let next = changes.peek().copied();
        if same(wanted.value, now) {
            continue;
        }
        match next {
            Some((sample, value)) if same(value, wanted.value) => {
                changes.next();
                now = value;
                let off = if sample < wanted.first {
                    wanted.first - sample
                } else {
                    sample.saturating_sub(wanted.last)
                };
                let when = if sample < wanted.first { "early" } else { "late" };
                let words =
                    || format!("{pin} becomes {value} in cycle {sample}, {off} cycles too {when}");
                findings.at_most(sample, None, (count(off), 0.0), (0.0, &words));
            }
            _ if brief => (),
            _ => {
                let words =
                    format!("{pin} does not become {} by cycle {}", wanted.value, wanted.last);
                findings.breaks(wanted.last, None, (now, wanted.value), words);
            }
        }
    }
    for (sample, value) in changes {
        let words = format!("{pin} becomes {value}, which nothing asks for here");
        findings.breaks(sample, None, (value, now), words);
    }
}
