//! Which reading of the documents the laws hold to, where these leave something open.

/// The choices that laws depend on, each with its options; the first one is the default. The suite has a page for each.
pub const CHOICES: &[(&str, &[&str])] = &[
    ("trajectory.motion-start", &["corner", "blend-end"]),
    ("trajectory.tolerance-at-change", &["larger", "before", "after"]),
];

/// Where a motion starts, at a corner that is rounded: what its outputs wait for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MotionStart {
    /// At the sample that is nearest to the corner.
    #[default]
    Corner,
    /// Where the blend has ended and the motion's own path begins.
    BlendEnd,
}

/// Which P holds at a corner where it changes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToleranceAtChange {
    /// The larger one: what no reading allows is not allowed.
    #[default]
    Larger,
    /// That of the element which ends there.
    Before,
    /// That of the element which starts there.
    After,
}

/// An option of each choice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Choices {
    /// `trajectory.motion-start`.
    pub motion_start: MotionStart,
    /// `trajectory.tolerance-at-change`.
    pub tolerance_at_change: ToleranceAtChange,
}

impl Choices {
    /// Reads options by the ids of their choices; what is not listed has its default.
    ///
    /// # Errors
    /// A choice or an option that there is not, as a sentence.
    pub fn new<'a>(options: impl IntoIterator<Item = (&'a str, &'a str)>) -> Result<Self, String> {
        let mut choices = Self::default();
        for (id, option) in options {
            match (id, option) {
                ("trajectory.motion-start", "corner") => {
                    choices.motion_start = MotionStart::Corner;
                }
                ("trajectory.motion-start", "blend-end") => {
                    choices.motion_start = MotionStart::BlendEnd;
                }
                ("trajectory.tolerance-at-change", "larger") => {
                    choices.tolerance_at_change = ToleranceAtChange::Larger;
                }
                ("trajectory.tolerance-at-change", "before") => {
                    choices.tolerance_at_change = ToleranceAtChange::Before;
                }
                ("trajectory.tolerance-at-change", "after") => {
                    choices.tolerance_at_change = ToleranceAtChange::After;
                }
                _ => return Err(format!("no law depends on {id} = {option}")),
            }
        }
        Ok(choices)
    }
}
