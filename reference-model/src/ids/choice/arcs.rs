//! Each choice of `arcs`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::ARCS;

    /// Whether I of an arc is a diameter in diameter mode: the document says it of moves along X.
    DiameterCentre = "arcs.diameter-centre" {
        /// I is as long as its word says
        Radius = "radius",
        /// half of I is the offset
        Diameter = "diameter",
    }

    /// Whether offsets of a centre without axis words are an arc while G2 or G3 is in force: a motion is
    /// executed again where axis words are on the line, and a full circle has none.
    OffsetsAlone = "arcs.offsets-alone" {
        /// the offset is a word that nothing uses
        Unused = "unused",
        /// a full circle
        Arc = "arc",
    }

    /// What becomes of a radius greater than zero that is less than half the distance by no more than what is
    /// lost when numbers are written, 0.00127 mm or 0.00005 inch. The document has no tolerance for it, and
    /// lists no error.
    RadiusJustTooSmall = "arcs.radius-just-too-small" {
        /// there is no such arc
        Refused = "refused",
        /// the arc is half a circle
        HalfCircle = "half-circle",
    }

    /// How far the radii at start and end of an arc may be apart when that is more than a thousandth of them:
    /// 0.005 mm or 0.0005 inch in the section on arcs, 0.001 mm or 0.0001 inch in the advice. Grbl has 0.005
    /// mm, and 0.5 mm for the greater bound, in inches too. NIST has 0.002 mm or 0.0002 inch whatever the
    /// radius.
    SmallTolerance = "arcs.small-tolerance" {
        /// 0.005 mm or 0.0005 inch
        Coarse = "coarse",
        /// 0.001 mm or 0.0001 inch
        Fine = "fine",
        /// 0.005 mm, and 0.5 mm for the greater bound, whatever the unit
        Millimetres = "millimetres",
        /// 0.002 mm or 0.0002 inch for every arc, whatever its radius
        TwoMicrometres = "two-micrometres",
    }

    /// What an arc with P0 or a negative P is: the document wants an integer, and counts turns from 1.
    TurnsBelowOne = "arcs.turns-below-one" {
        /// there is no such number of turns
        Refused = "refused",
        /// it has one turn
        One = "one",
    }

    /// Whether G2 and G3 with offsets of a centre and without a word of an axis of the plane make a full
    /// circle: LinuxCNC says so, Grbl refuses them.
    WithoutAxisWords = "arcs.without-axis-words" {
        /// a full circle
        FullCircle = "full-circle",
        /// an arc needs a word of an axis of its plane
        Refused = "refused",
    }

    /// Whether an arc whose centre is its start and its end is executed, turning in place; no error is listed
    /// for it.
    ZeroRadius = "arcs.zero-radius" {
        /// there is no circle
        Refused = "refused",
        /// it goes round a circle of no size
        Accepted = "accepted",
    }
}
