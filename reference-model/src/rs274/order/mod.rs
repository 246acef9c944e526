//! The fixed order of execution inside a block.

mod phase;
mod rules;

pub use phase::{
    AfterPhase, Phase, Phases, has_axis_words, is_of_axis, moves_by_axis_words, moves_without_code,
};
pub use rules::{ORDER_RULES, OrderRule};

use super::evaluate::Words;
use super::execute;
use super::execute::compensation::Surroundings;
use super::execute::turning;
use super::refusal::StepError;
use super::state::State;
use super::task::Record;
use crate::ids::rule;

/// Operations of the order of execution that a dialect can replace.
pub(crate) trait OrderRules {
    /// The phases of a block that is executed.
    fn phases(&self, words: &Words, _state: &mut State) -> Phases {
        Phases::of(words)
    }

    /// Whether the next phase of a block is executed after this one: all of them are.
    fn goes_on_after(
        &self,
        _phase: Phase,
        _phases: Phases,
        _words: &Words,
        _state: &mut State,
    ) -> Result<bool, StepError> {
        Ok(true)
    }
}

/// Executes one phase of a block that [`check`](super::check::check) let pass.
///
/// # Errors
/// A rule that depends on the modes in force when the phase comes.
pub fn execute_phase(
    phase: Phase,
    words: &Words,
    state: &mut State,
    record: &mut Record,
) -> Result<AfterPhase, StepError> {
    let frame = state.curve.open.is_some().then(|| state.modes.frame());
    let along_path = Surroundings::of(state);
    let after_phase = perform_phase(phase, words, state, record);
    if let (true, Some(surroundings)) = (after_phase.is_ok() && phase < Phase::Motion, along_path) {
        surroundings.after(phase, state)?;
    }
    if after_phase.is_ok()
        && phase < Phase::Motion
        && frame.is_some_and(|frame| frame != state.modes.frame())
    {
        let why = "another length unit or offset within the data block of G5.2".to_owned();
        return Err(StepError::Unspecified(why));
    }
    if matches!(after_phase, Err(StepError::Refused(_))) {
        refused_at(phase, words, state);
    }
    after_phase
}

/// Why one of the phases of a block that come later would be refused, or is open.
pub(crate) fn fault_after(
    phase: Phase,
    phases: Phases,
    words: &Words,
    state: &State,
) -> Option<StepError> {
    let mut state = state.clone();
    let mut record = Record::new(&state);
    let mut later = phases.iter().skip_while(|before| *before != phase).skip(1);
    later.find_map(|phase| {
        if phase == Phase::Motion && turning::is_programmed(words) {
            let why = "a lathe cycle in a block that waits for ever".to_owned();
            return Some(StepError::Unspecified(why));
        }
        let executed = execute_phase(phase, words, &mut state, &mut record);
        executed.err().filter(|error| !matches!(error, StepError::WaitsForEver))
    })
}

/// A block has gone through all its phases: the rules about their order are reached.
///
/// Rule order.words-in-any-order. Words act phase by phase, whatever their order in the text.
pub fn completed(words: &Words, phases: Phases, state: &mut State) {
    if phases.count() > 0 {
        state.coverage.accepted(rule::order::WORDS_IN_ANY_ORDER);
    }
    if phases.count() < 2 {
        return;
    }
    for rule in ORDER_RULES.iter().filter(|rule| rule.concerns(words, phases)) {
        state.coverage.accepted(rule.rule);
    }
}

/// Executes one phase of a block.
fn perform_phase(
    phase: Phase,
    words: &Words,
    state: &mut State,
    record: &mut Record,
) -> Result<AfterPhase, StepError> {
    match phase {
        Phase::Comment => {
            if let Some(comment) = &words.comment {
                execute::message::perform(comment, state, record)?;
            }
        }
        Phase::FeedMode => state.dialect().select_feed_mode(words, state)?,
        Phase::FeedRate => execute::feed::set_rate(words, state)?,
        Phase::SpindleSpeed => execute::spindle::set_speed(words, state)?,
        Phase::SelectTool => execute::tool::select(words, state, record)?,
        Phase::InputsOutputs => inputs_outputs(words, state, record)?,
        Phase::ChangeTool if words.m.contains(&61) => {
            execute::tool_change::set_number(words, state, record)?;
        }
        Phase::ChangeTool => execute::tool_change::change(state, record)?,
        Phase::Spindle if words.m.contains(&19) => {
            state.dialect().orient(words, state, record)?;
        }
        Phase::Spindle => execute::spindle::turn(words, state)?,
        Phase::SavedState => execute::saved_state::perform(words, state, record)?,
        Phase::Coolant => execute::coolant::perform(words, state),
        Phase::Overrides => execute::overrides::perform(words, state)?,
        Phase::UserCode => {
            for code in words.m.iter().copied().filter(|code| (100..=199).contains(code)) {
                execute::user_codes::perform(code, words, state, record)?;
            }
        }
        Phase::Dwell => execute::dwell::perform(words, state, record)?,
        Phase::Plane => execute::units_planes::select_plane(words, state)?,
        Phase::Units => execute::units_planes::select_units(words, state)?,
        Phase::Compensation => execute::compensation::perform(words, state, record)?,
        Phase::ToolLength => execute::tool_length::perform(words, state)?,
        Phase::WorkOffset => execute::offsets::select(words, state)?,
        Phase::Path => state.dialect().select_path(words, state)?,
        Phase::Distance => execute::units_planes::select_distance(words, state),
        Phase::Retract => state.dialect().select_retract(words, state)?,
        Phase::OffsetData => execute::offsets::change(words, state, record)?,
        Phase::Motion => execute::motion::perform(words, state, record)?,
        Phase::Stop => return execute::stop::perform(words, state, record),
    }
    Ok(AfterPhase::Execute)
}

/// M62 to M68. Where a block may hold several of them they come as the list names them, wherever they stand
/// (order.words-in-any-order).
fn inputs_outputs(words: &Words, state: &mut State, record: &mut Record) -> Result<(), StepError> {
    let mut codes: Vec<u32> =
        words.m.iter().copied().filter(|code| (62..=68).contains(code)).collect();
    codes.sort_unstable();
    for code in codes {
        match code {
            62..=65 => execute::outputs::digital(code, words, state, record)?,
            66 => execute::inputs::perform(words, state, record)?,
            _ => execute::outputs::analog(code, words, state, record)?,
        }
    }
    Ok(())
}

/// A block was refused in a phase: the rules by which an earlier phase of the block made that so refuse it too.
fn refused_at(phase: Phase, words: &Words, state: &mut State) {
    let phases = Phases::of(words);
    let by_order = ORDER_RULES.iter().filter(|rule| rule.refuses && rule.later.contains(phase));
    for rule in by_order.filter(|rule| rule.concerns(words, phases)) {
        state.coverage.refused(rule.rule);
    }
}
