//! Modal groups: of the members of a group one is in force, and a block holds at most one.

/// A modal group.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ModalGroup {
    /// Group 0: codes that hold for their own block only.
    NonModal,
    /// G92.1 to G92.3, where they do not belong to group 0.
    LocalOffset,
    /// Group 1.
    Motion,
    /// Group 2.
    Plane,
    /// Group 3.
    Distance,
    /// Group 4.
    ArcDistance,
    /// Group 5.
    FeedMode,
    /// Group 6.
    Units,
    /// Group 7.
    Compensation,
    /// Group 8.
    ToolLength,
    /// Group 10.
    Retract,
    /// Group 12.
    WorkOffset,
    /// Group 13.
    Path,
    /// Group 14.
    SpindleMode,
    /// Group 15.
    Lathe,
    /// Group 4 of the M codes.
    Stopping,
    /// Group 5 of the M codes, whose members no document lists.
    InputsOutputs,
    /// Group 6 of the M codes.
    ToolChange,
    /// Group 7 of the M codes.
    Spindle,
    /// Group 8 of the M codes; mist and flood can both be on.
    Coolant,
    /// Group 9 of the M codes.
    Overrides,
    /// Group 10 of the M codes.
    UserDefined,
}

impl ModalGroup {
    /// The rule that refuses two members in one block; groups without one have no member that the model executes.
    pub fn rule(self) -> Option<&'static str> {
        Some(match self {
            Self::NonModal | Self::LocalOffset => "modal-groups.non-modal-group",
            Self::Motion => "modal-groups.motion-group",
            Self::Plane => "modal-groups.plane-group",
            Self::Distance => "modal-groups.distance-group",
            Self::ArcDistance => "modal-groups.arc-distance-group",
            Self::FeedMode => "modal-groups.feed-mode-group",
            Self::Units => "modal-groups.units-group",
            Self::Compensation => "modal-groups.compensation-group",
            Self::ToolLength => "modal-groups.tool-length-group",
            Self::Retract => "modal-groups.return-mode-group",
            Self::WorkOffset => "modal-groups.work-offset-group",
            Self::Path => "modal-groups.path-group",
            Self::SpindleMode => "modal-groups.spindle-mode-group",
            Self::Lathe => "modal-groups.lathe-group",
            Self::Stopping => "modal-groups.stopping-group",
            Self::Spindle => "modal-groups.spindle-group",
            Self::Coolant => "modal-groups.coolant-group",
            Self::Overrides => "modal-groups.override-group",
            Self::InputsOutputs => "modal-groups.io-group",
            Self::ToolChange => "modal-groups.tool-change-group",
            Self::UserDefined => "modal-groups.user-defined-group",
        })
    }
}
