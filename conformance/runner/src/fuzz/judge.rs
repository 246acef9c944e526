//! One scenario on both controllers.

use std::cell::Cell;

use gaugeblock_adapter::{Adapter, HarnessError};
use gaugeblock_compare::observe::Observed;
use gaugeblock_compare::{Divergence, certainly_equal, compare};
use gaugeblock_reference::{RuleCoverage, RunCache};
use gaugeblock_vocabulary::{End, Outcome, Scenario, Undetermined};

use super::comparable::{comparable, named};
use super::fragile::is_fragile;
use super::plan::Plan;
use super::signature::Signature;
use super::statistics::{Statistics, count};

/// A difference between two controllers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The first difference.
    pub divergence: Divergence,
    /// Its signature.
    pub signature: Signature,
}

/// The result of one scenario.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FuzzResult {
    /// No difference.
    Same,
    /// A difference, or a controller that crashed, hung or flooded.
    Differs(Box<Difference>),
    /// The last bit of a transcendental function or of a computed position decides; there is no verdict.
    Fragile,
    /// One side does not support it.
    Unsupported,
    /// The documents leave it open.
    Unspecified,
    /// No verdict, and why: not run, or not understood.
    NotJudged(String),
}

thread_local! {
    /// Buffers of the model for the next run.
    static MODEL: Cell<RunCache> = Cell::default();
}

/// The outcome of a side, with the rule coverage if it is the model.
pub(super) type CoveredOutcome = (Outcome, Option<RuleCoverage>);

/// The outcomes of both sides, with the rule coverage if one is the model.
#[derive(Debug)]
pub(super) struct OutcomePair {
    expected: Outcome,
    found: Outcome,
    coverage: Option<RuleCoverage>,
}

impl Plan<'_> {
    /// Runs a scenario on both sides and compares.
    pub fn judge(&self, scenario: &Scenario, statistics: &mut Statistics) -> FuzzResult {
        let expected = self.run_expected(scenario, statistics);
        let both = expected.and_then(|expected| self.run_tested(scenario, expected, statistics));
        match both {
            Ok(both) => self.compare_pair(scenario, both, statistics),
            Err(result) => result,
        }
    }

    /// Runs a scenario on the reference side: the expected outcome, or the result if it is already known.
    pub(super) fn run_expected(
        &self,
        scenario: &Scenario,
        statistics: &mut Statistics,
    ) -> Result<CoveredOutcome, FuzzResult> {
        statistics.programs += 1;
        if let Some((name, why)) = self.reason_not_run(scenario) {
            let why = format!("{name}: {}", without_place(&why));
            count(&mut statistics.unsupported, &why);
            return Err(FuzzResult::Unsupported);
        }
        self.iut.prefetch(scenario);
        let (expected, coverage) = run_side(self.against, scenario, None);
        let expected = match expected {
            Ok(expected) => expected,
            Err(error) => return Err(self.judge_failure(self.against, &error, statistics)),
        };
        statistics.blocks += u64::try_from(expected.steps.len()).unwrap_or_default();
        if let Some(result) = undetermined_result(self.against, &expected, statistics) {
            return Err(result);
        }
        Ok((expected, coverage))
    }

    /// Runs a scenario on the side under test: both outcomes, or the result if it is already known.
    pub(super) fn run_tested(
        &self,
        scenario: &Scenario,
        (expected, coverage): CoveredOutcome,
        statistics: &mut Statistics,
    ) -> Result<OutcomePair, FuzzResult> {
        let (found, other) = run_side(self.iut, scenario, Some(&expected));
        let found = match found {
            Ok(found) => found,
            Err(HarnessError::TimedOut { .. } | HarnessError::Flooded { .. })
                if matches!(expected.end, End::BudgetExhausted { .. }) =>
            {
                let why = format!("{}: no end, here as there", controller_name(self.iut));
                count(&mut statistics.not_judged, &why);
                return Err(FuzzResult::NotJudged(why));
            }
            Err(error) => return Err(self.judge_failure(self.iut, &error, statistics)),
        };
        if let Some(result) = undetermined_result(self.iut, &found, statistics) {
            return Err(result);
        }
        Ok(OutcomePair { expected, found, coverage: coverage.or(other) })
    }

    /// Compares the outcomes of both sides.
    pub(super) fn compare_pair(
        &self,
        scenario: &Scenario,
        both: OutcomePair,
        statistics: &mut Statistics,
    ) -> FuzzResult {
        let OutcomePair { expected, found, coverage } = both;
        statistics.count(scenario, &expected);
        if let Some(coverage) = &coverage {
            statistics.reached(coverage);
        }
        match self.divergence(scenario, expected, found) {
            None => FuzzResult::Same,
            Some(_) if coverage.is_some() && is_fragile(scenario) => {
                statistics.fragile += 1;
                FuzzResult::Fragile
            }
            Some(divergence) => match self.void_refusal(scenario, &divergence) {
                Some(rule) => {
                    let why = format!("edition: its documents do not have {rule}");
                    count(&mut statistics.unsupported, &why);
                    FuzzResult::Unsupported
                }
                None => differs(divergence, statistics),
            },
        }
    }

    /// The first difference between two outcomes of a scenario, of what both sides show.
    pub(super) fn divergence(
        &self,
        scenario: &Scenario,
        expected: Outcome,
        found: Outcome,
    ) -> Option<Divergence> {
        let (expected, found) = comparable(expected, found);
        let show_pins = |side: &dyn Adapter| !side.capabilities().pins.is_empty();
        if certainly_equal(&expected, &found, show_pins(self.iut) && show_pins(self.against)) {
            return None;
        }
        let observables = self.iut.observables(scenario).and(&self.against.observables(scenario));
        let comparison = compare(&Observed::of(&expected), &Observed::of(&found), &observables);
        comparison.divergence.map(|divergence| named(divergence, &expected, &found))
    }

    /// A controller that crashed, hung or flooded is a finding; one that was not understood is not judged.
    fn judge_failure(
        &self,
        side: &dyn Adapter,
        error: &HarnessError,
        statistics: &mut Statistics,
    ) -> FuzzResult {
        let what = match error {
            HarnessError::Crashed { .. } => "crash",
            HarnessError::TimedOut { .. } => "time-out",
            HarnessError::Flooded { .. } => "flood",
            HarnessError::NotRun(_)
            | HarnessError::Absent(_)
            | HarnessError::Unreadable { .. }
            | HarnessError::UnknownMessage(_)
            | HarnessError::ObservationDisturbs { .. } => {
                let line = error.to_string();
                let short: String =
                    line.lines().next().unwrap_or_default().chars().take(100).collect();
                count(&mut statistics.not_judged, &format!("{}: {short}", controller_name(side)));
                return FuzzResult::NotJudged(format!("{}: {error}", controller_name(side)));
            }
        };
        let of = |other: bool| if other { error.to_string() } else { "an end".to_owned() };
        let is_iut = controller_name(side) == controller_name(self.iut);
        let divergence = Divergence {
            block: None,
            field: what.to_owned(),
            expected: of(!is_iut),
            found: of(is_iut),
        };
        differs(divergence, statistics)
    }
}

fn differs(divergence: Divergence, statistics: &mut Statistics) -> FuzzResult {
    statistics.diverging += 1;
    let signature = Signature::of(&divergence);
    FuzzResult::Differs(Box::new(Difference { divergence, signature }))
}

/// A reason without the place that it names at its end, such as `(M0 at main.ngc:3)`: generated programs are counted
/// by reason.
fn without_place(why: &str) -> &str {
    let place = why.rsplit_once(" (").filter(|(_, place)| place.contains(" at "));
    place.map_or(why, |(reason, _)| reason)
}

fn controller_name(side: &dyn Adapter) -> &str {
    &side.capabilities().name
}

/// Runs a scenario on one side. The other side's outcome is the expected one.
fn run_side(
    side: &dyn Adapter,
    scenario: &Scenario,
    expected: Option<&Outcome>,
) -> (Result<Outcome, HarnessError>, Option<RuleCoverage>) {
    if controller_name(side) == "reference" {
        let mut cache = MODEL.take();
        let (outcome, coverage) = gaugeblock_reference::run_with(&mut cache, scenario);
        MODEL.set(cache);
        return (Ok(outcome), Some(coverage));
    }
    let outcome = match expected {
        Some(expected) => side.run_expecting(scenario, &expected),
        None => side.run(scenario),
    };
    (outcome, None)
}

/// The result if a run is unsupported, or if the documents leave it open.
fn undetermined_result(
    side: &dyn Adapter,
    outcome: &Outcome,
    statistics: &mut Statistics,
) -> Option<FuzzResult> {
    Some(match outcome.end.undetermined()? {
        Undetermined::Unsupported(what) => {
            count(&mut statistics.unsupported, &format!("{}: {what}", controller_name(side)));
            FuzzResult::Unsupported
        }
        Undetermined::Unspecified(why) => {
            count(&mut statistics.unspecified, why);
            FuzzResult::Unspecified
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn programs_are_counted_by_reason_wherever_the_reason_is() {
        for (why, reason) in [
            ("pauses do not pause (M0 at main.ngc:3)", "pauses do not pause"),
            ("no operator actions (pause, resume)", "no operator actions (pause, resume)"),
            ("no probe", "no probe"),
        ] {
            assert_eq!(without_place(why), reason);
        }
    }
}
