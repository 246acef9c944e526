//! Each choice of `spindle`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::SPINDLE;

    /// What $-1 means to M3, M4 and M5. The 2.8 text does not know it.
    MinusOne = "spindle.minus-one" {
        /// no spindle has this number
        Refused = "refused",
        /// all spindles
        All = "all",
    }

    /// Whether G97 needs an S word. Its form has one that is not marked optional; the list of errors requires
    /// S with G96 only.
    RpmModeSpeed = "spindle.rpm-mode-speed" {
        /// the speed stays
        Optional = "optional",
        /// G97 without S is refused
        Required = "required",
    }

    /// Which spindles M3, M4 and M5 without $ act on.
    WithoutDollar = "spindle.without-dollar" {
        /// all spindles
        All = "all",
        /// spindle 0
        First = "first",
    }
}
