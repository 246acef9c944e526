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

    /// Which feed rate is in force after a switch from inverse time to feed per minute: LinuxCNC needs a new
    /// one, NIST's report does not say, and its program has that of the last move.
    AfterModeChange = "feed.after-mode-change" {
        /// none
        None = "none",
        /// the rate per minute at which the last feed move was made
        OfLastMove = "of-last-move",
    }
}
