//! Each rule of `dwell`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::DWELL;

    /// G4 does not affect spindle, coolant, position or motion mode.
    CHANGES_NOTHING = "dwell.changes-nothing",
    /// G4 without P is refused.
    NEEDS_TIME = "dwell.needs-time",
    /// G4 with a negative P is refused.
    NEGATIVE_TIME = "dwell.negative-time",
    /// G4 is not modal.
    ONCE = "dwell.once",
    /// G4 waits P seconds, fractions included.
    SECONDS = "dwell.seconds",
    /// G4 P0 is allowed.
    ZERO_TIME = "dwell.zero-time",
}
