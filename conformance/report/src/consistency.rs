//! Whether a report that is read again says one thing: its counts and its exit status follow from its cases.

use serde::Deserialize;
use serde::de::IgnoredAny;

use super::rule::{Counts, Totals};
use super::stored::StoredCase;

/// What a report says of all its cases.
#[derive(Debug, Deserialize)]
pub(crate) struct Summary {
    counts: Counts,
    exit_status: u8,
    profiles: Vec<Profile>,
    expectations: Option<Vec<IgnoredAny>>,
}

#[derive(Debug, Deserialize)]
struct Profile {
    claimed: bool,
    passes: bool,
}

/// Counts the cases again.
///
/// # Errors
/// The summary does not follow from the cases; the message follows the name of the file.
pub(crate) fn check(summary: &Summary, cases: &[StoredCase]) -> Result<(), String> {
    let mut counts = Counts::default();
    for case in cases {
        counts.add_verdict(&case.verdict.reported(), case.accepted.is_some(), &case.compared);
    }
    if let Some((name, reported, counted)) = first_difference(summary.counts, counts) {
        return Err(format!(
            "contradicts itself: `{name}` of its counts is {reported}, and its cases result in {counted}"
        ));
    }
    let totals = Totals {
        counts,
        mismatches: summary.expectations.as_ref().map(Vec::len),
        fails_profile: summary.profiles.iter().any(|profile| profile.claimed && !profile.passes),
        leaks: cases.iter().any(|case| case.before.is_some()),
    };
    let (reported, status) = (summary.exit_status, totals.exit_status());
    if reported == status {
        return Ok(());
    }
    Err(format!(
        "contradicts itself: its exit status is {reported}, and its cases result in {status}"
    ))
}

/// The first count that differs: its name, and its value on both sides.
fn first_difference(reported: Counts, counted: Counts) -> Option<(String, u64, u64)> {
    let values = |counts: Counts| match serde_json::to_value(counts) {
        Ok(serde_json::Value::Object(values)) => values,
        Ok(_) | Err(_) => serde_json::Map::new(),
    };
    let other = values(counted);
    let number = |value: Option<&serde_json::Value>| value.and_then(serde_json::Value::as_u64);
    values(reported).iter().find_map(|(name, value)| {
        let (value, counted) = (number(Some(value))?, number(other.get(name))?);
        (value != counted).then(|| (name.clone(), value, counted))
    })
}
