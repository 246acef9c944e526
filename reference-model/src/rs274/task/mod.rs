//! The run: start, blocks, budget, record, end.

mod record;

use std::collections::BTreeMap;

use gaugeblock_trace::scenario::Start;
use gaugeblock_trace::{
    Block, Bound, End, Fault, FaultKind, Indexed, Language, Outcome, Position, Program, Scenario,
    Settings,
};

pub use record::Record;

use super::control::{self, Control, Frame, Next};
use super::machine::{State, slots};
use super::modes::Modes;
use super::order::Flow;
use super::outside::Outside;
use super::parameters::{self, Name, Parameters};
use super::read::{self, Words};
use super::readings::Readings;
use super::refusal::{Halt, Refusal, refuse};
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
    let parameters = run.parameters();
    let pins = run.state.outside.changes().to_vec();
    (run.record.finish(end, parameters, pins), run.state.evidence)
}

/// The state before the first block.
fn start(scenario: &Scenario, readings: Readings) -> State {
    let machine = scenario.machine.clone();
    let modes = Modes::new(&machine, &readings);
    let outside = Outside::new(&scenario.bench, modes.spindles.len(), &readings);
    State {
        position: modes.program_point(Position::default()),
        modes,
        parameters: Parameters::new(&machine, &readings),
        readings,
        machine,
        tool: 0,
        prepared_tool: -1,
        selected_for_change: false,
        slots: slots(&scenario.machine),
        frames: vec![Frame::default()],
        line: 1,
        log_open: false,
        outside,
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
        } else if self.state.outside.time() >= budget.time {
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
            self.record.step_without_state(place, &self.state);
            return Ok(next);
        }
        let words = read::read(&block, &mut self.state)?;
        self.control.begin(&words);
        if Control::asks(&words) {
            let next = self.numbered(&words)?;
            self.record.step_without_state(place, &self.state);
            return Ok(next);
        }
        check::check(&words, &mut self.state)?;
        let before = self.changeable(&words);
        let flow = self.execute(&words)?;
        if flow == Flow::ProgramEnd {
            self.ended(block.block_delete)?;
            self.record.last_step(place, &self.state);
            return Ok(Next::End(End::ProgramEnd));
        }
        let changed = self.changed(&before);
        let comment_only = block.words.is_empty() && block.settings.is_empty();
        if comment_only && block.line_number.is_none() && self.record.is_idle(&self.state) {
            // A comment that says nothing is no block.
            return Ok(Next::Following);
        }
        self.record.step(place, &self.state, changed);
        Ok(Next::Following)
    }

    /// Executes a block that the check let pass; its settings take effect after it.
    fn execute(&mut self, words: &Words) -> Result<Flow, Halt> {
        let flow = order::execute(words, &mut self.state, &mut self.record)?;
        step::pass(0.0, &mut self.state);
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
        }
        Ok(())
    }

    /// The parameters that a block can change, as they are before it.
    fn changeable(&self, words: &Words) -> BTreeMap<Name, Option<f64>> {
        let settings = words.settings.iter().map(|(name, _)| name.clone());
        let offsets = if words.g.iter().any(|code| sets_coordinates(*code)) {
            COORDINATE_PARAMETERS
        } else {
            0..0
        };
        let read = words.m.contains(&66).then_some(step::inputs::RESULT);
        let all = settings.chain(offsets.chain(read).map(Name::Numbered));
        all.map(|name| {
            let value = parameters::value(&name, &self.state).ok();
            (name, value)
        })
        .collect()
    }

    /// The parameters that a block has changed.
    fn changed(&self, before: &BTreeMap<Name, Option<f64>>) -> Indexed<String, f64> {
        let after = before.iter().filter_map(|(name, before)| {
            let after = parameters::value(name, &self.state).ok()?;
            let name = match name {
                Name::Numbered(number) => number.to_string(),
                Name::Named(name) => name.clone(),
            };
            (Some(after) != *before).then_some((name, after))
        });
        after.collect()
    }

    /// Rule program-end.parameters-kept. All numbered parameters that are not zero.
    fn parameters(&self) -> Indexed<u32, f64> {
        let mut all = self.state.parameters.nonzero();
        let local = (1..).zip(self.arguments());
        all.0.extend(local.filter(|(_, value)| value.abs() > 0.0));
        all
    }

    /// Parameters #1 to #30 once the run is over. With it every call is over, so that they are the main program's, which a
    /// numbered subprogram shares.
    fn arguments(&self) -> [f64; 30] {
        let frames = &self.state.frames;
        let shares = |frame: &&Frame| frame.shares_parameters();
        match frames.iter().skip(1).take_while(shares).last() {
            Some(_) if self.state.readings.quirk("rs274.fanuc-changes-at-end") => {
                self.control.at_last_call
            }
            Some(frame) => frame.arguments,
            None => frames[0].arguments,
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
            Halt::WaitsForEver => End::BudgetExhausted { bound: Bound::Time },
        }
    }
}

/// The main program among the files.
const MAIN: usize = 0;

/// Parameters of coordinate systems and their offsets.
const COORDINATE_PARAMETERS: std::ops::Range<u32> = 5161..5401;

/// Whether a G code, in tenths, can change [`COORDINATE_PARAMETERS`]: G10, G28, G30, G52, G54 to G59.3, G92.
fn sets_coordinates(code: u32) -> bool {
    matches!(code, 100 | 280..=301 | 520 | 540..=593 | 920..=923)
}
