//! The table: every kind of statement, whether it is possible here, and how it is written.

use super::state::State;
use super::statements;
use super::writer::Writer;

/// A kind of statement. A program uses some kinds and leaves others out.
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
    /// Comments, blank lines, odd ones.
    Text,
    /// Several codes in one block.
    Crowded,
    /// Arcs.
    Arc,
    /// Canned cycles.
    Cycle,
    /// Probing.
    Probe,
    /// Moves under cutter compensation.
    Compensation,
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
        Self::Predefined,
        Self::ToolTable,
        Self::Synchronised,
        Self::Spline,
        Self::Polar,
    ];

    /// Whether the model still ends most of this as unsupported: only some programs use it. To enable a kind, take it
    /// out here.
    pub fn is_later(self) -> bool {
        matches!(
            self,
            Self::Arc | Self::Cycle | Self::Probe | Self::Compensation | Self::Predefined
        ) || matches!(self, Self::AxisOffset | Self::ToolTable | Self::Synchronised)
            || matches!(self, Self::Spline | Self::Polar)
    }

    /// Whether its rows have bodies.
    pub(crate) fn nests(self) -> bool {
        matches!(self, Self::Control | Self::Sub | Self::Numbered)
    }
}

/// A row of the table.
#[derive(Debug)]
pub struct Statement {
    /// Its name, by which single-rule programs are asked for.
    pub name: &'static str,
    /// Its kind.
    pub kind: StatementKind,
    /// How often it is chosen, relative to the others.
    pub weight: u32,
    /// Whether it is possible here without being refused.
    pub(crate) possible: fn(&State) -> bool,
    /// Writes it and tells the state.
    pub(crate) write: fn(&mut Writer<'_, '_>),
}

impl Statement {
    /// A row that is possible anywhere.
    pub(crate) const fn any(
        name: &'static str,
        kind: StatementKind,
        weight: u32,
        write: fn(&mut Writer<'_, '_>),
    ) -> Self {
        Self { name, kind, weight, possible: |_| true, write }
    }

    /// A row that is possible at some places.
    pub(crate) const fn when(
        name: &'static str,
        kind: StatementKind,
        weight: u32,
        possible: fn(&State) -> bool,
        write: fn(&mut Writer<'_, '_>),
    ) -> Self {
        Self { name, kind, weight, possible, write }
    }
}

/// All rows, by chapter.
pub const TABLE: &[&[Statement]] = &[
    statements::motion::STATEMENTS,
    statements::modes::STATEMENTS,
    statements::spindle::STATEMENTS,
    statements::tool::STATEMENTS,
    statements::outside::STATEMENTS,
    statements::parameters::STATEMENTS,
    statements::control::STATEMENTS,
    statements::text::STATEMENTS,
    statements::later::STATEMENTS,
];
