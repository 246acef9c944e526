//! What a run cost, beside what came of it: a file of its own, since no two runs cost the same and their reports are
//! compared byte by byte.

use std::collections::BTreeMap;
use std::time::Duration;

use gaugeblock_runner::certify::{CaseResult, Run};
use serde::{Deserialize, Serialize};

/// Name of the file in the folder of a report.
pub const FILE: &str = "cost.json";

/// Milliseconds of each case, by rule and case.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Cost(BTreeMap<String, BTreeMap<String, f64>>);

impl Cost {
    /// What a run cost.
    pub fn of(run: &Run<'_>) -> Self {
        let mut all = Self::default();
        for result in &run.cases {
            let of_rule = all.0.entry(result.rule.id.clone()).or_default();
            let milliseconds = (result.cost.as_secs_f64() * 1e6).round() / 1e3;
            of_rule.insert(result.name.to_owned(), milliseconds);
        }
        all
    }

    /// Reads it.
    ///
    /// # Errors
    /// It is none, with its place.
    pub fn read(text: &str) -> Result<Self, String> {
        serde_json::from_str(text).map_err(|error| error.to_string())
    }

    /// What it is as text.
    pub fn to_text(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }

    /// Writes to each case of a run what it cost, where that is known.
    pub fn apply_to(&self, cases: &mut [CaseResult<'_>]) {
        for result in cases {
            let known = self.0.get(&result.rule.id).and_then(|of_rule| of_rule.get(result.name));
            if let Some(milliseconds) = known {
                result.cost = Duration::try_from_secs_f64(milliseconds / 1e3).unwrap_or_default();
            }
        }
    }

    /// What several parts cost.
    pub fn and(mut self, other: Self) -> Self {
        for (rule, cases) in other.0 {
            self.0.entry(rule).or_default().extend(cases);
        }
        self
    }
}
