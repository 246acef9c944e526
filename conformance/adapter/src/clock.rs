//! The clock: it ends waits and measures cost, and decides no outcome.

use std::time::Instant;

/// The time at which it is called.
#[expect(
    clippy::disallowed_methods,
    reason = "a foreign program may hang, and a campaign has an end; no outcome depends on the time"
)]
pub fn now() -> Instant {
    Instant::now()
}
