//! Each rule of `turning`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::TURNING;

    /// After the last pass of G70 the tool stays at the end of the profile, with E.
    FINISHING_END = "turning.finishing-end",
    /// G70 is refused if the profile is monotonic in neither Z nor X.
    FINISHING_MONOTONIC = "turning.finishing-monotonic",
    /// The distance of a pass of G70 from the profile is (pass - 1)(D - E)/P + E, from the greatest pass down
    /// to the first.
    FINISHING_PASSES = "turning.finishing-passes",
    /// Each pass of G70 traverses to the start of the profile and follows it at feed rate; between passes it
    /// traverses to the position before the first.
    FINISHING_PATH = "turning.finishing-path",
    /// A positive distance of G70 is towards the position before the cycle.
    FINISHING_SIDE = "turning.finishing-side",
    /// With X or Z a lathe cycle begins with a traverse to them; a missing word keeps its axis.
    FIRST_TRAVERSE = "turning.first-traverse",
    /// A lathe cycle is refused in another plane than ZX.
    PLANE = "turning.plane",
    /// C in a block of a profile inserts the chord of a fillet with this radius.
    PROFILE_CHAMFER = "turning.profile-chamfer",
    /// In absolute distance mode U and W of a profile are displacements along X and Z.
    PROFILE_DISPLACEMENTS = "turning.profile-displacements",
    /// A in a block of a profile inserts a fillet with this radius at the end of its move; one that is too
    /// large is refused.
    PROFILE_FILLET = "turning.profile-fillet",
    /// All other codes of a profile are ignored.
    PROFILE_IGNORED = "turning.profile-ignored",
    /// The moves of a profile are the blocks with G0, G1, G2 and G3; G0 counts as G1.
    PROFILE_MOVES = "turning.profile-moves",
    /// A lathe cycle without Q is refused.
    PROFILE_NEEDED = "turning.profile-needed",
    /// Q of a lathe cycle is an integer.
    PROFILE_NUMBER = "turning.profile-number",
    /// A lathe cycle cuts the profile of the subroutine with the number Q, which runs as a call without
    /// arguments runs.
    PROFILE_SUBROUTINE = "turning.profile-subroutine",
    /// A lathe cycle whose subroutine is not defined is refused.
    PROFILE_UNKNOWN = "turning.profile-unknown",
    /// G71 removes layers along Z and G72 along X, in the direction of the profile.
    ROUGHING_DIRECTION = "turning.roughing-direction",
    /// D keeps a distance from the profile.
    ROUGHING_DISTANCE = "turning.roughing-distance",
    /// The tool stops at the end of the profile, with D.
    ROUGHING_END = "turning.roughing-end",
    /// I is the distance between two layers, 1 without it; zero and less are refused.
    ROUGHING_INCREMENT = "turning.roughing-increment",
    /// G71 is refused if the profile is not monotonic in Z, and G72 if it is not monotonic in X.
    ROUGHING_MONOTONIC = "turning.roughing-monotonic",
    /// G71.2 and G72.2 cut after the first pocket, where G71.1 and G72.1 stop.
    ROUGHING_POCKETS = "turning.roughing-pockets",
    /// R is the distance by which the tool retracts after a layer, 0.5 without it.
    ROUGHING_RETRACT = "turning.roughing-retract",
    /// G71 and G72 cut the whole profile, with its pockets.
    ROUGHING_WHOLE = "turning.roughing-whole",
    /// G71.1 and G72.1 do not cut pockets.
    ROUGHING_WITHOUT_POCKETS = "turning.roughing-without-pockets",
    /// G71, G72 and their variants are refused while cutter compensation is on.
    UNDER_COMPENSATION = "turning.under-compensation",
}
