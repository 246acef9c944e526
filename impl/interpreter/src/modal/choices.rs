//! The points at which documents differ, as far as they concern modes: read once from the options.

use gaugeblock_vocabulary::Options;

use crate::error::Error;

macro_rules! choices {
    ($($(#[$about:meta])* $name:ident: $id:literal, $first:literal, $second:literal;)*) => {
        /// A field for each choice of two options: whether the second one applies. A choice that is not listed has
        /// its first.
        #[derive(Clone, Debug)]
        pub(crate) struct Choices {
            $($(#[$about])* pub(crate) $name: bool,)*
            /// `arcs.small-tolerance`.
            pub(crate) arc_tolerance: ArcTolerance,
            /// `modal-groups.initial-motion`.
            pub(crate) initial_motion: InitialMotion,
            /// `motion.without-axis-words`.
            pub(crate) without_axis_words: WithoutAxisWords,
            /// `cycles.tap-without-dwell`.
            pub(crate) tap_without_dwell: TapWithoutDwell,
            /// `program-end.feed-after-mode-change`.
            pub(crate) feed_at_end: FeedAtEnd,
        }

        impl Choices {
            /// Reads the options that concern modes; others are not looked at.
            pub(crate) fn read(options: &Options) -> Result<Self, Error> {
                let mut choices = Self {
                    $($name: false,)*
                    arc_tolerance: ArcTolerance::Coarse,
                    initial_motion: InitialMotion::None,
                    without_axis_words: WithoutAxisWords::Nothing,
                    tap_without_dwell: TapWithoutDwell::Refused,
                    feed_at_end: FeedAtEnd::Zero,
                };
                for (id, option) in &options.0 {
                    match id.as_str() {
                        $($id => choices.$name = match option.as_str() {
                            $first => false,
                            $second => true,
                            _ => return Err(Error::Configuration(concat!("no such option of ", $id))),
                        },)*
                        "arcs.small-tolerance" => {
                            choices.arc_tolerance = ArcTolerance::of(option)?;
                        }
                        "modal-groups.initial-motion" => {
                            choices.initial_motion = InitialMotion::of(option)?;
                        }
                        "motion.without-axis-words" => {
                            choices.without_axis_words = WithoutAxisWords::of(option)?;
                        }
                        "cycles.tap-without-dwell" => {
                            choices.tap_without_dwell = TapWithoutDwell::of(option)?;
                        }
                        "program-end.feed-after-mode-change" => {
                            choices.feed_at_end = FeedAtEnd::of(option)?;
                        }
                        _ => {}
                    }
                }
                Ok(choices)
            }

            /// Whether a motion code without axis words moves in place.
            pub(crate) fn move_in_place(&self) -> bool {
                self.without_axis_words == WithoutAxisWords::MoveInPlace
            }
        }
    };
}

choices! {
    /// An abort leaves spindles and coolant as they are.
    abort_leaves_running: "abort.spindle-and-coolant", "switched-off", "left-alone";
    /// I of an arc is a diameter under G7.
    arc_centre_diameter: "arcs.diameter-centre", "radius", "diameter";
    /// Offsets of a centre alone repeat an arc.
    arc_offsets_alone: "arcs.offsets-alone", "unused", "arc";
    /// R of an arc that is a little too small makes half a circle.
    arc_half_circle: "arcs.radius-just-too-small", "refused", "half-circle";
    /// Fewer turns than one are one.
    arc_turns_one: "arcs.turns-below-one", "refused", "one";
    /// An arc with offsets of its centre needs a word of an axis of its plane.
    arc_needs_axis_word: "arcs.without-axis-words", "full-circle", "refused";
    /// An arc may go round the point where it begins.
    arc_zero_radius: "arcs.zero-radius", "refused", "accepted";
    /// In front of a G0 an arc leads round an outer corner, too.
    arc_before_traverse: "compensation.corner-before-traverse", "straight", "arc";
    /// Any move may follow cutter compensation.
    any_exit: "compensation.exit-move", "line", "any";
    /// One block may have M7 and M8.
    both_coolants: "coolant.both-in-one-block", "refused", "accepted";
    /// G85 feeds out to the clear level.
    bore_feeds_out: "cycles.bore-return", "traverse", "feed";
    /// G83 goes out to the clear level between two pecks.
    pecks_clear: "cycles.peck-return", "retract", "clear";
    /// G73 ends where the return mode says.
    break_returns: "cycles.chip-break-return", "retract", "return-level";
    /// P and Q of a cycle are needed in each block.
    arguments_each_block: "cycles.sticky-arguments", "sticky", "each-block";
    /// G84 and G74 need a spindle that turns as the thread is cut.
    tap_as_cut: "cycles.tap-direction", "any", "as-cut";
    /// The spindle turns as before after G84 and G74.
    tap_turns_back: "cycles.tap-return", "reversed", "as-before";
    /// A canned cycle needs no feed rate.
    cycle_feed_any: "cycles.feed-rate", "needed", "any";
    /// G98 returns to where the point was before each cycle, not before the row.
    level_of_cycle: "cycles.old-level", "row", "cycle";
    /// A canned cycle moves in exact path mode.
    cycle_exact_path: "cycles.path-mode", "as-programmed", "exact-path";
    /// G84 and G74 leave the overrides alone.
    tap_keeps_overrides: "cycles.tap-override-switches", "disabled", "kept";
    /// Under G93 F holds for its own block only.
    feed_for_one_block: "feed.after-inverse-time", "kept", "zero";
    /// After G93 the feed rate of the last move counts under G94.
    feed_of_last_move: "feed.after-mode-change", "none", "of-last-move";
    /// M66 is refused under cutter compensation.
    input_uncompensated: "inputs.under-compensation", "accepted", "refused";
    /// M66 without Q waits for ever.
    endless_wait: "inputs.without-timeout", "refused", "accepted";
    /// G98 at the start.
    initial_old_z: "modal-groups.initial-retract", "r-plane", "old-z";
    /// M19, M98, M99 and $ are not in the language.
    no_later_codes: "modal-groups.later-codes", "known", "unknown";
    /// M62 to M68 do not exclude each other.
    independent_io: "modal-groups.io-members", "exclusive", "independent";
    /// M50 to M53 are in the group of M48 and M49.
    one_override_group: "modal-groups.override-members", "listed", "all";
    /// Under G80 no code uses axis words.
    no_axis_words_after_cancel: "motion.offset-words-after-cancel", "accepted", "refused";
    /// Offsets in force do not change under cutter compensation.
    offset_uncompensated: "offsets.change-under-compensation", "accepted", "refused";
    /// G92 leaves the offset of axes that have no word.
    position_keeps_other_axes: "offsets.position-other-axes", "cleared", "kept";
    /// No parameter says whether the offset of G92 applies or how a system is turned, and offsets are those of the
    /// machine's axes.
    offsets_of_axes: "offsets.flag-and-rotation", "stored", "none";
    /// Offsets, positions and tools are stored and read as numbers of the active unit.
    stored_as_programmed: "offsets.stored-unit", "machine", "as-programmed";
    /// P0 of G10 L2 is refused.
    no_system_zero: "offsets.set-active-number", "active", "refused";
    /// G10 L2 needs an axis word.
    set_needs_axes: "offsets.set-without-axes", "accepted", "refused";
    /// G10 sets G54 to G59 only.
    six_systems: "offsets.systems", "nine", "six";
    /// F in the block of G20 or G21 is in the unit that the block selects.
    feed_in_new_unit: "order.feed-unit", "old", "new";
    /// M19 without $ orients all spindles.
    orient_all: "orient.without-dollar", "first", "all";
    /// Q0 of M19 is allowed.
    orient_at_once: "orient.zero-timeout", "refused", "accepted";
    /// Outputs are refused under cutter compensation.
    output_uncompensated: "outputs.under-compensation", "accepted", "refused";
    /// M48 and M49 with $ leave the feed override alone.
    feed_override_untouched: "overrides.selected-feed", "switched", "untouched";
    /// M48 to M53 are refused under cutter compensation.
    override_uncompensated: "overrides.under-compensation", "accepted", "refused";
    /// Speed overrides without $ concern spindle 0.
    override_first: "overrides.without-dollar", "all", "first";
    /// The lathe flags are 0 where the machine is not a lathe.
    lathe_flags_zero: "parameters.lathe-flags", "any-machine", "lathe-only";
    /// `_feed_override` follows M51 and `_speed_override` M50.
    override_names_as_written: "parameters.override-names", "by-name", "as-written";
    /// `_retract_old_z` reports G99 and `_retract_r_plane` G98.
    retract_names_as_written: "parameters.retract-names", "by-name", "as-written";
    /// `_spindle_on` is 0 at a speed of zero.
    spindle_on_turning: "parameters.spindle-on-at-zero", "commanded", "turning";
    /// A tolerance of G64 below zero counts as no tolerance.
    negative_tolerance_none: "path-control.negative-tolerance", "refused", "left-out";
    /// M1 does nothing.
    no_optional_stop: "pause.optional-stop", "switch", "ignored";
    /// M60 ends the program and M30 pauses it.
    pallet_table: "pause.pallet-codes", "sections", "table";
    /// G28 and G30 with axis words take every axis to the stored position.
    home_all_axes: "positions.home-axes", "named", "all";
    /// G28 and G30 with axis words go to the stored position along axes of the program.
    position_program_axes: "positions.rotated-axes", "machine", "program";
    /// G96 holds for probing too: the spindle must turn.
    probe_turning: "probe.standing-spindle", "accepted", "refused";
    /// The program end cancels the offset of G92.
    end_suspends_offset: "program-end.local-offset", "kept", "suspended";
    /// The program end stops spindle 0 only.
    end_stops_first: "program-end.spindles", "all", "first";
    /// What the main program has saved is gone when it ends or is aborted, and when the next one begins.
    saved_for_one_run: "saved-state.after-run", "kept", "forgotten";
    /// M71 needs a saved state.
    invalidate_needs_save: "saved-state.invalidate-nothing", "accepted", "refused";
    /// Every motion mode comes back, where any does.
    every_motion: "saved-state.listed-motion", "listed", "every";
    /// The motion mode comes back.
    motion_restored: "saved-state.motion-mode", "not-restored", "restored";
    /// M70 and M73 share one place.
    one_place: "saved-state.places", "apart", "one";
    /// M72 restores only where M70 saved.
    restore_needs_m70: "saved-state.restorable", "either", "m70-only";
    /// $-1 means all spindles to M3, M4 and M5.
    minus_one_all: "spindle.minus-one", "refused", "all";
    /// G97 needs S.
    rpm_needs_speed: "spindle.rpm-mode-speed", "optional", "required";
    /// M3, M4 and M5 without $ act on spindle 0.
    turn_first: "spindle.without-dollar", "all", "first";
    /// G5.2 is refused without a feed rate, and not G5.3.
    nurbs_feed_at_opening: "splines.nurbs-feed", "at-closing", "at-opening";
    /// G76 needs a spindle that turns.
    thread_needs_spindle: "threading.cycle-spindle", "any", "turning";
    /// M6 stops spindle 0 only.
    change_stops_first: "tool.change-spindles", "all", "first";
    /// M6 is refused under cutter compensation.
    change_uncompensated: "tool.change-under-compensation", "accepted", "refused";
    /// M6 without a T since the last change is allowed.
    change_unselected: "tool.change-without-selection", "refused", "accepted";
    /// A T that names no tool is refused.
    tool_must_exist: "tool.empty-slot", "accepted", "refused";
    /// The cutter is compensated in the XY plane alone.
    compensation_in_xy_only: "tool.compensation-in-zx", "accepted", "refused";
    /// G10 L1, L10 and L11 need something to set.
    entry_needs_words: "tool.entry-without-words", "accepted", "refused";
    /// G49 is refused in a block with a code that uses axis words.
    length_off_without_motion: "tool.length-off-with-motion", "accepted", "refused";
    /// G43 needs H, and H0 is an offset of zero.
    length_zero_is_none: "tool.length-number-zero", "spindle", "zero";
    /// G43, G43.1, G43.2 and G49 are refused under cutter compensation.
    length_uncompensated: "tool.length-under-compensation", "accepted", "refused";
    /// The old tool goes to the slot of the new one.
    old_tool_to_new_slot: "tool.old-tool-place", "its-own-slot", "slot-of-the-new";
    /// The slide of G76 moves the end of a pass too.
    thread_end_with_depth: "threading.slide-end", "fixed", "with-depth";
    /// G76 without R cuts passes of the same area.
    thread_constant_area: "threading.without-degression", "constant-depth", "constant-area";
    /// D and H are numbers of slots.
    offsets_by_slot: "tool.offset-numbers", "tool", "slot";
    /// T is the number of a slot.
    tool_by_slot: "tool.selected-by", "number", "slot";
    /// A program may not have M61.
    no_set_in_program: "tool.set-number-in-program", "accepted", "refused";
    /// M61 may name any tool.
    set_any_tool: "tool.set-number-unknown", "refused", "accepted";
    /// X words of offsets are diameters too under G7.
    diameter_offsets: "units-planes.diameter-offsets", "moves-only", "every-word";
    /// The number of F stays over a change of unit.
    feed_number_kept: "units-planes.feed-over-unit-change", "rescaled", "kept";
    /// The machine's own unit is in force at the start.
    initial_machine_unit: "units-planes.initial-unit", "millimetre", "machine";
    /// G20 and G21 are refused under cutter compensation.
    units_uncompensated: "units-planes.units-under-compensation", "accepted", "refused";
    /// G17, G18 and G19 do not change the plane under cutter compensation.
    plane_uncompensated: "units-planes.plane-under-compensation", "accepted", "refused";
    /// A missing argument of a user-defined code is an empty text.
    empty_argument: "user-codes.missing-argument", "minus-one", "empty";
}

/// Options of `arcs.small-tolerance`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ArcTolerance {
    /// As the section on arcs says.
    Coarse,
    /// As the advice says, which allows a smaller difference of small radii.
    Fine,
    /// As the section on arcs says for millimetres, in inches too.
    Millimetres,
    /// One bound for arcs of every radius.
    TwoMicrometres,
}

impl ArcTolerance {
    fn of(option: &str) -> Result<Self, Error> {
        match option {
            "coarse" => Ok(Self::Coarse),
            "fine" => Ok(Self::Fine),
            "millimetres" => Ok(Self::Millimetres),
            "two-micrometres" => Ok(Self::TwoMicrometres),
            _ => Err(Error::Configuration("no such option of arcs.small-tolerance")),
        }
    }
}

/// Options of `motion.without-axis-words`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WithoutAxisWords {
    /// The mode is set.
    Nothing,
    /// The point moves to where it is.
    MoveInPlace,
    /// The block is refused.
    Refused,
}

impl WithoutAxisWords {
    fn of(option: &str) -> Result<Self, Error> {
        match option {
            "nothing" => Ok(Self::Nothing),
            "move-in-place" => Ok(Self::MoveInPlace),
            "refused" => Ok(Self::Refused),
            _ => Err(Error::Configuration("no such option of motion.without-axis-words")),
        }
    }
}

/// Options of `modal-groups.initial-motion`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum InitialMotion {
    /// G80.
    None,
    /// G1.
    Feed,
    /// G0.
    Traverse,
}

impl InitialMotion {
    fn of(option: &str) -> Result<Self, Error> {
        match option {
            "none" => Ok(Self::None),
            "feed" => Ok(Self::Feed),
            "traverse" => Ok(Self::Traverse),
            _ => Err(Error::Configuration("no such option of modal-groups.initial-motion")),
        }
    }
}

/// Options of `cycles.tap-without-dwell`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TapWithoutDwell {
    /// G84 and G74 need P.
    Refused,
    /// Without P they dwell for zero seconds.
    Zero,
    /// Without P they do not dwell.
    NoDwell,
}

impl TapWithoutDwell {
    fn of(option: &str) -> Result<Self, Error> {
        match option {
            "refused" => Ok(Self::Refused),
            "zero" => Ok(Self::Zero),
            "none" => Ok(Self::NoDwell),
            _ => Err(Error::Configuration("no such option of cycles.tap-without-dwell")),
        }
    }
}

/// Options of `program-end.feed-after-mode-change`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FeedAtEnd {
    /// No feed rate is set.
    Zero,
    /// The number of F stays.
    Kept,
    /// That of the last feed move, per minute.
    OfLastMove,
}

impl FeedAtEnd {
    fn of(option: &str) -> Result<Self, Error> {
        match option {
            "zero" => Ok(Self::Zero),
            "kept" => Ok(Self::Kept),
            "of-last-move" => Ok(Self::OfLastMove),
            _ => Err(Error::Configuration("no such option of program-end.feed-after-mode-change")),
        }
    }
}
