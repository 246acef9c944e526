//! The operations that a dialect may replace; the module `dialects` of the crate installs one.
//!
//! A chapter states its rules as functions. The rules that a real controller follows differently are methods
//! of a trait of that chapter, such as [`RestoreRules`](super::execute::restore::RestoreRules): the default body of a
//! method is what the documents say. [`Documented`] takes every default. The chapters call such a rule through
//! [`State::dialect`], and know no other dialect.

use std::fmt::Debug;

use super::check::codes::CodeRules;
use super::check::needed::NeededWordRules;
use super::check::words::WordRules;
use super::control::ConditionRules;
use super::control::ControlRules;
use super::control::LoopRules;
use super::control::NumberedRules;
use super::control::SubroutineRules;
use super::evaluate::EvaluationRules;
use super::execute::arc::ArcRules;
use super::execute::compensation::CompensationRules;
use super::execute::cycles::CycleRules;
use super::execute::dwell::DwellRules;
use super::execute::feed::FeedRules;
use super::execute::inputs::InputRules;
use super::execute::local_offset::LocalOffsetRules;
use super::execute::message::MessageRules;
use super::execute::motion::MotionRules;
use super::execute::offsets::OffsetRules;
use super::execute::orient::OrientRules;
use super::execute::outputs::OutputRules;
use super::execute::overrides::OverrideRules;
use super::execute::path::PathRules;
use super::execute::positions::MachinePositionRules;
use super::execute::probe::ProbeRules;
use super::execute::program_end::ProgramEndRules;
use super::execute::restore::RestoreRules;
use super::execute::saved_state::SavedStateRules;
use super::execute::spindle::SpindleRules;
use super::execute::splines::SplineRules;
use super::execute::threading::ThreadRules;
use super::execute::threading::ThreadingRules;
use super::execute::tool_change::ToolChangeRules;
use super::execute::tool_length::ToolLengthRules;
use super::execute::tool_table::ToolTableRules;
use super::execute::turning::TurningRules;
use super::execute::units_planes::UnitsAndPlanesRules;
use super::modes::ModesRules;
use super::order::OrderRules;
use super::parameters::ParameterRules;
use super::state::State;
use super::syntax::SyntaxRules;
use super::task::TaskRules;
use super::text::TextRules;

/// Every operation that a dialect may replace.
pub(crate) trait Dialect:
    ArcRules
    + CodeRules
    + CompensationRules
    + ConditionRules
    + ControlRules
    + CycleRules
    + DwellRules
    + EvaluationRules
    + FeedRules
    + InputRules
    + LocalOffsetRules
    + LoopRules
    + MachinePositionRules
    + MessageRules
    + ModesRules
    + MotionRules
    + NeededWordRules
    + NumberedRules
    + OffsetRules
    + OrderRules
    + OrientRules
    + OutputRules
    + OverrideRules
    + ParameterRules
    + PathRules
    + ProbeRules
    + ProgramEndRules
    + RestoreRules
    + SavedStateRules
    + SpindleRules
    + SplineRules
    + SubroutineRules
    + SyntaxRules
    + TaskRules
    + TextRules
    + ThreadRules
    + ThreadingRules
    + ToolChangeRules
    + ToolLengthRules
    + ToolTableRules
    + TurningRules
    + UnitsAndPlanesRules
    + WordRules
    + Debug
    + Send
    + Sync
{
}

/// What the documents say.
#[derive(Debug)]
pub(crate) struct Documented;

impl ArcRules for Documented {}
impl CodeRules for Documented {}
impl CompensationRules for Documented {}
impl ConditionRules for Documented {}
impl ControlRules for Documented {}
impl CycleRules for Documented {}
impl DwellRules for Documented {}
impl EvaluationRules for Documented {}
impl FeedRules for Documented {}
impl InputRules for Documented {}
impl LocalOffsetRules for Documented {}
impl LoopRules for Documented {}
impl MachinePositionRules for Documented {}
impl MessageRules for Documented {}
impl ModesRules for Documented {}
impl MotionRules for Documented {}
impl NeededWordRules for Documented {}
impl NumberedRules for Documented {}
impl OffsetRules for Documented {}
impl OrderRules for Documented {}
impl OrientRules for Documented {}
impl OutputRules for Documented {}
impl OverrideRules for Documented {}
impl ParameterRules for Documented {}
impl PathRules for Documented {}
impl ProbeRules for Documented {}
impl ProgramEndRules for Documented {}
impl RestoreRules for Documented {}
impl SavedStateRules for Documented {}
impl SpindleRules for Documented {}
impl SplineRules for Documented {}
impl SubroutineRules for Documented {}
impl SyntaxRules for Documented {}
impl TaskRules for Documented {}
impl TextRules for Documented {}
impl ThreadRules for Documented {}
impl ThreadingRules for Documented {}
impl ToolChangeRules for Documented {}
impl ToolLengthRules for Documented {}
impl ToolTableRules for Documented {}
impl TurningRules for Documented {}
impl UnitsAndPlanesRules for Documented {}
impl WordRules for Documented {}
impl Dialect for Documented {}

impl State {
    /// The dialect of this run.
    pub(crate) fn dialect(&self) -> &'static dyn Dialect {
        self.choices.dialect()
    }
}
