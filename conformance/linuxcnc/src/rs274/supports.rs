//! Which scenarios the controller can run.

use gaugeblock_vocabulary::scenario::{Environment, Start};
use gaugeblock_vocabulary::{Axis, Language, LengthUnit, Machine, Program, Scenario};

use crate::instrumentation::host::is_ini_name;
use crate::instrumentation::source::{LAST_PARAMETER, Source, is_sub_file};
use crate::instrumentation::workspace::{INI, PARAMETERS, TOOLS};

/// The environment that answers as this controller does.
const OWN_ENVIRONMENT: &str = "stand-alone rs274";

/// Axes that it has, whatever the machine.
pub(super) const AXES: [Axis; 6] = [Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::B, Axis::C];

/// Whether the controller can run a scenario.
///
/// # Errors
/// The reason why not.
pub(super) fn supports(scenario: &Scenario) -> Result<(), String> {
    program(&scenario.program)?;
    machine(&scenario.machine)?;
    stored_lengths(scenario)?;
    if !scenario.operator.is_empty() {
        return Err("no operator actions (pause, resume, abort, overrides)".to_owned());
    }
    let own = scenario.environment.name.as_deref() == Some(OWN_ENVIRONMENT);
    if let Some((block, code)) = Source::new(&scenario.program).pause().filter(|_| !own) {
        return Err(format!("programmed pauses do not pause (M{code} at {block})"));
    }
    if scenario.environment != Environment::default() && !own {
        return Err("inputs and external signals cannot be varied".to_owned());
    }
    Ok(())
}

/// Codes that store lengths.
const STORING: &[&str] = &["g10", "g28.1", "g30.1", "g52", "g92"];

/// Parameters that are stored lengths are inches here, whatever the machine's unit is: where the program sets one, or
/// lets a code set it and reads it, it does something else.
fn stored_lengths(scenario: &Scenario) -> Result<(), String> {
    let inch = scenario.machine.length_unit == LengthUnit::Inch;
    let source = Source::new(&scenario.program);
    let parameters = source.parameters();
    let is_set = parameters.set.iter().copied().any(is_linear)
        || parameters.numbered.iter().copied().any(is_linear) && source.has_code(STORING);
    if !inch && is_set {
        return Err("lengths that are stored are always in inches".to_owned());
    }
    Ok(())
}

/// Whether a stored parameter is a length along X, Y, Z, U, V or W: of the points of G28 and G30, the offset of G92,
/// or a coordinate system.
pub(super) fn is_linear(number: u32) -> bool {
    let first = match number {
        5161..=5169 => 5161,
        5181..=5189 => 5181,
        5211..=5219 => 5211,
        5221..=5390 => number - (number - 5221) % 20,
        _ => return false,
    };
    matches!(number - first, 0..=2 | 6..=8)
}

fn program(program: &Program) -> Result<(), String> {
    if program.language != Language::Rs274 {
        return Err(format!("the language {} is not supported", program.language));
    }
    if program.start == Start::Mdi {
        return Err("O-words do not work in MDI".to_owned());
    }
    let own = [Program::MAIN, INI, TOOLS, PARAMETERS];
    for name in program.files.keys() {
        if !is_sub_file(name) || own.contains(&name.as_str()) {
            return Err(format!("{name:?} is not a valid file name of a sub"));
        }
    }
    let source = Source::new(program);
    if let Some(block) = source.reaches_host() {
        return Err(format!(
            "{block} would reach beyond the program's files: a log, a sub or Python of the host"
        ));
    }
    match source.shows_open_name() {
        Some(_) => Err("a message that ends within a name prints whatever is in memory".to_owned()),
        None => Ok(()),
    }
}

fn machine(machine: &Machine) -> Result<(), String> {
    if machine.axes != AXES {
        return Err("no other axes than X Y Z A B C".to_owned());
    }
    if !machine.limits.is_empty() {
        return Err("no axis limits".to_owned());
    }
    if machine.random_tool_changer {
        return Err("no random tool changer".to_owned());
    }
    if !(1..=8).contains(&machine.spindles) {
        return Err("no other number of spindles than 1 to 8".to_owned());
    }
    if let Some(number) =
        machine.parameters.0.keys().find(|number| !(1..=LAST_PARAMETER).contains(number))
    {
        return Err(format!("#{number} cannot be stored"));
    }
    let is_length = |number: &u32| (5161..=5390).contains(number) && *number != 5220;
    let stores_lengths = !machine.tools.is_empty() || machine.parameters.0.keys().any(is_length);
    if stores_lengths && machine.length_unit != LengthUnit::Inch {
        return Err("lengths that are stored are always in inches".to_owned());
    }
    if let Some(name) = machine.ini.keys().find(|name| !is_ini_name(name)) {
        return Err(format!("{name:?} is not of the form [SECTION]NAME"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_stored_and_angles_are_not() {
        for (number, expected) in [
            (5160, false),
            (5161, true),
            (5164, false),
            (5210, false),
            (5211, true),
            (5220, false),
            (5223, true),
            (5224, false),
            (5230, false),
            (5241, true),
            (5390, false),
            (5399, false),
        ] {
            assert_eq!(is_linear(number), expected, "#{number}");
        }
    }
}
