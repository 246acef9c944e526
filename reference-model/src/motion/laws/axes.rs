//! Velocity, acceleration and jerk of each axis, by differences of samples.
//!
//! A motion whose k-th derivative is bounded has k-th differences, over the k-th power of the period, within the same
//! bound, whatever the period: the difference is a mean of the derivative. What is added to a limit is what numbers
//! lose: 1e-9 of it, last places of the positions, and what a recorded position may be off.

use std::collections::VecDeque;

use gaugeblock_vocabulary::Axis;
use gaugeblock_vocabulary::motion::Column;
use gaugeblock_vocabulary::scenario::AxisLimits;

use super::record::Record;
use super::verdict::{Findings, Law, Verdict, figure};
use crate::motion::vector::last_place;

const RELATIVE: f64 = 1e-9;

/// A difference of samples and what rounding adds to it.
struct Order {
    law: Law,
    /// Factors of a position and of those before it.
    weights: &'static [f64],
    /// How many last places of a position it may be off.
    places: f64,
    limit: fn(&AxisLimits) -> Option<f64>,
    unit: &'static str,
}

/// Rule trajectory.velocity. The first difference of an axis is within its velocity (manual of 2.9, section 2.3.1.1:
/// maximum velocity and acceleration of an axis must be obeyed).
pub(super) fn velocity(record: &Record<'_>) -> Verdict {
    let limit = |limits: &AxisLimits| limits.velocity;
    differences(
        record,
        &Order { law: Law::Velocity, weights: &[1.0, -1.0], places: 1.0, limit, unit: "/s" },
    )
}

/// Rule trajectory.acceleration. The second difference of an axis is within its acceleration.
pub(super) fn acceleration(record: &Record<'_>) -> Verdict {
    let limit = |limits: &AxisLimits| limits.acceleration;
    let weights = &[1.0, -2.0, 1.0];
    differences(record, &Order { law: Law::Acceleration, weights, places: 2.0, limit, unit: "/s²" })
}

/// Rule trajectory.jerk. The third difference of an axis is within its jerk, where it has such a limit.
pub(super) fn jerk(record: &Record<'_>) -> Verdict {
    let limit = |limits: &AxisLimits| limits.jerk;
    if record.limits.axes.values().all(|limits| limits.jerk.is_none()) {
        return Verdict::NotApplicable;
    }
    let weights = &[1.0, -3.0, 3.0, -1.0];
    differences(record, &Order { law: Law::Jerk, weights, places: 4.0, limit, unit: "/s³" })
}

fn differences(record: &Record<'_>, order: &Order) -> Verdict {
    let mut findings = Findings::of(order.law);
    for axis in Axis::ALL.iter().copied() {
        let place = axis.place();
        let first = record.point(0)[place].to_bits();
        let stands = !record.moves(place);
        let recorded = record.recording.has(Column::Position(axis));
        let asked = record.path.elements.iter().filter_map(|element| element.end());
        if !recorded && asked.into_iter().any(|end| end.get(axis).to_bits() != first) {
            return Verdict::NotJudged(format!("{axis} moves and is not recorded"));
        }
        if stands {
            continue;
        }
        let Some(limit) = record.limits.axes.get(&axis).and_then(order.limit) else {
            if order.law == Law::Jerk {
                continue;
            }
            return Verdict::NotJudged(format!("{axis} moves and no limit of it is stated"));
        };
        one_axis(record, order, (axis, limit), &mut findings);
    }
    findings.verdict()
}

fn one_axis(
    record: &Record<'_>,
    order: &Order,
    (axis, limit): (Axis, f64),
    findings: &mut Findings,
) {
    let place = axis.place();
    let rate = order.weights[1..].iter().fold(1.0, |rate, _| rate / record.period);
    let written: f64 = order.weights.iter().map(|weight| weight.abs()).sum();
    let unit = if matches!(axis, Axis::A | Axis::B | Axis::C) { "degrees" } else { "mm" };
    let hidden = written * record.recording.resolution() * rate;
    findings.hides(hidden, limit, &|| format!("{unit}{} of {axis}", order.unit));
    // The values of the last samples, the latest first.
    let mut window: VecDeque<f64> = VecDeque::with_capacity(order.weights.len());
    for (sample, point) in record.recording.points().enumerate() {
        window.truncate(order.weights.len() - 1);
        window.push_front(point[place]);
        if window.len() < order.weights.len() {
            continue;
        }
        let values = window.iter().zip(order.weights);
        let measured: f64 = values.map(|(value, weight)| value * weight).sum();
        let measured = measured.abs() * rate;
        let size = window.iter().map(|value| last_place(*value)).fold(0.0, f64::max);
        let off = (order.places * size + written * record.recording.resolution()) * rate;
        let allowed = limit * (1.0 + RELATIVE) + off;
        let words = || {
            format!(
                "{axis} has {measured} {unit}{} where {limit} are allowed",
                order.unit,
                measured = figure(measured),
                limit = figure(limit)
            )
        };
        let at = sample + 1 + order.weights.len() / 2 - order.weights.len();
        findings.at_most(at, Some(axis), (measured, allowed), (limit, &words));
    }
}
