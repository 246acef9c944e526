//! Each rule of `spindle`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::SPINDLE;

    /// Several spindles turn each at its own speed and in its own direction.
    EACH_TURNS = "spindle.each-turns",
    /// $-1 means all spindles to M3, M4 and M5; the 2.8 text does not know it.
    MINUS_ONE = "spindle.minus-one",
    /// A $ word that names no spindle of the machine is refused.
    OUT_OF_RANGE = "spindle.out-of-range",
    /// While the speed override is enabled and not at 100 % the speed is another one than S.
    OVERRIDE_COUNTS = "spindle.override-counts",
    /// A spindle that is stopped by its override starts turning once that is turned up.
    OVERRIDE_TURNED_UP = "spindle.override-turned-up",
    /// A spindle does not turn while its speed override is enabled and zero.
    OVERRIDE_ZERO_STANDS = "spindle.override-zero-stands",
    /// M3 and M4 are allowed while the spindle turns, M5 while it is stopped.
    REPEATED = "spindle.repeated",
    /// G97 selects revolutions per minute.
    RPM_MODE = "spindle.rpm-mode",
    /// G97 without S keeps the speed, unless its S word is taken as required.
    RPM_MODE_SPEED = "spindle.rpm-mode-speed",
    /// M3, M4 and M5 with $ act on that spindle only.
    SELECTED = "spindle.selected",
    /// S sets the spindle speed, which holds until another S.
    SPEED = "spindle.speed",
    /// A negative S is refused.
    SPEED_NEGATIVE = "spindle.speed-negative",
    /// S with $ sets the speed of that spindle, without $ that of spindle 0.
    SPEED_SELECTED = "spindle.speed-selected",
    /// S may be programmed whether the spindle turns or not, and neither starts nor stops it.
    SPEED_STARTS_NOTHING = "spindle.speed-starts-nothing",
    /// S0 is allowed.
    SPEED_ZERO = "spindle.speed-zero",
    /// M3 starts the spindle clockwise, M4 counterclockwise, at the S speed.
    START = "spindle.start",
    /// M3 and M4 are allowed with a speed of zero.
    START_AT_ZERO = "spindle.start-at-zero",
    /// M5 stops the spindle.
    STOP = "spindle.stop",
    /// G96 with S selects constant surface speed.
    SURFACE_SPEED = "spindle.surface-speed",
    /// The surface speed of G96 is the same in diameter mode and in radius mode.
    SURFACE_SPEED_LATHE = "spindle.surface-speed-lathe",
    /// D with G96 limits the spindle speed; it is optional.
    SURFACE_SPEED_LIMIT = "spindle.surface-speed-limit",
    /// G96 without S is refused.
    SURFACE_SPEED_NEEDS_SPEED = "spindle.surface-speed-needs-speed",
    /// G96 with $ concerns that spindle only.
    SURFACE_SPEED_SELECTED = "spindle.surface-speed-selected",
    /// A feed move under G96 while the spindle is not turning is refused.
    SURFACE_SPEED_WHILE_STOPPED = "spindle.surface-speed-while-stopped",
    /// While M3 or M4 is in effect the spindle turns at the S speed.
    TURNS_AT_SPEED = "spindle.turns-at-speed",
    /// A spindle that was started at a speed of zero starts turning once the speed is above zero.
    TURNS_LATER = "spindle.turns-later",
    /// A $ word that no code of its block uses is refused.
    UNUSED_DOLLAR = "spindle.unused-dollar",
    /// D without a code that uses it is refused.
    UNUSED_LIMIT = "spindle.unused-limit",
    /// M3, M4 and M5 without $ act on all spindles or on spindle 0: the documents differ.
    WITHOUT_DOLLAR = "spindle.without-dollar",
    /// A spindle that is started at a speed of zero does not turn.
    ZERO_SPEED_STANDS = "spindle.zero-speed-stands",
}
