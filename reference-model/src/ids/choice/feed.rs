//! Each choice of `feed`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::FEED;

    /// Which feed rate is in force after a block under G93 that has no F: LinuxCNC does not take the last one
    /// away, Grbl sets it to zero in each such block.
    AfterInverseTime = "feed.after-inverse-time" {
        /// that of the last F
        Kept = "kept",
        /// none
        Zero = "zero",
    }
}
