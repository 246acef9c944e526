//! Each rule of `tool`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::TOOL;

    /// G43.2 adds the offset of a tool, or axis values, to the tool offset.
    ADDITIONAL_LENGTH = "tool.additional-length",
    /// G43.2 with the number of no tool is refused.
    ADDITIONAL_LENGTH_UNKNOWN_TOOL = "tool.additional-length-unknown-tool",
    /// G43.2 needs either H or axis words, not both and not none.
    ADDITIONAL_LENGTH_WORDS = "tool.additional-length-words",
    /// M6 puts the tool that T selected into the spindle.
    CHANGE = "tool.change",
    /// Where the machine is set so, it goes to the position of G30 before the tool change.
    CHANGE_AT_G30 = "tool.change-at-g30",
    /// The tool that was in the spindle goes back into the changer, and can be taken again.
    CHANGE_BACK = "tool.change-back",
    /// Where tools are changed by hand, M6 stops the spindle and requests the tool of the last T from the
    /// operator.
    CHANGE_BY_HAND = "tool.change-by-hand",
    /// M6 changes only tool and spindle.
    CHANGE_KEEPS = "tool.change-keeps",
    /// M6 leaves the tool length offset alone.
    CHANGE_KEEPS_LENGTH = "tool.change-keeps-length",
    /// Where the machine is set so, Z goes to machine zero before the tool change.
    CHANGE_QUILL_UP = "tool.change-quill-up",
    /// A change to the tool that is in the spindle is allowed.
    CHANGE_SAME = "tool.change-same",
    /// Where the machine is set so, the spindle turns on during a tool change.
    CHANGE_SPINDLE_ON = "tool.change-spindle-on",
    /// After M6 the spindle is stopped.
    CHANGE_STOPS_SPINDLE = "tool.change-stops-spindle",
    /// M6 is allowed, or refused, while cutter compensation is on.
    CHANGE_UNDER_COMPENSATION = "tool.change-under-compensation",
    /// M6 without a T since the last change is refused, or changes nothing.
    CHANGE_WITHOUT_SELECTION = "tool.change-without-selection",
    /// After a change with T0 no tool is in the spindle.
    CHANGE_ZERO = "tool.change-zero",
    /// G41 and G42 turn cutter compensation on to the left and right, G40 turns it off.
    COMPENSATION = "tool.compensation",
    /// G40 is allowed when cutter compensation is off.
    COMPENSATION_OFF_REPEATED = "tool.compensation-off-repeated",
    /// Cutter compensation may be turned on in the XY and ZX planes only, by a choice in the XY plane alone.
    COMPENSATION_PLANE = "tool.compensation-plane",
    /// D of G41 and G42 is a tool number or 0.
    COMPENSATION_TOOL = "tool.compensation-tool",
    /// Cutter compensation may not be turned on while it is on.
    COMPENSATION_TWICE = "tool.compensation-twice",
    /// G41.1 and G42.1 turn cutter compensation on with a diameter.
    DYNAMIC_COMPENSATION = "tool.dynamic-compensation",
    /// G41.1 and G42.1 without D are refused.
    DYNAMIC_COMPENSATION_NEEDS_DIAMETER = "tool.dynamic-compensation-needs-diameter",
    /// L of G41.1 and G42.1 is 0 to 9 and only allowed in the ZX plane.
    DYNAMIC_COMPENSATION_ORIENTATION = "tool.dynamic-compensation-orientation",
    /// G43.1 replaces the tool offset of the axes that it names, and moves nothing.
    DYNAMIC_LENGTH = "tool.dynamic-length",
    /// G43.1 without an axis word is refused.
    DYNAMIC_LENGTH_NEEDS_AXES = "tool.dynamic-length-needs-axes",
    /// A motion in the block of G43.1 is refused.
    DYNAMIC_LENGTH_WITH_MOTION = "tool.dynamic-length-with-motion",
    /// When no tool is in the slot that was selected, the spindle is empty after the change, or the selection
    /// is refused.
    EMPTY_SLOT = "tool.empty-slot",
    /// G10 L1 sets offsets, radius (R), front and back angle (I, J) and orientation (Q) of tool P in the tool
    /// table.
    ENTRY = "tool.entry",
    /// G10 L10 sets the offsets of tool P so that the current point gets the axis values once they are
    /// applied, with the coordinate system and the local offset in force.
    ENTRY_CALCULATED = "tool.entry-calculated",
    /// G10 L11 sets the offsets of tool P so that the current point gets the axis values in G59.3 without a
    /// local offset.
    ENTRY_CALCULATED_FIXTURE = "tool.entry-calculated-fixture",
    /// A tool offset that is in force stays when the tool table changes; the parameters of the tool in the
    /// spindle change at once.
    ENTRY_KEEPS_OFFSET = "tool.entry-keeps-offset",
    /// G10 L1, L10 and L11 without P are refused.
    ENTRY_NEEDS_NUMBER = "tool.entry-needs-number",
    /// G10 L1, L10 and L11 leave alone of a tool what they have no word for.
    ENTRY_OMITTED_WORDS = "tool.entry-omitted-words",
    /// Q of G10 L1, L10 and L11 must be an integer from 0 to 9.
    ENTRY_ORIENTATION = "tool.entry-orientation",
    /// G10 L1, L10 and L11 are refused while cutter compensation is on.
    ENTRY_UNDER_COMPENSATION = "tool.entry-under-compensation",
    /// P of G10 L1, L10 and L11 must be the number of a tool in the tool table.
    ENTRY_UNKNOWN_TOOL = "tool.entry-unknown-tool",
    /// Whether G10 L1 with only a tool is refused is a choice.
    ENTRY_WITHOUT_WORDS = "tool.entry-without-words",
    /// P0 of G10 L1, L10 and L11 is refused.
    ENTRY_ZERO = "tool.entry-zero",
    /// G43 with H applies the length offset of that tool.
    LENGTH = "tool.length",
    /// G43 moves nothing; the same point gets other coordinates.
    LENGTH_MOVES_NOTHING = "tool.length-moves-nothing",
    /// G43 with a negative H is refused.
    LENGTH_NEGATIVE = "tool.length-negative",
    /// G43 with an H that is not an integer is refused.
    LENGTH_NOT_AN_INTEGER = "tool.length-not-an-integer",
    /// Whether G43 with H0, or without H, applies the offset of the tool in the spindle is a choice.
    LENGTH_NUMBER_ZERO = "tool.length-number-zero",
    /// G49 cancels the tool length offset.
    LENGTH_OFF = "tool.length-off",
    /// Whether G49 in the block of a motion is refused is a choice.
    LENGTH_OFF_WITH_MOTION = "tool.length-off-with-motion",
    /// The same tool length offset may be programmed again, and G49 when none is used.
    LENGTH_REPEATED = "tool.length-repeated",
    /// Whether the tool offset can be changed while cutter compensation is on is a choice.
    LENGTH_UNDER_COMPENSATION = "tool.length-under-compensation",
    /// G43 with the number of no tool is refused.
    LENGTH_UNKNOWN_TOOL = "tool.length-unknown-tool",
    /// H0 means the tool in the spindle, and an offset of zero where there is none.
    LENGTH_ZERO = "tool.length-zero",
    /// G43 H0 applies the offset of tool 0 where tools change places, and is refused when the table has none.
    LENGTH_ZERO_RANDOM = "tool.length-zero-random",
    /// G10 L0 reads the tool table again, and changes neither a tool offset in force nor the position.
    RELOAD = "tool.reload",
    /// G10 L0 is refused while a tool is in the spindle.
    RELOAD_NEEDS_EMPTY_SPINDLE = "tool.reload-needs-empty-spindle",
    /// T prepares the tool of that number.
    SELECT = "tool.select",
    /// T changes no tool: that is done by M6.
    SELECT_CHANGES_NOTHING = "tool.select-changes-nothing",
    /// T is a whole number.
    SELECT_INTEGER = "tool.select-integer",
    /// Of several T words before a change the last one counts.
    SELECT_LATEST = "tool.select-latest",
    /// A negative T is refused.
    SELECT_NEGATIVE = "tool.select-negative",
    /// A T that is not in the tool table is refused, unless an empty slot may be selected.
    SELECT_UNKNOWN = "tool.select-unknown",
    /// T0 selects no tool where tools have fixed places.
    SELECT_ZERO = "tool.select-zero",
    /// Where tools change places, T0 is a tool like any other.
    SELECT_ZERO_RANDOM = "tool.select-zero-random",
    /// The number of T is that of a slot of the changer, or that of a tool.
    SELECTED_BY = "tool.selected-by",
    /// M61 says which tool is in the spindle, without a tool change.
    SET_NUMBER = "tool.set-number",
    /// M61 is allowed in a program, or belongs to MDI and manual mode only.
    SET_NUMBER_IN_PROGRAM = "tool.set-number-in-program",
    /// Q of M61 is a whole number.
    SET_NUMBER_INTEGER = "tool.set-number-integer",
    /// M61 leaves the tool length offset alone.
    SET_NUMBER_KEEPS_LENGTH = "tool.set-number-keeps-length",
    /// M61 without Q, or with a Q below zero, is refused.
    SET_NUMBER_RANGE = "tool.set-number-range",
    /// M61 with the number of no tool is refused, or accepted.
    SET_NUMBER_UNKNOWN = "tool.set-number-unknown",
    /// M61 Q0 says that no tool is in the spindle.
    SET_NUMBER_ZERO = "tool.set-number-zero",
    /// H without a code that uses it is refused.
    UNUSED_LENGTH = "tool.unused-length",
}
