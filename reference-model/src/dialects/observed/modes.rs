//! Quirks of the modes before the first block.

use super::{HasQuirk, Observed};
use crate::Choices;
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::modes::ModesRules;

impl ModesRules for Observed {
    /// Quirk nist.offset-at-start. The stored offset applies for every value of #5210.
    fn offset_applies_at_start(&self, flag: f64, choices: &Choices) -> bool {
        choices.has_quirk(quirk::nist::OFFSET_AT_START)
            || Documented.offset_applies_at_start(flag, choices)
    }

    /// Quirk linuxcnc.initial-tolerance. Before the first G64 paths are blended within a thousandth of an inch.
    fn initial_blend_tolerance(&self, choices: &Choices) -> f64 {
        if choices.has_quirk(quirk::linuxcnc::INITIAL_TOLERANCE) {
            return 0.0254;
        }
        Documented.initial_blend_tolerance(choices)
    }
}
