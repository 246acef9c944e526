//! What a spline leaves for the next one.

use gaugeblock_vocabulary::Position;

/// A data block between G5.2 and G5.3.
#[derive(Clone, Debug, PartialEq)]
pub struct Nurbs {
    /// The control points that were programmed; the one where it begins is not among them.
    pub(crate) points: Vec<Position>,
    /// L.
    pub(crate) order: u32,
}

/// What the next spline may need of the one before.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// Whether the last motion was a G5, so that the next one may take its direction from it.
    pub continues: bool,
    /// The data block that is open.
    pub open: Option<Nurbs>,
}
