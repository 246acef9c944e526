//! Whether the two scenarios of a metamorphic pair have equal effects.

use gaugeblock_vocabulary::{
    Effect, End, Event, Fault, FaultKind, LengthUnit, Outcome, Position, Scenario, Settings,
};

use crate::generate::metamorphic::{Pair, Same};

/// Millimetres by which points may differ.
const TOLERANCE: f64 = 1e-6;

/// Runs both scenarios of a pair and compares what must be equal. A run without an outcome (`None`), or one that ends
/// as unsupported, unspecified or with its budget exhausted, is not compared.
///
/// # Errors
/// What differs, with both programs.
pub fn metamorphic(
    pair: &Pair,
    run: &mut dyn FnMut(&Scenario) -> Option<Outcome>,
) -> Result<(), String> {
    let (Some(one), Some(other)) = (run(&pair.one), run(&pair.other)) else { return Ok(()) };
    let silent = |outcome: &Outcome| {
        matches!(
            outcome.end,
            End::Unsupported { .. } | End::Unspecified { .. } | End::BudgetExhausted { .. }
        )
    };
    if silent(&one) || silent(&other) {
        return Ok(());
    }
    let equal = match pair.same {
        Same::Effects | Same::Commented => {
            effects(&one) == effects(&other) && settings(&one) == settings(&other)
        }
        Same::Path => close(&path(&one), &path(&other)),
    };
    let for_a_comment = pair.same == Same::Commented && lacks_its_end(&pair.one, &one);
    let same_kind = for_a_comment || kind(&one) == kind(&other);
    if equal && one.end.name() == other.end.name() && same_kind {
        return Ok(());
    }
    Err(format!(
        "{}:\n{}\n--- does\n{}\n--- and\n{}\n--- does\n{}",
        pair.name,
        pair.one.program.main,
        one.to_text(),
        pair.other.program.main,
        other.to_text()
    ))
}

fn kind(outcome: &Outcome) -> Option<FaultKind> {
    if let End::Fault(fault) = &outcome.end { fault.kind } else { None }
}

/// Whether a line was refused at its end.
fn lacks_its_end(scenario: &Scenario, outcome: &Outcome) -> bool {
    let End::Fault(Fault { block: Some(block), span: Some(span), .. }) = &outcome.end else {
        return false;
    };
    let line = scenario.program.line(block);
    line.is_some_and(|line| {
        usize::try_from(span.start).is_ok_and(|start| start >= line.trim_end().len())
    })
}

/// Effects of all blocks but a refused one.
fn effects(outcome: &Outcome) -> Vec<&Effect> {
    let fault = if let End::Fault(fault) = &outcome.end { fault.block.as_ref() } else { None };
    let last = outcome.steps.len().saturating_sub(1);
    let steps = outcome.steps.iter().enumerate();
    let counted = steps
        .filter(|(at, step)| !(*at == last && step.state.is_none() && fault == Some(&step.block)));
    let events = counted.flat_map(|(_, step)| &step.events);
    events
        .filter_map(|event| if let Event::Do(effect) = event { Some(effect) } else { None })
        .collect()
}

/// Settings at the end of a run that was not refused.
fn settings(outcome: &Outcome) -> Option<Settings> {
    let mut settings = outcome.start.clone();
    for event in outcome.steps.iter().flat_map(|step| &step.events) {
        if let Event::Set(change) = event {
            settings.overlay(change);
        }
    }
    (!matches!(outcome.end, End::Fault(_))).then_some(settings)
}

type Point = [f64; 3];

/// Where straight moves end, machine coordinates in millimetres, without points on the way.
fn path(outcome: &Outcome) -> Vec<Point> {
    let mut settings = outcome.start.clone();
    let mut points: Vec<Point> = vec![[0.0; 3]];
    for event in outcome.steps.iter().flat_map(|step| &step.events) {
        match event {
            Event::Set(change) => settings.overlay(change),
            Event::Do(Effect::StraightFeed { end } | Effect::StraightTraverse { end }) => {
                let point = machine(end, &settings);
                if let [.., before, last] = points.as_slice()
                    && on_the_way(before, last, &point)
                {
                    points.pop();
                }
                points.push(point);
            }
            Event::Do(_) | Event::Unknown(_) => {}
        }
    }
    points
}

fn machine(end: &Position, settings: &Settings) -> Point {
    let unit = if settings.units == Some(LengthUnit::Inch) { 25.4 } else { 1.0 };
    let sum = |positions: &[Option<Position>]| {
        let of = |coordinate: fn(&Position) -> f64| {
            positions.iter().flatten().map(coordinate).sum::<f64>()
        };
        [of(|p| p.x), of(|p| p.y), of(|p| p.z)]
    };
    // A system is turned about its origin, and what is programmed in it with it.
    let [x, y, z] = sum(&[Some(*end), settings.g92_offset]);
    let (sine, cosine) = libm::sincos(settings.rotation.unwrap_or_default().to_radians());
    let [dx, dy, dz] = sum(&[settings.g5x_offset, settings.tool_offset]);
    [x * cosine - y * sine + dx, x * sine + y * cosine + dy, z + dz].map(|part| part * unit)
}

/// Whether a point lies on the straight line between two others.
fn on_the_way(from: &Point, point: &Point, to: &Point) -> bool {
    let length =
        |a: &Point, b: &Point| a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
    (length(from, point) + length(point, to) - length(from, to)).abs() < TOLERANCE * 1e-3
}

fn close(a: &[Point], b: &[Point]) -> bool {
    let near = |(a, b): (&Point, &Point)| a.iter().zip(b).all(|(a, b)| (a - b).abs() < TOLERANCE);
    a.len() == b.len() && a.iter().zip(b).all(near)
}
