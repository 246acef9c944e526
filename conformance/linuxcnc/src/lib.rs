//! LinuxCNC 2.9 as a controller under test: its stand-alone interpreter, and all of it with a simulated machine.
//!
//! Both observe the interpreter from within the program that it runs (`instrumentation`).
//!
//! **Invariant:** this crate does nothing that an adapter in another language could not do: it knows the vocabulary and
//! LinuxCNC, and no model of the language. `python/rs274.py` is such an adapter, and gets the same verdicts.

mod instrumentation;
mod rs274;
mod whole;

pub use rs274::{Rs274, in_inches};
pub use whole::LinuxCnc;
