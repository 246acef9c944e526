//! Cutter compensation as a mode (11.5.25 to 11.5.27): what it needs to be switched on.

use gaugeblock_vocabulary::{Compensation, FaultKind, Plane};

use crate::faults::{PlantedFault, planted};
use crate::words::Words;

use super::Modal;
use super::refusal::{Refusal, refuse};
use super::values::integer_in;

impl Modal {
    /// G40 to G42.1.
    pub(super) fn compensation(&mut self, words: &Words, code: u16) -> Result<(), Refusal> {
        if code == 400 {
            self.compensation_radius = 0.0;
            self.active.put(|modes| &mut modes.compensation, Compensation::Off);
            return Ok(());
        }
        self.refuse_under_compensation("cutter compensation")?;
        let plane = self.active.now().plane;
        if !matches!(plane, Plane::Xy | Plane::Zx) {
            return refuse(FaultKind::ModalConflict, "cutter compensation outside of XY and ZX");
        }
        self.compensation_radius = if let 411 | 421 = code {
            if let Some(orientation) = words.get(b'L') {
                integer_in(orientation, 0, 9, "L of G41.1 and G42.1")?;
                let none = orientation.abs() < 0.5 && planted(PlantedFault::OrientationZeroFree);
                if plane != Plane::Zx && !none {
                    return refuse(
                        FaultKind::UnusedWord,
                        "L of dynamic compensation outside of ZX",
                    );
                }
            }
            words.get(b'D').unwrap_or(0.0) / 2.0
        } else {
            let tool = self.named_tool(words.get(b'D'), "D")?;
            self.stored_to_active().of(tool.map_or(0.0, |tool| tool.diameter / 2.0))
        };
        let compensation = match code {
            410 => Compensation::Left,
            420 => Compensation::Right,
            411 => Compensation::DynamicLeft,
            _ => Compensation::DynamicRight,
        };
        self.active.put(|modes| &mut modes.compensation, compensation);
        Ok(())
    }
}
