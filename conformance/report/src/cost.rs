//! The cost of a run. It has a file of its own, because costs differ from run to run and reports are compared byte by
//! byte.

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
    /// The cost of a run.
    pub fn of(run: &Run<'_>) -> Self {
        let mut all = Self::default();
        for result in &run.cases {
            let of_rule = all.0.entry(result.rule.id.clone()).or_default();
            let milliseconds = (result.cost.as_secs_f64() * 1e6).round() / 1e3;
            of_rule.insert(result.name.to_owned(), milliseconds);
        }
        all
    }

    /// Parses it.
    ///
    /// # Errors
    /// It is not valid, with its place.
    pub fn read(text: &str) -> Result<Self, String> {
        serde_json::from_str(text).map_err(|error| error.to_string())
    }

    /// Its text.
    pub fn to_text(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }

    /// Sets the cost of each case, if known.
    pub fn apply_to(&self, cases: &mut [CaseResult<'_>]) {
        for result in cases {
            let known = self.0.get(&result.rule.id).and_then(|of_rule| of_rule.get(result.name));
            if let Some(milliseconds) = known {
                result.cost = Duration::try_from_secs_f64(milliseconds / 1e3).unwrap_or_default();
            }
        }
    }

    /// The cost of several parts.
    pub fn and(mut self, other: Self) -> Self {
        for (rule, cases) in other.0 {
            self.0.entry(rule).or_default().extend(cases);
        }
        self
    }
}
