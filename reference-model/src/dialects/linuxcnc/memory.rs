//! What LinuxCNC remembers and the documents do not need.

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_vocabulary::Plane;

use crate::rs274::modes::Modes;
use crate::rs274::text::Place;

/// What it remembers besides the modes: no save keeps it, and no restore brings it back.
#[derive(Clone, Debug, Default)]
pub(crate) struct Memory {
    /// Quirk rs274.rest-of-restore-block: whether the rest of the block is dropped.
    pub(super) drops_rest: bool,
    /// Quirk rs274.chosen-spindle: the spindle that cycles and synchronised moves follow without $.
    pub(super) chosen_spindle: usize,
    /// Quirk rs274.tap-dwell-kept: P of the last canned cycle that had one, seconds.
    pub(super) cycle_dwell: f64,
    /// Quirk rs274.polar-plane: the plane in force before the block that is executed.
    pub(super) plane_before: Option<Plane>,
    /// Quirk linuxcnc.modes-of-last-motion: the modes in force at the last motion, or before the first block; none
    /// where that motion was in a sub.
    pub(super) at_last_motion: Option<Box<Modes>>,
    /// Quirk linuxcnc.modes-of-last-motion: whether anything has moved.
    pub(super) has_moved: bool,
}

/// What it remembers with the control of a program, until another one begins.
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
    /// Quirk rs274.return-after-call: whether a sub or a numbered program was called before.
    pub(super) has_called: bool,
    /// Quirk rs274.sub-found-later: definitions of subs that were found behind their call.
    pub(super) found_later: BTreeSet<Place>,
    /// Quirk rs274.numbers-of-all-files: numbered programs that were called before, by number.
    pub(super) numbers_called: BTreeMap<String, Place>,
}

/// What it remembers of a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct SourceMemory {
    /// Quirk rs274.percent-in-file: whether percent lines mean nothing.
    pub(super) ignores_percent: bool,
}
