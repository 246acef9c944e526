//! Each choice of `outputs`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::OUTPUTS;

    /// Whether M64, M65 and M68 take back what M62, M63 and M67 have asked of the same output. The sentence
    /// on later commands stands between both.
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

    /// Whether an abort takes back what M62, M63 and M67 have asked for. What they queue is done by the next
    /// motion command, and nothing says whether that of another program is one.
    WaitingAfterAbort = "outputs.waiting-after-abort" {
        /// it is gone with what else was queued
        Forgotten = "forgotten",
        /// it waits for the next motion, whoever asks for that
        Kept = "kept",
    }

    /// Whether what M62, M63 and M67 have asked for outlives the program. What they queue is done by the next
    /// motion command, and nothing says whether that of the next program is one.
    WaitingAfterEnd = "outputs.waiting-after-end" {
        /// it waits for the next motion, whoever asks for that
        Kept = "kept",
        /// it is gone with the program's end
        Forgotten = "forgotten",
    }
}
