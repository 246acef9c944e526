//! Quirks of inputs and outputs.

use crate::rs274::machine::State;
use crate::rs274::step::whole;

/// Quirk rs274.output-value-optional. The value of M67 and M68 without Q.
pub(crate) const ABSENT_VALUE: f64 = -1.0;

/// Quirk rs274.io-number-rounded. A number of an input or output is rounded, halves to the even number.
pub(crate) fn number(value: f64, state: &State) -> Option<i32> {
    if state.readings.quirk("rs274.io-number-rounded") {
        whole(value.round_ties_even())
    } else {
        whole(value)
    }
}
