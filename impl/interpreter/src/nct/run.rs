//! A run: the programs that are in progress, and which block comes next, a step at a time.

use alloc::vec::Vec;

use gaugeblock_vocabulary::{Axis, Effect, End, FaultKind, Motion, Position};

use super::choices::Choices;
use super::evaluate::{Evaluator, Stack};
use super::frames::{Frame, ModalCall, Reach};
use super::modes::Modes;
use super::program::{Code, Condition, Kind, Stop, Target, Value, refuse};
use super::variables::Variables;
use crate::faults::{PlantedFault, planted};
use crate::math;
use crate::modal::Coordinates;

/// The report of a step in addition to variables.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct StepReport {
    pub(super) modal_call: Option<(u32, u32)>,
    pub(super) motion: Option<Motion>,
    pub(super) position: Option<Position>,
}

/// The result of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Flow {
    /// The run goes on.
    On,
    /// M2 or M30.
    ProgramEnd,
    /// M99 in the main program.
    Endless,
}

/// Programs, and all that their run needs.
#[derive(Debug)]
pub(super) struct Runner {
    pub(super) code: Code,
    pub(super) choices: Choices,
    pub(super) variables: Variables,
    /// Axes that the machine has, by place.
    pub(super) axes: [bool; 9],
    pub(super) modes: Modes,
    /// None at the beginning.
    pub(super) motion: Motion,
    /// Program coordinates, active length unit and degrees.
    pub(super) position: Coordinates,
    /// The tool that T named last.
    pub(super) tool: i32,
    /// Programs in progress, the main program first.
    pub(super) frames: Vec<Frame>,
    /// How often M99 may still repeat the main program.
    pub(super) turns_left: u32,
    /// The modal calls in force, the one that was commanded last at the end.
    pub(super) modal_calls: Vec<ModalCall>,
    /// The modal call that follows the block which has been executed.
    pub(super) follows: Option<usize>,
    /// The words of the block that have a value, and their values.
    pub(super) words: Vec<(u8, f64)>,
    /// Its G codes in tenths, and its M codes.
    pub(super) g: Vec<u16>,
    pub(super) m: Vec<u16>,
    pub(super) effects: Vec<Effect>,
    pub(super) report: StepReport,
    stack: Stack,
    /// Motion mode and position as they were reported last.
    last: Option<(Motion, Coordinates)>,
}

impl Runner {
    pub(super) fn new(code: Code, choices: Choices, axes: &[Axis]) -> Self {
        let mut has = [false; 9];
        for (place, axis) in has.iter_mut().zip(Axis::ALL) {
            *place = axes.contains(axis);
        }
        let first = code.programs.first().map_or(0, |program| program.blocks.from);
        Self {
            code,
            choices,
            variables: Variables::new(),
            axes: has,
            modes: Modes::default(),
            motion: Motion::None,
            position: Coordinates::default(),
            tool: 0,
            frames: alloc::vec![Frame::main(first)],
            turns_left: End::TURNS - 1,
            modal_calls: Vec::new(),
            follows: None,
            words: Vec::new(),
            g: Vec::new(),
            m: Vec::new(),
            effects: Vec::new(),
            report: StepReport::default(),
            stack: Stack::new(),
            last: None,
        }
    }

    /// Whether a block is left, or a call after one; otherwise the next step refuses the program.
    pub(super) fn has_next(&mut self) -> bool {
        if self.follows.is_some() {
            return true;
        }
        let next = self.frame().next;
        let has_next = self.next_block().is_ok();
        self.go_to(next);
        has_next
    }

    /// Makes a step: its line, and its result or why it failed.
    pub(super) fn step(&mut self) -> (u32, Result<Flow, Stop>) {
        self.variables.begin();
        self.effects.clear();
        self.report = StepReport::default();
        let (line, flow) = match self.follows.take() {
            Some(call) => (self.line_before(), self.call_modally(call).map(|()| Flow::On)),
            None => match self.next_block() {
                Ok((line, kind)) => (line, self.block(kind)),
                Err(line) => (line, refuse(FaultKind::MissingEnd, "the program has no end")),
            },
        };
        if flow.is_ok() {
            self.report_state();
        }
        (line, flow)
    }

    /// Reports differences from the step before.
    fn report_state(&mut self) {
        let last = self.last.replace((self.motion, self.position));
        if last.is_none_or(|(motion, _)| motion != self.motion) {
            self.report.motion = Some(self.motion);
        }
        if last.is_none_or(|(_, position)| position != self.position) {
            self.report.position = Some(self.position.position());
        }
    }

    /// The line of the block that has been executed.
    fn line_before(&self) -> u32 {
        let block = self.frame().next.checked_sub(1);
        block.and_then(|block| self.code.blocks.get(block)).map_or(0, |block| block.line)
    }

    /// Goes on to the next block, past those that are skipped; the line at which the program has no end where there
    /// is none.
    fn next_block(&mut self) -> Result<(u32, Kind), u32> {
        let program = self.frame().program;
        let Some(program) = self.code.programs.get(program).copied() else { return Err(1) };
        loop {
            let next = self.frame().next;
            let block =
                program.blocks.of(&self.code.blocks).get(next.wrapping_sub(program.blocks.from));
            let Some(block) = block.copied() else {
                let last = program.blocks.of(&self.code.blocks).last();
                return Err(last.map_or(program.line, |block| block.line));
            };
            self.go_to(next.saturating_add(1));
            if !matches!(block.kind, Kind::Skipped) {
                return Ok((block.line, block.kind));
            }
        }
    }

    fn block(&mut self, kind: Kind) -> Result<Flow, Stop> {
        match kind {
            Kind::Words(words) => return self.words(words),
            Kind::Assign { to, from } => self.assign(to, from)?,
            Kind::Goto(to) => self.jump(to)?,
            Kind::If { condition, to } => {
                if self.holds(condition)? {
                    self.jump(to)?;
                }
            }
            Kind::While { condition, behind } => {
                if !self.holds(condition)? {
                    self.go_to(behind);
                }
            }
            Kind::End(begin) => self.go_to(begin),
            Kind::Stop(stop) => return Err(stop),
            Kind::Skipped => {}
        }
        Ok(Flow::On)
    }

    /// Evaluates with the variables as they are now, and the stack for it.
    pub(super) fn evaluator(&mut self) -> (Evaluator<'_>, &mut Stack) {
        let (code, variables) = (&self.code, &self.variables);
        (Evaluator { code, variables, choices: self.choices }, &mut self.stack)
    }

    fn holds(&mut self, condition: Condition) -> Result<bool, Stop> {
        let (evaluator, stack) = self.evaluator();
        evaluator.holds(condition, stack)
    }

    fn assign(&mut self, to: Target, from: Value) -> Result<(), Stop> {
        let (evaluator, stack) = self.evaluator();
        let slot = evaluator.target(to, stack)?;
        let value = evaluator.value(from, stack)?;
        if self.variables.put(slot?, value) {
            return Ok(());
        }
        refuse(FaultKind::ReadOnlyParameter, "#0 is vacant for ever")
    }

    fn jump(&mut self, to: Value) -> Result<(), Stop> {
        let (evaluator, stack) = self.evaluator();
        let Some(number) = evaluator.value(to, stack)? else {
            return Err(Stop::Open("GOTO with a vacant value"));
        };
        self.jump_to(number)
    }

    /// Goes on at the block of a sequence number in the program in progress.
    pub(super) fn jump_to(&mut self, number: f64) -> Result<(), Stop> {
        let frame = self.frame();
        let (program, here) = (frame.program, frame.next.saturating_sub(1));
        let none = Stop::Refused(FaultKind::UnknownLabel, "3070 NOT EXISTING BLOCK NO. P");
        let rounded = if planted(PlantedFault::LabelCut) {
            math::floor(number)
        } else {
            math::round_away(number)
        };
        let number = math::whole(rounded).and_then(|number| u32::try_from(number).ok());
        let number = number.ok_or(none)?;
        let labels = &self.code.labels;
        let found = labels.partition_point(|(of, label, _)| (*of, *label) < (program, number));
        let mut labels = labels.iter().skip(found);
        let is_it = |label: &&(usize, u32, usize)| (label.0, label.1) == (program, number);
        let Some((.., block)) = labels.next().filter(is_it).copied() else { return Err(none) };
        if labels.next().is_some_and(|label| is_it(&label)) {
            return Err(Stop::Open("a sequence number that occurs several times is searched"));
        }
        let within = self.code.blocks.get(block).and_then(|block| block.within);
        if let Some(within) = within.and_then(|within| self.code.loops.get(within))
            && !(within.from..within.to).contains(&here)
        {
            return Err(Stop::Open("a jump into a loop"));
        }
        self.go_to(block);
        Ok(())
    }

    /// The program in progress.
    pub(super) fn frame(&self) -> Frame {
        self.frames.last().copied().unwrap_or(Frame::main(0))
    }

    /// Which block of the program in progress comes next.
    pub(super) fn go_to(&mut self, next: usize) {
        if let Some(frame) = self.frames.last_mut() {
            frame.next = next;
        }
    }

    /// The modal call that a block of the program in progress triggers, as its place among those in force.
    pub(super) fn reached(&self) -> Result<Option<usize>, Stop> {
        let in_force = self.modal_calls.len();
        match self.frame().reach {
            Reach::All => Ok(in_force.checked_sub(1)),
            Reach::First(calls) => Ok(calls.min(in_force).checked_sub(1)),
            Reach::Unspecified if in_force == 0 => Ok(None),
            Reach::Unspecified => Err(Stop::Open(
                "which modal calls reach a macro of G65 that is called while one is in force",
            )),
        }
    }
}
