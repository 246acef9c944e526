//! What LinuxCNC remembers and the documents do not need.

use gaugeblock_vocabulary::LengthUnit;

/// What it remembers besides the modes: no save keeps it, and no restore brings it back.
#[derive(Clone, Debug, Default)]
pub(crate) struct Memory {
    /// Quirk rs274.rest-of-restore-block: whether the rest of the block is dropped.
    pub(super) drops_rest: bool,
}

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
}

impl Remembered {
    /// Before the first block.
    const AT_START: Self = Self {
        feed_number: 0.0,
        tool_offset_unit: LengthUnit::Millimetre,
        tolerance_unit: LengthUnit::Millimetre,
    };
}

impl ModalMemory {
    /// The values.
    pub(super) fn get(&self) -> &Remembered {
        self.0.as_deref().unwrap_or(&Remembered::AT_START)
    }

    /// The values, for changing them.
    pub(super) fn get_mut(&mut self) -> &mut Remembered {
        self.0.get_or_insert_with(|| Box::new(Remembered::AT_START))
    }
}

impl PartialEq for ModalMemory {
    fn eq(&self, other: &Self) -> bool {
        self.get() == other.get()
    }
}
