//! The program, block after block: parsed, evaluated, checked, executed, recorded.

use std::sync::Arc;

use gaugeblock_vocabulary::{End, FaultKind};

use super::{ModelRun, Record};
use crate::ids::{choice, rule};
use crate::rs274::control::{self, Control, MAIN, Next};
use crate::rs274::environment::stub;
use crate::rs274::evaluate::{self, Words};
use crate::rs274::order::{AfterPhase, Phase, Phases};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::syntax::Keyword;
use crate::rs274::text::Line;
use crate::rs274::{check, execute, order, syntax};

impl ModelRun<'_> {
    /// The next line of the program.
    ///
    /// Rule program-end.percent. The second percent line ends the run and does nothing else: it is not a program end.
    pub(super) fn next(&mut self) -> Result<Option<End>, StepError> {
        let place = self.control.place;
        self.state.line = place.line;
        let source = Arc::clone(self.control.files.source(place.file));
        let text = match self.control.files.line_of(&source, place.line, &mut self.state) {
            Some(Line::Block(text)) => text,
            Some(Line::Nothing) => {
                self.control.place.line += 1;
                return Ok(None);
            }
            Some(Line::Skipped(text)) => {
                self.state.dialect().pass_over_skipped(text, &mut self.state)?;
                self.control.place.line += 1;
                return Ok(None);
            }
            Some(Line::End) if self.state.call_level() > 0 => {
                self.between()?;
                let why = "a percent line that is reached in a subroutine".to_owned();
                return Err(StepError::Unspecified(why));
            }
            Some(Line::End) if self.by_hand => {
                return Err(StepError::Unspecified("a percent sign, entered by hand".to_owned()));
            }
            Some(Line::End) => {
                self.between()?;
                self.state.coverage.accepted(rule::program_end::PERCENT);
                if self.record.waits() {
                    let why =
                        "where the machine is after a percent sign while a compensated move waits";
                    return Err(StepError::Unspecified(why.to_owned()));
                }
                execute::compensation::end_of_run(&mut self.state);
                self.over();
                return Ok(Some(End::PercentEnd));
            }
            None => {
                self.between()?;
                return Err(self.missing_end());
            }
        };
        match self.block(text)? {
            Next::Following => self.control.place.line += 1,
            Next::At(place) => self.control.place = place,
            Next::End(End::Endless) if self.record.waits() => {
                let why = "M99 in the main program while a compensated move waits".to_owned();
                return Err(StepError::Unspecified(why));
            }
            Next::End(End::Endless) if !self.ahead && self.is_repeated() => {
                self.read_from_the_beginning();
            }
            Next::End(end) => return Ok(Some(end)),
        }
        Ok(None)
    }

    /// Whether M99 repeats the main program: while operator events are left, and then up to a fixed number of turns.
    fn is_repeated(&mut self) -> bool {
        if self.operator.is_done() {
            self.turns += 1;
        }
        self.turns < End::TURNS
    }

    /// Rules program-end.missing, text.percent-unclosed. The file has ended, the program has not.
    ///
    /// Rule subroutines.missing-endsub. Nor has a sub that began in it.
    pub(super) fn missing_end(&self) -> StepError {
        if self.state.frame().is_sub() {
            let message = "the file ends without an endsub";
            return refuse(rule::subroutines::MISSING_ENDSUB, FaultKind::MissingEnd, message);
        }
        let source = self.control.files.source(self.control.place.file);
        if source.percent {
            return source.unclosed();
        }
        let message = "the file ends without M2 or M30";
        refuse(rule::program_end::MISSING, FaultKind::MissingEnd, message)
    }

    /// One block: parsed, evaluated, checked, executed, recorded.
    fn block(&mut self, text: &str) -> Result<Next, StepError> {
        let place = self.control.files.block(self.control.place);
        self.begins(&place)?;
        let block = syntax::parse(text, &mut self.state)?;
        if let Some(word) = &block.o_word {
            self.by_hand_only(word.keyword == Keyword::Call, "an O-word other than call")?;
            self.is_within_block = true;
            let next = self.control.o_word(&block, word, &mut self.state, &mut self.record)?;
            self.done()?;
            self.update_pins(Some(Phase::SavedState));
            if matches!(word.keyword, Keyword::Call | Keyword::EndSub | Keyword::Return) {
                self.record.leads_elsewhere();
            }
            self.record.step_without_state(place, &self.state);
            return Ok(next);
        }
        let words = evaluate::words(&block, &mut self.state)?;
        self.control.begin(&words);
        if Control::asks(&words) && check::has_later_codes(&self.state) {
            self.by_hand_only(false, "M98 or M99")?;
            self.is_within_block = true;
            let next = self.numbered(&words)?;
            self.done()?;
            self.update_pins(Some(Phase::SavedState));
            self.record.leads_elsewhere();
            self.record.step_without_state(place, &self.state);
            return Ok(next);
        }
        check::check(&words, &mut self.state)?;
        self.is_within_block = true;
        let is_empty = block.words.is_empty() && block.settings.is_empty();
        let comment_only = is_empty && block.line_number.is_none();
        let after_phase = self.execute(&words, comment_only)?;
        stub::after_block(self.record.moves(), &mut self.state)?;
        if after_phase == AfterPhase::ProgramEnd {
            self.ended(block.block_delete)?;
            self.done()?;
            self.record.step(place, &mut self.state);
            return Ok(Next::End(End::ProgramEnd));
        }
        self.done()?;
        if comment_only && self.record.is_idle(&self.state) {
            // An inactive comment is not a block.
            self.record.is_no_block();
            return Ok(Next::Following);
        }
        self.record.step(place, &mut self.state);
        Ok(Next::Following)
    }

    /// Prepares the feed rate, once, after the comment of a block.
    fn begin_feed(&mut self, words: &mut Option<&Words>) {
        if let Some(words) = words.take() {
            execute::feed::begin_block(words, &mut self.state);
        }
    }

    /// A block has been executed, with as many effects as the budget allows.
    fn done(&mut self) -> Result<(), StepError> {
        if self.record.is_over() {
            return Err(StepError::TooManyEffects);
        }
        self.is_within_block = false;
        Ok(())
    }

    /// What only a program can do: by hand the documents leave it open, unless it is said.
    fn by_hand_only(&self, allowed: bool, what: &str) -> Result<(), StepError> {
        if self.by_hand && self.state.call_level() == 0 && !allowed {
            return Err(StepError::Unspecified(format!("{what}, entered by hand")));
        }
        Ok(())
    }

    /// Executes a block that the check let pass, phase by phase.
    ///
    /// Choice parameters.setting-time: its settings take effect after its words, and so once the program goes on that
    /// they pause, or before them and after its comment.
    ///
    /// In a phase that takes time the operator may act. What an abort breaks off has not been done.
    fn execute(&mut self, words: &Words, comment_only: bool) -> Result<AfterPhase, StepError> {
        let mut feed = (!comment_only).then_some(words);
        let mut after_phase = AfterPhase::Execute;
        let mut is_whole = true;
        let mut settings = (!words.settings.is_empty()).then_some(&words.settings);
        let before_words = settings.is_some()
            && self.state.choices.is(choice::parameters::SettingTime::BeforeWords);
        let phases = self.state.dialect().phases(words, &mut self.state);
        for phase in phases.iter() {
            if phase != Phase::Comment {
                self.begin_feed(&mut feed);
            }
            if before_words
                && phase != Phase::Comment
                && let Some(settings) = settings.take()
            {
                control::assign(settings, &mut self.state)?;
            }
            if phase == Phase::Dwell {
                self.stand_in_dwell()?;
            }
            self.waits_for_machine = waits_for_machine(phase, words, &self.state);
            if self.waits_for_machine && self.ahead {
                return Err(self.read_up_to(phase, words));
            }
            let mut began = self.state.environment.time();
            let may_break_off = may_take_time(phase) && self.operator.is_due();
            let before = may_break_off.then(|| self.without_coverage());
            let executed = self.perform_phase(phase, words, &mut began);
            let refused = match executed {
                Ok(done) => {
                    after_phase = done;
                    None
                }
                Err(StepError::WaitsForEver) => return Err(self.waits_before(phase, phases, words)),
                Err(refused @ StepError::Refused(_)) if self.state.environment.time() > began => {
                    Some(refused)
                }
                Err(error) => return Err(error),
            };
            self.update_pins(Some(phase));
            if refused.is_none()
                && !self.state.dialect().goes_on_after(phase, phases, words, &mut self.state)?
            {
                is_whole = false;
                break;
            }
            let counted = self.state.environment.changes().len();
            if let Err(error) = self.took_time_since(began, phase) {
                let coverage = std::mem::take(&mut self.state.coverage);
                if let Some(before) = before {
                    let after = std::mem::replace(&mut self.state, before);
                    self.broken_off(phase, &after);
                    let environment =
                        std::mem::replace(&mut self.state.environment, after.environment);
                    self.state.environment.drop_what_was_to_come(&environment, counted);
                    self.state.panel = after.panel;
                }
                self.state.coverage = coverage;
                return Err(error);
            }
            if let Some(refused) = refused {
                return Err(refused);
            }
        }
        self.begin_feed(&mut feed);
        if is_whole {
            order::completed(words, phases, &mut self.state);
        }
        execute::pass(0.0, &mut self.state);
        if after_phase == AfterPhase::Pause {
            self.paused(words)?;
        }
        if let Some(settings) = settings {
            control::assign(settings, &mut self.state)?;
        }
        Ok(after_phase)
    }

    /// Executes a phase. A lathe cycle makes its first motion, and then its profile is read. `began` becomes the time
    /// of the last wait.
    fn perform_phase(
        &mut self,
        phase: Phase,
        words: &Words,
        began: &mut f64,
    ) -> Result<AfterPhase, StepError> {
        if phase == Phase::Motion && execute::turning::is_programmed(words) {
            self.state.profile = None;
            self.perform_moves(phase, words, began)?;
            self.read_profile(words)?;
        }
        self.perform_moves(phase, words, began)
    }

    /// Executes a phase; what holds its moves may change meanwhile.
    fn perform_moves(
        &mut self,
        phase: Phase,
        words: &Words,
        began: &mut f64,
    ) -> Result<AfterPhase, StepError> {
        if self.is_watched(phase, words) {
            return self.watched(phase, words, began);
        }
        order::execute_phase(phase, words, &mut self.state, &mut self.record)
    }

    /// A block waits for ever for one of its phases. Where a later one has a fault, no document says whether that is
    /// found before.
    fn waits_before(&mut self, phase: Phase, phases: Phases, words: &Words) -> StepError {
        if order::fault_after(phase, phases, words, &self.state).is_some() {
            let why = "a block that waits for ever before a part of it that is refused, or open";
            return StepError::Unspecified(why.to_owned());
        }
        self.waits_for_ever()
    }

    /// Reading ahead ends with what waits for the machine, unless that is refused. A tool change has stopped the
    /// spindle by then.
    fn read_up_to(&mut self, phase: Phase, words: &Words) -> StepError {
        let mut state = self.state.clone();
        let mut record = Record::new(&state);
        match order::execute_phase(phase, words, &mut state, &mut record) {
            Err(StepError::Refused(refused))
                if !execute::probe::is_found_out_by_machine(refused.rule) =>
            {
                return StepError::Refused(refused);
            }
            Ok(_) | Err(_) => {}
        }
        if phase == Phase::ChangeTool {
            execute::tool_change::before_moving(&mut self.state);
        }
        StepError::Ended(End::Paused)
    }

    /// The state as an abort brings it back: what was reached stays reached.
    pub(super) fn without_coverage(&mut self) -> State {
        let coverage = std::mem::take(&mut self.state.coverage);
        let state = self.state.clone();
        self.state.coverage = coverage;
        state
    }

    /// A phase has been broken off while it waited. What it has told a spindle stays, and the way to where the tool
    /// is changed has been made.
    pub(super) fn broken_off(&mut self, phase: Phase, after: &State) {
        if !matches!(phase, Phase::Spindle | Phase::ChangeTool) {
            return;
        }
        self.state.position = after.position;
        for (spindle, turned) in self.state.modes.spindles.iter_mut().zip(&after.modes.spindles) {
            spindle.turn = turned.turn;
        }
    }

    /// A block with M98 or M99: its comment and settings, then the call or return.
    fn numbered(&mut self, words: &Words) -> Result<Next, StepError> {
        if let Some(comment) = &words.comment {
            execute::message::perform(comment, &mut self.state, &mut self.record)?;
        }
        control::assign(&words.settings, &mut self.state)?;
        self.control.numbered(words, &mut self.state, &mut self.record)
    }

    /// Rule program-end.ends. M2 and M30 end the program, at any level.
    ///
    /// Rule program-end.lines-after. The text after them is not read.
    ///
    /// Rule fanuc-subs.block-deleted-end. One that block delete would skip ends the program while block delete is off.
    fn ended(&mut self, deletable: bool) -> Result<(), StepError> {
        self.control.files.source(MAIN).program_ends(&mut self.state)?;
        let inside_control = !self.state.frame().open.is_empty();
        let inside_sub = self.state.call_level() > 0;
        let coverage = &mut self.state.coverage;
        coverage.accepted(rule::program_end::ENDS);
        coverage.accepted(rule::program_end::LINES_AFTER);
        if deletable {
            coverage.accepted(rule::fanuc_subs::BLOCK_DELETED_END);
        }
        if inside_control {
            coverage.accepted(rule::program_end::INSIDE_CONTROL);
        }
        if inside_sub {
            coverage.accepted(rule::subroutines::PROGRAM_END_IN_SUB);
            self.record.leads_elsewhere();
        }
        self.leave_calls();
        self.over();
        Ok(())
    }

    /// Choices outputs.waiting-after-end, saved-state.after-run. What waits for a motion waits for one of the next
    /// program, or is gone; so it is with what is saved.
    fn over(&mut self) {
        execute::saved_state::run_is_over(&mut self.state);
        // What is only read ahead has not ended.
        if !self.ahead && self.state.choices.is(choice::outputs::WaitingAfterEnd::Forgotten) {
            self.state.environment.forget_all_with_motion();
        }
    }
}

/// Whether time may go by in a phase, so that somebody can break it off.
fn may_take_time(phase: Phase) -> bool {
    const TAKE_TIME: Phases = Phases::these(&[
        Phase::InputsOutputs,
        Phase::ChangeTool,
        Phase::Spindle,
        Phase::UserCode,
        Phase::Dwell,
    ]);
    TAKE_TIME.contains(phase)
}

/// Whether the motion of a block is a canned cycle.
pub(super) fn is_cycle(words: &Words, state: &State) -> bool {
    execute::programmed_motion::motion_of(words, state).is_some_and(execute::cycles::is_cycle)
}

/// Whether a phase waits for what the machine answers, so that later blocks cannot be read before: M66, M6, a probe.
fn waits_for_machine(phase: Phase, words: &Words, state: &State) -> bool {
    let reads_input = phase == Phase::InputsOutputs && words.m.contains(&66);
    let probes = phase == Phase::Motion
        && execute::programmed_motion::motion_of(words, state)
            .is_some_and(execute::probe::is_probing);
    let changes_tool = phase == Phase::ChangeTool && words.m.contains(&6);
    reads_input || probes || changes_tool
}
