//! The runner compares a controller with the documents, rule by rule.
//!
//! Data flows one way: the [suite](gaugeblock_suite) gives scenarios, an [adapter](gaugeblock_adapter) runs each on a
//! controller, and the reference model runs it too. Both outcomes are [folded, compared and
//! judged](gaugeblock_compare). [`certify`] makes a verdict, which a report prints and [`expectations`] compare with
//! known divergences. Generated programs take the same way ([`fuzz`], [`motion_programs`]).
//!
//! **Invariants.** The runner trusts no controller. A case that was not run, not understood or not observable never
//! passes. The order in which cases run changes nothing.

pub mod certify;
pub mod check;
pub mod expectations;
mod explain;
pub mod findings;
pub mod fingerprint;
pub mod fuzz;
pub mod journal;
pub mod language;
pub mod measure;
mod model_run;
pub mod motion_programs;
mod observables;
mod orphans;
pub mod shard;
pub mod suite_check;
pub mod waivers;

pub use explain::other_controller;
