//! Each rule of `positions`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::POSITIONS;

    /// With axis words G28 moves at rapid speed to the point that they name, as G0 would, and then to the
    /// stored position.
    BY_WAY_OF = "positions.by-way-of",
    /// G28 without axis words moves every axis at rapid speed to the machine position that `#5161` to `#5169`
    /// hold in the machine's unit.
    GO = "positions.go",
    /// Whether G28 and G30 with axis words move an axis without a word to the stored position is a choice.
    HOME_AXES = "positions.home-axes",
    /// Axes for which G28 or G30 has no word do not move.
    NAMED_AXES = "positions.named-axes",
    /// Where nothing was stored, G28 and G30 go to the machine's zero.
    NOT_STORED = "positions.not-stored",
    /// Which axes a word of G28 names in a rotated coordinate system is a choice.
    ROTATED_AXES = "positions.rotated-axes",
    /// G30 and G30.1 are like G28 and G28.1 with `#5181` to `#5189`.
    SECOND = "positions.second",
    /// G28.1 stores the machine position in `#5161` to `#5169`, in the machine's unit, and moves nothing.
    STORE = "positions.store",
    /// Axis words in the block of G28.1 and G30.1 belong to the motion mode; the position before the move is
    /// stored.
    STORE_WITH_MOTION = "positions.store-with-motion",
    /// G28, G28.1, G30 and G30.1 are refused while cutter compensation is on.
    UNDER_COMPENSATION = "positions.under-compensation",
}
