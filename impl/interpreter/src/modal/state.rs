//! The state of the modal side.

use alloc::boxed::Box;
use alloc::vec::Vec;

use gaugeblock_vocabulary::scenario::ToolChange;
use gaugeblock_vocabulary::{ControllerMode, LengthUnit, Motion, Rs274State, Settings, Tool};

use crate::parameters::Numbered;

use super::choices::Choices;
use super::compensation::path::CompensationState;
use super::compensation::plane::Cutter;
use super::coordinates::{Conversion, Coordinates};
use super::cycles::{MotionSeries, PendingBlock};
use super::modes::ActiveSettings;
use super::offsets;
use super::saved_states::SavedStates;
use super::snapshots::MachineSnapshot;
use super::turning::Turning;

/// No tool is selected.
pub(super) const NO_TOOL: i32 = -1;

/// The modes of a running program, and the machine as far as they need it.
#[derive(Clone, Debug)]
pub(crate) struct Modal {
    /// The settings in force.
    pub(super) active: ActiveSettings,
    /// Motion mode.
    pub(super) motion: Motion,
    /// The controlled point: program coordinates, active length unit and degrees.
    pub(super) position: Coordinates,
    /// The series of cycles or splines.
    pub(super) series: MotionSeries,
    /// The rest of a block that takes more than a step.
    pub(super) pending: Option<PendingBlock>,
    /// The lathe cycle under way.
    pub(super) turning: Option<Box<Turning>>,
    /// Most moves of a profile.
    pub(crate) profile_moves: u32,
    /// The cutter of the compensation in force.
    pub(super) cutter: Cutter,
    /// The compensated path, and what waits.
    pub(super) compensation: CompensationState,
    /// Whether any spindle is under constant surface speed.
    pub(super) surface_speed: bool,
    /// The spindle that G95 follows.
    pub(super) feed_spindle: u32,
    /// Tool number in the spindle, 0 for none.
    pub(super) tool: i32,
    /// Tool that T selected since the last change, [`NO_TOOL`] where it selected none.
    pub(super) prepared: Option<i32>,
    /// Tool that T selected last; a change takes nothing from it.
    pub(super) selected: Option<i32>,
    /// Tool table, machine unit.
    pub(super) tools: Vec<Tool>,
    /// Tools that the block has changed, with their places, as they were.
    pub(super) changed_tools: Vec<(usize, Tool)>,
    /// The machine as it is, while blocks are only read.
    pub(super) machine_snapshot: Option<Box<MachineSnapshot>>,
    /// Mode of the controller.
    pub(super) controller_mode: ControllerMode,
    /// The states that M70 and M73 saved.
    pub(super) saved: SavedStates,
    /// The sink replied with a stop within this block.
    pub(super) stop_asked: bool,
    /// Letters of the axes that the machine has.
    pub(super) axes: u32,
    /// Highest velocity of each axis, machine unit per second; infinite where none is given.
    pub(super) velocities: Coordinates,
    /// Whether quirks of `rs274` are emulated.
    pub(crate) emulates_rs274: bool,
    /// The tool that M6 put into the spindle last.
    pub(super) loaded_by_change: i32,
    /// P of the last cycle that had one, seconds.
    pub(super) cycle_dwell: f64,
    /// Number of spindles.
    pub(super) spindles: u32,
    /// Number of digital inputs and outputs each.
    pub(super) digital_io: i32,
    /// Number of analog inputs and outputs each.
    pub(super) analog_io: i32,
    /// Degrees added to R of M19.
    pub(super) orient_offset: f64,
    /// Additional actions of a tool change.
    pub(super) tool_change: ToolChange,
    /// Whether tools change places in the changer.
    pub(super) random_tool_changer: bool,
    /// Length unit of the machine.
    pub(super) machine_unit: LengthUnit,
    /// Feed rate per minute of the last feed move, active unit.
    pub(super) rate_of_move: f64,
    /// The choices of the dialect.
    pub(super) choices: Choices,
}

impl Modal {
    /// All settings in force.
    pub(crate) fn settings(&self) -> Settings {
        self.active.settings()
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
        self.active.now().machine_of(self.position).converted(self.active_to_machine())
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

    /// The unit of stored lengths: that of the machine, or by a choice the active one.
    fn stored_unit(&self) -> LengthUnit {
        if self.choices.stored_as_programmed { self.active.now().units } else { self.machine_unit }
    }

    /// From the unit of stored lengths to the active one.
    pub(super) fn stored_to_active(&self) -> Conversion {
        Conversion::between(self.stored_unit(), self.active.now().units)
    }

    /// From the active unit to that of stored lengths.
    pub(super) fn active_to_stored(&self) -> Conversion {
        Conversion::between(self.active.now().units, self.stored_unit())
    }

    /// From the unit of the machine to the active one.
    pub(super) fn machine_to_active(&self) -> Conversion {
        Conversion::between(self.machine_unit, self.active.now().units)
    }

    /// From the active unit to that of the machine.
    pub(super) fn active_to_machine(&self) -> Conversion {
        Conversion::between(self.active.now().units, self.machine_unit)
    }
}
