//! The speed of elements that are so short that too many would end within a cycle.

use crate::limits::{Limits, squared};
use crate::math;
use crate::path_element::PathElement;
use crate::ring::Ring;

/// Where elements are short, the speed is limited so that at most this many end within a cycle.
const ELEMENTS_PER_CROWDED_CYCLE: u64 = 3;

/// Limits the speed of the last elements before `end` where too many would fit into a cycle, of those after the motion
/// at `at`. Lowers `first_changed` to the first element that is changed.
pub(crate) fn limit_crowded_speed(
    end: u64,
    at: u64,
    limits: &Limits,
    (elements, first_changed): (&mut Ring<PathElement>, &mut u64),
) {
    let Some(last) = elements.get(end.wrapping_sub(1)) else { return };
    // An element that takes a whole cycle is not short.
    if last.length >= last.speed_limit * limits.cycle {
        return;
    }
    let first = end.saturating_sub(ELEMENTS_PER_CROWDED_CYCLE);
    let (mut length, mut most) = (last.length, last.speed_limit);
    for place in first..end.wrapping_sub(1) {
        // Fewer elements than that fit into a cycle.
        let Some(element) = elements.get(place) else { return };
        length += element.length;
        most = math::max(most, element.speed_limit);
    }
    if length >= most * limits.cycle {
        return;
    }
    let fastest = length / limits.cycle;
    let ceiling = squared(fastest);
    for place in first.max(at.saturating_add(1))..end {
        if let Some(element) = elements.get_mut(place)
            && element.speed_limit > fastest
        {
            element.start_limit_sq = math::min(element.start_limit_sq, ceiling);
            element.end_limit_sq = math::min(element.end_limit_sq, ceiling);
            element.speed_limit = fastest;
            *first_changed = (*first_changed).min(place);
        }
    }
}
