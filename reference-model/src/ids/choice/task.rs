//! Each choice of `task`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::TASK;

    /// What becomes of a block by hand in manual mode. The documents name auto mode only, in which it is not
    /// enabled.
    MdiInManual = "task.mdi-in-manual" {
        /// the request is refused
        Refused = "refused",
        /// the block is executed
        Executed = "executed",
    }
}
