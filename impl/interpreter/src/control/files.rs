//! Compiles code from elsewhere: the sub of a file, and the numbered subprograms that follow in the main program.

use alloc::collections::BTreeMap;
use alloc::string::String;

use gaugeblock_vocabulary::FaultKind;

use crate::control::compile::{Bad, Ends, Next, refuse_endless};
use crate::control::o_words::{ControlError, refuse};
use crate::control::{PROGRAMS, Reader};
use crate::error::Error;
use crate::interpret::{Interpreter, NumberedProgram, segment};
use crate::parameters::NameId;
use crate::source::Source;
use crate::syntax::bytecode::{Block, Keyword, Kind, NONE, OWord};
use crate::syntax::{CodeSegment, LinePlace};

impl Interpreter {
    /// Compiles the sub of a file of its name (11.7.9); none where there is no such file or sub.
    ///
    /// # Errors
    /// The file cannot be read, or the sub cannot be compiled.
    pub(crate) fn compile_file_sub<S: Source>(
        &mut self,
        label: NameId,
        source: &mut S,
    ) -> Result<Option<u32>, ControlError> {
        let name = self.compiler.labels.name(label);
        // The name of a file, and never a way to another folder.
        let leads_away = |byte: u8| matches!(byte, b'/' | b'\\');
        if name.is_empty() || name.starts_with('.') || name.bytes().any(leads_away) {
            return Ok(None);
        }
        let mut name = String::from(name);
        name.push_str(".ngc");
        if !source.open(&name).map_err(Error::from)? {
            return Ok(None);
        }
        let file = u32::try_from(self.files.len()).unwrap_or(NONE);
        self.files.push(name);
        let caller = core::mem::replace(&mut self.reader, Reader::new());
        let percents = (self.percent.take(), self.percent_closed);
        let found = self.read_file(label, file, source);
        (self.percent, self.percent_closed) = percents;
        self.reader = caller;
        source.close();
        found
    }

    /// Reads a file for the one sub that it may hold.
    fn read_file<S: Source>(
        &mut self,
        label: NameId,
        file: u32,
        source: &mut S,
    ) -> Result<Option<u32>, ControlError> {
        let mut found = None;
        let mut code = CodeSegment { file, ..CodeSegment::default() };
        loop {
            code.clear();
            match self.compile_next(source, &mut code)? {
                Next::Over => return Ok(found),
                Next::Percent(place) => {
                    // What is refused outside of its sub is never executed.
                    if let Ok(Some(_)) = self.percent_line(place.line) {
                        return Ok(found);
                    }
                }
                Next::Nothing => {}
                Next::Block(block) => {
                    // A program end that is not executed ends nothing.
                    match block.kind {
                        Kind::Control(OWord { keyword: Keyword::Sub, label: other, .. }) => {
                            if found.is_some() || other != label {
                                if self.compiler.choices.emulates_rs274 {
                                    continue;
                                }
                                return refuse(
                                    FaultKind::BadFile,
                                    "a file holds one sub, of its own name",
                                );
                            }
                            found = Some(self.compile_sub_in_file(&block, label, file, source)?);
                        }
                        Kind::Control(_)
                        | Kind::Plain
                        | Kind::Definition { .. }
                        | Kind::Percent => {}
                    }
                }
            }
        }
    }

    /// Compiles a sub of a file; its faults have their places there.
    fn compile_sub_in_file<S: Source>(
        &mut self,
        head: &Block,
        label: NameId,
        file: u32,
        source: &mut S,
    ) -> Result<u32, Error> {
        let (line, kind, message) = match self.compile_sub(label, file, source, false)? {
            Ok(segment) => return Ok(segment),
            Err(Bad::Nested(line)) => (line, FaultKind::NestedSub, "a sub within a sub"),
            Err(Bad::Endless) => (head.line, FaultKind::UnknownLabel, "the sub does not end"),
        };
        let number = u32::try_from(self.segments.len()).unwrap_or(NONE);
        self.segments.push(CodeSegment { file, ..CodeSegment::default() });
        Err(self.fault(number, line, kind, message.into(), None))
    }

    /// Where a sub begins among numbered subprograms, it gets a segment of its own. One that does not end holds
    /// nothing: what follows its head can begin a program. That none ends is found out once, so that the text is not
    /// read again for each.
    fn compile_called_sub<S: Source>(
        &mut self,
        head: &Block,
        ends: &mut Option<Ends>,
        source: &mut S,
        code: &mut CodeSegment,
    ) -> Result<bool, Error> {
        if let (Some(ends), Kind::Control(OWord { keyword: Keyword::Sub, label, .. })) =
            (ends.as_ref(), head.kind)
            && !ends.end(label, head.line)
        {
            refuse_endless(code);
            return Ok(false);
        }
        let body = self.reader.place();
        let is_sub = self.compile_inner_sub(head, source, code)?;
        if !is_sub {
            self.rewind(source, body)?;
            *ends = Some(self.ends(code.file, source)?);
            self.rewind(source, body)?;
        }
        Ok(is_sub)
    }

    /// Looks for the numbered subprograms in what follows of the main program (11.7.4.1), once, and compiles them
    /// together, since one that does not end runs into the next. False where the source cannot go back.
    ///
    /// They follow the call. A call within a loop or sub is before the reader's place.
    pub(crate) fn compile_programs<S: Source>(
        &mut self,
        call: Option<LinePlace>,
        source: &mut S,
    ) -> Result<bool, Error> {
        if self.programs.is_some() {
            return Ok(true);
        }
        let (here, closed) = (self.reader.place(), self.percent_closed);
        if let Some(call) = call
            && !self.rewind(source, call)?
        {
            return Ok(false);
        }
        let mut code = CodeSegment::default();
        let (mut programs, mut ends) = (BTreeMap::new(), None);
        loop {
            if programs.is_empty() {
                code.clear();
            }
            match self.compile_next_of(source, &mut code, programs.is_empty())? {
                Next::Over => break,
                Next::Nothing => {}
                Next::Percent(place) => {
                    if self.add_percent_line(place, &mut code) {
                        break;
                    }
                }
                Next::Block(Block {
                    kind: Kind::Control(OWord { keyword: Keyword::Program, label, .. }),
                    line,
                    // Together with anything else a number does not begin a program: the line is refused.
                    refused: NONE,
                    ..
                }) => {
                    let entry = u32::try_from(code.blocks.len()).unwrap_or(NONE);
                    let begun = NumberedProgram { entry, line, called: false };
                    programs.entry(label).or_insert(begun);
                }
                Next::Block(block) => {
                    if self.compile_called_sub(&block, &mut ends, source, &mut code)?
                        && block.refused == NONE
                        && let Some(Block { kind: Kind::Definition { label, segment: at }, .. }) =
                            code.blocks.last()
                        && segment(&self.segments, *at).is_some_and(|code| code.inner.is_none())
                    {
                        self.subs_ahead.push(*label);
                    }
                }
            }
            self.check_size(&code)?;
        }
        code.join_labels();
        self.code_bytes = self.code_bytes.saturating_add(code.bytes());
        if let Some(slot) = usize::try_from(PROGRAMS).ok().and_then(|at| self.segments.get_mut(at))
        {
            *slot = code;
        }
        self.programs = Some(programs);
        let back = self.rewind(source, here)?;
        self.percent_closed = closed;
        Ok(back)
    }
}
