//! Each choice of `abort`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::ABORT;

    /// Whether an abort leaves modes and parameters as they are at the block that it breaks off, or as the
    /// interpreter has left them that reads ahead.
    ReadAhead = "abort.read-ahead" {
        /// nothing counts that was not executed
        None = "none",
        /// what was read ahead counts, up to a block that waits for the machine or to the end
        ReadOn = "read-on",
    }

    /// Whether an abort stops the spindles and switches coolant off. The documents say nothing of either.
    SpindleAndCoolant = "abort.spindle-and-coolant" {
        /// both are off
        SwitchedOff = "switched-off",
        /// both stay as they are
        LeftAlone = "left-alone",
    }
}
