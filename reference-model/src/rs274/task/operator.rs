//! What the operator does, and when: events that wait for an execution of their block, and then for their time.

use std::collections::BTreeMap;

use gaugeblock_vocabulary::BlockLocation;
use gaugeblock_vocabulary::scenario::{Action, OperatorEvent};

/// The events of a scenario, each taken once.
#[derive(Debug)]
pub(super) struct Operator<'a> {
    events: Vec<Event<'a>>,
    /// How often each block that an event names was begun.
    executions: BTreeMap<&'a BlockLocation, u32>,
}

#[derive(Debug)]
struct Event<'a> {
    event: &'a OperatorEvent,
    /// Its place among the events of the scenario.
    place: usize,
    /// Virtual time at which it happens, seconds; none before its execution has begun.
    due: Option<f64>,
}

/// An event that happens now.
#[derive(Clone, Copy, Debug)]
pub(super) struct Happening<'a> {
    /// Virtual time, seconds.
    pub time: f64,
    /// What the operator does.
    pub action: &'a Action,
    /// Its place among the events of the scenario, from 0.
    pub place: usize,
}

impl<'a> Operator<'a> {
    /// Before the first block.
    pub(super) fn new(events: &'a [OperatorEvent]) -> Self {
        let executions = events.iter().map(|event| (&event.when.block, 0)).collect();
        let events = events.iter().enumerate();
        let events = events.map(|(place, event)| Event { event, place, due: None }).collect();
        Self { events, executions }
    }

    /// An execution of a block begins: the events that name it get their time. Whether there are any.
    pub(super) fn begins(&mut self, block: &BlockLocation, now: f64) -> bool {
        let Some(execution) = self.executions.get_mut(block) else { return false };
        *execution += 1;
        let mut is_named = false;
        for waiting in &mut self.events {
            let when = &waiting.event.when;
            if when.block == *block && when.execution == *execution && waiting.due.is_none() {
                waiting.due = Some(now + when.offset);
                is_named = true;
            }
        }
        is_named
    }

    /// Takes the next event that happens up to a time; of several at one time the one that is listed first.
    pub(super) fn next(&mut self, until: f64) -> Option<Happening<'a>> {
        let due = |(place, event): (usize, &Event<'a>)| Some((event.due?, place));
        let all = self.events.iter().enumerate().filter_map(due);
        let (time, place) = all.min_by(|(a, _), (b, _)| a.total_cmp(b))?;
        if time > until {
            return None;
        }
        let Event { event, place, .. } = self.events.remove(place);
        Some(Happening { time, action: &event.action, place })
    }

    /// Whether something happens at a time that is known by now.
    pub(super) fn is_due(&self) -> bool {
        self.events.iter().any(|event| event.due.is_some())
    }

    /// Whether the operator may still abort a program.
    pub(super) fn may_abort(&self) -> bool {
        self.events.iter().any(|event| event.event.action == Action::Abort)
    }

    /// How many events have not happened.
    pub(super) fn events_left(&self) -> usize {
        self.events.len()
    }

    /// Whether the operator does nothing more.
    pub(super) fn is_done(&self) -> bool {
        self.events.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use gaugeblock_vocabulary::scenario::RunPoint;

    use super::*;

    fn event(line: u32, execution: u32, offset: f64, action: Action) -> OperatorEvent {
        let block = BlockLocation::new("main.ngc", line);
        OperatorEvent { when: RunPoint { block, execution, offset }, action }
    }

    #[test]
    fn events_come_in_the_order_of_their_times() {
        let events = [
            event(2, 1, 0.3, Action::Abort),
            event(2, 1, 0.1, Action::Pause),
            event(1, 2, 0.0, Action::CycleStart),
            event(2, 1, 0.1, Action::Resume),
        ];
        let mut operator = Operator::new(&events);
        let places = |operator: &mut Operator<'_>, until| {
            std::iter::from_fn(|| operator.next(until).map(|h| h.place)).collect::<Vec<_>>()
        };
        operator.begins(&BlockLocation::new("main.ngc", 1), 0.0);
        assert!(places(&mut operator, f64::INFINITY).is_empty());
        operator.begins(&BlockLocation::new("main.ngc", 2), 1.0);
        assert_eq!(places(&mut operator, 1.2), [1, 3]);
        operator.begins(&BlockLocation::new("main.ngc", 1), 2.0);
        assert_eq!(places(&mut operator, f64::INFINITY), [0, 2]);
        assert!(operator.is_done());
    }
}
