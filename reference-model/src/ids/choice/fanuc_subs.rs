//! Each choice of `fanuc-subs`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::FANUC_SUBS;

    /// Whether a subprogram can call itself: it must follow the call, but its beginning is before every block
    /// inside it.
    CallItself = "fanuc-subs.call-itself" {
        /// the subprogram precedes the call inside it
        Refused = "refused",
        /// it follows the first call, which is enough
        Allowed = "allowed",
    }

    /// Whether a numbered subprogram sees the local named parameters of its caller. No local of a calling
    /// procedure is visible in a called one; the list of differences of M98 names `#1` to `#30` only.
    NamedLocals = "fanuc-subs.named-locals" {
        /// local named parameters belong to the subprogram's own scope
        Hidden = "hidden",
        /// a subprogram has no scope of its own, for named parameters neither
        Shared = "shared",
    }

    /// What a call by M98 does to the value of an earlier o-word call: 11.7.10 clears it at the next
    /// subroutine call, the list of parameters at the next O-word call, which M98 is not.
    ValueAfterCall = "fanuc-subs.value-after-call" {
        /// a call by M98 clears both parameters, as every call does
        Cleared = "cleared",
        /// only an o-word call clears them
        Kept = "kept",
    }

    /// Whether the subprogram must exist that M98 L0 does not execute.
    ZeroCountUnknown = "fanuc-subs.zero-count-unknown" {
        /// a call is to a subprogram that follows
        Refused = "refused",
        /// what is not executed need not exist
        Accepted = "accepted",
    }
}
