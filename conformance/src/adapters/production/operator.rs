//! What a person does, and when it falls due.

use std::collections::BTreeMap;

use gaugeblock_trace::Block;
use gaugeblock_trace::scenario::{Action, OperatorEvent};

/// The operator of a scenario.
#[derive(Clone, Debug)]
pub(super) struct Operator<'a> {
    /// What stands at a block that has not been reached yet.
    ahead: Vec<&'a OperatorEvent>,
    /// What falls due, and when, in order.
    due: Vec<(f64, &'a Action)>,
    /// How often each block has been executed that something stands at.
    executions: BTreeMap<Block, u32>,
    /// Blocks that were entered by hand so far.
    entered: u32,
}

impl<'a> Operator<'a> {
    /// Before the first block.
    pub(super) fn new(events: &'a [OperatorEvent]) -> Self {
        let executions = events.iter().map(|event| (event.when.block.clone(), 0)).collect();
        Self { ahead: events.iter().collect(), due: Vec::new(), executions, entered: 0 }
    }

    /// A block begins: what stands at this execution falls due from this time on.
    pub(super) fn begin_block(&mut self, block: &Block, time: f64) {
        let Some(count) = self.executions.get_mut(block) else { return };
        *count += 1;
        let count = *count;
        let is_here = |event: &OperatorEvent| {
            let when = &event.when;
            when.block == *block && when.execution == count
        };
        let (here, ahead) = self.ahead.iter().partition(|event| is_here(event));
        self.ahead = ahead;
        let here: Vec<&OperatorEvent> = here;
        self.due.extend(here.into_iter().map(|event| (time + event.when.offset, &event.action)));
        self.due.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    }

    /// When the next of what stands at blocks that were reached falls due.
    pub(super) fn due(&self) -> Option<f64> {
        self.due.first().map(|(due, _)| *due)
    }

    /// Takes what has fallen due by then.
    pub(super) fn take(&mut self, time: f64) -> Option<Action> {
        let (due, action) = *self.due.first()?;
        if due > time {
            return None;
        }
        self.due.remove(0);
        self.entered += u32::from(matches!(action, Action::Mdi(_)));
        Some(action.clone())
    }

    /// Blocks that were entered by hand so far, whatever the controller did with them.
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
