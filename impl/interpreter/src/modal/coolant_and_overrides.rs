//! Coolant (11.6.7) and override controls (11.6.9 to 11.6.13).

use gaugeblock_vocabulary::{Compensation, FaultKind, Switch};

use crate::faults::{PlantedFault, planted};

use super::Modal;
use super::check::Block;
use super::modes::FIRST;
use super::refusal::{Refusal, refuse};
use super::values::integer;

impl Modal {
    /// M7, M8, M9.
    pub(super) fn coolant(&mut self, code: u16) {
        let modes = self.active.set();
        match code {
            7 if modes.flood == Switch::On && planted(PlantedFault::MistAfterFlood) => {}
            7 => modes.mist = Switch::On,
            8 => modes.flood = Switch::On,
            _ if planted(PlantedFault::MistStays) => modes.flood = Switch::Off,
            _ => (modes.mist, modes.flood) = (Switch::Off, Switch::Off),
        }
    }

    /// M48 to M53.
    pub(super) fn overrides(&mut self, block: &Block<'_>, code: u16) -> Result<(), Refusal> {
        if self.choices.override_uncompensated {
            self.refuse_under_compensation("overrides")?;
        }
        let without = if self.choices.override_first { FIRST } else { self.all_spindles() };
        if let 48 | 49 = code {
            let switch = if code == 48 { Switch::On } else { Switch::Off };
            let mut which = self.selected(block, without)?;
            let disabled = code == 49 && self.active.now().feed_override == Switch::Off;
            if disabled && planted(PlantedFault::DisabledAlready) {
                return Ok(());
            }
            if code == 48 && planted(PlantedFault::EnablesAll) {
                which = self.all_spindles();
            }
            if block.words.dollar.is_none() || !self.choices.feed_override_untouched {
                self.active.put(|modes| &mut modes.feed_override, switch);
            }
            if code == 49 && planted(PlantedFault::DisablesAdaptive) {
                self.active.put(|modes| &mut modes.adaptive_feed, Switch::Off);
            }
            if code == 48 || !planted(PlantedFault::SpeedUntouched) {
                self.set_speed_override(which, switch);
            }
            return Ok(());
        }
        // P1 is optional.
        let default = if planted(PlantedFault::DefaultOff) { 0 } else { 1 };
        let switch = match block.words.get(b'P').map_or(Ok(default), |p| integer(p, "P"))? {
            0 => Switch::Off,
            1 => Switch::On,
            _ => return refuse(FaultKind::WordOutOfRange, "P of M50 to M53 is 0 or 1"),
        };
        match code {
            50 => self.active.put(|modes| &mut modes.feed_override, switch),
            51 => {
                let mut which = self.selected(block, without)?;
                if block.words.get(b'P').is_none() && planted(PlantedFault::BareIgnoresSpindle) {
                    which = without;
                }
                self.set_speed_override(which, switch);
            }
            52 if !planted(PlantedFault::WrongSwitch) => {
                self.active.put(|modes| &mut modes.adaptive_feed, switch);
            }
            _ => self.active.put(|modes| &mut modes.feed_stop, switch),
        }
        Ok(())
    }

    /// Refuses what an option does not allow while cutter compensation is on.
    pub(super) fn refuse_under_compensation(&self, what: &str) -> Result<(), Refusal> {
        if self.active.now().compensation == Compensation::Off {
            return Ok(());
        }
        refuse(
            FaultKind::CompensationActive,
            alloc::format!("{what} while cutter compensation is on"),
        )
    }
}
