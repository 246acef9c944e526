//! Each rule of `motion`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::MOTION;

    /// An axis letter without a number is refused.
    AXIS_WITHOUT_VALUE = "motion.axis-without-value",
    /// Axis words alone are refused while G80 is active.
    AXIS_WORDS_AFTER_CANCEL = "motion.axis-words-after-cancel",
    /// G80 cancels the motion mode.
    CANCEL = "motion.cancel",
    /// Axis words in a block with G80 are refused.
    CANCEL_WITH_AXIS_WORDS = "motion.cancel-with-axis-words",
    /// G1 makes a linear move to the programmed point.
    FEED = "motion.feed",
    /// Another motion code replaces the motion mode.
    MODE_CHANGE = "motion.mode-change",
    /// Axis words alone repeat the motion mode.
    MODE_HOLDS = "motion.mode-holds",
    /// An axis letter that the machine does not have is refused.
    NO_SUCH_AXIS = "motion.no-such-axis",
    /// Whether the axis words of offset and position codes are refused while G80 is active is a choice.
    OFFSET_WORDS_AFTER_CANCEL = "motion.offset-words-after-cancel",
    /// An axis without a word keeps its value.
    OMITTED_AXES = "motion.omitted-axes",
    /// @ is a distance from the XY origin and ^ an angle counterclockwise from the X axis.
    POLAR = "motion.polar",
    /// An incremental polar move that starts at the origin is refused.
    POLAR_FROM_ORIGIN = "motion.polar-from-origin",
    /// Under G91 distance and angle add to those of the current point.
    POLAR_INCREMENTAL = "motion.polar-incremental",
    /// Polar words together with X or Y are refused.
    POLAR_MIXED = "motion.polar-mixed",
    /// Polar words in the block of G10, G43.1, G52 or G92 are refused: they give the XY coordinate of a move.
    POLAR_MOVES_ONLY = "motion.polar-moves-only",
    /// A polar word that is left out keeps its value; under G91 it adds nothing.
    POLAR_PARTIAL = "motion.polar-partial",
    /// Rotary axes move together with the linear ones.
    ROTARY_AXES = "motion.rotary-axes",
    /// G0 makes a rapid move to the programmed point.
    TRAVERSE = "motion.traverse",
    /// G0 and G1 without axis words set the motion mode and leave the point where it is, or are refused.
    WITHOUT_AXIS_WORDS = "motion.without-axis-words",
}
