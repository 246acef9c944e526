//! Measures a controller: how large a number may be before it refuses, how fine its lengths are, how far it rounds a
//! corner. The suite asks whether a rule is kept; a measurement says where the edge is.
//!
//! A limit is searched by bisection, from a value that should pass to one that should not. So a controller that
//! accepts, refuses and accepts again has one of its edges reported.

mod blend;
mod quantities;

use gaugeblock_adapter::Adapter;
use gaugeblock_vocabulary::{Effect, End, Event, Options, Outcome, Scenario, State};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use quantities::{QUANTITIES, Quantity, Scale};

/// What was measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Measured {
    /// The edge is between the two.
    Edge {
        /// The last value that was accepted.
        accepted: f64,
        /// The first value that was not.
        refused: f64,
    },
    /// The largest value that was tried is accepted.
    AtLeast(f64),
    /// The smallest value that was tried is refused.
    Below(f64),
    /// A value that is read off.
    Value(f64),
    /// Nothing was measured, and why.
    Nothing(String),
}

/// A measurement of a controller.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Measurement {
    /// Its name, such as `arc-end-radius-10`.
    pub id: String,
    /// What it is, as a phrase.
    pub title: String,
    /// The unit; empty for a count.
    pub unit: String,
    /// The result.
    pub measured: Measured,
    /// How many programs were run.
    pub runs: u32,
    /// The program at the edge: the first that is refused, or else the last that ran.
    pub program: String,
}

/// The names of all measurements, in order.
pub fn names() -> Vec<String> {
    let edges = QUANTITIES.iter().map(|quantity| quantity.id.to_owned());
    let blends = blend::TOLERANCES.iter().map(|tolerance| blend::id(*tolerance));
    edges.chain([RESOLUTION.to_owned()]).chain(blends).collect()
}

/// Measures what is wanted by its name; `after` is called with each measurement.
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

/// How a controller takes a program.
enum Answer {
    Accepted(Box<Outcome>),
    Refused,
}

/// Runs programs and counts them.
struct Bench<'a> {
    controller: &'a dyn Adapter,
    options: &'a Options,
    runs: u32,
    program: String,
}

impl<'a> Bench<'a> {
    fn new(controller: &'a dyn Adapter, options: &'a Options) -> Self {
        Self { controller, options, runs: 0, program: String::new() }
    }

    fn scenario(&self, program: &str) -> Scenario {
        Scenario { options: self.options.clone(), ..Scenario::of(program) }
    }

    /// Runs a program to its end.
    ///
    /// # Errors
    /// The reason why that says nothing: the controller does not have what the program needs, or fails.
    fn answer(&mut self, program: &str) -> Result<Answer, String> {
        let scenario = self.scenario(program);
        self.controller.supports(&scenario)?;
        self.runs += 1;
        program.clone_into(&mut self.program);
        let outcome = self.controller.run(&scenario).map_err(|error| error.to_string())?;
        match &outcome.end {
            End::ProgramEnd | End::PercentEnd | End::StreamEnd => {
                Ok(Answer::Accepted(Box::new(outcome)))
            }
            End::Fault(_) => Ok(Answer::Refused),
            End::Unsupported { what, .. } => Err(what.clone()),
            End::Unspecified { why, .. } => Err(format!("the documents leave it open: {why}")),
            End::BudgetExhausted { .. } => {
                Err("the program takes longer than its budget".to_owned())
            }
            End::Endless | End::Paused | End::Aborted => Err("the program does not end".to_owned()),
        }
    }

    fn accepts(&mut self, program: &str) -> Result<bool, String> {
        Ok(matches!(self.answer(program)?, Answer::Accepted(_)))
    }
}

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
/// The reason why a value says nothing.
fn search(
    scale: Scale,
    mut accepts: impl FnMut(f64) -> Result<bool, String>,
) -> Result<Measured, String> {
    let (low, high) = scale.ends();
    if !accepts(low)? {
        return Ok(Measured::Below(low));
    }
    // What is far beyond the edge can be costly, such as a deep call: the search comes from below.
    let mut accepted = low;
    let mut refused = loop {
        if accepted >= high {
            return Ok(Measured::AtLeast(high));
        }
        let next = scale.beyond(accepted).min(high);
        match accepts(next) {
            Ok(true) => accepted = next,
            Ok(false) => break next,
            // The controller has no answer for a large value: what it has accepted stands.
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
    // Growing numbers are coarser steps; the search is for the first that is not seen.
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
        // A state has what has changed.
        last = state.position.map(|position| position.x).or(last);
        last
    });
    states.collect()
}

#[cfg(test)]
mod tests;
