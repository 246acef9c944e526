//! Controllers of this project and real ones, each behind [`Adapter`](gaugeblock_adapter::Adapter).

#[cfg(feature = "faulty")]
pub mod faulty;
pub mod linuxcnc;
pub mod narrowed;
pub mod offline;
mod probing;
pub mod production;
pub mod reference;
pub mod rs274;
