//! Each rule of `offsets`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::OFFSETS;

    /// G10 L20 sets the origin of a coordinate system so that the current point gets the axis values in it,
    /// and moves nothing.
    CALCULATE = "offsets.calculate",
    /// G10 L20 needs an axis word.
    CALCULATE_NEEDS_AXES = "offsets.calculate-needs-axes",
    /// Whether an offset in force can be changed while cutter compensation is on is a choice.
    CHANGE_UNDER_COMPENSATION = "offsets.change-under-compensation",
    /// G52 shifts the coordinate system by its axis values and moves nothing.
    LOCAL = "offsets.local",
    /// G92.1 cancels the local offset of G92 and G52, moves nothing, and sets `#5210` to `#5219` to zero.
    LOCAL_CLEARED = "offsets.local-cleared",
    /// G52 without an axis word is refused.
    LOCAL_NEEDS_AXES = "offsets.local-needs-axes",
    /// G52 leaves the local offset of axes alone for which it has no word.
    LOCAL_OMITTED_AXES = "offsets.local-omitted-axes",
    /// `#5210` is 1 while a local offset is applied, `#5211` to `#5219` hold it.
    LOCAL_PARAMETERS = "offsets.local-parameters",
    /// The end of the program leaves the local offset as it is.
    LOCAL_PERSISTS = "offsets.local-persists",
    /// G52 counts from the coordinate system, not from an earlier G52; zero cancels it.
    LOCAL_REPLACES = "offsets.local-replaces",
    /// G92.3 applies the offset that `#5211` to `#5219` hold.
    LOCAL_RESUMED = "offsets.local-resumed",
    /// A local offset continues when an origin is set or another coordinate system is selected.
    LOCAL_STAYS = "offsets.local-stays",
    /// G92.2 cancels the local offset of G92 and G52, and leaves `#5211` to `#5219`.
    LOCAL_SUSPENDED = "offsets.local-suspended",
    /// A move with G53 goes to machine coordinates, whatever offsets are active.
    MACHINE_COORDINATES = "offsets.machine-coordinates",
    /// G53 in incremental distance mode goes to the absolute point all the same.
    MACHINE_INCREMENTAL = "offsets.machine-incremental",
    /// G53 may use the G0 or G1 that is active.
    MACHINE_MOTION = "offsets.machine-motion",
    /// G53 needs an axis word.
    MACHINE_NEEDS_AXES = "offsets.machine-needs-axes",
    /// G53 without G0 or G1 active is refused.
    MACHINE_NEEDS_MOTION = "offsets.machine-needs-motion",
    /// G53 holds for its own block only.
    MACHINE_ONCE = "offsets.machine-once",
    /// G53 while cutter compensation is on is refused.
    MACHINE_UNDER_COMPENSATION = "offsets.machine-under-compensation",
    /// G92 gives the point where the machine is the coordinates of its axis words, and moves nothing.
    POSITION = "offsets.position",
    /// The offset of G92 applies in every coordinate system.
    POSITION_ALL_SYSTEMS = "offsets.position-all-systems",
    /// G92 without an axis word is refused.
    POSITION_NEEDS_AXES = "offsets.position-needs-axes",
    /// After G92 an axis for which it has no word has no local offset.
    POSITION_OMITTED_AXES = "offsets.position-omitted-axes",
    /// Whether G92 leaves the local offset of axes alone for which it has no word is a choice.
    POSITION_OTHER_AXES = "offsets.position-other-axes",
    /// `#5211` to `#5219` hold the offset of G92 in the machine's unit, and `#5210` is 1.
    POSITION_PARAMETERS = "offsets.position-parameters",
    /// The offset that G92 makes takes the place of an earlier one, of G52 or G92.
    POSITION_REPLACES = "offsets.position-replaces",
    /// `#5211` to `#5216` hold the offset that G92 makes, axis by axis from X to C.
    POSITION_STORED = "offsets.position-stored",
    /// R of G10 L2 turns the coordinate system about Z through its origin, counterclockwise in degrees;
    /// without R the rotation stays.
    ROTATION = "offsets.rotation",
    /// G54 to G59.3 select coordinate systems 1 to 9.
    SELECT = "offsets.select",
    /// A coordinate system stays selected until another is.
    SELECT_HOLDS = "offsets.select-holds",
    /// Selecting a coordinate system moves nothing; the same point gets the coordinates of the new system.
    SELECT_MOVES_NOTHING = "offsets.select-moves-nothing",
    /// `#5220` holds the number of the coordinate system that is active.
    SELECT_NUMBER = "offsets.select-number",
    /// Selecting a coordinate system while cutter compensation is on is refused.
    SELECT_UNDER_COMPENSATION = "offsets.select-under-compensation",
    /// G10 L2 P1 to P9 sets the origin of that coordinate system to the axis values.
    SET = "offsets.set",
    /// P0 of G10 L2 means the active coordinate system.
    SET_ACTIVE = "offsets.set-active",
    /// Whether P0 of G10 L2 is refused is a choice.
    SET_ACTIVE_NUMBER = "offsets.set-active-number",
    /// A new origin of the active coordinate system takes effect at once and moves nothing.
    SET_IMMEDIATE = "offsets.set-immediate",
    /// G10 L2 selects no coordinate system.
    SET_INACTIVE = "offsets.set-inactive",
    /// G10 without L, or with an L that does not exist, is refused.
    SET_NEEDS_KIND = "offsets.set-needs-kind",
    /// G10 L2 without P is refused.
    SET_NEEDS_NUMBER = "offsets.set-needs-number",
    /// P of G10 L2 must be an integer from 0 to 9.
    SET_NUMBER = "offsets.set-number",
    /// G10 L2 leaves the axes alone for which it has no word, and all axis words are optional.
    SET_OMITTED_AXES = "offsets.set-omitted-axes",
    /// The values of G10 L2 replace the old ones, whatever the distance mode.
    SET_REPLACES = "offsets.set-replaces",
    /// G10 L2 with an axis that the machine does not have is refused.
    SET_UNKNOWN_AXIS = "offsets.set-unknown-axis",
    /// Whether G10 L2 without an axis word is refused is a choice.
    SET_WITHOUT_AXES = "offsets.set-without-axes",
    /// `#5220` names the coordinate system at the start; without a number from 1 to 9 it is the first.
    START_SYSTEM = "offsets.start-system",
    /// The origin of a coordinate system comes from its stored parameters.
    STORED = "offsets.stored",
    /// P of G10 L2 and L20 is 0 to 6 at least, and not above 9; whether P7 to P9 are refused is a choice.
    SYSTEMS = "offsets.systems",
}
