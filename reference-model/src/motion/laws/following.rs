//! Whether the path is followed: deviation, corners, order, progress.

use gaugeblock_vocabulary::motion::{Column, PathMode};

use super::matching::{Matching, Miss, Missed};
use super::record::Record;
use super::verdict::{Findings, Law, Verdict, figure};
use crate::motion::route::{Leg, Route};
use crate::motion::vector::{AxisVector, direction, dot, from_segment, length, minus, plus};

type Matched<'a> = (Route<'a>, Matching);

fn matched<'r, 'a>(record: &'r Record<'a>) -> Result<&'r Matched<'a>, Verdict> {
    record.matched.as_ref().map_err(|why| Verdict::NotJudged(why.clone()))
}

fn missed(
    record: &Record<'_>,
    law: Law,
    words: impl Fn(&Route<'_>, &Miss) -> Option<String>,
) -> Result<Findings, Verdict> {
    let (route, matching) = matched(record)?;
    let mut findings = Findings::of(law);
    for miss in &matching.missed {
        if let Some(words) = words(route, miss) {
            findings.breaks(miss.sample, None, (miss.distance, miss.allowed), words);
        }
    }
    Ok(findings)
}

/// Calls a function with the distance of each sample from the legs that it matches; never if that is unknown.
pub(super) fn for_each_deviation(record: &Record<'_>, mut each: impl FnMut(f64)) {
    let Ok((route, matching)) = &record.matched else { return };
    for (sample, point) in record.recording.points().enumerate() {
        let (first, last) = matching.legs(sample);
        let legs = route.legs.get(first..=last).unwrap_or_default();
        each(legs.iter().map(|leg| leg.curve.away(&point)).reduce(f64::min).unwrap_or(0.0));
    }
}

/// Rule trajectory.deviation. Every commanded point is within P of the programmed path (G64 P, section 2.3.1.3: the
/// tool path can stay within the tolerance); on it where the path is exact (G61, G61.1: followed exactly). A row of
/// lines that may be merged is Q wider.
pub(super) fn deviation(record: &Record<'_>) -> Verdict {
    let words = |_: &Route<'_>, miss: &Miss| {
        let far = miss.what == Missed::Path;
        far.then(|| {
            format!(
                "{} mm from the path where {} are allowed",
                figure(miss.distance),
                figure(miss.allowed)
            )
        })
    };
    let findings = match missed(record, Law::Deviation, words) {
        Ok(findings) => findings,
        Err(verdict) => return verdict,
    };
    findings.verdict()
}

/// Rule trajectory.vertex. The commanded path passes every programmed corner within P (section 2.3.1.3: no more than
/// P from the actual endpoints), exactly where a leg is exact. A corner that may be merged is passed within P + Q.
/// Between two samples a motion can be a·h²/8 from their chord, and that much is granted.
pub(super) fn vertex(record: &Record<'_>) -> Verdict {
    let words = |route: &Route<'_>, miss: &Miss| match miss.what {
        Missed::Corner(corner) => {
            let block = &route.legs[corner - 1].element.block;
            Some(format!(
                "the end of {block} is passed at {} mm where {} are allowed",
                figure(miss.distance),
                figure(miss.allowed)
            ))
        }
        Missed::Path | Missed::Leg(_) | Missed::Middle(_) | Missed::Order => None,
    };
    match missed(record, Law::Vertex, words) {
        Ok(findings) => findings.verdict(),
        Err(verdict) => verdict,
    }
}

/// Rule trajectory.order. Every element that leads somewhere is passed, in the order of the program; one that leads
/// nowhere changes nothing. Where a controller records which element or line it executes, it names none that comes
/// before one that it named already, but while it runs backwards.
pub(super) fn order(record: &Record<'_>) -> Verdict {
    let last = record.len() - 1;
    let unfinished = |miss: &Miss| record.requests.aborted.is_some() && miss.sample == last;
    let words = |route: &Route<'_>, miss: &Miss| match miss.what {
        // What an abort leaves out is not lost.
        Missed::Leg(_) if unfinished(miss) => None,
        Missed::Leg(leg) => Some(format!("{} is not passed", route.legs[leg].element.block)),
        Missed::Path | Missed::Corner(_) | Missed::Middle(_) | Missed::Order => None,
    };
    let mut findings = match missed(record, Law::Order, words) {
        Ok(findings) => findings,
        Err(verdict) => return verdict,
    };
    let runs_back = record.requests.changes().iter().any(|request| request.adaptive < 0.0);
    if let Some(elements) = record.recording.column(Column::Element)
        && !runs_back
    {
        for sample in 1..record.len() {
            let (before, now) = (elements.get(sample - 1), elements.get(sample));
            if now < before {
                let words = format!("element {now} is named after element {before}");
                findings.breaks(sample, None, (now, before), words);
            }
        }
    }
    findings.verdict()
}

/// Rule trajectory.progress. The path is followed forwards, but that a negative adaptive feed runs it backwards (M52,
/// section 11.6.12), exactly as it came.
pub(super) fn progress(record: &Record<'_>) -> Verdict {
    let words = |_: &Route<'_>, miss: &Miss| {
        let back = miss.what == Missed::Order;
        back.then(|| {
            format!(
                "the path is followed backwards, {} mm from the sample before",
                figure(miss.distance)
            )
        })
    };
    match missed(record, Law::Progress, words) {
        Ok(findings) => findings.verdict(),
        Err(verdict) => verdict,
    }
}

/// Rule trajectory.midpoints. Without a tolerance (G64 alone) a corner is rounded between the middles of its legs:
/// the middle of each leg is passed, and between two of them the commanded point stays in the triangle of middle,
/// corner and middle: that of another corner does not count, since a sample stands for points between two middles
/// only after the first was passed. The manual says that each movement is touched at one point at least.
pub(super) fn midpoints(record: &Record<'_>) -> Verdict {
    let (route, matching) = match matched(record) {
        Ok(matched) => matched,
        Err(verdict) => return verdict,
    };
    if !route.legs.iter().any(|leg| leg.element.mode == PathMode::BetweenMidpoints) {
        return Verdict::NotApplicable;
    }
    let mut findings = Findings::of(Law::Midpoints);
    for miss in &matching.missed {
        if let Missed::Middle(leg) = miss.what {
            let block = &route.legs[leg].element.block;
            let words = format!("the middle of {block} is passed at {} mm", figure(miss.distance));
            findings.breaks(miss.sample, None, (miss.distance, miss.allowed), words);
        }
    }
    for sample in 0..record.len() {
        let (first, last) = matching.legs(sample);
        let plain = |leg: &Leg<'_>| {
            leg.element.mode == PathMode::BetweenMidpoints && leg.curve.is_straight()
        };
        if !route.legs[first..=last].iter().all(plain) {
            continue;
        }
        let away = matching
            .corners(sample)
            .iter()
            .map(|corner| from_corner(route, *corner, &record.point(sample)))
            .fold(f64::INFINITY, f64::min);
        let block = &route.legs[first].element.block;
        let words = || format!("{away} mm outside of the triangle at {block}", away = figure(away));
        findings.at_most(sample, None, (away, record.slack), (0.0, &words));
    }
    findings.verdict()
}

/// The distance of a point from the triangle of a corner and the middles of its legs. The middle of an arc makes no
/// triangle with a corner.
fn from_corner(route: &Route<'_>, corner: usize, point: &AxisVector) -> f64 {
    let at = route.corners[corner].at;
    let beside = [corner.checked_sub(1), Some(corner)].into_iter().flatten();
    let mut legs = beside.filter_map(|leg| route.legs.get(leg));
    if legs.any(|leg| !leg.curve.is_straight()) {
        return 0.0;
    }
    let middle = |leg: Option<&Leg<'_>>| leg.map_or(at, |leg| leg.curve.at(0.5));
    let before = corner.checked_sub(1).and_then(|leg| route.legs.get(leg));
    from_triangle([&middle(before), &at, &middle(route.legs.get(corner))], point)
}

/// The distance of a point from a triangle, in as many dimensions as there are.
fn from_triangle([a, b, c]: [&AxisVector; 3], point: &AxisVector) -> f64 {
    let edges = [(a, b), (b, c), (c, a)];
    let edge = edges
        .iter()
        .map(|(one, other)| from_segment(one, other, point))
        .fold(f64::INFINITY, f64::min);
    // Along one edge and across it, which keeps its digits however flat the triangle is.
    let (ab, ac, ap) = (minus(b, a), minus(c, a), minus(point, a));
    let Some(along) = direction(&ab) else { return edge };
    let height = plus(&ac, &along, -dot(&ac, &along));
    if length(&height) <= 1e-9 * length(&ac) {
        return edge;
    }
    // What rounding leaves of the first direction in a small height is no longer small in its direction.
    let height = plus(&height, &along, -dot(&height, &along));
    let Some(across) = direction(&height) else { return edge };
    let (x, y) = (dot(&ap, &along), dot(&ap, &across));
    let gamma = y / length(&height);
    let beta = (x - gamma * dot(&ac, &along)) / length(&ab);
    if beta < 0.0 || gamma < 0.0 || beta + gamma > 1.0 {
        return edge;
    }
    length(&plus(&plus(&ap, &along, -x), &across, -y)).min(edge)
}
