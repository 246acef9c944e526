//! Calls that wait under cutter compensation: `rs274` prints them when the end of the move before them is known.

use std::collections::VecDeque;

/// Calls and moves that wait, in program order.
#[derive(Debug, Default)]
pub(super) struct Late {
    items: VecDeque<Item>,
    /// The call that is being written.
    call: Vec<u8>,
    /// Whether calls of the present phase wait after a move.
    pub(super) waits: bool,
}

#[derive(Debug)]
enum Item {
    /// The text of a call.
    Call(Vec<u8>),
    /// A move, by the number of its place.
    Move(u64),
}

impl Late {
    /// Whether calls that are written now wait.
    pub(super) fn takes(&self) -> bool {
        self.waits && !self.items.is_empty()
    }

    /// A move waits from here on.
    pub(super) fn hold(&mut self, place: u64) {
        self.items.push_back(Item::Move(place));
    }

    /// The text of the call that is being written.
    pub(super) fn call(&mut self) -> &mut Vec<u8> {
        &mut self.call
    }

    /// The call is complete.
    pub(super) fn end_call(&mut self) {
        self.items.push_back(Item::Call(std::mem::take(&mut self.call)));
    }

    /// The move at the head does not wait any more.
    pub(super) fn pass(&mut self, place: u64) {
        if matches!(self.items.front(), Some(Item::Move(number)) if *number == place) {
            let _passed = self.items.pop_front();
        }
    }

    /// The next call, where no move is before it.
    pub(super) fn next_call(&mut self) -> Option<Vec<u8>> {
        let Some(Item::Call(call)) = self.items.front_mut() else { return None };
        let call = std::mem::take(call);
        let _passed = self.items.pop_front();
        Some(call)
    }

    /// What waits is lost.
    pub(super) fn lose(&mut self) {
        self.items.clear();
        self.call.clear();
        self.waits = false;
    }
}
