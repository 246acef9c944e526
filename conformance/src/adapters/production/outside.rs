//! What the outside answers to the production interpreter, as the scenario's bench says. Time is virtual: dwells and waits move it.

use std::collections::BTreeMap;

use gaugeblock_impl::{Probing, Reply};
use gaugeblock_trace::scenario::{Bench, Folder, OrientAnswer, ProbeContact, UserProgram};
use gaugeblock_trace::{Effect, FaultKind, OutputTiming, Position, Scenario, WaitMode};

/// What M66 reads when nothing came in time.
const TIMED_OUT: f64 = -1.0;

/// Points that are nearer than this in each axis are one, machine unit.
const SAME: f64 = 1e-6;

/// The outside: clock, outputs that are wired to inputs, and spindles that turn to an angle.
#[derive(Clone, Debug)]
pub(super) struct Outside<'a> {
    bench: &'a Bench,
    /// Whether programs of user-defined codes are looked for in the search path too.
    search_path: bool,
    /// Whether the run goes on after a program that ended with a status other than zero.
    ignores_status: bool,
    /// Seconds since the start.
    time: f64,
    /// Digital outputs that are not off, or were not.
    outputs: BTreeMap<i32, bool>,
    /// What digital outputs become with the next motion.
    with_motion: BTreeMap<i32, bool>,
    /// When each spindle began to turn to its angle.
    orienting: BTreeMap<u32, f64>,
    /// Where the last probing move ended, and whether the probe touches there.
    probed: Option<(Position, bool)>,
}

/// What came of an effect outside.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Answer {
    /// This.
    Reply(Reply),
    /// Nothing will ever come.
    Never,
}

impl<'a> Outside<'a> {
    /// The outside before the first block: all outputs are off.
    pub(super) fn new(scenario: &'a Scenario) -> Self {
        Self {
            bench: &scenario.bench,
            search_path: !scenario.options.is("user-codes.place", "program-prefix"),
            ignores_status: scenario.options.is("user-codes.exit-status", "ignored"),
            time: 0.0,
            outputs: BTreeMap::new(),
            with_motion: BTreeMap::new(),
            orienting: BTreeMap::new(),
            probed: None,
        }
    }

    /// Seconds since the start.
    pub(super) fn time(&self) -> f64 {
        self.time
    }

    /// What comes of an effect. Only the kinds of effects are looked at that something outside answers, or that take time.
    pub(super) fn perform(&mut self, effect: &Effect) -> Answer {
        if moves(effect) {
            self.outputs.append(&mut self.with_motion);
        }
        let reply = if let Effect::Dwell { seconds } = effect {
            self.pass(*seconds);
            Reply::Done
        } else if let Effect::SetDigitalOutput { output, on, timing } = effect {
            self.switch(*output, *on, *timing);
            Reply::Done
        } else if let Effect::WaitInput { digital, analog, mode, timeout, .. } = effect {
            return self.wait(*digital, *analog, *mode, *timeout);
        } else if let Effect::ChangeTool { .. } = effect {
            self.pass(self.bench.tool_change_time);
            Reply::Done
        } else if let Effect::OrientSpindle { spindle, .. } = effect {
            self.orienting.insert(*spindle, self.time);
            Reply::Done
        } else if let Effect::WaitOrient { spindle, timeout } = effect {
            self.wait_orient(*spindle, *timeout)
        } else if let Effect::UserCode { code, .. } = effect {
            self.user_code(*code)
        } else {
            Reply::Done
        };
        Answer::Reply(reply)
    }

    /// Where the probe changes on its way, machine coordinates.
    ///
    /// # Errors
    /// It is as it is to become before it moves.
    pub(super) fn probe(&mut self, probing: &Probing) -> Result<Option<Position>, FaultKind> {
        let (from, to) = (probing.from(), probing.to());
        let touches_here = match self.probed {
            Some((place, touches)) if is_same(place, from) => touches,
            _ => matches!(self.bench.probe, Some(ProbeContact::At(point)) if is_same(point, from)),
        };
        if touches_here == probing.toward() {
            return Err(FaultKind::Probe);
        }
        self.outputs.append(&mut self.with_motion);
        let contact = match self.bench.probe {
            Some(ProbeContact::AtTarget) => Some(to),
            Some(ProbeContact::At(point)) if lies_between(point, from, to) => Some(point),
            Some(ProbeContact::At(_) | ProbeContact::Never) | None => None,
        };
        let touches = contact.is_some() == probing.toward();
        self.probed = Some((contact.unwrap_or(to), touches));
        Ok(contact)
    }

    fn pass(&mut self, seconds: f64) {
        self.time += seconds.max(0.0);
    }

    fn switch(&mut self, output: i32, on: bool, timing: OutputTiming) {
        match timing {
            OutputTiming::WithMotion => self.with_motion.insert(output, on),
            OutputTiming::AtOnce => self.outputs.insert(output, on),
        };
    }

    fn wait(
        &mut self,
        digital: Option<i32>,
        analog: Option<i32>,
        mode: WaitMode,
        timeout: Option<f64>,
    ) -> Answer {
        let input = match (digital, analog) {
            (Some(number), _) => format!("digital_in[{number}]"),
            (None, number) => format!("analog_in[{}]", number.unwrap_or_default()),
        };
        let wire = digital.and_then(|number| self.wire(number));
        let came = self.when(&input, wire, mode);
        match (came, timeout) {
            (Some(when), timeout) if timeout.is_none_or(|seconds| when <= self.time + seconds) => {
                self.time = self.time.max(when);
                Answer::Reply(Reply::Input(self.input(&input, wire)))
            }
            (_, Some(seconds)) => {
                self.pass(seconds);
                Answer::Reply(Reply::Input(TIMED_OUT))
            }
            (_, None) => Answer::Never,
        }
    }

    /// The digital output that is wired to a digital input.
    fn wire(&self, input: i32) -> Option<i32> {
        let wired = self.bench.wires.iter().find(|(_, wired)| i32::from(**wired) == input);
        wired.and_then(|(output, _)| output.parse().ok())
    }

    /// The value of an input now; one to which nothing is connected is zero.
    fn input(&self, input: &str, wire: Option<i32>) -> f64 {
        if let Some(output) = wire {
            let on = self.outputs.get(&output).copied().unwrap_or_default();
            return f64::from(u8::from(on));
        }
        let changes = self.bench.inputs.iter();
        let past = changes.filter(|change| change.input == input && change.time <= self.time);
        past.map(|change| change.value).next_back().unwrap_or_default()
    }

    /// When an input does what is awaited, from now on. While a program waits it switches no output.
    fn when(&self, input: &str, wire: Option<i32>, mode: WaitMode) -> Option<f64> {
        let mut high = self.input(input, wire) != 0.0;
        let wanted = match mode {
            WaitMode::Immediate => return Some(self.time),
            WaitMode::High if high => return Some(self.time),
            WaitMode::Low if !high => return Some(self.time),
            WaitMode::High | WaitMode::Rise => true,
            WaitMode::Low | WaitMode::Fall => false,
        };
        if wire.is_some() {
            return None;
        }
        let changes = self.bench.inputs.iter().filter(|change| change.input == input);
        for change in changes.filter(|change| change.time > self.time) {
            let was = std::mem::replace(&mut high, change.value != 0.0);
            if was != high && high == wanted {
                return Some(change.time);
            }
        }
        None
    }

    /// An encoder of which nothing is said answers at once.
    fn wait_orient(&mut self, spindle: u32, timeout: f64) -> Reply {
        let begun = self.orienting.remove(&spindle).unwrap_or(self.time);
        let place = usize::try_from(spindle).unwrap_or(usize::MAX);
        let answer = self.bench.orient.get(place).copied().unwrap_or(OrientAnswer::After(0.0));
        match answer {
            OrientAnswer::After(seconds) if begun + seconds <= self.time + timeout => {
                self.time = self.time.max(begun + seconds);
                Reply::Done
            }
            OrientAnswer::After(_) | OrientAnswer::Never => {
                self.pass(timeout);
                Reply::Failed(FaultKind::Orient)
            }
            OrientAnswer::Fault(_) => Reply::Failed(FaultKind::Orient),
        }
    }

    /// Runs the program of a user-defined code, as data.
    fn user_code(&mut self, code: u32) -> Reply {
        let Some(program) = self.user_program(code) else {
            return Reply::Failed(FaultKind::UnknownCode);
        };
        self.pass(program.duration);
        if program.exit_status == 0 || self.ignores_status {
            Reply::Done
        } else {
            Reply::Failed(FaultKind::UserCode)
        }
    }

    /// The first executable program, in the folder of programs before the search path.
    fn user_program(&self, code: u32) -> Option<&'a UserProgram> {
        let name = format!("M{code}");
        let fits =
            |program: &&UserProgram| program.file == name && program.at_start && program.executable;
        let of = |folder: Folder| {
            self.bench.user_programs.iter().filter(fits).find(move |file| file.folder == folder)
        };
        let searched = || self.search_path.then(|| of(Folder::SearchPath)).flatten();
        of(Folder::ProgramPrefix).or_else(searched)
    }
}

/// Whether an effect is a motion, with which outputs switch.
fn moves(effect: &Effect) -> bool {
    matches!(
        effect,
        Effect::StraightTraverse { .. }
            | Effect::StraightFeed { .. }
            | Effect::ArcFeed { .. }
            | Effect::NurbsFeed { .. }
            | Effect::StraightProbe { .. }
            | Effect::RigidTap { .. }
    )
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
