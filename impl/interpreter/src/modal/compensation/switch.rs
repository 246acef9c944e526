//! Cutter compensation as a mode: what it needs to be switched on, and the cutter that it takes.

use gaugeblock_vocabulary::{Compensation, FaultKind, Plane};

use crate::canon::Sink;
use crate::faults::{PlantedFault, planted};
use crate::words::Words;

use super::super::Modal;
use super::super::refusal::{Refusal, refuse};
use super::super::values::{integer, integer_in};
use super::Cutter;
use super::path::PathState;

impl Modal {
    /// G40 to G42.1.
    pub(in super::super) fn switch_compensation<K: Sink>(
        &mut self,
        words: &Words,
        code: u16,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        if code == 400 {
            return self.switch_off(sink);
        }
        let plane = self.active.now().plane;
        let is_left = matches!(code, 410 | 411);
        if self.is_other_side(is_left) && planted(PlantedFault::OtherSideReplaces) {
            self.end_path(sink)?;
        } else {
            self.refuse_under_compensation("cutter compensation")?;
        }
        let is_free =
            plane == Plane::Yz && matches!(code, 411 | 421) && planted(PlantedFault::DynamicInYz);
        if !(is_free || matches!(plane, Plane::Xy | Plane::Zx)) {
            return refuse(FaultKind::ModalConflict, "cutter compensation outside of XY and ZX");
        }
        if plane != Plane::Xy && self.choices.compensation_in_xy_only {
            return refuse(FaultKind::ModalConflict, "cutter compensation outside of XY");
        }
        let is_turned = plane == Plane::Zx && planted(PlantedFault::SidesByWordOrder);
        let is_left = is_left != is_turned;
        self.cutter = if let 411 | 421 = code {
            let orientation = self.or_of_tool(words, dynamic_orientation(words, plane)?, plane);
            Cutter::new(words.get(b'D').unwrap_or(0.0), is_left, orientation)
        } else {
            let diameter = words.get(b'D');
            let is_zero = diameter.is_some_and(|number| integer(number, "D") == Ok(0));
            let is_none = is_zero && self.choices.length_zero_is_none;
            let mut tool =
                if is_none { None } else { self.named_tool(self.or_selected(diameter), "D")? };
            if planted(PlantedFault::RadiusOfSpindleTool) {
                tool = self.named_tool(None, "D")?;
            }
            let (mut diameter, orientation) =
                tool.map_or((0.0, 0), |tool| (tool.diameter, tool.orientation));
            if planted(PlantedFault::NegativeDiameterAbsolute) {
                diameter = diameter.abs();
            }
            // Orientation 9 has its tip at the centre.
            if (1..=8).contains(&orientation) && plane != Plane::Zx {
                return refuse(
                    FaultKind::ModalConflict,
                    "compensation by a tool with an orientation outside of ZX",
                );
            }
            Cutter::new(self.table_to_active().of(diameter), is_left, orientation)
        };
        if self.emulates_rs274 {
            self.cutter = self.cutter.emulating_rs274();
        }
        let compensation = match code {
            410 => Compensation::Left,
            420 => Compensation::Right,
            411 => Compensation::DynamicLeft,
            _ => Compensation::DynamicRight,
        };
        // The first move after an earlier G40 has still to come.
        let exit = self.compensation.path.exit;
        *self.compensation.path_mut() = PathState { exit, ..PathState::default() };
        self.active.put(|modes| &mut modes.compensation, compensation);
        self.note_compensation();
        Ok(())
    }

    /// Whether compensation is on for the other side. Only a planted fault uses it.
    fn is_other_side(&self, is_left: bool) -> bool {
        match self.active.now().compensation {
            Compensation::Off => false,
            Compensation::Left | Compensation::DynamicLeft => !is_left,
            Compensation::Right | Compensation::DynamicRight => is_left,
        }
    }

    /// The number of D. Without D a planted fault returns the tool that T selected.
    fn or_selected(&self, word: Option<f64>) -> Option<f64> {
        let selected = self.selected.filter(|_| planted(PlantedFault::RadiusOfSelectedTool));
        word.or(selected.map(f64::from))
    }

    /// The orientation of L. Without L a planted fault returns that of the loaded tool.
    fn or_of_tool(&self, words: &Words, orientation: u8, plane: Plane) -> u8 {
        let takes = words.get(b'L').is_none() && plane == Plane::Zx;
        if !(takes && planted(PlantedFault::DynamicOrientationOfTool)) {
            return orientation;
        }
        let tool = self.named_tool(None, "L").ok().flatten();
        tool.map_or(orientation, |tool| tool.orientation)
    }
}

/// L of G41.1 and G42.1: an orientation from 0 to 9, in the ZX plane only (11.5.27).
fn dynamic_orientation(words: &Words, plane: Plane) -> Result<u8, Refusal> {
    let Some(word) = words.get(b'L') else { return Ok(0) };
    let orientation = integer_in(word, 0, 9, "L of G41.1 and G42.1")?;
    let none = word.abs() < 0.5 && planted(PlantedFault::OrientationZeroFree);
    if plane != Plane::Zx && !none {
        return refuse(FaultKind::UnusedWord, "L of dynamic compensation outside of ZX");
    }
    Ok(u8::try_from(orientation).unwrap_or(0))
}
