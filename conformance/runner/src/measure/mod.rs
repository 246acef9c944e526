//! Measures a controller: how large a number may be before it refuses, how fine its lengths are, how far it rounds a
//! corner. The suite checks rules; a measurement finds limits.
//!
//! A limit is searched by bisection, from a value that should pass to one that should not. So a controller that
//! accepts, refuses and accepts again has one of its edges reported.

mod bench;
mod blend;
mod measurement;
mod quantities;

pub use measurement::{Measured, Measurement};

use gaugeblock_adapter::Adapter;
use gaugeblock_vocabulary::{Effect, Event, Options, Outcome, State};

use bench::{Answer, Bench};
use quantities::{QUANTITIES, Quantity, Scale};

/// The names of all measurements, in order.
pub fn names() -> Vec<String> {
    let edges = QUANTITIES.iter().map(|quantity| quantity.id.to_owned());
    let blends = blend::TOLERANCES.iter().map(|tolerance| blend::id(*tolerance));
    edges.chain([RESOLUTION.to_owned()]).chain(blends).collect()
}

/// Makes the measurements that `wanted` accepts by name. Calls `after` with each result.
pub fn measure(
    controller: &dyn Adapter,
    options: &Options,
    wanted: impl Fn(&str) -> bool,
    mut after: impl FnMut(&Measurement),
) -> Vec<Measurement> {
    let mut measurements = Vec::new();
    let mut add = |measurement: Measurement| {
        after(&measurement);
        measurements.push(measurement);
    };
    for quantity in QUANTITIES.iter().filter(|quantity| wanted(quantity.id)) {
        add(edge(quantity, controller, options));
    }
    if wanted(RESOLUTION) {
        add(resolution(controller, options));
    }
    for tolerance in blend::TOLERANCES.iter().filter(|tolerance| wanted(&blend::id(**tolerance))) {
        add(blend::deviation(*tolerance, controller, options));
    }
    measurements
}

/// The name of the smallest step.
const RESOLUTION: &str = "resolution";

/// The edge of a quantity.
fn edge(quantity: &Quantity, controller: &dyn Adapter, options: &Options) -> Measurement {
    let mut bench = Bench::new(controller, options);
    let measured = search(quantity.scale, |value| bench.accepts(&(quantity.program)(value)));
    let measured = measured.unwrap_or_else(Measured::Nothing);
    if let Measured::Edge { refused, .. } = measured {
        bench.program = (quantity.program)(refused);
    }
    Measurement {
        id: quantity.id.to_owned(),
        title: quantity.title.to_owned(),
        unit: quantity.unit.to_owned(),
        measured,
        runs: bench.runs,
        program: bench.program,
    }
}

/// Finds where a controller stops to accept, within a scale.
///
/// # Errors
/// The controller does not judge a value. The text names the reason.
fn search(
    scale: Scale,
    mut accepts: impl FnMut(f64) -> Result<bool, String>,
) -> Result<Measured, String> {
    let (low, high) = scale.ends();
    if !accepts(low)? {
        return Ok(Measured::Below(low));
    }
    // A value far beyond the edge can take long, such as a deep call. So the search goes upward.
    let mut accepted = low;
    let mut refused = loop {
        if accepted >= high {
            return Ok(Measured::AtLeast(high));
        }
        let next = scale.beyond(accepted).min(high);
        match accepts(next) {
            Ok(true) => accepted = next,
            Ok(false) => break next,
            // The controller does not judge a large value: the accepted one is the result.
            Err(_) if accepted > low => return Ok(Measured::AtLeast(accepted)),
            Err(why) => return Err(why),
        }
    };
    while let Some(middle) = scale.between(accepted, refused) {
        if accepts(middle)? {
            accepted = middle;
        } else {
            refused = middle;
        }
    }
    Ok(Measured::Edge { accepted, refused })
}

/// The smallest step of X that changes the position, millimetres.
fn resolution(controller: &dyn Adapter, options: &Options) -> Measurement {
    let mut bench = Bench::new(controller, options);
    // A larger number is a finer step. The search finds the first step that does not change the position.
    let scale = Scale::Real { low: 1.0, high: 1e12, closeness: 0.02 };
    let measured = search(scale, |parts| {
        let step = 1.0 / parts;
        let program = quantities::step_program(step);
        match bench.answer(&program)? {
            Answer::Refused => Err("a move is refused".to_owned()),
            Answer::Accepted(outcome) => {
                let ends = ends(&outcome);
                match ends.as_slice() {
                    [] | [_] => Err("the controller reports no positions".to_owned()),
                    [.., before, last] => Ok(before.to_bits() != last.to_bits()),
                }
            }
        }
    });
    let measured = match measured {
        Ok(Measured::Edge { accepted, refused }) => {
            Measured::Edge { accepted: 1.0 / accepted, refused: 1.0 / refused }
        }
        Ok(Measured::AtLeast(parts)) => Measured::Below(1.0 / parts),
        Ok(Measured::Below(parts)) => Measured::AtLeast(1.0 / parts),
        Ok(other) => other,
        Err(why) => Measured::Nothing(why),
    };
    Measurement {
        id: RESOLUTION.to_owned(),
        title: "smallest step of X that changes the position".to_owned(),
        unit: "mm".to_owned(),
        measured,
        runs: bench.runs,
        program: bench.program,
    }
}

/// X at the end of each block that moves, from effects or else from states.
fn ends(outcome: &Outcome) -> Vec<f64> {
    let events = outcome.steps.iter().flat_map(|step| &step.events);
    let of_effects = events.filter_map(|event| {
        let Event::Do(Effect::StraightTraverse { end } | Effect::StraightFeed { end }) = event
        else {
            return None;
        };
        Some(end.x)
    });
    let of_effects: Vec<_> = of_effects.collect();
    if !of_effects.is_empty() {
        return of_effects;
    }
    let mut last = None;
    let states = outcome.steps.iter().filter_map(|step| {
        let Some(State::Rs274(state)) = &step.state else { return None };
        // A state has only the fields that have changed.
        last = state.position.map(|position| position.x).or(last);
        last
    });
    states.collect()
}

#[cfg(test)]
mod tests;
