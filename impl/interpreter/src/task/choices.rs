//! The points at which documents differ, as far as they concern the task.

use gaugeblock_vocabulary::Options;

use crate::error::Error;

/// The choices of the dialect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Choices {
    /// `abort.read-ahead`: modes and parameters are those that the interpreter has made by reading ahead.
    pub(super) read_ahead_on_abort: bool,
    /// `abort.spindle-and-coolant`: spindles go on, and those that are held at an angle stay so.
    pub(super) abort_keeps_spindles: bool,
    /// `orient.brake-otherwise`: the brake is applied only while the spindle is locked.
    pub(super) brake_while_locked: bool,
    /// `outputs.at-once-over-waiting`: a setting at once cancels one that waits.
    pub(super) at_once_replaces: bool,
    /// `outputs.waiting-after-abort`: what waits for a motion when a program is aborted waits for the next one.
    pub(super) waits_after_abort: bool,
    /// `outputs.waiting-after-end`: what waits for a motion when a program ends is forgotten.
    pub(super) forgets_at_end: bool,
    /// `pause.cycle-start`: cycle start goes on after M0 and M1.
    pub(super) cycle_start_resumes: bool,
    /// `pause.during-dwell`: a pause stops a dwell.
    pub(super) pause_stops_dwell: bool,
    /// `task.mdi-in-manual`: a block by hand in manual mode is executed.
    pub(super) mdi_in_manual: bool,
}

impl Choices {
    /// Reads the options; a choice that is not listed has its first.
    pub(crate) fn read(options: &Options) -> Result<Self, Error> {
        let second = |id: &str, first: &str, second: &str| match options.get(id) {
            None => Ok(false),
            Some(option) if option == first => Ok(false),
            Some(option) if option == second => Ok(true),
            Some(_) => Err(Error::Configuration("no such option of a choice about the task")),
        };
        Ok(Self {
            read_ahead_on_abort: second("abort.read-ahead", "none", "read-on")?,
            abort_keeps_spindles: second(
                "abort.spindle-and-coolant",
                "switched-off",
                "left-alone",
            )?,
            brake_while_locked: second("orient.brake-otherwise", "while-standing", "while-locked")?,
            at_once_replaces: second("outputs.at-once-over-waiting", "kept", "replaces")?,
            waits_after_abort: second("outputs.waiting-after-abort", "forgotten", "kept")?,
            forgets_at_end: second("outputs.waiting-after-end", "kept", "forgotten")?,
            cycle_start_resumes: second("pause.cycle-start", "refused", "goes-on")?,
            pause_stops_dwell: second("pause.during-dwell", "goes-on", "stands-still")?,
            mdi_in_manual: second("task.mdi-in-manual", "refused", "executed")?,
        })
    }
}
