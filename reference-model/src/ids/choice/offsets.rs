//! Each choice of `offsets`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::OFFSETS;

    /// Whether an offset that is in force can be changed while cutter compensation is on, by G52, G92, or G10
    /// L2 and L20 for the active coordinate system. It is not among their errors.
    ChangeUnderCompensation = "offsets.change-under-compensation" {
        /// the offset changes
        Accepted = "accepted",
        /// it cannot
        Refused = "refused",
    }
}
