//! The modal side: what the words of a block mean under the modes in force, in the documents' order of execution.
//!
//! ```text
//! Words ─► check (groups, missing and unused words) ─► execute (11.4.23, phase by phase) ─► Sink
//!                                                         └─► motions ─► cycles/, a bounded number of strokes at a time
//! ```
//!
//! **Invariants.**
//! * The codes stand in one table, [`codes`]; no other file says which group a code is in or which words it takes.
//! * A refused block leaves the modes as they were, [`undo`], unless its probe has moved and found nothing.
//! * The sink hears of a setting when it changed, and before the next effect.
//! * Positions are program coordinates in the active length unit; only an offset, a unit or G53 goes through machine
//!   coordinates.

mod ahead;
mod arcs;
mod check;
mod choices;
mod codes;
mod compensation;
mod coordinates;
mod cycles;
mod end;
mod execute;
mod io;
pub(crate) mod letters;
mod modes;
mod motion;
mod motions;
mod named;
pub(crate) mod offsets;
mod probe;
mod reference;
mod refusal;
mod saved;
mod spindle;
mod splines;
mod switches;
mod target;
mod threads;
mod tool;
mod tool_table;
mod undo;
mod units;
mod values;
mod work;

#[cfg(test)]
mod tests;

use alloc::boxed::Box;
use alloc::vec::Vec;

use gaugeblock_vocabulary::scenario::ToolChange;
use gaugeblock_vocabulary::{
    Axis, ControllerMode, LengthUnit, Machine, Motion, ReturnMode, Rs274State, Settings, Tool,
};

use crate::error::Error;
use crate::parameters::{Numbered, is_stored};

use ahead::Stands;
pub(crate) use choices::Choices;
use choices::InitialMotion;
pub(crate) use coordinates::{Conversion, Coordinates};
use cycles::{Series, Unfinished};
pub(crate) use modes::Modes;
use modes::{InForce, SPINDLES};
use saved::SavedStates;
use tool::NO_TOOL;

pub(crate) use named::Predefined;
pub(crate) use refusal::{Flow, Refusal};

/// The modes of a running program, and the machine as far as they need it.
#[derive(Clone, Debug)]
pub(crate) struct Modal {
    /// The settings in force.
    in_force: InForce,
    /// Motion mode.
    motion: Motion,
    /// The controlled point: program coordinates, active length unit and degrees.
    position: Coordinates,
    /// What a series of cycles or splines keeps from block to block.
    series: Series,
    /// The rest of a block that is more than a step does.
    unfinished: Option<Unfinished>,
    /// Radius under cutter compensation, active length unit.
    compensation_radius: f64,
    /// Whether any spindle is under constant surface speed.
    surface_speed: bool,
    /// The spindle that G95 follows.
    feed_spindle: u32,
    /// Tool number in the spindle, 0 for none.
    tool: i32,
    /// Tool that T selected since the last change, [`tool::NO_TOOL`] where it selected none.
    prepared: Option<i32>,
    /// Tool that T selected last; a change takes nothing from it.
    selected: Option<i32>,
    /// Tool table, machine unit.
    tools: Vec<Tool>,
    /// Tools that the block has changed, with their places, as they were.
    changed_tools: Vec<(usize, Tool)>,
    /// The machine as it is, where what is executed now is only read ahead.
    stands: Option<Box<Stands>>,
    /// Mode of the controller.
    controller_mode: ControllerMode,
    /// What M70 and M73 saved.
    saved: SavedStates,
    /// The sink asked to stop within this block.
    stop_asked: bool,
    /// Letters of the axes that the machine has.
    axes: u32,
    /// Highest velocity of each axis, machine unit per second; infinite where none is given.
    velocities: Coordinates,
    /// Whether quirks of `rs274` are imitated.
    pub(crate) imitates: bool,
    /// P of the last cycle that had one, seconds.
    cycle_dwell: f64,
    /// Number of spindles.
    spindles: u32,
    /// Number of digital inputs and outputs each.
    digital_io: i32,
    /// Number of analog inputs and outputs each.
    analog_io: i32,
    /// Degrees added to R of M19.
    orient_offset: f64,
    /// What a tool change does besides.
    tool_change: ToolChange,
    /// Whether tools change places in the changer.
    random_tool_changer: bool,
    /// Length unit of stored data.
    machine_unit: LengthUnit,
    /// The readings of the documents that apply.
    choices: Choices,
}

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
            in_force: InForce::new(initial_modes(machine, &choices, numbered), spindles),
            motion: match choices.initial_motion {
                InitialMotion::None => Motion::None,
                InitialMotion::Feed => Motion::Feed,
                InitialMotion::Traverse => Motion::Traverse,
            },
            position: Coordinates::default(),
            series: Series::default(),
            unfinished: None,
            compensation_radius: 0.0,
            surface_speed: false,
            feed_spindle: 0,
            tool: initial_tool(machine).map_or(0, tool::number_of),
            prepared: None,
            selected: None,
            tools: machine.tools.clone(),
            changed_tools: Vec::with_capacity(2),
            stands: None,
            controller_mode: ControllerMode::Auto,
            saved: SavedStates::default(),
            stop_asked: false,
            axes: axis_letters(&machine.axes),
            velocities: threads::velocities(machine),
            imitates: false,
            cycle_dwell: 0.0,
            spindles: u32::from(machine.spindles),
            digital_io: i32::from(machine.digital_io),
            analog_io: i32::from(machine.analog_io),
            orient_offset: machine.orient_offset,
            tool_change: machine.tool_change,
            random_tool_changer: machine.random_tool_changer,
            machine_unit: machine.length_unit,
            choices,
        };
        // The machine stands at its origin (11.1.2).
        modal.position = modal.in_force.now().program_of(Coordinates::default());
        modal.publish_tool(numbered);
        Ok(modal)
    }

    /// Does as `rs274` from the start on: the point where the machine stands is one without the stored rotation.
    pub(crate) fn imitate(&mut self) {
        self.imitates = true;
        let now = *self.in_force.now();
        self.position = Modes { rotation: 0.0, ..now }.program_of(Coordinates::default());
    }

    /// All settings in force.
    pub(crate) fn settings(&self) -> Settings {
        self.in_force.settings()
    }

    /// The state as far as the modes know it: call level and parameters are the caller's to add.
    pub(crate) fn state(&self) -> Rs274State {
        Rs274State {
            motion: Some(self.motion),
            position: Some(self.position.position()),
            tool: Some(self.tool),
            prepared_tool: Some(self.prepared.unwrap_or(NO_TOOL)),
            controller_mode: Some(self.controller_mode),
            call_level: None,
            parameter: None,
        }
    }

    /// The mode of the controller.
    pub(crate) fn controller_mode(&self) -> ControllerMode {
        self.controller_mode
    }

    /// The controller is in another mode.
    pub(crate) fn set_controller_mode(&mut self, mode: ControllerMode) {
        self.controller_mode = mode;
    }

    /// The controlled point in machine coordinates, machine unit.
    pub(crate) fn machine_point(&self) -> Coordinates {
        self.in_force.now().machine_of(self.position).converted(self.active_to_stored())
    }

    /// The tool table as the program has changed it.
    pub(crate) fn tools(&self) -> &[Tool] {
        &self.tools
    }

    /// A parameter that is not kept in [`Numbered`]: the controlled point, 5420 to 5428.
    pub(crate) fn numbered(&self, number: u32) -> Option<f64> {
        offsets::published(self.position, number)
    }

    /// Writes the controlled point into its parameters.
    pub(crate) fn publish(&self, numbered: &mut Numbered) {
        offsets::publish(numbered, self.position);
    }

    /// From the unit of stored lengths to the active one.
    fn stored_to_active(&self) -> Conversion {
        Conversion::between(self.machine_unit, self.in_force.now().units)
    }

    /// From the active unit to that of stored lengths.
    fn active_to_stored(&self) -> Conversion {
        Conversion::between(self.in_force.now().units, self.machine_unit)
    }
}

/// The settings before the first block. A machine starts with the work coordinate system of 5220 (11.1.3.1) and with
/// the stored offset of G92 (11.1.5.1).
fn initial_modes(machine: &Machine, choices: &Choices, numbered: &mut Numbered) -> Modes {
    let units =
        if choices.initial_machine_unit { machine.length_unit } else { LengthUnit::Millimetre };
    let conversion = Conversion::between(machine.length_unit, units);
    let system = offsets::system_of(numbered.get(offsets::WORK_OFFSET));
    numbered.set(offsets::WORK_OFFSET, f64::from(system));
    let mut modes = Modes {
        units,
        work_offset: system,
        g5x_offset: offsets::origin(numbered, system).converted(conversion),
        rotation: offsets::rotation(numbered, system),
        retract: if choices.initial_old_z { ReturnMode::OldZ } else { ReturnMode::RPlane },
        ..Modes::default()
    };
    if numbered.get(offsets::G92_APPLIED).abs() > 0.0 {
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
