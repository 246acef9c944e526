//! The state of a run.

use gaugeblock_vocabulary::Scenario;
use gaugeblock_vocabulary::scenario::Action;

use super::operator::Operator;
use super::pins::update_pins;
use super::record::Record;
use crate::rs274::control::{Control, Place};
use crate::rs274::order::Phase;
use crate::rs274::state::State;

/// A run, with its operator.
pub(super) struct ModelRun<'a> {
    /// What is run.
    pub(super) scenario: &'a Scenario,
    /// The state of the controller.
    pub(super) state: State,
    /// Where the run is, and which subs it knows.
    pub(super) control: Control,
    /// What has been observed.
    pub(super) record: Record,
    /// What the operator does, and when.
    pub(super) operator: Operator<'a>,
    /// The first of the blocks that the operator enters by hand, one for each event that enters one.
    pub(super) entries: Place,
    /// Whether what is executed was entered by hand.
    pub(super) by_hand: bool,
    /// Whether this run only reads ahead of another one: nothing waits, and no operator acts.
    pub(super) ahead: bool,
    /// How often M99 has ended the main program since the last operator event.
    pub(super) turns: u32,
    /// Whether the operator has requested a pause at which the program has not stopped yet.
    pub(super) pause_asked: bool,
    /// The state when the block that is executed began, where the operator may abort it.
    pub(super) at_block: Option<Box<State>>,
    /// Whether the block that is executed waits for what the machine answers.
    pub(super) waits_for_machine: bool,
    /// Whether a block is being executed, so that some of what it does may be done.
    pub(super) is_within_block: bool,
    /// The state before the block, where the operator has acted as it began.
    pub(super) before_block: Option<Box<State>>,
}

impl<'a> ModelRun<'a> {
    /// Nothing has been executed.
    pub(super) fn new(scenario: &'a Scenario, mut state: State, record: Record) -> Self {
        let mut control = Control::new(&scenario.program, &mut state);
        let entries = open_entries(scenario, &mut control, &mut state);
        Self {
            scenario,
            state,
            control,
            record,
            operator: Operator::new(&scenario.operator),
            entries,
            by_hand: false,
            ahead: false,
            turns: 0,
            pause_asked: false,
            at_block: None,
            waits_for_machine: false,
            is_within_block: false,
            before_block: None,
        }
    }

    /// Brings the pins up to date after a phase of a block, or after something that the operator did.
    pub(super) fn update_pins(&mut self, after: Option<Phase>) {
        update_pins(&mut self.state, after);
    }
}

/// Opens the text of what the operator enters by hand: a line for each event, in the order of the scenario.
pub(super) fn open_entries(scenario: &Scenario, control: &mut Control, state: &mut State) -> Place {
    let mut text = String::new();
    for event in &scenario.operator {
        if let Action::Mdi(block) = &event.action {
            text.push_str(block.split(['\r', '\n']).next().unwrap_or_default());
            text.push('\n');
        }
    }
    control.files.begin_entries(&text, state)
}
