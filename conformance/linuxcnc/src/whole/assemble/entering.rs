//! Where the driver is with a block that is entered by hand.

use gaugeblock_vocabulary::BlockLocation;

/// The file that blocks entered besides a program are recorded in.
const FILE: &str = "mdi";

/// Where the driver is with a block.
#[derive(Clone, Debug)]
pub(super) enum Entering {
    /// The next checkpoint has the settings before it.
    Before { line: u32, text: String },
    /// The block itself comes.
    Block { line: u32, text: String },
    /// The next checkpoint has the settings after it.
    After { line: u32, text: String },
}

/// The block of this number among those that are entered.
pub(super) fn block(line: u32) -> BlockLocation {
    BlockLocation::new(FILE, line)
}
