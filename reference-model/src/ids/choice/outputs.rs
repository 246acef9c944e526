//! Each choice of `outputs`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::OUTPUTS;

    /// Whether M64, M65 and M68 cancel what M62, M63 and M67 have queued for the same output. The sentence on
    /// later commands is between both.
    AtOnceOverWaiting = "outputs.at-once-over-waiting" {
        /// the output still changes with the next motion
        Kept = "kept",
        /// the latest command for the output counts, of either kind
        Replaces = "replaces",
    }

    /// Whether outputs may be switched while cutter compensation is on. The documents name no such error.
    UnderCompensation = "outputs.under-compensation" {
        /// they may
        Accepted = "accepted",
        /// they may not
        Refused = "refused",
    }

    /// Whether an abort cancels what M62, M63 and M67 have queued. The next motion command executes the
    /// queue, and no sentence says whether that may belong to another program.
    WaitingAfterAbort = "outputs.waiting-after-abort" {
        /// it is gone with what else was queued
        Forgotten = "forgotten",
        /// it waits for the next motion of any program
        Kept = "kept",
    }

    /// Whether what M62, M63 and M67 have queued outlives the program. The next motion command executes the
    /// queue, and no sentence says whether that may belong to the next program.
    WaitingAfterEnd = "outputs.waiting-after-end" {
        /// it waits for the next motion of any program
        Kept = "kept",
        /// it is gone with the program's end
        Forgotten = "forgotten",
    }
}
