//! Puts calls, probes and the error message together to an outcome.

use std::collections::BTreeMap;

use gaugeblock_trace::scenario::Budget;
use gaugeblock_trace::{
    Bound, End, Event, Indexed, Language, Outcome, Position, Rs274State, Scenario, Settings, State,
    Step,
};

use super::canon::{Canon, Mark};
use super::output::Line;
use super::refusal;
use crate::adapters::HarnessError;
use crate::adapters::probing::instrument::Plan;
use crate::adapters::probing::probe::Probe;
use crate::adapters::probing::source::{Form, Source, form, has_slash};
use crate::adapters::probing::state;
use crate::observe::is_local_name;

/// What was seen of a run.
#[derive(Debug)]
pub(super) struct Seen<'a> {
    /// Standard output.
    pub(super) lines: &'a [Line],
    /// Standard error.
    pub(super) stderr: &'a str,
    /// Standard error of the run without probes.
    pub(super) plain_stderr: &'a str,
    /// Whether the program exited with the status of a refusal.
    pub(super) refused: bool,
    /// Whether it was ended because it ran too long or wrote too much.
    pub(super) cut_off: bool,
    /// What was shown after the end, if the program reached its end.
    pub(super) after_end: Option<&'a Probe>,
    /// Numbered parameters that are not zero at the end.
    pub(super) parameters: Option<&'a BTreeMap<u32, f64>>,
}

/// An outcome in the making.
#[derive(Debug)]
struct Assembly<'a> {
    source: &'a Source,
    plan: &'a Plan,
    block_delete: bool,
    canon: Canon,
    known: Rs274State,
    /// Depth of calls where the last probe stood.
    level: i64,
    at: Option<(usize, u32)>,
    start: Settings,
    steps: Vec<Step>,
    end: Option<End>,
}

/// The outcome of a run.
///
/// # Errors
/// The output does not make sense, or an error message is unknown.
pub(super) fn outcome(
    scenario: &Scenario,
    source: &Source,
    plan: &Plan,
    seen: &Seen<'_>,
    parameters: Option<BTreeMap<u32, f64>>,
) -> Result<Outcome, HarnessError> {
    let mut assembly = Assembly {
        source,
        plan,
        block_delete: scenario.program.block_delete,
        canon: Canon::new(&scenario.machine),
        known: Rs274State::default(),
        level: 0,
        at: None,
        start: Settings::default(),
        steps: Vec::new(),
        end: None,
    };
    for line in seen.lines {
        assembly.line(line, seen)?;
        if assembly.end.is_some() {
            break;
        }
    }
    let end = assembly.end(seen)?;
    let mut outcome = Outcome {
        language: Language::Rs274,
        start: assembly.start,
        steps: assembly.steps,
        end,
        parameters: parameters.map(|parameters| parameters.into_iter().collect::<Indexed<_, _>>()),
        pins: Vec::new(),
        samples: Vec::new(),
    };
    if limit(&mut outcome, scenario.budget).is_none() && seen.cut_off {
        return Err(HarnessError::Unreadable {
            what: "output cut off within the budget".to_owned(),
            line: String::new(),
        });
    }
    Ok(outcome)
}

impl Assembly<'_> {
    fn line(&mut self, line: &Line, seen: &Seen<'_>) -> Result<(), HarnessError> {
        match line {
            Line::Text(text) => self.canon.print(text),
            Line::Probe(probe) => self.probe(probe)?,
            Line::Call(call) => match self.canon.call(call)? {
                Mark::None => {}
                Mark::ProgramEnd => self.program_end(seen)?,
                Mark::PercentEnd => self.end = Some(End::PercentEnd),
                Mark::Unsupported(what) => self.unsupported(what),
            },
        }
        Ok(())
    }

    /// The block that is executed next if nothing jumps.
    fn next(&self) -> Option<(usize, u32)> {
        self.at.map(|(file, line)| (file, line + 1))
    }

    fn next_form(&self) -> Form {
        self.next().map_or(Form::Other, |(file, line)| form(self.source.line(file, line)))
    }

    fn probe(&mut self, probe: &Probe) -> Result<(), HarnessError> {
        let here = (probe.file, probe.line);
        if self.at.is_none() {
            self.canon.settle(probe)?;
            self.canon
                .set(Settings { tool_offset: Some(Position::default()), ..state::others(probe) });
            self.canon.take_events();
            self.start = self.canon.now.clone();
            self.known.parameter = Some(self.unnamed(probe)?);
        } else {
            self.canon.settle(probe)?;
            let level = std::mem::replace(&mut self.level, probe.mode("_call_level"));
            if level != self.level || self.next_form() == Form::Return {
                self.led_elsewhere();
            }
            self.passed(probe, here)?;
        }
        self.canon.position = state::position(probe);
        self.at = Some(here);
        let (file, line) = (here.0, here.1 + 1);
        self.canon.block(self.source.line(file, line));
        Ok(())
    }

    /// Parameters that the program does not name: only their changes are of interest.
    fn unnamed(&self, probe: &Probe) -> Result<Indexed<String, f64>, HarnessError> {
        let numbered = self.source.parameters().numbered;
        let is_named = |name: &str| name.parse().is_ok_and(|number| numbered.contains(&number));
        let shown = state::state(probe, 0, self.plan)?.parameter.unwrap_or_default();
        Ok(shown.0.into_iter().filter(|(name, _)| !is_named(name)).collect())
    }

    /// After a call or return the level is recorded anew, and with it the local names that exist.
    fn led_elsewhere(&mut self) {
        self.known.call_level = None;
        if let Some(parameters) = &mut self.known.parameter {
            parameters.0.retain(|name, _| !is_local_name(name));
        }
    }

    /// A block was executed; the run is now behind it, or where it jumped to.
    fn passed(&mut self, probe: &Probe, here: (usize, u32)) -> Result<(), HarnessError> {
        let Some(next) = self.next() else { return Ok(()) };
        let events = self.canon.take_events();
        let jumped = here != next;
        match self.next_form() {
            Form::Call if jumped => {
                // The call counts when it returns; what its block did, it did before the sub.
                if !events.is_empty() {
                    self.step(next, events, None);
                }
            }
            Form::Call | Form::Control | Form::Return => self.step(next, events, None),
            Form::Empty | Form::Percent if events.is_empty() => {}
            // A block with M2 that is passed did not execute it.
            Form::Empty | Form::Percent | Form::End | Form::Other => {
                let line = self.source.line(next.0, next.1);
                if !(self.block_delete && has_slash(line)) {
                    let shown = state::state(probe, self.canon.tool, self.plan)?;
                    let changes = shown.since(&self.known);
                    self.known.overlay(&changes);
                    self.step(next, events, Some(State::Rs274(changes)));
                }
            }
        }
        if jumped && form(self.source.line(here.0, here.1)) == Form::Call {
            self.step(here, Vec::new(), None);
        }
        Ok(())
    }

    fn step(&mut self, (file, line): (usize, u32), events: Vec<Event>, state: Option<State>) {
        self.steps.push(Step { block: self.source.block(file, line), events, state });
    }

    fn program_end(&mut self, seen: &Seen<'_>) -> Result<(), HarnessError> {
        let next = self.next().unwrap_or((0, 1));
        if self.next_form() == Form::Return {
            self.unsupported(
                "M99 in the main program: it ends here, though it should begin again".to_owned(),
            );
            return Ok(());
        }
        let Some(probe) = seen.after_end else {
            self.unsupported("an end whose state cannot be asked for".to_owned());
            return Ok(());
        };
        self.canon.end(|canon| canon.settle(probe))?;
        let events = self.canon.take_events();
        let mut shown = state::state(probe, self.canon.tool, self.plan)?;
        if self.level != 0 {
            self.led_elsewhere();
            at_end(&mut shown, seen.parameters);
        }
        let changes = shown.since(&self.known);
        self.step(next, events, Some(State::Rs274(changes)));
        self.end = Some(End::ProgramEnd);
        Ok(())
    }

    fn unsupported(&mut self, what: String) {
        let (file, line) = self.next().unwrap_or((0, 1));
        self.end = Some(End::Unsupported { block: self.source.block(file, line), what });
    }

    fn end(&mut self, seen: &Seen<'_>) -> Result<End, HarnessError> {
        if let Some(end) = self.end.take() {
            return Ok(end);
        }
        if self.at.is_none() {
            self.start = self.canon.now.clone();
        }
        if seen.refused {
            let next = self.next().or(Some((0, 1)));
            let mut fault = refusal::fault(seen.stderr, self.source, self.plan, next)?;
            if let Some(words) = refusal::message(seen.plain_stderr) {
                words.clone_into(&mut fault.message);
            }
            return Ok(End::Fault(fault));
        }
        if seen.cut_off {
            return Ok(End::BudgetExhausted { bound: Bound::Steps });
        }
        let line = seen.stderr.lines().last().unwrap_or_default().to_owned();
        Err(HarnessError::Unreadable { what: "a run without an end".to_owned(), line })
    }
}

/// Where a run ended in a sub, it was not the end but the stop before it that showed #1 to #30: the list at the end has
/// what they are.
fn at_end(shown: &mut Rs274State, parameters: Option<&BTreeMap<u32, f64>>) {
    let shown = shown.parameter.iter_mut().flat_map(|shown| shown.0.iter_mut());
    for (name, value) in shown {
        if let (Some(list), Ok(number @ 1..=30)) = (parameters, name.parse()) {
            *value = list.get(&number).copied().unwrap_or_default();
        }
    }
}

/// Cuts an outcome off where the budget ends; tells which bound did.
fn limit(outcome: &mut Outcome, budget: Budget) -> Option<Bound> {
    let steps = usize::try_from(budget.steps).unwrap_or(usize::MAX);
    let mut effects = 0;
    let is_effect = |event: &&Event| matches!(event, Event::Do(_));
    let keep = outcome.steps.iter().take_while(|step| {
        effects += step.events.iter().filter(is_effect).count();
        u32::try_from(effects).is_ok_and(|effects| effects <= budget.effects)
    });
    let keep = keep.count();
    let bound = if keep.min(steps) == outcome.steps.len() {
        return None;
    } else if keep < steps {
        Bound::Effects
    } else {
        Bound::Steps
    };
    outcome.steps.truncate(keep.min(steps));
    outcome.end = End::BudgetExhausted { bound };
    outcome.parameters = None;
    Some(bound)
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
        let seen = Seen {
            lines: &lines,
            stderr,
            plain_stderr: "",
            refused: true,
            cut_off: false,
            after_end: None,
            parameters: None,
        };
        let parameters = BTreeMap::from([(2, 7.0), (5220, 1.0), (5599, 1.0)]);
        let outcome = outcome(&scenario, &source, &plan, &seen, Some(parameters)).unwrap();
        assert_eq!(outcome.to_text(), include_str!("captured/repeat.outcome"));
    }

    #[test]
    fn a_run_without_an_end_is_an_error() {
        let scenario = Scenario::of("g4 p1\nm2\n");
        let source = Source::new(&scenario.program);
        let plan = Plan::new(&source, &BTreeSet::new());
        let seen = Seen {
            lines: &[],
            stderr: "",
            plain_stderr: "",
            refused: false,
            cut_off: false,
            after_end: None,
            parameters: None,
        };
        assert!(outcome(&scenario, &source, &plan, &seen, None).is_err());
    }
}
