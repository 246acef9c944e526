//! The statements of the table, a chapter each.

pub(super) mod arcs;
pub(super) mod compensation;
pub(super) mod control;
pub(super) mod cycles;
pub(super) mod modes;
pub(super) mod motion;
pub(super) mod offsets;
pub(super) mod outside;
pub(super) mod parameters;
pub(super) mod spindle;
pub(super) mod text;
pub(super) mod tool;
pub(super) mod turning;
