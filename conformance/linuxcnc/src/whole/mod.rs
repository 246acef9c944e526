//! LinuxCNC's whole controller, version 2.9: headless, with a simulated machine.
//!
//! A scenario becomes a configuration (`setup`), which a controller in name spaces of its own is started with
//! (`session`) and kept for the next scenario that needs the same one (`pool`). Inside, a script of ours (`driver.py`)
//! is the display: it resets the controller, runs the program, plays the environment and the operator, and samples the
//! pins. The controller prints each block that it reads and each command that it issues (`stream`); commands become
//! settings and effects (`canon`), checkpoint lines within the program the state after each block, and all together an
//! outcome (`assemble`).
//!
//! Without an operator it reads ahead at most one command, so that all blocks before a refused one have been executed.
//!
//! Not observable: moves that do not move, the tool length mode apart from the offset, Q of G64, the limit of a
//! spindle's speed, and which of several spindles a command is for; their pins report that.

mod assemble;
mod canon;
mod order;
mod pool;
mod recorder;
mod reuse;
mod session;
mod setup;
mod stream;
mod supports;
mod trace;
mod version;

use std::collections::{BTreeMap, BTreeSet};
use std::num::NonZero;
use std::path::PathBuf;
use std::time::Duration;

use gaugeblock_adapter::{Adapter, ControllerError, HarnessError, NoSamples};
use gaugeblock_compare::Capabilities;
use gaugeblock_vocabulary::motion::{MotionLimits, Samples};
use gaugeblock_vocabulary::scenario::{Action, Start};
use gaugeblock_vocabulary::{Effect, LengthUnit, Outcome, Pin, Rs274State, Scenario, Settings};
use serde_json::Value;

use crate::instrumentation::instrument::{Ends, Plan, is_plain};
use crate::instrumentation::source::{DEBUG_SWITCH, Source};
use crate::instrumentation::workspace;
use assemble::Assembly;
use order::{after, order, plan};
use pool::Pool;
use reuse::{foreign_names, has, leaves_traces};
use session::Session;
use setup::Setup;
use stream::Item;

/// How long a run may take in real time; most take a tenth of a second.
const LONGEST_RUN: Duration = Duration::from_secs(30);

/// How much longer the driver has for the rest.
const SPARE: Duration = Duration::from_secs(15);

/// Fields that it does not show.
const HIDDEN_FIELDS: &[&str] = &["tool_length", "naive_cam_tolerance", "spindle_limit"];

/// Fields that commands report at their place among effects. Lengths are not among them, since a change of the unit is
/// not a command.
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

/// A machine in inches prints six decimals of an inch; a metric program has millimetres.
const RESOLUTION_IN_INCHES: f64 = 1.3e-5;

/// How long a pin's value lasts that is seen for sure: some cycles of the servo thread and of the I/O controller.
const PIN_PERIOD: f64 = 0.01;

/// Errors that one controller may report: it prints no more than 30, and each is counted twice.
const ERRORS_MAX: usize = 40;

/// How often a run is repeated if a fresh controller prints something unknown.
const CHANCES: u32 = 2;

/// The controller.
#[derive(Debug)]
pub struct LinuxCnc {
    capabilities: Capabilities,
    pool: Pool,
    longest: Duration,
}

impl LinuxCnc {
    /// Finds the installed controller and queries its version. Nothing is started yet.
    ///
    /// # Errors
    /// It is missing, is not of version 2.9, or the system does not allow name spaces of its own.
    pub fn find() -> Result<Self, ControllerError> {
        let version = version::query()?;
        Ok(Self {
            capabilities: capabilities(version),
            pool: Pool::default(),
            longest: LONGEST_RUN,
        })
    }

    /// Records the servo samples of a program, which it runs at its own pace.
    ///
    /// # Errors
    /// It cannot run the program to its end, or samples are lost; a servo period that is not a whole number of
    /// nanoseconds.
    pub fn record(&self, scenario: &Scenario, limits: &MotionLimits) -> Result<Samples, NoSamples> {
        self.supports(scenario).map_err(NoSamples::Unsupported)?;
        recorder::record(scenario, limits)
    }

    /// One run with all parameters that the plan names.
    fn run_once(
        &self,
        scenario: &Scenario,
        source: &Source,
        plan: &Plan,
        new: bool,
    ) -> Result<RecordedRun, HarnessError> {
        let setup = Setup::of(scenario);
        let tools = workspace::tool_table(&scenario.machine);
        let names = foreign_names(source);
        // Stored parameters change where the machine stands to begin with, and an abort brings back the speeds of the
        // programs before.
        let stores = !scenario.machine.parameters.0.is_empty();
        let aborts = scenario.operator.iter().any(|event| event.action == Action::Abort);
        // A controller that was used before may be other than a new one; then the run is repeated on a new one. One
        // that prints what it should not is given another chance there, too: on a loaded machine its real-time tasks
        // are too late.
        let mut chances = CHANCES;
        loop {
            let mut session = self.pool.take(&setup, &names, &tools, new || stores || aborts)?;
            let is_new = session.fresh.is_none();
            let recorded = match run_on(&mut session, scenario, source, plan, self.longest) {
                Ok(recorded) => recorded,
                Err(error) => {
                    self.pool.end(session);
                    let broke = matches!(error, HarnessError::Unreadable { .. });
                    if is_new && (chances == 0 || !broke) {
                        return Err(error);
                    }
                    chances -= u32::from(is_new);
                    continue;
                }
            };
            let first = recorded.items.iter().find_map(Item::checkpoint).cloned();
            let shows_same = first.as_ref().is_none_or(|first| {
                session.fresh.as_ref().is_none_or(|fresh| fresh.has_same_modes(first))
            });
            let is_same = is_new || shows_same && recorded.items.iter().all(Item::begins_as_new);
            if is_new {
                session.fresh = first;
            }
            session.names.extend(source.parameters().named);
            let machine_keeps = stores || scenario.machine.random_tool_changer;
            let keeps = machine_keeps || !session.setup.programs.is_empty();
            session.errors += recorded.items.iter().filter(|item| item.is_error()).count();
            let is_worn = session.errors > ERRORS_MAX;
            if !is_same || keeps || is_worn || leaves_traces(source, &recorded.items) {
                self.pool.end(session);
            } else {
                self.pool.give(session);
            }
            if is_same {
                return Ok(recorded);
            }
        }
    }
}

/// The observations of a run.
#[derive(Debug)]
struct RecordedRun {
    items: Vec<Item>,
    parameters: BTreeMap<u32, f64>,
}

impl Adapter for LinuxCnc {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    /// Under inverse time it reports the speed of a move, and not F.
    /// Of several spindles it does not tell which one a command is for; and under constant surface speed the pins
    /// of a spindle's speed, and with it of its brake, follow the radius, which is a matter of motion.
    fn observables(&self, scenario: &Scenario) -> Capabilities {
        let mut observables = self.capabilities.clone();
        let source = Source::new(&scenario.program);
        if source.has_code(&["g93"]) && source.has_code(&["g1", "g2", "g3"]) {
            observables.fields.remove("feed_rate");
            observables.fields_at_effects.remove("feed_rate");
        }
        if scenario.machine.length_unit == LengthUnit::Inch {
            observables.resolution = observables.resolution.max(RESOLUTION_IN_INCHES);
        }
        // The pins of a spindle at its angle say what an abort does with it, its commands do not.
        let aborts = scenario.operator.iter().any(|event| event.action == Action::Abort);
        if aborts && source.has_code(&["m19"]) {
            observables.fields.remove("spindle");
            observables.fields_at_effects.remove("spindle");
        }
        // A program that is left at a pause is aborted before its parameters can be read, and an abort selects what the
        // last motion had: another coordinate system, and whether the offset of G92 is active.
        if source.has_code(&["m0", "m00", "m1", "m01", "m60"]) {
            observables.hidden_parameters.extend([5210..=5210, 5220..=5220]);
        }
        if has(&source, "g96") {
            for pin in [Pin::SpindleSpeed(0), Pin::SpindleBrake(0)] {
                observables.pins.remove(pin.name());
            }
        }
        if scenario.machine.spindles > 1 {
            for hidden in ["orient_spindle", "wait_orient"] {
                observables.effects.remove(hidden);
            }
            observables.fields.remove("speed_override");
            if has(&Source::new(&scenario.program), "m19") {
                observables.fields.remove("spindle");
            }
        }
        observables
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        supports::supports(scenario)
    }

    /// Its task controller, which has the interpreter; the rest of it is named by the version alone.
    fn files(&self) -> Vec<PathBuf> {
        version::find("milltask").into_iter().collect()
    }

    /// By setup, since another one costs a start; within it first those that leave no residue.
    fn order_key(&self, scenario: &Scenario) -> String {
        let source = Source::new(&scenario.program);
        let leaves = reuse::words_leave_traces(&source);
        format!("{} {leaves}", Setup::of(scenario).key())
    }

    fn best_jobs(&self) -> Option<NonZero<usize>> {
        NonZero::new(pool::MOST)
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        self.observe(scenario, false)
    }

    fn observables_vary(&self) -> bool {
        true
    }

    fn own_edition(&self) -> Option<&str> {
        Some("linuxcnc-2.9")
    }

    fn observed_edition(&self) -> Option<&str> {
        Some("linuxcnc-2.9-observed")
    }

    fn run_fresh(&self, scenario: &Scenario) -> Option<Result<Outcome, HarnessError>> {
        Some(self.observe(scenario, true))
    }
}

impl LinuxCnc {
    /// Runs the scenario, perhaps more than once until all is seen that it changes.
    fn observe(&self, scenario: &Scenario, new: bool) -> Result<Outcome, HarnessError> {
        // What is refused here could reach the host: it must not run even if nobody asked before.
        self.supports(scenario).map_err(HarnessError::NotRun)?;
        let source = Source::new(&scenario.program);
        let mut more = BTreeSet::new();
        loop {
            let plan = plan(scenario, &source, &more);
            let recorded = self.run_once(scenario, &source, &plan, new)?;
            // Once more where it turns out that a parameter was written that no checkpoint showed.
            let is_unseen =
                |number: &u32| is_plain(*number) && !plan.parameters.contains(&number.to_string());
            let unseen: BTreeSet<_> = recorded
                .parameters
                .keys()
                .copied()
                .filter(is_unseen)
                .filter(|number| *number != DEBUG_SWITCH)
                .collect();
            if !source.parameters().indirect || unseen.is_subset(&more) {
                let parameters = hidden_parameters(recorded.parameters);
                return Assembly::outcome(
                    scenario,
                    &source,
                    &plan,
                    &recorded.items,
                    Some(parameters),
                );
            }
            more.extend(unseen);
        }
    }
}

/// Writes the program, gives the order, and reads what was printed.
fn run_on(
    session: &mut Session,
    scenario: &Scenario,
    source: &Source,
    plan: &Plan,
    longest: Duration,
) -> Result<RecordedRun, HarnessError> {
    session.clear_programs()?;
    session.add_late_programs()?;
    let mut by_hand = Value::Null;
    for (file, (name, lines)) in source.files().iter().enumerate() {
        let text = plan.with_checkpoints(file, lines, &Ends::default());
        if file == 0 && scenario.program.start == Start::Mdi {
            by_hand = text.lines().filter(|line| !line.trim().is_empty()).collect();
        }
        session.write(&format!("programs/{name}"), &text)?;
    }
    session.write("after.ngc", &after(scenario, source, plan))?;
    let listed = source.listed();
    session.write("parameters.new", &workspace::parameter_file(&scenario.machine, &listed))?;
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
    Ok(RecordedRun { items, parameters: session.parameters()? })
}

/// Parameters at the end, without those that only repeat position and tool.
fn hidden_parameters(parameters: BTreeMap<u32, f64>) -> BTreeMap<u32, f64> {
    parameters.into_iter().filter(|(number, _)| !(5399..=5428).contains(number)).collect()
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
        relative_resolution: 0.0,
        unconverted_lengths: BTreeMap::new(),
        fields: owned(&fields, HIDDEN_FIELDS),
        reports_all_fields: false,
        effects: owned(Effect::NAMES, HIDDEN_EFFECTS),
        pins: Pin::names().map(str::to_owned).collect(),
        pin_period: PIN_PERIOD,
        blocks: true,
        refuses: true,
        faults_have_blocks: true,
        faults_have_kinds: true,
        final_parameters: true,
        moves_in_place: false,
        fields_at_effects: owned(FIELDS_AT_EFFECTS, &[]),
        hidden_parameters: vec![5399..=5428],
    }
}

#[cfg(test)]
mod tests;
