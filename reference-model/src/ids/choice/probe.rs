//! Each choice of `probe`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::PROBE;

    /// Whether a straight probe is a feed move, which G96 forbids while the spindle does not turn. It is made
    /// at the feed rate, and a probe does not turn.
    StandingSpindle = "probe.standing-spindle" {
        /// it is none
        Accepted = "accepted",
        /// it is one
        Refused = "refused",
    }
}
