//! Programs of which nothing can be said, since the last bit of a number decides.

use gaugeblock_compare::observe::Observed;
use gaugeblock_compare::{Capabilities, certainly_equal, compare};
use gaugeblock_fuzz::generate::ulp_perturbed;
use gaugeblock_reference::Rounding;
use gaugeblock_vocabulary::{Language, Outcome, Scenario};

/// Whether the model's own answer changes when every transcendental result moves by its last bit, or every position
/// that a conversion of units, an offset or a polar word has computed is rounded in another way.
///
/// It runs the scenario up to six times.
pub fn is_fragile(scenario: &Scenario) -> bool {
    // A post-processor has no function, and its rounding is told to the last bit.
    if scenario.program.language == Language::Gpp {
        return false;
    }
    let plain = gaugeblock_reference::run(scenario).0;
    let observables = Capabilities::everything("reference", "");
    let differs = |other: &Outcome| {
        !certainly_equal(&plain, other, true)
            && compare(&Observed::of(&plain), &Observed::of(other), &observables)
                .divergence
                .is_some()
    };
    let perturbed = [true, false].into_iter().filter_map(|up| ulp_perturbed(scenario, up));
    let perturbed = perturbed.map(|other| gaugeblock_reference::run(&other).0);
    let rounded = [Rounding::ToDecimals, Rounding::Up, Rounding::Down];
    let rounded = rounded.map(|rounding| gaugeblock_reference::run_rounded(scenario, rounding).0);
    perturbed.chain(rounded).any(|other| differs(&other))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_hangs_on_the_last_bit_of_a_function_or_of_a_point() {
        let fragile = |program: &str| is_fragile(&Scenario::of(program));
        assert!(!fragile("f100\ng0 x1.1\ng2 x2.2 r3\nm2\n"));
        assert!(fragile("g0 x fix[2*sin[30]]\nm2\n"));
        // The point of the second arc is the one where the first ended, or the one beside it.
        assert!(fragile("f1\ng0 @7 ^48\ng2 ^10 r13\ng2 ^10 r13\nm2\n"));
        assert!(!fragile("f1\ng0 @7 ^48\ng2 ^10 r13\ng2 ^48 r13\nm2\n"));
        // At every angle, also where our numbers make them one point.
        for degrees in 1..360 {
            let again =
                |words: &str| fragile(&format!("f1\ng0 @7 ^[{degrees}+.5]\ng2 {words} r13\nm2\n"));
            assert!(again(&format!("^[{degrees}+.5]")) && again("@7"), "{degrees}");
            assert!(!again(&format!("@7 ^[{degrees}+.5]")), "{degrees}");
        }
    }

    #[test]
    fn a_program_hangs_on_the_last_bit_of_an_offset() {
        let mut scenario = Scenario::of("g0 z-.25\ng54\ng0 z-round[#<_z>]\nm2\n");
        assert!(!is_fragile(&scenario));
        // It begins in G55, which is at -4.25: behind G54 Z is at a half.
        scenario.machine.parameters.0.insert(5220, 2.0);
        scenario.machine.parameters.0.insert(5243, -4.25);
        assert!(is_fragile(&scenario));
    }
}
