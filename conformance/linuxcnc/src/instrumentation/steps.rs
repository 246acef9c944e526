//! Turns consecutive checkpoints into executed blocks.

use std::collections::BTreeMap;

use gaugeblock_adapter::HarnessError;
use gaugeblock_compare::observe::is_local_name;
use gaugeblock_vocabulary::scenario::Budget;
use gaugeblock_vocabulary::{
    BlockLocation, Bound, ControllerMode, Effect, End, Event, Indexed, Outcome, Rs274State,
    Scenario, State, Step,
};

use super::checkpoint::Checkpoint;
use super::instrument::Plan;
use super::source::{Form, Source, code, form, has_slash, opens_probe_log};
use super::state;

/// The blocks that were executed so far.
#[derive(Debug)]
pub(crate) struct Steps<'a> {
    source: &'a Source,
    plan: &'a Plan,
    block_delete: bool,
    /// Whether tools change places: then T0 selects a tool.
    tools_change_places: bool,
    known: Rs274State,
    /// Depth of calls at the last checkpoint.
    level: i64,
    at: Option<(usize, u32)>,
    /// The call that was entered since a block was recorded.
    entered: Option<(usize, u32)>,
    /// Whether the tool was changed since the last T. Then no tool is selected, even if parameters report the old one.
    changed: bool,
    /// Whether a file for probed points is open.
    probe_log: bool,
    /// How often M99 has ended the main program since the last operator event.
    turns: u32,
    /// Number of blocks after [`End::TURNS`] of them.
    turned: Option<usize>,
    /// Whether the interpreter's position is that of the program; if not, it is not reported.
    pub(crate) reports_position: bool,
    /// Mode of the controller, if it has modes.
    pub(crate) mode: Option<ControllerMode>,
    /// The blocks with what they did.
    pub(crate) taken: Vec<Step>,
}

impl<'a> Steps<'a> {
    /// No blocks: the run has not begun.
    pub(crate) fn new(source: &'a Source, plan: &'a Plan, scenario: &Scenario) -> Self {
        let known = Rs274State::default();
        Self {
            source,
            plan,
            block_delete: scenario.program.block_delete,
            tools_change_places: scenario.machine.random_tool_changer,
            known,
            level: 0,
            at: None,
            entered: None,
            changed: false,
            probe_log: false,
            turns: 0,
            turned: None,
            reports_position: true,
            mode: None,
            taken: Vec::new(),
        }
    }

    /// Whether a checkpoint was seen.
    pub(crate) fn has_begun(&self) -> bool {
        self.at.is_some()
    }

    /// The block that is executed next if nothing jumps.
    pub(crate) fn next(&self) -> Option<(usize, u32)> {
        self.at.map(|(file, line)| (file, line + 1))
    }

    /// The kind of that block.
    pub(crate) fn next_form(&self) -> Form {
        self.next().map_or(Form::Other, |(file, line)| form(self.source.line(file, line)))
    }

    /// The call in which the next block is, if no block of its sub has been recorded.
    pub(crate) fn entered_call(&self) -> Option<(usize, u32)> {
        self.entered
    }

    /// The numbered parameters as the last checkpoint has them.
    pub(crate) fn numbered_parameters(&self) -> BTreeMap<u32, f64> {
        let known = self.known.parameter.iter().flat_map(|known| known.0.iter());
        known.filter_map(|(name, value)| Some((name.parse().ok()?, *value))).collect()
    }

    /// Begins at the first checkpoint. Of the parameters that the program does not name, only later changes are
    /// recorded.
    ///
    /// # Errors
    /// A mode that is not known.
    pub(crate) fn begin(&mut self, checkpoint: &Checkpoint) -> Result<(), HarnessError> {
        let numbered = self.source.parameters().numbered;
        let is_named = |name: &str| name.parse().is_ok_and(|number| numbered.contains(&number));
        let observed = state::state(checkpoint, 0, self.plan)?.parameter.unwrap_or_default();
        let unnamed: Indexed<String, f64> =
            observed.0.into_iter().filter(|(name, _)| !is_named(name)).collect();
        self.known.parameter = Some(unnamed);
        self.at = Some((checkpoint.file, checkpoint.line));
        Ok(())
    }

    /// Records an executed block; the run is now after it, or where it jumped to.
    ///
    /// # Errors
    /// A mode that is not known.
    pub(crate) fn record_block(
        &mut self,
        checkpoint: &Checkpoint,
        events: Vec<Event>,
        tool: i32,
    ) -> Result<(), HarnessError> {
        self.tool_codes(&events);
        let here = (checkpoint.file, checkpoint.line);
        let Some(next) = self.next() else { return Ok(()) };
        let jumped = here != next;
        let level = std::mem::replace(&mut self.level, checkpoint.mode("_call_level"));
        if level != self.level || self.next_form() == Form::Return {
            self.enter_level();
        }
        let closes_nothing = self.is_idle_probe_close(next);
        match self.next_form() {
            Form::Other if closes_nothing && events.is_empty() => {}
            Form::Call if jumped => {
                // The call is recorded as a block when it returns; the effects of its block come before the sub.
                if !events.is_empty() {
                    self.step(next, events, None);
                }
                self.entered = Some(next);
            }
            Form::Return if level == 0 && self.level == 0 => {
                self.step(next, events, None);
                self.turns += 1;
                if self.turns == End::TURNS {
                    self.turned = Some(self.taken.len());
                }
            }
            Form::Call | Form::Control | Form::Return => self.step(next, events, None),
            Form::Empty | Form::Percent if events.is_empty() => {}
            // A block with M2 after which the program continues did not execute its M2.
            Form::Empty | Form::Percent | Form::End | Form::Other => {
                let line = self.source.line(next.0, next.1);
                if !(self.block_delete && has_slash(line)) {
                    let observed = self.state_of(checkpoint, tool)?;
                    let changes = observed.since(&self.known);
                    self.known.overlay(&changes);
                    self.step(next, events, Some(State::Rs274(changes)));
                }
            }
        }
        if jumped && form(self.source.line(here.0, here.1)) == Form::Call {
            self.step(here, Vec::new(), None);
        }
        self.at = Some(here);
        Ok(())
    }

    /// Counts the turns of an endless program from here: an operator event has happened.
    pub(crate) fn count_turns_again(&mut self) {
        (self.turns, self.turned) = (0, None);
    }

    /// Removes the blocks of an endless program after its last counted turn.
    pub(crate) fn leave_out_more_turns(&mut self) {
        self.taken.truncate(self.turned.unwrap_or(usize::MAX));
    }

    /// Whether a line is only a (PROBECLOSE) without an open file: such a comment is not a block.
    fn is_idle_probe_close(&mut self, (file, line): (usize, u32)) -> bool {
        let line = self.source.line(file, line);
        let is_skipped = self.block_delete && has_slash(line);
        let Some(opens) = opens_probe_log(line).filter(|_| !is_skipped) else { return false };
        let was_open = std::mem::replace(&mut self.probe_log, opens);
        !opens && !was_open && matches!(code(line).as_str(), "" | "/")
    }

    /// After a call or return the level is recorded anew, and with it the local names that exist.
    fn enter_level(&mut self) {
        self.known.call_level = None;
        if let Some(parameters) = &mut self.known.parameter {
            parameters.0.retain(|name, _| !is_local_name(name));
        }
    }

    /// Records that the program ended with the next block, what was printed afterwards, and all numbered parameters
    /// that are not zero.
    ///
    /// # Errors
    /// A mode that is not known.
    pub(crate) fn record_end(
        &mut self,
        checkpoint: &Checkpoint,
        parameters: Option<&BTreeMap<u32, f64>>,
        events: Vec<Event>,
        tool: i32,
    ) -> Result<(), HarnessError> {
        self.tool_codes(&events);
        let mut observed = self.state_of(checkpoint, tool)?;
        if self.level != 0 {
            self.enter_level();
            arguments_at_end(&mut observed, parameters);
        }
        let changes = observed.since(&self.known);
        self.known.overlay(&changes);
        self.step(self.next().unwrap_or((0, 1)), events, Some(State::Rs274(changes)));
        Ok(())
    }

    /// A block was entered by hand while no program ran.
    ///
    /// # Errors
    /// A mode that is not known.
    pub(crate) fn record_mdi_block(
        &mut self,
        block: BlockLocation,
        checkpoint: &Checkpoint,
        events: Vec<Event>,
        tool: i32,
    ) -> Result<(), HarnessError> {
        self.tool_codes(&events);
        let changes = self.state_of(checkpoint, tool)?.since(&self.known);
        self.known.overlay(&changes);
        self.taken.push(Step { block, events, state: Some(State::Rs274(changes)) });
        Ok(())
    }

    /// Continues after this checkpoint: the program again, or the next block after an aborted one.
    pub(crate) fn resume_at(&mut self, checkpoint: &Checkpoint) {
        self.at = Some((checkpoint.file, checkpoint.line));
    }

    fn tool_codes(&mut self, events: &[Event]) {
        for event in events {
            match event {
                Event::Do(Effect::PrepareTool { .. }) => self.changed = false,
                Event::Do(Effect::ChangeTool { .. }) => self.changed = true,
                Event::Set(_) | Event::Do(_) | Event::Unknown(_) => {}
            }
        }
    }

    fn state_of(&self, checkpoint: &Checkpoint, tool: i32) -> Result<Rs274State, HarnessError> {
        let observed = state::state(checkpoint, tool, self.plan)?;
        // With a tool in the spindle, or after a change of the table, the controller reports T0 as tool 0.
        let selects_none = observed.prepared_tool == Some(0) && !self.tools_change_places;
        let prepared_tool =
            if self.changed || selects_none { Some(-1) } else { observed.prepared_tool };
        let position = observed.position.filter(|_| self.reports_position);
        Ok(Rs274State { controller_mode: self.mode, prepared_tool, position, ..observed })
    }

    /// A block of which only its events are known.
    pub(crate) fn step(
        &mut self,
        (file, line): (usize, u32),
        events: Vec<Event>,
        state: Option<State>,
    ) {
        self.entered = None;
        self.taken.push(Step { block: self.source.block(file, line), events, state });
    }
}

/// If a run ended in a sub, #1 to #30 come from the stop before it: the list at the end has their values.
fn arguments_at_end(observed: &mut Rs274State, parameters: Option<&BTreeMap<u32, f64>>) {
    let observed = observed.parameter.iter_mut().flat_map(|observed| observed.0.iter_mut());
    for (name, value) in observed {
        if let (Some(list), Ok(number @ 1..=30)) = (parameters, name.parse()) {
            *value = list.get(&number).copied().unwrap_or_default();
        }
    }
}

/// Cuts an outcome off where the budget ends; returns the bound that was reached.
pub(crate) fn limit(outcome: &mut Outcome, budget: Budget) -> Option<Bound> {
    let steps = usize::try_from(budget.steps).unwrap_or(usize::MAX);
    let mut effects = 0;
    let is_effect = |event: &&Event| matches!(event, Event::Do(_));
    let keep = outcome.steps.iter().take_while(|step| {
        effects += step.events.iter().filter(is_effect).count();
        u32::try_from(effects).is_ok_and(|effects| effects <= budget.effects)
    });
    let keep = keep.count();
    let bound = if keep.min(steps) == outcome.steps.len() {
        return None;
    } else if keep < steps {
        Bound::Effects
    } else {
        Bound::Steps
    };
    outcome.steps.truncate(keep.min(steps));
    outcome.end = End::BudgetExhausted { bound };
    outcome.parameters = None;
    Some(bound)
}
