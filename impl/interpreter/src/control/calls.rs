//! Calls and returns: by o-words (11.7.4, 11.7.9, 11.7.10), and by M98 and M99 (11.7.4.1).

use gaugeblock_vocabulary::{End, FaultKind};

use crate::block_end::BlockKind;
use crate::canon::Sink;
use crate::control::o_words::{ControlError, refuse};
use crate::control::{Cursor, Frame, FrameKind, PROGRAMS, STREAM};
use crate::error::Error;
use crate::faults::{PlantedFault, narrowed, planted};
use crate::interpret::{Interpreter, Progress, segment};
use crate::math;
use crate::modal::Refusal;
use crate::parameters::NameId;
use crate::quirks;
use crate::source::Source;
use crate::syntax::LinePlace;
use crate::syntax::bytecode::{Block, Keyword, NONE, OWord};

/// Deepest nesting of calls (11.7.4).
const LEVELS: usize = 10;
/// Letters that M98 takes.
const P_AND_L: u32 = 1 << (b'P' - b'A') | 1 << (b'L' - b'A');

impl Interpreter {
    /// The segment of a sub.
    #[inline]
    pub(super) fn segment_of(&self, label: NameId) -> Option<u32> {
        let place = usize::try_from(label).ok()?;
        self.subs.get(place).copied().filter(|segment| *segment != NONE)
    }

    fn set_segment(&mut self, label: NameId, segment: u32) {
        let Ok(place) = usize::try_from(label) else { return };
        if self.subs.len() <= place {
            self.subs.resize(place.saturating_add(1), NONE);
        }
        if let Some(slot) = self.subs.get_mut(place) {
            *slot = segment;
        }
    }

    /// A sub begins: its body is compiled, and execution continues after it.
    pub(crate) fn define_main_sub<S: Source>(
        &mut self,
        at: Cursor,
        block: &Block,
        label: NameId,
        source: &mut S,
    ) -> Result<(), ControlError> {
        if at.segment != STREAM {
            return refuse(FaultKind::NestedSub, "a sub within a sub");
        }
        if self.defined_lines.get(&label) == Some(&block.line) {
            // A jump back has passed here before.
            return Ok(self.skip_sub(label, source)?);
        }
        if self.segment_of(label).is_some() {
            return refuse(FaultKind::DuplicateSub, "the sub is defined twice");
        }
        let segment = self.compile_main_sub(block, label, source)?;
        self.defined_lines.insert(label, block.line);
        self.set_segment(label, segment);
        Ok(())
    }

    /// A sub among compiled blocks is defined when execution reaches it.
    pub(crate) fn define_sub(
        &mut self,
        at: Cursor,
        block: &Block,
        label: NameId,
        segment: u32,
    ) -> Result<(), Error> {
        if !self.call_stack.frames.is_empty() {
            let message = "a sub within a called program".into();
            return Err(self.fault(at.segment, block.line, FaultKind::NestedSub, message, None));
        }
        match self.segment_of(label) {
            Some(defined) if defined == segment => Ok(()),
            Some(_) if self.defined_lines.get(&label) == Some(&block.line) => Ok(()),
            Some(_) => {
                let message = "the sub is defined twice".into();
                Err(self.fault(at.segment, block.line, FaultKind::DuplicateSub, message, None))
            }
            None => {
                if let Some(line) =
                    crate::interpret::segment(&self.segments, segment).and_then(|code| code.inner)
                {
                    let message = "a sub within a sub".into();
                    return Err(self.fault(at.segment, line, FaultKind::NestedSub, message, None));
                }
                self.defined_lines.insert(label, block.line);
                self.set_segment(label, segment);
                Ok(())
            }
        }
    }

    /// `call`, with arguments.
    #[inline]
    pub(crate) fn call_sub<S: Source>(
        &mut self,
        at: Cursor,
        block: &Block,
        o_word: OWord,
        label: NameId,
        source: &mut S,
    ) -> Result<(), ControlError> {
        let segment = match self.segment_of(label) {
            Some(segment) => segment,
            None => {
                // The line is evaluated before the sub is searched for (11.4.5); the search may change values.
                self.evaluate_values(at, block, o_word)?;
                self.find_sub(label, source)?
            }
        };
        self.evaluate_values(at, block, o_word)?;
        if planted(PlantedFault::ArgumentsInPlace) {
            self.evaluate_in_place(at, block, o_word)?;
        }
        let entry = Cursor { segment, place: 0 };
        self.open_level(entry, FrameKind::Sub, label)?;
        #[cfg(feature = "faults")]
        if let Some(frame) = self.call_stack.frames.last_mut() {
            frame.passed = o_word.values;
        }
        if self.compiler.choices.emulates_rs274 {
            self.parameters.numbered.set_arguments(&quirks::UNPASSED);
        }
        if o_word.values == 0 && planted(PlantedFault::NoArgumentsZeroed) {
            self.parameters.numbered.set_arguments(&[0.0; 30]);
        }
        let first = if planted(PlantedFault::ArgumentsShifted) { 2 } else { 1_u32 };
        if planted(PlantedFault::LastArgumentLost) {
            self.evaluator.stack.truncate(29);
        }
        for (number, value) in (first..).zip(self.evaluator.stack.iter()) {
            self.parameters.numbered.set(number, *value);
        }
        self.parameters.value = 0.0;
        self.parameters.value_returned &= planted(PlantedFault::ReturnedFlagKept);
        Ok(())
    }

    /// A sub that has not been defined: in a file of its name, or in the other style.
    #[cold]
    fn find_sub<S: Source>(&mut self, label: NameId, source: &mut S) -> Result<u32, ControlError> {
        let mixed = "this number begins a numbered program, which M98 calls";
        if self.is_mdi() && self.previous_subs.contains(&label) {
            let why = "whether the subs of a program that has ended can be called by hand";
            return Err(ControlError::Refusal(Refusal::Unspecified(why.into())));
        }
        if let Some(segment) = self.compile_file_sub(label, source)? {
            self.set_segment(label, segment);
            return Ok(segment);
        }
        if self.compile_programs(None, source)?
            && self.programs.as_ref().is_some_and(|programs| programs.contains_key(&label))
        {
            return refuse(FaultKind::MixedStyles, mixed);
        }
        refuse(FaultKind::UnknownSub, "there is no such sub before this call, and no such file")
    }

    /// Calls the sub of a number without arguments, as an o-word would.
    pub(crate) fn call_by_number<S: Source>(
        &mut self,
        number: f64,
        source: &mut S,
    ) -> Result<(), ControlError> {
        let Some(label) = self.compiler.computed_label(number) else {
            return refuse(FaultKind::NotAnInteger, "an o-number is an integer");
        };
        let segment = match self.segment_of(label) {
            Some(segment) => segment,
            None => self.find_sub(label, source)?,
        };
        self.open_level(Cursor { segment, place: 0 }, FrameKind::Sub, label)?;
        if self.compiler.choices.emulates_rs274 {
            self.parameters.numbered.set_arguments(&quirks::UNPASSED);
        }
        self.parameters.value = 0.0;
        self.parameters.value_returned = false;
        Ok(())
    }

    /// Opens a call level.
    #[inline]
    fn open_level(
        &mut self,
        entry: Cursor,
        kind: FrameKind,
        label: NameId,
    ) -> Result<(), ControlError> {
        let most = usize::try_from(self.limits.call_depth).unwrap_or(LEVELS).min(LEVELS);
        let most = most.saturating_add(usize::from(planted(PlantedFault::ElevenLevels)));
        if self.call_stack.frames.len() >= most {
            return refuse(FaultKind::TooManyLevels, "calls are nested too deep");
        }
        let shared = self.compiler.choices.locals_shared && kind != FrameKind::Sub;
        let named = &mut self.parameters.named;
        let shared = shared || planted(PlantedFault::LocalsInherited);
        let mark = if shared { named.share() } else { named.enter() };
        let frame = Frame {
            kind,
            label,
            back: self.cursor,
            arguments: self.parameters.numbered.arguments(),
            #[cfg(feature = "faults")]
            passed: 0,
            mark,
            definitions: self.call_stack.definitions(),
        };
        self.call_stack.frames.push(frame);
        self.parameters.call_level = self.parameters.call_level.saturating_add(1);
        self.modal.enter_call();
        self.cursor = entry;
        Ok(())
    }

    /// Closes the innermost call level.
    #[inline]
    fn close_level<K: Sink>(&mut self, frame: &Frame, line: u32, sink: &mut K) {
        self.modal.leave_call(&mut self.parameters.numbered, sink, line);
        self.parameters.named.leave(frame.mark);
        self.call_stack.forget_definitions(frame.definitions);
        self.call_stack.frames.pop();
        self.parameters.call_level = self.parameters.call_level.saturating_sub(1);
    }

    /// The run is over, and every call with it: `#1` to `#30` and local names are those of the main program, which
    /// numbered subprograms share. Nothing is restored besides: that is for a return (11.6.22).
    pub(crate) fn leave_calls(&mut self) {
        let first = self.call_stack.frames.iter().find(|frame| frame.kind == FrameKind::Sub);
        if let Some(arguments) = first.map(|frame| frame.arguments) {
            self.parameters.numbered.set_arguments(&arguments);
        }
        while let Some(frame) = self.call_stack.frames.pop() {
            self.parameters.named.leave(frame.mark);
        }
        self.parameters.call_level = 0;
    }

    /// Restores of `#1` to `#30` only those that the call has passed: a planted fault.
    #[inline]
    fn restore_passed(&mut self, frame: &Frame) {
        let mut arguments = self.parameters.numbered.arguments();
        let passed = frame.passed();
        for (argument, before) in arguments.iter_mut().zip(frame.arguments).take(passed) {
            *argument = before;
        }
        self.parameters.numbered.set_arguments(&arguments);
    }

    /// Evaluates arguments as if each were set before the next one is evaluated: a planted fault.
    #[inline]
    fn evaluate_in_place(
        &mut self,
        at: Cursor,
        block: &Block,
        o_word: OWord,
    ) -> Result<(), ControlError> {
        let before = self.parameters.numbered.arguments();
        let mut result = Ok(());
        for number in 1..=u32::from(o_word.values) {
            result = self.evaluate_values(at, block, o_word);
            let place = usize::try_from(number).unwrap_or(1).wrapping_sub(1);
            let value = self.evaluator.stack.get(place).copied().unwrap_or(0.0);
            self.parameters.numbered.replace(number, value);
        }
        let arguments = self.parameters.numbered.arguments();
        self.parameters.numbered.set_arguments(&before);
        result?;
        self.evaluator.stack.clear();
        self.evaluator.stack.extend(arguments.iter().take(usize::from(o_word.values)));
        Ok(())
    }

    /// `return` and `endsub`, with a value or without.
    #[inline]
    pub(crate) fn leave_sub<K: Sink>(
        &mut self,
        at: Cursor,
        block: &Block,
        o_word: OWord,
        label: NameId,
        sink: &mut K,
    ) -> Result<(), ControlError> {
        let Some(frame) = self.call_stack.frames.last().copied() else {
            return refuse(FaultKind::OutsideSub, "no sub is being executed");
        };
        if frame.kind != FrameKind::Sub {
            return refuse(FaultKind::MixedStyles, "a numbered program ends with M99");
        }
        let own = o_word.keyword == Keyword::EndSub || self.compiler.choices.return_own;
        if own && label != frame.label {
            return refuse(FaultKind::UnknownLabel, "this is not the number of the sub");
        }
        self.evaluate_values(at, block, o_word)?;
        let value = self.evaluator.stack.first().copied();
        let kept = if planted(PlantedFault::ValueLost) { None } else { value };
        self.parameters.value = kept.unwrap_or(0.0);
        self.parameters.value_returned = value.is_some();
        if o_word.keyword == Keyword::Return && planted(PlantedFault::ReturnKeeps) {
            self.modal.forget_autorestore();
        }
        self.close_level(&frame, block.line, sink);
        if planted(PlantedFault::OnlyPassedRestored) {
            self.restore_passed(&frame);
        } else if !planted(PlantedFault::ArgumentsKept) {
            self.parameters.numbered.set_arguments(&frame.arguments);
        }
        self.cursor = frame.back;
        Ok(())
    }

    /// A block with M98 or M99.
    pub(crate) fn numbered_call<S: Source, K: Sink>(
        &mut self,
        at: Cursor,
        block: &Block,
        source: &mut S,
        sink: &mut K,
    ) -> Result<Progress, Error> {
        let (kind, result) = if self.words.has_m(98) {
            (BlockKind::NumberedCall, self.call_numbered(at, block, source))
        } else {
            (BlockKind::NumberedReturn, self.return_numbered(block, sink))
        };
        match result {
            Ok(progress) => {
                self.report_block_end(at, block.line, kind, sink);
                Ok(progress)
            }
            Err(ControlError::Refusal(refusal)) => self.roll_back(at, block.line, refusal),
            Err(ControlError::Error(error)) => {
                self.evaluator.roll_back(&mut self.parameters);
                Err(error)
            }
        }
    }

    /// Refuses a block that has other words than M98 or M99 and the letters that it takes.
    fn check_no_other_words(&self, letters: u32) -> Result<(), ControlError> {
        if !self.machine.fanuc_subs && !planted(PlantedFault::DisabledFanuc) {
            return refuse(FaultKind::FanucDisabled, "M98 and M99 are disabled");
        }
        let words = &self.words;
        if words.g_count != 0 || words.m_count != 1 {
            return refuse(FaultKind::BadBlock, "another code in a block with M98 or M99");
        }
        let signs = words.dollar.is_some() || words.at.is_some() || words.caret.is_some();
        if words.present & !letters != 0 || signs {
            return refuse(FaultKind::UnusedWord, "a word that M98 or M99 does not use");
        }
        Ok(())
    }

    /// M98 P L.
    fn call_numbered<S: Source>(
        &mut self,
        at: Cursor,
        block: &Block,
        source: &mut S,
    ) -> Result<Progress, ControlError> {
        self.check_no_other_words(P_AND_L)?;
        let Some(number) = self.words.get(b'P') else {
            return refuse(FaultKind::MissingWord, "M98 needs P");
        };
        let number = narrowed(PlantedFault::SubprogramWraps, count(number)?, 65_536.0);
        let turns = math::to_count(count(self.words.get(b'L').unwrap_or(1.0))?);
        let turns = if planted(PlantedFault::ZeroIsOnce) { turns.max(1) } else { turns };
        if turns == 0 && self.compiler.choices.uncalled_free {
            return Ok(Progress::More);
        }
        let label = self.compiler.computed_label(number).unwrap_or(NONE);
        let entry = self.find_program(label, (at, block), turns != 0, source)?;
        if turns == 0 {
            return Ok(Progress::More);
        }
        let left = match turns {
            _ if planted(PlantedFault::NoRepeat) => 0,
            turns if planted(PlantedFault::OneTurnMore) => turns,
            turns => turns.saturating_sub(1),
        };
        let kind = FrameKind::Numbered { left, entry };
        self.open_level(Cursor { segment: PROGRAMS, place: entry }, kind, label)?;
        if !self.compiler.choices.value_kept {
            self.parameters.value = 0.0;
            self.parameters.value_returned = false;
        }
        Ok(Progress::More)
    }

    /// Where a numbered subprogram begins; it must follow the call. `called` says whether it is called now.
    fn find_program<S: Source>(
        &mut self,
        label: NameId,
        (at, block): (Cursor, &Block),
        called: bool,
        source: &mut S,
    ) -> Result<u32, ControlError> {
        let mixed = "this number is that of a sub, which an o-word calls";
        if self.segment_of(label).is_some() {
            return refuse(FaultKind::MixedStyles, mixed);
        }
        // Numbered programs are looked for in the main program alone, and it must follow the call in its file.
        if segment(&self.segments, at.segment).is_some_and(|code| code.file != 0) {
            return refuse(
                FaultKind::UnknownSub,
                "no numbered program follows this call in its file",
            );
        }
        let call = LinePlace { line: block.line, offset: block.offset };
        if !self.compile_programs((at.segment != STREAM).then_some(call), source)? {
            let what = "M98 in a source that cannot go back";
            return Err(ControlError::Refusal(Refusal::Unsupported(what.into())));
        }
        let call_itself = self.compiler.choices.call_itself;
        let found = self.programs.as_mut().and_then(|programs| programs.get_mut(&label));
        match found {
            Some(program) if planted(PlantedFault::EarlierCalled) => Ok(program.entry),
            Some(program) if program.line > block.line || program.called && call_itself => {
                program.called |= called;
                Ok(program.entry)
            }
            None if self.subs_ahead.contains(&label) => refuse(FaultKind::MixedStyles, mixed),
            Some(_) | None => {
                refuse(FaultKind::UnknownSub, "no such numbered program follows this call")
            }
        }
    }

    /// M99: the next turn, back to the caller, or, in the main program, for ever from the beginning.
    fn return_numbered<K: Sink>(
        &mut self,
        block: &Block,
        sink: &mut K,
    ) -> Result<Progress, ControlError> {
        self.check_no_other_words(0)?;
        let Some(frame) = self.call_stack.frames.last().copied() else {
            return Ok(Progress::Ended(End::Endless));
        };
        let FrameKind::Numbered { left, entry } = frame.kind else {
            if planted(PlantedFault::ReturnEndsSub) {
                self.close_level(&frame, block.line, sink);
                self.parameters.numbered.set_arguments(&frame.arguments);
                self.cursor = frame.back;
                return Ok(Progress::More);
            }
            return refuse(FaultKind::MixedStyles, "a sub ends with endsub");
        };
        self.close_level(&frame, block.line, sink);
        if planted(PlantedFault::ThirtiethLocal) {
            let [.., last] = frame.arguments;
            self.parameters.numbered.set(30, last);
        }
        self.cursor = frame.back;
        if let Some(left) = left.checked_sub(1) {
            let kind = FrameKind::Numbered { left, entry };
            self.open_level(Cursor { segment: PROGRAMS, place: entry }, kind, frame.label)?;
        }
        Ok(Progress::More)
    }
}

/// A number of a program or of turns: a whole number of any size.
fn count(value: f64) -> Result<f64, ControlError> {
    let number = math::round_even(value);
    if (number - value).abs() > math::CLOSE || !number.is_finite() {
        return refuse(FaultKind::NotAnInteger, "P and L of M98 are integers");
    }
    if number < 0.0 {
        return refuse(FaultKind::WordOutOfRange, "P and L of M98 are not negative");
    }
    Ok(number)
}
