//! Each rule of `coolant`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::COOLANT;

    /// Mist and flood can be on together.
    BOTH = "coolant.both",
    /// M7 and M8 are of one modal group and, unless its table is read in another way, not allowed in one
    /// block.
    BOTH_IN_ONE_BLOCK = "coolant.both-in-one-block",
    /// M8 turns flood coolant on and leaves mist alone.
    FLOOD = "coolant.flood",
    /// M8 switches the flood pin on, M9 off.
    FLOOD_PIN = "coolant.flood-pin",
    /// M7 turns mist coolant on and leaves flood alone.
    MIST = "coolant.mist",
    /// M7 switches the mist pin on, M9 off.
    MIST_PIN = "coolant.mist-pin",
    /// M9 turns mist and flood off.
    OFF = "coolant.off",
    /// Every coolant code is allowed in every coolant state.
    REPEATED = "coolant.repeated",
}
