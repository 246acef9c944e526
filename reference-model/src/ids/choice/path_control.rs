//! Each choice of `path-control`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::PATH_CONTROL;

    /// What a tolerance of G64 below zero means. The section lists no errors, and no path is nearer than at
    /// no distance.
    NegativeTolerance = "path-control.negative-tolerance" {
        /// it is none
        Refused = "refused",
        /// it counts as no tolerance
        LeftOut = "left-out",
    }
}
