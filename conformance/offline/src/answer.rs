//! A sheet filled in from what a controller did.

use gaugeblock_adapter::{Adapter, HarnessError, MotionRequest, NoSamples};
use gaugeblock_compare::Capabilities;
use gaugeblock_compare::observe::{Observed, value_of};
use gaugeblock_suite::assertion::is_accepted;
use gaugeblock_vocabulary::motion::MotionScript;
use gaugeblock_vocabulary::{Effect, End, Outcome, State};

use super::blocks::{Blocks, blocks_text};
use super::sheet::{MODES, Values, text};
use super::{ExportedProgram, Question, SAMPLES, SHEET};

/// The files of a program's folder that a person fills in, by name, filled in from a run; nothing that the controller
/// does not show. With `by_block`, positions after each block too, in place of the modes at the end.
///
/// # Errors
/// The controller failed: then there is nothing to fill in.
pub fn answer(
    question: &Question,
    controller: &dyn Adapter,
    by_block: bool,
) -> Result<Vec<(&'static str, String)>, HarnessError> {
    let Question { exported, scenario, limits } = question;
    let impossible = |why: &str| {
        vec![(SHEET, text(exported, &Values { not_possible: why.to_owned(), ..Values::default() }))]
    };
    if let Some(limits) = limits {
        let script = MotionScript::default();
        return match controller.record_motion(&MotionRequest {
            scenario,
            limits,
            script: &script,
            feed_interval: None,
        }) {
            Ok(samples) => Ok(vec![(SAMPLES, samples.to_csv())]),
            Err(NoSamples::Unsupported(why)) => Ok(impossible(&why)),
            Err(NoSamples::Failed(why)) => Err(why),
        };
    }
    if let Err(why) = controller.supports(scenario) {
        return Ok(impossible(&why));
    }
    let outcome = controller.run(scenario)?;
    if let End::Unsupported { what, .. } = &outcome.end {
        return Ok(impossible(what));
    }
    let observables = controller.observables(scenario);
    let mut values = values(exported, &outcome, &observables);
    let mut files = Vec::new();
    if by_block {
        values.modes.clear();
        files.push((super::BLOCKS, blocks_text(&exported.axes, &blocks(&outcome))));
    }
    files.push((SHEET, text(exported, &values)));
    Ok(files)
}

fn values(exported: &ExportedProgram, outcome: &Outcome, observables: &Capabilities) -> Values {
    let observed = Observed::of(outcome);
    let mut values = Values { ended: ended(&outcome.end).to_owned(), ..Values::default() };
    if let End::Fault(fault) = &outcome.end {
        values.alarm = fault.message.trim().to_owned();
        values.block = fault.block.clone().filter(|_| observables.faults_have_blocks);
    }
    let last = observed.steps.iter().rev().find(|step| step.state.is_some());
    if let Some(step) = last.filter(|_| is_accepted(&outcome.end)) {
        if let Some(State::Rs274(state)) = &step.state {
            values.position = state.position.filter(|_| observables.fields.contains("position"));
        }
        let mut entries = step.settings.entries();
        entries.extend(step.state.iter().flat_map(State::entries));
        let shown = MODES.iter().filter(|(mode, _)| observables.fields.contains(*mode));
        let known = shown.filter_map(|(mode, _)| {
            Some(((*mode).to_owned(), value_of(&entries, mode, None)?.to_string()))
        });
        values.modes = known.collect();
    }
    let is_hidden =
        |number| observables.hidden_parameters.iter().any(|range| range.contains(&number));
    if let Some(parameters) = outcome.parameters.as_ref().filter(|_| observables.final_parameters) {
        let exported = exported.variables.iter().filter(|number| !is_hidden(**number));
        let value = |number: &u32| parameters.0.get(number).copied().unwrap_or_default();
        values.variables = exported.map(|number| (*number, value(number))).collect();
    }
    if exported.messages && observables.effects.contains("message") {
        let message = |effect: &Effect| {
            let Effect::Message { channel, text } = effect else { return None };
            Some((*channel, text.clone()))
        };
        let messages = observed.effects.iter().filter_map(|shown| message(&shown.effect));
        values.messages = Some(messages.collect());
    }
    values
}

fn ended(end: &End) -> &'static str {
    match end {
        End::ProgramEnd => "program end",
        End::PercentEnd => "percent sign",
        End::Endless => "endless",
        End::Paused => "waiting",
        End::Aborted => "aborted",
        End::Fault(_) => "alarm",
        End::BudgetExhausted { .. } => "did not end",
        End::StreamEnd | End::Unsupported { .. } | End::Unspecified { .. } => "",
    }
}

/// Where the controlled point was after each block.
fn blocks(outcome: &Outcome) -> Blocks {
    let mut at = None;
    let mut blocks = Blocks::new();
    for step in &outcome.steps {
        if let Some(State::Rs274(state)) = &step.state {
            at = state.position.or(at);
        }
        let told = step.state.as_ref().map(|_| at.unwrap_or_default());
        blocks.push((step.block.clone(), told));
    }
    blocks
}
