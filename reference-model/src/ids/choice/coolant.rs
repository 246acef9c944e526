//! Each choice of `coolant`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::COOLANT;

    /// Whether M7 and M8 are allowed in one block. They share a modal group, of which the table says that
    /// both can be on.
    BothInOneBlock = "coolant.both-in-one-block" {
        /// two codes of one modal group
        Refused = "refused",
        /// both are turned on
        Accepted = "accepted",
    }
}
