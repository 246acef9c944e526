//! Moves while the cutter is compensated: docs/compensation.md.

mod laws;
mod refusals;
mod waiting;
mod worked;

use gaugeblock_reference::run;
use gaugeblock_vocabulary::{
    Axis, Effect, End, Event, FaultKind, LengthUnit, Machine, Outcome, Position, Scenario, Tool,
};

/// A compensated move: its end in the plane, and of an arc the centre and the turns.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Move {
    /// G0.
    Rapid([f64; 2]),
    /// G1.
    Line([f64; 2]),
    /// G2, G3: end, centre, turns.
    Arc([f64; 2], [f64; 2], i32),
}

/// A machine in inches with tools of half an inch; the number of each is its orientation plus 10.
fn machine() -> Machine {
    let tool = |orientation: u8| Tool {
        number: 10 + u32::from(orientation),
        diameter: 0.5,
        orientation,
        ..Tool::default()
    };
    let negative = Tool { number: 20, diameter: -0.5, orientation: 2, ..Tool::default() };
    let tools = (0..10).map(tool).chain([negative]).collect();
    Machine { length_unit: LengthUnit::Inch, tools, axes: Axis::ALL.to_vec(), ..Machine::default() }
}

/// Runs blocks that semicolons separate, in inches and with a feed rate before them.
fn outcome(blocks: &str) -> Outcome {
    outcome_under(&[], blocks)
}

/// The same under these options.
fn outcome_under(options: &[(&str, &str)], blocks: &str) -> Outcome {
    let blocks: Vec<_> = blocks.split(';').map(str::trim).collect();
    let program = format!("g20 f10\n{}\n", blocks.join("\n"));
    let mut scenario = Scenario { machine: machine(), ..Scenario::of(program) };
    scenario.options.0 =
        options.iter().map(|(id, option)| ((*id).to_owned(), (*option).to_owned())).collect();
    run(&scenario).0
}

/// The same, which must end its program.
#[track_caller]
fn completed(blocks: &str) -> Outcome {
    let outcome = outcome(&format!("{blocks}; m2"));
    assert_eq!(outcome.end, End::ProgramEnd, "{blocks}\n{}", outcome.to_text());
    outcome
}

/// The effects with the lines of their blocks.
fn effects(outcome: &Outcome) -> Vec<(u32, Effect)> {
    let steps = outcome.steps.iter();
    steps
        .flat_map(|step| {
            step.events.iter().filter_map(|event| match event {
                Event::Do(effect) => Some((step.block.line, effect.clone())),
                Event::Set(_) | Event::Unknown(_) => None,
            })
        })
        .collect()
}

/// The moves in the XY plane, or in the plane of Z and X.
fn moves_in(outcome: &Outcome, plane: fn(Position) -> [f64; 2]) -> Vec<Move> {
    let effects = effects(outcome).into_iter();
    effects
        .filter_map(|(_, effect)| {
            if let Effect::StraightTraverse { end } = effect {
                Some(Move::Rapid(plane(end)))
            } else if let Effect::StraightFeed { end } = effect {
                Some(Move::Line(plane(end)))
            } else if let Effect::ArcFeed { end, first_centre, second_centre, turns } = effect {
                Some(Move::Arc(plane(end), [first_centre, second_centre], turns))
            } else {
                None
            }
        })
        .collect()
}

/// The ends of the feed moves with the lines of their blocks.
fn feed_ends(outcome: &Outcome) -> Vec<(u32, Position)> {
    let effects = effects(outcome).into_iter();
    effects
        .filter_map(|(line, effect)| {
            let (Effect::StraightFeed { end } | Effect::ArcFeed { end, .. }) = effect else {
                return None;
            };
            Some((line, end))
        })
        .collect()
}

/// The moves in the XY plane.
fn moves(outcome: &Outcome) -> Vec<Move> {
    moves_in(outcome, |end| [end.x, end.y])
}

/// Whether two moves are the same to the last few bits.
fn same(one: &Move, other: &Move) -> bool {
    let close = |one: &[f64; 2], other: &[f64; 2]| {
        (0..2).all(|place| (one[place] - other[place]).abs() < 1e-7)
    };
    match (one, other) {
        (Move::Rapid(one), Move::Rapid(other)) | (Move::Line(one), Move::Line(other)) => {
            close(one, other)
        }
        (Move::Arc(end, centre, turns), Move::Arc(other_end, other_centre, other_turns)) => {
            close(end, other_end) && close(centre, other_centre) && turns == other_turns
        }
        _ => false,
    }
}

/// Whether these are the moves.
#[track_caller]
fn leads(found: &[Move], expected: &[Move]) {
    let all = found.len() == expected.len()
        && found.iter().zip(expected).all(|(found, expected)| same(found, expected));
    assert!(all, "found {found:?}\nexpected {expected:?}");
}

/// How a run ended, in short: the kind of a fault or the name of the end, and the line.
fn ending(outcome: &Outcome) -> (&'static str, u32) {
    let line = |block: &gaugeblock_vocabulary::BlockLocation| block.line;
    match &outcome.end {
        End::Fault(fault) => {
            (fault.kind.map_or("a fault", FaultKind::word), fault.block.as_ref().map_or(0, line))
        }
        End::Unsupported { block, .. } => ("unsupported", line(block)),
        End::Unspecified { block, .. } => ("unspecified", line(block)),
        End::ProgramEnd
        | End::PercentEnd
        | End::StreamEnd
        | End::Endless
        | End::Paused
        | End::Aborted
        | End::BudgetExhausted { .. } => (outcome.end.name(), 0),
    }
}
