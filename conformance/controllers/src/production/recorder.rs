//! Records what the production controller does: settings, effects and pins, and the state after each block.

use std::collections::BTreeMap;

use gaugeblock_compare::observe::is_local_name;
use gaugeblock_interpreter::task::{
    ExternalOperation, Input, MDI_FILE, Machine, OperationState, WaitEvent,
};
use gaugeblock_interpreter::{BlockEnd, BlockKind, Interpreter, ProbeMove, Reply, Sink, Waiting};
use gaugeblock_vocabulary::scenario::{Action, Start};
use gaugeblock_vocabulary::{
    BlockLocation, Effect, End, Event, Indexed, Language, Outcome, Pin, PinChange, Program,
    Rs274State, Scenario, Settings, Sorted, State, Step,
};

use super::environment::SimulatedEnvironment;
use super::held::Held;

/// As many steps as most programs of cases and campaigns have.
const MANY_STEPS: usize = 64;

/// As many events as most blocks have that have any.
const MANY_EVENTS: usize = 2;

/// What has been seen so far.
#[derive(Debug)]
pub(super) struct Recorder<'a> {
    outside: SimulatedEnvironment<'a>,
    start: Settings,
    steps: Vec<Step>,
    pins: Vec<PinChange>,
    /// What the block that is being executed has done.
    events: Vec<Event>,
    /// What has to wait.
    held: Held,
    /// Whether nothing is being executed: what happens now belongs to the last block.
    idle: bool,
    /// Whether MDI lines are the lines of the program.
    by_hand: bool,
    /// The block in execution, if there are operator's events at blocks.
    block: BlockLocation,
    effects: u32,
    most_effects: u32,
    /// Whether a block has had more of them than there are, which is not recorded.
    over: bool,
    /// State as recorded last.
    state: Rs274State,
    /// Numbered parameters as recorded last; those that are not among them are zero.
    numbered: Sorted<u32, f64>,
    /// Global and local named parameters as recorded last.
    globals: BTreeMap<String, f64>,
    locals: BTreeMap<String, f64>,
    /// Numbered parameters that were set since a state was recorded last.
    written: Sorted<u32, f64>,
    /// Whether a call or return has led elsewhere since a state was recorded last.
    elsewhere: bool,
}

impl<'a> Recorder<'a> {
    /// Nothing has happened yet.
    pub(super) fn new(
        interpreter: &mut Interpreter,
        outside: SimulatedEnvironment<'a>,
        scenario: &Scenario,
    ) -> Self {
        let numbered = interpreter.parameters().into_iter().collect();
        Self {
            outside,
            start: interpreter.settings(),
            steps: Vec::with_capacity(MANY_STEPS),
            pins: Vec::new(),
            events: Vec::new(),
            held: Held::default(),
            idle: false,
            by_hand: scenario.program.start == Start::Mdi,
            block: BlockLocation::new(Program::MAIN, 1),
            effects: 0,
            most_effects: scenario.budget.effects,
            over: false,
            state: Rs274State::default(),
            numbered,
            globals: BTreeMap::new(),
            locals: BTreeMap::new(),
            written: Sorted::new(),
            elsewhere: false,
        }
    }

    /// Executed blocks so far.
    pub(super) fn steps(&self) -> u32 {
        u32::try_from(self.steps.len()).unwrap_or(u32::MAX)
    }

    /// Effects so far.
    pub(super) fn effects(&self) -> u32 {
        self.effects
    }

    /// Whether a block has had more effects than there are.
    pub(super) fn is_over(&self) -> bool {
        self.over
    }

    /// Whether all that has been done is recorded.
    pub(super) fn is_whole(&self) -> bool {
        !self.over && self.events.is_empty()
    }

    /// Seconds since the start.
    pub(super) fn elapsed(&self) -> f64 {
        self.outside.time()
    }

    /// Whether there are operator's events at blocks.
    pub(super) fn has_operator(&self) -> bool {
        self.outside.operator().is_there()
    }

    /// The line of the block that was entered by hand last.
    pub(super) fn entered(&self) -> u32 {
        self.outside.operator().entered()
    }

    /// Whether operator's events are left.
    pub(super) fn operator_is_waiting(&self) -> bool {
        self.outside.operator().is_waiting()
    }

    /// A block begins.
    pub(super) fn begin_block(&mut self, block: BlockLocation) {
        self.idle = false;
        self.outside.begin_block(&block);
        self.block = block;
    }

    /// All lines of the program have been entered by hand.
    pub(super) fn lines_are_over(&mut self) {
        self.by_hand = false;
    }

    /// Nothing is executed now: what follows belongs to the block before.
    pub(super) fn rest(&mut self) {
        self.idle = true;
    }

    /// Records later events in the next block.
    pub(super) fn go_on(&mut self) {
        self.idle = false;
    }

    /// This block is not over, and stays so.
    pub(super) fn stay(&mut self, block: &BlockLocation) {
        let events = std::mem::take(&mut self.events);
        self.steps.push(Step { block: self.block(&block.file, block.line), events, state: None });
    }

    /// Records the block before it does anything.
    pub(super) fn stay_before(&mut self) {
        if !self.idle {
            self.stay(&self.block.clone());
        }
    }

    /// A block as it is recorded: a line of a program that is entered by hand is one of that program.
    pub(super) fn block(&self, file: &str, line: u32) -> BlockLocation {
        BlockLocation::new(
            if self.by_hand && file == MDI_FILE { Program::MAIN } else { file },
            line,
        )
    }

    /// Something happened, within a block or after the last one.
    fn happened(&mut self, event: Event) {
        if !self.idle {
            if self.events.capacity() == 0 {
                self.events.reserve_exact(MANY_EVENTS);
            }
            self.events.push(event);
            return;
        }
        if self.steps.is_empty() {
            self.steps.push(Step { block: self.block.clone(), events: Vec::new(), state: None });
        }
        if let Some(step) = self.steps.last_mut() {
            step.events.push(event);
        }
    }

    /// The whole outcome. What a block did that was not finished is left out.
    pub(super) fn outcome(mut self, end: End, parameters: Indexed<u32, f64>) -> Outcome {
        self.held.remove_lost(&mut self.steps);
        Outcome {
            language: Language::Rs274,
            start: self.start,
            steps: self.steps,
            end,
            parameters: Some(parameters),
            pins: self.pins,
            samples: Vec::new(),
        }
    }

    /// What changed since a state was recorded last. After a call or return the level is recorded anew, and with it
    /// the local named parameters that exist.
    fn changes(&mut self, done: &mut BlockEnd<'_>) -> Rs274State {
        let is_elsewhere = std::mem::take(&mut self.elsewhere);
        if is_elsewhere {
            self.state.call_level = None;
            self.locals.clear();
        }
        let now = done.state();
        let mut changes = now.since(&self.state);
        self.state = now;
        let mut changed = Vec::new();
        for (number, value) in std::mem::take(&mut self.written) {
            if self.numbered.get(&number).copied().or(Some(0.0)) != Some(value) {
                self.numbered.insert(number, value);
                changed.push((number.to_string(), value));
            }
        }
        let mut record = |name: &str, value| {
            let named = if is_local_name(name) { &mut self.locals } else { &mut self.globals };
            if named.get(name) != Some(&value) {
                named.insert(name.to_owned(), value);
                changed.push((name.to_owned(), value));
            }
        };
        done.take_named(&mut record);
        if is_elsewhere {
            done.locals().for_each(|(name, value)| record(name, value));
        }
        changes.parameter = (!changed.is_empty()).then(|| changed.into_iter().collect());
        changes
    }
}

impl Sink for Recorder<'_> {
    fn hold(&mut self, _line: u32, waiting: Waiting<'_>) -> u64 {
        match waiting {
            // They are in force for the blocks that follow, whatever becomes of what waits.
            Waiting::Settings(changed) => {
                self.happened(Event::Set(changed.clone().into()));
                Held::SETTINGS
            }
            Waiting::Effect(effect) => {
                let place = self.held.hold(self.steps.len(), self.events.len());
                self.happened(Event::Do(effect.clone()));
                place
            }
        }
    }

    fn release(&mut self, place: u64) {
        self.held.release(place);
    }

    fn set(&mut self, _line: u32, changed: &Settings) {
        if self.held.is_recorded() {
            return;
        }
        self.happened(Event::Set(changed.clone().into()));
    }

    fn perform(&mut self, _line: u32, effect: &Effect) -> Reply {
        if let Err(kind) = self.outside.perform(effect) {
            return Reply::Failed(kind);
        }
        match self.held.take_released() {
            Some((step, place)) => {
                let events = match self.steps.get_mut(step) {
                    Some(step) => &mut step.events,
                    None => &mut self.events,
                };
                if let Some(event) = events.get_mut(place) {
                    *event = Event::Do(effect.clone());
                }
            }
            None => self.happened(Event::Do(effect.clone())),
        }
        self.effects = self.effects.saturating_add(1);
        Reply::Done
    }

    fn probe(&mut self, _line: u32, effect: &Effect, probing: &ProbeMove) -> Reply {
        let found = match self.outside.probe(probing) {
            Ok(found) => found,
            Err(kind) => return Reply::Failed(kind),
        };
        let mut effect = effect.clone();
        let mut touched = None;
        if let Effect::StraightProbe { end, contact } = &mut effect {
            touched = found.map(
                |point| {
                    if point == probing.to() { *end } else { probing.program(point) }
                },
            );
            *contact = touched;
        }
        self.happened(Event::Do(effect));
        self.effects = self.effects.saturating_add(1);
        Reply::Contact(touched)
    }

    fn end_block(&mut self, done: &mut BlockEnd<'_>) {
        if self.effects > self.most_effects {
            self.over = true;
            return;
        }
        let written = &mut self.written;
        done.take_numbered(|number, value| {
            written.insert(number, value);
        });
        let with_state = match done.kind() {
            BlockKind::Words => true,
            // A comment that says nothing is no block.
            BlockKind::Comment if self.events.is_empty() => return,
            BlockKind::Comment => true,
            BlockKind::End => {
                self.elsewhere |= self.state.call_level != Some(0);
                true
            }
            BlockKind::OWord => false,
            BlockKind::Call
            | BlockKind::Return
            | BlockKind::NumberedCall
            | BlockKind::NumberedReturn => {
                self.elsewhere = true;
                false
            }
        };
        let state = with_state.then(|| State::Rs274(self.changes(done)));
        let events = std::mem::take(&mut self.events);
        self.steps.push(Step { block: self.block(done.file(), done.line()), events, state });
    }
}

impl Machine for Recorder<'_> {
    fn time(&self) -> f64 {
        self.outside.time()
    }

    fn wait(&mut self, until: Option<f64>) -> WaitEvent {
        self.outside.wait(until)
    }

    fn poll_request(&mut self) -> Option<Action> {
        self.outside.asked()
    }

    fn input(&self, input: Input) -> f64 {
        self.outside.input(input)
    }

    fn operation_state(&mut self, operation: ExternalOperation) -> OperationState {
        self.outside.operation_state(operation)
    }

    fn set_pin(&mut self, pin: Pin, value: f64) {
        self.outside.pin(pin, value);
        self.pins.push(PinChange { time: self.outside.time(), pin, value });
    }

    fn record_input(&mut self, value: f64) {
        let effects = self.events.iter_mut().rev();
        let waits = effects.filter_map(|event| match event {
            Event::Do(Effect::WaitInput { read, .. }) => Some(read),
            Event::Do(_) | Event::Set(_) | Event::Unknown(_) => None,
        });
        waits.take(1).for_each(|read| *read = value);
    }

    fn discard_block(&mut self) {
        let mut settings = Settings::default();
        let mut refused = Vec::new();
        self.held.discard_block(self.steps.len());
        for event in self.events.drain(..) {
            match event {
                Event::Set(changed) => settings.overlay(&changed),
                // The controller refused it, and not the block.
                Event::Do(Effect::RequestRefused { .. }) => refused.push(event),
                Event::Do(_) | Event::Unknown(_) => {}
            }
        }
        self.idle = true;
        for event in refused {
            self.happened(event);
        }
        if settings != Settings::default() {
            // They are in force, and the block that set them is not recorded.
            self.happened(Event::Set(settings.into()));
        }
        self.elsewhere |= self.state.call_level != Some(0);
    }

    fn has_user_program(&self, code: u32) -> bool {
        self.outside.user_program(code).is_some()
    }

    fn prompts_for_tools(&self) -> bool {
        self.outside.prompts_for_tools()
    }
}
