//! Each rule of `units-planes`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::UNITS_PLANES;

    /// Under G90 axis words are positions in the active coordinate system.
    ABSOLUTE = "units-planes.absolute",
    /// G90.1 and G91.1 set absolute and incremental arc distance mode.
    ARC_DISTANCE = "units-planes.arc-distance",
    /// The arc distance mode and the distance mode do not influence each other.
    ARC_DISTANCE_APART = "units-planes.arc-distance-apart",
    /// Under G7 an X word is a diameter: X moves half of it.
    DIAMETER = "units-planes.diameter",
    /// Diameter mode halves the X words of moves only, or those of offsets too: the documents speak of moves.
    DIAMETER_OFFSETS = "units-planes.diameter-offsets",
    /// Diameter mode concerns X only.
    DIAMETER_X_ONLY = "units-planes.diameter-x-only",
    /// Changing the distance mode keeps the position.
    DISTANCE_CHANGE = "units-planes.distance-change",
    /// A feed rate outlives a change of the length unit, as the same feed or as the same number.
    FEED_OVER_UNIT_CHANGE = "units-planes.feed-over-unit-change",
    /// Under G91 axis words are increments from the current position.
    INCREMENTAL = "units-planes.incremental",
    /// Linear axis words are read in the length unit that is active.
    MOTION_IN_ACTIVE_UNIT = "units-planes.motion-in-active-unit",
    /// A change of the length unit leaves offsets where they are, expressed in the new unit.
    OFFSETS_OVER_UNIT_CHANGE = "units-planes.offsets-over-unit-change",
    /// G17, G18 and G19 select the XY, ZX and YZ plane, until another is selected.
    PLANE = "units-planes.plane",
    /// Selecting a plane moves nothing and changes no position.
    PLANE_MOVES_NOTHING = "units-planes.plane-moves-nothing",
    /// Whether another plane can be selected while cutter compensation is on is a choice.
    PLANE_UNDER_COMPENSATION = "units-planes.plane-under-compensation",
    /// A change of the length unit moves nothing: the position is the same point, expressed in the new unit.
    POSITION_OVER_UNIT_CHANGE = "units-planes.position-over-unit-change",
    /// Under G8 an X word is the distance from the centre.
    RADIUS = "units-planes.radius",
    /// Rotary axes are in degrees and a change of the length unit does not alter them.
    ROTARY_AXES = "units-planes.rotary-axes",
    /// G17.1, G18.1 and G19.1 select the UV, WU and VW plane.
    SECONDARY_PLANES = "units-planes.secondary-planes",
    /// A change of the length unit leaves the tool offset as long as it was.
    TOOL_OFFSET_OVER_UNIT_CHANGE = "units-planes.tool-offset-over-unit-change",
    /// G20 makes inches and G21 millimetres the length unit, until the other is programmed.
    UNITS = "units-planes.units",
}
