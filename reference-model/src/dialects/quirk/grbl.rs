//! Each quirk of `grbl`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

quirks! {
    super::first::GRBL;

    /// Of the number of a G or M code fourteen bits count: 16384 more than a code is that code.
    CODE_NUMBER_BITS = "grbl.code-number-bits",
    /// Eight digits of a number count, zeros before them too; further ones become zeros.
    EIGHT_DIGITS = "grbl.eight-digits",
    /// G49 may have any decimals.
    LENGTH_OFF_DECIMALS = "grbl.length-off-decimals",
    /// The greatest line number is 10,000,000; one of more than 32 bits is accepted, too.
    LINE_NUMBER_LIMIT = "grbl.line-number-limit",
    /// In the block of G92.1 absolute axis words count with the offset that the code cancels.
    OFFSET_CANCELLED_LATE = "grbl.offset-cancelled-late",
    /// Of L of G10 the whole part counts, and of that eight bits.
    OFFSET_KIND_CUT = "grbl.offset-kind-cut",
    /// An arc with a radius may end where it starts in its plane if the third coordinate changes; its centre
    /// is undefined.
    RADIUS_HELIX = "grbl.radius-helix",
    /// G10 L2 and L20 without P set the active coordinate system.
    SET_WITHOUT_NUMBER = "grbl.set-without-number",
    /// Of P of G10 L2 and L20 the whole part counts, and of that eight bits.
    SYSTEM_NUMBER_BITS = "grbl.system-number-bits",
    /// Of T the whole part counts.
    TOOL_NUMBER_CUT = "grbl.tool-number-cut",
}
