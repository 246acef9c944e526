//! The operations that a dialect may replace, and the place where one is installed.
//!
//! A chapter states its rules as functions. The rules that a real controller is known to follow otherwise are methods
//! of a trait of that chapter, such as [`RestoreRules`](super::execute::restore::RestoreRules): the default body of a
//! method is what the documents say. [`Documented`] takes every default. The chapters call such a rule through
//! [`State::dialect`], and know no other dialect.

use std::fmt::Debug;

use super::evaluate::EvaluationRules;
use super::execute::arc::ArcRules;
use super::execute::cycles::CycleRules;
use super::execute::feed::FeedRules;
use super::execute::message::MessageRules;
use super::execute::motion::MotionRules;
use super::execute::path::PathRules;
use super::execute::positions::MachinePositionRules;
use super::execute::restore::RestoreRules;
use super::execute::saved_state::SavedStateRules;
use super::execute::tool_length::ToolLengthRules;
use super::execute::units_planes::UnitsAndPlanesRules;
use super::order::OrderRules;
use super::parameters::ParameterRules;
use super::state::State;
use super::syntax::SyntaxRules;
use super::text::TextRules;
use crate::Choices;
use crate::dialects::operations;
pub(crate) use crate::dialects::{Memory, ModalMemory};

/// Every operation that a dialect may replace.
pub(crate) trait Dialect:
    ArcRules
    + CycleRules
    + EvaluationRules
    + FeedRules
    + MachinePositionRules
    + MessageRules
    + MotionRules
    + OrderRules
    + ParameterRules
    + PathRules
    + RestoreRules
    + SavedStateRules
    + SyntaxRules
    + TextRules
    + ToolLengthRules
    + UnitsAndPlanesRules
    + Debug
    + Send
    + Sync
{
}

/// What the documents say.
#[derive(Debug)]
pub(crate) struct Documented;

impl ArcRules for Documented {}
impl CycleRules for Documented {}
impl EvaluationRules for Documented {}
impl FeedRules for Documented {}
impl MachinePositionRules for Documented {}
impl MessageRules for Documented {}
impl MotionRules for Documented {}
impl OrderRules for Documented {}
impl ParameterRules for Documented {}
impl PathRules for Documented {}
impl RestoreRules for Documented {}
impl SavedStateRules for Documented {}
impl SyntaxRules for Documented {}
impl TextRules for Documented {}
impl ToolLengthRules for Documented {}
impl UnitsAndPlanesRules for Documented {}
impl Dialect for Documented {}

impl State {
    /// The dialect of this run.
    pub(crate) fn dialect(&self) -> &'static dyn Dialect {
        self.choices.dialect()
    }
}

impl Choices {
    /// The dialect of this run.
    pub(crate) fn dialect(&self) -> &'static dyn Dialect {
        operations(self)
    }
}
