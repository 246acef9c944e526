//! What the outside answers to the production controller, as the scenario's environment says. Time is virtual: only
//! waits move it.

use std::collections::BTreeMap;

use gaugeblock_interpreter::ProbeMove;
use gaugeblock_interpreter::task::{ExternalOperation, Input, OperationState, WaitEvent};
use gaugeblock_vocabulary::scenario::{
    Action, Environment, Folder, OrientAnswer, ProbeContact, UserProgram,
};
use gaugeblock_vocabulary::{BlockLocation, Effect, FaultKind, Pin, Position, Scenario};

use super::operator::Operator;

/// Points that are nearer than this in each axis are one, machine unit.
const SAME: f64 = 1e-6;

/// The outside: clock, inputs, wires, tool changer, encoders, programs, and the operator.
#[derive(Clone, Debug)]
pub(super) struct SimulatedEnvironment<'a> {
    environment: &'a Environment,
    operator: Operator<'a>,
    /// Whether programs of user-defined codes are looked for in the search path too.
    search_path: bool,
    /// Whether the run goes on after a program that ended with a status other than zero.
    ignores_status: bool,
    /// Seconds since the start.
    time: f64,
    /// Digital outputs that are not off, or were not.
    outputs: BTreeMap<u16, bool>,
    /// When the tool change is over.
    changed_at: f64,
    /// When each spindle began to turn to its angle.
    orienting: BTreeMap<u32, f64>,
    /// When the program of a user-defined code is over, and how.
    program: (f64, OperationState),
    /// Where the last probing move ended, and whether the probe touches there.
    probed: Option<(Position, bool)>,
}

impl<'a> SimulatedEnvironment<'a> {
    /// The outside before the first block: all outputs are off.
    pub(super) fn new(scenario: &'a Scenario) -> Self {
        Self {
            environment: &scenario.environment,
            operator: Operator::new(&scenario.operator),
            search_path: !scenario.options.is("user-codes.place", "program-prefix"),
            ignores_status: scenario.options.is("user-codes.exit-status", "ignored"),
            time: 0.0,
            outputs: BTreeMap::new(),
            changed_at: 0.0,
            orienting: BTreeMap::new(),
            program: (0.0, OperationState::Done),
            probed: None,
        }
    }

    /// Seconds since the start.
    pub(super) fn time(&self) -> f64 {
        self.time
    }

    /// The operator.
    pub(super) fn operator(&self) -> &Operator<'a> {
        &self.operator
    }

    /// A block begins now: what the operator does at it falls due from here.
    pub(super) fn begin_block(&mut self, block: &BlockLocation) {
        self.operator.begin_block(block, self.time);
    }

    /// What the operator has requested so far.
    pub(super) fn asked(&mut self) -> Option<Action> {
        self.operator.take(self.time)
    }

    /// Whether a person changes the tools.
    pub(super) fn prompts_for_tools(&self) -> bool {
        self.environment.manual_tool_change
    }

    /// Lets time go by until then, or until something happens. Of what happens at one time the operator comes first.
    pub(super) fn wait(&mut self, until: Option<f64>) -> WaitEvent {
        let until = until.unwrap_or(f64::INFINITY);
        let changes = self.environment.inputs.iter().map(|change| change.time);
        let works = [self.changed_at, self.program.0].into_iter().chain(self.orientations());
        let later = changes.chain(works).filter(|time| *time > self.time);
        let change = later.fold(f64::INFINITY, f64::min);
        let request = self.operator.due().map_or(f64::INFINITY, |due| due.max(self.time));
        if change.is_finite() && change <= until && change < request {
            self.time = change;
            return WaitEvent::Changed;
        }
        if request <= until
            && let Some(action) = self.operator.take(request)
        {
            self.time = request;
            return WaitEvent::Requested(action);
        }
        if until.is_infinite() {
            return WaitEvent::Never;
        }
        self.time = self.time.max(until);
        WaitEvent::Time
    }

    /// When spindles reach their angles.
    fn orientations(&self) -> impl Iterator<Item = f64> {
        self.orienting.iter().filter_map(|(spindle, begun)| match self.answer(*spindle) {
            OrientAnswer::After(seconds) => Some(begun + seconds),
            OrientAnswer::Never | OrientAnswer::Fault(_) => None,
        })
    }

    /// The immediate reaction to an effect. Only effects that the environment answers have one.
    pub(super) fn perform(&mut self, effect: &Effect) -> Result<(), FaultKind> {
        if let Effect::ChangeTool { .. } = effect {
            self.changed_at = self.time + self.environment.tool_change_time;
        } else if let Effect::OrientSpindle { spindle, .. } = effect {
            self.orienting.insert(*spindle, self.time);
        } else if let Effect::UserCode { code, .. } = effect {
            let program = self.user_program(*code).ok_or(FaultKind::UnknownCode)?;
            let fails = program.exit_status != 0 && !self.ignores_status;
            let failed = OperationState::Failed(FaultKind::UserCode);
            let state = if fails { failed } else { OperationState::Done };
            self.program = (self.time + program.duration, state);
        }
        Ok(())
    }

    /// How far a work is.
    pub(super) fn operation_state(&self, operation: ExternalOperation) -> OperationState {
        let done = |at: f64| {
            if at <= self.time { OperationState::Done } else { OperationState::InProgress }
        };
        match operation {
            ExternalOperation::ToolChange => done(self.changed_at),
            ExternalOperation::UserProgram if self.program.0 <= self.time => self.program.1,
            ExternalOperation::UserProgram => OperationState::InProgress,
            ExternalOperation::Orientation(spindle) => match self.answer(spindle) {
                OrientAnswer::After(seconds) => {
                    let begun = self.orienting.get(&spindle).copied().unwrap_or(self.time);
                    done(begun + seconds)
                }
                OrientAnswer::Never => OperationState::InProgress,
                OrientAnswer::Fault(_) => OperationState::Failed(FaultKind::Orient),
            },
        }
    }

    /// What the encoder of a spindle answers. One of which nothing is said answers at once.
    fn answer(&self, spindle: u32) -> OrientAnswer {
        let place = usize::try_from(spindle).unwrap_or(usize::MAX);
        self.environment.orient.get(place).copied().unwrap_or(OrientAnswer::After(0.0))
    }

    /// A pin has another value: outputs may be wired to inputs.
    pub(super) fn pin(&mut self, pin: Pin, value: f64) {
        if let Pin::DigitalOut(number) = pin {
            self.outputs.insert(number, value != 0.0);
        }
    }

    /// The value of an input now; one to which nothing is connected is zero.
    pub(super) fn input(&self, input: Input) -> f64 {
        if let Input::Digital(number) = input
            && let Some(output) = self.wire(number)
        {
            let on = self.outputs.get(&output).copied().unwrap_or_default();
            return f64::from(u8::from(on));
        }
        // Where nothing slows motion down it is at full speed.
        let unconnected = if input == Input::AdaptiveFeed { 1.0 } else { 0.0 };
        if self.environment.inputs.iter().all(|change| change.time > self.time) {
            return unconnected;
        }
        let name = match input {
            Input::Digital(number) => format!("digital_in[{number}]"),
            Input::Analog(number) => format!("analog_in[{number}]"),
            Input::AdaptiveFeed => "adaptive_feed".to_owned(),
            Input::FeedHold => "feed_hold".to_owned(),
        };
        let changes = self.environment.inputs.iter();
        let past = changes.filter(|change| change.input == name && change.time <= self.time);
        past.map(|change| change.value).next_back().unwrap_or(unconnected)
    }

    /// The digital output that is wired to a digital input.
    fn wire(&self, input: u16) -> Option<u16> {
        let wired = self.environment.wires.iter().find(|(_, wired)| **wired == input);
        wired.and_then(|(output, _)| output.parse().ok())
    }

    /// Where the probe changes on its way, machine coordinates.
    ///
    /// # Errors
    /// It is as it is to become before it moves.
    pub(super) fn probe(&mut self, probing: &ProbeMove) -> Result<Option<Position>, FaultKind> {
        let (from, to) = (probing.from(), probing.to());
        let touches_here = match self.probed {
            Some((place, touches)) if is_same(place, from) => touches,
            _ => {
                matches!(self.environment.probe, Some(ProbeContact::At(point)) if is_same(point, from))
            }
        };
        if touches_here == probing.toward() {
            return Err(FaultKind::Probe);
        }
        let contact = match self.environment.probe {
            Some(ProbeContact::AtTarget) => Some(to),
            Some(ProbeContact::At(point)) if lies_between(point, from, to) => Some(point),
            Some(ProbeContact::At(_) | ProbeContact::Never) | None => None,
        };
        let touches = contact.is_some() == probing.toward();
        self.probed = Some((contact.unwrap_or(to), touches));
        Ok(contact)
    }

    /// The first executable program, in the folder of programs before the search path.
    pub(super) fn user_program(&self, code: u32) -> Option<&'a UserProgram> {
        let name = format!("M{code}");
        let fits =
            |program: &&UserProgram| program.file == name && program.at_start && program.executable;
        let of = |folder: Folder| {
            self.environment
                .user_programs
                .iter()
                .filter(fits)
                .find(move |file| file.folder == folder)
        };
        let searched = || self.search_path.then(|| of(Folder::SearchPath)).flatten();
        of(Folder::ProgramPrefix).or_else(searched)
    }
}

fn is_same(a: Position, b: Position) -> bool {
    a.to_array().into_iter().zip(b.to_array()).all(|(a, b)| (a - b).abs() < SAME)
}

/// Whether a point is on the straight way between two others.
fn lies_between(point: Position, from: Position, to: Position) -> bool {
    let way = from.to_array().into_iter().zip(to.to_array()).map(|(from, to)| to - from);
    let way: Vec<f64> = way.collect();
    let gone = from.to_array().into_iter().zip(point.to_array()).map(|(from, at)| at - from);
    let gone: Vec<f64> = gone.collect();
    let length: f64 = way.iter().map(|part| part * part).sum();
    let share = way.iter().zip(&gone).map(|(way, gone)| way * gone).sum::<f64>() / length;
    let is_on_line = way.iter().zip(&gone).all(|(way, gone)| (gone - share * way).abs() < SAME);
    (-SAME..=1.0 + SAME).contains(&share) && is_on_line
}
