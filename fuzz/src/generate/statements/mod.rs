//! The rows of the table, a chapter each.

pub(super) mod control;
pub(super) mod later;
pub(super) mod modes;
pub(super) mod motion;
pub(super) mod outside;
pub(super) mod parameters;
pub(super) mod spindle;
pub(super) mod text;
pub(super) mod tool;
