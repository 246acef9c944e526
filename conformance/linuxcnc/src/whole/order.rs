//! The orders for a scenario: how its program is observed, what the driver does meanwhile, and how it returns to where
//! the next program begins.

use std::collections::BTreeSet;

use gaugeblock_vocabulary::scenario::{Action, OperatorEvent, Start};
use gaugeblock_vocabulary::{Axis, End, LengthUnit, Scenario};
use serde_json::{Value, json};

use super::reuse::has;
use super::setup;
use crate::instrumentation::instrument::{Marks, Plan};
use crate::instrumentation::source::{Source, code, has_slash};

/// Feed override for programs whose pace is not compared; the operator's factors multiply it.
const HURRY: f64 = 10_000.0;

/// The parameter that holds what M66 has read.
const INPUT_READ: &str = "5399";

/// How a program is observed, with `more` parameters than it names.
pub(super) fn plan(scenario: &Scenario, source: &Source, more: &BTreeSet<u32>) -> Plan {
    let names = source.files().iter().map(|(name, _)| name);
    let file = |name: &str| names.clone().position(|known| known == name);
    let place =
        |event: &OperatorEvent| Some((file(&event.when.block.file)?, event.when.block.line));
    let mut plan = Plan::new(source, more);
    // What an M66 reads; no effect but this one needs it.
    if source.all().any(|(_, _, line)| code(line).contains('m')) && !source.names_line() {
        plan.parameters.retain(|name| name != INPUT_READ);
        plan.parameters.push(INPUT_READ.to_owned());
    }
    let is_parallel = |axis: &Axis| matches!(axis, Axis::U | Axis::V | Axis::W);
    // A comment is not a command: the driver does not see those that wait.
    plan.compensates = false;
    plan.parallel_axes = scenario.machine.axes.iter().any(is_parallel);
    plan.marks = Some(Marks { before: scenario.operator.iter().filter_map(place).collect() });
    plan
}

/// Whether an event comes as its block begins, before anything of it is executed. What lets a program that pauses go on
/// comes once it pauses.
fn comes_before(event: &OperatorEvent) -> bool {
    let goes_on = matches!(event.action, Action::CycleStart | Action::Resume);
    !goes_on && event.when.offset <= 0.0
}

/// What the driver is to do; the blocks that are entered `by_hand`, if they are.
pub(super) fn order(scenario: &Scenario, source: &Source, plan: &Plan, by_hand: Value) -> Value {
    let inputs = scenario.environment.inputs.iter().filter_map(|change| {
        let pin = setup::input_pin(&change.input)?;
        let is_bit = pin.contains("digital") || pin.ends_with("feed-hold");
        let value = if is_bit {
            u8::from(change.value > 0.5).to_string()
        } else {
            change.value.to_string()
        };
        Some(json!([change.time, pin, value]))
    });
    let file = |name: &str| source.files().iter().position(|(known, _)| known == name);
    let mut entered = 0;
    let events = scenario.operator.iter().filter_map(|event| {
        let mut command = action(&event.action);
        if matches!(event.action, Action::Mdi(_)) {
            entered += 1;
            command["line"] = entered.into();
        }
        let (place, line) = (file(&event.when.block.file)?, event.when.block.line);
        let before = comes_before(event);
        let marker =
            if before { plan.mark_gate(place, line) } else { plan.mark_before(place, line) };
        command["marker"] = marker.into();
        command["execution"] = event.when.execution.into();
        // A block has begun once its command has gone out.
        command["offset"] = (event.when.offset + if before { 0.0 } else { 0.004 }).into();
        Some(command)
    });
    let before = plan.marks.iter().flat_map(|marks| &marks.before);
    let gates: Vec<_> = before.map(|(file, line)| plan.mark_gate(*file, *line)).collect();
    let may_stop = source.all().any(|(_, _, line)| {
        let code = code(line);
        code.contains("m1") || code.contains("m01") || code.contains("m#") || code.contains("m[")
    });
    json!({
        "marker": plan.marker,
        "gates": gates,
        "reads_ahead": setup::reads_ahead(scenario) && scenario.program.start != Start::Mdi,
        "first": plan.mark_after(0, 0),
        "steps": scenario.budget.steps,
        "turns": End::TURNS,
        "optional_stop": may_stop.then_some(false),
        "block_delete": source.all().any(|(_, _, line)| has_slash(line)).then_some(scenario.program.block_delete),
        "feed_override": if setup::has_own_pace(scenario) { 1.0 } else { HURRY },
        "inputs": inputs.collect::<Vec<_>>(),
        "events": events.collect::<Vec<_>>(),
        "by_hand": by_hand,
        "checkpoint": plan.checkpoint(0, 0).lines().collect::<Vec<_>>(),
        "program": "programs/main.ngc",
        "after": "after.ngc",
    })
}

fn action(action: &Action) -> Value {
    match action {
        Action::CycleStart => json!({ "action": "cycle_start" }),
        Action::Pause => json!({ "action": "pause" }),
        Action::Resume => json!({ "action": "resume" }),
        Action::Abort => json!({ "action": "abort" }),
        Action::Mode(mode) => json!({ "action": "mode", "value": mode.to_string() }),
        Action::Mdi(block) => json!({ "action": "mdi", "value": block }),
        Action::OptionalStop(on) => json!({ "action": "optional_stop", "value": on }),
        Action::FeedOverride(factor) => json!({ "action": "feed_override", "value": factor }),
        Action::RapidOverride(factor) => json!({ "action": "rapid_override", "value": factor }),
        Action::SpindleOverride { spindle, factor } => {
            json!({ "action": "spindle_override", "value": factor, "spindle": spindle })
        }
        Action::FeedHold(on) => json!({ "action": "feed_hold", "value": on }),
    }
}

/// The blocks that run after each program: a checkpoint of the state that it left, and the return to the initial state.
pub(super) fn after(scenario: &Scenario, source: &Source, plan: &Plan) -> String {
    let machine = &scenario.machine;
    let switches = (2..=8).any(|code| has(source, &format!("m6{code}")))
        || has(source, "m[")
        || has(source, "m#");
    let mut outputs = String::new();
    if switches {
        let digital = (0..machine.digital_io).map(|output| format!("M65 P{output}\n"));
        let analog = (0..machine.analog_io).map(|output| format!("M68 E{output} Q0\n"));
        outputs = digital.chain(analog).collect();
    }

    // All away, then back one after another: an axis that moves with others, or stays where an arc has ended, is a
    // rounding away from where it began.
    let words = machine.axes.iter().map(|axis| axis.word().to_uppercase());
    let words: Vec<_> = words.collect();
    let away: String = words.iter().map(|word| format!(" {word}1")).collect();
    let back: String = words.iter().map(|word| format!("G53 G0 {word}0\nG4 P0.001\n")).collect();
    // The angle that was asked for last stays at the pins.
    let turns_back = has(source, "m19") && scenario.environment.orient.is_empty();
    let spindles = (0..machine.spindles).filter(|_| turns_back);
    outputs.extend(spindles.map(|spindle| format!("M19 R0 Q1 ${spindle}\nM5 ${spindle}\n")));
    // The last motion is one in the initial modes: an abort of the next program may bring them back.
    let unit = match machine.length_unit {
        LengthUnit::Millimetre => "G21",
        LengthUnit::Inch => "G20",
    };
    let spindles = 0..machine.spindles;
    let stopped: String = spindles.map(|spindle| format!("G97 S0 ${spindle}\n")).collect();
    // The controller stands off a corner that it has rounded: a wait parts the two ways.
    let tool = if scenario.machine.random_tool_changer { "" } else { "M61 Q0\n" };
    format!(
        "{}M71\nG40\n{stopped}G17 {unit} G90 G94 G99 G49 F0\nG53 G0{away}\nG4 P0.001\n{back}{tool}{outputs}M2\n",
        plan.checkpoint(0, 0)
    )
}
