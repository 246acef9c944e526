//! Each rule of `cycles`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::CYCLES;

    /// In absolute distance mode X, Y, Z and R of a canned cycle are positions in the current coordinate
    /// system.
    ABSOLUTE = "cycles.absolute",
    /// A canned cycle without an axis word is refused.
    AXIS_WORDS_MISSING = "cycles.axis-words-missing",
    /// G85 feeds to the bottom, feeds out to R, and traverses on to the clear height.
    BORE = "cycles.bore",
    /// G89 feeds to the bottom, dwells P seconds, and feeds out to the clear height.
    BORE_DWELL = "cycles.bore-dwell",
    /// G86 is refused while the spindle does not turn.
    BORE_NEEDS_SPINDLE = "cycles.bore-needs-spindle",
    /// Whether G85 feeds out to R and traverses on to the clear height, or feeds all the way, is a choice.
    BORE_RETURN = "cycles.bore-return",
    /// G86 feeds to the bottom, dwells P seconds, stops the spindle, traverses to the clear height, and lets
    /// the spindle turn again as before.
    BORE_SPINDLE_STOP = "cycles.bore-spindle-stop",
    /// G80, or any other motion code, ends a canned cycle.
    CANCELLED_BY_MOTION = "cycles.cancelled-by-motion",
    /// G73 feeds deeper by Q again and again, and between two pecks traverses up by 0.254 mm or 0.01 inch.
    CHIP_BREAKING = "cycles.chip-breaking",
    /// G81 feeds along the normal axis to the bottom of the hole and traverses back to the clear height.
    DRILL = "cycles.drill",
    /// G82 dwells P seconds at the bottom of the hole and traverses back to the clear height.
    DRILL_DWELL = "cycles.drill-dwell",
    /// G82, G86 and G89 need P, the seconds of their dwell, in their first block.
    DWELL_NEEDED = "cycles.dwell-needed",
    /// Each repeat of a canned cycle begins with a traverse in the plane to the place of the hole, and then
    /// with one along the normal axis to R, unless it is there.
    IN_BETWEEN_MOTION = "cycles.in-between-motion",
    /// In incremental distance mode X, Y and R of a canned cycle are increments from the current position,
    /// and Z is one from R.
    INCREMENTAL = "cycles.incremental",
    /// The level to which G98 returns is where the normal axis was before the first of a row of canned
    /// cycles, be they the same or not; any other motion ends the row.
    INITIAL_LEVEL = "cycles.initial-level",
    /// A canned cycle under inverse time is refused.
    INVERSE_TIME = "cycles.inverse-time",
    /// A negative P of a canned cycle that dwells is refused.
    NEGATIVE_DWELL = "cycles.negative-dwell",
    /// G83 feeds deeper by Q again and again; between two pecks it traverses to R, under G98 too, and back to
    /// 0.254 mm or 0.01 inch above what it has drilled; at the bottom it traverses to the clear height.
    PECK = "cycles.peck",
    /// Q of G73 and G83 is positive.
    PECK_INCREMENT = "cycles.peck-increment",
    /// G73 and G83 need Q, the increment of their pecks, in their first block.
    PECK_NEEDED = "cycles.peck-needed",
    /// Whether G83 traverses between two pecks to R, or to the clear height, is a choice.
    PECK_RETURN = "cycles.peck-return",
    /// A canned cycle works in the selected plane, whichever it is: it drills along its normal axis, R is a
    /// position along that axis, and the hole is in the plane.
    PLANE = "cycles.plane",
    /// When the controlled point is below R, a canned cycle first traverses along the normal axis to R: once,
    /// however often it is repeated.
    PRELIMINARY_MOTION = "cycles.preliminary-motion",
    /// A canned cycle is executed as often as L says: in incremental distance mode each time further on by
    /// the same increments in the plane, with the same R and depth; in absolute distance mode each time in
    /// the same place.
    REPEAT = "cycles.repeat",
    /// L of a canned cycle is a positive integer.
    REPEAT_COUNT = "cycles.repeat-count",
    /// L counts for its own block; without it a canned cycle is executed once.
    REPEAT_NOT_STICKY = "cycles.repeat-not-sticky",
    /// As long as a canned cycle is the motion mode, a block with axis words executes it again.
    REPEATS_ITSELF = "cycles.repeats-itself",
    /// A canned cycle whose R is below the bottom of its hole is refused.
    RETRACT_BELOW_BOTTOM = "cycles.retract-below-bottom",
    /// Each repeat of a canned cycle ends at R under G99. Under G98 it ends at the level before the cycles if
    /// that is above R, and at R if not. Whether that is the level before a row of them or before each is a
    /// choice.
    RETURN_LEVEL = "cycles.return-level",
    /// A canned cycle takes no word of a rotary axis, not even where it would not move.
    ROTARY_WORDS = "cycles.rotary-words",
    /// $ names the spindle of G74, G84 and G86, one that the machine has; without it that is spindle 0.
    SPINDLE = "cycles.spindle",
    /// The word of the normal axis must be programmed in the first block of a canned cycle, and keeps its
    /// value in the blocks of the same cycle that follow.
    STICKY_DEPTH = "cycles.sticky-depth",
    /// R must be programmed in the first block of a canned cycle, and keeps its value in the blocks of the
    /// same cycle that follow.
    STICKY_RETRACT = "cycles.sticky-retract",
    /// G74 feeds to the bottom, stops the spindle and starts it clockwise, dwells P seconds, and feeds out to
    /// the clear height.
    TAP_LEFT = "cycles.tap-left",
    /// While G84 and G74 cut and feed out, the feed override and the speed override are disabled; then they
    /// are as before.
    TAP_OVERRIDES = "cycles.tap-overrides",
    /// G84 feeds to the bottom, stops the spindle and starts it counterclockwise, dwells P seconds, and feeds
    /// out to the clear height.
    TAP_RIGHT = "cycles.tap-right",
    /// A canned cycle while cutter compensation is on is refused.
    UNDER_COMPENSATION = "cycles.under-compensation",
    /// A canned cycle in a plane of X, Y and Z takes no U, V or W, and the other way round.
    WORDS_OF_PLANE = "cycles.words-of-plane",
}
