//! Each choice of `gpp`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::GPP;

    /// What a printed member of a modal array does.
    ArrayMembers = "gpp.array-members" {
        /// it goes off, like any modal variable
        GoOff = "go-off",
        /// it stays on
        StayOn = "stay-on",
    }

    /// What turns a variable on that has a value already and is assigned one by a statement.
    AssignedAgain = "gpp.assigned-again" {
        /// another value, as it is printed
        IfChanged = "if-changed",
        /// any value
        Always = "always",
        /// none: the first value alone turned it on
        FirstOnly = "first-only",
    }

    /// Where a variable has its modality from that nothing declares modal or non-modal.
    DefaultModality = "gpp.default-modality" {
        /// it is non-modal
        NonModal = "non-modal",
        /// from its format
        ByFormat = "by-format",
    }

    /// When the procedure of the newline symbol is run.
    Newline = "gpp.newline" {
        /// at each symbol
        Each = "each",
        /// once, before the next thing that is printed
        Lazy = "lazy",
    }

    /// Whether a modal variable is printed that is off.
    OffModal = "gpp.off-modal" {
        /// it is
        Printed = "printed",
        /// it is left out
        LeftOut = "left-out",
    }

    /// Whether the words of the old GPP are understood.
    OldWords = "gpp.old-words" {
        /// they are not statements of it
        Refused = "refused",
        /// RESET, `ALL_VAR`, `NON_MODAL`, and conditions in `IF_SET`
        Accepted = "accepted",
    }

    /// Where a number is rounded to that lies in the middle.
    Tie = "gpp.tie" {
        /// away from zero
        Away = "away",
        /// to the even digit
        Even = "even",
    }

    /// What a variable without a value is worth in an expression, a condition, or on the right of an
    /// assignment.
    WithoutValue = "gpp.without-value" {
        /// nothing: the statement is refused
        Refused = "refused",
        /// zero, or the empty text
        Zero = "zero",
    }
}
