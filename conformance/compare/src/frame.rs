//! Judges that a block changes no other fields than those that an assertion names.

use gaugeblock_suite::assertion::Field;
use gaugeblock_vocabulary::{Entry, State};

use crate::Capabilities;
use crate::accuracy::{Match, hidden};
use crate::observe::{Observed, ObservedStep};
use crate::{rounded, tolerance};

/// Numbered parameters that belong to the program alone. The others follow the position, the offsets and the tool, or
/// belong to one call.
pub(super) const PROGRAM_PARAMETERS: std::ops::RangeInclusive<u32> = 31..=5000;

/// Compares settings and state after a block with those before it. The settings before are those of the last block
/// before it; the state is the last recorded one. Returns the first field that cannot be judged.
///
/// # Errors
/// A field that the block changes.
pub(super) fn unchanged(
    run: &Observed,
    step: &ObservedStep,
    changed: &[Field],
    observables: &Capabilities,
) -> Result<Option<String>, String> {
    let place = run.steps.iter().position(|other| std::ptr::eq(other, step)).unwrap_or_default();
    let earlier = &run.steps[..place];
    let mut before = earlier.last().map_or(&run.start, |step| &step.settings).entries();
    let state = earlier.iter().rev().find_map(|step| step.state.as_ref());
    before.extend(state.into_iter().flat_map(State::entries));
    let mut after = step.settings.entries();
    after.extend(step.state.iter().flat_map(State::entries));
    let is_judged = |entry: &&Entry| {
        let index = entry.index.as_deref();
        let is_of_program = index.and_then(|index| index.parse().ok());
        let is_of_program = is_of_program.is_some_and(|n| PROGRAM_PARAMETERS.contains(&n));
        (entry.field != "parameter" || is_of_program)
            && !changed.iter().any(|field| field.covers(entry.field, index))
    };
    let mut masked = None;
    for found in after.iter().filter(is_judged) {
        if !observables.fields.contains(found.field) {
            masked = Some(found.field.to_owned());
            continue;
        }
        let same = |entry: &&Entry| entry.field == found.field && entry.index == found.index;
        let Some(old) = before.iter().find(same) else {
            if found.field == "parameter" {
                return Err(format!("{} = {}", found.name(), rounded(&found.value)));
            }
            continue;
        };
        let resolution = observables.resolution_of(found.field, &after);
        let are_equal = |error| tolerance::fields(found.field, &old.value, &found.value, error);
        match resolution.compare(are_equal) {
            Match::Equal => {}
            Match::Hidden => masked = Some(hidden(found.field)),
            Match::Different => {
                let (name, old) = (found.name(), rounded(&old.value));
                let new = rounded(&found.value);
                return Err(format!("{name} = {new}; before the block it was {old}"));
            }
        }
    }
    Ok(masked)
}
