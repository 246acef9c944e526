//! Machines, environments and operators.

use gaugeblock_vocabulary::scenario::{
    Action, Environment, Folder, InputChange, Machine, OperatorEvent, OrientAnswer, ProbeContact,
    Scenario, Tool, ToolChange, UserProgram, When,
};
use gaugeblock_vocabulary::{Axis, BlockLocation, ControllerMode, LengthUnit, Program};

use super::dice::Dice;

/// Which machines, environments and operators a scenario may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setups {
    /// The default machine, nothing outside.
    Plain,
    /// What LinuxCNC's stand-alone interpreter can be: six axes, no limits, stored lengths in inches, nothing outside.
    StandAlone,
    /// Any machine and environment, nobody at the panel.
    Any,
    /// Any machine and environment, and a person at the panel.
    Operated,
}

/// A scenario without a program.
pub(super) fn scenario(dice: &mut Dice<'_>, setups: Setups) -> Scenario {
    let mut scenario = Scenario::default();
    if setups == Setups::Plain || dice.chance(25) {
        return scenario;
    }
    let free = matches!(setups, Setups::Any | Setups::Operated);
    scenario.machine = machine(dice, free);
    if free && dice.chance(50) {
        scenario.environment = environment(dice);
    }
    if setups == Setups::Operated {
        scenario.operator = operator(dice);
    }
    scenario
}

fn machine(dice: &mut Dice<'_>, free: bool) -> Machine {
    let mut machine = Machine::default();
    if dice.chance(40) {
        machine.length_unit = LengthUnit::Inch;
    }
    machine.spindles = u8::try_from(*dice.pick(&[1, 1, 1, 2, 3, 8])).unwrap_or(1);
    machine.fanuc_subs = !dice.chance(8);
    if dice.chance(10) {
        machine.orient_offset = f64::from(dice.below(90));
    }
    if free {
        machine.axes = match dice.below(8) {
            0 => vec![Axis::X, Axis::Y, Axis::Z],
            1 => vec![Axis::X, Axis::Z],
            2 | 3 => Axis::ALL.to_vec(),
            _ => machine.axes,
        };
        machine.random_tool_changer = dice.chance(12);
        machine.tool_change = ToolChange {
            at_g30: dice.chance(6),
            quill_up: dice.chance(6),
            with_spindle_on: dice.chance(10),
        };
        if dice.chance(15) {
            machine.digital_io = u16::try_from(dice.range(1, 8)).unwrap_or(4);
            machine.analog_io = machine.digital_io;
        }
    }
    if (free || machine.length_unit == LengthUnit::Inch) && dice.chance(70) {
        stored(dice, free, &mut machine);
    }
    machine
}

/// A tool table and stored parameters.
fn stored(dice: &mut Dice<'_>, free: bool, machine: &mut Machine) {
    // Number 0 is a tool where tools change places, and none elsewhere.
    let first = u32::from(!dice.chance(8));
    for number in first..=dice.range(0, 4) {
        let number = if number == 0 { 0 } else { number + 10 * dice.below(2) };
        let mut tool = Tool { number, diameter: quarter(dice), ..Tool::default() };
        tool.offset.z = quarter(dice);
        if dice.chance(20) {
            tool.offset.x = quarter(dice);
        }
        if free && dice.chance(15) {
            let far = quarter(dice);
            let axis = *dice.pick(&machine.axes);
            *tool.offset.get_mut(axis) = far;
        }
        if free && dice.chance(10) {
            tool.front_angle = quarter(dice);
            tool.back_angle = -quarter(dice);
            tool.orientation = u8::try_from(dice.below(10)).unwrap_or_default();
        }
        machine.tools.push(tool);
    }
    if free && dice.chance(20) {
        pockets(dice, &mut machine.tools);
    }
    if dice.chance(40) {
        let system = dice.below(9);
        machine.parameters.0.insert(5221 + 20 * system, quarter(dice));
        machine.parameters.0.insert(5223 + 20 * system, -quarter(dice));
        machine.parameters.0.insert(5220, f64::from(system + 1));
        let turns = [Axis::X, Axis::Y].iter().all(|axis| machine.axes.contains(axis));
        if turns && dice.chance(15) {
            let turn = f64::from(*dice.pick(&[90, 30, 180]));
            machine.parameters.0.insert(5230 + 20 * system, turn);
        }
    }
    if dice.chance(10) {
        machine.parameters.0.insert(5210, f64::from(dice.below(2)));
        machine.parameters.0.insert(5211 + dice.below(3), quarter(dice));
    }
    if dice.chance(10) {
        let number = *dice.pick(&[31, 500, 5161, 5181, 5163, 5182]);
        machine.parameters.0.insert(number, quarter(dice));
    }
}

/// Pockets that are not the tools' numbers; each is taken once, and one may be that of the spindle.
fn pockets(dice: &mut Dice<'_>, tools: &mut [Tool]) {
    let mut pocket = dice.below(3);
    for tool in tools {
        tool.pocket = Some(pocket);
        pocket += dice.range(1, 3);
    }
}

/// A number that every unit and every printed form holds exactly.
fn quarter(dice: &mut Dice<'_>) -> f64 {
    f64::from(dice.below(40)) / 4.0
}

fn environment(dice: &mut Dice<'_>) -> Environment {
    let mut environment = Environment::default();
    if dice.chance(50) {
        environment
            .wires
            .insert(dice.below(3).to_string(), u16::try_from(dice.below(3)).unwrap_or_default());
    }
    let mut time = 0.0;
    for _ in 0..dice.below(4) {
        time += quarter(dice);
        let (input, value) = match dice.below(12) {
            0 => ("adaptive_feed".to_owned(), f64::from(dice.below(3)) / 2.0),
            1 => ("feed_hold".to_owned(), f64::from(dice.below(2))),
            2..=5 => (format!("analog_in[{}]", dice.below(3)), quarter(dice)),
            _ => (format!("digital_in[{}]", dice.below(3)), f64::from(dice.below(2))),
        };
        environment.inputs.push(InputChange { time, input, value });
    }
    if dice.chance(30) {
        let answers = [
            OrientAnswer::After(0.0),
            OrientAnswer::After(1.5),
            OrientAnswer::Never,
            OrientAnswer::Fault(3),
        ];
        environment.orient.push(*dice.pick(&answers));
    }
    if dice.chance(30) {
        environment.probe = Some(*dice.pick(&[ProbeContact::AtTarget, ProbeContact::Never]));
    }
    if dice.chance(20) {
        environment.tool_change_time = quarter(dice);
        environment.manual_tool_change = dice.chance(30);
    }
    for _ in 0..dice.below(3) {
        let file = format!("M{}", dice.range(100, 105));
        if environment.user_programs.iter().all(|program| program.file != file) {
            let folder =
                *dice.pick(&[Folder::ProgramPrefix, Folder::ProgramPrefix, Folder::SearchPath]);
            let duration = quarter(dice);
            environment.user_programs.push(UserProgram {
                file,
                folder,
                duration,
                executable: !dice.chance(8),
                exit_status: if dice.chance(10) { 3 } else { 0 },
                ..UserProgram::default()
            });
        }
    }
    environment
}

fn operator(dice: &mut Dice<'_>) -> Vec<OperatorEvent> {
    let actions = [
        Action::Pause,
        Action::Resume,
        Action::Resume,
        Action::CycleStart,
        Action::Abort,
        Action::OptionalStop(true),
        Action::FeedOverride(0.5),
        Action::FeedOverride(0.0),
        Action::FeedOverride(1.0),
        Action::SpindleOverride { spindle: 0, factor: 0.0 },
        Action::SpindleOverride { spindle: 0, factor: 0.5 },
        Action::SpindleOverride { spindle: 0, factor: 1.0 },
        Action::Mode(ControllerMode::Manual),
        Action::Mode(ControllerMode::Mdi),
        Action::Mode(ControllerMode::Auto),
        Action::RapidOverride(0.0),
        Action::RapidOverride(0.25),
        Action::RapidOverride(1.0),
        Action::FeedHold(true),
        Action::FeedHold(false),
        Action::Mdi("g0 x5".to_owned()),
        Action::Mdi("g91 g20 m3 s100".to_owned()),
        Action::Mdi("m70 g54 f7".to_owned()),
        Action::Mdi("#31=#<_metric>".to_owned()),
        Action::Mdi("t1 m6 g43".to_owned()),
    ];
    let mut events: Vec<OperatorEvent> = (0..dice.below(4))
        .map(|_| {
            let block = BlockLocation::new(Program::MAIN, dice.range(1, 20));
            let execution = if dice.chance(8) { 2 } else { 1 };
            let when = When { block, execution, offset: quarter(dice) };
            OperatorEvent { when, action: dice.pick(&actions).clone() }
        })
        .collect();
    if dice.chance(3) {
        // A spindle that stands at an override of zero turns once that is turned up.
        for factor in [0.0, 1.0] {
            let block = BlockLocation::new(Program::MAIN, dice.range(1, 20));
            let when = When { block, execution: 1, offset: 0.0 };
            let action = Action::SpindleOverride { spindle: 0, factor };
            events.push(OperatorEvent { when, action });
        }
    }
    events.sort_by_key(|event| event.when.block.line);
    events
}
