//! What is compared for a controller: what it exposes, without the modes that the edition does not have.

use gaugeblock_adapter::Adapter;
use gaugeblock_compare::Capabilities;
use gaugeblock_suite::Edition;
use gaugeblock_vocabulary::Scenario;

/// Modes, and the G codes that set them.
const MODES: [(&str, &[&str]); 5] = [
    ("arc_distance", &["90.1", "91.1"]),
    ("lathe", &["7", "8"]),
    ("path", &["61", "61.1", "64"]),
    ("retract", &["98", "99"]),
    ("spindle_mode", &["96", "97"]),
];

/// What a controller exposes when it runs this scenario, without the modes that no code of the edition sets: their
/// values are up to the controller.
pub(crate) fn judged_observables(
    controller: &dyn Adapter,
    scenario: &Scenario,
    edition: &Edition,
) -> Capabilities {
    let mut observables = controller.observables(scenario);
    for mode in modes_without_code(edition) {
        observables.fields.remove(mode);
        observables.fields_at_effects.remove(mode);
    }
    observables
}

/// The modes that no code of the edition sets.
fn modes_without_code(edition: &Edition) -> impl Iterator<Item = &'static str> {
    let has = edition.has.as_ref().and_then(|language| language.g.as_ref());
    let is_set =
        move |codes: &[&str]| has.is_none_or(|has| codes.iter().any(|it| has.contains(*it)));
    MODES.into_iter().filter(move |(_, codes)| !is_set(codes)).map(|(mode, _)| mode)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mode_without_a_code_is_not_judged() {
        let suite = gaugeblock_embedded_suite::files().expect("the files");
        let suite = gaugeblock_suite::Suite::read(&suite).expect("the suite");
        let without = |edition: &str| -> Vec<&str> {
            modes_without_code(suite.edition(edition).expect("the edition")).collect()
        };
        assert_eq!(without("grbl-1.1"), ["lathe", "retract", "spindle_mode"]);
        assert_eq!(without("linuxcnc-2.9"), [""; 0]);
    }
}
