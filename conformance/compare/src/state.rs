//! In which settings and fields of the state two runs differ, where they do so first.

use gaugeblock_vocabulary::{Entry, Settings, State};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::tolerance::{self, rounded};
use crate::Capabilities;
use crate::accuracy::Match;
use crate::observe::{Observed, ObservedStep, recorded};

/// Settings and state after a block, as far as they differ.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct StateDifference {
    /// The block, such as `main.ngc:4`.
    pub block: String,
    /// Each field that differs.
    pub fields: Vec<FieldDifference>,
}

/// A field that differs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct FieldDifference {
    /// Its name.
    pub field: String,
    /// Its value by the documents.
    pub expected: String,
    /// Its value on the controller.
    pub found: String,
}

/// The first block after which observable members differ, with all of them.
pub fn state(
    expected: &Observed,
    found: &Observed,
    observables: &Capabilities,
) -> Option<StateDifference> {
    let (left, right) = (recorded(expected), recorded(found));
    let pairs = left.iter().zip(&right).take_while(|((_, a), (_, b))| a.block == b.block);
    pairs.into_iter().find_map(|((_, a), (_, b))| {
        let fields = fields(&entries(a), &entries(b), observables);
        (!fields.is_empty()).then(|| StateDifference { block: a.block.to_string(), fields })
    })
}

/// Settings and state after a block. Parameters that a program uses are compared by assertions.
pub(super) fn entries(step: &ObservedStep) -> Vec<Entry> {
    let mut entries = Settings::entries(&step.settings);
    entries.extend(step.state.iter().flat_map(State::entries));
    entries.retain(|entry| entry.field != "parameter");
    entries
}

fn fields(expected: &[Entry], found: &[Entry], observables: &Capabilities) -> Vec<FieldDifference> {
    let shown = expected.iter().filter(|entry| observables.fields.contains(entry.field));
    let differing = shown.filter_map(|entry| {
        let fits = |other: &&Entry| other.field == entry.field && other.index == entry.index;
        let other = found.iter().find(fits)?;
        let resolution = observables.resolution_of(entry.field, found);
        let same = resolution
            .compare(|error| tolerance::fields(entry.field, &entry.value, &other.value, error));
        (same == Match::Different).then(|| FieldDifference {
            field: entry.name(),
            expected: rounded(&entry.value),
            found: rounded(&other.value),
        })
    });
    differing.collect()
}
