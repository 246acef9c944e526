//! Issued commands as settings and effects of the vocabulary.
//!
//! Moves are issued in machine coordinates and the machine's unit; offsets, rotation and unit in force lead back to
//! program coordinates.

use gaugeblock_adapter::HarnessError;
use gaugeblock_vocabulary::{
    Axis, Channel, Effect, Event, Indexed, LengthUnit, Machine, OrientDirection, OutputTiming,
    PathControlMode, Position, Settings, SpindleTurn, Switch, WaitMode,
};

use super::stream::Issued;
use crate::instrumentation::checkpoint::Checkpoint;
use crate::instrumentation::lengths::Lengths;
use crate::instrumentation::source::code;
use crate::instrumentation::state;

/// Millimetres in an inch.
const INCH: f64 = 25.4;

/// Settings after the commands so far, and the events of the block in progress.
#[derive(Clone, Debug)]
pub(super) struct Canon {
    /// Settings in force.
    pub(super) now: Settings,
    /// Where the controlled point is, program coordinates.
    pub(super) position: Position,
    /// Tool in the spindle.
    pub(super) tool: i32,
    prepared: i32,
    /// Tool numbers in the order of the tool table, unless each is found by its pocket.
    tools: Vec<i32>,
    unit: LengthUnit,
    spindles: u8,
    lengths: Lengths,
    g5x: Position,
    g92: Position,
    tool_offset: Position,
    rotation: f64,
    events: Vec<Event>,
    /// Value of #5399 after the block, which an M66 has read.
    read: f64,
    block: String,
    /// Whether M19 has made the interpreter take the spindles for stopped.
    forgotten: bool,
}

impl Canon {
    /// Nothing set yet.
    pub(super) fn new(machine: &Machine) -> Self {
        let in_order = machine.tools.iter().map(|tool| i32::try_from(tool.number).unwrap_or(0));
        Self {
            now: Settings::default(),
            position: Position::default(),
            tool: 0,
            prepared: 0,
            tools: if machine.random_tool_changer { Vec::new() } else { in_order.collect() },
            unit: machine.length_unit,
            spindles: machine.spindles,
            lengths: Lengths::default(),
            g5x: Position::default(),
            g92: Position::default(),
            tool_offset: Position::default(),
            rotation: 0.0,
            events: Vec::new(),
            read: 0.0,
            block: String::new(),
            forgotten: false,
        }
    }

    /// Begins the next block; `after` is the checkpoint after it, `read` what #5399 was then.
    pub(super) fn begin(&mut self, line: &str, after: &Checkpoint, read: Option<f64>) {
        self.block = code(line);
        self.read = read.unwrap_or_default();
        let unit = if after.is("_metric") { LengthUnit::Millimetre } else { LengthUnit::Inch };
        let rescaled = self.lengths.use_unit(unit);
        self.set(Settings { units: Some(unit), ..rescaled });
    }

    /// Ends the block: the settings of its checkpoint, and its events.
    ///
    /// # Errors
    /// A mode that is not known.
    pub(super) fn finish(&mut self, after: &Checkpoint) -> Result<Vec<Event>, HarnessError> {
        let modes = state::modes(after, &self.now, &self.block)?;
        self.set(modes);
        let mut others = state::others(after);
        // After M19 the interpreter takes every spindle for stopped; the commands tell how they turn.
        let oriented =
            self.now.spindle.as_ref().and_then(|all| all.0.get(&0)) == Some(&SpindleTurn::Oriented);
        self.forgotten |= oriented || self.block.contains("m19");
        self.forgotten &= !after.is("_spindle_on");
        if self.forgotten {
            others.spindle = None;
        }
        others.work_offset = u32::try_from(after.mode("_coord_system")).ok().map(work_offset);
        self.set(others);
        self.position = state::position(after);
        Ok(self.take_events())
    }

    /// The events since the last time.
    pub(super) fn take_events(&mut self) -> Vec<Event> {
        std::mem::take(&mut self.events)
    }

    /// What the program did while it was read: messages that pass no queue.
    pub(super) fn push(&mut self, effect: Effect) {
        self.events.push(Event::Do(effect));
    }

    fn set(&mut self, change: Settings) {
        state::set(&mut self.now, &mut self.events, &change);
    }

    /// Takes over a command.
    ///
    /// # Errors
    /// A command that is not known, or arguments that do not belong to it.
    pub(super) fn issue(&mut self, issued: &Issued) -> Result<(), HarnessError> {
        let effect = match issued.name.as_str() {
            "TRAJ_LINEAR_MOVE" => {
                let end = self.program_position(machine_position(issued, 0)?);
                if issued.whole(9)? == 1 {
                    Effect::StraightTraverse { end }
                } else {
                    Effect::StraightFeed { end }
                }
            }
            "TRAJ_CIRCULAR_MOVE" => self.arc(issued)?,
            "TRAJ_DELAY" => Effect::Dwell { seconds: issued.number(0)? },
            "OPERATOR_DISPLAY" => {
                Effect::Message { channel: Channel::Display, text: issued.text(1) }
            }
            "TASK_PLAN_PAUSE" => Effect::Stop { optional: false },
            "TASK_PLAN_OPTIONAL_STOP" => Effect::Stop { optional: true },
            "TASK_PLAN_END" => Effect::ProgramEnd {},
            "CONTROLLER_MODE" => Effect::ChangeControllerMode { mode: word(issued)? },
            "REQUEST_REFUSED" => Effect::RequestRefused { request: word(issued)? },
            _ => return self.other(issued),
        };
        self.push(effect);
        Ok(())
    }

    fn other(&mut self, issued: &Issued) -> Result<(), HarnessError> {
        let effect = match issued.name.as_str() {
            "MOTION_SET_DOUT" => Effect::SetDigitalOutput {
                output: issued.whole(0)?,
                on: issued.whole(1)? != 0,
                timing: timing(issued.whole(3)?),
            },
            "MOTION_SET_AOUT" => Effect::SetAnalogOutput {
                output: issued.whole(0)?,
                to: issued.number(1)?,
                timing: timing(issued.whole(3)?),
            },
            "AUX_INPUT_WAIT" => self.wait_input(issued)?,
            "SYSTEM_CMD" => user_code(issued)?,
            "TOOL_PREPARE" => {
                self.prepared = issued.whole(0)?;
                Effect::PrepareTool { tool: self.prepared }
            }
            "TOOL_LOAD" => {
                self.tool = self.prepared;
                Effect::ChangeTool { tool: self.tool }
            }
            "TOOL_UNLOAD" => {
                self.tool = 0;
                Effect::ChangeTool { tool: 0 }
            }
            "TOOL_SET_NUMBER" => {
                // Without random order it is the place in the table, from 1.
                let place: i32 = issued.whole(0)?;
                let at = place.checked_sub(1).and_then(|at| usize::try_from(at).ok());
                let listed = at.and_then(|at| self.tools.get(at));
                self.tool = listed.copied().unwrap_or(place);
                Effect::SetToolNumber { tool: self.tool }
            }
            "TOOL_SET_OFFSET" => self.tool_entry(issued)?,
            "SPINDLE_ORIENT" => {
                if self.spindles == 1 {
                    self.turn(SpindleTurn::Oriented);
                }
                Effect::OrientSpindle {
                    spindle: 0,
                    angle: issued.number(0)?,
                    direction: match issued.whole(1)? {
                        0 => OrientDirection::Shortest,
                        1 => OrientDirection::Clockwise,
                        2 => OrientDirection::Counterclockwise,
                        _ => return Err(issued.unreadable()),
                    },
                }
            }
            "SPINDLE_WAIT_ORIENT_COMPLETE" => {
                Effect::WaitOrient { spindle: 0, timeout: issued.number(0)? }
            }
            _ => {
                let change = self.setting(issued)?;
                self.set(change);
                return Ok(());
            }
        };
        self.push(effect);
        Ok(())
    }

    /// An entry of the tool table was written.
    fn tool_entry(&self, issued: &Issued) -> Result<Effect, HarnessError> {
        Ok(Effect::SetToolEntry {
            tool: issued.whole(1)?,
            offset: self.in_program_unit(machine_position(issued, 2)?),
            diameter: self.length(issued.number(11)?),
            front_angle: issued.number(12)?,
            back_angle: issued.number(13)?,
            orientation: issued.whole(14)?,
        })
    }

    fn setting(&mut self, issued: &Issued) -> Result<Settings, HarnessError> {
        let none = Settings::default();
        let switch = |place| -> Result<Option<Switch>, HarnessError> {
            Ok(Some(if issued.whole(place)? == 0 { Switch::Off } else { Switch::On }))
        };
        Ok(match issued.name.as_str() {
            "TRAJ_SET_G5X" => {
                self.g5x = machine_position(issued, 1)?;
                let offset = self.in_program_unit(self.g5x);
                let work_offset = u32::try_from(issued.whole(0)?).ok();
                Settings { work_offset, ..self.lengths.g5x(offset) }
            }
            "TRAJ_SET_G92" => {
                self.g92 = machine_position(issued, 0)?;
                let offset = self.in_program_unit(self.g92);
                self.lengths.g92(offset)
            }
            "TRAJ_SET_ROTATION" => {
                self.rotation = issued.number(0)?;
                Settings { rotation: Some(self.rotation), ..none }
            }
            "TRAJ_SET_OFFSET" => {
                self.tool_offset = machine_position(issued, 0)?;
                let offset = self.in_program_unit(self.tool_offset);
                self.lengths.tool(offset)
            }
            "TRAJ_SET_TERM_COND" => {
                let path = match issued.whole(0)? {
                    0 => PathControlMode::ExactStop,
                    1 => PathControlMode::ExactPath,
                    2 => PathControlMode::Continuous,
                    _ => return Err(issued.unreadable()),
                };
                let tolerance = self.length(issued.number(1)?);
                let blend = match path {
                    PathControlMode::Continuous => self.lengths.blend(tolerance),
                    PathControlMode::ExactPath | PathControlMode::ExactStop => none,
                };
                Settings { path: Some(path), ..blend }
            }
            "COOLANT_MIST_ON" => Settings { mist: Some(Switch::On), ..none },
            "COOLANT_MIST_OFF" => Settings { mist: Some(Switch::Off), ..none },
            "COOLANT_FLOOD_ON" => Settings { flood: Some(Switch::On), ..none },
            "COOLANT_FLOOD_OFF" => Settings { flood: Some(Switch::Off), ..none },
            "TRAJ_SET_FO_ENABLE" => Settings { feed_override: switch(0)?, ..none },
            "TRAJ_SET_FH_ENABLE" => Settings { feed_stop: switch(0)?, ..none },
            "MOTION_ADAPTIVE" => Settings { adaptive_feed: switch(0)?, ..none },
            // Which spindle is not told; the checkpoint after the block shows the first one's.
            "SPINDLE_ON" | "SPINDLE_OFF" if self.spindles == 1 => {
                // The checkpoint after the block shows which way it turns.
                let turn = SpindleTurn::Stopped;
                Settings { spindle: Some(Indexed::one(0, turn)), ..none }
            }
            "TRAJ_SET_SO_ENABLE" | "SPINDLE_SPEED" | "SPINDLE_ON" | "SPINDLE_OFF" => none,
            "TRAJ_SET_SPINDLESYNC" | "TRAJ_CLEAR_PROBE_TRIPPED_FLAG" | "TOOL_START_CHANGE" => none,
            name if name.starts_with("TASK_") => none,
            "TRAJ_SET_SCALE" | "TRAJ_SET_RAPID_SCALE" | "TRAJ_SET_SPINDLE_SCALE" => none,
            "TOOL_LOAD_TOOL_TABLE" => none,
            _ => return Err(issued.unreadable()),
        })
    }

    fn turn(&mut self, turn: SpindleTurn) {
        self.set(Settings { spindle: Some(Indexed::one(0, turn)), ..Settings::default() });
    }

    fn wait_input(&self, issued: &Issued) -> Result<Effect, HarnessError> {
        let input = Some(issued.whole(0)?);
        let is_digital = issued.whole(1)? == 1;
        let mode = match issued.whole(2)? {
            0 => WaitMode::Immediate,
            1 => WaitMode::Rise,
            2 => WaitMode::Fall,
            3 => WaitMode::High,
            4 => WaitMode::Low,
            // It takes numbers that mean nothing, and lets the time-out go by.
            5.. => WaitMode::Immediate,
            _ => return Err(issued.unreadable()),
        };
        let timeout = issued.number(3)?;
        Ok(Effect::WaitInput {
            digital: input.filter(|_| is_digital),
            analog: input.filter(|_| !is_digital),
            mode,
            timeout: (mode != WaitMode::Immediate).then_some(timeout),
            read: self.read,
        })
    }

    fn arc(&self, issued: &Issued) -> Result<Effect, HarnessError> {
        let end = self.program_position(machine_position(issued, 0)?);
        let axis = |place| issued.number(place);
        let centre = Position { x: axis(9)?, y: axis(10)?, z: axis(11)?, ..Position::default() };
        // On a machine in inches it is as long as a millimetre.
        let normal: [f64; 3] = [axis(12)?, axis(13)?, axis(14)?];
        let longest = normal.iter().fold(0.0_f64, |other, part| other.max(part.abs()));
        let turn = issued.whole(15)?;
        let turns = if turn >= 0 { turn + 1 } else { turn };
        let centre = self.program_position(centre);
        let (first_centre, second_centre) = match normal.map(|part| part.abs() > longest / 2.0) {
            [false, false, true] => (centre.x, centre.y),
            [false, true, false] => (centre.z, centre.x),
            [true, false, false] => (centre.y, centre.z),
            _ => return Err(issued.unreadable()),
        };
        Ok(Effect::ArcFeed { end, first_centre, second_centre, turns })
    }

    /// A length of the machine in the active unit.
    fn length(&self, length: f64) -> f64 {
        match (self.unit, self.now.units) {
            (LengthUnit::Millimetre, Some(LengthUnit::Inch)) => length / INCH,
            (LengthUnit::Inch, Some(LengthUnit::Millimetre)) => length * INCH,
            _ => length,
        }
    }

    fn in_program_unit(&self, mut position: Position) -> Position {
        for axis in [Axis::X, Axis::Y, Axis::Z, Axis::U, Axis::V, Axis::W] {
            let length = position.get_mut(axis);
            *length = self.length(*length);
        }
        position
    }

    /// Program coordinates of a machine position: without tool offset and work offset, turned back, without G92.
    fn program_position(&self, machine: Position) -> Position {
        let minus = |a: Position, b: Position| {
            let (a, b) = (a.to_array(), b.to_array());
            Position::from(std::array::from_fn(|axis| a[axis] - b[axis]))
        };
        let mut position = minus(minus(machine, self.tool_offset), self.g5x);
        let angle = -self.rotation.to_radians();
        let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
        let (x, y) = (position.x, position.y);
        position.x = x * cosine - y * sine;
        position.y = x * sine + y * cosine;
        self.in_program_unit(minus(position, self.g92))
    }
}

/// G54 to G59.3 as the interpreter numbers them: 540 to 590, then 591 to 593.
fn work_offset(mode: u32) -> u32 {
    if mode > 590 { mode - 584 } else { (mode / 10).saturating_sub(53) }
}

fn machine_position(issued: &Issued, first: usize) -> Result<Position, HarnessError> {
    let mut position = [0.0; 9];
    for (axis, value) in position.iter_mut().enumerate() {
        *value = issued.number(first + axis)?;
    }
    Ok(Position::from(position))
}

/// The first argument as a word of the vocabulary.
fn word<T: serde::de::DeserializeOwned>(issued: &Issued) -> Result<T, HarnessError> {
    serde_json::from_value(issued.text(0).into()).map_err(|_| issued.unreadable())
}

fn timing(now: i32) -> OutputTiming {
    if now == 0 { OutputTiming::WithMotion } else { OutputTiming::AtOnce }
}

/// A user program's command line: its path, then both arguments as text.
fn user_code(issued: &Issued) -> Result<Effect, HarnessError> {
    let line = issued.text(0);
    let mut words = line.split_whitespace();
    let name = words.next().and_then(|path| path.rsplit('/').next()).unwrap_or_default();
    let code = name.get(1..4).and_then(|digits| digits.parse().ok());
    let (Some(code), Some(p), Some(q)) = (code, words.next(), words.next()) else {
        return Err(issued.unreadable());
    };
    Ok(Effect::UserCode { code, p: p.to_owned(), q: q.to_owned() })
}
