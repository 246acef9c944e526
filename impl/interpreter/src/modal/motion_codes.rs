//! Motion modes and the codes that set them.

use gaugeblock_vocabulary::Motion;

/// The motion mode that a code in tenths sets.
pub(super) const fn mode_of(code: u16) -> Motion {
    match code {
        0 => Motion::Traverse,
        10 => Motion::Feed,
        20 => Motion::ArcClockwise,
        30 => Motion::ArcCounterclockwise,
        50 => Motion::CubicSpline,
        51 => Motion::QuadraticSpline,
        52 => Motion::Nurbs,
        330 => Motion::SpindleSynchronised,
        331 => Motion::RigidTap,
        382 => Motion::ProbeTowardError,
        383 => Motion::ProbeToward,
        384 => Motion::ProbeAwayError,
        385 => Motion::ProbeAway,
        730 => Motion::Cycle73,
        740 => Motion::Cycle74,
        760 => Motion::Thread76,
        810 => Motion::Cycle81,
        820 => Motion::Cycle82,
        830 => Motion::Cycle83,
        840 => Motion::Cycle84,
        850 => Motion::Cycle85,
        860 => Motion::Cycle86,
        870 => Motion::Cycle87,
        880 => Motion::Cycle88,
        890 => Motion::Cycle89,
        _ => Motion::None,
    }
}

/// The code of a motion mode in tenths.
pub(super) fn code_of(motion: Motion) -> u16 {
    match motion {
        Motion::Traverse => 0,
        Motion::Feed => 10,
        Motion::ArcClockwise => 20,
        Motion::ArcCounterclockwise => 30,
        Motion::CubicSpline => 50,
        Motion::QuadraticSpline => 51,
        Motion::Nurbs => 52,
        Motion::SpindleSynchronised => 330,
        Motion::RigidTap => 331,
        Motion::ProbeTowardError => 382,
        Motion::ProbeToward => 383,
        Motion::ProbeAwayError => 384,
        Motion::ProbeAway => 385,
        Motion::Cycle73 => 730,
        Motion::Cycle74 => 740,
        Motion::Thread76 => 760,
        Motion::None => 800,
        Motion::Cycle81 => 810,
        Motion::Cycle82 => 820,
        Motion::Cycle83 => 830,
        Motion::Cycle84 => 840,
        Motion::Cycle85 => 850,
        Motion::Cycle86 => 860,
        Motion::Cycle87 => 870,
        Motion::Cycle88 => 880,
        Motion::Cycle89 => 890,
    }
}

/// Whether a motion mode belongs to a series of cycles (11.5.61).
pub(super) const fn is_cycle(motion: Motion) -> bool {
    matches!(
        motion,
        Motion::Cycle73
            | Motion::Cycle74
            | Motion::Thread76
            | Motion::Cycle81
            | Motion::Cycle82
            | Motion::Cycle83
            | Motion::Cycle84
            | Motion::Cycle85
            | Motion::Cycle86
            | Motion::Cycle87
            | Motion::Cycle88
            | Motion::Cycle89
    )
}
