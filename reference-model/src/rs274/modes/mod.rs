//! The table of codes and modal groups, and the modes in force.

mod codes;
mod coordinates;
mod groups;
mod motions;
mod rounding;
mod saved_state;
mod settings;
pub(crate) mod units;

pub use codes::{ARC, Code, G_CODES, M_CODES, g_code, g_text, m_code};
pub(crate) use coordinates::first_parameter;
pub use groups::ModalGroup;
pub use motions::{motion_code, motion_mode};
pub use rounding::Rounding;
pub use saved_state::SavedState;
pub(crate) use units::each;
pub use units::{converted, unit_size};

use gaugeblock_vocabulary::{
    Axis, Compensation, ControllerMode, Distance, FeedMode, Lathe, LengthUnit, Machine, Motion,
    PathControlMode, Plane, Position, ReturnMode, SpindleLimit, SpindleMode, SpindleTurn, Switch,
};

use crate::Choices;
use crate::dialects::ModalMemory;
use crate::ids::choice::modal_groups::{InitialMotion, InitialRetract};
use crate::ids::choice::offsets::{FlagAndRotation, StoredUnit};
use crate::ids::choice::units_planes::InitialUnit;
use crate::math::near_integer;

/// The mode in force of each modal group, with all values that stay in force until they are set again.
///
/// Lengths are in the active length unit: a change of unit converts them all (`execute::units`).
#[derive(Clone, Debug, PartialEq)]
pub struct Modes {
    /// Motion mode: what axis words alone mean.
    pub motion: Motion,
    /// Length unit of program coordinates and feeds.
    pub units: LengthUnit,
    /// Selected plane.
    pub plane: Plane,
    /// Distance mode of axis words.
    pub distance: Distance,
    /// Distance mode of arc offsets.
    pub arc_distance: Distance,
    /// Feed mode: what F counts.
    pub feed_mode: FeedMode,
    /// F in the active length unit per minute or per revolution, or in 1/min under inverse time; zero until set.
    pub feed_rate: f64,
    /// Whether F is awaited since a switch to G94 or G95.
    pub feed_awaited: bool,
    /// Return mode of canned cycles.
    pub retract: ReturnMode,
    /// Cutter compensation.
    pub compensation: Compensation,
    /// Radius of the cutter while it is compensated, active length unit.
    pub compensation_radius: f64,
    /// Orientation of the lathe tool that is compensated, 0 to 9; 0 and 9 are its centre.
    pub compensation_orientation: i32,
    /// Whether a tool length offset applies.
    pub tool_length: Switch,
    /// The tool offset that applies, active length unit; zero under G49.
    pub tool_offset: Position,
    /// Work coordinate system, 1 to 9 for G54 to G59.3.
    pub work_offset: u32,
    /// Offset of the work coordinate system, active length unit.
    pub g5x_offset: Position,
    /// Offset of G52 and G92, active length unit.
    pub g92_offset: Position,
    /// Whether an offset of G52 or G92 applies, be it zero.
    pub local_applies: bool,
    /// Rotation of the work coordinate system about Z, degrees.
    pub rotation: f64,
    /// Path control mode.
    pub path: PathControlMode,
    /// P of G64, active length unit; zero when not given.
    pub blend_tolerance: f64,
    /// Q of G64, active length unit; zero when not given.
    pub naive_cam_tolerance: f64,
    /// Diameter or radius programming of a lathe.
    pub lathe: Lathe,
    /// The spindles by number from 0; the machine has at least one.
    pub spindles: Vec<Spindle>,
    /// Mist coolant.
    pub mist: Switch,
    /// Flood coolant.
    pub flood: Switch,
    /// Whether the feed override control is enabled.
    pub feed_override: Switch,
    /// Whether the adaptive feed input is used.
    pub adaptive_feed: Switch,
    /// Whether the feed stop input is enabled.
    pub feed_stop: Switch,
    /// Mode of the controller: a program runs in auto mode, and its end leaves MDI mode.
    pub controller_mode: ControllerMode,
    /// What becomes of the last bits of positions that are computed.
    pub rounding: Rounding,
    /// What the dialect remembers with the modes; nothing by the documents.
    pub(crate) memory: ModalMemory,
}

/// The commanded turn and speed of a spindle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spindle {
    /// S: revolutions per minute, or surface speed (feet or metres per minute) under constant surface speed.
    pub speed: f64,
    /// What S means.
    pub mode: SpindleMode,
    /// D of G96.
    pub limit: SpindleLimit,
    /// Whether it turns, and which way.
    pub turn: SpindleTurn,
    /// Whether its speed override control is enabled.
    pub speed_override: Switch,
}

impl Spindle {
    /// A spindle before the first block.
    pub const AT_START: Self = Self {
        speed: 0.0,
        mode: SpindleMode::Rpm,
        limit: SpindleLimit::None,
        turn: SpindleTurn::Stopped,
        speed_override: Switch::On,
    };
}

/// What a controller may do otherwise with the modes.
pub(crate) trait ModesRules {
    /// Rule offsets.local-parameters. Whether the stored local offset applies at the start: unless #5210 is 0.
    /// Choice offsets.flag-and-rotation: where no parameter says so, it waits for G92.3.
    fn offset_applies_at_start(&self, flag: f64, choices: &Choices) -> bool {
        flag.abs() > 0.0 && choices.is(FlagAndRotation::Stored)
    }

    /// Rule modal-groups.initial-modes. The blend tolerance before the first block, in millimetres: there is none.
    fn initial_blend_tolerance(&self, _choices: &Choices) -> f64 {
        0.0
    }
}

impl Modes {
    /// The modes before the first block.
    ///
    /// Rule modal-groups.initial-modes. XY plane, radius mode, incremental arc distance, blending without a
    /// tolerance, and the coordinate system that #5220 names. Motion mode, return mode and length unit are choices.
    ///
    /// LinuxCNC's documents say no more. Everything else begins as the README of this crate tells: absolute distance,
    /// feed per minute, nothing on but overrides and feed stop.
    ///
    /// Rule modal-groups.power-up. Grbl's documents list all of this; their motion mode is G0.
    pub fn new(machine: &Machine, choices: &Choices) -> Self {
        let stored = |number: u32| stored(machine, number).unwrap_or(0.0);
        // Choice units-planes.initial-unit.
        let initial_unit = match choices.get::<InitialUnit>() {
            InitialUnit::Machine => machine.length_unit,
            InitialUnit::Millimetre => LengthUnit::Millimetre,
        };
        let mut modes = Self {
            motion: match choices.get::<InitialMotion>() {
                InitialMotion::Feed => Motion::Feed,
                InitialMotion::Traverse => Motion::Traverse,
                InitialMotion::None => Motion::None,
            },
            units: initial_unit,
            plane: Plane::Xy,
            distance: Distance::Absolute,
            arc_distance: Distance::Incremental,
            feed_mode: FeedMode::PerMinute,
            feed_rate: 0.0,
            feed_awaited: false,
            retract: match choices.get::<InitialRetract>() {
                InitialRetract::OldZ => ReturnMode::OldZ,
                InitialRetract::RPlane => ReturnMode::RPlane,
            },
            compensation: Compensation::Off,
            compensation_radius: 0.0,
            compensation_orientation: 0,
            tool_length: Switch::Off,
            tool_offset: Position::default(),
            work_offset: start_system(machine),
            g5x_offset: Position::default(),
            g92_offset: Position::default(),
            local_applies: false,
            rotation: 0.0,
            path: PathControlMode::Continuous,
            blend_tolerance: choices.dialect().initial_blend_tolerance(choices)
                / unit_size(initial_unit),
            naive_cam_tolerance: 0.0,
            lathe: Lathe::Radius,
            spindles: vec![Spindle::AT_START; usize::from(machine.spindles.max(1))],
            mist: Switch::Off,
            flood: Switch::Off,
            feed_override: Switch::On,
            adaptive_feed: Switch::Off,
            feed_stop: Switch::On,
            controller_mode: ControllerMode::Auto,
            rounding: Rounding::default(),
            memory: ModalMemory::default(),
        };
        let unit = match choices.get::<StoredUnit>() {
            StoredUnit::Machine => machine.length_unit,
            StoredUnit::AsProgrammed => initial_unit,
        };
        modes.load_work_offset(stored, unit);
        if choices.is(FlagAndRotation::None) {
            modes.rotation = 0.0;
            for axis in Axis::ALL.iter().filter(|axis| !machine.axes.contains(axis)) {
                *modes.g5x_offset.get_mut(*axis) = 0.0;
            }
        }
        let applies = choices.dialect().offset_applies_at_start(stored(5210), choices);
        modes.use_stored_offset(applies, stored, unit);
        modes
    }
}

/// Rule offsets.start-system. #5220 names the coordinate system at the start; without a number from 1 to 9 it is the
/// first. Rule numbers.near-integer. What is stored is such a number where it is close to one.
pub fn start_system(machine: &Machine) -> u32 {
    let named = stored(machine, 5220).and_then(near_integer);
    let system = named.and_then(|named| u32::try_from(named).ok());
    system.filter(|system| (1..=9).contains(system)).unwrap_or(1)
}

/// A parameter as it is stored, if it has a value.
fn stored(machine: &Machine, number: u32) -> Option<f64> {
    machine.parameters.0.get(&number).copied().filter(|value| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at_start(parameters: &[(u32, f64)]) -> Modes {
        let parameters = parameters.iter().copied().collect();
        Modes::new(&Machine { parameters, ..Machine::default() }, &Choices::default())
    }

    #[test]
    fn a_stored_number_close_to_that_of_a_system_names_it() {
        let unknown = [1.4, 2.000_2, 0.5, 9.5, 10.0, -2.0, f64::INFINITY].map(|stored| (stored, 1));
        for (stored, system) in [(2.000_05, 2), (8.999_95, 9)].into_iter().chain(unknown) {
            assert_eq!(at_start(&[(5220, stored)]).work_offset, system, "{stored}");
        }
    }

    #[test]
    fn a_stored_local_offset_applies_unless_zero_says_that_it_does_not() {
        let unknown = [f64::NAN, f64::INFINITY, 0.0].map(|stored| (stored, 0.0));
        let known = [1.0, 2.0, -1.0, 0.5].map(|stored| (stored, 7.0));
        for (stored, offset) in known.into_iter().chain(unknown) {
            let modes = at_start(&[(5210, stored), (5211, 7.0)]);
            assert!((modes.g92_offset.x - offset).abs() < 1e-9, "{stored}");
        }
    }
}
