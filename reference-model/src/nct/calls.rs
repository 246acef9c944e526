//! Macro calls, modal calls, subprograms, returns.

use gaugeblock_vocabulary::{End, FaultKind};

use super::evaluate::rounded;
use super::frames::{Frame, Kind, ModalCall, Reach};
use super::refusal::{StepError, open, refuse, refuse_form};
use super::state::{Flow, Run};
use super::variables::Locals;
use super::words::{Words, word};
use crate::ids::{Rule, choice, rule};

/// Most repetitions of a call.
const MOST_REPEATS: u32 = 9999;

/// G65.
pub(super) const CALL: i64 = 650;
/// G66.
pub(super) const AFTER_MOTION: i64 = 660;
/// G66.1.
pub(super) const BY_BLOCK: i64 = 661;
/// G67.
pub(super) const CANCEL: i64 = 670;

impl Run<'_> {
    /// Whether a block with this code is a call or cancels one.
    pub(super) fn is_call(code: i64) -> bool {
        matches!(code, CALL | AFTER_MOTION | BY_BLOCK | CANCEL)
    }

    /// G65, G66, G66.1 and G67.
    pub(super) fn call_block(&mut self, codes: &[i64], words: &Words) -> Result<Flow, StepError> {
        if codes.iter().filter(|code| Self::is_call(**code)).count() > 1 {
            return Err(refuse_form(FaultKind::ModalConflict, "two codes of calls"));
        }
        let code = *codes.iter().find(|code| Self::is_call(**code)).expect("calls: it has one");
        if code == CANCEL {
            if words.len() > 1 {
                return Err(open("G67 with other words"));
            }
            self.cancel()?;
            return Ok(Flow::On);
        }
        if words.first().is_none_or(|(letter, _)| *letter != 'G') || codes.first() != Some(&code) {
            let message = "a word before the code of the call";
            return Err(refuse(rule::nct::ARGUMENTS, FaultKind::Macro, message));
        }
        let rule = if code == CALL { rule::nct::CALL } else { rule::nct::MODAL_CALL };
        let program = self.called_program(rule, words)?;
        let repeats = self.repeats(words)?;
        let of_call = |letter: char| matches!(letter, 'P' | 'L');
        let arguments: Words =
            words[1..].iter().copied().filter(|(letter, _)| !of_call(*letter)).collect();
        if code == BY_BLOCK && !arguments.is_empty() {
            return Err(open("arguments in the block of G66.1"));
        }
        let arguments = self.arguments(&arguments, false)?;
        if code == CALL {
            let reach = match self.reached()? {
                0 if self.modal_calls.is_empty() => Reach::All,
                0 => Reach::First(0),
                _ => Reach::Open,
            };
            self.enter(program, repeats, arguments, reach)?;
            self.coverage.accepted(rule::nct::CALL);
        } else {
            let by_block = code == BY_BLOCK;
            self.begin_modal(ModalCall { program, repeats, arguments, by_block })?;
        }
        Ok(Flow::On)
    }

    /// Rule nct.modal-call. The block of a modal call stores the arguments, and calls nothing itself.
    fn begin_modal(&mut self, call: ModalCall) -> Result<(), StepError> {
        self.may_change_modal_calls()?;
        if self.modal_calls.last().is_some_and(|last| last.by_block != call.by_block) {
            return Err(open("G66 and G66.1 in force together"));
        }
        let rule = if call.by_block { rule::nct::BLOCK_LAST_FIRST } else { rule::nct::MODAL_CALL };
        self.coverage.accepted(rule);
        self.modal_calls.push(call);
        Ok(())
    }

    /// Rule nct.cancel-last. G67 cancels the modal call that was commanded last.
    /// Rule nct.cancel-earlier. A further one cancels the one before it.
    /// Choice nct.cancel-without-call.
    fn cancel(&mut self) -> Result<(), StepError> {
        self.may_change_modal_calls()?;
        let rule = match self.modal_calls.pop() {
            Some(_) if self.modal_calls.is_empty() => rule::nct::CANCEL_EARLIER,
            Some(_) => rule::nct::CANCEL_LAST,
            None if self.choices.is(choice::nct::CancelWithoutCall::Refused) => {
                let message = "G67 without a modal call";
                return Err(refuse(rule::nct::CANCEL_NOTHING, FaultKind::Macro, message));
            }
            None => rule::nct::CANCEL_NOTHING,
        };
        self.coverage.accepted(rule);
        Ok(())
    }

    fn may_change_modal_calls(&self) -> Result<(), StepError> {
        if self.frame().reach == Reach::All {
            return Ok(());
        }
        Err(open("G66, G66.1 or G67 in a macro that is called while a modal call is in force"))
    }

    /// The number of the program that a block calls. Whether there is one shows when it begins.
    pub(super) fn called_program(&mut self, rule: Rule, words: &Words) -> Result<i64, StepError> {
        let message = "a call without P";
        let program =
            word(words, 'P').ok_or_else(|| refuse(rule, FaultKind::MissingWord, message))?;
        self.once(words, 'P')?;
        Ok(rounded(program))
    }

    /// Rule nct.repeat. L says how often, from 1 to 9999; without it, once.
    pub(super) fn repeats(&mut self, words: &Words) -> Result<u32, StepError> {
        let Some(repeats) = word(words, 'L') else { return Ok(1) };
        self.once(words, 'L')?;
        let rule = rule::nct::REPEAT;
        let number = u32::try_from(rounded(repeats)).ok();
        let number = number.filter(|number| (1..=MOST_REPEATS).contains(number));
        let message = format!("L{repeats} is not from 1 to {MOST_REPEATS}");
        let number = number.ok_or_else(|| refuse(rule, FaultKind::WordOutOfRange, message))?;
        self.coverage.accepted(rule);
        Ok(number)
    }

    fn once(&self, words: &Words, letter: char) -> Result<(), StepError> {
        if words.iter().filter(|(other, _)| *other == letter).count() > 1 {
            return Err(refuse_form(FaultKind::RepeatedWord, format!("{letter} occurs twice")));
        }
        Ok(())
    }

    /// A macro begins.
    ///
    /// Rule nct.level-rises. It is one level above the program that calls it. Rule nct.stored-on-call. The local
    /// variables of that program are stored; those of the macro are the arguments, and others are vacant. Rule
    /// nct.level-limit. Choice nct.depth: how many levels there are.
    pub(super) fn enter(
        &mut self,
        program: i64,
        repeats: u32,
        arguments: Locals,
        reach: Reach,
    ) -> Result<(), StepError> {
        let most = if self.choices.is(choice::nct::Depth::Five) { 5 } else { 4 };
        if self.variables.level() >= most {
            let message = format!("more than {most} macro levels");
            return Err(refuse(rule::nct::LEVEL_LIMIT, FaultKind::TooManyLevels, message));
        }
        self.begin_program(program, repeats, Kind::Macro(Box::new(arguments)), reach)?;
        let level = self.variables.level();
        self.variables.levels.push(arguments);
        let rules: &[Rule] = match level {
            0 => &[rule::nct::LEVEL_RISES, rule::nct::STORED_ON_CALL],
            _ => &[
                rule::nct::LEVEL_RISES,
                rule::nct::STORED_ON_CALL,
                rule::nct::STORED_AT_EACH_LEVEL,
            ],
        };
        rules.iter().for_each(|rule| self.coverage.accepted(*rule));
        if level + 1 == most {
            self.coverage.accepted(rule::nct::LEVEL_LIMIT);
            self.coverage.accepted(rule::nct::FIVE_SETS);
        }
        if self.variables.common.iter().any(Option::is_some) {
            self.coverage.accepted(rule::nct::COMMON);
        }
        Ok(())
    }

    fn begin_program(
        &mut self,
        program: i64,
        repeats: u32,
        kind: Kind,
        reach: Reach,
    ) -> Result<(), StepError> {
        let program = self.programs.find(program)?;
        let most = if self.choices.is(choice::nct::Depth::Five) { 15 } else { 8 };
        if self.frames.len() > most {
            let message = format!("more than {most} calls within each other");
            return Err(refuse(rule::nct::LEVEL_LIMIT, FaultKind::TooManyLevels, message));
        }
        let modal_calls = self.modal_calls.len();
        self.frames.push(Frame { program, next: 0, kind, repeats, reach, modal_calls });
        Ok(())
    }

    /// Rule nct.sub-call. M98 calls a subprogram at the level that it stands at: it shares the local variables.
    pub(super) fn call_sub(&mut self, words: &Words) -> Result<(), StepError> {
        let program = self.called_program(rule::nct::SUB_CALL, words)?;
        let repeats = self.repeats(words)?;
        let reach = self.frame().reach;
        self.begin_program(program, repeats, Kind::Sub, reach)?;
        self.coverage.accepted(rule::nct::SUB_CALL);
        Ok(())
    }

    /// How many modal calls the blocks of the program in progress reach.
    pub(super) fn reached(&self) -> Result<usize, StepError> {
        match self.frame().reach {
            Reach::All => Ok(self.modal_calls.len()),
            Reach::First(count) => Ok(count),
            Reach::Open => {
                Err(open("a block that reaches a modal call, in a macro that G65 calls"))
            }
        }
    }

    /// How many modal calls a motion reaches: those by block are called in place of a block, and by nothing else.
    pub(super) fn reached_by_motion(&self) -> Result<usize, StepError> {
        if self.calls_by_block() { Ok(0) } else { self.reached() }
    }

    /// Whether the modal calls in force take blocks as arguments.
    pub(super) fn calls_by_block(&self) -> bool {
        self.modal_calls.last().is_some_and(|call| call.by_block)
    }

    /// After a motion, or in place of a block: the last of the modal calls that the block reaches.
    ///
    /// Rule nct.modal-order. The macro's own blocks reach those that were commanded before it.
    pub(super) fn call_modal(
        &mut self,
        reached: usize,
        block: Option<&Words>,
    ) -> Result<(), StepError> {
        let call = self.modal_calls[reached - 1].clone();
        let arguments = match block {
            Some(words) => self.arguments(words, true)?,
            None => call.arguments,
        };
        self.enter(call.program, call.repeats, arguments, Reach::First(reached - 1))?;
        let in_macro = self.frames.len() > 2 && matches!(self.frames[1].kind, Kind::Macro(_));
        let rule = match (block, in_macro) {
            (Some(_), false) => rule::nct::BLOCK_LAST_FIRST,
            (Some(_), true) => rule::nct::BLOCK_THEN_EARLIER,
            (None, false) => rule::nct::MODAL_CALL,
            (None, true) => rule::nct::MODAL_ORDER,
        };
        self.coverage.accepted(rule);
        self.coverage.accepted(rule::nct::MODAL_LEVELS);
        Ok(())
    }

    /// M99: once more from the beginning, or back behind the call, or to a block of the calling program.
    ///
    /// Rule nct.restored. The local variables of the calling program are what they were when it called.
    /// Rule nct.return-to. With P it goes on at the block of that number.
    pub(super) fn go_back(&mut self, words: &Words) -> Result<Flow, StepError> {
        let to = self.return_block(words)?;
        let frame = self.frames.last_mut().expect("calls: the main program is in progress");
        if frame.modal_calls != self.modal_calls.len() && !matches!(frame.kind, Kind::Main) {
            return Err(open(
                "a modal call that the program commanded, or cancelled, and returns with",
            ));
        }
        if frame.repeats > 1 {
            if to.is_some() {
                return Err(open("M99 with P in a call that is to be repeated"));
            }
            frame.repeats -= 1;
            frame.next = 0;
            if let (true, Kind::Macro(arguments)) =
                (self.choices.is(choice::nct::RepeatedLocals::Reloaded), &frame.kind)
            {
                *self.variables.locals() = **arguments;
            }
            return Ok(Flow::On);
        }
        match frame.kind {
            Kind::Main => return self.main_return(to),
            Kind::Sub => {}
            Kind::Macro(_) => {
                self.variables.levels.pop();
                self.coverage.accepted(rule::nct::RESTORED);
                self.coverage.accepted(rule::nct::ANY_BODY);
            }
        }
        self.frames.pop();
        if let Some(to) = to {
            self.jump(to, rule::nct::RETURN_TO)?;
        }
        Ok(Flow::On)
    }

    fn return_block(&mut self, words: &Words) -> Result<Option<i64>, StepError> {
        let Some(to) = word(words, 'P') else { return Ok(None) };
        self.once(words, 'P')?;
        Ok(Some(rounded(to)))
    }

    /// Choice nct.main-return.
    fn main_return(&mut self, to: Option<i64>) -> Result<Flow, StepError> {
        let rule = rule::nct::MAIN_RETURN;
        if self.choices.is(choice::nct::MainReturn::Refused) {
            return Err(refuse(rule, FaultKind::OutsideSub, "M99 in the main program"));
        }
        self.coverage.accepted(rule);
        match to {
            Some(to) => self.jump(to, rule).map(|()| Flow::On),
            None if self.turns == End::TURNS => Ok(Flow::Endless),
            None => {
                self.turns += 1;
                self.frames.last_mut().expect("calls: the main program is in progress").next = 0;
                Ok(Flow::On)
            }
        }
    }

    /// The program in progress goes on at the block of a sequence number.
    pub(super) fn jump(&mut self, to: i64, rule: Rule) -> Result<(), StepError> {
        let frame = self.frames.last_mut().expect("calls: the main program is in progress");
        // The block that jumps, or that called, stands before the next one.
        let from = frame.next.saturating_sub(1);
        frame.next = self.programs.all[frame.program].find(to, from, rule)?;
        self.coverage.accepted(rule);
        Ok(())
    }

    pub(super) fn frame(&self) -> &Frame {
        self.frames.last().expect("calls: the main program is in progress")
    }
}
