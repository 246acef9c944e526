//! Each choice of `order`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::ORDER;

    /// In which length unit F is read in the block that changes the unit: LinuxCNC sets the feed rate before
    /// the unit, Grbl converts the values of a block by the modes that the block sets.
    FeedUnit = "order.feed-unit" {
        /// in the unit before the block
        Old = "old",
        /// in the unit of the block
        New = "new",
    }
}
