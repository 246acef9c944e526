//! What is observed of a run, block by block.

use std::collections::BTreeMap;

use gaugeblock_vocabulary::scenario::Budget;
use gaugeblock_vocabulary::{
    BlockLocation, Effect, End, Event, Indexed, Language, Outcome, PinChange, Rs274State, Settings,
    Step,
};

use super::effects::{Waiting, is_move, may_wait};
use super::watch::{Begins, Mark, Watch, Why};
use crate::rs274::environment::stub::BlockMotion;
use crate::rs274::execute::move_start::{self, Speed};
use crate::rs274::execute::pass;
use crate::rs274::modes::Modes;
use crate::rs274::parameters::{self, Name};
use crate::rs274::state::State;

/// As many steps as most programs of cases and campaigns have.
const MANY_STEPS: usize = 64;

/// As many events as most blocks have that have any.
const MANY_EVENTS: usize = 2;

/// What has been observed so far.
///
/// Settings, states and parameters are recorded as what changed since they were recorded last. After a call or return
/// the call level is recorded anew, even when it is the same, and with it all local named parameters that exist.
#[derive(Debug)]
pub struct Record {
    start: Settings,
    pub(super) steps: Vec<Step>,
    /// Events of the block that is being executed.
    pub(super) events: Vec<Event>,
    /// The modes whose settings were recorded last.
    modes: Modes,
    /// State as recorded last, without parameters.
    state: Rs274State,
    /// Parameters as recorded last; numbered ones that are not among them are zero.
    parameters: BTreeMap<Name, f64>,
    /// Whether a call or return has led elsewhere since a state was recorded last.
    elsewhere: bool,
    /// Effects so far.
    effects: u32,
    /// As many effects as the budget allows.
    most_effects: u32,
    /// Whether a block is being executed.
    in_block: bool,
    /// Whether moves go by the spindle now.
    in_step: bool,
    /// Effects that wait until the next compensated move is known, in the order of the program.
    pub(super) waiting: Vec<Waiting>,
    /// The moves of the phase that is executed, where they may be held.
    pub(super) watch: Option<Watch>,
}

impl Record {
    /// Nothing has happened yet; the settings in force are recorded in full.
    pub fn new(state: &State) -> Self {
        let start = state.settings();
        let stored = state.parameters.nonzero().0.into_iter();
        Self {
            parameters: stored.map(|(number, value)| (Name::Numbered(number), value)).collect(),
            elsewhere: false,
            modes: state.modes.clone(),
            start,
            steps: Vec::with_capacity(MANY_STEPS),
            events: Vec::new(),
            state: Rs274State::default(),
            effects: 0,
            most_effects: Budget::default().effects,
            in_block: false,
            in_step: false,
            waiting: Vec::new(),
            watch: None,
        }
    }

    /// Sets as many effects as the budget allows.
    pub fn allow(&mut self, budget: &Budget) {
        self.most_effects = budget.effects;
    }

    /// Whether no block has been executed to its end.
    pub fn is_empty(&self) -> bool {
        self.steps.iter().all(|step| step.state.is_none() && step.events.is_empty())
    }

    /// Whether there are as many effects as the budget allows: a block that would go on and on stops here.
    pub fn is_full(&self) -> bool {
        self.effects >= self.most_effects
    }

    /// Whether there are more effects than the budget allows: the block that has them is not recorded.
    pub fn is_over(&self) -> bool {
        self.effects > self.most_effects
    }

    /// An effect, under the settings now in force. A move begins with it, unless it is held.
    pub fn effect(&mut self, state: &mut State, effect: Effect) {
        let speed =
            speed_of(&effect, self.in_step).filter(|_| move_start::is_motion(&effect, state));
        if self.has_stopped() || speed.is_some_and(|speed| self.waits_to_move(speed, state)) {
            return self.does_not_happen();
        }
        if speed.is_some() {
            move_start::motion_begins(state);
        }
        move_start::moves_axes(&effect, state);
        self.happened(state, effect);
        if let Some(watch) = self.watch.as_mut().filter(|_| speed.is_some()) {
            watch.moved(state);
        }
    }

    /// Whether a move has to wait, so that nothing that depends on its beginning has happened.
    pub(crate) fn waits_to_move(&mut self, speed: Speed, state: &mut State) -> bool {
        let begins = self.begins(Why::Move(speed), state);
        if let Begins::After(refused) = begins {
            refused.into_iter().for_each(|refused| self.happened(state, refused));
        }
        self.has_stopped()
    }

    /// A dwell between the moves of a canned cycle: so many seconds go by.
    pub fn dwell(&mut self, state: &mut State, seconds: f64) {
        self.effect(state, Effect::Dwell { seconds });
        self.passes(Why::Dwell(seconds), seconds, state);
    }

    /// A wait of so many seconds for something outside.
    pub fn wait(&mut self, state: &mut State, seconds: f64) {
        self.passes(Why::Wait(seconds), seconds, state);
    }

    fn passes(&mut self, why: Why, seconds: f64, state: &mut State) {
        match self.begins(why, state) {
            Begins::AtOnce => pass(seconds, state),
            Begins::After(refused) => {
                refused.into_iter().for_each(|refused| self.happened(state, refused));
            }
            Begins::Later => {}
        }
    }

    /// When a move or wait of a phase begins that is watched; others begin at once.
    fn begins(&mut self, why: Why, state: &mut State) -> Begins {
        if self.has_stopped() {
            return Begins::Later;
        }
        let Some(mut watch) = self.watch.take() else { return Begins::AtOnce };
        let begins = watch.comes_to(why, state);
        if matches!(begins, Begins::Later) {
            watch.stops(why, self.mark(), state);
        }
        self.watch = Some(watch);
        begins
    }

    /// What comes after a move that waits has not happened. It is counted, so that a phase without an end is bounded.
    fn does_not_happen(&mut self) {
        self.effects = self.effects.saturating_add(1);
    }

    fn has_stopped(&self) -> bool {
        self.watch.as_ref().is_some_and(Watch::has_stopped)
    }

    fn happened(&mut self, state: &State, effect: Effect) {
        self.settings(state);
        self.effects = self.effects.saturating_add(1);
        let begins = matches!(effect, Effect::StartSpindleSynchronisation { .. });
        self.in_step = begins || self.in_step && effect != Effect::StopSpindleSynchronisation {};
        let waits = self.in_block && state.contour.waits() && may_wait(&effect);
        self.push(Event::Do(effect));
        if waits {
            let (step, event) = (self.steps.len(), self.events.len() - 1);
            self.waiting.push(Waiting { step, event, units: state.modes.units });
        }
        self.leave_to_last();
    }

    /// What has been observed of the block so far, to come back to.
    pub(super) fn mark(&self) -> Mark {
        Mark {
            events: self.events.clone(),
            modes: self.modes.clone(),
            effects: self.effects,
            in_step: self.in_step,
            waiting: self.waiting.clone(),
        }
    }

    /// What was observed since has not happened.
    pub(super) fn back_to(&mut self, mark: Mark) {
        let Mark { events, modes, effects, in_step, waiting } = mark;
        self.waiting = waiting;
        self.events = events;
        self.modes = modes;
        self.effects = effects;
        self.in_step = in_step;
    }

    /// The effects of the block since then.
    pub(super) fn effects_since(&self, mark: &Mark) -> Vec<Effect> {
        let later = self.events.iter().skip(mark.events.len());
        later
            .filter_map(|event| match event {
                Event::Do(effect) => Some(effect.clone()),
                Event::Set(_) | Event::Unknown(_) => None,
            })
            .collect()
    }

    /// Between blocks the one before is what everything belongs to.
    fn leave_to_last(&mut self) {
        if !self.in_block
            && let Some(last) = self.steps.last_mut()
        {
            last.events.append(&mut self.events);
        }
    }

    /// Settings have changed without a block of the program.
    pub fn settle(&mut self, state: &State) {
        self.settings(state);
        self.leave_to_last();
    }

    /// A block begins.
    pub fn begin(&mut self) {
        self.in_block = true;
        self.in_step = false;
    }

    /// What was being executed was no block.
    pub fn is_no_block(&mut self) {
        self.in_block = false;
    }

    /// The block that is being executed, if there is one, stands, and the run with it; no state is recorded after it.
    pub fn stands(&mut self, block: BlockLocation, state: &State) {
        if self.in_block {
            self.step_without_state(block, state);
        }
    }

    /// The block that is being executed, if there is one, is broken off. What it did itself is not recorded, as with
    /// one that is refused; what the controller refused meanwhile is, and what was set and stays so.
    pub fn broken_off(&mut self, block: BlockLocation, state: &State) {
        if !self.in_block {
            return;
        }
        let mut set = Settings::default();
        self.events.retain(|event| match event {
            Event::Set(changed) => {
                set.overlay(changed);
                false
            }
            Event::Do(effect) => matches!(effect, Effect::RequestRefused { .. }),
            Event::Unknown(_) => false,
        });
        if set != Settings::default() {
            self.events.push(Event::Set(set.into()));
        }
        if self.steps.is_empty() {
            self.step_without_state(block, state);
        } else {
            self.in_block = false;
            self.leave_to_last();
        }
    }

    /// Records the settings that changed since they were recorded last.
    fn settings(&mut self, state: &State) {
        if state.modes == self.modes {
            return;
        }
        let reported = state.dialect().reported_modes(state);
        let changed = reported.settings_since(&self.modes);
        self.modes.clone_from(&reported);
        if changed != Settings::default() {
            self.push(Event::Set(changed.into()));
        }
    }

    /// Something happens in the block.
    fn push(&mut self, event: Event) {
        if self.events.capacity() == 0 {
            self.events.reserve_exact(MANY_EVENTS);
        }
        self.events.push(event);
    }

    /// Whether the block that is being executed has done nothing so far.
    pub fn is_idle(&self, state: &State) -> bool {
        self.events.is_empty()
            && (state.modes == self.modes
                || state.dialect().reported_modes(state).settings_since(&self.modes)
                    == Settings::default())
    }

    /// The moves of the executed block, as the stub of a machine receives them.
    pub(crate) fn moves(&self) -> BlockMotion {
        let mut moves = self.events.iter().filter_map(|event| match event {
            Event::Do(effect) if is_move(effect) => Some(effect),
            Event::Set(_) | Event::Do(_) | Event::Unknown(_) => None,
        });
        match moves.next() {
            None => BlockMotion::None,
            Some(Effect::NurbsFeed { points: ..=3, .. }) => BlockMotion::NoPoint,
            Some(Effect::NurbsFeed { .. }) => BlockMotion::Spline,
            Some(_) => BlockMotion::Moves,
        }
    }

    /// A call or return leads to another level, or to another call at the same one.
    pub fn leads_elsewhere(&mut self) {
        self.elsewhere = true;
    }

    /// The end of a block after which the state is recorded.
    pub fn step(&mut self, block: BlockLocation, state: &mut State) {
        self.settings(state);
        let mut names = state.parameters.take_written();
        if std::mem::take(&mut self.elsewhere) {
            names.extend(self.local_names(state));
            self.state.call_level = None;
        }
        let now = state.record();
        let mut changed = now.since(&self.state);
        self.state = now;
        let parameters = self.parameters(&names, state);
        if !parameters.0.is_empty() {
            changed.parameter = Some(parameters);
        }
        let events = std::mem::take(&mut self.events);
        self.in_block = false;
        self.steps.push(Step {
            block,
            events,
            state: Some(gaugeblock_vocabulary::State::Rs274(changed)),
        });
    }

    /// The local parameters where the run is now, but for numbered ones that are zero and were. Local names that were
    /// recorded elsewhere are forgotten.
    fn local_names(&mut self, state: &State) -> Vec<Name> {
        self.parameters.retain(|name, _| !name.is_local_name());
        let arguments = (1..).zip(&state.frame().arguments);
        let set = arguments.filter(|(_, value)| value.abs() > 0.0);
        let set = set.map(|(number, _)| Name::Numbered(number));
        let recorded = self.parameters.range(Name::Numbered(1)..=Name::Numbered(30));
        let recorded = recorded.map(|(name, _)| name.clone());
        let named = state.frame().locals.keys().cloned().map(Name::Named);
        set.chain(recorded).chain(named).collect()
    }

    /// Those of some parameters that exist and are not as they were recorded last.
    fn parameters(&mut self, names: &[Name], state: &State) -> Indexed<String, f64> {
        let changed = names.iter().filter_map(|name| {
            let value = parameters::value(name, state).ok()?;
            let unset = matches!(name, Name::Numbered(_)).then_some(0.0);
            let before = self.parameters.get(name).copied().or(unset);
            (Some(value) != before).then(|| {
                self.parameters.insert(name.clone(), value);
                (name.to_string(), value)
            })
        });
        changed.collect()
    }

    /// The end of a block after which no state is recorded: O-words, M98, M99.
    pub fn step_without_state(&mut self, block: BlockLocation, state: &State) {
        self.settings(state);
        let events = std::mem::take(&mut self.events);
        self.in_block = false;
        self.steps.push(Step { block, events, state: None });
    }

    /// Executed blocks so far.
    pub fn steps(&self) -> usize {
        self.steps.len()
    }

    /// Effects so far.
    pub fn effects(&self) -> u32 {
        self.effects
    }

    /// The whole outcome. What a refused block did before it was refused is not part of it.
    pub fn finish(self, end: End, parameters: Indexed<u32, f64>, pins: Vec<PinChange>) -> Outcome {
        Outcome {
            language: Language::Rs274,
            start: self.start,
            steps: self.steps,
            end,
            parameters: Some(parameters),
            pins,
            samples: Vec::new(),
        }
    }
}

/// What determines the speed of a move; `None` for another effect.
fn speed_of(effect: &Effect, in_step: bool) -> Option<Speed> {
    if !is_move(effect) {
        None
    } else if matches!(effect, Effect::StraightTraverse { .. }) {
        Some(Speed::Rapid)
    } else if in_step || matches!(effect, Effect::RigidTap { .. }) {
        Some(Speed::Spindle)
    } else {
        Some(Speed::Feed)
    }
}
