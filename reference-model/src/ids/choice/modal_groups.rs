//! Each choice of `modal-groups`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::MODAL_GROUPS;

    /// How far the number of a code can be from that of a code of the language: LinuxCNC says 0.0001, of an M
    /// number or of ten times a G number; Grbl rounds its decimals to hundredths.
    CodeDecimals = "modal-groups.code-decimals" {
        /// G91.001 is not a code
        TenThousandths = "ten-thousandths",
        /// G91.001 is G91
        Hundredths = "hundredths",
    }

    /// The motion mode at the start of a program. One is always in effect; the documents do not say which.
    InitialMotion = "modal-groups.initial-motion" {
        /// G80
        None = "none",
        /// G1, as after a program end
        Feed = "feed",
        /// G0
        Traverse = "traverse",
    }

    /// The return mode of canned cycles at the start of a program. One of its group is in effect; the
    /// documents do not say which.
    InitialRetract = "modal-groups.initial-retract" {
        /// G99
        RPlane = "r-plane",
        /// G98
        OldZ = "old-z",
    }

    /// Whether M62 to M68 exclude each other in a block. The table names a group of inputs and outputs, and
    /// its members are not filled in.
    IoMembers = "modal-groups.io-members" {
        /// they do
        Exclusive = "exclusive",
        /// they do not
        Independent = "independent",
    }

    /// Whether M19, M98 and M99 are codes, and $ is a word. The table of EMC2 2.5 has none of the codes, and
    /// its chapter has one spindle, which no word selects.
    LaterCodes = "modal-groups.later-codes" {
        /// the language has them
        Known = "known",
        /// the language does not have them: a block with one is refused
        Unknown = "unknown",
    }

    /// Whether M50 to M53 belong to the modal group of M48 and M49. The table lists these two only; the order
    /// of execution names all six together.
    OverrideMembers = "modal-groups.override-members" {
        /// M48 and M49 only: M52 and M53 may be in one block
        Listed = "listed",
        /// M48 to M53 are one group
        All = "all",
    }
}
