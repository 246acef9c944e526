//! Each rule of `splines`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::SPLINES;

    /// G5 moves along a cubic spline of four control points: I and J lead from the start to the second one, P
    /// and Q from the end to the third one.
    CUBIC = "splines.cubic",
    /// A G5 after another may leave out both I and J: it continues in the direction in which that one ended.
    CUBIC_CONTINUED = "splines.cubic-continued",
    /// Each G5 needs P and Q.
    CUBIC_END_DIRECTION = "splines.cubic-end-direction",
    /// The first G5 of a row needs I and J.
    CUBIC_FIRST_DIRECTION = "splines.cubic-first-direction",
    /// G5 has both I and J, or neither.
    CUBIC_HALF_DIRECTION = "splines.cubic-half-direction",
    /// G5.2 opens a data block in which each X and Y is a control point, and G5.3 closes it: the curve has
    /// the current point and all of these as its control points, and ends at the last one.
    NURBS = "splines.nurbs",
    /// The order of a NURBS without L is 3.
    NURBS_DEFAULT_ORDER = "splines.nurbs-default-order",
    /// The weight of a control point without P is 1.
    NURBS_DEFAULT_WEIGHT = "splines.nurbs-default-weight",
    /// G5.2 with P and without X and Y sets the weight of the current point.
    NURBS_FIRST_WEIGHT = "splines.nurbs-first-weight",
    /// G5 and G5.1 are refused in a plane other than XY.
    PLANE = "splines.plane",
    /// G5.1 moves along a quadratic spline of three control points: I and J lead from the start to the one in
    /// the middle.
    QUADRATIC = "splines.quadratic",
    /// G5.1 is refused when both I and J are left out or zero.
    QUADRATIC_OFFSET = "splines.quadratic-offset",
    /// One of I and J of G5.1 may be left out, and is zero then.
    QUADRATIC_ONE_OFFSET = "splines.quadratic-one-offset",
    /// G5 and G5.1 take no axis other than X and Y.
    XY_ONLY = "splines.xy-only",
}
