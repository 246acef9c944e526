//! States that are kept aside: before a block that may be refused, and of the machine while blocks are only read.

use alloc::vec::Vec;

use gaugeblock_vocabulary::{ControllerMode, Motion, Tool};

use super::compensation::Cutter;
use super::coordinates::Coordinates;
use super::cycles::MotionSeries;

/// The state before a block, as far as it is small. Settings, tools, saved states and parameters are noted when they
/// change.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlockSnapshot {
    pub(super) motion: Motion,
    pub(super) position: Coordinates,
    pub(super) series: MotionSeries,
    pub(super) cutter: Cutter,
    pub(super) surface_speed: bool,
    pub(super) feed_spindle: u32,
    pub(super) tool: i32,
    pub(super) prepared: Option<i32>,
    pub(super) selected: Option<i32>,
    pub(super) controller_mode: ControllerMode,
}

impl BlockSnapshot {
    /// The motion mode.
    pub(super) fn motion(&self) -> Motion {
        self.motion
    }
}

/// The state of the machine that a program does not change while it is only read: its position and its tools.
#[derive(Clone, Debug)]
pub(super) struct MachineSnapshot {
    /// The controlled point, machine coordinates and unit.
    pub(super) point: Coordinates,
    pub(super) tool: i32,
    pub(super) prepared: Option<i32>,
    pub(super) selected: Option<i32>,
    pub(super) tools: Vec<Tool>,
}
