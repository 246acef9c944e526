//! Quirks of offsets.

use gaugeblock_vocabulary::{Axis, Compensation, FaultKind, Position};

use super::program_end::without_local_offset;
use super::values::in_single_precision;
use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::local_offset::LocalOffsetRules;
use crate::rs274::execute::offsets::OffsetRules;
use crate::rs274::execute::{whole, word};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

impl OffsetRules for Observed {
    /// Quirk nist.systems-under-compensation. A system is selected while the cutter is compensated.
    fn selects_under_compensation(&self, state: &State) -> bool {
        state.has_quirk(quirk::nist::SYSTEMS_UNDER_COMPENSATION)
            || Documented.selects_under_compensation(state)
    }

    /// Quirk rs274.same-system-kept. Selecting the active coordinate system does not read its parameters again.
    fn select_system(&self, system: u32, state: &mut State) {
        let same = system == state.modes.work_offset;
        if !(same && state.has_quirk(quirk::rs274::SAME_SYSTEM_KEPT)) {
            Documented.select_system(system, state);
        }
    }

    /// Quirk rs274.calculate-without-axes. G10 L20 needs no axis word.
    fn check_calculated_axes(&self, words: &Words, state: &State) -> Result<(), StepError> {
        if state.has_quirk(quirk::rs274::CALCULATE_WITHOUT_AXES) {
            return Ok(());
        }
        Documented.check_calculated_axes(words, state)
    }

    /// Quirk grbl.offset-kind-cut. The whole part counts, and of that eight bits: 2 or 20.
    fn offset_kind(&self, value: f64, state: &State) -> Option<i32> {
        if state.has_quirk(quirk::grbl::OFFSET_KIND_CUT) {
            return whole(eight_bits(value)).filter(|kind| [2, 20].contains(kind));
        }
        Documented.offset_kind(value, state)
    }

    /// Quirk rs274.origin-number-cut. P of G10 L2 with a fraction of 0.5 or more is rounded down.
    /// Quirk grbl.set-without-number. Without P it is the active system.
    /// Quirk grbl.system-number-bits. The whole part counts, and of that eight bits.
    fn programmed_system(&self, words: &Words, state: &State) -> Option<f64> {
        if word(words, 'p').is_none() && state.has_quirk(quirk::grbl::SET_WITHOUT_NUMBER) {
            return Some(0.0);
        }
        if state.has_quirk(quirk::grbl::SYSTEM_NUMBER_BITS) {
            return Documented.programmed_system(words, state).map(eight_bits);
        }
        let cuts = state.has_quirk(quirk::rs274::ORIGIN_NUMBER_CUT);
        let is_cut = |number: f64| cuts && number - number.floor() >= 0.5;
        let number = Documented.programmed_system(words, state)?;
        Some(if is_cut(number) { number.floor() } else { number })
    }

    /// Quirk rs274.rotation-under-local-offset. G10 L2 rotates the active system without the local offset.
    fn reload_turned_system(&self, state: &mut State) {
        without_local_offset(|state| Documented.reload_turned_system(state), state);
    }
}

/// What eight bits hold of the whole part of a number that is not below zero, in single precision.
fn eight_bits(number: f64) -> f64 {
    if number < 0.0 { number } else { in_single_precision(number).trunc() % 256.0 }
}

impl LocalOffsetRules for Observed {
    /// Quirk nist.local-offset-under-compensation. Not while the cutter is compensated.
    fn check_local_offset(&self, state: &State) -> Result<(), StepError> {
        let quirk = quirk::nist::LOCAL_OFFSET_UNDER_COMPENSATION;
        if state.modes.compensation != Compensation::Off && state.has_quirk(quirk) {
            let message = "the local offset is changed while cutter compensation is on";
            return Err(refuse(quirk, FaultKind::CompensationActive, message));
        }
        Documented.check_local_offset(state)
    }

    /// Quirk grbl.offset-cancelled-late. The offset is recorded for `named_coordinate`.
    fn local_offset_ends(&self, state: &mut State) {
        state.memory.cancelled_offset = state.modes.g92_offset;
    }

    /// Quirk grbl.offset-cancelled-late. In the block of G92.1 axis words count with the offset that it cancels.
    fn named_coordinate(&self, axis: Axis, value: f64, words: &Words, state: &State) -> f64 {
        let named = Documented.named_coordinate(axis, value, words, state);
        let cancels = words.g_tenths.contains(&921);
        let late = cancels && state.has_quirk(quirk::grbl::OFFSET_CANCELLED_LATE);
        if late { named + state.memory.cancelled_offset.get(axis) } else { named }
    }

    /// Quirk rs274.position-omitted-axes. Axes without a word in the block of G92 keep their local offset.
    fn offset_without_word(&self, before: Position, state: &State) -> Position {
        if state.has_quirk(quirk::rs274::POSITION_OMITTED_AXES) {
            return before;
        }
        Documented.offset_without_word(before, state)
    }
}
