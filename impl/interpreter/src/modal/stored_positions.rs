//! Stored positions: G28 and G30 move there, G28.1 and G30.1 store one (11.5.20, 11.5.21). Codes are in tenths.

use crate::canon::Sink;
use crate::faults::{PlantedFault, planted};
use crate::parameters::Numbered;

use super::Modal;
use super::check::Block;
use super::coordinates::Coordinates;
use super::letters::{X, Y, Z};
use super::offsets::{self, G28_POSITION, G30_POSITION};
use super::refusal::Refusal;

impl Modal {
    /// Executes G28, G28.1, G30 or G30.1. Positions are stored in machine coordinates and in the machine's unit.
    pub(super) fn stored_position<K: Sink>(
        &mut self,
        block: &Block<'_>,
        code: u16,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        self.refuse_under_compensation("a predefined position")?;
        let first = if matches!(code, 280 | 281) || planted(PlantedFault::OnePosition) {
            G28_POSITION
        } else {
            G30_POSITION
        };
        if matches!(code, 281 | 301) {
            let mut frame = *self.active.now();
            if code == 301 && planted(PlantedFault::StoredWithoutTool) {
                frame.tool_offset = Coordinates::default();
            }
            let machine = frame.machine_of(self.position);
            // All nine axes are stored (11.4.3.1), although 11.5.20 lists parameters only up to #5166.
            let stored = if code == 281 && planted(PlantedFault::StoredNumber) {
                machine
            } else {
                machine.converted(self.active_to_stored())
            };
            offsets::set_row(numbered, first, stored);
            return Ok(());
        }
        self.leave_path_by_other_move(code);
        let mut letters = block.words.axes();
        if letters == 0 {
            letters = self.axes;
            if code == 300 && planted(PlantedFault::OnlyLinear) {
                letters &= X | Y | Z;
            }
        } else {
            let absolute = planted(PlantedFault::IntermediateAbsolute) && !block.words.is_polar();
            let intermediate = if absolute && self.is_incremental() {
                self.position.replaced(block.words)
            } else {
                self.block_end_point(block)?
            };
            if !planted(PlantedFault::StraightToPosition) {
                self.traverse_to(block.words.line, intermediate, sink)?;
            }
            if self.choices.home_all_axes || planted(PlantedFault::AllAxes) {
                letters = self.axes;
            }
        }
        let stored = offsets::row(numbered, first).converted(self.stored_to_active());
        let end = if self.choices.position_program_axes {
            self.position.taking(letters, self.active.now().program_of(stored))
        } else {
            self.with_machine(self.position, letters, stored)
        };
        self.traverse_to(block.words.line, end, sink)
    }
}
