//! Stored lengths in inches, which the stand-alone interpreter requires whatever the unit of the machine is.

use gaugeblock_vocabulary::{Axis, LengthUnit, Machine, Scenario, Tool};

use super::supports::{AXES, is_linear};
use crate::instrumentation::source::Source;

/// Millimetres in an inch.
const INCH: f64 = 25.4;

/// Parameters that repeat the offset and the diameter of the loaded tool in the unit of the machine.
const OF_TOOL: std::ops::RangeInclusive<u32> = 5401..=5410;

/// The same scenario on a machine that stores inches and has the axes of the interpreter; `None` if nothing changes.
///
/// # Errors
/// The block whose meaning would change, because it names a parameter that is a stored length.
pub fn in_inches(scenario: &Scenario) -> Result<Option<Scenario>, String> {
    let machine = &scenario.machine;
    let stores = !machine.tools.is_empty() || machine.parameters.0.keys().any(|n| is_linear(*n));
    let is_metric = machine.length_unit == LengthUnit::Millimetre && stores;
    let has_fewer_axes = machine.axes != AXES && machine.axes.iter().all(|a| AXES.contains(a));
    if !is_metric && !has_fewer_axes {
        return Ok(None);
    }
    let mut converted = scenario.clone();
    if has_fewer_axes {
        converted.machine.axes = AXES.to_vec();
    }
    if is_metric {
        let reads = |number: u32| is_linear(number) || OF_TOOL.contains(&number);
        if let Some((block, what)) = Source::new(&scenario.program).names_parameter(reads) {
            return Err(format!("{what} at {block} is a length in the unit of the machine"));
        }
        convert(&mut converted.machine);
    }
    Ok(Some(converted))
}

/// Converts all that a machine stores.
fn convert(machine: &mut Machine) {
    machine.length_unit = LengthUnit::Inch;
    for Tool { offset, diameter, .. } in &mut machine.tools {
        *diameter /= INCH;
        for axis in Axis::ALL.iter().filter(|axis| is_length(**axis)) {
            *offset.get_mut(*axis) /= INCH;
        }
    }
    for (number, value) in machine.parameters.0.iter_mut() {
        if is_linear(*number) {
            *value /= INCH;
        }
    }
    for (axis, limits) in &mut machine.limits {
        let named = Axis::ALL.iter().find(|named| named.to_string() == *axis);
        if named.is_some_and(|axis| is_length(*axis)) {
            for limit in [
                &mut limits.minimum,
                &mut limits.maximum,
                &mut limits.velocity,
                &mut limits.acceleration,
                &mut limits.jerk,
            ] {
                *limit = limit.map(|limit| limit / INCH);
            }
        }
    }
}

fn is_length(axis: Axis) -> bool {
    !matches!(axis, Axis::A | Axis::B | Axis::C)
}

#[cfg(test)]
mod tests {
    use gaugeblock_vocabulary::Position;

    use super::*;

    fn scenario(program: &str) -> Scenario {
        let offset = Position { z: 25.4, a: 3.0, ..Position::default() };
        let tool = Tool { number: 1, offset, diameter: 12.7, ..Tool::default() };
        let mut scenario = Scenario::of(program);
        scenario.machine.tools.push(tool);
        scenario.machine.parameters.0.extend([(31, 5.0), (5221, 50.8), (5224, 7.0)]);
        scenario
    }

    #[test]
    fn stored_lengths_become_inches_and_angles_stay() {
        let converted = in_inches(&scenario("t1 m6\nm2\n")).unwrap().unwrap();
        let Machine { length_unit, tools, parameters, .. } = converted.machine;
        assert_eq!(length_unit, LengthUnit::Inch);
        assert_eq!((tools[0].offset.z, tools[0].offset.a, tools[0].diameter), (1.0, 3.0, 0.5));
        let stored = parameters.0.into_iter().collect::<Vec<_>>();
        assert_eq!(stored, [(31, 5.0), (5221, 2.0), (5224, 7.0)]);
        assert_eq!(in_inches(&Scenario::of("m2\n")), Ok(None));
    }

    #[test]
    fn block_that_names_a_stored_length_is_not_converted() {
        for (program, what) in [
            ("g0 x#5403\n", "#5403 at main.ngc:1"),
            ("g0\n#5221=5\n", "#5221 at main.ngc:2"),
            ("g0 x#[#1+2]\n", "a computed number of a parameter at main.ngc:1"),
        ] {
            let error = in_inches(&scenario(program)).unwrap_err();
            assert!(error.starts_with(what), "{error}");
        }
        assert!(in_inches(&scenario("g0 x#5420 y#5224\n")).is_ok());
    }
}
