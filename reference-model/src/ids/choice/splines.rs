//! Each choice of `splines`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::SPLINES;

    /// Where a NURBS without a feed rate is refused: the manual names no error, and the curve is fed along
    /// when its block is closed.
    NurbsFeed = "splines.nurbs-feed" {
        /// G5.3, which moves, is refused
        AtClosing = "at-closing",
        /// G5.2 is refused, and so is each point; G5.3 is not
        AtOpening = "at-opening",
    }
}
