//! One program: sends its blocks, queries the modes after each, and writes down what the controller reports.

use std::time::Duration;

use gaugeblock_adapter::HarnessError;
use gaugeblock_vocabulary::{
    Axis, BlockLocation, Bound, End, Event, Fault, Language, LengthUnit, Outcome, Program,
    Rs274State, Scenario, Settings, State, Step,
};

use crate::dialect::Meaning;
use crate::identity::Identity;
use crate::session::{Answer, Session};
use crate::setup::{Motion, Setup};
use crate::stored::position;
use crate::words::{Words, is_blank};

/// Distance from the program's zero that counts as zero, in the length unit of reports.
const START_DISTANCE_MAX: f64 = 0.01;

/// A run of a program.
#[derive(Debug)]
pub(crate) struct Case<'a> {
    pub(crate) session: &'a mut Session,
    pub(crate) identity: &'a Identity,
    pub(crate) setup: &'a Setup,
    pub(crate) scenario: &'a Scenario,
}

/// What is known after a block.
#[derive(Clone, Debug, Default)]
struct Known {
    settings: Settings,
    state: Rs274State,
    is_ended: bool,
}

impl Case<'_> {
    /// Runs the program on a controller that was reset and is idle.
    ///
    /// # Errors
    /// The controller gives no valid answer in time, restarts, is locked, or is not where the program begins.
    pub(crate) fn run(mut self) -> Result<Outcome, HarnessError> {
        let home = match self.setup.motion {
            Motion::Checked => {
                self.session.enter_check_mode()?;
                None
            }
            Motion::Real => Some(self.start_of_motion()?),
        };
        let mut known = Known::default();
        self.query(&mut known, true)?;
        let mut outcome = Outcome {
            language: Language::Rs274,
            start: known.settings.clone(),
            steps: Vec::new(),
            end: End::StreamEnd,
            parameters: None,
            pins: Vec::new(),
            samples: Vec::new(),
        };
        let is_locked = self.blocks(&mut known, &mut outcome)?;
        if let (Some(home), false) = (home, is_locked) {
            if outcome.end == End::Paused {
                self.session.reset()?;
                self.session.make_ready(false)?;
            }
            self.return_to(&home)?;
        }
        Ok(outcome)
    }

    /// Sends the blocks up to the end of the program. True if an alarm has locked the controller.
    fn blocks(&mut self, known: &mut Known, outcome: &mut Outcome) -> Result<bool, HarnessError> {
        let mut reported = Rs274State::default();
        let scenario = self.scenario;
        let lines = scenario.program.language.lines(&scenario.program.main);
        for (number, line) in (1..).zip(lines) {
            if is_blank(line) {
                continue;
            }
            let words = Words::of(line);
            let is_block = !words.is_empty() && !line.trim_start().starts_with('%');
            let steps = u32::try_from(outcome.steps.len()).unwrap_or(u32::MAX);
            if is_block && steps >= scenario.budget.steps {
                outcome.end = End::BudgetExhausted { bound: Bound::Steps };
                return Ok(false);
            }
            let block = BlockLocation::new(Program::MAIN, number);
            let dwell = Duration::from_secs_f64(words.dwell_seconds().clamp(0.0, 3600.0));
            let exchange = self.session.block(line.trim(), dwell, self.setup.motion)?;
            match exchange.answer {
                Answer::Accepted => {}
                Answer::Paused => {
                    outcome.end = End::Paused;
                    return Ok(false);
                }
                Answer::Error(code) => {
                    let meaning =
                        self.identity.dialect.error(code, &words, known.settings.feed_mode);
                    outcome.end = refusal(meaning, &format!("error:{code}"), block)?;
                    return Ok(false);
                }
                Answer::Alarm(code) => {
                    let meaning = self.identity.dialect.alarm(code);
                    outcome.end = refusal(meaning, &format!("ALARM:{code}"), block)?;
                    return Ok(true);
                }
            }
            let before = known.settings.clone();
            self.query(known, words.may_change_offsets())?;
            let is_end = exchange.ends_program() || known.is_ended;
            if is_block {
                let change = known.settings.since(&before);
                let state = State::Rs274(known.state.since(&reported));
                reported = known.state.clone();
                outcome.steps.push(step(block, change, state));
            }
            if is_end {
                outcome.end = End::ProgramEnd;
                return Ok(false);
            }
        }
        Ok(false)
    }

    /// Queries the modes, the offsets if they may have changed, and the position of a machine that moves.
    fn query(&mut self, known: &mut Known, offsets: bool) -> Result<(), HarnessError> {
        let modes = self.session.modes()?.of(self.identity.dialect);
        known.settings.overlay(&modes.settings);
        known.state.overlay(&modes.state);
        known.is_ended = modes.is_ended;
        let axes = self.identity.axes();
        let unit = self.identity.unit;
        if offsets && self.identity.reports_offsets {
            let stored = self.session.stored()?.unwrap_or_default();
            let settings = stored.settings(&known.settings, &axes, unit);
            known.settings.overlay(&settings.unwrap_or_default());
        }
        if self.setup.motion == Motion::Real {
            let status = self.session.rest()?;
            let units = known.settings.units.unwrap_or(LengthUnit::Millimetre);
            let at = self.session.work_position(&status);
            known.state.position = at.map(|at| position(&at, &axes, unit, units));
        }
        Ok(())
    }

    /// Where the machine is before the program: at the zero of its coordinates. Returns its machine position.
    fn start_of_motion(&mut self) -> Result<Vec<f64>, HarnessError> {
        let status = self.session.rest()?;
        let work = self.session.work_position(&status).unwrap_or_default();
        let is_zero = work.iter().all(|at| at.abs() <= START_DISTANCE_MAX);
        match status.machine {
            Some(machine) if is_zero && !work.is_empty() => Ok(machine),
            None => Err(HarnessError::NotRun(
                "the controller reports work positions only; hint: $10=1 makes it report machine positions"
                    .to_owned(),
            )),
            Some(_) => Err(HarnessError::NotRun(format!(
                "the machine is at {work:?} in G54, not at zero; hint: move it to where the programs may begin, and \
                 set the zero there: G10 L20 P1 X0 Y0 Z0"
            ))),
        }
    }

    /// Moves the machine to where the program began.
    fn return_to(&mut self, home: &[f64]) -> Result<(), HarnessError> {
        let unit = if self.identity.unit == LengthUnit::Inch { "G20" } else { "G21" };
        let axes = self.identity.axes();
        let word = |(axis, at): (&Axis, &f64)| format!("{}{at}", axis.word().to_uppercase());
        let words: String = axes.iter().zip(home).map(word).collect();
        let block = format!("M5M9{unit}G90G94G53G0{words}");
        let answer = self.session.block(&block, Duration::ZERO, Motion::Real)?.answer;
        if answer == Answer::Accepted {
            return Ok(());
        }
        Err(HarnessError::NotRun(format!(
            "the machine does not return to where the program began: {answer:?}"
        )))
    }
}

/// The end of a program at a refused block.
fn refusal(meaning: Meaning, message: &str, block: BlockLocation) -> Result<End, HarnessError> {
    match meaning {
        Meaning::Refused(kind) => Ok(End::Fault(Fault {
            kind,
            block: Some(block),
            span: None,
            message: message.to_owned(),
        })),
        Meaning::NotReady(hint) => {
            Err(HarnessError::NotRun(format!("{message} at {block}; hint: {hint}")))
        }
        Meaning::Unknown => Err(HarnessError::UnknownMessage(format!("{message} at {block}"))),
    }
}

/// A step with the settings that have changed, and the state.
fn step(block: BlockLocation, change: Settings, state: State) -> Step {
    let events = if change.is_empty() { Vec::new() } else { vec![Event::Set(change.into())] };
    Step { block, events, state: Some(state) }
}
