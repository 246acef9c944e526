//! The loop: the next block is found, evaluated, and handed on.

use gaugeblock_vocabulary::{End, FaultKind, Program};

use crate::block_end::{BlockEnd, BlockKind};
use crate::canon::Sink;
use crate::control::{Cursor, LOOP, STREAM, View};
use crate::error::Error;
use crate::faults::{PlantedFault, planted};
use crate::interpret::{Interpreter, Progress, segment};
use crate::modal::{Flow, Refusal};
use crate::source::Source;
use crate::syntax::bytecode::{Block, Kind, NONE};
use crate::syntax::{LineKind, PercentAlone};

impl Interpreter {
    /// Finds and executes one block.
    #[inline]
    pub(crate) fn execute_next<S: Source, K: Sink>(
        &mut self,
        source: &mut S,
        sink: &mut K,
    ) -> Result<Progress, Error> {
        if let Some(place) = self.pending.take() {
            return self.resume_block(place, source, sink);
        }
        loop {
            let at = self.cursor;
            if at.segment == STREAM && !self.line_pending {
                if let Some(progress) = self.execute_line_fast(source, sink)? {
                    return Ok(progress);
                }
                if let Some(end) = self.read_block(source)? {
                    return Ok(Progress::Ended(end));
                }
                self.line_pending = true;
                continue;
            }
            let block = segment(&self.segments, at.segment).and_then(|code| code.block(at.place));
            let Some(block) = block.copied() else {
                // A segment is over; the last blocks of subs are ends of subs, so this is a loop or the last
                // subprogram.
                if at.segment == LOOP {
                    self.cursor = Cursor::MAIN;
                    continue;
                }
                return Err(self.file_ended());
            };
            self.line_pending = false;
            self.cursor = if at.segment == STREAM { at } else { at.after() };
            self.parameters.line = block.line;
            if block.refused != NONE {
                return Err(self.refused(at, &block));
            }
            return match block.kind {
                Kind::Plain => self.execute_plain(at, &block, source, sink),
                Kind::Control(o_word) => self.execute_o_word(at, &block, o_word, source, sink),
                Kind::Definition { label: NONE, .. } if self.call_stack.frames.is_empty() => {
                    let why = "when the number of a sub is computed that is defined in a loop";
                    let block = self.location(at.segment, block.line);
                    Ok(Progress::Ended(End::Unspecified { block, why: why.into() }))
                }
                Kind::Definition { label, segment } => {
                    self.define_sub(at, &block, label, segment)?;
                    self.report_block_end(at, block.line, BlockKind::OWord, sink);
                    Ok(Progress::More)
                }
                Kind::Percent => {
                    self.modal.end_run();
                    Ok(Progress::Ended(End::PercentEnd))
                }
            };
        }
    }

    /// Executes a block of words, settings and comments.
    #[inline]
    fn execute_plain<S: Source, K: Sink>(
        &mut self,
        at: Cursor,
        block: &Block,
        source: &mut S,
        sink: &mut K,
    ) -> Result<Progress, Error> {
        match self.evaluate_plain(at, block, sink) {
            Ok(Some(flow)) => {
                let kind = if block.bare { BlockKind::Comment } else { BlockKind::Words };
                self.after_words((at, block.line), kind, flow, source, sink)
            }
            Ok(None) => self.numbered_call(at, block, source, sink),
            Err(refusal) => self.roll_back(at, block.line, refusal),
        }
    }

    /// Continues after a block of words.
    #[inline]
    pub(crate) fn after_words<S: Source, K: Sink>(
        &mut self,
        (at, line): (Cursor, u32),
        kind: BlockKind,
        flow: Flow,
        source: &mut S,
        sink: &mut K,
    ) -> Result<Progress, Error> {
        let progress = match flow {
            Flow::More => Progress::More,
            Flow::Stopped => Progress::Stopped,
            Flow::Within { stopped } => {
                self.pending = Some((at, line, kind));
                return Ok(if stopped { Progress::Stopped } else { Progress::More });
            }
            Flow::Ended => return self.program_end(at, line, source, sink),
        };
        self.report_block_end(at, line, kind, sink);
        Ok(progress)
    }

    /// Continues a block that is not finished.
    #[inline(never)]
    fn resume_block<S: Source, K: Sink>(
        &mut self,
        (at, line, kind): (Cursor, u32, BlockKind),
        source: &mut S,
        sink: &mut K,
    ) -> Result<Progress, Error> {
        if let Some(stage) = self.modal.profile_stage() {
            return self.read_profile((at, line, kind), stage, source);
        }
        match self.modal.resume_block(&mut self.parameters.numbered, sink) {
            Ok(flow) => self.after_words((at, line), kind, flow, source, sink),
            Err(refusal) => self.refuse(at, line, refusal),
        }
    }

    /// Evaluates such a block and hands its words to the modes; `None` where they are M98 or M99.
    #[inline]
    fn evaluate_plain<K: Sink>(
        &mut self,
        at: Cursor,
        block: &Block,
        sink: &mut K,
    ) -> Result<Option<Flow>, Refusal> {
        let Some(code) = segment(&self.segments, at.segment) else { return Ok(Some(Flow::More)) };
        self.words.clear(block.line);
        self.evaluator.clear();
        self.evaluator.run(
            code.ops_of(block),
            &self.parameters,
            &self.modal,
            &self.compiler,
            &mut self.words,
        )?;
        let mut stopped = false;
        let first = self.compiler.choices.settings_first;
        if block.comment != NONE {
            let before = self.compiler.choices.message_old;
            if !before {
                self.evaluator.apply(&mut self.parameters);
            }
            let view = View {
                parameters: &self.parameters,
                modal: &self.modal,
                compiler: &self.compiler,
                segment: code,
            };
            let comment = usize::try_from(block.comment).ok();
            if let Some(comment) = comment.and_then(|place| code.comments.get(place)) {
                stopped = self.logs.perform(*comment, view, block.line, sink)?;
            }
            if !before {
                self.evaluator.postpone(&mut self.parameters);
            }
        }
        let called = self.words.m_count != 0
            && (self.words.has_m(98) || self.words.has_m(99))
            && self.modal.has_numbered_programs();
        if first || called || self.words.is_empty() {
            self.evaluator.apply(&mut self.parameters);
        }
        if self.words.is_empty() {
            if !block.bare {
                self.modal.execute_wordless(block.line, sink);
            }
            return Ok(Some(if stopped { Flow::Stopped } else { Flow::More }));
        }
        if called {
            return Ok(None);
        }
        let flow = self.modal.execute(&self.words, &mut self.parameters.numbered, sink)?;
        if !first {
            self.evaluator.apply(&mut self.parameters);
        }
        Ok(Some(match flow {
            Flow::More if stopped => Flow::Stopped,
            Flow::Within { .. } if stopped => Flow::Within { stopped },
            Flow::More | Flow::Stopped | Flow::Within { .. } | Flow::Ended => flow,
        }))
    }

    /// M2 or M30: the end, unless the file must have a second percent line.
    fn program_end<S: Source, K: Sink>(
        &mut self,
        at: Cursor,
        line: u32,
        source: &mut S,
        sink: &mut K,
    ) -> Result<Progress, Error> {
        let needed = self.compiler.choices.percent_needed && self.percent == Some(true);
        if needed && !self.percent_closed {
            loop {
                let percent = self.reader.next(source, |line, _| crate::syntax::is_percent(line));
                match percent? {
                    Some(true) => break,
                    Some(false) => {}
                    None => return Err(self.file_ended()),
                }
            }
        }
        self.leave_calls();
        self.report_block_end(at, line, BlockKind::End, sink);
        Ok(Progress::Ended(End::ProgramEnd))
    }

    /// Reads the next block of the main program into [`STREAM`]; the end where the file is over.
    #[inline]
    pub(crate) fn read_block<S: Source>(&mut self, source: &mut S) -> Result<Option<End>, Error> {
        loop {
            let Self { reader, segments, compiler, .. } = self;
            let Some(code) = segments.first_mut() else { return Ok(None) };
            code.clear();
            let taken = reader.next(source, |line, place| {
                let taken = compiler.compile_line(line, place, code);
                (taken, place, taken == LineKind::Nothing && line.trim_ascii().is_empty())
            })?;
            if compiler.limit_exceeded.is_some()
                || compiler.names.len() != self.parameters.named.covered()
            {
                self.finish_line(STREAM)?;
            }
            match taken {
                Some((LineKind::Block, ..)) => {
                    if self.percent.is_none() {
                        self.percent = Some(false);
                    }
                    return Ok(None);
                }
                Some((LineKind::Nothing, _, blank)) => {
                    if !blank && self.percent.is_none() {
                        self.percent = Some(false);
                    }
                }
                Some((LineKind::Percent, place, _)) => {
                    if let Some(end) = self.percent_line(place.line)? {
                        self.modal.end_run();
                        return Ok(Some(end));
                    }
                }
                None => return Err(self.file_ended()),
            }
        }
    }

    /// A line that holds a percent sign only (11.4.1): it begins the file, ends it, or belongs nowhere.
    pub(crate) fn percent_line(&mut self, line: u32) -> Result<Option<End>, Error> {
        match (self.percent, self.compiler.choices.percent_alone) {
            (None, _) => {
                self.percent = Some(true);
                Ok(None)
            }
            (Some(true), _) if planted(PlantedFault::PercentGoesOn) => Ok(None),
            (Some(true), _) | (Some(false), PercentAlone::Ends) => {
                self.percent_closed = true;
                Ok(Some(End::PercentEnd))
            }
            (Some(false), PercentAlone::Ignored) => Ok(None),
            (Some(false), PercentAlone::Refused) => {
                let message = "a percent line in a file that does not begin with one";
                Err(self.fault(STREAM, line, FaultKind::BadCharacter, message.into(), None))
            }
        }
    }

    /// Makes room for the names of a line, and fails when there are too many.
    pub(crate) fn finish_line(&mut self, segment: u32) -> Result<(), Error> {
        self.parameters.named.cover(&self.compiler.names);
        match self.compiler.limit_exceeded.take() {
            Some(limit) => Err(self.limit_exceeded(segment, limit)),
            None => Ok(()),
        }
    }

    /// Reports the end of a block to the sink.
    #[inline]
    pub(crate) fn report_block_end<K: Sink>(
        &mut self,
        at: Cursor,
        line: u32,
        kind: BlockKind,
        sink: &mut K,
    ) {
        let file = segment(&self.segments, at.segment).map_or(0, |code| code.file);
        let file = usize::try_from(file).ok().and_then(|file| self.files.get(file));
        sink.end_block(&mut BlockEnd {
            file: file.map_or(Program::MAIN, |file| file),
            line,
            kind,
            parameters: &mut self.parameters,
            modal: &self.modal,
            names: &self.compiler.names,
        });
    }
}
