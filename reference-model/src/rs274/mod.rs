//! LinuxCNC's dialect of RS-274.
//!
//! | room | what it settles |
//! | --- | --- |
//! | [`text`] | files, lines, percent signs, block delete, comments split off |
//! | [`syntax`] | what a block may look like: words, settings, O-words, expressions |
//! | [`evaluate`] | a block's expressions evaluated: numbers for words |
//! | [`modes`] | the table of codes and modal groups; the modes in force |
//! | [`parameters`] | numbered and named parameters, scopes, the predefined ones |
//! | `planar` | lines and arcs in the plane, and the curves of a compensated tool along them |
//! | `turning` | profiles of lathe cycles: pieces, corners, offsets |
//! | [`state`] | the whole state, a sentence per field |
//! | [`check`] | what is refused before anything of the block is done |
//! | [`order`] | the fixed order of execution inside a block |
//! | [`execute`] | what each phase does |
//! | [`control`] | O-words, calls, M98 and M99: which block comes next |
//! | [`environment`] | the clock, the pins, how the environment answers |
//! | [`task`] | the run: modes of the controller, operator, start, blocks, budget, record, end |
//! | `needs` | what a program needs of the language, for controllers that have a part of it |
//! | [`dialect`] | the rules that a controller may follow otherwise |

pub mod check;
pub mod control;
pub(crate) mod dialect;
pub mod environment;
pub mod evaluate;
pub mod execute;
pub mod modes;
mod needs;
pub mod order;
pub mod parameters;
pub(crate) mod planar;
pub mod refusal;
pub mod state;
pub mod syntax;
pub mod task;
pub mod text;
pub(crate) mod turning;

use gaugeblock_vocabulary::{Outcome, Scenario};

use crate::RuleCoverage;

pub use needs::{CodeUse, LanguageNeeds, language_needs};
pub use task::RunCache;

/// Runs a scenario as the documents say.
pub fn run(
    cache: &mut RunCache,
    scenario: &Scenario,
    rounding: modes::Rounding,
) -> (Outcome, RuleCoverage) {
    task::run(cache, scenario, rounding)
}
