//! The run: block by block.

use gaugeblock_vocabulary::{
    BlockLocation as Place, Effect, End, Fault, FaultKind, Language, Outcome, Program as Files,
    Scenario,
};

use super::evaluate::rounded;
use super::frames::{Frame, Kind, Reach};
use super::modes::{Block, Codes, Modes};
use super::motion::{self, OF_ARC, axis, is_arc};
use super::programs::Programs;
use super::record::Record;
use super::refusal::{Refusal, StepError, open, refuse, refuse_form};
use super::state::{Flow, Run};
use super::syntax::{Content, Expression, Word};
use super::variables::Variables;
use super::words::{Words, word};
use crate::Choices;
use crate::RuleCoverage;
use crate::ids::{choice, rule};

/// What the documents say about a scenario in this language, and the rules that were reached.
pub fn run(scenario: &Scenario) -> (Outcome, RuleCoverage) {
    let mut coverage = RuleCoverage::default();
    let choices = Choices::known(&scenario.options);
    let block_delete = scenario.program.block_delete;
    let programs = Programs::read(&scenario.program.main, block_delete, &choices);
    let modes = Modes::new();
    let start = modes.settings();
    let main = Frame {
        program: 0,
        next: 0,
        kind: Kind::Main,
        repeats: 1,
        reach: Reach::All,
        modal_calls: 0,
    };
    let mut run = Run {
        programs: &programs,
        choices,
        coverage: &mut coverage,
        variables: Variables::new(),
        modal_calls: Vec::new(),
        frames: vec![main],
        turns: 1,
        modes,
        machine: &scenario.machine,
        record: Record::new(scenario.budget, start.clone()),
        at: 1,
    };
    let end = match run.whole(block_delete) {
        Ok(Flow::Endless) => End::Endless,
        Ok(Flow::On | Flow::Ended) => End::ProgramEnd,
        Err(error) => run.end_after(error),
    };
    let outcome = Outcome {
        language: Language::Nct,
        start,
        steps: run.record.steps,
        end,
        parameters: None,
        pins: Vec::new(),
        samples: Vec::new(),
    };
    (outcome, coverage)
}

impl Run<'_> {
    fn end_after(&mut self, error: StepError) -> End {
        let block = Place::new(Files::MAIN, self.at);
        match error {
            StepError::Refused(Refusal { rule, kind, message }) => {
                if let Some(rule) = rule {
                    self.coverage.refused(rule);
                }
                End::Fault(Fault { kind: Some(kind), block: Some(block), span: None, message })
            }
            StepError::Unspecified(why) => End::Unspecified { block, why },
            StepError::Unsupported(what) => End::Unsupported { block, what },
            StepError::Exhausted(bound) => End::BudgetExhausted { bound },
        }
    }

    fn whole(&mut self, block_delete: bool) -> Result<Flow, StepError> {
        let programs = self.programs;
        loop {
            let frame = self.frames.last_mut().expect("run: the main program is in progress");
            let program = &programs.all[frame.program];
            let place = frame.next;
            let Some(block) = program.blocks.get(place) else {
                self.at = program.blocks.last().map_or(program.line, |block| block.line);
                let message = "the program has no end";
                return Err(refuse(rule::nct::TEXT_END, FaultKind::MissingEnd, message));
            };
            frame.next += 1;
            if block_delete && block.is_optional {
                self.coverage.accepted(rule::nct::BLOCK_DELETE);
                continue;
            }
            self.begin(block.line)?;
            let content = block.content.as_ref().map_err(Clone::clone)?;
            program.check(place)?;
            let flow = self.content(content, place)?;
            if flow != Flow::On {
                return Ok(flow);
            }
        }
    }

    fn begin(&mut self, line: u32) -> Result<(), StepError> {
        self.at = line;
        self.record.begin()
    }

    fn end(&mut self) -> Result<(), StepError> {
        let block = Place::new(Files::MAIN, self.at);
        self.record.end(block, &self.modes, &self.variables, &self.modal_calls)
    }

    fn content(&mut self, content: &Content, place: usize) -> Result<Flow, StepError> {
        match content {
            Content::Words(words) => return self.word_block(words),
            Content::Assign { number, value } => {
                let number = self.variable_number(number)?;
                let value = self.value(value)?;
                self.variables.set(number, value)?;
                self.coverage.accepted(rule::nct::STATEMENT_FORM);
                if value.is_none() {
                    self.coverage.accepted(rule::nct::VACANT);
                }
            }
            Content::Goto(to) => self.go_to(to)?,
            Content::If(condition, to) => {
                if self.condition(condition)? {
                    self.go_to(to)?;
                }
            }
            Content::While(condition, _) => {
                self.coverage.accepted(rule::nct::LOOPS);
                self.coverage.accepted(rule::nct::LOOP_NUMBER);
                self.coverage.accepted(rule::nct::LOOP_PAIRS);
                if !self.condition(condition)? {
                    self.go_beyond(place);
                }
            }
            Content::End(_) => self.go_to_begin(place),
        }
        self.end()?;
        Ok(Flow::On)
    }

    /// The block behind the END of a DO.
    fn go_beyond(&mut self, place: usize) {
        let frame = self.frames.last_mut().expect("run: the main program is in progress");
        let end = self.programs.all[frame.program].pairs.get(&place);
        frame.next = end.expect("programs: a DO that is reached has its END") + 1;
    }

    /// The DO of an END.
    fn go_to_begin(&mut self, place: usize) {
        let frame = self.frames.last_mut().expect("run: the main program is in progress");
        let begin = self.programs.all[frame.program].pairs.get(&place);
        frame.next = *begin.expect("programs: an END that is reached has its DO");
    }

    /// Rule nct.goto. The number of the block may be computed.
    fn go_to(&mut self, to: &Expression) -> Result<(), StepError> {
        let Some(to) = self.value(to)? else {
            return Err(open("GOTO with a vacant variable"));
        };
        self.jump(rounded(to), rule::nct::GOTO)
    }

    fn word_block(&mut self, words: &[Word]) -> Result<Flow, StepError> {
        let words = self.words(words)?;
        let g = self.g_codes(&words)?;
        if g.iter().any(|code| Self::is_call(*code)) {
            let flow = self.call_block(&g, &words)?;
            self.end()?;
            return Ok(flow);
        }
        let m = self.m_codes(&words)?;
        if self.is_taken(&words, &m)? {
            let reached = self.reached()?;
            self.call_modal(reached, Some(&words))?;
            self.end()?;
            return Ok(Flow::On);
        }
        self.executed(&words, &Codes { g, m })
    }

    /// Whether a block is taken as the arguments of a modal call. One without words is not, and neither is M99.
    fn is_taken(&mut self, words: &Words, m: &[i64]) -> Result<bool, StepError> {
        if !self.calls_by_block() || words.is_empty() || m.contains(&99) || self.reached()? == 0 {
            return Ok(false);
        }
        if m.iter().any(|code| matches!(code, 2 | 30 | 98)) {
            return Err(open("M2, M30 or M98 in a block that G66.1 takes as arguments"));
        }
        Ok(true)
    }

    /// A block that is executed: modes, F, S, T, tool change, dwell, motion, then a call, a return or the end.
    fn executed(&mut self, words: &Words, codes: &Codes) -> Result<Flow, StepError> {
        let block = self.modes.set(codes)?;
        if !codes.g.is_empty() {
            self.coverage.accepted(rule::nct::MODES);
        }
        let moves = self.moves(words, block);
        self.used(words, block, moves)?;
        self.values(words)?;
        if block.tool_change {
            self.record.effect(&self.modes, Effect::ChangeTool { tool: self.modes.tool });
        }
        if block.dwell {
            self.dwell(words)?;
        }
        if let Some(motion) = block.motion {
            self.modes.motion = motion;
        }
        let reached = if moves { self.reached_by_motion()? } else { 0 };
        if moves {
            if reached > 0 && (block.sub || block.back || block.end) {
                return Err(open("M2, M30, M98 or M99 in a block after which a modal call comes"));
            }
            let effect = motion::perform(&mut self.modes, words, &self.machine.axes)?;
            let is_arc = matches!(effect, Effect::ArcFeed { .. });
            self.coverage.accepted(if is_arc { rule::nct::ARC } else { rule::nct::MOTION });
            self.record.effect(&self.modes, effect);
        }
        self.ended(words, block, reached)
    }

    /// What comes after the rest of a block.
    fn ended(&mut self, words: &Words, block: Block, reached: usize) -> Result<Flow, StepError> {
        let mut flow = Flow::On;
        if block.sub {
            self.call_sub(words)?;
        } else if block.back {
            flow = self.go_back(words)?;
        } else if block.end {
            self.coverage.accepted(rule::nct::TEXT_END);
            self.record.effect(&self.modes, Effect::ProgramEnd {});
            flow = Flow::Ended;
        }
        self.end()?;
        if reached > 0 {
            self.begin(self.at)?;
            self.call_modal(reached, None)?;
            self.end()?;
        }
        Ok(flow)
    }

    /// Whether a block moves: it has a word of an axis, or goes round a circle.
    fn moves(&self, words: &Words, block: Block) -> bool {
        let motion = block.motion.unwrap_or(self.modes.motion);
        let has_axis = words.iter().any(|(letter, _)| axis(*letter).is_some());
        has_axis || is_arc(motion) && words.iter().any(|(letter, _)| OF_ARC.contains(*letter))
    }

    /// Each letter but G and M stands once, and something in the block uses it.
    fn used(&self, words: &Words, block: Block, moves: bool) -> Result<(), StepError> {
        let motion = block.motion.unwrap_or(self.modes.motion);
        let of_p = [block.dwell, block.sub, block.back].iter().filter(|uses| **uses).count();
        if of_p > 1 && word(words, 'P').is_some() {
            return Err(open("two codes that use P"));
        }
        let mut seen = std::collections::BTreeSet::new();
        for (letter, _) in words {
            if matches!(letter, 'G' | 'M') {
                continue;
            }
            if !seen.insert(*letter) {
                let message = format!("{letter} occurs twice");
                return Err(refuse_form(FaultKind::RepeatedWord, message));
            }
            let is_used = match letter {
                'F' | 'S' | 'T' => true,
                'P' => of_p > 0,
                'L' => block.sub,
                'I' | 'J' | 'K' | 'R' => moves && is_arc(motion),
                _ => axis(*letter).is_some(),
            };
            if !is_used {
                let message = format!("nothing in the block uses {letter}");
                return Err(refuse_form(FaultKind::UnusedWord, message));
            }
        }
        Ok(())
    }

    /// F, S and T.
    fn values(&mut self, words: &Words) -> Result<(), StepError> {
        for letter in ['F', 'S'] {
            let Some(value) = word(words, letter) else { continue };
            if value < 0.0 {
                let message = format!("{letter} below zero");
                return Err(refuse_form(FaultKind::WordOutOfRange, message));
            }
            if letter == 'F' {
                self.modes.feed_rate = value;
            } else {
                self.modes.spindle_speed = value;
            }
        }
        if let Some(tool) = word(words, 'T') {
            let tool = self.counted('T', tool, i64::from(i32::MAX))?;
            self.modes.tool = i32::try_from(tool).unwrap_or_default();
            self.record.effect(&self.modes, Effect::PrepareTool { tool: self.modes.tool });
        }
        Ok(())
    }

    /// Rule nct.dwell. G4 waits for P. Choice nct.dwell: in which unit.
    fn dwell(&mut self, words: &Words) -> Result<(), StepError> {
        let rule = rule::nct::DWELL;
        let Some(time) = word(words, 'P') else {
            return Err(refuse(rule, FaultKind::MissingWord, "G4 without P"));
        };
        if time < 0.0 {
            return Err(refuse(rule, FaultKind::WordOutOfRange, "a dwell below zero"));
        }
        let seconds =
            if self.choices.is(choice::nct::Dwell::Milliseconds) { time / 1000.0 } else { time };
        self.record.effect(&self.modes, Effect::Dwell { seconds });
        self.coverage.accepted(rule);
        Ok(())
    }
}
