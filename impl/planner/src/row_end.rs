//! The end of a row of chords that the motion comes near to.

/// How many elements that the motion has passed are remembered at least, for running in reverse.
pub(crate) const REVERSE_ELEMENTS_MIN: u64 = 128;
/// The motion is near the end of the path only if no more elements are left.
pub(crate) const NEAR_END_ELEMENTS: u64 = 48;

/// What servo cycles have done to end the row of chords before the motion reaches the end of the path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RowEnd {
    /// Nothing.
    Open,
    /// The motion is near the end.
    Near,
    /// The next line is written.
    Written,
    /// Its corner is found, and it waits for a cheap cycle: how many cycles.
    HasCorner(u8),
}
