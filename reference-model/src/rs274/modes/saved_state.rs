//! What M70 and M73 keep.

use super::Modes;

/// A saved state.
#[derive(Clone, Debug, PartialEq)]
pub struct SavedState {
    /// The modes at the save. What a restore takes from them is the matter of `execute::restore`.
    pub modes: Modes,
    /// Whether it can be restored from: M71 takes that away.
    pub valid: bool,
}
