//! The runner: holds a controller to the documents, rule by rule.
//!
//! Data flows one way: the [suite](gaugeblock_suite) gives scenarios, an [adapter](gaugeblock_adapter) runs each on a
//! controller, the reference model runs it too, both outcomes are [folded, compared and
//! judged](gaugeblock_compare), and [`certify`] makes a verdict of it, which a report shows and [`expectations`] hold
//! against what is known. Generated programs take the same way ([`fuzz`], [`motion_programs`]).
//!
//! **Invariants.** The runner trusts no controller. What was not run, not understood or not shown is never a pass. The
//! order in which cases run changes nothing.

pub mod certify;
pub mod check;
pub mod expectations;
mod explain;
pub mod fingerprint;
pub mod fuzz;
pub mod journal;
pub mod motion_programs;
pub mod shard;
pub mod suite_check;
pub mod waivers;
