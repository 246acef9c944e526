//! The state before the first block.

use alloc::vec::Vec;

use gaugeblock_vocabulary::{Axis, ControllerMode, LengthUnit, Machine, Motion, ReturnMode, Tool};

use crate::error::Error;
use crate::faults::{PlantedFault, planted};
use crate::limits::Limits;
use crate::parameters::{Numbered, is_stored};

use super::Modal;
use super::choices::{Choices, InitialMotion};
use super::compensation::path::CompensationState;
use super::compensation::plane::Cutter;
use super::coordinates::{Conversion, Coordinates};
use super::cycles::MotionSeries;
use super::letters::AXES;
use super::modes::{ActiveSettings, Modes, SPINDLES};
use super::saved_states::SavedStates;
use super::tool::number_of;
use super::{letters, offsets};

impl Modal {
    /// The modes at the start of a program. Stored parameters are taken over into `numbered`.
    ///
    /// # Errors
    /// An unknown option, or a number of spindles other than 1 to 8.
    pub(crate) fn new(
        machine: &Machine,
        choices: Choices,
        numbered: &mut Numbered,
    ) -> Result<Self, Error> {
        let spindles = usize::from(machine.spindles);
        if !(1..=SPINDLES).contains(&spindles) {
            return Err(Error::Configuration("a machine has 1 to 8 spindles"));
        }
        for (number, value) in machine.parameters.0.iter().filter(|(at, _)| is_stored(**at)) {
            numbered.set(*number, *value);
        }
        let mut modal = Self {
            active: ActiveSettings::new(initial_modes(machine, &choices, numbered), spindles),
            motion: match choices.initial_motion {
                _ if planted(PlantedFault::BeginsWithTraverse) => Motion::Traverse,
                InitialMotion::None => Motion::None,
                InitialMotion::Feed => Motion::Feed,
                InitialMotion::Traverse => Motion::Traverse,
            },
            position: Coordinates::default(),
            series: MotionSeries::default(),
            pending: None,
            turning: None,
            profile_moves: Limits::default().profile_moves,
            cutter: Cutter::NONE,
            compensation: CompensationState::new(Limits::default().waiting_effects),
            surface_speed: false,
            feed_spindle: 0,
            tool: initial_tool(machine).map_or(0, number_of),
            prepared: None,
            selected: None,
            tools: machine.tools.clone(),
            changed_tools: Vec::with_capacity(2),
            machine_snapshot: None,
            controller_mode: ControllerMode::Auto,
            saved: SavedStates::default(),
            stop_asked: false,
            axes: axis_letters(&machine.axes),
            velocities: velocities(machine),
            emulates_rs274: false,
            loaded_by_change: 0,
            cycle_dwell: 0.0,
            spindles: u32::from(machine.spindles),
            digital_io: i32::from(machine.digital_io),
            analog_io: i32::from(machine.analog_io),
            orient_offset: machine.orient_offset,
            tool_change: machine.tool_change,
            random_tool_changer: machine.random_tool_changer,
            machine_unit: machine.length_unit,
            rate_of_move: 0.0,
            choices,
        };
        // The machine is at its origin (11.1.2).
        modal.position = modal.active.now().program_of(Coordinates::default());
        modal.publish_tool(numbered);
        Ok(modal)
    }

    /// Emulates `rs274` from the start: the initial point is computed without the stored rotation.
    pub(crate) fn emulate_rs274(&mut self) {
        self.emulates_rs274 = true;
        let now = *self.active.now();
        self.position = Modes { rotation: 0.0, ..now }.program_of(Coordinates::default());
    }
}

/// The settings before the first block. A machine starts with the work coordinate system of 5220 (11.1.3.1) and with
/// the stored offset of G92 (11.1.5.1).
fn initial_modes(machine: &Machine, choices: &Choices, numbered: &mut Numbered) -> Modes {
    let units =
        if choices.initial_machine_unit { machine.length_unit } else { LengthUnit::Millimetre };
    let stored = if choices.stored_as_programmed { units } else { machine.length_unit };
    let conversion = Conversion::between(stored, units);
    let of_axes = choices.offsets_of_axes;
    let system = offsets::system_of(numbered.get(offsets::WORK_OFFSET));
    numbered.set(offsets::WORK_OFFSET, f64::from(system));
    let origin = offsets::origin(numbered, system);
    let mut modes = Modes {
        units,
        work_offset: system,
        g5x_offset: Coordinates::default()
            .taking(if of_axes { axis_letters(&machine.axes) } else { AXES }, origin)
            .converted(conversion),
        rotation: if of_axes { 0.0 } else { offsets::rotation(numbered, system) },
        retract: if choices.initial_old_z { ReturnMode::OldZ } else { ReturnMode::RPlane },
        ..Modes::default()
    };
    if numbered.get(offsets::G92_APPLIED).abs() > 0.0 && !of_axes {
        modes.g92_offset = offsets::g92_offset(numbered).converted(conversion);
    }
    modes
}

/// On a machine whose tools change places, pocket 0 is the spindle (11.2.2.2).
fn initial_tool(machine: &Machine) -> Option<&Tool> {
    let in_spindle = |tool: &&Tool| machine.random_tool_changer && tool.pocket == Some(0);
    machine.tools.iter().find(in_spindle)
}

/// The letters of axes.
fn axis_letters(axes: &[Axis]) -> u32 {
    axes.iter().fold(0, |letters, axis| {
        letters
            | match axis {
                Axis::X => letters::X,
                Axis::Y => letters::Y,
                Axis::Z => letters::Z,
                Axis::A => letters::A,
                Axis::B => letters::B,
                Axis::C => letters::C,
                Axis::U => letters::U,
                Axis::V => letters::V,
                Axis::W => letters::W,
            }
    })
}

/// The highest velocity of each axis, machine unit per second.
fn velocities(machine: &Machine) -> Coordinates {
    Axis::ALL.iter().fold(Coordinates([f64::INFINITY; 9]), |velocities, axis| {
        let limit = machine.limits.get(axis.word()).and_then(|limits| limits.velocity);
        limit.map_or(velocities, |limit| velocities.with_axis(*axis, limit))
    })
}
