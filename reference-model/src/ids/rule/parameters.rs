//! Each rule of `parameters`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::PARAMETERS;

    /// `_abs_x` to `_abs_c` are the position without offsets.
    ABSOLUTE_POSITION = "parameters.absolute-position",
    /// 5220 is the number of the active coordinate system, 1 to 9.
    ACTIVE_SYSTEM = "parameters.active-system",
    /// `_adaptive_feed` is 1 after M52 or M52 P1, else 0.
    ADAPTIVE_FEED = "parameters.adaptive-feed",
    /// `_ijk_absolute_mode` is 1 under G90.1, else 0.
    ARC_DISTANCE = "parameters.arc-distance",
    /// The equals sign stores the number on its right in the parameter on its left.
    ASSIGNMENT = "parameters.assignment",
    /// A parameter alone, or a setting without a value, is refused.
    ASSIGNMENT_FORM = "parameters.assignment-form",
    /// `_call_level` is the nesting level of o-word procedures.
    CALL_LEVEL = "parameters.call-level",
    /// `_ccomp` is ten times the number of the active compensation code.
    COMPENSATION = "parameters.compensation",
    /// `_mist` is 1 after M7, `_flood` is 1 after M8.
    COOLANT = "parameters.coolant",
    /// `_coord_system` is ten times the number of the active work offset code.
    COORDINATE_SYSTEM = "parameters.coordinate-system",
    /// While 5599 is 0 the DEBUG comments say nothing; at the start it is 1.
    DEBUG_SWITCH = "parameters.debug-switch",
    /// `_absolute` is 1 under G90 and `_incremental` under G91, else 0.
    DISTANCE = "parameters.distance",
    /// `_feed` is the value of F.
    FEED = "parameters.feed",
    /// `_feed_hold` is 1 while feed stop is enabled (M53 P1), else 0.
    FEED_HOLD = "parameters.feed-hold",
    /// `_inverse_time`, `_units_per_minute` and `_units_per_rev` are 1 under G93, G94 and G95, else 0.
    FEED_MODE = "parameters.feed-mode",
    /// Whether there are parameters above 5399 is a choice.
    GREATEST = "parameters.greatest",
    /// `#<_hal[item]>` is the value of that HAL item, such as a pin of the machine; the name counts in lower
    /// case, and as a whole.
    HAL = "parameters.hal",
    /// A HAL item has the value that it had when the program began, and after an M66 the one that it had
    /// then.
    HAL_TIME = "parameters.hal-time",
    /// The number of a parameter must be close to an integer.
    INDEX_INTEGER = "parameters.index-integer",
    /// The number sign may be repeated or come before an expression: the value within is the parameter's
    /// number.
    INDIRECT = "parameters.indirect",
    /// `#<_ini[section]name>` is the value of that entry of the INI file.
    INI = "parameters.ini",
    /// EXISTS is 1 if an INI entry or HAL item exists; reading an absent one is refused.
    INI_ABSENT = "parameters.ini-absent",
    /// Where the INI file disables them, no INI entry and no HAL item can be read.
    INI_DISABLED = "parameters.ini-disabled",
    /// Assigning to an INI or HAL parameter is refused.
    INI_READ_ONLY = "parameters.ini-read-only",
    /// `_lathe_diameter_mode` and `_lathe_radius_mode` are 1 under G7 and G8 of a lathe, else 0.
    LATHE_MODE = "parameters.lathe-mode",
    /// `_line` is the number of the current line.
    LINE = "parameters.line",
    /// When a subroutine returns its local named parameters are deleted.
    LOCAL_DELETED = "parameters.local-deleted",
    /// Parameters 1 to 30 are local to a subroutine; 31 and up are global.
    LOCAL_NUMBERS = "parameters.local-numbers",
    /// `_motion_mode` is ten times the number of the active motion code; 800 for G80.
    MOTION_MODE = "parameters.motion-mode",
    /// A name is written between `<` and `>`.
    NAME_MARKS = "parameters.name-marks",
    /// Case and blanks in a name do not count.
    NAME_SPELLING = "parameters.name-spelling",
    /// A named parameter comes into existence when it is assigned for the first time.
    NAMED = "parameters.named",
    /// A named parameter that does not exist is refused in an expression, as a word's value and on the right
    /// of a setting.
    NAMED_ABSENT = "parameters.named-absent",
    /// A name that begins with an underscore is global: subs see and set it.
    NAMED_GLOBAL = "parameters.named-global",
    /// A local named parameter belongs to the scope that assigned it: callers and callees do not see it.
    NAMED_LOCAL = "parameters.named-local",
    /// `_feed_override` and `_speed_override` are 1 while that override is enabled, else 0.
    OVERRIDE_FLAGS = "parameters.override-flags",
    /// `_plane` is ten times the number of the active plane code.
    PLANE = "parameters.plane",
    /// `_x` to `_w` and 5420 to 5428 are the position in the active coordinate system with all offsets.
    POSITION = "parameters.position",
    /// 5420 to 5428 are in the current program units.
    POSITION_UNITS = "parameters.position-units",
    /// The number of a parameter is an integer from 1 to 5602.
    RANGE = "parameters.range",
    /// Assigning to a predefined named parameter is refused.
    READ_ONLY = "parameters.read-only",
    /// `_remap_level` is the level of the remap stack.
    REMAP_LEVEL = "parameters.remap-level",
    /// When a line sets one parameter more than once, only the last setting takes effect.
    REPEATED_SETTING = "parameters.repeated-setting",
    /// `_retract_r_plane` and `_retract_old_z` report the canned cycle return mode; one of them is 1.
    RETRACT = "parameters.retract",
    /// `_value` and `_value_returned` report what the last return or endsub gave; `_value` is 0 again when a
    /// program starts.
    RETURNED_VALUE = "parameters.returned-value",
    /// A persistent parameter that a program has set is there to be stored when the run is over, and the next
    /// start begins with it.
    SAVED = "parameters.saved",
    /// A setting takes effect after all parameter values on its line have been found.
    SETTING_LAST = "parameters.setting-last",
    /// Where a block sets a parameter and moves, words anywhere in the same line see the old value.
    SETTING_ORDER = "parameters.setting-order",
    /// The number sign binds closer than any operator.
    SIGN_FIRST = "parameters.sign-first",
    /// `_rpm` is the value of S.
    SPEED = "parameters.speed",
    /// `_spindle_rpm_mode` is 1 under G97 and `_spindle_css_mode` under G96, else 0.
    SPINDLE_MODE = "parameters.spindle-mode",
    /// `_spindle_on` is 1 after M3 or M4, at a speed of zero as commanded or as it turns; `_spindle_cw` is 1
    /// after M3.
    SPINDLE_STATUS = "parameters.spindle-status",
    /// Stored parameters have their values when a program starts.
    STORED = "parameters.stored",
    /// Each coordinate system has ten parameters from 5221, 5241 … 5381 on: its nine axes and its rotation.
    SYSTEM_ORIGINS = "parameters.system-origins",
    /// `_task` is 1 within the task controller and 0 elsewhere.
    TASK = "parameters.task",
    /// `_current_tool` is the tool in the spindle, as 5400 is; `_selected_tool` is the tool of the last T; it
    /// and `_selected_pocket` are -1 before.
    TOOL = "parameters.tool",
    /// `_tool_offset` is 1 while a tool offset is on, else 0.
    TOOL_OFFSET = "parameters.tool-offset",
    /// `_metric` is 1 under G21 and `_imperial` under G20, else 0.
    UNITS = "parameters.units",
    /// A numbered parameter that was never set is zero.
    UNSET_NUMBERED = "parameters.unset-numbered",
    /// `_vmajor` is the first two numbers of the version, 2.5 of 2.5.2; `_vminor` the third in tenths, 0.2.
    /// Of a third number above 9 nothing is said.
    VERSION = "parameters.version",
}
