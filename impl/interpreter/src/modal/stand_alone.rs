//! What the stand-alone `rs274` has in place of a machine, to emulate it: a probe that touches at the programmed point
//! and backs off, and a spindle that only M6 loads.

use gaugeblock_vocabulary::LengthUnit;

use crate::math;
use crate::parameters::Numbered;

use super::Modal;
use super::check::Block;
use super::coordinates::Coordinates;
use super::modes::Modes;

impl Modal {
    /// Where the tool is after a probing move: 0.01 inch back from its end, along X, Y and Z.
    pub(super) fn after_probe(&self, start: Coordinates, end: Coordinates) -> Coordinates {
        let back = match self.active.now().units {
            LengthUnit::Inch => 0.01,
            LengthUnit::Millimetre => 0.254,
        };
        let [x, y, z, ..] = end.minus(start).0;
        let length = math::hypotenuse(math::hypotenuse(x, y), z);
        if length <= 0.0 {
            return end;
        }
        let by = [x, y, z].map(|along| along / length * back);
        let mut there = end;
        for (place, by) in there.0.iter_mut().zip(by) {
            *place -= by;
        }
        there
    }

    /// After a block with M6 or M61 the program learns anew where the tool is: at the end of the last move, whatever
    /// tool offset the block selected. The tool in the spindle is the one that M6 put there last.
    pub(super) fn after_tool_change(
        &mut self,
        block: &Block<'_>,
        before: Coordinates,
        numbered: &mut Numbered,
    ) {
        let mut codes = block.m().map(|(_, code)| code).filter(|code| matches!(code, 6 | 61));
        let Some(code) = codes.next() else { return };
        if code == 61 {
            self.tool = self.loaded_by_change;
            self.publish_tool(numbered);
        }
        self.move_to_cutter();
        if !block.axes_move {
            let now = *self.active.now();
            let machine = now.machine_of(self.position);
            self.position = Modes { tool_offset: before, ..now }.program_of(machine);
        }
    }
}
