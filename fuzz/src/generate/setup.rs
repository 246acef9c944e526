//! Machines, benches and operators.

use gaugeblock_trace::scenario::{
    Action, Bench, Folder, InputChange, Machine, OperatorEvent, OrientAnswer, ProbeContact,
    Scenario, Tool, ToolChange, UserProgram, When,
};
use gaugeblock_trace::{Axis, Block, ControllerMode, LengthUnit, Position, Program};

use super::dice::Dice;

/// Which machines, benches and operators a scenario may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setups {
    /// The default machine, nothing outside.
    Plain,
    /// What LinuxCNC's stand-alone interpreter can be: six axes, no limits, stored lengths in inches, nothing outside.
    StandAlone,
    /// Any machine and bench, nobody at the panel.
    Any,
    /// Any machine and bench, and a person at the panel.
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
        scenario.bench = bench(dice);
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
        stored(dice, &mut machine);
    }
    machine
}

/// A tool table and stored parameters.
fn stored(dice: &mut Dice<'_>, machine: &mut Machine) {
    for number in 1..=dice.range(0, 4) {
        let number = number + 10 * dice.below(2);
        let offset = Position {
            z: quarter(dice),
            x: if dice.chance(20) { quarter(dice) } else { 0.0 },
            ..Position::default()
        };
        let tool =
            Tool { number, pocket: None, offset, diameter: quarter(dice), ..Tool::default() };
        machine.tools.push(tool);
    }
    if dice.chance(40) {
        let system = dice.below(9);
        machine.parameters.0.insert(5221 + 20 * system, quarter(dice));
        machine.parameters.0.insert(5223 + 20 * system, -quarter(dice));
        machine.parameters.0.insert(5220, f64::from(system + 1));
    }
    if dice.chance(10) {
        machine.parameters.0.insert(*dice.pick(&[31, 500, 5161, 5181]), quarter(dice));
    }
}

/// A number that every unit and every printed form holds exactly.
fn quarter(dice: &mut Dice<'_>) -> f64 {
    f64::from(dice.below(40)) / 4.0
}

fn bench(dice: &mut Dice<'_>) -> Bench {
    let mut bench = Bench::default();
    if dice.chance(50) {
        bench
            .wires
            .insert(dice.below(3).to_string(), u16::try_from(dice.below(3)).unwrap_or_default());
    }
    let mut time = 0.0;
    for _ in 0..dice.below(4) {
        time += quarter(dice);
        let (input, value) = match dice.below(3) {
            0 => (format!("analog_in[{}]", dice.below(3)), quarter(dice)),
            _ => (format!("digital_in[{}]", dice.below(3)), f64::from(dice.below(2))),
        };
        bench.inputs.push(InputChange { time, input, value });
    }
    if dice.chance(30) {
        let answers = [
            OrientAnswer::After(0.0),
            OrientAnswer::After(1.5),
            OrientAnswer::Never,
            OrientAnswer::Fault(3),
        ];
        bench.orient.push(*dice.pick(&answers));
    }
    if dice.chance(30) {
        bench.probe = Some(*dice.pick(&[ProbeContact::AtTarget, ProbeContact::Never]));
    }
    if dice.chance(20) {
        bench.tool_change_time = quarter(dice);
    }
    for _ in 0..dice.below(3) {
        let file = format!("M{}", dice.range(100, 105));
        if bench.user_programs.iter().all(|program| program.file != file) {
            let folder =
                *dice.pick(&[Folder::ProgramPrefix, Folder::ProgramPrefix, Folder::SearchPath]);
            let duration = quarter(dice);
            bench.user_programs.push(UserProgram {
                file,
                folder,
                duration,
                ..UserProgram::default()
            });
        }
    }
    bench
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
    ];
    let mut events: Vec<OperatorEvent> = (0..dice.below(4))
        .map(|_| {
            let block = Block::new(Program::MAIN, dice.range(1, 20));
            let when = When { block, execution: 1, offset: quarter(dice) };
            OperatorEvent { when, action: dice.pick(&actions).clone() }
        })
        .collect();
    events.sort_by_key(|event| event.when.block.line);
    events
}
