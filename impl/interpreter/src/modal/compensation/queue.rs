//! The queue of what waits: data alone.

use alloc::boxed::Box;
use alloc::collections::VecDeque;

use gaugeblock_vocabulary::{Effect, LengthUnit, Settings};

use super::super::coordinates::{Conversion, Coordinates};

/// What waits, the oldest first. The first item is a move in the plane.
#[derive(Clone, Debug)]
pub(super) struct Queue {
    pub(super) items: VecDeque<Item>,
    /// The controlled point before the first item, active length unit.
    pub(super) start: Coordinates,
    /// Most items.
    pub(super) limit: u32,
}

/// Something that waits.
#[derive(Clone, Debug)]
pub(super) struct Item {
    /// Its place in the order of the sink.
    pub(super) place: u64,
    pub(super) line: u32,
    /// The length unit of its block.
    pub(super) units: LengthUnit,
    pub(super) content: Content,
}

#[derive(Clone, Debug)]
pub(super) enum Content {
    /// F alone, which many blocks have.
    Feed(f64),
    Settings(Box<Settings>),
    Effect(Effect),
}

impl Queue {
    /// Nothing waits.
    pub(super) fn new(limit: u32) -> Self {
        Self { items: VecDeque::new(), start: Coordinates::default(), limit }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// What waits is lost.
    pub(super) fn clear(&mut self) {
        self.items.clear();
    }

    /// The point before what waits in another unit.
    pub(super) fn convert(&mut self, by: Conversion) {
        self.start = self.start.converted(by);
    }
}
