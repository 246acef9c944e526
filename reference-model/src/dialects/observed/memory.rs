//! State that quirks of LinuxCNC need in addition to the documented state.

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_vocabulary::{Plane, Position, SpindleTurn};

use crate::rs274::modes::Modes;
use crate::rs274::text::Place;

/// State outside of the modes: M70 and M73 do not save it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Memory {
    /// Quirk rs274.rest-of-restore-block: whether the rest of the block is not executed.
    pub(super) drops_rest: bool,
    /// Quirk rs274.chosen-spindle: the spindle of cycles and synchronised moves without $.
    pub(super) chosen_spindle: usize,
    /// Quirk rs274.tap-dwell-kept: P of the last canned cycle that had one, seconds.
    pub(super) cycle_dwell: f64,
    /// Quirk nist.cycle-repeats-last-word: the numbers of the last X, Y and Z word of a block.
    pub(super) last_words: [f64; 3],
    /// Quirk rs274.polar-plane: the plane in force before the block that is executed.
    pub(super) plane_before: Option<Plane>,
    /// Quirk grbl.offset-cancelled-late: the local offset that the last G92.1 has cancelled.
    pub(super) cancelled_offset: Position,
    /// Quirk linuxcnc.modes-of-last-motion: the modes in force at the last motion; `None` before the first motion, and
    /// if the last one was in a sub.
    pub(super) at_last_motion: Option<Box<Modes>>,
    /// Quirk linuxcnc.selection-kept: the tool of the last M6, if it was in the spindle before.
    pub(super) kept_selection: Option<i32>,
    /// Quirk linuxcnc.speed-while-oriented: how each spindle turned before M19.
    pub(super) turned_before: BTreeMap<usize, SpindleTurn>,
    /// Quirk linuxcnc.speed-while-oriented: oriented spindles that a speed has let turn again.
    pub(super) turning_again: BTreeSet<usize>,
    /// Quirk linuxcnc.spindle-mode-read-back: spindles whose speed follows G96, although they are in revolutions mode.
    pub(super) follows_surface_speed: BTreeSet<usize>,
    /// Quirk linuxcnc.tool-change-move: whether the machine is on its way to where the tool is changed.
    pub(super) moves_to_change: bool,
    /// Quirk linuxcnc.move-in-place: where the last move has led the axes, machine position, millimetres.
    pub(super) axes: Position,
    /// Quirk linuxcnc.point-read-back: where the machine is, in its own coordinates and in millimetres, while the
    /// interpreter takes it to be elsewhere.
    pub(super) machine_point: Option<Position>,
    /// Quirk linuxcnc.point-read-back: where the block has led the machine, likewise.
    pub(super) led_to: Option<Position>,
}

/// State of subroutines and loops, from the beginning of a program to that of the next one.
#[derive(Clone, Debug, Default)]
pub(crate) struct ControlMemory {
    /// Quirk rs274.repeat-counter-shared: turns left of each repeat.
    pub(super) shared_counters: BTreeMap<Place, u64>,
    /// Quirk rs274.fanuc-changes-at-end: #1 to #30 of the main program at its last O-word call.
    pub(super) at_last_call: [f64; 30],
    /// Quirk rs274.continue-remembered: whether a do loop was continued since the last loop of another kind ended.
    pub(super) continue_remembered: bool,
    /// Quirk rs274.break-remembered: whether a while was broken since the last do loop tested its condition.
    pub(super) break_remembered: bool,
    /// Quirk rs274.return-after-call: whether a sub or a numbered program was called since a sub was defined.
    pub(super) has_called: bool,
    /// Quirk rs274.sub-found-later: definitions that a call found further on in the file.
    pub(super) found_later: BTreeSet<Place>,
    /// Quirk rs274.numbers-of-all-files: numbered programs that were called before, by number.
    pub(super) numbers_called: BTreeMap<String, Place>,
}

/// State of a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct SourceMemory {
    /// Quirk rs274.percent-in-file: whether percent lines have no meaning.
    pub(super) ignores_percent: bool,
}
