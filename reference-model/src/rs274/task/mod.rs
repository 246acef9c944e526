//! The run: a program or lines entered by hand, the operator's events, and the end.
//!
//! | room | what it settles |
//! | --- | --- |
//! | [`program`] | block after block: parsed, evaluated, checked, executed, recorded |
//! | [`operator`] | what the operator does, and when |
//! | [`mod@run`] | the state of a run |
//! | [`profile`] | the subroutine with the profile of a lathe cycle |
//! | [`moves`] | moves of a block that are held where they begin |
//! | [`wait`] | the operator's events while the program waits, pauses or is stopped |
//! | [`request`] | what the controller does with a request, or refuses, by its mode |
//! | [`idle`] | while no program runs: blocks by hand, cycle start |
//! | [`abort`] | the state after an abort |
//! | [`pins`] | the values of the machine's pins |
//! | [`record`] | what is observed |
//! | [`effects`] | kinds of effects: moves, and what waits with a compensated move |
//! | [`waiting`] | effects that wait until the next compensated move is known |
//! | [`watch`] | moves and waits of a phase, looked at one by one |

mod abort;
mod effects;
mod idle;
mod moves;
mod operator;
mod pins;
mod profile;
mod program;
mod record;
mod request;
mod run;
mod wait;
mod waiting;
mod watch;

use std::borrow::Cow;
use std::sync::Arc;

use gaugeblock_vocabulary::scenario::Start;
use gaugeblock_vocabulary::{
    BlockLocation, Bound, ControllerMode, End, Fault, FaultKind, Indexed, Language, Options,
    Outcome, Position, Program, Scenario, Settings, Shared,
};

pub(crate) use pins::update_pins;
pub use record::Record;

use self::run::ModelRun;
use super::control::{Control, Frame, MAIN};
use super::environment::EnvironmentState;
use super::execute;
use super::modes::{Modes, Rounding};
use super::parameters::{self, Name, Parameters};
use super::refusal::{Refusal, StepError};
use super::state::{Contour, Curve, Panel, State, in_pocket_zero, slots};
use super::syntax::Room;
use crate::Choices;
use crate::Consulted;
use crate::RuleCoverage;
use crate::dialects::Memory;
use crate::ids::{choice, rule};

/// What a run leaves for the next one, so that it need not be made again.
#[derive(Debug, Default)]
pub struct RunCache {
    /// How the documents are read under some options.
    choices: Option<(Options, Shared<Choices>)>,
    /// Room for what the parser makes of a line.
    room: Room,
    /// What the runs consult; none if it is not recorded.
    consulted: Option<Arc<Consulted>>,
}

impl RunCache {
    /// A cache that records what its runs consult.
    pub(crate) fn consulting(consulted: Arc<Consulted>) -> Self {
        Self { consulted: Some(consulted), ..Self::default() }
    }

    /// How the documents are read under some options, which are most often those of the run before.
    pub(super) fn choices(&mut self, options: &Options) -> Result<Shared<Choices>, String> {
        if let Some((known, choices)) = &self.choices
            && known == options
        {
            return Ok(choices.clone());
        }
        let mut choices = Choices::new(options)?;
        choices.consulted.clone_from(&self.consulted);
        let choices = Shared::from(choices);
        self.choices = Some((options.clone(), choices.clone()));
        Ok(choices)
    }
}

/// Runs a scenario as the documents say; how positions are rounded they leave open.
///
/// Options that the model does not know end the run before its first block.
pub fn run(
    cache: &mut RunCache,
    scenario: &Scenario,
    rounding: Rounding,
) -> (Outcome, RuleCoverage) {
    let choices = match cache.choices(&scenario.options) {
        Ok(choices) => choices,
        Err(what) => return (not_begun(what), RuleCoverage::default()),
    };
    let mut state = start(scenario, choices, rounding);
    state.room = std::mem::take(&mut cache.room);
    state.coverage.accepted(rule::modal_groups::INITIAL_MODES);
    state.coverage.accepted(rule::modal_groups::POWER_UP);
    state.coverage.accepted(rule::offsets::START_SYSTEM);
    let mut record = Record::new(&state);
    record.allow(&scenario.budget);
    let mut run = ModelRun::new(scenario, state, record);
    let end = run.whole();
    if run.is_within_block && leaves_nothing(&end) {
        run.before_block();
    }
    if !matches!(end, End::Paused | End::Aborted) {
        run.record.lose_waiting();
    }
    run.leave_calls();
    let parameters = run.parameters();
    let pins = run.state.environment.changes().to_vec();
    cache.room = run.state.room;
    (run.record.finish(end, parameters, pins), run.state.coverage)
}

/// Whether a block during which the run ends so has done nothing: one that is refused, or that requests more effects
/// than there are.
fn leaves_nothing(end: &End) -> bool {
    match end {
        End::Fault(_) => true,
        End::BudgetExhausted { bound } => *bound == Bound::Effects,
        End::ProgramEnd
        | End::PercentEnd
        | End::StreamEnd
        | End::Endless
        | End::Aborted
        | End::Paused
        | End::Unsupported { .. }
        | End::Unspecified { .. } => false,
    }
}

/// Operations of the run that a dialect can replace.
pub(crate) trait TaskRules {
    /// Before the first block the machine is at its zero.
    fn stand_at_start(&self, state: &mut State) {
        state.position = state.modes.program_point(Position::default());
    }

    /// The modes as they are recorded.
    fn reported_modes<'s>(&self, state: &'s State) -> Cow<'s, Modes> {
        Cow::Borrowed(&state.modes)
    }

    /// Rule parameters.returned-value. What the last program's subs have returned is 0 when a program starts.
    fn forget_returned_value(&self, state: &mut State) {
        state.parameters.returned = 0.0;
    }

    /// An abort leaves the modes as they are. Whether it changes them.
    fn change_modes_at_abort(&self, _state: &mut State) -> bool {
        false
    }

    /// Rule parameters.returned-value. Another mode of the controller does not change what a sub has returned.
    fn mode_has_changed(&self, _state: &mut State) {}

    /// Somebody requests the mode in which the controller is: nothing changes.
    fn request_same_mode(&self, _is_running: bool, _state: &State) -> Result<(), StepError> {
        Ok(())
    }

    /// Rule abort.read-ahead. How a run ends that is aborted, although a block ahead of the interrupted one would have
    /// been refused: reading ahead executes nothing. `is_first` is whether no block has been executed.
    fn end_before_fault(&self, _fault: Fault, _is_first: bool, _state: &State) -> End {
        End::Aborted
    }

    /// Rule pause.pallet-restart. Whether cycle start lets the program go on after M60.
    fn goes_on_after_pallets(&self, _state: &State) -> bool {
        true
    }

    /// Rule fanuc-subs.shared-parameters. #1 to #30 of the main program, once the run is over in a subprogram that
    /// shares them.
    fn arguments_left(&self, called: &Frame, _control: &Control, _choices: &Choices) -> [f64; 30] {
        called.arguments
    }
}

/// The state before the first block.
pub(super) fn start(scenario: &Scenario, choices: Shared<Choices>, rounding: Rounding) -> State {
    let machine = scenario.machine.clone();
    let mut modes = Modes { rounding, ..Modes::new(&machine, &choices) };
    if scenario.program.start == Start::Mdi {
        modes.controller_mode = ControllerMode::Mdi;
    }
    let environment = EnvironmentState::new(&scenario.environment, modes.spindles.len(), &choices);
    let tool = in_pocket_zero(&machine);
    let mut state = State {
        position: Position::default(),
        modes,
        parameters: Parameters::new(&machine, &choices),
        choices,
        panel: Panel::new(&machine),
        environment,
        machine: machine.into(),
        tool,
        known_tool: tool,
        prepared_tool: -1,
        selected_tool: -1,
        selected_for_change: false,
        move_rate: 0.0,
        slots: slots(&scenario.machine),
        frames: vec![Frame::default()],
        line: 1,
        memory: Memory::default(),
        log_open: false,
        probe_log_open: false,
        series: None,
        curve: Curve::default(),
        contour: Contour::default(),
        profile: None,
        pin_snapshot: None,
        room: Room::default(),
        coverage: RuleCoverage::default(),
    };
    state.dialect().stand_at_start(&mut state);
    state
}

/// The outcome of a scenario that is out of this model's reach as a whole.
fn not_begun(what: String) -> Outcome {
    Outcome {
        language: Language::Rs274,
        start: Settings::default(),
        steps: Vec::new(),
        end: End::Unsupported { block: BlockLocation::new(Program::MAIN, 1), what },
        parameters: None,
        pins: Vec::new(),
        samples: Vec::new(),
    }
}

impl ModelRun<'_> {
    /// The program, or the lines entered by hand, and all that the operator does afterwards.
    fn whole(&mut self) -> End {
        let mut end = match self.scenario.program.start {
            Start::Program => self.program(),
            Start::Mdi => self.lines_by_hand(),
        };
        loop {
            let stands_idle = match &end {
                // A program that pauses has no event left; what is entered by hand is idle.
                End::ProgramEnd | End::PercentEnd | End::Aborted | End::Paused => true,
                End::StreamEnd
                | End::Endless
                | End::Fault(_)
                | End::BudgetExhausted { .. }
                | End::Unsupported { .. }
                | End::Unspecified { .. } => false,
            };
            if !stands_idle {
                return end;
            }
            match self.idle(&mut end) {
                Ok(idle::Then::Nothing) => return end,
                Ok(idle::Then::Begin) => end = self.program(),
                Err(error) => return self.end_after(error),
            }
        }
    }

    /// Block after block, until something ends the run.
    fn program(&mut self) -> End {
        loop {
            if let Some(bound) = self.exhausted() {
                return End::BudgetExhausted { bound };
            }
            match self.next() {
                Ok(None) => {}
                Ok(Some(end)) => return end,
                Err(error) => return self.end_after(error),
            }
        }
    }

    /// The bound of the budget that is used up. It is looked at between blocks, so that a short run is a prefix of a
    /// longer one. A dwell after a compensated move that waits takes its time once the move is put out.
    fn exhausted(&self) -> Option<Bound> {
        let budget = &self.scenario.budget;
        if self.record.steps() >= budget.steps as usize {
            Some(Bound::Steps)
        } else if self.record.effects() >= budget.effects {
            Some(Bound::Effects)
        } else if self.state.environment.time() - self.record.waiting_seconds() >= budget.time {
            Some(Bound::Time)
        } else {
            None
        }
    }

    /// Rule program-end.parameters-kept. All numbered parameters that are not zero, position and tool among them.
    ///
    /// Rule parameters.saved. Those that are persistent are there to be stored, however the run has ended.
    fn parameters(&mut self) -> Indexed<u32, f64> {
        let mut all = self.state.parameters.nonzero();
        if parameters::changed_persistent(&self.state) {
            self.state.coverage.accepted(rule::parameters::SAVED);
        }
        let others = (1..=30).chain(parameters::computed_numbers());
        let known = others.filter_map(|number| {
            let value = parameters::value(&Name::Numbered(number), &self.state).ok()?;
            Some((number, value))
        });
        all.0.extend(known.filter(|(_, value)| value.abs() > 0.0));
        all
    }

    /// The state as it was before the block that is being executed. What is outside of the controller stays as it is.
    ///
    /// A block does not keep what was there before it unless the operator has acted as it began: the run is made
    /// again up to this one.
    fn before_block(&mut self) {
        let before = self.before_block.take().map_or_else(|| self.again(), |before| *before);
        let after = std::mem::replace(&mut self.state, before);
        self.state.coverage = after.coverage;
        self.state.environment = after.environment;
    }

    /// The state after as many blocks as have been executed, executed again.
    fn again(&self) -> State {
        let mut scenario = self.scenario.clone();
        scenario.budget.steps = u32::try_from(self.record.steps()).unwrap_or(u32::MAX);
        let (choices, rounding) = (self.state.choices.clone(), self.state.modes.rounding);
        let mut state = start(&scenario, choices, rounding);
        state.coverage = RuleCoverage::muted();
        let mut record = Record::new(&state);
        record.allow(&scenario.budget);
        let mut again = ModelRun::new(&scenario, state, record);
        again.whole();
        again.state
    }

    /// Once the run is over every call is over, so that local parameters are the main program's, which a numbered
    /// subprogram shares.
    fn leave_calls(&mut self) {
        let mut called = self.state.frames.split_off(1);
        let shares = |frame: &&mut Frame| frame.shares_parameters();
        let Some(sharing) = called.iter_mut().take_while(shares).last() else { return };
        let main = &mut self.state.frames[0];
        main.arguments = self.state.choices.dialect().arguments_left(
            sharing,
            &self.control,
            &self.state.choices,
        );
        if self.state.choices.is(choice::fanuc_subs::NamedLocals::Shared) {
            main.locals = std::mem::take(&mut sharing.locals);
        }
    }

    /// How a run ends whose block does not go on.
    ///
    /// Rule subroutines.file-fault. A fault in a called file is a fault of the run.
    fn end_after(&mut self, error: StepError) -> End {
        let block = self.control.files.block(self.control.place);
        match error {
            StepError::Refused(Refusal { kind: FaultKind::Orient, .. })
            | StepError::WaitsForEver
                if self.record.waits() =>
            {
                let why = "when a spindle is oriented while a compensated move waits".to_owned();
                End::Unspecified { block, why }
            }
            StepError::Refused(Refusal { rule, kind, message, span }) => {
                self.state.coverage.refused(rule);
                if ![MAIN, self.entries.file].contains(&self.control.place.file) {
                    self.state.coverage.refused(rule::subroutines::FILE_FAULT);
                }
                execute::saved_state::broken_off(&mut self.state);
                if execute::probe::has_moved(rule) {
                    self.is_within_block = false;
                }
                let message = format!("{message} ({rule})");
                End::Fault(Fault { kind: Some(kind), block: Some(block), span, message })
            }
            StepError::Unspecified(why) => End::Unspecified { block, why },
            StepError::TooManyEffects => End::BudgetExhausted { bound: Bound::Effects },
            StepError::WaitsForEver => End::BudgetExhausted { bound: Bound::Time },
            StepError::Ended(end) => {
                self.is_within_block = false;
                if end == End::Aborted {
                    self.record.broken_off(block, &self.state);
                    return self.aborted();
                }
                self.record.stands(block, &self.state);
                end
            }
        }
    }
}
