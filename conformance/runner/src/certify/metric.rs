//! Cases of a machine in inches, on a machine in millimetres.
//!
//! Cases with stored data name a machine in inches, since LinuxCNC's stand-alone interpreter stores inches. The same
//! program means the same on a machine in millimetres that stores the same lengths.

use gaugeblock_compare::Capabilities;
use gaugeblock_compare::judge::{Finding, judge};
use gaugeblock_compare::observe::Observed;
use gaugeblock_suite::{Case, applies};
use gaugeblock_vocabulary::scenario::ProbeContact;
use gaugeblock_vocabulary::{Axis, LengthUnit, Position, Scenario};

/// Millimetres of an inch.
const INCH_MM: f64 = 25.4;

/// Axes that have a length.
const LINEAR: [Axis; 6] = [Axis::X, Axis::Y, Axis::Z, Axis::U, Axis::V, Axis::W];

/// The first parameters of stored points, of X each: probed point, G28, G30, G92, the nine coordinate systems and the
/// tool offset.
const POINTS: [u32; 14] =
    [5061, 5161, 5181, 5211, 5221, 5241, 5261, 5281, 5301, 5321, 5341, 5361, 5381, 5401];

/// The scenario of a case on a machine in millimetres; `None` if its machine is not one in inches, or if one of its
/// assertions does not hold there.
pub(super) fn on_metric_machine(
    case: &Case,
    scenario: &Scenario,
    edition: &str,
) -> Option<Scenario> {
    if scenario.machine.length_unit != LengthUnit::Inch {
        return None;
    }
    let metric = converted(scenario);
    let outcome = Observed::of(&gaugeblock_reference::run(&metric).0);
    let everything = Capabilities::everything("", "");
    let mut claims =
        case.parsed().into_iter().filter(|claim| applies(claim, &metric.options, edition));
    let holds = claims.all(|claim| judge(&claim, &outcome, &everything) == Finding::Holds);
    holds.then_some(metric)
}

/// The same scenario with all stored lengths in millimetres.
fn converted(scenario: &Scenario) -> Scenario {
    let mut metric = scenario.clone();
    let machine = &mut metric.machine;
    machine.length_unit = LengthUnit::Millimetre;
    for tool in &mut machine.tools {
        tool.offset = lengths(tool.offset);
        tool.diameter *= INCH_MM;
    }
    for (axis, limits) in &mut machine.limits {
        if LINEAR.iter().any(|linear| linear.word() == axis) {
            let all = [
                &mut limits.minimum,
                &mut limits.maximum,
                &mut limits.velocity,
                &mut limits.acceleration,
                &mut limits.jerk,
            ];
            all.into_iter().flatten().for_each(|limit| *limit *= INCH_MM);
        }
    }
    for (number, value) in machine.parameters.0.iter_mut() {
        if is_length(*number) {
            *value *= INCH_MM;
        }
    }
    if let Some(ProbeContact::At(point)) = &mut metric.environment.probe {
        *point = lengths(*point);
    }
    metric
}

/// Whether a stored parameter is a length.
fn is_length(parameter: u32) -> bool {
    let is_linear = |place: usize| LINEAR.iter().any(|axis| axis.place() == place);
    let place = |first: &u32| usize::try_from(parameter.checked_sub(*first)?).ok();
    POINTS.iter().filter_map(place).any(is_linear)
}

fn lengths(point: Position) -> Position {
    let mut metric = point;
    for axis in LINEAR {
        *metric.get_mut(axis) *= INCH_MM;
    }
    metric
}

#[cfg(test)]
mod tests {
    use gaugeblock_suite::Setup;

    use super::*;

    #[test]
    fn stored_lengths_are_converted_and_nothing_else() {
        for (parameter, expected) in [
            (5221, true),
            (5226, false),
            (5227, true),
            (5229, true),
            (5230, false),
            (5220, false),
            (31, false),
        ] {
            assert_eq!(is_length(parameter), expected, "#{parameter}");
        }
        let mut scenario = Scenario::of("m2\n");
        scenario.machine.length_unit = LengthUnit::Inch;
        scenario.machine.parameters.0.extend([(5221, 1.0), (5224, 2.0), (31, 3.0)]);
        let machine = converted(&scenario).machine;
        assert_eq!(machine.length_unit, LengthUnit::Millimetre);
        let stored: Vec<(u32, f64)> = machine.parameters.0.into_iter().collect();
        assert_eq!(stored, [(31, 3.0), (5221, 25.4), (5224, 2.0)]);
    }

    #[test]
    fn assertion_about_the_machine_unit_is_judged_in_inches_only() {
        let case = |assertion: &str| Case {
            name: String::new(),
            why: String::new(),
            program: String::new(),
            assertions: vec![assertion.to_owned()],
            golden: None,
            grid: None,
            beyond: Vec::new(),
            editions: Vec::new(),
            needs: None,
            setup: Setup::default(),
        };
        let mut scenario = Scenario::of("g20\ng28.1\n#31=#5221\nm2\n");
        scenario.machine.length_unit = LengthUnit::Inch;
        scenario.machine.parameters.0.insert(5221, 2.0);
        let has = |assertion: &str| on_metric_machine(&case(assertion), &scenario, "").is_some();
        assert!(has("after 1 g5x_offset = (x2)"));
        assert!(!has("at end #31 = 2"));
    }
}
