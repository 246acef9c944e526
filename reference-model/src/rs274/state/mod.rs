//! The whole state of a controller, a sentence per field.

mod contour;
mod curve;
mod frame;
mod pins;
mod series;

use std::collections::BTreeMap;

use gaugeblock_vocabulary::{LengthUnit, Machine, Position, Rs274State, Settings, Shared, Tool};

pub use contour::Contour;
pub(crate) use contour::{CompensatedPath, Exit};
pub use curve::{Curve, Nurbs};
pub use frame::{Call, Frame, Open, Structure, Style};
pub use pins::PinSnapshot;
pub use series::Series;
pub(crate) use series::SeriesFrame;

use super::environment::EnvironmentState;
use super::modes::Modes;
use super::parameters::Parameters;
use super::syntax::Room;
use super::turning::Profile;
use crate::Choices;
use crate::RuleCoverage;
use crate::dialects::Memory;
use crate::ids::choice;

/// The whole state of a controller.
#[derive(Clone, Debug)]
pub struct State {
    /// How the documents are read.
    pub choices: Shared<Choices>,
    /// The machine that it drives.
    pub machine: Shared<Machine>,
    /// The mode in force of each modal group, with feed, speeds, coolant, overrides, offsets: all that M70 can save
    /// and more.
    pub modes: Modes,
    /// The controlled point in program coordinates: active length unit and degrees.
    pub position: Position,
    /// Tool number in the spindle; 0 for none.
    pub tool: i32,
    /// The tool that parameters and codes without a tool number take to be in the spindle: that one, but for the stub
    /// of the stand-alone interpreter, which tells of neither M61 nor a change to no tool.
    pub known_tool: i32,
    /// Tool number that T selected for the next change; -1 for none.
    pub prepared_tool: i32,
    /// Tool number of the last T, changed or not; -1 before.
    pub selected_tool: i32,
    /// Whether T has selected a tool since the last tool change.
    pub selected_for_change: bool,
    /// The tool of each slot of the changer, be it in its slot or in the spindle.
    pub slots: Shared<BTreeMap<u32, i32>>,
    /// Numbered and global named parameters. Local ones are in the frames.
    pub parameters: Parameters,
    /// The main program's frame and one for each call in progress, innermost last; never empty.
    pub frames: Vec<Frame>,
    /// Feed rate per minute before G93, or of the last feed move under it, active length unit.
    pub move_rate: f64,
    /// Line of the current block within its file, from 1.
    pub line: u32,
    /// The row of canned cycles that the last motion belongs to, with the numbers that the next one may leave out.
    pub series: Option<Series>,
    /// What the next spline may need of the one before.
    pub curve: Curve,
    /// The contour along which the cutter is compensated.
    pub contour: Contour,
    /// The profile of the lathe cycle that is being executed, once the cycle has made its first motion; none at other
    /// times. Its moves are read after this motion.
    pub(crate) profile: Option<Profile>,
    /// What the dialect remembers; nothing by the documents.
    #[cfg_attr(not(feature = "dialects"), expect(dead_code, reason = "only a dialect reads it"))]
    pub(crate) memory: Memory,
    /// Whether a log file is open.
    pub log_open: bool,
    /// Whether a file for probed points is open.
    pub probe_log_open: bool,
    /// What the operator has set at the panel.
    pub panel: Panel,
    /// The environment of the controller: its clock, its pins, and how what is connected to it answers.
    pub environment: EnvironmentState,
    /// What the pins were brought up to date for; none where they have to be looked at.
    pub pin_snapshot: Option<PinSnapshot>,
    /// Room for what the parser makes of a line; nothing of it counts from one line to the next.
    pub room: Room,
    /// The rules reached so far.
    pub coverage: RuleCoverage,
}

/// Switches and overrides that the operator sets, in every mode of the controller.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// The optional-stop switch.
    pub optional_stop: bool,
    /// Feed override; 1 is 100 %.
    pub feed_override: f64,
    /// Rapid override; 1 is 100 %.
    pub rapid_override: f64,
    /// Speed override of each spindle by its number; 1 is 100 %.
    pub spindle_overrides: Vec<f64>,
    /// Feed hold.
    pub feed_hold: bool,
}

impl Panel {
    /// Before the operator has touched anything: no optional stop, no feed hold, every override at 100 %.
    pub fn new(machine: &Machine) -> Self {
        Self {
            optional_stop: false,
            feed_override: 1.0,
            rapid_override: 1.0,
            spindle_overrides: vec![1.0; usize::from(machine.spindles.max(1))],
            feed_hold: false,
        }
    }

    /// The speed override of a spindle; 1 for one that the machine does not have.
    pub fn spindle_override(&self, number: u16) -> f64 {
        self.spindle_overrides.get(usize::from(number)).copied().unwrap_or(1.0)
    }
}

/// The tool that is in the spindle at the start; 0 for none. Pocket 0 represents the spindle where tools change
/// places (11.2.2.1); of any other changer a pocket's number says nothing.
pub(crate) fn in_pocket_zero(machine: &Machine) -> i32 {
    let mut tools = machine.tools.iter().filter(|_| machine.random_tool_changer);
    let tool = tools.find(|tool| tool.pocket == Some(0));
    tool.and_then(|tool| i32::try_from(tool.number).ok()).unwrap_or(0)
}

/// The tool of each slot of a changer, as the tool table has them.
pub(crate) fn slots(machine: &Machine) -> Shared<BTreeMap<u32, i32>> {
    let tools = machine.tools.iter();
    tools
        .filter_map(|tool| {
            Some((tool.pocket.unwrap_or(tool.number), i32::try_from(tool.number).ok()?))
        })
        .collect()
}

impl State {
    /// The length unit of stored offsets, positions and tools.
    ///
    /// Choice offsets.stored-unit. That is the machine's, or the one that is active when they are stored or read.
    pub(crate) fn stored_unit(&self) -> LengthUnit {
        match self.choices.get() {
            choice::offsets::StoredUnit::Machine => self.machine.length_unit,
            choice::offsets::StoredUnit::AsProgrammed => self.modes.units,
        }
    }

    /// The frame of the call in progress; the main program's outside of any.
    ///
    /// # Panics
    /// There is no frame: a fault of the model.
    pub fn frame(&self) -> &Frame {
        self.frames.last().expect("control: the main program's frame is never popped")
    }

    /// The same, for changing it.
    ///
    /// # Panics
    /// There is no frame: a fault of the model.
    pub fn frame_mut(&mut self) -> &mut Frame {
        self.frames.last_mut().expect("control: the main program's frame is never popped")
    }

    /// Depth of calls; 0 in the main program.
    ///
    /// # Panics
    /// More calls than a `u32` holds: a fault of the model.
    pub fn call_level(&self) -> u32 {
        u32::try_from(self.frames.len() - 1).expect("control: calls are bounded")
    }

    /// A tool of the tool table.
    pub(crate) fn table_tool(&self, number: i32) -> Option<&Tool> {
        let number = u32::try_from(number).ok()?;
        self.machine.tools.iter().find(|tool| tool.number == number)
    }

    /// The tool in the spindle, when the tool table holds it. Where tools do not change places, 0 is none.
    pub(crate) fn loaded_tool(&self) -> Option<&Tool> {
        let none = self.known_tool == 0 && !self.machine.random_tool_changer;
        self.table_tool(self.known_tool).filter(|_| !none)
    }

    /// Whether the pins are up to date: since they were brought so nothing has changed that they depend on, nor they
    /// themselves.
    pub(crate) fn pins_are_current(&self) -> bool {
        let (modes, environment) = (&self.modes, &self.environment);
        !environment.is_orienting()
            && self.pin_snapshot.as_ref().is_some_and(|snapshot| {
                snapshot.changes == environment.changes().len()
                    && (snapshot.mist, snapshot.flood) == (modes.mist, modes.flood)
                    && snapshot.spindles == modes.spindles
                    && snapshot.overrides == self.panel.spindle_overrides
            })
    }

    /// Every spindle of the machine.
    pub(crate) fn all_spindles(&self) -> Vec<usize> {
        (0..self.modes.spindles.len()).collect()
    }

    /// Everything that is in force, as it is recorded.
    pub fn settings(&self) -> Settings {
        self.modes.settings()
    }

    /// What else is recorded after a block, without the parameters that changed.
    pub fn record(&self) -> Rs274State {
        Rs274State {
            motion: Some(self.modes.motion),
            position: Some(self.position),
            tool: Some(self.tool),
            prepared_tool: Some(self.prepared_tool),
            controller_mode: Some(self.modes.controller_mode),
            call_level: Some(self.call_level()),
            parameter: None,
        }
    }
}

#[cfg(test)]
impl State {
    /// A state before the first block, for tests: the default machine under some options.
    pub(crate) fn under(options: &[(&str, &str)]) -> Self {
        let options = options.iter().map(|(id, option)| ((*id).to_owned(), (*option).to_owned()));
        let choices = Choices::new(&gaugeblock_vocabulary::Options(options.collect()))
            .expect("options are known");
        let machine = Machine::default();
        Self {
            modes: Modes::new(&machine, &choices),
            parameters: Parameters::new(&machine, &choices),
            machine: machine.into(),
            position: Position::default(),
            tool: 0,
            known_tool: 0,
            prepared_tool: -1,
            selected_tool: -1,
            selected_for_change: false,
            move_rate: 0.0,
            slots: Shared::default(),
            frames: vec![Frame::default()],
            line: 1,
            memory: Memory::default(),
            log_open: false,
            probe_log_open: false,
            series: None,
            curve: Curve::default(),
            contour: Contour::default(),
            profile: None,
            panel: Panel::new(&Machine::default()),
            environment: EnvironmentState::new(
                &gaugeblock_vocabulary::scenario::Environment::default(),
                1,
                &choices,
            ),
            pin_snapshot: None,
            room: Room::default(),
            coverage: RuleCoverage::default(),
            choices: choices.into(),
        }
    }
}
