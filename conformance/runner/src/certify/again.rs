//! Cases that are run more than once: one that ends its controller is run again alone, and of every hundred one is
//! run twice.

use gaugeblock_adapter::{Adapter, Expected, HarnessError};
use gaugeblock_compare::compare;
use gaugeblock_compare::observe::Observed;
use gaugeblock_vocabulary::{Outcome, Scenario};
use sha2::{Digest as _, Sha256};

use super::verdict::{Cause, NotJudgedReason};

/// How many cases of a hundred are run twice. Which ones follows from their names alone, so that every part of a run,
/// and one that is gone on with, chooses the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RepeatSampling(pub u8);

impl Default for RepeatSampling {
    fn default() -> Self {
        Self(1)
    }
}

impl RepeatSampling {
    /// Whether a case is run twice.
    pub fn chooses(self, rule: &str, case: &str) -> bool {
        let digest = Sha256::digest(format!("{rule} / {case}"));
        let number =
            digest.iter().take(8).fold(0_u64, |number, byte| number << 8 | u64::from(*byte));
        number % 100 < u64::from(self.0)
    }
}

/// What a controller did.
pub(super) struct RunAttempt {
    pub(super) found: Outcome,
    /// How it failed where other programs had run before; this is then what it did alone, twice.
    pub(super) before: Option<String>,
}

/// A controller and what it is to run.
#[derive(Clone, Copy)]
pub(super) struct RunAttempts<'a> {
    pub(super) controller: &'a dyn Adapter,
    pub(super) scenario: &'a Scenario,
}

impl RunAttempts<'_> {
    /// What the controller does, where the documents say `expected`; where `twice` says so, only if it does the same
    /// when it is asked again.
    pub(super) fn outcome(
        self,
        expected: &Expected<'_>,
        twice: bool,
    ) -> Result<RunAttempt, NotJudgedReason> {
        let found = match self.controller.run_expecting(self.scenario, expected) {
            Ok(found) => found,
            Err(error) if is_perhaps_left(&error) => return self.failed(&error),
            Err(error) => return Err(NotJudgedReason::from(&error)),
        };
        if twice {
            self.same_again(&found)?;
        }
        Ok(RunAttempt { found, before: None })
    }

    /// A new controller, or one that is always new.
    pub(super) fn alone(self) -> Result<Outcome, HarnessError> {
        let anew = self.controller.run_fresh(self.scenario);
        anew.unwrap_or_else(|| self.controller.run(self.scenario))
    }

    /// The first difference between two runs of this on the same controller.
    pub(super) fn difference(self, first: &Outcome, second: &Outcome) -> Option<String> {
        let mut observables = self.controller.observables(self.scenario);
        if observables.pin_period > 0.0 {
            // What is too brief to be seen for sure may be seen once and missed once.
            observables.pins.clear();
        }
        let comparison = compare(&Observed::of(first), &Observed::of(second), &observables);
        let difference = comparison.divergence?;
        let place = difference.block.map(|block| format!("{block}: ")).unwrap_or_default();
        let (first, second) = (difference.expected, difference.found);
        Some(format!("{place}{}: first {first}, then {second}", difference.field))
    }

    /// There is no outcome. What fails alone, too, is the case's; what does not was left there by an earlier program
    /// if it never fails alone, and chance otherwise.
    fn failed(self, error: &HarnessError) -> Result<RunAttempt, NotJudgedReason> {
        let anew = self.controller.run_fresh(self.scenario);
        let is_always_new = anew.is_none();
        let first = match anew.unwrap_or_else(|| self.controller.run(self.scenario)) {
            Ok(_) if is_always_new => return Err(by_chance(error)),
            Ok(first) => first,
            Err(again) => return Err(NotJudgedReason::from(&again)),
        };
        match self.alone() {
            Ok(second) if self.difference(&first, &second).is_none() => {
                Ok(RunAttempt { found: first, before: Some(error.to_string()) })
            }
            Ok(_) => Err(by_chance(error)),
            Err(again) => Err(by_chance(&again)),
        }
    }

    fn same_again(self, first: &Outcome) -> Result<(), NotJudgedReason> {
        let difference = match self.controller.run(self.scenario) {
            Ok(second) => self.difference(first, &second),
            Err(error) => Some(format!("first it ended, then {error}")),
        };
        let Some(difference) = difference else { return Ok(()) };
        let is_alone_the_same =
            self.alone().is_ok_and(|alone| self.difference(first, &alone).is_none());
        let why = if is_alone_the_same {
            "on a new controller as at first: it keeps something across reset, or it is chance"
        } else {
            "on a new controller otherwise, too"
        };
        Err(NotJudgedReason::new(
            Cause::Nondeterministic,
            format!("run twice: {difference}; {why}"),
        ))
    }
}

/// Whether an earlier program may have left what did this.
fn is_perhaps_left(error: &HarnessError) -> bool {
    use HarnessError::{Crashed, TimedOut, Unreadable};
    matches!(error, Crashed { .. } | TimedOut { .. } | Unreadable { .. })
}

fn by_chance(error: &HarnessError) -> NotJudgedReason {
    let why = format!("{error}; and not so when it was run again alone");
    NotJudgedReason::new(Cause::Nondeterministic, why)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn about_as_many_are_chosen_as_are_asked_for() {
        let chosen = |twice: u8| {
            (0..10_000).filter(|n| RepeatSampling(twice).chooses("a.rule", &n.to_string())).count()
        };
        assert_eq!((chosen(0), chosen(100)), (0, 10_000));
        assert!((50..200).contains(&chosen(1)), "{}", chosen(1));
    }
}
