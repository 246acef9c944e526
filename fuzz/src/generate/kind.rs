//! Kinds of statements.

/// A kind of statement. Each program uses some kinds and leaves others out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum StatementKind {
    /// G0, G1, axis words.
    Motion,
    /// Units, planes, distance modes.
    Mode,
    /// F and feed modes.
    Feed,
    /// Spindles.
    Spindle,
    /// Coolant.
    Coolant,
    /// Overrides.
    Override,
    /// Work coordinate systems.
    Offset,
    /// G92 and G52.
    AxisOffset,
    /// Tools.
    Tool,
    /// Outputs and inputs.
    Io,
    /// Path control and dwell.
    Path,
    /// Parameters.
    Parameter,
    /// Branches and loops.
    Control,
    /// Subs.
    Sub,
    /// Numbered programs.
    Numbered,
    /// M70 to M73.
    Saved,
    /// Messages and logs.
    Message,
    /// User-defined codes and stops.
    Outside,
    /// Comments, blank lines, malformed blocks.
    Text,
    /// Several codes in one block.
    Crowded,
    /// Arcs.
    Arc,
    /// Canned cycles.
    Cycle,
    /// Probing.
    Probe,
    /// Cutter compensation that is on while the machine does not move.
    Compensation,
    /// Moves under cutter compensation.
    CompensatedMove,
    /// G28 and G30.
    Predefined,
    /// G10 L1, L10, L11, L20.
    ToolTable,
    /// Spindle-synchronised motion and threads.
    Synchronised,
    /// Splines.
    Spline,
    /// Polar words.
    Polar,
    /// Lathe cycles with a profile.
    Turning,
}

impl StatementKind {
    /// All kinds.
    pub const ALL: &[Self] = &[
        Self::Motion,
        Self::Mode,
        Self::Feed,
        Self::Spindle,
        Self::Coolant,
        Self::Override,
        Self::Offset,
        Self::AxisOffset,
        Self::Tool,
        Self::Io,
        Self::Path,
        Self::Parameter,
        Self::Control,
        Self::Sub,
        Self::Numbered,
        Self::Saved,
        Self::Message,
        Self::Outside,
        Self::Text,
        Self::Crowded,
        Self::Arc,
        Self::Cycle,
        Self::Probe,
        Self::Compensation,
        Self::CompensatedMove,
        Self::Predefined,
        Self::ToolTable,
        Self::Synchronised,
        Self::Spline,
        Self::Polar,
        Self::Turning,
    ];

    /// Whether few programs use it: most of what can follow it is refused.
    pub fn is_rare(self) -> bool {
        matches!(self, Self::CompensatedMove | Self::Turning)
    }

    /// Whether its statements have bodies.
    pub(crate) fn nests(self) -> bool {
        matches!(self, Self::Control | Self::Sub | Self::Numbered)
    }
}
