//! Each rule of `feed`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::FEED;

    /// Whether a block without F under G93 sets the feed rate to zero is a choice.
    AFTER_INVERSE_TIME = "feed.after-inverse-time",
    /// A linear move is made at the feed rate that is current.
    APPLIES_TO_FEED_MOVES = "feed.applies-to-feed-moves",
    /// A feed counts X, Y, Z if one of them moves, else U, V, W if one of them does, else A, B, C; the others
    /// start and stop with them.
    COORDINATES = "feed.coordinates",
    /// G93 sets inverse time feed mode, and F counts for its own block.
    INVERSE_TIME = "feed.inverse-time",
    /// Under G93 every block with a feed move, programmed or implied, must have an F word.
    INVERSE_TIME_NEEDS_RATE = "feed.inverse-time-needs-rate",
    /// G93 does not affect rapid moves.
    INVERSE_TIME_RAPID = "feed.inverse-time-rapid",
    /// Under G93 an F word in a block without a feed move is ignored.
    INVERSE_TIME_STRAY_RATE = "feed.inverse-time-stray-rate",
    /// A feed mode holds until another is programmed.
    MODE_HOLDS = "feed.mode-holds",
    /// A linear move for which no feed rate has been set is refused.
    MOVE_WITHOUT_RATE = "feed.move-without-rate",
    /// A negative feed rate is refused.
    NEGATIVE_RATE = "feed.negative-rate",
    /// G94 sets units per minute feed mode.
    PER_MINUTE = "feed.per-minute",
    /// G95 sets units per revolution feed mode.
    PER_REVOLUTION = "feed.per-revolution",
    /// With G95 a $ word may be given, for the spindle to which the feed is tied; it must name a spindle of
    /// the machine.
    PER_REVOLUTION_SPINDLE = "feed.per-revolution-spindle",
    /// F sets the feed rate, which holds until another F.
    RATE = "feed.rate",
    /// After a switch to G94 or G95 a new feed rate must be given.
    RATE_AFTER_MODE_CHANGE = "feed.rate-after-mode-change",
    /// F in a block without motion sets the feed rate and moves nothing.
    RATE_MOVES_NOTHING = "feed.rate-moves-nothing",
    /// A rapid move needs no feed rate.
    TRAVERSE_NEEDS_NONE = "feed.traverse-needs-none",
}
