//! Each rule of `arcs`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::ARCS;

    /// In absolute arc distance mode an arc needs both offsets of its plane.
    ABSOLUTE_NEEDS_BOTH = "arcs.absolute-needs-both",
    /// In incremental arc distance mode the offsets lead from the start of the arc to its centre; one that is
    /// left out is zero.
    CENTRE = "arcs.centre",
    /// In absolute arc distance mode the offsets are the coordinates of the centre.
    CENTRE_ABSOLUTE = "arcs.centre-absolute",
    /// In diameter mode the X word of an arc is a diameter, as that of every move.
    DIAMETER = "arcs.diameter",
    /// Whether the offset I of an arc is a diameter in diameter mode is a choice.
    DIAMETER_CENTRE = "arcs.diameter-centre",
    /// G2 goes clockwise and G3 counterclockwise, seen from the positive end of the axis normal to the plane,
    /// at the feed rate.
    DIRECTION = "arcs.direction",
    /// Where one bound holds for arcs of every radius, an arc is refused when its radii at the start and at
    /// the end differ by more than 0.002 mm or 0.0002 inch.
    EQUAL_RADII = "arcs.equal-radii",
    /// Without axis words, or with an end point that is the current point, an arc with a centre is a full
    /// circle.
    FULL_CIRCLE = "arcs.full-circle",
    /// A word of the axis normal to the plane makes the arc a helix: that axis goes to its value meanwhile.
    HELIX = "arcs.helix",
    /// While G2 or G3 is in force, a block with axis words is an arc without the code.
    MODE_HOLDS = "arcs.mode-holds",
    /// An arc while no feed rate has been set is refused.
    NEEDS_FEED_RATE = "arcs.needs-feed-rate",
    /// An arc without an offset of its centre and without a radius is refused.
    NEEDS_OFFSETS = "arcs.needs-offsets",
    /// Whether offsets of a centre without axis words are an arc while G2 or G3 is in force is a choice.
    OFFSETS_ALONE = "arcs.offsets-alone",
    /// An arc with a radius and an offset of its centre is refused.
    ONE_FORMAT = "arcs.one-format",
    /// An offset of the centre along the axis normal to the plane is refused.
    OTHER_OFFSET = "arcs.other-offset",
    /// An arc lies in the selected plane: I and J are its offsets in XY, I and K in ZX, J and K in YZ.
    PLANE = "arcs.plane",
    /// In radius format the arc has the radius R and goes through the current point and the end point.
    RADIUS = "arcs.radius",
    /// Whether a radius that is too small by a rounding makes half a circle is a choice.
    RADIUS_JUST_TOO_SMALL = "arcs.radius-just-too-small",
    /// An arc with a radius and without a word of an axis of the selected plane is refused.
    RADIUS_NEEDS_AXIS = "arcs.radius-needs-axis",
    /// An arc with a radius whose end point is the current point is refused.
    RADIUS_SAME_POINT = "arcs.radius-same-point",
    /// A positive radius makes an arc of less than half a circle, a negative one an arc of more.
    RADIUS_SIGN = "arcs.radius-sign",
    /// An arc with a radius of less than half the distance to its end point is refused.
    RADIUS_TOO_SMALL = "arcs.radius-too-small",
    /// Rotary axes in the block of an arc turn to their values meanwhile.
    ROTARY_AXES = "arcs.rotary-axes",
    /// An arc while one of the planes of U, V and W is selected is refused.
    SECONDARY_PLANES = "arcs.secondary-planes",
    /// P is the number of turns of an arc, the begun one too; without P it is one.
    TURNS = "arcs.turns",
    /// Whether an arc with fewer than one turn is refused is a choice.
    TURNS_BELOW_ONE = "arcs.turns-below-one",
    /// P of an arc must be an integer.
    TURNS_INTEGER = "arcs.turns-integer",
    /// An arc is refused when its radius at the end is not that at the start: by more than 0.5 mm or 0.05
    /// inch, or by more than a thousandth of the radius and a small bound; which bounds hold is a choice.
    UNEQUAL_RADII = "arcs.unequal-radii",
    /// Whether an arc with offsets of its centre and without a word of an axis of its plane is refused is a
    /// choice.
    WITHOUT_AXIS_WORDS = "arcs.without-axis-words",
    /// Whether an arc about its own point is refused is a choice.
    ZERO_RADIUS = "arcs.zero-radius",
}
