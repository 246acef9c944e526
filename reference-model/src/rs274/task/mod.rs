//! The run: start, blocks, budget, record, end.

mod record;

use gaugeblock_trace::scenario::Start;
use gaugeblock_trace::{
    Block, Bound, End, Fault, FaultKind, Indexed, Language, Outcome, Position, Program, Scenario,
    Settings,
};

pub use record::Record;

use super::control::{self, Control, Frame, Next};
use super::machine::State;
use super::modes::Modes;
use super::order::Flow;
use super::parameters::{self, Name, Parameters};
use super::read::{self, Words};
use super::readings::Readings;
use super::refusal::{Halt, Refusal, refuse};
use super::syntax::Keyword;
use super::text::Line;
use super::{check, order, step, syntax};
use crate::Evidence;

/// Runs a scenario as the documents say.
///
/// Options that the model does not know end the run before its first block.
pub fn run(scenario: &Scenario) -> (Outcome, Evidence) {
    let readings = match Readings::new(&scenario.options) {
        Ok(readings) => readings,
        Err(what) => return (not_begun(what), Evidence::default()),
    };
    if scenario.program.start == Start::Mdi {
        let what = "manual data input".to_owned();
        return (not_begun(what), Evidence::default());
    }
    let mut state = start(scenario, readings);
    state.evidence.accepted("modal-groups.initial-modes");
    state.evidence.accepted("offsets.start-system");
    let control = Control::new(&scenario.program, &mut state);
    let record = Record::new(&state);
    let mut run = Run { scenario, state, control, record };
    let end = run.blocks();
    run.leave_calls();
    let parameters = run.parameters();
    (run.record.finish(end, parameters), run.state.evidence)
}

/// The state before the first block.
fn start(scenario: &Scenario, readings: Readings) -> State {
    let machine = scenario.machine.clone();
    let modes = Modes::new(&machine, &readings);
    State {
        position: modes.program_point(Position::default()),
        modes,
        parameters: Parameters::new(&machine, &readings),
        readings,
        machine,
        tool: 0,
        prepared_tool: -1,
        frames: vec![Frame::default()],
        line: 1,
        log_open: false,
        evidence: Evidence::default(),
    }
}

/// The outcome of a scenario that is out of this model's reach as a whole.
fn not_begun(what: String) -> Outcome {
    Outcome {
        language: Language::Rs274,
        start: Settings::default(),
        steps: Vec::new(),
        end: End::Unsupported { block: Block::new(Program::MAIN, 1), what },
        parameters: None,
        pins: Vec::new(),
        samples: Vec::new(),
    }
}

struct Run<'a> {
    scenario: &'a Scenario,
    state: State,
    control: Control,
    record: Record,
}

impl Run<'_> {
    /// Block after block, until something ends the run.
    fn blocks(&mut self) -> End {
        loop {
            if let Some(bound) = self.exhausted() {
                return End::BudgetExhausted { bound };
            }
            match self.next() {
                Ok(None) => {}
                Ok(Some(end)) => return end,
                Err(halt) => return self.halted(halt),
            }
        }
    }

    /// The bound of the budget that is used up. It is looked at between blocks, so that a short run is a prefix of a
    /// longer one.
    fn exhausted(&self) -> Option<Bound> {
        let budget = &self.scenario.budget;
        if self.record.steps() >= budget.steps as usize {
            Some(Bound::Steps)
        } else if self.record.effects() >= budget.effects {
            Some(Bound::Effects)
        } else if self.record.time() >= budget.time {
            Some(Bound::Time)
        } else {
            None
        }
    }

    /// The next line of the program.
    ///
    /// Rule program-end.percent. The second percent line ends the run and does nothing else: it is no program end.
    fn next(&mut self) -> Result<Option<End>, Halt> {
        let place = self.control.place;
        self.state.line = place.line;
        let text = match self.control.files.line(place, &mut self.state) {
            Some(Line::Block(text)) => text,
            Some(Line::Nothing) => {
                self.control.place.line += 1;
                return Ok(None);
            }
            Some(Line::End) if self.state.call_level() > 0 => {
                let why = "a percent line that is reached in a subroutine".to_owned();
                return Err(Halt::Unspecified(why));
            }
            Some(Line::End) => {
                self.state.evidence.accepted("program-end.percent");
                return Ok(Some(End::PercentEnd));
            }
            None => return Err(self.missing_end()),
        };
        match self.block(&text)? {
            Next::Following => self.control.place.line += 1,
            Next::At(place) => self.control.place = place,
            Next::End(end) => return Ok(Some(end)),
        }
        Ok(None)
    }

    /// Rules program-end.missing, text.percent-unclosed. The file has ended, the program has not.
    ///
    /// Rule subroutines.missing-endsub. Nor has a sub that began in it.
    fn missing_end(&self) -> Halt {
        if self.state.frame().is_sub() {
            let message = "the file ends without an endsub";
            return refuse("subroutines.missing-endsub", FaultKind::MissingEnd, message);
        }
        let source = self.control.files.source(self.control.place.file);
        if source.percent {
            return source.unclosed();
        }
        let message = "the file ends without a program end";
        refuse("program-end.missing", FaultKind::MissingEnd, message)
    }

    /// One block: parsed, evaluated, checked, executed, recorded.
    fn block(&mut self, text: &str) -> Result<Next, Halt> {
        let block = syntax::parse(text, &mut self.state)?;
        let place = self.control.files.block(self.control.place);
        if let Some(word) = &block.o_word {
            let next = self.control.o_word(&block, word, &mut self.state, &mut self.record)?;
            if matches!(word.keyword, Keyword::Call | Keyword::EndSub | Keyword::Return) {
                self.record.leads_elsewhere();
            }
            self.record.step_without_state(place, &self.state);
            return Ok(next);
        }
        let words = read::read(&block, &mut self.state)?;
        self.control.begin(&words);
        if Control::asks(&words) {
            let next = self.numbered(&words)?;
            self.record.leads_elsewhere();
            self.record.step_without_state(place, &self.state);
            return Ok(next);
        }
        check::check(&words, &mut self.state)?;
        let flow = self.execute(&words)?;
        if flow == Flow::ProgramEnd {
            self.ended(block.block_delete)?;
            self.record.step(place, &mut self.state);
            return Ok(Next::End(End::ProgramEnd));
        }
        let comment_only = block.words.is_empty() && block.settings.is_empty();
        if comment_only && block.line_number.is_none() && self.record.is_idle(&self.state) {
            // A comment that says nothing is no block.
            return Ok(Next::Following);
        }
        self.record.step(place, &mut self.state);
        Ok(Next::Following)
    }

    /// Executes a block that the check let pass; its settings take effect after it.
    fn execute(&mut self, words: &Words) -> Result<Flow, Halt> {
        let flow = order::execute(words, &mut self.state, &mut self.record)?;
        control::assign(&words.settings, &mut self.state)?;
        Ok(flow)
    }

    /// A block with M98 or M99: its comment and settings, then the call or return.
    fn numbered(&mut self, words: &Words) -> Result<Next, Halt> {
        if let Some(comment) = &words.comment {
            step::message::perform(comment, &mut self.state, &mut self.record)?;
        }
        control::assign(&words.settings, &mut self.state)?;
        self.control.numbered(words, &mut self.state, &mut self.record)
    }

    /// Rule program-end.ends. M2 and M30 end the program, at any level.
    ///
    /// Rule program-end.lines-after. What stands behind them is not read.
    ///
    /// Rule fanuc-subs.block-deleted-end. One that block delete would skip ends the program while block delete is off.
    fn ended(&mut self, deletable: bool) -> Result<(), Halt> {
        self.control.files.source(MAIN).program_ends(&mut self.state)?;
        let inside_control = !self.state.frame().open.is_empty();
        let inside_sub = self.state.call_level() > 0;
        let evidence = &mut self.state.evidence;
        evidence.accepted("program-end.ends");
        evidence.accepted("program-end.lines-after");
        if deletable {
            evidence.accepted("fanuc-subs.block-deleted-end");
        }
        if inside_control {
            evidence.accepted("program-end.inside-control");
        }
        if inside_sub {
            evidence.accepted("subroutines.program-end-in-sub");
            self.record.leads_elsewhere();
        }
        self.leave_calls();
        Ok(())
    }

    /// Rule program-end.parameters-kept. All numbered parameters that are not zero, position and tool among them.
    fn parameters(&self) -> Indexed<u32, f64> {
        let mut all = self.state.parameters.nonzero();
        let others = (1..=30).chain(parameters::computed_numbers());
        let known = others.filter_map(|number| {
            let value = parameters::value(&Name::Numbered(number), &self.state).ok()?;
            Some((number, value))
        });
        all.0.extend(known.filter(|(_, value)| value.abs() > 0.0));
        all
    }

    /// Once the run is over every call is over, so that local parameters are the main program's, which a numbered
    /// subprogram shares.
    ///
    /// Quirk rs274.fanuc-changes-at-end: what a subprogram changed of #1 to #30 is lost.
    fn leave_calls(&mut self) {
        let mut called = self.state.frames.split_off(1);
        let shares = |frame: &&mut Frame| frame.shares_parameters();
        let Some(sharing) = called.iter_mut().take_while(shares).last() else { return };
        let main = &mut self.state.frames[0];
        main.arguments = if self.state.readings.quirk("rs274.fanuc-changes-at-end") {
            self.control.at_last_call
        } else {
            sharing.arguments
        };
        if self.state.readings.is("fanuc-subs.named-locals", "shared") {
            main.locals = std::mem::take(&mut sharing.locals);
        }
    }

    /// How a run ends whose block does not go on.
    ///
    /// Rule subroutines.file-fault. A fault in a called file is a fault of the run.
    fn halted(&mut self, halt: Halt) -> End {
        let block = self.control.files.block(self.control.place);
        match halt {
            Halt::Refused(Refusal { rule, kind, message, span }) => {
                self.state.evidence.refused(rule);
                if self.control.place.file != MAIN {
                    self.state.evidence.refused("subroutines.file-fault");
                }
                step::saved_state::broken_off(&mut self.state);
                let message = format!("{message} ({rule})");
                End::Fault(Fault { kind: Some(kind), block: Some(block), span, message })
            }
            Halt::Unsupported(what) => End::Unsupported { block, what },
            Halt::Unspecified(why) => End::Unspecified { block, why },
        }
    }
}

/// The main program among the files.
const MAIN: usize = 0;
