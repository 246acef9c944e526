//! Which scenarios the controller can run.

use gaugeblock_vocabulary::scenario::{Environment, Start};
use gaugeblock_vocabulary::{Axis, Language, LengthUnit, Machine, Program, Scenario};

use crate::setup::{Motion, Setup};
use crate::stored::Stored;
use crate::words::{Words, check_sendable};

/// The environment that answers as a scenario says, and as any machine does where it says nothing.
const USUAL: &str = "whole controller";

/// Longest dwell of a program with motion, seconds.
const DWELL_MAX_S: f64 = 60.0;

/// Whether the controller can run a scenario.
///
/// # Errors
/// The reason why not.
pub(crate) fn supports(scenario: &Scenario, setup: &Setup) -> Result<(), String> {
    if !scenario.operator.is_empty() {
        return Err("no operator actions (pause, resume, abort, overrides)".to_owned());
    }
    let Environment { name, .. } = &scenario.environment;
    let expected = Environment { name: name.clone(), ..Environment::default() };
    if name.as_deref().is_some_and(|name| name != USUAL) || scenario.environment != expected {
        return Err("inputs, probe and external signals cannot be varied".to_owned());
    }
    machine(&scenario.machine)?;
    program(&scenario.program, setup)
}

/// Checks a program that changes offsets which the controller keeps over a reset: G92 and tool length. They must be
/// zero at the start, so that the adapter can restore them. G92 also writes the EEPROM.
///
/// # Errors
/// The reason why not.
pub(crate) fn supports_kept_offsets(
    program: &Program,
    setup: &Setup,
    stored: &Stored,
) -> Result<(), String> {
    let blocks: Vec<Words> = program.language.lines(&program.main).map(Words::of).collect();
    if blocks.iter().any(Words::changes_tool_offset) && !stored.has_zero_tool_offset() {
        return Err(
            "a tool length offset is set that could not be restored; cancel it with G49".to_owned()
        );
    }
    if !blocks.iter().any(Words::changes_local_offset) {
        return Ok(());
    }
    if !setup.eeprom {
        return Err("G92 writes the EEPROM of grblHAL; permit it with the option `eeprom=restore`"
            .to_owned());
    }
    if !stored.has_zero_local_offset() {
        return Err(
            "a G92 offset is stored that could not be restored; cancel it with G92.1".to_owned()
        );
    }
    Ok(())
}

/// Checks a program for a controller that reads a negative M number as M0.
///
/// # Errors
/// The reason why not.
pub(crate) fn supports_negative_codes(program: &Program, setup: &Setup) -> Result<(), String> {
    let mut blocks = program.language.lines(&program.main).map(Words::of);
    let is_negative = |block: Words| block.numbers('M').any(|number| number < 0.0);
    if setup.motion == Motion::Checked && blocks.any(is_negative) {
        return Err("a negative M number can be M0, at which check mode does not pause".to_owned());
    }
    Ok(())
}

/// Checks a program for a controller that has scaling and macros, which its documents name and do not describe.
///
/// # Errors
/// The reason why not.
pub(crate) fn supports_named_codes(program: &Program) -> Result<(), String> {
    let mut blocks = program.language.lines(&program.main).map(Words::of);
    if blocks.any(|block| block.has('G', &[500, 510, 650, 660, 670])) {
        return Err("its documents name scaling and macros, and do not describe them".to_owned());
    }
    Ok(())
}

fn machine(machine: &Machine) -> Result<(), String> {
    let plain = Machine {
        // What a program needs of these follows from its codes.
        axes: machine.axes.clone(),
        digital_io: machine.digital_io,
        analog_io: machine.analog_io,
        fanuc_subs: machine.fanuc_subs,
        ..Machine::default()
    };
    let has_axis = |axis: &Axis| machine.axes.contains(axis);
    let reason = if machine.length_unit == LengthUnit::Inch {
        "the machine's own length unit is the millimetre"
    } else if ![Axis::X, Axis::Y, Axis::Z].iter().all(has_axis) {
        "no machine without X, Y and Z"
    } else if !machine.limits.is_empty() {
        "no axis limits: they are settings of the machine"
    } else if !machine.tools.is_empty() {
        "no tool table can be set up"
    } else if !machine.parameters.0.is_empty() {
        "no stored parameters can be set up"
    } else if !machine.ini.is_empty() {
        "no INI file"
    } else if machine.spindles != 1 {
        "no other number of spindles than 1"
    } else if *machine != plain {
        "the tool changer and the spindle cannot be configured"
    } else {
        return Ok(());
    };
    Err(reason.to_owned())
}

fn program(program: &Program, setup: &Setup) -> Result<(), String> {
    if program.language != Language::Rs274 {
        return Err(format!("the language {} is not supported", program.language));
    }
    if program.start == Start::Mdi {
        return Err("it has no manual data input; it reads one stream of blocks".to_owned());
    }
    if !program.files.is_empty() {
        return Err("no subroutine files".to_owned());
    }
    for line in program.language.lines(&program.main) {
        check_sendable(line)?;
        if line.trim_start().starts_with('%') {
            return Err("no percent sign: the documents do not have it".to_owned());
        }
        if program.block_delete && line.trim_start().starts_with('/') {
            return Err("no block delete switch".to_owned());
        }
        block(&Words::of(line), setup)?;
    }
    Ok(())
}

fn block(words: &Words, setup: &Setup) -> Result<(), String> {
    if words.writes_coordinate_system() && !setup.eeprom {
        return Err("G10 writes the EEPROM; permit it with the option `eeprom=restore`".to_owned());
    }
    if words.has_computed_code {
        return Err("a code that is computed or too large could write the EEPROM".to_owned());
    }
    if words.writes_reference_point() {
        return Err("G28.1 and G30.1 write the EEPROM, and only motion could restore it".to_owned());
    }
    match setup.motion {
        Motion::Checked if words.may_pause() => {
            Err("check mode does not pause at M0 and M60".to_owned())
        }
        Motion::Checked if words.has('G', &[382, 383, 384, 385]) => {
            Err("check mode does not probe".to_owned())
        }
        Motion::Checked => Ok(()),
        Motion::Real if words.has('G', &[280, 300, 530]) => {
            Err("machine coordinates are those of the machine, not of the scenario".to_owned())
        }
        Motion::Real if words.has('G', &[382, 383, 384, 385]) => {
            Err("the probe cannot be varied".to_owned())
        }
        Motion::Real if words.has_more => {
            Err("with motion, only blocks of plain words and numbers are sent".to_owned())
        }
        Motion::Real if words.dwell_seconds() > DWELL_MAX_S => {
            Err(format!("with motion, no dwell of more than {DWELL_MAX_S} seconds"))
        }
        Motion::Real => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use gaugeblock_vocabulary::scenario::{Action, OperatorEvent, RunPoint, Tool};
    use gaugeblock_vocabulary::{BlockLocation, Indexed};

    use super::*;

    fn setup(text: &str) -> Setup {
        Setup::read(&format!("/dev/null?{text}")).expect("a setup")
    }

    fn refused(scenario: &Scenario, expect: &str) {
        let found = supports(scenario, &setup(""));
        assert!(found.as_ref().is_err_and(|why| why.contains(expect)), "{expect}: {found:?}");
    }

    #[test]
    fn scenario_that_cannot_be_set_up_is_refused_with_a_reason() {
        let plain = Scenario::of("g0 x1\nm2\n");
        assert_eq!(supports(&plain, &setup("")), Ok(()));
        let of = |change: fn(&mut Scenario)| {
            let mut scenario = plain.clone();
            change(&mut scenario);
            scenario
        };
        refused(&of(|s| s.machine.length_unit = LengthUnit::Inch), "millimetre");
        refused(&of(|s| s.machine.tools.push(Tool::default())), "tool table");
        refused(&of(|s| s.machine.parameters = Indexed::one(31, 1.0)), "stored parameters");
        refused(&of(|s| s.machine.spindles = 2), "spindles");
        refused(&of(|s| s.machine.axes = vec![Axis::X, Axis::Z]), "without X, Y and Z");
        refused(&of(|s| s.program.start = Start::Mdi), "manual data input");
        refused(&of(|s| s.environment.tool_change_time = 1.0), "external signals");
        refused(&of(|s| s.environment.name = Some("stand-alone rs274".to_owned())), "external");
        refused(&of(|s| s.program.main = "$H\n".to_owned()), "system command");
        refused(&of(|s| s.program.main = "g28.1\n".to_owned()), "EEPROM");
        refused(&of(|s| s.program.main = "g[10] l2 p1\n".to_owned()), "computed");
        refused(&of(|s| s.program.main = "m0\n".to_owned()), "does not pause");
        refused(&of(|s| s.program.main = "%\ng0 x1\n%\n".to_owned()), "percent sign");
        refused(
            &of(|s| {
                let block = BlockLocation::new(Program::MAIN, 1);
                let when = RunPoint { block, execution: 1, offset: 0.0 };
                s.operator.push(OperatorEvent { when, action: Action::Pause });
            }),
            "operator",
        );
        refused(
            &of(|s| {
                s.program.files.insert("a.ngc".to_owned(), String::new());
            }),
            "files",
        );
    }

    #[test]
    fn eeprom_is_written_only_if_that_is_permitted() {
        let scenario = Scenario::of("g10 l2 p1 x1\nm2\n");
        refused(&scenario, "eeprom=restore");
        assert_eq!(supports(&scenario, &setup("eeprom=restore")), Ok(()));
    }

    #[test]
    fn offset_is_changed_only_if_it_can_be_restored() {
        let program = Scenario::of("g92 x1\nm2\n").program;
        let mut stored = Stored::default();
        let found = |options, stored: &Stored| {
            supports_kept_offsets(&program, &setup(options), stored)
                .map_err(|why| why.contains("eeprom"))
        };
        assert_eq!(found("", &stored), Err(true));
        assert_eq!(found("eeprom=restore", &stored), Ok(()));
        assert!(stored.take("G92", "1.000,0.000,0.000"));
        assert_eq!(found("eeprom=restore", &stored), Err(false));
        let plain = Scenario::of("g0 x1\nm2\n").program;
        assert_eq!(supports_kept_offsets(&plain, &setup(""), &stored), Ok(()));
        let tool = Scenario::of("g43.1 z1\nm2\n").program;
        assert_eq!(supports_kept_offsets(&tool, &setup(""), &stored), Ok(()));
        assert!(stored.take("TLO", "0.000,0.000,2.000"));
        assert!(supports_kept_offsets(&tool, &setup(""), &stored).is_err());
        assert_eq!(supports_kept_offsets(&plain, &setup(""), &stored), Ok(()));
    }

    #[test]
    fn negative_m_number_is_not_sent_in_check_mode() {
        let found = |line: &str, options| {
            supports_negative_codes(&Scenario::of(line).program, &setup(options))
        };
        assert!(found("m-5\n", "").is_err());
        assert_eq!(found("m-5\n", "motion=real"), Ok(()));
        assert_eq!(found("g-1 x1\nm5\n", ""), Ok(()));
    }

    #[test]
    fn codes_that_are_only_named_are_left_out() {
        for (text, runs) in [("g50.00001\n", false), ("g0 x1 g51\n", false), ("g5\ng6.5\n", true)] {
            let scenario = Scenario::of(text);
            assert_eq!(supports_named_codes(&scenario.program).is_ok(), runs, "{text}");
        }
    }

    #[test]
    fn with_motion_only_plain_blocks_are_sent() {
        for line in ["g28", "g53 g0 x1", "g38.2 z-1", "g0 x#1", "g4 p999"] {
            let found = supports(&Scenario::of(format!("{line}\n")), &setup("motion=real"));
            assert!(found.is_err(), "{line}");
        }
        let plain = Scenario::of("g1 f100 x1\ng4 p0.5\nm0\n");
        assert_eq!(supports(&plain, &setup("motion=real")), Ok(()));
    }
}
