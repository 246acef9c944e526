//! Each rule of `overrides`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::OVERRIDES;

    /// M52 with P1 or without P turns adaptive feed on, with P0 off, and nothing else.
    ADAPTIVE_FEED = "overrides.adaptive-feed",
    /// Adaptive feed counts while the feed override is disabled, too.
    ADAPTIVE_FEED_ALONE = "overrides.adaptive-feed-alone",
    /// Without adaptive feed its input has no influence.
    ADAPTIVE_FEED_NO_INFLUENCE = "overrides.adaptive-feed-no-influence",
    /// With adaptive feed an input of zero holds a move as feed hold does, and 1 is full speed.
    ADAPTIVE_FEED_ZERO = "overrides.adaptive-feed-zero",
    /// With $ M48 and M49 switch the speed override of that spindle and of no other; whether they switch the
    /// feed override too is a choice.
    BOTH_SELECTED = "overrides.both-selected",
    /// M48 and M49 take no P.
    BOTH_UNUSED_P = "overrides.both-unused-p",
    /// M49 disables the feed and the spindle speed override.
    DISABLE_BOTH = "overrides.disable-both",
    /// M48 enables the feed and the spindle speed override.
    ENABLE_BOTH = "overrides.enable-both",
    /// M50 with P1 or without P enables the feed override, with P0 it disables it, and nothing else.
    FEED = "overrides.feed",
    /// While the feed override is enabled it counts: at zero a feed move does not get on until it is turned
    /// up.
    FEED_INFLUENCE = "overrides.feed-influence",
    /// While the feed override is disabled it has no influence: a move is executed at the programmed feed.
    FEED_NO_INFLUENCE = "overrides.feed-no-influence",
    /// M53 with P1 or without P enables the feed stop switch, with P0 it disables it, and nothing else.
    FEED_STOP = "overrides.feed-stop",
    /// While the feed stop is enabled its input stops motion.
    FEED_STOP_HOLDS = "overrides.feed-stop-holds",
    /// While the feed stop is disabled its input has no effect.
    FEED_STOP_NO_EFFECT = "overrides.feed-stop-no-effect",
    /// M50, M52 and M53 take no $.
    FEED_TAKES_NO_DOLLAR = "overrides.feed-takes-no-dollar",
    /// M50 and M51 change what M48 and M49 have set, one control at a time.
    ONE_BY_ONE = "overrides.one-by-one",
    /// P of M50 to M53 is 0 or 1; anything else is refused.
    OTHER_P = "overrides.other-p",
    /// A $ word with M48, M49 or M51 that names no spindle of the machine is refused.
    OUT_OF_RANGE = "overrides.out-of-range",
    /// M48 and M49 are allowed when the overrides are already enabled or disabled.
    REPEATED = "overrides.repeated",
    /// M51 with P1 or without P enables the spindle speed override, with P0 it disables it, and nothing else.
    SPEED = "overrides.speed",
    /// M51 with $ concerns the speed override of that spindle only.
    SPEED_SELECTED = "overrides.speed-selected",
    /// While the speed override is disabled the spindle turns at exactly the speed of S.
    SPEED_VALUE = "overrides.speed-value",
    /// Overrides may be switched while cutter compensation is on, unless a controller takes it for an error.
    UNDER_COMPENSATION = "overrides.under-compensation",
    /// M48, M49 and M51 without $ concern the speed override of all spindles or of spindle 0.
    WITHOUT_DOLLAR = "overrides.without-dollar",
}
