//! The interpreter: program text in, settings and effects out, a block at a time.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

use gaugeblock_vocabulary::{
    BlockLocation, ControllerMode, End, Machine, Options, Position, Program, Rs274State, Settings,
    Tool,
};

use crate::block_end::BlockKind;
use crate::canon::Sink;
use crate::control::{CallStack, Cursor, Evaluator, LOOP, Logs, Reader, STREAM};
use crate::dialect::Dialect;
use crate::error::Error;
use crate::limits::Limits;
use crate::modal::Modal;
use crate::parameters::{ItemName, NameId, Named, Numbered, Parameters, is_stored};
use crate::source::Source;
use crate::syntax::bytecode::{Block, Kind, NONE};
use crate::syntax::{CodeSegment, LineCompiler};
use crate::words::Words;

/// An interpreter of LinuxCNC's dialect of RS-274, with the options of a chosen edition.
///
/// One pass over the source: what runs once is read, executed and forgotten, what can run again is compiled once. In
/// steady state a block allocates nothing.
///
/// ```
/// use gaugeblock_interpreter::{Interpreter, Limits, Memory, Progress, Reply, Sink};
/// use gaugeblock_vocabulary::{Effect, End, Machine, Options, Settings};
///
/// #[derive(Default)]
/// struct Count(u32);
/// impl Sink for Count {
///     fn set(&mut self, _line: u32, _changed: &Settings) {}
///     fn perform(&mut self, _line: u32, effect: &Effect) -> Reply {
///         self.0 += u32::from(matches!(effect, Effect::StraightFeed { .. }));
///         Reply::Done
///     }
/// }
///
/// let mut interpreter = Interpreter::new(Machine::default(), Options::default(), Limits::default())?;
/// let mut source = Memory::new("g1 f100\n o1 repeat [3]\n x[#1] #1=[#1+1]\n o1 endrepeat\nm2\n");
/// let mut count = Count::default();
/// let progress = interpreter.run(&mut source, &mut count, 1000)?;
/// assert_eq!(progress, Progress::Ended(End::ProgramEnd));
/// assert_eq!(count.0, 3);
/// # Ok::<(), gaugeblock_interpreter::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Interpreter {
    pub(crate) machine: Machine,
    pub(crate) dialect: Dialect,
    pub(crate) limits: Limits,
    /// Compiles lines; holds the names.
    pub(crate) compiler: LineCompiler,
    /// The place in the source.
    pub(crate) reader: Reader,
    /// Compiled blocks: the line being read, a loop of the main program, numbered subprograms, then subs.
    pub(crate) segments: Vec<CodeSegment>,
    /// Names of the files that were read; the main program first.
    pub(crate) files: Vec<String>,
    /// The next block.
    pub(crate) cursor: Cursor,
    /// Whether the line in the first segment has been read but not executed.
    pub(crate) line_pending: bool,
    /// Whether a search for the next branch of a condition led to the next block. There an elseif evaluates its
    /// condition, and an else is taken; without it both end the branch before them.
    pub(crate) at_branch: bool,
    /// Whether the main program begins with a percent line; not known before its first line.
    pub(crate) percent: Option<bool>,
    /// Whether the percent line that ends the main program was read, perhaps ahead of what is executed.
    pub(crate) percent_closed: bool,
    /// How many loops of the main program have been compiled.
    pub(crate) generation: u32,
    pub(crate) parameters: Parameters,
    /// The modes.
    pub(crate) modal: Modal,
    pub(crate) evaluator: Evaluator,
    pub(crate) words: Words,
    /// Call levels and labels.
    pub(crate) call_stack: CallStack,
    /// Segments of subs by label; `u32::MAX` where there is no such sub.
    pub(crate) subs: Vec<u32>,
    /// Numbered subprograms by label, once M98 has looked for them.
    pub(crate) programs: Option<BTreeMap<NameId, NumberedProgram>>,
    /// Labels of subs that M98's search has passed.
    pub(crate) subs_ahead: Vec<NameId>,
    /// The line of each sub of the main program.
    pub(crate) defined_lines: BTreeMap<NameId, u32>,
    /// Labels of the subs that the last program has defined.
    pub(crate) previous_subs: BTreeSet<NameId>,
    /// Bytes of compiled subs and subprograms.
    pub(crate) code_bytes: usize,
    /// Open log files.
    pub(crate) logs: Logs,
    /// The block of words that is not finished: its place, its line, and its kind.
    pub(crate) pending: Option<(Cursor, u32, BlockKind)>,
    /// How the run ended.
    ended: Option<Result<End, Error>>,
}

/// Reusable memory for parameters, and the dialect: to create both costs more than to execute a few blocks.
#[derive(Debug, Default)]
pub struct Scratch(Option<(Numbered, Dialect)>);

/// Where a numbered subprogram begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NumberedProgram {
    /// Its first block in the segment of programs.
    pub(crate) entry: u32,
    /// The line of its number.
    pub(crate) line: u32,
    /// Whether it has been called.
    pub(crate) called: bool,
}

/// The result of a step.
#[derive(Clone, Debug, PartialEq)]
pub enum Progress {
    /// As many blocks as requested were executed; there is more.
    More,
    /// The sink replied with a stop within the last block; the next step continues from there.
    Stopped,
    /// The sink aborted the last block ([`Reply::Aborted`](crate::Reply::Aborted)).
    Aborted,
    /// The program is over. A refused block is an [`Error::Fault`] and not an end.
    Ended(End),
}

impl Interpreter {
    /// An interpreter before a program's first block, in the machine's initial state.
    ///
    /// # Errors
    /// [`Error::Configuration`]: an option that its choice does not have, or a machine that cannot be.
    pub fn new(machine: Machine, options: Options, limits: Limits) -> Result<Self, Error> {
        Self::with_scratch(machine, options, limits, Scratch::default())
    }

    /// The same, with the scratch memory of an interpreter that is not needed any more. For a caller that runs many
    /// short programs.
    ///
    /// # Errors
    /// As for [`Self::new`].
    pub fn with_scratch(
        machine: Machine,
        options: Options,
        limits: Limits,
        scratch: Scratch,
    ) -> Result<Self, Error> {
        let (numbered, dialect) = scratch.0.unzip();
        let dialect = match dialect.filter(|dialect| *dialect.options() == options) {
            Some(dialect) => dialect,
            None => Dialect::of(options)?,
        };
        let mut numbered = numbered.unwrap_or_else(Numbered::new);
        // DEBUG speaks unless the program turns it off (11.4.3.1).
        numbered.set(5599, 1.0);
        let mut modal = Modal::new(&machine, dialect.modes.clone(), &mut numbered)?;
        modal.set_limits(&limits);
        numbered.take_changes(|_, _| ());
        Ok(Self {
            compiler: LineCompiler::new(&machine, dialect.text.clone(), &limits),
            machine,
            dialect,
            limits,
            reader: Reader::new(),
            segments: vec![CodeSegment::default(); 3],
            files: vec![Program::MAIN.into()],
            cursor: Cursor::MAIN,
            line_pending: false,
            at_branch: false,
            percent: None,
            percent_closed: false,
            generation: 0,
            parameters: Parameters {
                numbered,
                named: Named::new(),
                line: 0,
                call_level: 0,
                controls_machine: true,
                value: 0.0,
                value_returned: false,
                items: Vec::new(),
            },
            modal,
            evaluator: Evaluator::new(),
            words: Words::new(),
            call_stack: CallStack::new(),
            subs: Vec::new(),
            programs: None,
            subs_ahead: Vec::new(),
            defined_lines: BTreeMap::new(),
            previous_subs: BTreeSet::new(),
            code_bytes: 0,
            logs: Logs::default(),
            pending: None,
            ended: None,
        })
    }

    /// Its scratch memory, for another interpreter. It carries no state.
    pub fn into_scratch(self) -> Scratch {
        let mut numbered = self.parameters.numbered;
        numbered.clear();
        Scratch(Some((numbered, self.dialect)))
    }

    /// Sets whether blocks that begin with a slash are skipped, for the next program. By default they are executed.
    pub fn set_block_delete(&mut self, skipped: bool) {
        self.compiler.block_delete = skipped;
    }

    /// Sets whether lines that hold only a plain comment are reported to the sink as blocks that do nothing. By
    /// default they are not blocks.
    pub fn set_report_comments(&mut self, report: bool) {
        self.compiler.report_comments = report;
    }

    /// Sets whether this run is a preview of what a program would do. `#<_task>` is 0 in a preview, so that a program
    /// can skip what only a machine can answer (11.4.3.5).
    pub fn set_preview(&mut self, preview: bool) {
        self.parameters.controls_machine = !preview;
    }

    /// Behaves like LinuxCNC's `rs274` where that differs from its manual: only a few points, which the module
    /// `quirks` lists. It is off unless this is called before the program begins. `stored` holds all stored
    /// parameters: those that are not persistent are taken over too.
    pub fn emulate_rs274(&mut self, stored: impl IntoIterator<Item = (u32, f64)>) {
        self.compiler.choices.emulates_rs274 = true;
        for (number, value) in stored.into_iter().filter(|(number, _)| !is_stored(*number)) {
            self.parameters.numbered.set(number, value);
        }
        self.modal.emulate_rs274();
    }

    /// Reads and executes one block, or a part of one: a canned cycle that is long takes more steps than one. An
    /// endless loop is a step that comes back `More`, for ever; a caller can stop it.
    ///
    /// # Errors
    /// A refused block, a bound of [`Limits`], or a source that cannot be read. After an error the state is that
    /// after the block before, unless its probe has moved and found nothing, and [`Self::abort`] makes it ready for
    /// another program.
    pub fn step<S: Source, K: Sink>(
        &mut self,
        source: &mut S,
        sink: &mut K,
    ) -> Result<Progress, Error> {
        self.run(source, sink, 1)
    }

    /// Reads and executes up to so many blocks.
    ///
    /// # Errors
    /// As for [`Self::step`]; all blocks before the refused one have been executed.
    pub fn run<S: Source, K: Sink>(
        &mut self,
        source: &mut S,
        sink: &mut K,
        blocks: u64,
    ) -> Result<Progress, Error> {
        if let Some(ended) = &self.ended {
            return ended.clone().map(Progress::Ended);
        }
        for _ in 0..blocks {
            match self.execute_next(source, sink) {
                Ok(Progress::More) => {}
                Ok(progress @ (Progress::Stopped | Progress::Aborted)) => return Ok(progress),
                Ok(Progress::Ended(end)) => {
                    self.ended = Some(Ok(end.clone()));
                    return Ok(Progress::Ended(end));
                }
                Err(error) => {
                    self.modal.lose_waiting();
                    self.ended = Some(Err(error.clone()));
                    return Err(error);
                }
            }
        }
        Ok(Progress::More)
    }

    /// Ends the program as an operator's abort does: call levels and what was saved in them are gone, what the main
    /// program has saved as the options say, settings are reset.
    /// After it the interpreter is before another program's first block, as after [`Self::begin`].
    pub fn abort<K: Sink>(&mut self, sink: &mut K) {
        self.modal.abort(sink, self.parameters.line);
        self.restart();
    }

    /// An operator's abort while no program runs: settings are reset, and no run ends by it.
    pub fn abort_idle<K: Sink>(&mut self, sink: &mut K) {
        self.modal.abort_idle(sink, self.parameters.line);
    }

    /// Makes it ready for another program in the state that the last one left: what it defined is forgotten, what it
    /// set stays, and what it has saved as the options say. The value that a sub has returned is 0 then (11.4.3.5).
    pub fn begin(&mut self) {
        self.parameters.value = 0.0;
        self.modal.end_run();
        self.modal.begin();
        self.restart();
        self.previous_subs.clear();
    }

    /// Makes it ready for the program's first block, where that follows its last one without an end between them.
    pub fn restart(&mut self) {
        self.forget_program();
        self.parameters.named.begin();
        self.modal.begin_again();
        if let Some(main) = self.files.first_mut().filter(|main| ***main != *Program::MAIN) {
            *main = Program::MAIN.into();
        }
    }

    /// The calls, the definitions and the place of the last program are forgotten.
    fn forget_program(&mut self) {
        self.leave_calls();
        self.reader = Reader::new();
        self.segments.truncate(3);
        self.segments.iter_mut().for_each(CodeSegment::clear);
        self.files.truncate(1);
        self.cursor = Cursor::MAIN;
        self.line_pending = false;
        self.at_branch = false;
        (self.percent, self.percent_closed) = (None, false);
        self.call_stack = CallStack::new();
        self.subs.clear();
        self.programs = None;
        self.subs_ahead.clear();
        self.previous_subs.extend(core::mem::take(&mut self.defined_lines).into_keys());
        self.code_bytes = 0;
        self.parameters.numbered.end_notes();
        (self.pending, self.ended) = (None, None);
    }

    /// Continues after a refused block: the next step executes the block after it, or, where calls were open, the
    /// block after the outermost call. What a refused block has done already stays done.
    pub fn skip_faulted_block(&mut self) {
        if let Some(frame) = self.call_stack.frames.first() {
            self.cursor = frame.back;
            self.leave_calls();
            self.modal.begin();
        }
        self.modal.lose_waiting();
        self.at_branch = false;
        self.ended = None;
    }

    /// Makes it ready for an MDI block, as line `number` of a file of this name. The states that are saved at the
    /// level of the main program stay; what the last program has defined is forgotten. The source holds that one
    /// line.
    pub fn begin_mdi(&mut self, file: &str, number: u32) {
        self.forget_program();
        self.reader.begin_at(number);
        self.percent = Some(false);
        if let Some(main) = self.files.first_mut()
            && main != file
        {
            *main = file.into();
        }
        self.modal.leave_saved_calls();
        self.modal.set_controller_mode(ControllerMode::Mdi);
    }

    /// Whether it executes an MDI block.
    pub(crate) fn is_mdi(&self) -> bool {
        self.files.first().is_some_and(|main| main != Program::MAIN)
    }

    /// Whether it is between two blocks of the main text, and the next one has not been read.
    pub fn needs_text(&self) -> bool {
        self.cursor.segment == STREAM && !self.line_pending && self.pending.is_none()
    }

    /// The file and line of the block that the next step executes; none where that continues a block or ends the run.
    /// The block is only read and kept: a caller that does not use this loses nothing.
    pub fn next_block<S: Source>(&mut self, source: &mut S) -> Option<(&str, u32)> {
        if self.ended.is_some() || self.pending.is_some() {
            return None;
        }
        if self.cursor.segment == LOOP && self.block_at(self.cursor).is_none() {
            self.cursor = Cursor::MAIN;
        }
        if self.needs_text() {
            match self.read_block(source) {
                Ok(None) => self.line_pending = true,
                Ok(Some(end)) => self.ended = Some(Ok(end)),
                Err(error) => self.ended = Some(Err(error)),
            }
            if let Some(ended) = &self.ended {
                // A refused line still has a place.
                return ended.as_ref().err().and_then(Error::line);
            }
        }
        let at = self.cursor;
        let ends = |block: &&Block| block.kind == Kind::Percent && block.refused == NONE;
        let line = self.block_at(at).filter(|block| !ends(block))?.line;
        let file = segment(&self.segments, at.segment).map_or(0, |code| code.file);
        let file = usize::try_from(file).ok().and_then(|file| self.files.get(file));
        Some((file.map_or(Program::MAIN, |file| file), line))
    }

    /// The block that was executed last, or is being executed.
    pub fn block(&self) -> BlockLocation {
        self.location(self.cursor.segment, self.parameters.line)
    }

    fn block_at(&self, at: Cursor) -> Option<&Block> {
        segment(&self.segments, at.segment).and_then(|code| code.block(at.place))
    }

    /// Declares the HAL items that programs can read by `#<_hal[…]>`, before anything is read. By default there are
    /// none, nor where the INI file disables them. Their values are zero until they are set.
    pub fn declare_items(&mut self, names: impl IntoIterator<Item = ItemName>) {
        if !self.compiler.items_enabled {
            return;
        }
        self.compiler.items.extend(names);
        self.parameters.items.resize(self.compiler.items.len(), 0.0);
    }

    /// Sets the values of HAL items, in the order in which they were declared.
    pub fn set_items(&mut self, values: &[f64]) {
        self.parameters.set_items(values);
    }

    /// The mode of the controller, as programs and the state report it.
    pub fn controller_mode(&self) -> ControllerMode {
        self.modal.controller_mode()
    }

    /// Sets the mode of the controller; a program end changes it too.
    pub fn set_controller_mode(&mut self, mode: ControllerMode) {
        self.modal.set_controller_mode(mode);
    }

    /// Where the controlled point is: machine coordinates, machine unit.
    pub fn machine_point(&self) -> Position {
        self.modal.machine_point().position()
    }

    /// From here on blocks are only read: they change modes and parameters, and not the machine.
    pub fn begin_read_ahead(&mut self) {
        self.modal.begin_read_ahead();
    }

    /// Ends reading ahead: point and tools are those of the machine again. Settings that wait are reported.
    pub fn end_read_ahead<K: Sink>(&mut self, sink: &mut K) {
        self.modal.end_read_ahead(&mut self.parameters.numbered, sink);
    }

    /// Depth of calls; 0 in the main program.
    pub fn call_level(&self) -> u32 {
        self.parameters.call_level
    }

    /// Settings in force.
    pub fn settings(&self) -> Settings {
        self.modal.settings()
    }

    /// The state after the last executed block, without parameters.
    pub fn state(&self) -> Rs274State {
        let mut state = self.modal.state();
        state.call_level = Some(self.parameters.call_level);
        state
    }

    /// All numbered parameters that are not zero, in ascending order.
    pub fn parameters(&mut self) -> Vec<(u32, f64)> {
        self.modal.publish(&mut self.parameters.numbered);
        self.parameters.numbered.nonzero().collect()
    }

    /// The tool table as the program has changed it.
    pub fn tools(&self) -> &[Tool] {
        self.modal.tools()
    }

    /// The machine as it was at the beginning.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// The readings of the documents that apply.
    pub fn options(&self) -> &Options {
        self.dialect.options()
    }
}

/// A segment by its number.
#[inline]
pub(crate) fn segment(segments: &[CodeSegment], number: u32) -> Option<&CodeSegment> {
    usize::try_from(number).ok().and_then(|number| segments.get(number))
}
