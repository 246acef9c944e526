//! Each choice of `subroutines`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::SUBROUTINES;

    /// Whether a return inside a sub must carry the number of that sub. The documents list only the return
    /// outside any sub as an error.
    ReturnLabel = "subroutines.return-label" {
        /// a return with another number leaves the sub too
        Any = "any",
        /// a return with another number is refused
        Own = "own",
    }
}
