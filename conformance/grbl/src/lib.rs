//! Controllers of the Grbl family under test: Grbl 1.1 and grblHAL, at a serial line or a socket.
//!
//! The adapter is a sender as the interface document describes it: it sends one block, waits for `ok`, `error:N` or
//! `ALARM:N`, and queries the modes (`$G`) before the next one. A soft reset precedes each program.
//!
//! Not observable: effects, so motions between the ends of blocks; messages; parameters; in check mode also positions
//! and, where the controller refuses `$#` then, offsets. Modes that `$G` does not report are not declared.
//!
//! **Invariants.**
//! * Nothing moves unless the caller chose motion: check mode is confirmed by the controller before the first block.
//! * No line is sent that is a system command or contains a real-time command, except by the adapter itself.
//! * Settings are read and never written. Coordinate systems are written only if permitted, and then restored.
//! * Each wait is bounded.

mod case;
mod dialect;
mod grbl;
mod identity;
mod interrupt;
mod message;
mod modes;
mod port;
mod session;
mod setup;
mod stored;
mod supports;
mod words;

pub use dialect::Dialect;
pub use grbl::Grbl;
pub use identity::LanguageCheck;
pub use interrupt::handles_signals;
pub use port::{BITS_PER_SECOND, Traffic};
pub use session::Limits;
pub use setup::{Address, Motion, Setup};
