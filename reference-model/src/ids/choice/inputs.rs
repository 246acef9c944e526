//! Each choice of `inputs`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::INPUTS;

    /// Whether M66 may be used while cutter compensation is on. The documents name no such error.
    UnderCompensation = "inputs.under-compensation" {
        /// it may
        Accepted = "accepted",
        /// it may not
        Refused = "refused",
    }

    /// Whether M66 may wait without Q. An example of the older text does so, and another one that waits for
    /// an analog input contradicts its own text and counts as a misprint; the later texts have Q in their
    /// example.
    WithoutTimeout = "inputs.without-timeout" {
        /// a wait needs Q
        Refused = "refused",
        /// without Q it waits as long as it takes
        Accepted = "accepted",
    }
}
