//! Each rule of `saved-state`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::SAVED_STATE;

    /// Whether adaptive feed is used is part of the saved state.
    ADAPTIVE_FEED = "saved-state.adaptive-feed",
    /// A restore brings back all of the saved state, not a part of it.
    ALL_RESTORED = "saved-state.all-restored",
    /// The arc distance mode is part of the saved state.
    ARC_DISTANCE = "saved-state.arc-distance",
    /// After M71 a sub with M73 restores nothing at its end.
    AUTORESTORE_CANCELLED = "saved-state.autorestore-cancelled",
    /// A sub with M73 restores at its end the state in force at the M73.
    AUTORESTORE_ENDSUB = "saved-state.autorestore-endsub",
    /// The state that M73 saved also serves M72 at the same call level.
    AUTORESTORE_EXPLICIT = "saved-state.autorestore-explicit",
    /// A run that is broken off in a sub with M73 does not restore.
    AUTORESTORE_FAULT = "saved-state.autorestore-fault",
    /// A subprogram with M73 restores at its M99.
    AUTORESTORE_M99 = "saved-state.autorestore-m99",
    /// M73 in the main program saves as M70 does, for a later M72.
    AUTORESTORE_MAIN = "saved-state.autorestore-main",
    /// Each sub with M73 restores its own caller's state, through nesting and recursion.
    AUTORESTORE_NESTED = "saved-state.autorestore-nested",
    /// A program end, in the main program or in a sub with M73, does not restore.
    AUTORESTORE_PROGRAM_END = "saved-state.autorestore-program-end",
    /// A sub with M73 restores on every return path, from inside conditions and loops too.
    AUTORESTORE_RETURN = "saved-state.autorestore-return",
    /// Where M70 and M73 have a place each, an M70 after an M73 does not change what the end of the sub
    /// restores; where they share one, that is what M70 saved.
    AUTORESTORE_THEN_SAVE = "saved-state.autorestore-then-save",
    /// In a block the save follows feed, speed and spindle words and comes before coolant and the preparatory
    /// codes; the restore has the same place.
    BLOCK_ORDER = "saved-state.block-order",
    /// Where M70 and M73 have a place each, an M70 after M73 and M71 does not revive the cancelled restore at
    /// the end of the sub; where they share one, it does.
    CANCELLED_THEN_SAVED = "saved-state.cancelled-then-saved",
    /// The status of cutter compensation, off, left or right, is part of the saved state.
    COMPENSATION = "saved-state.compensation",
    /// The distance mode is part of the saved state.
    DISTANCE = "saved-state.distance",
    /// On a machine with several spindles the saved state holds speed, mode and status of each of them.
    EACH_SPINDLE = "saved-state.each-spindle",
    /// A subprogram called by M98 is a call level of its own.
    FANUC_LEVEL = "saved-state.fanuc-level",
    /// The value of F is part of the saved state.
    FEED = "saved-state.feed",
    /// The feed mode is part of the saved state.
    FEED_MODE = "saved-state.feed-mode",
    /// The feed comes back together with the feed mode in which it was given.
    FEED_OF_FEED_MODE = "saved-state.feed-of-feed-mode",
    /// Whether the feed override is enabled is part of the saved state.
    FEED_OVERRIDE = "saved-state.feed-override",
    /// Whether the feed stop switch is enabled is part of the saved state.
    FEED_STOP = "saved-state.feed-stop",
    /// Whether flood coolant is on is part of the saved state, apart from mist.
    FLOOD = "saved-state.flood",
    /// After M71 a restore at the same call level is refused.
    INVALIDATED = "saved-state.invalidated",
    /// M71 invalidates the saved state of its own call level and of no other.
    INVALIDATED_LEVEL = "saved-state.invalidated-level",
    /// For M72 a call level has one place for a saved state: the latest save counts.
    LATEST_SAVE = "saved-state.latest-save",
    /// The lathe mode, diameter or radius, is part of the saved state.
    LATHE = "saved-state.lathe",
    /// The main program is a call level of its own: its saved state outlives the subs that it calls, whatever
    /// they save.
    MAIN_LEVEL = "saved-state.main-level",
    /// Whether mist coolant is on is part of the saved state, apart from flood.
    MIST = "saved-state.mist",
    /// The two overrides are saved apart: each mixture of enabled and disabled comes back.
    MIXED_OVERRIDES = "saved-state.mixed-overrides",
    /// The motion mode is not restored; only the draft lists it, and there it comes back.
    MOTION_MODE = "saved-state.motion-mode",
    /// What the list of the saved state leaves out is not restored: parameters, offset values, the prepared
    /// tool, the position.
    NOT_LISTED = "saved-state.not-listed",
    /// Restoring where nothing was saved at this call level is refused.
    NOTHING_SAVED = "saved-state.nothing-saved",
    /// An orientation does not belong to the saved state, whose spindle status is M3, M4 or M5: a spindle
    /// that was at an angle when it was saved does not turn after the restore.
    ORIENTATION_NOT_SAVED = "saved-state.orientation-not-saved",
    /// The path control mode is part of the saved state.
    PATH = "saved-state.path",
    /// The two tolerances of G64 come back with the path control mode.
    PATH_TOLERANCES = "saved-state.path-tolerances",
    /// The selected plane, one of six, is part of the saved state.
    PLANE = "saved-state.plane",
    /// A recursive call of a sub is a new call level with its own saved state.
    RECURSION = "saved-state.recursion",
    /// A restore does not use up the saved state: it can be repeated.
    REPEATED_RESTORE = "saved-state.repeated-restore",
    /// The retract mode of canned cycles is part of the saved state.
    RETRACT = "saved-state.retract",
    /// A save by M70 in a sub does not restore anything at the sub's end.
    SAVE_ALONE = "saved-state.save-alone",
    /// M70 saves the modal state at the current call level; M72 brings back exactly that state.
    SAVE_RESTORE = "saved-state.save-restore",
    /// After M71 a new save makes a restore possible again.
    SAVED_AGAIN = "saved-state.saved-again",
    /// Single modes can be remembered in local parameters from predefined ones and set again before the
    /// return.
    SELECTIVE = "saved-state.selective",
    /// The value of S is part of the saved state.
    SPEED = "saved-state.speed",
    /// Whether the spindle speed override is enabled is part of the saved state.
    SPEED_OVERRIDE = "saved-state.speed-override",
    /// The limit of revolutions that came with constant surface speed comes back with that mode.
    SPINDLE_LIMIT = "saved-state.spindle-limit",
    /// The spindle mode, revolutions per minute or constant surface speed, is part of the saved state.
    SPINDLE_MODE = "saved-state.spindle-mode",
    /// Whether the spindle turns, and in which direction, is part of the saved state.
    SPINDLE_STATUS = "saved-state.spindle-status",
    /// State saved in a sub belongs to this invocation and is gone when the sub is left.
    SUB_LEVEL = "saved-state.sub-level",
    /// The status of tool length compensation, with the offset in force, is part of the saved state.
    TOOL_LENGTH = "saved-state.tool-length",
    /// The length unit, inch or millimetre, is part of the saved state.
    UNITS = "saved-state.units",
    /// When a restore changes the length unit, the unit comes back before the feed, so that the feed counts
    /// in the saved unit.
    UNITS_BEFORE_FEED = "saved-state.units-before-feed",
    /// Without a save and a restore, what a sub changes in the modal state stays changed for its caller.
    UNPROTECTED = "saved-state.unprotected",
    /// The selected coordinate system, one of nine, is part of the saved state.
    WORK_OFFSET = "saved-state.work-offset",
}
