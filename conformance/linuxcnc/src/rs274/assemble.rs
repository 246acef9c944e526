//! Assembles an outcome from calls, checkpoints and the error message.

use std::collections::BTreeMap;

use gaugeblock_adapter::HarnessError;
use gaugeblock_vocabulary::{
    BlockLocation, Bound, End, Indexed, Language, Outcome, Position, Scenario, Settings,
};

use super::canon::{Canon, Mark};
use super::output::Line;
use super::waiting::{self, Ordered};
use crate::instrumentation::checkpoint::Checkpoint;
use crate::instrumentation::instrument::Plan;
use crate::instrumentation::source::{Form, Source};
use crate::instrumentation::steps::{self, Steps};
use crate::instrumentation::{refusal, state};

/// What was seen of a run.
#[derive(Debug)]
pub(super) struct CapturedRun<'a> {
    /// Standard output.
    pub(super) lines: &'a [Line],
    /// Standard error.
    pub(super) stderr: &'a str,
    /// Standard error of the run without checkpoints.
    pub(super) plain_stderr: &'a str,
    /// Whether the program exited with the status of a refusal.
    pub(super) refused: bool,
    /// Whether it was ended because it ran too long or wrote too much.
    pub(super) cut_off: bool,
    /// The output after the end, if the program reached its end.
    pub(super) after_end: Option<&'a Checkpoint>,
    /// Numbered parameters that are not zero at the end.
    pub(super) parameters: Option<&'a BTreeMap<u32, f64>>,
}

/// An outcome in the making.
#[derive(Debug)]
struct Assembly<'a> {
    source: &'a Source,
    plan: &'a Plan,
    canon: Canon,
    start: Settings,
    steps: Steps<'a>,
    end: Option<End>,
    /// What the last checkpoint's parameters tell of settings whose calls can wait.
    shown: Settings,
}

/// The outcome of a run.
///
/// # Errors
/// The output does not make sense, or an error message is unknown.
pub(super) fn outcome(
    scenario: &Scenario,
    source: &Source,
    plan: &Plan,
    captured: &CapturedRun<'_>,
    parameters: Option<BTreeMap<u32, f64>>,
) -> Result<Outcome, HarnessError> {
    let mut assembly = Assembly {
        source,
        plan,
        canon: Canon::new(&scenario.machine),
        start: Settings::default(),
        steps: Steps::new(source, plan, scenario),
        end: None,
        shown: Settings::default(),
    };
    let lines = if plan.compensates {
        waiting::in_program_order(captured.lines)
    } else {
        captured.lines.iter().map(Ordered::Line).collect()
    };
    for line in lines {
        match line {
            Ordered::Line(line) => assembly.line(line, captured)?,
            Ordered::Rescaled => assembly.unsupported(RESCALED.to_owned()),
            Ordered::Overtaken => assembly.unsupported(OVERTAKEN.to_owned()),
            Ordered::Unfinished(checkpoint) => assembly.unfinished(checkpoint),
        }
        if assembly.end.is_some() {
            break;
        }
    }
    let end = assembly.end(captured)?;
    let mut outcome = Outcome {
        language: Language::Rs274,
        start: assembly.start,
        steps: assembly.steps.taken,
        end,
        parameters: parameters.map(|parameters| parameters.into_iter().collect::<Indexed<_, _>>()),
        pins: Vec::new(),
        samples: Vec::new(),
    };
    if steps::limit(&mut outcome, scenario.budget).is_none() && captured.cut_off {
        return Err(HarnessError::Unreadable {
            what: "output cut off within the budget".to_owned(),
            line: String::new(),
        });
    }
    Ok(outcome)
}

/// Of a program that does something else under observation, since the number of a line decides what it does.
pub(super) fn decided_by_line(source: &Source) -> Outcome {
    let what = "#<_line> decides what is done, and checkpoints are lines, too";
    not_observable(source.block(0, 1), what)
}

/// Of a program that does something else under observation, since a compensated move waits for the block that ends it.
pub(super) fn put_out_before_end(block: BlockLocation) -> Outcome {
    not_observable(
        block,
        "a compensated move that waits for a move in the block that ends the program",
    )
}

fn not_observable(block: BlockLocation, what: &str) -> Outcome {
    Outcome {
        language: Language::Rs274,
        start: Settings::default(),
        steps: Vec::new(),
        end: End::Unsupported { block, what: what.to_owned() },
        parameters: None,
        pins: Vec::new(),
        samples: Vec::new(),
    }
}

/// Why a block is not judged that has a spline and a tool change or the program end, or depends on #<_line>.
const HIDDEN_SPLINE: &str =
    "where a spline ends whose block has a tool change or the program end, or follows #<_line>";

/// Why a block is not judged after which the length unit changes while its move waits: the call has the other unit, and
/// four decimals of an inch are too few for millimetres.
const RESCALED: &str = "a move that waits for the next one while the length unit changes";

/// Why a block is not judged that a spline overtakes.
const OVERTAKEN: &str = "a compensated move that waits while a spline is made";

/// Why a block is not judged whose M19 waits when the program stops, or one after it: parameters do not report M19.
const ORIENTS: &str = "an M19 that waits for the next move when the program stops";

impl Assembly<'_> {
    fn line(&mut self, line: &Line, captured: &CapturedRun<'_>) -> Result<(), HarnessError> {
        match line {
            Line::Text(text) => self.canon.print(text),
            Line::Passed => {}
            Line::Checkpoint(checkpoint) => self.checkpoint(checkpoint)?,
            Line::Call(call) => match self.canon.call(call)? {
                Mark::None => {}
                Mark::ProgramEnd => self.program_end(captured)?,
                // It is called too where a label was sought up to the percent sign, which is an error.
                Mark::PercentEnd if captured.refused => {}
                Mark::PercentEnd => self.end = Some(End::PercentEnd),
                Mark::Unsupported(what) => self.unsupported(what),
            },
        }
        Ok(())
    }

    fn checkpoint(&mut self, checkpoint: &Checkpoint) -> Result<(), HarnessError> {
        if !self.steps.has_begun() {
            self.canon.settle(checkpoint)?;
            self.canon.set(Settings {
                tool_offset: Some(Position::default()),
                ..state::others(checkpoint)
            });
            self.canon.take_events();
            self.start = self.canon.now.clone();
            self.steps.begin(checkpoint)?;
        } else if self.canon.hides_spline(self.source.names_line()) {
            self.unsupported(HIDDEN_SPLINE.to_owned());
        } else {
            self.canon.settle(checkpoint)?;
            self.canon.arrived(state::position(checkpoint));
            let events = self.canon.take_events();
            self.steps.record_block(checkpoint, events, self.canon.tool)?;
        }
        self.shown = state::waiting(checkpoint);
        self.canon.position = state::position(checkpoint);
        self.canon.block(self.source.line(checkpoint.file, checkpoint.line + 1));
        Ok(())
    }

    /// A block whose calls wait when the program stops: parameters tell its settings.
    fn unfinished(&mut self, checkpoint: &Checkpoint) {
        if self.canon.has_word("m19") || self.canon.has_oriented_spindle() {
            return self.unsupported(ORIENTS.to_owned());
        }
        let shown = state::waiting(checkpoint);
        let mut changed = shown.since(&self.shown);
        if self.canon.has_word("f") {
            changed.feed_rate = shown.feed_rate;
        }
        self.canon.set_waiting(changed, state::feed_mode(checkpoint));
    }

    fn program_end(&mut self, captured: &CapturedRun<'_>) -> Result<(), HarnessError> {
        if self.steps.next_form() == Form::Return {
            self.unsupported(
                "M99 in the main program: it ends here, though it should begin again".to_owned(),
            );
            return Ok(());
        }
        let Some(checkpoint) = captured.after_end else {
            self.unsupported("an end whose state cannot be queried".to_owned());
            return Ok(());
        };
        if self.canon.hides_spline(true) {
            self.unsupported(HIDDEN_SPLINE.to_owned());
            return Ok(());
        }
        self.canon.end(|canon| canon.settle(checkpoint))?;
        let events = self.canon.take_events();
        self.steps.record_end(checkpoint, captured.parameters, events, self.canon.tool)?;
        self.end = Some(End::ProgramEnd);
        Ok(())
    }

    fn unsupported(&mut self, what: String) {
        let (file, line) = self.steps.next().unwrap_or((0, 1));
        self.end = Some(End::Unsupported { block: self.source.block(file, line), what });
    }

    fn end(&mut self, captured: &CapturedRun<'_>) -> Result<End, HarnessError> {
        if let Some(end) = self.end.take() {
            return Ok(end);
        }
        if !self.steps.has_begun() {
            self.start = self.canon.now.clone();
        }
        if captured.refused {
            let next = self.steps.next().or(Some((0, 1)));
            let mut fault = refusal::fault(captured.stderr, self.source, self.plan, next)?;
            if let Some(words) = refusal::message(captured.plain_stderr) {
                words.clone_into(&mut fault.message);
            }
            return Ok(End::Fault(fault));
        }
        if captured.cut_off {
            return Ok(End::BudgetExhausted { bound: Bound::Steps });
        }
        let line = captured.stderr.lines().last().unwrap_or_default().to_owned();
        Err(HarnessError::Unreadable { what: "a run without an end".to_owned(), line })
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::super::output;
    use super::*;

    /// What the program printed for one of our own programs, and the outcome that it comes to.
    #[test]
    fn a_captured_run_is_put_together() {
        let scenario = Scenario::of(include_str!("captured/repeat.ngc"));
        let source = Source::new(&scenario.program);
        let plan = Plan::new(&source, &BTreeSet::new());
        let lines = output::lines(include_str!("captured/repeat.stdout"), &plan, false).unwrap();
        let stderr = include_str!("captured/repeat.stderr");
        let captured = CapturedRun {
            lines: &lines,
            stderr,
            plain_stderr: "",
            refused: true,
            cut_off: false,
            after_end: None,
            parameters: None,
        };
        let parameters = BTreeMap::from([(2, 7.0), (5220, 1.0), (5599, 1.0)]);
        let outcome = outcome(&scenario, &source, &plan, &captured, Some(parameters)).unwrap();
        assert_eq!(outcome.to_text(), include_str!("captured/repeat.outcome"));
    }

    #[test]
    fn a_run_without_an_end_is_an_error() {
        let scenario = Scenario::of("g4 p1\nm2\n");
        let source = Source::new(&scenario.program);
        let plan = Plan::new(&source, &BTreeSet::new());
        let captured = CapturedRun {
            lines: &[],
            stderr: "",
            plain_stderr: "",
            refused: false,
            cut_off: false,
            after_end: None,
            parameters: None,
        };
        assert!(outcome(&scenario, &source, &plan, &captured, None).is_err());
    }
}
