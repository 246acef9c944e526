//! Machines, environments and operators.

use gaugeblock_vocabulary::scenario::{
    Action, Environment, Folder, InputChange, Machine, OperatorEvent, OrientAnswer, ProbeContact,
    RunPoint, Scenario, Tool, ToolChange, UserProgram,
};
use gaugeblock_vocabulary::{Axis, BlockLocation, ControllerMode, LengthUnit, Program};

use super::entropy::Entropy;

/// Which machines, environments and operators a scenario may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setups {
    /// The default machine, no environment.
    Plain,
    /// The machines of LinuxCNC's stand-alone interpreter: six axes, no limits, stored lengths in inches, no
    /// environment.
    StandAlone,
    /// Any machine and environment, no operator.
    Any,
    /// Any machine and environment, and an operator.
    Operated,
}

/// A scenario without a program.
pub(super) fn scenario(entropy: &mut Entropy<'_>, setups: Setups) -> Scenario {
    let mut scenario = Scenario::default();
    if setups == Setups::Plain || entropy.chance(25) {
        return scenario;
    }
    let free = matches!(setups, Setups::Any | Setups::Operated);
    scenario.machine = machine(entropy, free);
    if free && entropy.chance(50) {
        scenario.environment = environment(entropy);
    }
    if setups == Setups::Operated {
        scenario.operator = operator(entropy);
    }
    scenario
}

fn machine(entropy: &mut Entropy<'_>, free: bool) -> Machine {
    let mut machine = Machine::default();
    if entropy.chance(40) {
        machine.length_unit = LengthUnit::Inch;
    }
    machine.spindles = u8::try_from(*entropy.pick(&[1, 1, 1, 2, 3, 8])).unwrap_or(1);
    machine.fanuc_subs = !entropy.chance(8);
    if entropy.chance(10) {
        machine.orient_offset = f64::from(entropy.below(90));
    }
    if free {
        machine.axes = match entropy.below(8) {
            0 => vec![Axis::X, Axis::Y, Axis::Z],
            1 => vec![Axis::X, Axis::Z],
            2 | 3 => Axis::ALL.to_vec(),
            _ => machine.axes,
        };
        machine.random_tool_changer = entropy.chance(12);
        machine.tool_change = ToolChange {
            at_g30: entropy.chance(6),
            quill_up: entropy.chance(6),
            with_spindle_on: entropy.chance(10),
        };
        if entropy.chance(15) {
            machine.digital_io = u16::try_from(entropy.range(1, 8)).unwrap_or(4);
            machine.analog_io = machine.digital_io;
        }
    }
    if (free || machine.length_unit == LengthUnit::Inch) && entropy.chance(70) {
        stored(entropy, free, &mut machine);
    }
    machine
}

/// A tool table and stored parameters.
fn stored(entropy: &mut Entropy<'_>, free: bool, machine: &mut Machine) {
    // Number 0 is a tool where tools change places, and none elsewhere.
    let first = u32::from(!entropy.chance(8));
    for number in first..=entropy.range(0, 4) {
        let number = if number == 0 { 0 } else { number + 10 * entropy.below(2) };
        let mut tool = Tool { number, diameter: quarter(entropy), ..Tool::default() };
        tool.offset.z = quarter(entropy);
        if entropy.chance(20) {
            tool.offset.x = quarter(entropy);
        }
        if free && entropy.chance(15) {
            let far = quarter(entropy);
            let axis = *entropy.pick(&machine.axes);
            *tool.offset.get_mut(axis) = far;
        }
        if free && entropy.chance(10) {
            tool.front_angle = quarter(entropy);
            tool.back_angle = -quarter(entropy);
            tool.orientation = u8::try_from(entropy.below(10)).unwrap_or_default();
        }
        machine.tools.push(tool);
    }
    if free && entropy.chance(20) {
        pockets(entropy, &mut machine.tools);
    }
    if entropy.chance(40) {
        let system = entropy.below(9);
        machine.parameters.0.insert(5221 + 20 * system, quarter(entropy));
        machine.parameters.0.insert(5223 + 20 * system, -quarter(entropy));
        machine.parameters.0.insert(5220, f64::from(system + 1));
        let turns = [Axis::X, Axis::Y].iter().all(|axis| machine.axes.contains(axis));
        if turns && entropy.chance(15) {
            let turn = f64::from(*entropy.pick(&[90, 30, 180]));
            machine.parameters.0.insert(5230 + 20 * system, turn);
        }
    }
    if entropy.chance(10) {
        machine.parameters.0.insert(5210, f64::from(entropy.below(2)));
        machine.parameters.0.insert(5211 + entropy.below(3), quarter(entropy));
    }
    if entropy.chance(10) {
        let number = *entropy.pick(&[31, 500, 5161, 5181, 5163, 5182]);
        machine.parameters.0.insert(number, quarter(entropy));
    }
}

/// Pockets that are not the tools' numbers; each is taken once, and one may be that of the spindle.
fn pockets(entropy: &mut Entropy<'_>, tools: &mut [Tool]) {
    let mut pocket = entropy.below(3);
    for tool in tools {
        tool.pocket = Some(pocket);
        pocket += entropy.range(1, 3);
    }
}

/// A number that every unit and every printed form holds exactly.
fn quarter(entropy: &mut Entropy<'_>) -> f64 {
    f64::from(entropy.below(40)) / 4.0
}

fn environment(entropy: &mut Entropy<'_>) -> Environment {
    let mut environment = Environment::default();
    if entropy.chance(50) {
        environment.wires.insert(
            entropy.below(3).to_string(),
            u16::try_from(entropy.below(3)).unwrap_or_default(),
        );
    }
    let mut time = 0.0;
    for _ in 0..entropy.below(4) {
        time += quarter(entropy);
        let (input, value) = match entropy.below(12) {
            0 => ("adaptive_feed".to_owned(), f64::from(entropy.below(3)) / 2.0),
            1 => ("feed_hold".to_owned(), f64::from(entropy.below(2))),
            2..=5 => (format!("analog_in[{}]", entropy.below(3)), quarter(entropy)),
            _ => (format!("digital_in[{}]", entropy.below(3)), f64::from(entropy.below(2))),
        };
        environment.inputs.push(InputChange { time, input, value });
    }
    if entropy.chance(30) {
        let answers = [
            OrientAnswer::After(0.0),
            OrientAnswer::After(1.5),
            OrientAnswer::Never,
            OrientAnswer::Fault(3),
        ];
        environment.orient.push(*entropy.pick(&answers));
    }
    if entropy.chance(30) {
        environment.probe = Some(*entropy.pick(&[ProbeContact::AtTarget, ProbeContact::Never]));
    }
    if entropy.chance(20) {
        environment.tool_change_time = quarter(entropy);
        environment.manual_tool_change = entropy.chance(30);
    }
    for _ in 0..entropy.below(3) {
        let file = format!("M{}", entropy.range(100, 105));
        if environment.user_programs.iter().all(|program| program.file != file) {
            let folder =
                *entropy.pick(&[Folder::ProgramPrefix, Folder::ProgramPrefix, Folder::SearchPath]);
            let duration = quarter(entropy);
            environment.user_programs.push(UserProgram {
                file,
                folder,
                duration,
                executable: !entropy.chance(8),
                exit_status: if entropy.chance(10) { 3 } else { 0 },
                ..UserProgram::default()
            });
        }
    }
    environment
}

fn operator(entropy: &mut Entropy<'_>) -> Vec<OperatorEvent> {
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
    let mut events: Vec<OperatorEvent> = (0..entropy.below(4))
        .map(|_| {
            let block = BlockLocation::new(Program::MAIN, entropy.range(1, 20));
            let execution = if entropy.chance(8) { 2 } else { 1 };
            let when = RunPoint { block, execution, offset: quarter(entropy) };
            OperatorEvent { when, action: entropy.pick(&actions).clone() }
        })
        .collect();
    if entropy.chance(3) {
        // A spindle that stands at an override of zero turns once that is turned up.
        for factor in [0.0, 1.0] {
            let block = BlockLocation::new(Program::MAIN, entropy.range(1, 20));
            let when = RunPoint { block, execution: 1, offset: 0.0 };
            let action = Action::SpindleOverride { spindle: 0, factor };
            events.push(OperatorEvent { when, action });
        }
    }
    events.sort_by_key(|event| event.when.block.line);
    events
}
