//! Repeated runs: a case that breaks its controller is run again on a fresh one, and a sample of all cases runs twice.

use gaugeblock_adapter::{Adapter, Expected, HarnessError};
use gaugeblock_compare::compare;
use gaugeblock_compare::observe::Observed;
use gaugeblock_vocabulary::{Outcome, Scenario};
use sha2::{Digest as _, Sha256};

use super::verdict::{Cause, NotJudgedReason};

/// The percentage of cases that are run twice. A hash of the names selects them, so that shards and resumed runs
/// select the same ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RepeatSampling(pub u8);

impl Default for RepeatSampling {
    fn default() -> Self {
        Self(1)
    }
}

impl RepeatSampling {
    /// Whether a case is run twice.
    pub fn includes(self, rule: &str, case: &str) -> bool {
        let digest = Sha256::digest(format!("{rule} / {case}"));
        let number =
            digest.iter().take(8).fold(0_u64, |number, byte| number << 8 | u64::from(*byte));
        number % 100 < u64::from(self.0)
    }
}

/// Whether two outcomes are the same. A number that is not a number is the same as itself.
pub(super) fn is_identical(one: &Outcome, other: &Outcome) -> bool {
    one == other || one.to_text() == other.to_text()
}

/// The outcome of a case.
pub(super) struct RunAttempt {
    pub(super) found: Outcome,
    /// The failure in a session in which other programs had run. `found` is then the outcome in fresh sessions.
    pub(super) leaked_failure: Option<String>,
}

/// What runs in fresh sessions say of a divergence.
pub(super) enum Confirmation {
    /// The controller does the same.
    Same,
    /// It does something else, without a difference in what is compared.
    Alone(Outcome),
    /// It does something else, each time, and the same as before in a session in which other programs had run.
    Leaked(Outcome),
}

/// Runs of one scenario on one controller.
#[derive(Clone, Copy)]
pub(super) struct RunAttempts<'a> {
    pub(super) controller: &'a dyn Adapter,
    pub(super) scenario: &'a Scenario,
}

impl RunAttempts<'_> {
    /// Runs the scenario, whose specified outcome is `expected` if it is known. With `twice` a second run has to give
    /// the same.
    pub(super) fn run(
        self,
        expected: Option<&Expected<'_>>,
        twice: bool,
    ) -> Result<RunAttempt, NotJudgedReason> {
        let run = match expected {
            Some(expected) => self.controller.run_expecting(self.scenario, expected),
            None => self.controller.run(self.scenario),
        };
        let found = match run {
            Ok(found) => found,
            Err(error) if may_be_leaked(&error) => return self.retry_failed(&error),
            Err(error) => return Err(NotJudgedReason::from(&error)),
        };
        if twice {
            self.check_repeatable(&found)?;
        }
        Ok(RunAttempt { found, leaked_failure: None })
    }

    /// Runs the scenario on a fresh controller.
    pub(super) fn run_fresh(self) -> Result<Outcome, HarnessError> {
        let fresh = self.controller.run_fresh(self.scenario);
        fresh.unwrap_or_else(|| self.controller.run(self.scenario))
    }

    /// Runs a scenario that diverges again, in two fresh sessions. If those differ from `found`, it is run once more in
    /// the used session: what comes and goes is not judged, and what only a used session has is leaked state.
    pub(super) fn confirm(self, found: &Outcome) -> Result<Confirmation, NotJudgedReason> {
        let Some(fresh) = self.controller.run_fresh(self.scenario) else {
            return Ok(Confirmation::Same);
        };
        let fresh = match fresh {
            Ok(fresh) => fresh,
            Err(error) if may_be_leaked(&error) => {
                let why = format!("first it ended, then on a new controller: {error}");
                return Err(NotJudgedReason::new(Cause::Nondeterministic, why));
            }
            Err(_) => return Ok(Confirmation::Same),
        };
        if is_identical(&fresh, found) {
            return Ok(Confirmation::Same);
        }
        let second = match self.run_fresh() {
            Ok(second) => self.first_difference(&fresh, &second),
            Err(error) => Some(format!("first it ended, then {error}")),
        };
        if let Some(difference) = second {
            let why = format!("twice on a new controller: {difference}");
            return Err(NotJudgedReason::new(Cause::Nondeterministic, why));
        }
        let Some(difference) = self.first_difference(found, &fresh) else {
            return Ok(Confirmation::Alone(fresh));
        };
        let again = self.controller.run(self.scenario);
        if again.is_ok_and(|again| self.first_difference(found, &again).is_none()) {
            return Ok(Confirmation::Leaked(fresh));
        }
        let why = format!(
            "it differs once, and not when it is run again, alone or after other programs: {difference}"
        );
        Err(NotJudgedReason::new(Cause::Nondeterministic, why))
    }

    /// The first difference between two outcomes of the scenario.
    pub(super) fn first_difference(self, first: &Outcome, second: &Outcome) -> Option<String> {
        let mut observables = self.controller.observables(self.scenario);
        if observables.pin_period > 0.0 {
            // One run may sample a short pulse that the other one misses.
            observables.pins.clear();
        }
        let comparison = compare(&Observed::of(first), &Observed::of(second), &observables);
        let difference = comparison.divergence?;
        let place = difference.block.map(|block| format!("{block}: ")).unwrap_or_default();
        let (first, second) = (difference.expected, difference.found);
        Some(format!("{place}{}: first {first}, then {second}", difference.field))
    }

    /// Runs a failed scenario again in fresh sessions. A failure there is the case's own. If none fails, an earlier
    /// program left something; if only some do, the controller is nondeterministic.
    fn retry_failed(self, error: &HarnessError) -> Result<RunAttempt, NotJudgedReason> {
        let fresh = self.controller.run_fresh(self.scenario);
        let is_always_new = fresh.is_none();
        let first = match fresh.unwrap_or_else(|| self.controller.run(self.scenario)) {
            Ok(_) if is_always_new => return Err(nondeterministic(error)),
            Ok(first) => first,
            Err(again) => return Err(NotJudgedReason::from(&again)),
        };
        match self.run_fresh() {
            Ok(second) if self.first_difference(&first, &second).is_none() => {
                Ok(RunAttempt { found: first, leaked_failure: Some(error.to_string()) })
            }
            Ok(_) => Err(nondeterministic(error)),
            Err(again) => Err(nondeterministic(&again)),
        }
    }

    fn check_repeatable(self, first: &Outcome) -> Result<(), NotJudgedReason> {
        let difference = match self.controller.run(self.scenario) {
            Ok(second) => self.first_difference(first, &second),
            Err(error) => Some(format!("first it ended, then {error}")),
        };
        let Some(difference) = difference else { return Ok(()) };
        let is_alone_the_same =
            self.run_fresh().is_ok_and(|alone| self.first_difference(first, &alone).is_none());
        let why = if is_alone_the_same {
            "on a new controller as at first: it keeps something across reset, or it is chance"
        } else {
            "on a new controller differently, too"
        };
        Err(NotJudgedReason::new(
            Cause::Nondeterministic,
            format!("run twice: {difference}; {why}"),
        ))
    }
}

/// Whether state of an earlier program may have caused the failure.
fn may_be_leaked(error: &HarnessError) -> bool {
    use HarnessError::{Crashed, TimedOut, Unreadable};
    matches!(error, Crashed { .. } | TimedOut { .. } | Unreadable { .. })
}

fn nondeterministic(error: &HarnessError) -> NotJudgedReason {
    let why = format!("{error}; and not so when it was run again alone");
    NotJudgedReason::new(Cause::Nondeterministic, why)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sampling_selects_about_the_requested_percentage() {
        let chosen = |twice: u8| {
            (0..10_000).filter(|n| RepeatSampling(twice).includes("a.rule", &n.to_string())).count()
        };
        assert_eq!((chosen(0), chosen(100)), (0, 10_000));
        assert!((50..200).contains(&chosen(1)), "{}", chosen(1));
    }
}
