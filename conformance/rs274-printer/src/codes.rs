//! Codes by what they do, in tenths, and the inch.

/// G54 to G59.3.
pub(super) const WORK_OFFSETS: [u16; 9] = [540, 550, 560, 570, 580, 590, 591, 592, 593];

/// Codes of the motion group.
pub(super) const MOTIONS: [u16; 27] = [
    0, 10, 20, 30, 50, 51, 52, 53, 330, 331, 382, 383, 384, 385, 730, 740, 760, 800, 810, 820, 830,
    840, 850, 860, 870, 880, 890,
];

/// Canned cycles.
pub(super) const CYCLES: [u16; 11] = [730, 740, 810, 820, 830, 840, 850, 860, 870, 880, 890];

/// Lathe cycles whose profile is in a sub.
pub(super) const TURNINGS: [u16; 7] = [700, 710, 711, 712, 720, 721, 722];

/// Millimetres in an inch: stored lengths are inches.
pub(super) const INCH: f64 = 25.4;

/// The work coordinate system of G54 to G59.3, from 1.
pub(super) fn system_of(code: u16) -> u32 {
    (1..).zip(WORK_OFFSETS).find(|(_, other)| *other == code).map_or(0, |(system, _)| system)
}
