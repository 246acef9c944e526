//! Quirks of offsets.

use super::LinuxCnc;
use super::program_end::without_local_offset;
use crate::rs274::dialect::Documented;
use crate::rs274::execute::offsets::OffsetRules;
use crate::rs274::state::State;

impl OffsetRules for LinuxCnc {
    /// Quirk rs274.rotation-under-local-offset.
    fn reload_turned_system(&self, state: &mut State) {
        without_local_offset(|state| Documented.reload_turned_system(state), state);
    }
}
