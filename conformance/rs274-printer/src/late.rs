//! Calls that wait under cutter compensation: `rs274` prints them when the end of the move before them is known.

use std::collections::VecDeque;

/// Calls and moves that wait, in program order.
#[derive(Debug, Default)]
pub(super) struct Late {
    items: VecDeque<Item>,
    /// The call that is being written.
    call: Vec<u8>,
    /// Whether calls of the present phase wait behind a move.
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
        let is_head = |item: &mut Item| matches!(item, Item::Move(number) if *number == place);
        let _passed = self.items.pop_front_if(is_head);
    }

    /// The next call, where no move is before it.
    pub(super) fn next_call(&mut self) -> Option<Vec<u8>> {
        match self.items.pop_front_if(|item| matches!(item, Item::Call(_)))? {
            Item::Call(call) => Some(call),
            Item::Move(_) => None,
        }
    }

    /// What waits is lost.
    pub(super) fn lose(&mut self) {
        self.items.clear();
        self.call.clear();
        self.waits = false;
    }
}
