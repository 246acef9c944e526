//! Modal groups: of the members of a group one is in force, and a block holds at most one.

use crate::ids::{Rule, rule};

/// A modal group.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ModalGroup {
    /// Group 0: codes that hold for their own block only.
    NonModal,
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
    pub fn rule(self) -> Option<Rule> {
        Some(match self {
            Self::NonModal => rule::modal_groups::NON_MODAL_GROUP,
            Self::Motion => rule::modal_groups::MOTION_GROUP,
            Self::Plane => rule::modal_groups::PLANE_GROUP,
            Self::Distance => rule::modal_groups::DISTANCE_GROUP,
            Self::ArcDistance => rule::modal_groups::ARC_DISTANCE_GROUP,
            Self::FeedMode => rule::modal_groups::FEED_MODE_GROUP,
            Self::Units => rule::modal_groups::UNITS_GROUP,
            Self::Compensation => rule::modal_groups::COMPENSATION_GROUP,
            Self::ToolLength => rule::modal_groups::TOOL_LENGTH_GROUP,
            Self::Retract => rule::modal_groups::RETURN_MODE_GROUP,
            Self::WorkOffset => rule::modal_groups::WORK_OFFSET_GROUP,
            Self::Path => rule::modal_groups::PATH_GROUP,
            Self::SpindleMode => rule::modal_groups::SPINDLE_MODE_GROUP,
            Self::Lathe => rule::modal_groups::LATHE_GROUP,
            Self::Stopping => rule::modal_groups::STOPPING_GROUP,
            Self::Spindle => rule::modal_groups::SPINDLE_GROUP,
            Self::Coolant => rule::modal_groups::COOLANT_GROUP,
            Self::Overrides => rule::modal_groups::OVERRIDE_GROUP,
            Self::InputsOutputs => rule::modal_groups::IO_GROUP,
            Self::ToolChange => rule::modal_groups::TOOL_CHANGE_GROUP,
            Self::UserDefined => rule::modal_groups::USER_DEFINED_GROUP,
        })
    }
}
