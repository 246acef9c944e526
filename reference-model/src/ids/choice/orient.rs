//! Each choice of `orient`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::ORIENT;

    /// When the brake of a spindle is applied besides at the end of an orientation. The documents do not say.
    BrakeOtherwise = "orient.brake-otherwise" {
        /// whenever the spindle is commanded neither to turn nor to go to an angle; one that M3 has started
        /// at a speed of zero is commanded to turn
        WhileStanding = "while-standing",
        /// only while the spindle is locked
        WhileLocked = "while-locked",
    }

    /// Which spindles M19 without $ orients.
    WithoutDollar = "orient.without-dollar" {
        /// spindle 0
        First = "first",
        /// every one
        All = "all",
    }

    /// Whether Q of M19 may be zero. The documents give no lowest value.
    ZeroTimeout = "orient.zero-timeout" {
        /// Q is greater than zero
        Refused = "refused",
        /// a spindle that is at its angle at once is in time
        Accepted = "accepted",
    }
}
