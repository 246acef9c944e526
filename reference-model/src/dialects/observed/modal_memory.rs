//! State of LinuxCNC's quirks that M70 and M73 save together with the modes.

use std::collections::BTreeSet;

use gaugeblock_vocabulary::{LengthUnit, Switch};

/// State that is saved and restored together with the modes.
#[derive(Clone, Debug, Default)]
pub(crate) struct ModalMemory(Option<Box<Remembered>>);

/// The values themselves.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Remembered {
    /// F as it was programmed, in the length unit that was active then.
    pub(super) feed_number: f64,
    /// Quirk rs274.thread-feed-override: the interpreter's own flag of the feed override, if a thread has enabled the
    /// override of the machine.
    pub(super) override_flag: Option<Switch>,
    /// The length unit in which the tool offset was programmed.
    pub(super) tool_offset_unit: LengthUnit,
    /// The length unit in which the tolerances of G64 were programmed.
    pub(super) tolerance_unit: LengthUnit,
    /// Quirk linuxcnc.modes-of-last-motion: whether the interpreter has read a program end, which sets F to zero.
    pub(super) has_read_end: bool,
    /// Spindles whose brake an S word has released since they were stopped.
    pub(super) brake_released: BTreeSet<usize>,
    /// Spindles that the interpreter regards as stopped, even if they turn.
    pub(super) regarded_as_stopped: BTreeSet<usize>,
}

/// The values before the first block.
static AT_START: Remembered = Remembered {
    feed_number: 0.0,
    override_flag: None,
    tool_offset_unit: LengthUnit::Millimetre,
    tolerance_unit: LengthUnit::Millimetre,
    has_read_end: false,
    brake_released: BTreeSet::new(),
    regarded_as_stopped: BTreeSet::new(),
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
