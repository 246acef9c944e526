//! Each rule of `modal-groups`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::MODAL_GROUPS;

    /// Two arc distance modes (group 4) in one block are refused; they are apart from the distance mode.
    ARC_DISTANCE_GROUP = "modal-groups.arc-distance-group",
    /// A group 1 code and a group 0 code that both use axis words are refused in one block.
    AXIS_WORDS_TWICE = "modal-groups.axis-words-twice",
    /// Axis words in a block where no code uses them and no motion mode is active are refused.
    AXIS_WORDS_WITHOUT_MODE = "modal-groups.axis-words-without-mode",
    /// An M number, and ten times a G number, must lie within 0.0001 of an integer.
    CODE_CLOSE_TO_INTEGER = "modal-groups.code-close-to-integer",
    /// Whether decimals of a code that round to zero hundredths count is a choice; greater ones make another
    /// code of it.
    CODE_DECIMALS = "modal-groups.code-decimals",
    /// The number of a code may be an expression.
    CODE_FROM_EXPRESSION = "modal-groups.code-from-expression",
    /// Two cutter compensation codes (group 7) in one block are refused.
    COMPENSATION_GROUP = "modal-groups.compensation-group",
    /// Two equal coolant codes, or M9 with another one (M group 8), in one block are refused.
    COOLANT_GROUP = "modal-groups.coolant-group",
    /// Two distance modes (group 3) in one block are refused.
    DISTANCE_GROUP = "modal-groups.distance-group",
    /// Two feed modes (group 5) in one block are refused.
    FEED_MODE_GROUP = "modal-groups.feed-mode-group",
    /// A block holds zero to four M words; a fifth is refused.
    FOUR_M_WORDS = "modal-groups.four-m-words",
    /// G codes lie between 0 and 99; a number outside is refused.
    G_CODE_OUT_OF_RANGE = "modal-groups.g-code-out-of-range",
    /// A program begins in the XY plane, in radius mode, with incremental arc distance, blending without a
    /// tolerance, and in the coordinate system that `#5220` names.
    INITIAL_MODES = "modal-groups.initial-modes",
    /// The codes M62 to M68 exclude each other in one block, or are independent.
    IO_GROUP = "modal-groups.io-group",
    /// Two lathe diameter modes (group 15) in one block are refused.
    LATHE_GROUP = "modal-groups.lathe-group",
    /// M codes lie between 0 and 199; a number outside is refused.
    M_CODE_OUT_OF_RANGE = "modal-groups.m-code-out-of-range",
    /// Two motion codes (group 1) in one block are refused.
    MOTION_GROUP = "modal-groups.motion-group",
    /// A group 0 code that uses axis words suspends the motion mode for its block only.
    MOTION_SUSPENDED = "modal-groups.motion-suspended",
    /// Two non-modal codes (group 0) in one block are refused.
    NON_MODAL_GROUP = "modal-groups.non-modal-group",
    /// A non-modal code has effect on its own block only.
    NON_MODAL_ONCE = "modal-groups.non-modal-once",
    /// One member of a modal group is in force until another member replaces it; other groups are not
    /// touched.
    ONE_IN_FORCE = "modal-groups.one-in-force",
    /// A block may hold one code of every modal group.
    ONE_OF_EACH = "modal-groups.one-of-each",
    /// M48 and M49 (M group 9) in one block are refused.
    OVERRIDE_GROUP = "modal-groups.override-group",
    /// Two path control modes (group 13) in one block are refused.
    PATH_GROUP = "modal-groups.path-group",
    /// Two plane selections (group 2) in one block are refused.
    PLANE_GROUP = "modal-groups.plane-group",
    /// Grbl begins with G0, G17, G21, G54, G90, G91.1, G94, G49, M5 and M9, without a tool, a speed and a
    /// feed rate.
    POWER_UP = "modal-groups.power-up",
    /// Every letter other than G and M appears at most once in a block.
    REPEATED_LETTER = "modal-groups.repeated-letter",
    /// Two return modes (group 10) in one block are refused.
    RETURN_MODE_GROUP = "modal-groups.return-mode-group",
    /// Two spindle codes (M group 7) in one block are refused.
    SPINDLE_GROUP = "modal-groups.spindle-group",
    /// Two spindle speed modes (group 14) in one block are refused.
    SPINDLE_MODE_GROUP = "modal-groups.spindle-mode-group",
    /// Two stopping codes (M group 4) in one block are refused.
    STOPPING_GROUP = "modal-groups.stopping-group",
    /// M6 twice in one block is refused.
    TOOL_CHANGE_GROUP = "modal-groups.tool-change-group",
    /// Two tool length codes (group 8) in one block are refused.
    TOOL_LENGTH_GROUP = "modal-groups.tool-length-group",
    /// Two length units (group 6) in one block are refused.
    UNITS_GROUP = "modal-groups.units-group",
    /// A G code that is not part of the language is refused.
    UNKNOWN_G_CODE = "modal-groups.unknown-g-code",
    /// An M code that is not part of the language is refused.
    UNKNOWN_M_CODE = "modal-groups.unknown-m-code",
    /// I, J and K without a code that uses them are refused.
    UNUSED_ARC_WORD = "modal-groups.unused-arc-word",
    /// A word that no code of its block uses is refused.
    UNUSED_WORD = "modal-groups.unused-word",
    /// Two user-defined codes in one block are refused.
    USER_DEFINED_GROUP = "modal-groups.user-defined-group",
    /// Two coordinate system selections (group 12) in one block are refused.
    WORK_OFFSET_GROUP = "modal-groups.work-offset-group",
}
