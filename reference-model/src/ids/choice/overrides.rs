//! Each choice of `overrides`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::OVERRIDES;

    /// Whether M48 and M49 with $ switch the feed override too: they enable and disable both controls, and $
    /// says on which spindle they operate.
    SelectedFeed = "overrides.selected-feed" {
        /// $ selects among speed overrides; the one feed override is switched in any case
        Switched = "switched",
        /// with $ the codes concern a spindle and nothing else; a controller that takes no $ leaves the feed
        /// override alone too
        Untouched = "untouched",
    }

    /// Whether M48 to M53 are allowed while cutter compensation is on. The documents name no such error.
    UnderCompensation = "overrides.under-compensation" {
        /// they are
        Accepted = "accepted",
        /// they are not
        Refused = "refused",
    }

    /// Which spindles the speed override of M48, M49 and M51 without $ concerns. The documents say that $
    /// selects one.
    WithoutDollar = "overrides.without-dollar" {
        /// all spindles
        All = "all",
        /// spindle 0
        First = "first",
    }
}
