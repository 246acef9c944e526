//! The tools as the calls have left them.

use gaugeblock_vocabulary::{LengthUnit, Machine, Tool};

/// The tools as the calls have left them, and the unit of their lengths.
#[derive(Clone, Debug)]
pub(super) struct Table {
    /// In the order of the table.
    pub(super) tools: Vec<Tool>,
    pub(super) unit: LengthUnit,
}

impl Table {
    pub(super) fn new(machine: &Machine) -> Self {
        Self { tools: machine.tools.clone(), unit: machine.length_unit }
    }

    /// The number of the tool at a place of the table.
    pub(super) fn number_at(&self, place: usize) -> Option<i32> {
        let tool = self.tools.get(place)?;
        Some(i32::try_from(tool.number).unwrap_or(i32::MAX))
    }
}
