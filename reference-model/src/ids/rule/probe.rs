//! Each rule of `probe`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::PROBE;

    /// Probing is refused when the probe is already as the move wants it: touching for G38.2 and G38.3, not
    /// touching for G38.4 and G38.5.
    ALREADY_THERE = "probe.already-there",
    /// Probing is a motion at the current feed rate.
    AT_FEED = "probe.at-feed",
    /// G38.4 and G38.5 move the controlled point straight toward the programmed point and stop where the
    /// probe ceases to touch.
    AWAY = "probe.away",
    /// Probing needs an axis word.
    AXIS_WORDS_MISSING = "probe.axis-words-missing",
    /// G38.2 and G38.4 that find no change are an error: the program does not go on.
    FAILURE = "probe.failure",
    /// Under inverse time F of a probing block gives the time of the whole way to the programmed point.
    INVERSE_TIME = "probe.inverse-time",
    /// After probing that succeeded `#5061` to `#5069` are where the controlled point was when the probe
    /// changed, in the current coordinate system, and `#5070` is 1.
    POINT = "probe.point",
    /// After probing that failed `#5061` to `#5069` are the programmed point, and `#5070` is 0.
    POINT_WITHOUT_CONTACT = "probe.point-without-contact",
    /// Probing to where the controlled point is, is refused.
    SAME_POINT = "probe.same-point",
    /// G38.2 and G38.3 move the controlled point straight toward the programmed point and stop where the
    /// probe begins to touch.
    TOWARD = "probe.toward",
    /// Probing while cutter compensation is on is refused.
    UNDER_COMPENSATION = "probe.under-compensation",
    /// G38.3 and G38.5 that find no change go to the programmed point, and the program goes on.
    WITHOUT_FAILURE = "probe.without-failure",
    /// Probing needs a feed rate.
    ZERO_FEED = "probe.zero-feed",
}
