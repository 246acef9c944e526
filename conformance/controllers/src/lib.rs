//! Controllers that run in this process: production, the reference model, and variants of them.
//!
//! [`Production`] runs the interpreters of production and, for servo samples, its planner ([`simulate`]).
//! [`Reference`] is the specification itself. `Faulty` is production with a planted fault. [`Restricted`] holds a
//! controller to what another one exposes too.

#[cfg(feature = "faulty")]
pub mod faulty;
mod production;
mod reference;
mod restricted;
pub mod simulate;

use std::path::PathBuf;

pub use production::Production;
pub use reference::Reference;
pub use restricted::Restricted;

/// The file of a controller that runs in this process: the running program.
fn running_program() -> Vec<PathBuf> {
    std::env::current_exe().into_iter().collect()
}
