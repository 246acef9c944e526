//! Each rule of `compensation`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::COMPENSATION;

    /// An arc under compensation keeps its centre, its direction and its turns; its radius differs by that of
    /// the tool.
    ARC = "compensation.arc",
    /// An arc with its centre on the tool's side is refused if its radius is less than the tool's.
    ARC_RADIUS = "compensation.arc-radius",
    /// D of G41.1 and G42.1 is the diameter of the tool in the program's unit; they act as G41 and G42 with
    /// such a tool.
    DYNAMIC_DIAMETER = "compensation.dynamic-diameter",
    /// The first move after G41 or G42 that is longer than the radius leads to the compensated path; it may
    /// be a traverse.
    ENTRY = "compensation.entry",
    /// An arc can be the first move too; its end is on the compensated path.
    ENTRY_ARC = "compensation.entry-arc",
    /// A first move that is shorter than the tool's radius is refused.
    ENTRY_LENGTH = "compensation.entry-length",
    /// After several traverses the tool is at the compensated end of the last one.
    ENTRY_RAPIDS = "compensation.entry-rapids",
    /// After G40, a line longer than the tool's diameter leads from where the tool is to its programmed end.
    EXIT = "compensation.exit",
    /// An arc as the next move after G40 is refused.
    EXIT_ARC = "compensation.exit-arc",
    /// The line after G40 is refused if it is shorter than the tool's diameter.
    EXIT_LENGTH = "compensation.exit-length",
    /// A move is refused if inside corners leave nothing of it: the tool would gouge the part.
    GOUGING = "compensation.gouging",
    /// Compensation holds from move to move, through other codes, until G40 or the program end turns it off.
    HOLDS = "compensation.holds",
    /// Before an inside corner a move stops where its compensated path meets that of the next move.
    INSIDE_CORNER = "compensation.inside-corner",
    /// A line under compensation leads parallel to the programmed one, at the distance of the tool's radius.
    LINE = "compensation.line",
    /// Where a move ends depends on the next move in the plane, also where other codes lie between the two.
    NEXT_MOVE = "compensation.next-move",
    /// L of G41.1 and G42.1 is the orientation of a turning tool: the controlled point is the corner of its
    /// nose on that side, in place of the centre. Without L it is the centre, as with L0 and L9.
    ORIENTATION = "compensation.orientation",
    /// Before an outside corner a move leads to the end of its own compensated path; the tool then goes round
    /// the corner in an arc.
    OUTSIDE_CORNER = "compensation.outside-corner",
    /// In the ZX plane, Z and X are compensated, on the side seen from the positive end of Y.
    PLANE = "compensation.plane",
    /// A program describes the path without the tool: the same program suits tools of other radii.
    PROGRAMMED_PATH = "compensation.programmed-path",
    /// Traverses under compensation are compensated as feed moves are.
    RAPID = "compensation.rapid",
    /// A radius that G10 L1 sets is that of the next G41 and G42 with this tool.
    SET_AT_RUN_TIME = "compensation.set-at-run-time",
    /// G41 leads the centre of the tool to the left of the programmed path and G42 to the right, seen along
    /// the path and from the positive end of the axis normal to the plane.
    SIDE = "compensation.side",
    /// A part of the contour is skipped by moves above it: Z is retracted and lowered again at the next
    /// start.
    SKIPPED = "compensation.skipped",
    /// Where the next move goes on in the same direction, the compensated paths meet at the end of the move.
    TANGENT_CORNER = "compensation.tangent-corner",
    /// Z moves as programmed while the contour is followed in the XY plane.
    THIRD_AXIS = "compensation.third-axis",
    /// D of G41 and G42 is the number of the tool whose radius is used, of any tool of the table.
    TOOL_NUMBER = "compensation.tool-number",
    /// With D0, G41 and G42 use the tool in the spindle where tools keep their places, or zero without a
    /// tool.
    TOOL_NUMBER_ZERO = "compensation.tool-number-zero",
    /// Where tools change places, D0 of G41 and G42 is tool 0 of the tool table, and refused if the table has
    /// none.
    TOOL_NUMBER_ZERO_RANDOM = "compensation.tool-number-zero-random",
    /// Without D, the radius of G41 and G42 is that of the tool in the spindle, from the tool table.
    TOOL_RADIUS = "compensation.tool-radius",
    /// With a radius of zero, moves lead to the programmed points.
    ZERO_RADIUS = "compensation.zero-radius",
}
