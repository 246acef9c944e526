//! LinuxCNC's whole controller, version 2.9: headless, with a simulated machine.
//!
//! A scenario becomes a configuration (`setup`), which a controller in name spaces of its own is started with (`session`)
//! and kept for the next scenario that needs the same one (`pool`). Inside, a script of ours (`driver.py`) is the display:
//! it resets the controller, runs the program, plays the bench and the operator, and samples the pins. The controller
//! prints each block that it reads and each command that it issues (`stream`); commands become settings and effects
//! (`canon`), probe lines within the program the state after each block, and all together an outcome (`assemble`).
//!
//! Where no person interrupts, it reads ahead no more than one command, so that all that stands before a refused block
//! has been carried out.
//!
//! What it cannot show: moves that do not move, the tool length mode apart from the offset, Q of G64, the limit of a
//! spindle's speed, and which of several spindles a command is for; their pins tell.

mod assemble;
mod canon;
mod pool;
mod session;
mod setup;
mod stream;
mod supports;
mod trace;
mod version;

use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

use gaugeblock_trace::scenario::{Action, OperatorEvent, Start};
use gaugeblock_trace::{Effect, Outcome, Pin, Rs274State, Scenario, Settings};
use serde_json::{Value, json};

use super::probing::instrument::{Ends, GATE, Marks, Plan, is_plain};
use super::probing::source::{DEBUG_SWITCH, Source, code, has_slash};
use super::probing::workspace;
use super::{Adapter, Capabilities, ControllerError, HarnessError};
use assemble::Assembly;
use pool::Pool;
use session::Session;
use setup::Setup;
use stream::Item;

/// How long a run may take in real time; most take a tenth of a second.
const LONGEST_RUN: Duration = Duration::from_secs(30);

/// How much longer the driver has for the rest.
const SPARE: Duration = Duration::from_secs(15);

/// Feed override under which programs run whose pace nobody looks at.
const HURRY: f64 = 10_000.0;

/// Fields that it does not show.
const HIDDEN_FIELDS: &[&str] = &["tool_length", "naive_cam_tolerance", "spindle_limit"];

/// Fields that commands show in their place among effects; not lengths, since a change of the unit is no command.
const FIELDS_AT_EFFECTS: &[&str] =
    &["rotation", "path", "mist", "flood", "feed_override", "adaptive_feed", "feed_stop"];

/// Effects that it does not show, or not all of.
const HIDDEN_EFFECTS: &[&str] = &[
    "nurbs_feed",
    "straight_probe",
    "rigid_tap",
    "start_spindle_synchronisation",
    "stop_spindle_synchronisation",
    "set_tool_entry",
    "pallet_shuttle",
    "prompt_tool",
    "probe_log_open",
    "probe_log_close",
];

/// The controller.
#[derive(Debug)]
pub struct LinuxCnc {
    capabilities: Capabilities,
    pool: Pool,
    longest: Duration,
}

impl LinuxCnc {
    /// Finds the installed controller and asks for its version. Nothing is started yet.
    ///
    /// # Errors
    /// It is missing, is not of version 2.9, or the system does not allow name spaces of its own.
    pub fn find() -> Result<Self, ControllerError> {
        let version = version::ask()?;
        Ok(Self {
            capabilities: capabilities(version),
            pool: Pool::default(),
            longest: LONGEST_RUN,
        })
    }

    /// One run with all parameters that the plan names.
    fn run_once(
        &self,
        scenario: &Scenario,
        source: &Source,
        plan: &Plan,
    ) -> Result<Seen, HarnessError> {
        let setup = Setup::of(scenario);
        let tools = workspace::tool_table(&scenario.machine);
        let names = foreign_names(source);
        // A controller that was used before may be other than a new one; then the run is repeated on a new one.
        loop {
            let mut session = self.pool.take(&setup, &names, &tools)?;
            let is_new = session.fresh.is_none();
            let seen = match run_on(&mut session, scenario, source, plan, self.longest) {
                Ok(seen) => seen,
                Err(error) => {
                    self.pool.end(session);
                    if is_new { return Err(error) } else { continue }
                }
            };
            let first = seen.items.iter().find_map(Item::probe).cloned();
            let stores = !scenario.machine.parameters.0.is_empty();
            let is_same = stores
                || is_new
                || first.as_ref().is_none_or(|first| {
                    session.fresh.as_ref().is_none_or(|fresh| fresh.shows_same_modes(first))
                });
            if is_new && !stores {
                session.fresh = first;
            }
            session.names.extend(source.parameters().named);
            let keeps = scenario.machine.random_tool_changer || !session.setup.programs.is_empty();
            if !is_same || keeps || leaves_traces(source, &seen.items) {
                self.pool.end(session);
            } else {
                self.pool.give(session);
            }
            if is_same {
                return Ok(seen);
            }
        }
    }
}

/// What a run showed.
#[derive(Debug)]
struct Seen {
    items: Vec<Item>,
    parameters: BTreeMap<u32, f64>,
}

impl Adapter for LinuxCnc {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    /// Of several spindles it does not tell which one a command is for.
    fn shows(&self, scenario: &Scenario) -> Capabilities {
        let mut shows = self.capabilities.clone();
        if scenario.machine.spindles > 1 {
            for hidden in ["orient_spindle", "wait_orient"] {
                shows.effects.remove(hidden);
            }
            shows.fields.remove("speed_override");
        }
        shows
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        supports::supports(scenario)
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        // What is refused here could reach the host: it must not run even if nobody asked before.
        self.supports(scenario).map_err(HarnessError::NotRun)?;
        let source = Source::new(&scenario.program);
        let mut more = BTreeSet::new();
        loop {
            let plan = plan(scenario, &source, &more);
            let seen = self.run_once(scenario, &source, &plan)?;
            // Once more where it turns out that a parameter was written that no probe showed.
            let is_unseen =
                |number: &u32| is_plain(*number) && !plan.parameters.contains(&number.to_string());
            let unseen: BTreeSet<_> = seen
                .parameters
                .keys()
                .copied()
                .filter(is_unseen)
                .filter(|number| *number != DEBUG_SWITCH)
                .collect();
            if !source.parameters().indirect || unseen.is_subset(&more) {
                let parameters = shown_parameters(seen.parameters);
                return Assembly::outcome(scenario, &source, &plan, &seen.items, Some(parameters));
            }
            more.extend(unseen);
        }
    }
}

fn plan(scenario: &Scenario, source: &Source, more: &BTreeSet<u32>) -> Plan {
    let names = source.files().iter().map(|(name, _)| name);
    let file = |name: &str| names.clone().position(|known| known == name);
    let places = |wanted: fn(&OperatorEvent) -> bool| -> BTreeSet<(usize, u32)> {
        let events = scenario.operator.iter().filter(|event| wanted(event));
        let place =
            |event: &OperatorEvent| Some((file(&event.when.block.file)?, event.when.block.line));
        events.filter_map(place).collect()
    };
    let mut plan = Plan::new(source, &more.iter().copied().chain([5399]).collect());
    plan.marks = Some(Marks { before: places(|_| true), gates: places(is_switched_before) });
    plan
}

/// Whether an event sets a switch before its block begins.
fn is_switched_before(event: &OperatorEvent) -> bool {
    let is_switch = matches!(
        event.action,
        Action::OptionalStop(_)
            | Action::FeedOverride(_)
            | Action::RapidOverride(_)
            | Action::SpindleOverride { .. }
            | Action::FeedHold(_)
    );
    is_switch && event.when.offset <= 0.0
}

/// Writes the program, gives the order, and reads what was printed.
fn run_on(
    session: &mut Session,
    scenario: &Scenario,
    source: &Source,
    plan: &Plan,
    longest: Duration,
) -> Result<Seen, HarnessError> {
    session.clear_programs()?;
    session.add_late_programs()?;
    let mut by_hand = Value::Null;
    for (file, (name, lines)) in source.files().iter().enumerate() {
        let text = plan.probed(file, lines, &Ends::default());
        if file == 0 && scenario.program.start == Start::Mdi {
            by_hand = text.lines().filter(|line| !line.trim().is_empty()).collect();
        }
        session.write(&format!("programs/{name}"), &text)?;
    }
    session.write("after.ngc", &after(scenario, plan))?;
    let listed = source.listed();
    session.write("parameters.var", &workspace::parameter_file(&scenario.machine, &listed))?;
    let tools = workspace::tool_table(&scenario.machine);
    let load_tools = session.tools != tools;
    if load_tools {
        session.write("tools.tbl", &tools)?;
        session.tools = tools;
    }
    let mut order = order(scenario, source, plan, by_hand);
    order["load_tools"] = load_tools.into();
    order["seconds"] = longest.as_secs_f64().into();
    let lines = session.order(&order, longest + SPARE)?;
    let items = stream::items(&lines, plan)?;
    Ok(Seen { items, parameters: session.parameters()? })
}

fn order(scenario: &Scenario, source: &Source, plan: &Plan, by_hand: Value) -> Value {
    let inputs = scenario.bench.inputs.iter().filter_map(|change| {
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
    let events = scenario.operator.iter().filter_map(|event| {
        let mut told = action(&event.action);
        let place = file(&event.when.block.file)?;
        told["marker"] = plan.mark_before(place, event.when.block.line).into();
        told["execution"] = event.when.execution.into();
        // A block has begun once its command has gone out.
        let has_gate = plan
            .marks
            .as_ref()
            .is_some_and(|marks| marks.gates.contains(&(place, event.when.block.line)));
        let begins = if has_gate { GATE.parse().unwrap_or_default() } else { 0.0 };
        let begins = if is_switched_before(event) { 0.0 } else { begins + 0.004 };
        told["offset"] = (event.when.offset + begins).into();
        Some(told)
    });
    let may_stop = source.all().any(|(_, _, line)| {
        let code = code(line);
        code.contains("m1") || code.contains("m01") || code.contains("m#") || code.contains("m[")
    });
    json!({
        "marker": plan.marker,
        "first": plan.mark_after(0, 0),
        "steps": scenario.budget.steps,
        "optional_stop": may_stop.then_some(false),
        "block_delete": source.all().any(|(_, _, line)| has_slash(line)).then_some(scenario.program.block_delete),
        "feed_override": if setup::has_own_pace(scenario) { 1.0 } else { HURRY },
        "inputs": inputs.collect::<Vec<_>>(),
        "events": events.collect::<Vec<_>>(),
        "by_hand": by_hand,
        "program": "programs/main.ngc",
        "after": "after.ngc",
        "linger": true,
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

/// What is run after each program: a probe of what it left, and the way back to where the next one begins.
fn after(scenario: &Scenario, plan: &Plan) -> String {
    let axes: String = scenario
        .machine
        .axes
        .iter()
        .map(|axis| format!(" {}0", axis.word().to_uppercase()))
        .collect();
    let tool = if scenario.machine.random_tool_changer { "" } else { "M61 Q0\n" };
    format!("{}M71\nG40\nG90 G49\nG53 G0{axes}\n{tool}M2\n", plan.probe(0, 0))
}

/// Names that a program may find given a value by a program before it: they stay for as long as the controller runs.
/// One that is given a value before it is looked at, and before anything jumps, is not among them.
fn foreign_names(source: &Source) -> BTreeSet<String> {
    let mut own: BTreeSet<String> = BTreeSet::new();
    for (file, _, line) in source.all() {
        let text: String = line.to_lowercase().split_whitespace().collect();
        let assigned = text.strip_prefix("#<").and_then(|rest| rest.split_once(">="));
        let is_only = text.matches('#').count() == 1 || text.matches("#<").count() == 1;
        match assigned {
            Some((name, _)) if file == 0 && is_only => {
                own.insert(name.to_owned());
            }
            _ if text.starts_with('o') || text.contains("#<") => break,
            _ => {}
        }
    }
    let named = source.parameters().named.into_iter();
    named.filter(|name| !own.contains(name) && !name.contains('[')).collect()
}

/// Whether a run leaves something in the interpreter that no reset takes back: a loop that it was to leave or a call
/// that it was to repeat, or, after some refusals, the refusal itself.
fn leaves_traces(source: &Source, items: &[Item]) -> bool {
    let end = items.iter().position(Item::is_end).unwrap_or_default();
    let refuses_all = items[end..].iter().any(|item| matches!(item, Item::Refused(_)));
    let last = items[..end].iter().rev().find_map(Item::probe);
    let in_sub = last.is_some_and(|probe| probe.mode("_call_level") > 0);
    let has = |word: &str| source.all().any(|(_, _, line)| code(line).contains(word));
    refuses_all || has("continue") || has("break") || in_sub && has("m98")
}

/// Parameters at the end, without those that only repeat position and tool.
fn shown_parameters(parameters: BTreeMap<u32, f64>) -> BTreeMap<u32, f64> {
    parameters.into_iter().filter(|(number, _)| !(5400..=5428).contains(number)).collect()
}

fn capabilities(version: String) -> Capabilities {
    let owned = |names: &[&str], hidden: &[&str]| -> BTreeSet<String> {
        names.iter().filter(|name| !hidden.contains(name)).map(|name| (*name).to_owned()).collect()
    };
    let fields = [Settings::FIELDS, Rs274State::FIELDS].concat();
    Capabilities {
        name: "linuxcnc".to_owned(),
        version,
        resolution: 5.0e-6,
        fields: owned(&fields, HIDDEN_FIELDS),
        effects: owned(Effect::NAMES, HIDDEN_EFFECTS),
        pins: Pin::names().map(str::to_owned).collect(),
        faults_have_kinds: true,
        final_parameters: true,
        moves_in_place: false,
        fields_at_effects: owned(FIELDS_AT_EFFECTS, &[]),
        hidden_parameters: vec![5400..=5428],
    }
}

#[cfg(test)]
mod tests;
