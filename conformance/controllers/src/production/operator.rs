//! What a person does, and when it falls due.

use std::collections::BTreeMap;

use gaugeblock_vocabulary::BlockLocation;
use gaugeblock_vocabulary::scenario::{Action, OperatorEvent};

/// The operator of a scenario.
#[derive(Clone, Debug)]
pub(super) struct Operator<'a> {
    /// Events at blocks that are not reached yet, with their place in the list.
    ahead: Vec<(usize, &'a OperatorEvent)>,
    /// Due events: their time and their place in the list. At equal times the order of the list decides.
    due: Vec<(f64, usize, &'a Action)>,
    /// How often each block that has an event was executed.
    executions: BTreeMap<BlockLocation, u32>,
    /// The line of each event that enters a block by hand: they are counted in the order in which they are listed.
    lines: BTreeMap<usize, u32>,
    /// The line of the last one that was taken.
    entered: u32,
}

impl<'a> Operator<'a> {
    /// Before the first block.
    pub(super) fn new(events: &'a [OperatorEvent]) -> Self {
        let executions = events.iter().map(|event| (event.when.block.clone(), 0)).collect();
        let enter = |event: &OperatorEvent| matches!(event.action, Action::Mdi(_));
        let entries = events.iter().enumerate().filter(|(_, event)| enter(event));
        let lines = entries.zip(1..).map(|((place, _), line)| (place, line)).collect();
        let ahead = events.iter().enumerate().collect();
        Self { ahead, due: Vec::new(), executions, lines, entered: 0 }
    }

    /// Begins a block: events at this execution become due from now on.
    pub(super) fn begin_block(&mut self, block: &BlockLocation, time: f64) {
        let Some(count) = self.executions.get_mut(block) else { return };
        *count += 1;
        let count = *count;
        let is_here = |event: &OperatorEvent| {
            let when = &event.when;
            when.block == *block && when.execution == count
        };
        let (here, ahead): (Vec<_>, _) = self.ahead.iter().partition(|(_, event)| is_here(event));
        self.ahead = ahead;
        let due = |(place, event): (usize, &'a OperatorEvent)| {
            (time + event.when.offset, place, &event.action)
        };
        self.due.extend(here.into_iter().map(due));
        self.due.sort_by(|(a, first, _), (b, second, _)| a.total_cmp(b).then(first.cmp(second)));
    }

    /// When the next event at a reached block is due.
    pub(super) fn due(&self) -> Option<f64> {
        self.due.first().map(|(due, ..)| *due)
    }

    /// Takes what has fallen due by then.
    pub(super) fn take(&mut self, time: f64) -> Option<Action> {
        let (due, place, action) = *self.due.first()?;
        if due > time {
            return None;
        }
        self.due.remove(0);
        self.entered = self.lines.get(&place).copied().unwrap_or(self.entered);
        Some(action.clone())
    }

    /// The line of the block that was entered by hand last, whatever the controller did with it.
    pub(super) fn entered(&self) -> u32 {
        self.entered
    }

    /// Whether anything is still to come.
    pub(super) fn is_waiting(&self) -> bool {
        !self.ahead.is_empty() || !self.due.is_empty()
    }

    /// Whether there is an operator at all.
    pub(super) fn is_there(&self) -> bool {
        !self.executions.is_empty()
    }
}
