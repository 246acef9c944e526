//! The motion mode of each motion code.

use gaugeblock_vocabulary::Motion;

/// Motion codes in tenths, with their modes.
const MOTIONS: &[(u32, Motion)] = &[
    (0, Motion::Traverse),
    (10, Motion::Feed),
    (20, Motion::ArcClockwise),
    (30, Motion::ArcCounterclockwise),
    (50, Motion::CubicSpline),
    (51, Motion::QuadraticSpline),
    (52, Motion::Nurbs),
    (330, Motion::SpindleSynchronised),
    (331, Motion::RigidTap),
    (382, Motion::ProbeTowardError),
    (383, Motion::ProbeToward),
    (384, Motion::ProbeAwayError),
    (385, Motion::ProbeAway),
    (730, Motion::Cycle73),
    (740, Motion::Cycle74),
    (760, Motion::Thread76),
    (800, Motion::None),
    (810, Motion::Cycle81),
    (820, Motion::Cycle82),
    (830, Motion::Cycle83),
    (840, Motion::Cycle84),
    (850, Motion::Cycle85),
    (860, Motion::Cycle86),
    (870, Motion::Cycle87),
    (880, Motion::Cycle88),
    (890, Motion::Cycle89),
];

/// The motion mode that a G code selects; none when it is no motion code, or one of G5.3 and G70 to G72.
pub fn motion_mode(code: u32) -> Option<Motion> {
    MOTIONS.iter().find(|(number, _)| *number == code).map(|(_, motion)| *motion)
}

/// The code of a motion mode, in tenths.
///
/// # Panics
/// A mode that is not in the table: a fault of the model.
pub fn motion_code(motion: Motion) -> u32 {
    let found = MOTIONS.iter().find(|(_, mode)| *mode == motion);
    found.expect("model: every motion mode has a code").0
}
