//! Each rule of `order`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::ORDER;

    /// A comment acts before all words of its block.
    COMMENT_FIRST = "order.comment-first",
    /// Cutter compensation is turned on or off before tool length compensation is.
    COMPENSATION_BEFORE_TOOL_LENGTH = "order.compensation-before-tool-length",
    /// Cutter compensation is turned on or off before a coordinate system is selected.
    COMPENSATION_BEFORE_WORK_OFFSET = "order.compensation-before-work-offset",
    /// Coolant codes act before a dwell.
    COOLANT_BEFORE_DWELL = "order.coolant-before-dwell",
    /// The distance mode is set before the block's motion.
    DISTANCE_BEFORE_MOTION = "order.distance-before-motion",
    /// A dwell acts before cutter compensation is turned on or off.
    DWELL_BEFORE_COMPENSATION = "order.dwell-before-compensation",
    /// A dwell acts before the distance mode and the return mode are set.
    DWELL_BEFORE_DISTANCE = "order.dwell-before-distance",
    /// A dwell acts before the block's motion.
    DWELL_BEFORE_MOTION = "order.dwell-before-motion",
    /// A dwell acts before the path control mode is set.
    DWELL_BEFORE_PATH = "order.dwell-before-path",
    /// A dwell acts before the plane is selected.
    DWELL_BEFORE_PLANE = "order.dwell-before-plane",
    /// A dwell acts before tool length compensation is turned on or off.
    DWELL_BEFORE_TOOL_LENGTH = "order.dwell-before-tool-length",
    /// A dwell acts before the length unit is set.
    DWELL_BEFORE_UNITS = "order.dwell-before-units",
    /// A dwell acts before a coordinate system is selected.
    DWELL_BEFORE_WORK_OFFSET = "order.dwell-before-work-offset",
    /// Feed mode, feed rate and spindle speed are set before the modal state is saved.
    FEED_AND_SPEED_BEFORE_SAVE = "order.feed-and-speed-before-save",
    /// The feed rate is set before the block's motion.
    FEED_BEFORE_MOTION = "order.feed-before-motion",
    /// The feed rate is set before the length unit: F in the block of a change is still read in the old unit.
    FEED_BEFORE_UNITS = "order.feed-before-units",
    /// The feed mode is set before the feed rate.
    FEED_MODE_BEFORE_FEED = "order.feed-mode-before-feed",
    /// Whether F in the block that changes the length unit is read in the old unit is a choice.
    FEED_UNIT = "order.feed-unit",
    /// An axis offset is cancelled or brought back before the block's motion.
    OFFSET_DATA_BEFORE_MOTION = "order.offset-data-before-motion",
    /// In a block the outputs are switched before the tool change.
    OUTPUTS_BEFORE_TOOL_CHANGE = "order.outputs-before-tool-change",
    /// Override codes act before a dwell.
    OVERRIDES_BEFORE_DWELL = "order.overrides-before-dwell",
    /// In a block the overrides are switched before a user-defined code is executed.
    OVERRIDES_BEFORE_USER_CODE = "order.overrides-before-user-code",
    /// The path control mode is set before the block's motion.
    PATH_BEFORE_MOTION = "order.path-before-motion",
    /// The plane is selected before cutter compensation is turned on.
    PLANE_BEFORE_COMPENSATION = "order.plane-before-compensation",
    /// The plane is selected before the block's motion.
    PLANE_BEFORE_MOTION = "order.plane-before-motion",
    /// The modal state is restored before the block's coolant codes act.
    RESTORE_BEFORE_COOLANT = "order.restore-before-coolant",
    /// The modal state is restored before the block's G code modes from plane to distance act.
    RESTORE_BEFORE_MODES = "order.restore-before-modes",
    /// The modal state is restored before the block's override codes act.
    RESTORE_BEFORE_OVERRIDES = "order.restore-before-overrides",
    /// The return mode is set before the block's motion.
    RETURN_MODE_BEFORE_MOTION = "order.return-mode-before-motion",
    /// The modal state is saved before the block's coolant codes act.
    SAVE_BEFORE_COOLANT = "order.save-before-coolant",
    /// The modal state is saved before the block's G code modes from plane to distance act.
    SAVE_BEFORE_MODES = "order.save-before-modes",
    /// The modal state is saved before the block's override codes act.
    SAVE_BEFORE_OVERRIDES = "order.save-before-overrides",
    /// In a block T is executed before the outputs.
    SELECT_BEFORE_OUTPUTS = "order.select-before-outputs",
    /// In a block T is executed before M6.
    SELECT_BEFORE_TOOL_CHANGE = "order.select-before-tool-change",
    /// The spindle speed is set and the spindle started before a dwell; which of the two comes first does not
    /// show.
    SPEED_BEFORE_SPINDLE = "order.speed-before-spindle",
    /// Feed rate, spindle speed and spindle codes act before a dwell.
    SPINDLE_BEFORE_DWELL = "order.spindle-before-dwell",
    /// Feed rate, spindle speed and spindle codes act before the modal state is restored.
    SPINDLE_BEFORE_RESTORE = "order.spindle-before-restore",
    /// The spindle starts or stops before the modal state is saved.
    SPINDLE_BEFORE_SAVE = "order.spindle-before-save",
    /// A program end acts after everything else in its block.
    STOP_LAST = "order.stop-last",
    /// In a block the tool change comes before the spindle codes.
    TOOL_CHANGE_BEFORE_SPINDLE = "order.tool-change-before-spindle",
    /// Tool length compensation is turned on or off before the block's motion.
    TOOL_LENGTH_BEFORE_MOTION = "order.tool-length-before-motion",
    /// The length unit is set before the block's motion.
    UNITS_BEFORE_MOTION = "order.units-before-motion",
    /// The length unit is set before offsets are set.
    UNITS_BEFORE_OFFSET_DATA = "order.units-before-offset-data",
    /// The length unit is set before the path control mode.
    UNITS_BEFORE_PATH = "order.units-before-path",
    /// The length unit is set before tool length compensation.
    UNITS_BEFORE_TOOL_LENGTH = "order.units-before-tool-length",
    /// In a block a user-defined code is executed before plane, units, compensation and the other modes.
    USER_CODE_BEFORE_MODES = "order.user-code-before-modes",
    /// The place of a word in its block does not change the block's meaning.
    WORDS_IN_ANY_ORDER = "order.words-in-any-order",
    /// A coordinate system is selected before the block's motion.
    WORK_OFFSET_BEFORE_MOTION = "order.work-offset-before-motion",
    /// A coordinate system is selected before offset data are changed.
    WORK_OFFSET_BEFORE_OFFSET_DATA = "order.work-offset-before-offset-data",
}
