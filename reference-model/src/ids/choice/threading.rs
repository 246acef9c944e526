//! Each choice of `threading`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::THREADING;

    /// Whether G76 is refused while the spindle does not turn. It is not among its errors; the cycle is based
    /// on G33, which is.
    CycleSpindle = "threading.cycle-spindle" {
        /// whether or not the spindle turns
        Any = "any",
        /// the spindle must turn
        Turning = "turning",
    }

    /// Whether the slide angle of G76 moves the end of a pass too. The manual says that passes are offset
    /// along the drive line, and that the last one ends at Z.
    SlideEnd = "threading.slide-end" {
        /// every pass ends at Z
        Fixed = "fixed",
        /// the less deep a pass the further before Z it ends
        WithDepth = "with-depth",
    }

    /// How deep the passes of G76 are without R. R is optional, and the manual names no value that it has
    /// then.
    WithoutDegression = "threading.without-degression" {
        /// as under R1
        ConstantDepth = "constant-depth",
        /// as under R2
        ConstantArea = "constant-area",
    }
}
