//! What LinuxCNC remembers with the modes.

use std::collections::BTreeSet;

use gaugeblock_vocabulary::LengthUnit;

/// What it remembers with the modes, and saves and restores with them.
#[derive(Clone, Debug, Default)]
pub(crate) struct ModalMemory(Option<Box<Remembered>>);

/// The values themselves.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Remembered {
    /// F as it was programmed, in the length unit of that time.
    pub(super) feed_number: f64,
    /// The length unit in which the tool offset was programmed.
    pub(super) tool_offset_unit: LengthUnit,
    /// The length unit in which the tolerances of G64 were programmed.
    pub(super) tolerance_unit: LengthUnit,
    /// Spindles whose brake a speed has released since they were stopped.
    pub(super) brake_released: BTreeSet<usize>,
    /// Spindles that the interpreter takes for stopped, however they turn.
    pub(super) taken_for_stopped: BTreeSet<usize>,
}

/// The values before the first block.
static AT_START: Remembered = Remembered {
    feed_number: 0.0,
    tool_offset_unit: LengthUnit::Millimetre,
    tolerance_unit: LengthUnit::Millimetre,
    brake_released: BTreeSet::new(),
    taken_for_stopped: BTreeSet::new(),
};

impl ModalMemory {
    /// The values.
    pub(super) fn get(&self) -> &Remembered {
        self.0.as_deref().unwrap_or(&AT_START)
    }

    /// The values, for changing them.
    pub(super) fn get_mut(&mut self) -> &mut Remembered {
        self.0.get_or_insert_with(|| Box::new(AT_START.clone()))
    }
}

impl PartialEq for ModalMemory {
    fn eq(&self, other: &Self) -> bool {
        self.get() == other.get()
    }
}
