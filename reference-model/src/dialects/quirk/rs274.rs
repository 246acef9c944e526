//! Each quirk of `rs274`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

quirks! {
    super::first::RS274;

    /// ABS leaves the sign of a zero.
    ABSOLUTE_NEGATIVE_ZERO = "rs274.absolute-negative-zero",
    /// G43.2 does not know axis words without H.
    ADDITIONAL_LENGTH_AXES = "rs274.additional-length-axes",
    /// An endsub that is executed ends the sub that is being executed, whatever its number or name.
    ANY_ENDSUB = "rs274.any-endsub",
    /// An arc whose centre is nearer than 0.00127 mm or 0.00005 inch to its start or to its end is refused;
    /// one with R may be smaller.
    ARC_LEAST_RADIUS = "rs274.arc-least-radius",
    /// R0 makes an arc whose centre is not a number, where half the distance to its end is no more than R may
    /// be too small by.
    ARC_NO_RADIUS = "rs274.arc-no-radius",
    /// The radii at the start and at the end of an arc may differ by more than five times of what is
    /// documented.
    ARC_RADIUS_TOLERANCE = "rs274.arc-radius-tolerance",
    /// G64 takes Q without P.
    BLEND_Q_WITHOUT_P = "rs274.blend-q-without-p",
    /// A break of a while, and one that is skipped on the way to the end of its loop, is remembered until a
    /// do loop tests its condition, and ends that.
    BREAK_REMEMBERED = "rs274.break-remembered",
    /// G10 L20 needs no axis word.
    CALCULATE_WITHOUT_AXES = "rs274.calculate-without-axes",
    /// G80 is refused in a block with the axis words of G43.1 or G43.2.
    CANCEL_BESIDE_OFFSET = "rs274.cancel-beside-offset",
    /// G80 is allowed in a block with another motion code, which wins, or with itself.
    CANCEL_WITH_MOTION = "rs274.cancel-with-motion",
    /// Where G33, G33.1, G76 and the cycles have no $, and under feed per revolution, the spindle is the one
    /// that was chosen last: by the $ of G33, G33.1 or G76, or by a block with G93 to G97, which without $
    /// chooses spindle 0.
    CHOSEN_SPINDLE = "rs274.chosen-spindle",
    /// After a comment at the beginning of a block neither an O-word nor M98 is allowed: no end is found
    /// there, and a block that is reached is refused.
    COMMENT_BEFORE_O_WORD = "rs274.comment-before-o-word",
    /// An entry, or the chord of an arc as entry, that is exactly as long as the tool's radius is refused.
    COMPENSATION_ENTRY_EQUAL = "rs274.compensation-entry-equal",
    /// After compensated moves and G40, an arc is refused until G0, G1, G33 or G33.1.
    COMPENSATION_EXIT_ARC = "rs274.compensation-exit-arc",
    /// The line after G40 may have any length.
    COMPENSATION_EXIT_LENGTH = "rs274.compensation-exit-length",
    /// L, an integer of zero or more, is allowed with G41 and G42. It does nothing.
    COMPENSATION_L_WORD = "rs274.compensation-l-word",
    /// With a negative diameter G41 and G42 select the other side, and the code of that side is active.
    COMPENSATION_SIDE = "rs274.compensation-side",
    /// A continue in a do loop is remembered until a loop ends that tests first or counts: a repeat that ends
    /// next begins again, and a while that is broken next tests its condition once more.
    CONTINUE_REMEMBERED = "rs274.continue-remembered",
    /// A continue in a while loop looks for the end of the loop before the condition is tested: it is refused
    /// where there is none.
    CONTINUE_SEEKS_END = "rs274.continue-seeks-end",
    /// The first G5 of a row needs no I and J.
    CUBIC_WITHOUT_DIRECTION = "rs274.cubic-without-direction",
    /// No canned cycle takes $.
    CYCLE_DOLLAR = "rs274.cycle-dollar",
    /// A canned cycle is executed in exact path mode.
    CYCLE_EXACT_PATH = "rs274.cycle-exact-path",
    /// A canned cycle accepts any negative P but -1.
    CYCLE_NEGATIVE_DWELL = "rs274.cycle-negative-dwell",
    /// In incremental distance mode R counts from the level at which the row of canned cycles began.
    CYCLE_RETRACT_FROM_INITIAL = "rs274.cycle-retract-from-initial",
    /// Whether a canned cycle rises to R goes by the level at which the row of cycles began: a row that began
    /// below R rises in each block, be it by nothing; in one that began above R the first move in the plane
    /// rises to the clear height on its way, when it begins at R or below.
    CYCLE_RISE = "rs274.cycle-rise",
    /// `_ccomp` does not distinguish G41.1 and G42.1 from G41 and G42.
    DYNAMIC_COMPENSATION_CODE = "rs274.dynamic-compensation-code",
    /// R, any number, is allowed with G41.1 and G42.1. It does nothing.
    DYNAMIC_COMPENSATION_R_WORD = "rs274.dynamic-compensation-r-word",
    /// A restore brings back dynamic cutter compensation without its diameter, as compensation by a tool of
    /// the table.
    DYNAMIC_COMPENSATION_RESTORE = "rs274.dynamic-compensation-restore",
    /// A motion code together with G43.1 uses the axis words as well.
    DYNAMIC_LENGTH_WITH_MOTION = "rs274.dynamic-length-with-motion",
    /// G43.1 without axis words is accepted.
    DYNAMIC_LENGTH_WITHOUT_AXES = "rs274.dynamic-length-without-axes",
    /// A name between `<` and `>` may be empty.
    EMPTY_NAME = "rs274.empty-name",
    /// The end of a condition or loop that is passed over, and its next branch, may be in a sub that follows.
    ENDS_IN_OTHER_SUBS = "rs274.ends-in-other-subs",
    /// EXISTS of a numbered parameter is accepted.
    EXISTS_NUMBERED = "rs274.exists-numbered",
    /// When the program ends inside a subprogram, `#1` to `#30` are what they were at the main program's last
    /// o-word call, or zero.
    FANUC_CHANGES_AT_END = "rs274.fanuc-changes-at-end",
    /// L of M98 is refused as negative from 2147483648 on.
    FANUC_COUNT_TOO_LARGE = "rs274.fanuc-count-too-large",
    /// A call with L0 leaves a call level: the tenth is refused, and inside a sub it spoils the sub's end.
    FANUC_ZERO_LOOPS = "rs274.fanuc-zero-loops",
    /// G94 and G95 lose the feed rate even when they are active already.
    FEED_LOST_AT_SAME_MODE = "rs274.feed-lost-at-same-mode",
    /// A restore that changes the feed mode loses the saved feed: into inverse time the later feed stays, out
    /// of it the feed becomes zero.
    FEED_MODE_FEED = "rs274.feed-mode-feed",
    /// Under inverse time `_feed` is the feed rate of the last straight feed: its way times F, or a tenth
    /// where that is more.
    FEED_NAME_INVERSE_TIME = "rs274.feed-name-inverse-time",
    /// `_feed` keeps the number of F when the length unit changes.
    FEED_NAME_NUMBER = "rs274.feed-name-number",
    /// A restore rounds the feed to one decimal and the speed to an integer.
    FEED_SPEED_ROUNDED = "rs274.feed-speed-rounded",
    /// A restore programs F again as a number, whatever the length unit was in which it was given.
    FEED_UNIT = "rs274.feed-unit",
    /// The program end sets the feed to zero.
    FEED_ZERO_AT_END = "rs274.feed-zero-at-end",
    /// A file that is called may define further subs in addition to its own; the head of one within its own
    /// does nothing.
    FILE_WITH_TWO_SUBS = "rs274.file-with-two-subs",
    /// Where the first piece of a profile ends at its greatest Z, be it the only one, X is the axis of travel
    /// of G70: an arc or a line that goes back along X is refused, and a positive distance can be on the side
    /// without the tool.
    FINISHING_ONE_ARC = "rs274.finishing-one-arc",
    /// Only the first spindle's state is saved and restored.
    FIRST_SPINDLE_SAVED = "rs274.first-spindle-saved",
    /// A G code may be off by a ten-thousandth itself, not only ten times it.
    G_CODE_TOLERANCE = "rs274.g-code-tolerance",
    /// G92.1, G92.2 and G92.3 exclude each other and no other code of group 0, after which they act.
    G92_CODES_APART = "rs274.g92-codes-apart",
    /// A name of the form of a HAL item or of an INI entry can be assigned if there is no such item or entry.
    HAL_ASSIGNMENT = "rs274.hal-assignment",
    /// Under inverse time F may be zero.
    INVERSE_TIME_ZERO_RATE = "rs274.inverse-time-zero-rate",
    /// M62 to M68 round the number of an input or output, halves to the even number.
    IO_NUMBER_ROUNDED = "rs274.io-number-rounded",
    /// The last parameter is 5601, not 5602.
    LAST_PARAMETER = "rs274.last-parameter",
    /// The condition of an elseif is evaluated even after a true one.
    LATER_CONDITIONS_EVALUATED = "rs274.later-conditions-evaluated",
    /// G74 takes no L.
    LEFT_TAP_REPEAT = "rs274.left-tap-repeat",
    /// A restore suspends a local offset that has come since the save, and resumes one that has been
    /// suspended since.
    LOCAL_OFFSET_RESTORE = "rs274.local-offset-restore",
    /// LOG speaks while no log file is open.
    LOG_CLOSED = "rs274.log-closed",
    /// A carriage return without a line feed does not end a line but counts as a blank.
    LONE_RETURN = "rs274.lone-return",
    /// %lf is printed unchanged.
    LONG_FORMAT = "rs274.long-format",
    /// G53 is refused in incremental distance mode.
    MACHINE_INCREMENTAL = "rs274.machine-incremental",
    /// G53, G28, G30 and an M6 at the position of G30 do not take the tool offset of a rotary axis into
    /// account.
    MACHINE_ROTARY_OFFSET = "rs274.machine-rotary-offset",
    /// G53 is accepted under cutter compensation with a radius of zero.
    MACHINE_UNDER_ZERO_RADIUS = "rs274.machine-under-zero-radius",
    /// G53 with G0 or G1 in its block needs no axis word.
    MACHINE_WITHOUT_AXES = "rs274.machine-without-axes",
    /// A move in machine coordinates computes the axes anew that it does not move, so that a zero loses its
    /// sign.
    MACHINE_ZERO_SIGN = "rs274.machine-zero-sign",
    /// MSG with blanks between its letters or after it is a plain comment.
    MESSAGE_BLANKS = "rs274.message-blanks",
    /// `#0` in a message is printed as zero.
    MESSAGE_PARAMETER_ZERO = "rs274.message-parameter-zero",
    /// A message prints a value that is nearer to zero than a ten-thousandth as zero.
    MESSAGE_SMALL_VALUE = "rs274.message-small-value",
    /// A named parameter that a line creates exists already, as zero, for later values on that line.
    NAMED_EXISTS_EARLY = "rs274.named-exists-early",
    /// A dwell of any negative time but -1 is accepted.
    NEGATIVE_DWELL = "rs274.negative-dwell",
    /// Nine nested calls are accepted and the tenth is refused: the main program counts as a level.
    NINE_LEVELS = "rs274.nine-levels",
    /// A number alone within a sub that is defined counts as the beginning of another one.
    NUMBER_IN_SUB = "rs274.number-in-sub",
    /// Once it was called, a numbered program is known by its number in every file, before those of the file
    /// itself.
    NUMBERS_OF_ALL_FILES = "rs274.numbers-of-all-files",
    /// G53 is allowed with G5.2, and not with the points that follow.
    NURBS_MACHINE_COORDINATES = "rs274.nurbs-machine-coordinates",
    /// A NURBS of order two needs three control points, as one of order three does.
    NURBS_ORDER_TWO = "rs274.nurbs-order-two",
    /// Each control point of a NURBS needs P, except one in the block of the first G5.2.
    NURBS_WEIGHT = "rs274.nurbs-weight",
    /// A restore does not switch off again what was saved as off: feed stop, adaptive feed, and flood while
    /// mist was on.
    OFF_NOT_RESTORED = "rs274.off-not-restored",
    /// With G10 a word is allowed that another L of it uses: P, Q, R, I, J and axis words with L0, and Q with
    /// L2 and L20. It does nothing.
    OFFSET_DATA_WORDS = "rs274.offset-data-words",
    /// After M19 every spindle is taken for stopped, oriented or not, though it turns on.
    ORIENT_FORGETS_TURNING = "rs274.orient-forgets-turning",
    /// M19 without R is accepted: with P the angle is zero, without P the spindle is not oriented.
    ORIENT_WITHOUT_ANGLE = "rs274.orient-without-angle",
    /// M19 without Q is accepted: the run does not wait for the spindle.
    ORIENT_WITHOUT_TIMEOUT = "rs274.orient-without-timeout",
    /// L of G41.1 and G42.1 above 9 is accepted.
    ORIENTATION_TOO_LARGE = "rs274.orientation-too-large",
    /// A restore takes a spindle that has been oriented for one that is stopped, and leaves it oriented.
    ORIENTED_AS_STOPPED = "rs274.oriented-as-stopped",
    /// A P of G10 L2 with a fraction of a half or more is cut down.
    ORIGIN_NUMBER_CUT = "rs274.origin-number-cut",
    /// M67 and M68 without Q set the value -1.
    OUTPUT_VALUE_OPTIONAL = "rs274.output-value-optional",
    /// M50 to M53 take any P but zero as one.
    OVERRIDE_ANY_P = "rs274.override-any-p",
    /// M48 and M49 take no $: where no other code or S uses it the block is refused, and where one does they
    /// act on all spindles.
    OVERRIDE_DOLLAR = "rs274.override-dollar",
    /// A restore leaves both overrides enabled when one or both of them were saved as disabled.
    OVERRIDE_RESTORE = "rs274.override-restore",
    /// G61, G61.1 and G64 are refused while cutter compensation is on, and so is a restore of another path
    /// control mode or tolerance with a compensation that was on at the save.
    PATH_UNDER_COMPENSATION = "rs274.path-under-compensation",
    /// A stroke of G73 or G83 that ends above the bottom by no more than a rounding error is followed by
    /// another.
    PECK_ROUNDING = "rs274.peck-rounding",
    /// G95 takes no $ unless something else in its block does.
    PER_REVOLUTION_DOLLAR = "rs274.per-revolution-dollar",
    /// Under feed per revolution G1, G2 and G3 are refused while the speed of the spindle is zero, whether it
    /// turns or not.
    PER_REVOLUTION_STANDING = "rs274.per-revolution-standing",
    /// Percent lines of a called file depend on how the main program begins. If it begins with one, the first
    /// one ends the called file; if not, they mean nothing, and are not blocks.
    PERCENT_IN_FILE = "rs274.percent-in-file",
    /// A restore selects the plane before it turns cutter compensation off, and is refused there.
    PLANE_RESTORE = "rs274.plane-restore",
    /// For an arc with a radius outside of the XY plane polar words name no axis of the plane.
    POLAR_ARC_PLANE = "rs274.polar-arc-plane",
    /// At the origin a polar word for the distance needs one for the angle, in absolute distance mode too.
    POLAR_NEEDS_ANGLE = "rs274.polar-needs-angle",
    /// Polar words are refused where another plane than XY was selected before their block.
    POLAR_PLANE = "rs274.polar-plane",
    /// @ and ^ are allowed more than once in a block. The last one counts.
    POLAR_REPEATED = "rs274.polar-repeated",
    /// An incremental polar move with an angle that ends at the origin is refused.
    POLAR_TO_ORIGIN = "rs274.polar-to-origin",
    /// G28 and G30 without axis words make a move of no length first.
    POSITION_MOVE_IN_PLACE = "rs274.position-move-in-place",
    /// G92 leaves the local offset of axes alone for which it has no word.
    POSITION_OMITTED_AXES = "rs274.position-omitted-axes",
    /// An expression that reads 5420 to 5428 is refused while cutter compensation is on; a message prints
    /// them, and `_x` to `_w` are read.
    POSITION_UNDER_COMPENSATION = "rs274.position-under-compensation",
    /// Under inverse time probing ignores F in its block, and goes at the rate that was set before.
    PROBE_INVERSE_TIME = "rs274.probe-inverse-time",
    /// Under feed per revolution probing is refused.
    PROBE_PER_REVOLUTION = "rs274.probe-per-revolution",
    /// G38.3 and G38.5 may lead to where the controlled point is.
    PROBE_SAME_POINT = "rs274.probe-same-point",
    /// G5.1 needs both I and J.
    QUADRATIC_NEEDS_BOTH = "rs274.quadratic-needs-both",
    /// Both I and J of G5.1 may be zero.
    QUADRATIC_OF_ZERO = "rs274.quadratic-of-zero",
    /// All invocations of a sub share the counter of a repeat: recursion inside it goes on without end, and
    /// turns left over by a return count in the next call.
    REPEAT_COUNTER_SHARED = "rs274.repeat-counter-shared",
    /// A P or a Q of -1 or less counts as none where another one follows it in its block.
    REPEATED_NEGATIVE_WORD = "rs274.repeated-negative-word",
    /// Signs may be repeated before a number; each minus negates.
    REPEATED_SIGNS = "rs274.repeated-signs",
    /// When a restore changes something, or programs something again that then is as it was, what the order
    /// of execution puts after it in its block is not executed.
    REST_OF_RESTORE_BLOCK = "rs274.rest-of-restore-block",
    /// G98 and G99 are refused while cutter compensation is on, and so is a restore of another return mode
    /// under a compensation that was on at the save too.
    RETRACT_UNDER_COMPENSATION = "rs274.retract-under-compensation",
    /// Once a sub or a numbered program was called, and until a sub is defined, a return in the main program
    /// is not an error: it sets the value parameters, and the next block follows.
    RETURN_AFTER_CALL = "rs274.return-after-call",
    /// When G10 L2 turns the coordinate system in force, or the program end that of G54, the point is turned
    /// without its local offset, and the program position is another one than where the machine is.
    ROTATION_UNDER_LOCAL_OFFSET = "rs274.rotation-under-local-offset",
    /// ROUND of a number that 32 bits do not hold is -2147483648.
    ROUND_32_BITS = "rs274.round-32-bits",
    /// What ROUND makes zero has no sign: ATAN takes it for a zero above zero.
    ROUNDED_ZERO_SIGN = "rs274.rounded-zero-sign",
    /// G97 takes no $ unless something else in its block does.
    RPM_MODE_DOLLAR = "rs274.rpm-mode-dollar",
    /// Selecting the coordinate system that is in force does not read its parameters again.
    SAME_SYSTEM_KEPT = "rs274.same-system-kept",
    /// M70 to M73 belong to the modal group of M3, M4 and M5.
    SAVE_IN_SPINDLE_GROUP = "rs274.save-in-spindle-group",
    /// `_selected_tool` is 0 before the first T.
    SELECTED_TOOL_ZERO = "rs274.selected-tool-zero",
    /// A semicolon comment is never active, nor does it silence an active comment before it.
    SEMICOLON_PLAIN = "rs274.semicolon-plain",
    /// When a restore programs G64 without tolerance again, an M51, M52 or M53 in the same block takes its P0
    /// and disables what it should enable.
    SHARED_P = "rs274.shared-p",
    /// A line has at most 252 bytes without its line end, not 255 characters.
    SHORTER_LINES = "rs274.shorter-lines",
    /// What is passed over on the way to an end, a sub or a number is read: a comment that is not closed, a
    /// line that is too long, a label or keyword that is none, an M98 with a P or L that is none, and where
    /// numbered programs are disabled an M98 and a number alone, are refused there.
    SKIPPED_IS_READ = "rs274.skipped-is-read",
    /// On the way to the end of a condition or loop its label is refused in every block that could not be its
    /// next one.
    SKIPPED_LABELS = "rs274.skipped-labels",
    /// S with $-1 sets the speed of all spindles.
    SPEED_OF_ALL_SPINDLES = "rs274.speed-of-all-spindles",
    /// The program end enables the speed override for the interpreter only and does not command the spindle.
    SPEED_OVERRIDE_AT_END = "rs274.speed-override-at-end",
    /// M51 with $0 is refused.
    SPEED_OVERRIDE_DOLLAR = "rs274.speed-override-dollar",
    /// The program end sets every spindle to revolutions per minute.
    SPINDLE_MODE_AT_END = "rs274.spindle-mode-at-end",
    /// The fraction of a $ word is cut off.
    SPINDLE_NUMBER_CUT = "rs274.spindle-number-cut",
    /// G5 and G5.1 leave the motion mode as it was.
    SPLINE_NOT_MODAL = "rs274.spline-not-modal",
    /// Under G95 splines need no feed rate.
    SPLINE_PER_REVOLUTION = "rs274.spline-per-revolution",
    /// The machine's position at the start is reported without the rotation that is stored for the coordinate
    /// system in force; all that follows has it.
    STORED_ROTATION = "rs274.stored-rotation",
    /// A sub that is defined later in the file than its call is found; its definition is refused when it is
    /// reached, and the head of another sub within it does nothing.
    SUB_FOUND_LATER = "rs274.sub-found-later",
    /// A definition that is reached once more, as in a loop, is refused.
    SUB_REACHED_AGAIN = "rs274.sub-reached-again",
    /// G96 with D0 commands the spindle in revolutions per minute, while programs read constant surface
    /// speed.
    SURFACE_LIMIT_ZERO = "rs274.surface-limit-zero",
    /// A restore into constant surface speed fails when the speed has not changed; if it has, it loses the
    /// limit D.
    SURFACE_SPEED_RESTORE = "rs274.surface-speed-restore",
    /// A feed move under G96 is made while the spindle is stopped.
    SURFACE_SPEED_WHILE_STOPPED = "rs274.surface-speed-while-stopped",
    /// E, any number, is allowed with G33 and G33.1. It does nothing.
    SYNCHRONISED_E_WORD = "rs274.synchronised-e-word",
    /// G33 and G33.1 are not allowed in a block with F.
    SYNCHRONISED_FEED_WORD = "rs274.synchronised-feed-word",
    /// A restore programs the coordinate system together with G41 or G42: where the cutter was compensated at
    /// the save and another system is selected now, it is refused.
    SYSTEM_RESTORE = "rs274.system-restore",
    /// Outside of the XY plane the feeds of G74 and G84 lead to a point with the axes in another order,
    /// though the controlled point is then where it should be.
    TAP_AXES = "rs274.tap-axes",
    /// A tap without P dwells as long as the last canned cycle that had P, whichever it was.
    TAP_DWELL_KEPT = "rs274.tap-dwell-kept",
    /// G76 is accepted in every plane.
    THREAD_ANY_PLANE = "rs274.thread-any-plane",
    /// Each pass of G76 begins and ends as much further out than the drive line as it is less deep than the
    /// last one, and a last traverse leads to the end of the drive line, even from there.
    THREAD_CLEARANCE = "rs274.thread-clearance",
    /// The feed override is disabled while a pass of G76 cuts, and enabled after it; what the interpreter
    /// saves and reports of it stays.
    THREAD_FEED_OVERRIDE = "rs274.thread-feed-override",
    /// E of G76 may be more than half the length of the thread. Where the thread leads nowhere, the tapers
    /// and the slide lead down.
    THREAD_LONG_TAPER = "rs274.thread-long-taper",
    /// A degression R of G76 below 1 is taken as 1.
    THREAD_LOW_DEGRESSION = "rs274.thread-low-degression",
    /// A negative H of G76 leaves out passes at the end.
    THREAD_NEGATIVE_SPRINGS = "rs274.thread-negative-springs",
    /// G76 takes X and Y, or polar words in their place, and its last traverse leads there.
    THREAD_OTHER_AXES = "rs274.thread-other-axes",
    /// A restore programs the tolerances of G64 again as numbers, whatever the length unit was in which they
    /// were given.
    TOLERANCE_UNIT = "rs274.tolerance-unit",
    /// G10 L1, L10 and L11 change the tool table while cutter compensation is on.
    TOOL_ENTRY_UNDER_COMPENSATION = "rs274.tool-entry-under-compensation",
    /// M61 rounds Q, halves to the even number.
    TOOL_NUMBER_ROUNDED = "rs274.tool-number-rounded",
    /// A restore programs G43 again instead of bringing back the saved offset: one from G43.1 or from another
    /// tool than that in the spindle is lost.
    TOOL_OFFSET_RESTORE = "rs274.tool-offset-restore",
    /// A tool offset keeps its number when the length unit changes. A later change of the offset therefore
    /// shifts the position, and G53, G28, G30, what G28.1 and G30.1 store, where M6 moves to and what G10 L10
    /// and L11 measure are off the point.
    TOOL_OFFSET_UNIT = "rs274.tool-offset-unit",
    /// After the profile G71 and G72 go on along their depth axis as far as the position before the cycle.
    TURNING_END = "rs274.turning-end",
    /// A profile with two lines in a row in the direction of travel is refused at a distance: their parallels
    /// do not intersect.
    TURNING_PARALLEL_PIECES = "rs274.turning-parallel-pieces",
    /// Blocks of a profile are checked as blocks are, and the axes of G92 and G10 count as a move.
    TURNING_PROFILE_CODES = "rs274.turning-profile-codes",
    /// While a profile is read, the position that parameters report is the end of its last move.
    TURNING_PROFILE_POSITION = "rs274.turning-profile-position",
    /// Under G91 the first traverse of a lathe cycle takes X and Z for a position, and the second one adds
    /// them to the position before.
    TURNING_START_INCREMENTAL = "rs274.turning-start-incremental",
    /// The position before the profile becomes that of its start along the axis of travel where it lies
    /// beyond the start in the direction of travel.
    TURNING_START_TOO_FAR = "rs274.turning-start-too-far",
    /// A lathe cycle without X and Z begins with a traverse in place, and a second traverse to the position
    /// before the profile follows.
    TURNING_TRAVERSE_IN_PLACE = "rs274.turning-traverse-in-place",
    /// Parameters that a call does not pass are zero in the sub.
    UNPASSED_ARGUMENTS_ZERO = "rs274.unpassed-arguments-zero",
    /// Q-1 is allowed in a block of which no code uses Q, and in a later block of a row of G73 or G83, where
    /// the Q before holds. It does nothing.
    UNUSED_Q_MINUS_ONE = "rs274.unused-q-minus-one",
    /// Where a sub is defined, its body is skipped but the values of its returns and of its endsub are
    /// evaluated, as if the sub had returned them; and so, with the arguments of the call, are those of an
    /// endsub or return of its label that is passed over where a call seeks it.
    VALUE_AT_DEFINITION = "rs274.value-at-definition",
    /// The value parameters are written when a sub returns, not cleared before a call; M99 clears them too.
    VALUE_CLEARED_AT_RETURN = "rs274.value-cleared-at-return",
    /// M66 with L above 4 is accepted.
    WAIT_MODE_ANY = "rs274.wait-mode-any",
    /// A format with more than one digit after its period loses its percent sign.
    WRONG_FORMAT_SIGN = "rs274.wrong-format-sign",
    /// `_tool_offset` reports whether an offset is not zero, not whether G43 is on.
    ZERO_TOOL_OFFSET_OFF = "rs274.zero-tool-offset-off",
}
