//! Each rule of `gpp`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::GPP;

    /// All members of an array share one modality, which is declared for the array as a whole.
    ARRAY_MODALITY = "gpp.array-modality",
    /// A system variable such as `X_CURPOS` is set on when it is assigned another value than the one before.
    CHANGED = "gpp.changed",
    /// Two numbers are different only if the variable's format prints them differently.
    CHANGED_BY_FORMAT = "gpp.changed-by-format",
    /// Numbers are compared as they are printed, each variable in its own format, an expression in that of
    /// the other side.
    COMPARISON = "gpp.comparison",
    /// FORMAT declares variables of a format, once, before they are used, with names of letters and digits.
    DECLARATION = "gpp.declaration",
    /// A variable that nothing declares modal is non-modal in GPP2, texts, system variables and arrays
    /// included.
    DEFAULT_NON_MODAL = "gpp.default-non-modal",
    /// A variable is set on the first time that it is assigned a value.
    FIRST_ASSIGNMENT = "gpp.first-assignment",
    /// In the old GPP a variable has the modality of its format until it is declared; in GPP2 formats have
    /// none.
    FORMAT_MODALITY = "gpp.format-modality",
    /// Identical variables share value and set status, each in its own format; they are of one type and no
    /// arrays.
    IDENTICAL = "gpp.identical",
    /// When a variable is set off, those that are identical to it are.
    IDENTICAL_OFF = "gpp.identical-off",
    /// When a variable is set on, those that are identical to it are.
    IDENTICAL_ON = "gpp.identical-on",
    /// A modal variable that is printed takes those that are identical to it off, non-modal ones too.
    IDENTICAL_PRINTED = "gpp.identical-printed",
    /// An index is rounded to the nearest number of a member, from 1 to the array's size.
    INDEX = "gpp.index",
    /// Each member of an array is set on or off by itself.
    MEMBER_FLAG = "gpp.member-flag",
    /// A statement of the declaration part makes a variable modal, and none later.
    MODAL_DECLARATION = "gpp.modal-declaration",
    /// A member of a modal array goes off when it is printed, and the others do not; in the old GPP it stays
    /// on.
    MODAL_MEMBERS = "gpp.modal-members",
    /// Every variable is modal or non-modal.
    MODALITY = "gpp.modality",
    /// The symbol that `NEW_LINE_IS` names runs the statements after it when OUTPUT reaches the symbol.
    NEWLINE_SYMBOL = "gpp.newline-symbol",
    /// A non-modal variable can be turned off, if not by OUTPUT.
    NON_MODAL_OFF = "gpp.non-modal-off",
    /// A non-modal variable that is printed stays as it is.
    NON_MODAL_STAYS = "gpp.non-modal-stays",
    /// A number is printed rounded to the most digits after the point of its format, and filled up to the
    /// fewest.
    NUMBER_FORMAT = "gpp.number-format",
    /// A modal variable that is off is printed in GPP2; in the old GPP it is left out until it is set on.
    OFF_MODAL = "gpp.off-modal",
    /// A variable is printed although it is off.
    OFF_PRINTED = "gpp.off-printed",
    /// RESET, `ALL_VAR`, `NON_MODAL` and conditions in `IF_SET` belong to the old GPP.
    OLD_WORDS = "gpp.old-words",
    /// Modal and non-modal variables differ only in what OUTPUT and PRINT do to them.
    ONLY_PRINTING = "gpp.only-printing",
    /// A modal variable that OUTPUT prints is set off.
    OUTPUT_TURNS_OFF = "gpp.output-turns-off",
    /// A system variable such as `PART_TOL` is set on when the toolpath includes it, equal or not, and off
    /// when it does not.
    PRESENCE = "gpp.presence",
    /// A modal variable that PRINT prints is set off.
    PRINT_TURNS_OFF = "gpp.print-turns-off",
    /// Every variable, of the system or of a user, is set on or off, and both behave the same way.
    SET_FLAG = "gpp.set-flag",
    /// `SET_OFF` sets a variable off; its value stays.
    SET_OFF = "gpp.set-off",
    /// `SET_ON` sets a variable on; its value stays.
    SET_ON = "gpp.set-on",
    /// A program is made of declarations and blocks of statements, each ended by a semicolon.
    STATEMENT = "gpp.statement",
    /// IF, `IF_SET` and UNTIL test whether variables are set on or off.
    TESTED = "gpp.tested",
}
