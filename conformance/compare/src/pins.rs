//! Values of a pin against those that a controller was seen to give it.

use super::tolerance;
use crate::Capabilities;
use crate::accuracy::{Match, PIN_PERIOD_MAX_S, Resolution};
use crate::observe::PinValue;

/// How the values of a pin compare: exactly, or as far as a controller can have sampled them.
pub fn compare(expected: &[PinValue], seen: &[f64], observables: &Capabilities) -> Match {
    let all: Vec<f64> = expected.iter().map(|at| at.value).collect();
    if tolerance::sequences(&all, seen, Resolution::EXACT) {
        Match::Equal
    } else if matches_samples(expected, seen, observables) {
        Match::Hidden
    } else {
        Match::Different
    }
}

/// Whether a controller can have sampled these values. A value that lasts for less than the sampling period may be
/// missed. An equal value after a missed one is then not seen as a change; the same holds for the value before the run.
pub fn matches_samples(expected: &[PinValue], seen: &[f64], observables: &Capabilities) -> bool {
    let sight = PinSampling {
        resolution: observables.resolution(),
        period: observables.pin_period.min(PIN_PERIOD_MAX_S),
    };
    sight.covers(expected, seen, None, false)
}

/// Whether what was seen may be all that there is to be seen of values whose times are not known.
pub fn may_match_untimed(expected: &[f64], seen: &[f64], observables: &Capabilities) -> bool {
    let brief = expected.iter().map(|value| PinValue { value: *value, lasts: 0.0 });
    matches_samples(&brief.collect::<Vec<_>>(), seen, observables)
}

struct PinSampling {
    resolution: Resolution,
    period: f64,
}

impl PinSampling {
    /// `last` is the value that was seen last, `passed_over` whether one was left out since.
    fn covers(
        &self,
        expected: &[PinValue],
        seen: &[f64],
        last: Option<f64>,
        passed_over: bool,
    ) -> bool {
        let Some((first, rest)) = expected.split_first() else { return seen.is_empty() };
        let is = |value: f64| tolerance::sequences(&[first.value], &[value], self.resolution);
        let is_next = seen.first().is_some_and(|value| is(*value));
        is_next && self.covers(rest, &seen[1..], Some(first.value), false)
            || first.lasts < self.period && self.covers(rest, seen, last, true)
            || passed_over
                && last.is_none_or(is)
                && self.covers(rest, seen, Some(first.value), false)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn observables(pin_period: f64) -> Capabilities {
        Capabilities { pin_period, ..Capabilities::everything("a controller", "1") }
    }

    fn values(values: &[(f64, f64)]) -> Vec<PinValue> {
        values.iter().map(|(value, lasts)| PinValue { value: *value, lasts: *lasts }).collect()
    }

    #[test]
    fn short_pulse_may_be_missed() {
        let pulse = values(&[(1.0, 0.0), (0.0, 1.0), (1.0, 0.0), (0.0, f64::INFINITY)]);
        for seen in [&[1.0, 0.0, 1.0, 0.0][..], &[1.0, 0.0], &[]] {
            assert!(matches_samples(&pulse, seen, &observables(0.01)), "{seen:?}");
        }
        for seen in [&[1.0][..], &[1.0, 0.0, 1.0], &[2.0, 0.0], &[1.0, 0.0, 1.0, 0.0, 1.0]] {
            assert!(!matches_samples(&pulse, seen, &observables(0.01)), "{seen:?}");
        }
    }

    #[test]
    fn lasting_value_must_be_seen() {
        let steps = values(&[(1.0, 0.5), (0.0, 0.0), (2.0, f64::INFINITY)]);
        assert!(matches_samples(&steps, &[1.0, 2.0], &observables(0.01)));
        assert!(!matches_samples(&steps, &[2.0], &observables(0.01)));
        assert!(!matches_samples(&steps, &[1.0], &observables(0.01)));
    }

    #[test]
    fn without_a_sampling_period_short_pulses_must_be_seen() {
        let pulse = values(&[(1.0, 0.0), (0.0, f64::INFINITY)]);
        assert!(matches_samples(&pulse, &[1.0, 0.0], &observables(0.0)));
        assert!(!matches_samples(&pulse, &[], &observables(0.0)));
        assert!(may_match_untimed(&[1.0, 0.0], &[], &observables(0.01)));
        assert!(!may_match_untimed(&[1.0, 0.0], &[2.0], &observables(0.01)));
        assert!(!may_match_untimed(&[1.0, 0.0], &[], &observables(0.0)));
    }
}
