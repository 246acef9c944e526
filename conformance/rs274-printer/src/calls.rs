//! The canonical calls, each in the form in which it is printed.

use gaugeblock_vocabulary::{
    Channel, Compensation, Distance, FeedMode, Lathe, LengthUnit, PathControlMode, Plane, Position,
    ReturnMode, SpindleLimit, SpindleMode, SpindleTurn, Switch,
};

use super::modes::{Modes, Spindle};
use super::output::Output;
use super::plane::in_plane;

/// What stands for no limit of a spindle's speed.
const NO_LIMIT: f64 = 1.0e30;

impl Output {
    /// A call without arguments.
    pub(super) fn call(&mut self, name: &str) {
        self.begin(name).text("()").end();
    }

    /// A call that has an integer, such as a spindle's number.
    pub(super) fn call_of(&mut self, name: &str, number: impl Into<i64>) {
        self.begin(name).text("(").integer(number.into()).text(")").end();
    }

    /// A call that has a number with four decimals.
    pub(super) fn call_with(&mut self, name: &str, number: f64) {
        self.begin(name).text("(").number(number).text(")").end();
    }

    /// A call that has a position, X to C.
    pub(super) fn call_to(&mut self, name: &str, end: &Position) {
        let Position { x, y, z, a, b, c, .. } = *end;
        self.begin(name).text("(").numbers(&[x, y, z, a, b, c], ", ").text(")").end();
    }

    /// A comment of the program.
    pub(super) fn comment(&mut self, text: &[u8]) {
        self.begin("COMMENT(\"").bytes(text).text("\")").end();
    }

    /// What the interpreter remarks.
    pub(super) fn note(&mut self, text: &str) {
        self.begin("COMMENT(\"interpreter: ").text(text).text("\")").end();
    }

    /// A message of the program.
    pub(super) fn message(&mut self, channel: Channel, text: &str) {
        match channel {
            Channel::Print => self.text(text).end(),
            Channel::Log => self.begin("LOG(\"").text(text).text("\")").end(),
            Channel::Display | Channel::Output => {
                self.begin("MESSAGE(\"").text(text).text("\")").end();
            }
        }
    }

    pub(super) fn units(&mut self, unit: LengthUnit) {
        self.begin(match unit {
            LengthUnit::Inch => "USE_LENGTH_UNITS(CANON_UNITS_INCHES)",
            LengthUnit::Millimetre => "USE_LENGTH_UNITS(CANON_UNITS_MM)",
        });
        self.end();
    }

    pub(super) fn plane(&mut self, plane: Plane) {
        self.begin(match plane {
            Plane::Xy => "SELECT_PLANE(CANON_PLANE_XY)",
            Plane::Yz => "SELECT_PLANE(CANON_PLANE_YZ)",
            Plane::Zx => "SELECT_PLANE(CANON_PLANE_XZ)",
            Plane::Uv | Plane::Wu | Plane::Vw => "SELECT_PLANE(CANON_PLANE_UNKNOWN)",
        });
        self.end();
    }

    pub(super) fn lathe(&mut self, lathe: Lathe) {
        self.note(match lathe {
            Lathe::Diameter => "Lathe diameter mode changed to diameter",
            Lathe::Radius => "Lathe diameter mode changed to radius",
        });
    }

    /// An arc.
    pub(super) fn arc(&mut self, plane: Plane, end: &Position, centre: [f64; 2], turns: i32) {
        let ([first, second], axis) = in_plane(plane, end);
        let [first_centre, second_centre] = centre;
        let begun = self.begin("ARC_FEED(");
        begun.numbers(&[first, second, first_centre, second_centre], ", ").text(", ");
        begun.integer(turns.into()).text(", ");
        begun.numbers(&[axis, end.a, end.b, end.c], ", ").text(")").end();
    }

    pub(super) fn compensation(&mut self, compensation: Compensation) {
        self.note(match compensation {
            Compensation::Off => "cutter radius compensation off",
            Compensation::Left | Compensation::DynamicLeft => "cutter radius compensation on left",
            Compensation::Right | Compensation::DynamicRight => {
                "cutter radius compensation on right"
            }
        });
    }

    pub(super) fn distance(&mut self, distance: Distance) {
        self.note(match distance {
            Distance::Absolute => "distance mode changed to absolute",
            Distance::Incremental => "distance mode changed to incremental",
        });
    }

    pub(super) fn arc_distance(&mut self, distance: Distance) {
        self.note(match distance {
            Distance::Absolute => "IJK distance mode changed to absolute",
            Distance::Incremental => "IJK distance mode changed to incremental",
        });
    }

    pub(super) fn retract(&mut self, retract: ReturnMode) {
        self.note(match retract {
            ReturnMode::OldZ => "retract mode set to old_z",
            ReturnMode::RPlane => "retract mode set to r_plane",
        });
    }

    /// A feed mode. It takes the feed rate away, unless it is inverse time.
    pub(super) fn feed_mode(&mut self, mode: FeedMode, spindle: i64) {
        let (note, number) = match mode {
            FeedMode::InverseTime => ("feed mode set to inverse time", 0),
            FeedMode::PerMinute => ("feed mode set to units per minute", 0),
            FeedMode::PerRevolution => ("feed mode set to units per revolution", 1),
        };
        self.note(note);
        self.begin("SET_FEED_MODE(").integer(spindle).text(", ").integer(number).text(")").end();
        if mode != FeedMode::InverseTime {
            self.call_with("SET_FEED_RATE", 0.0);
        }
    }

    pub(super) fn path_mode(&mut self, modes: &Modes) {
        match modes.path {
            PathControlMode::ExactPath => self.begin("SET_MOTION_CONTROL_MODE(CANON_EXACT_PATH)"),
            PathControlMode::ExactStop => self.begin("SET_MOTION_CONTROL_MODE(CANON_EXACT_STOP)"),
            PathControlMode::Continuous => {
                let begun = self.begin("SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, ");
                begun.six(modes.blend_tolerance).text(")")
            }
        };
        self.end();
    }

    pub(super) fn naive_cam_tolerance(&mut self, modes: &Modes) {
        self.call_with("SET_NAIVECAM_TOLERANCE", modes.naive_cam_tolerance);
    }

    pub(super) fn g5x_offset(&mut self, modes: &Modes) {
        let Position { x, y, z, a, b, c, .. } = modes.g5x_offset;
        let begun = self.begin("SET_G5X_OFFSET(").integer(modes.work_offset.into()).text(", ");
        begun.numbers(&[x, y, z, a, b, c], ", ").text(")").end();
    }

    pub(super) fn g92_offset(&mut self, modes: &Modes) {
        self.call_to("SET_G92_OFFSET", &modes.g92_offset);
    }

    pub(super) fn rotation(&mut self, modes: &Modes) {
        self.call_with("SET_XY_ROTATION", modes.rotation);
    }

    pub(super) fn tool_offset(&mut self, offset: &Position) {
        let Position { x, y, z, a, b, c, u, v, w } = *offset;
        let begun = self.begin("USE_TOOL_LENGTH_OFFSET(").numbers(&[x, y, z], " ").text(", ");
        begun.numbers(&[a, b, c], " ").text(", ").numbers(&[u, v, w], " ").text(")").end();
    }

    pub(super) fn spindle_speed(&mut self, number: i64, speed: f64) {
        let begun = self.begin("SET_SPINDLE_SPEED(").integer(number).text(", ");
        begun.number(speed).text(")").end();
    }

    /// What S means: a limit stands for constant surface speed, zero for revolutions.
    pub(super) fn spindle_mode(&mut self, number: i64, spindle: &Spindle) {
        let limit = match (spindle.mode, spindle.limit) {
            (SpindleMode::Rpm, _) => 0.0,
            (SpindleMode::SurfaceSpeed, SpindleLimit::None) => NO_LIMIT,
            (SpindleMode::SurfaceSpeed, SpindleLimit::Rpm(limit)) => limit,
        };
        let begun = self.begin("SET_SPINDLE_MODE(").integer(number).text(" ");
        begun.number(limit).text(")").end();
    }

    pub(super) fn turn(&mut self, number: i64, turn: SpindleTurn) {
        let name = match turn {
            SpindleTurn::Clockwise => "START_SPINDLE_CLOCKWISE",
            SpindleTurn::Counterclockwise => "START_SPINDLE_COUNTERCLOCKWISE",
            SpindleTurn::Stopped | SpindleTurn::Oriented => "STOP_SPINDLE_TURNING",
        };
        self.call_of(name, number);
    }

    pub(super) fn mist(&mut self, switch: Switch) {
        self.call(if switch == Switch::On { "MIST_ON" } else { "MIST_OFF" });
    }

    pub(super) fn flood(&mut self, switch: Switch) {
        self.call(if switch == Switch::On { "FLOOD_ON" } else { "FLOOD_OFF" });
    }

    pub(super) fn feed_override(&mut self, switch: Switch) {
        let on = switch == Switch::On;
        self.call(if on { "ENABLE_FEED_OVERRIDE" } else { "DISABLE_FEED_OVERRIDE" });
    }

    pub(super) fn speed_override(&mut self, number: i64, switch: Switch) {
        let on = switch == Switch::On;
        let name = if on { "ENABLE_SPEED_OVERRIDE" } else { "DISABLE_SPEED_OVERRIDE" };
        self.call_of(name, number);
    }

    pub(super) fn adaptive_feed(&mut self, switch: Switch) {
        let on = switch == Switch::On;
        self.call(if on { "ENABLE_ADAPTIVE_FEED" } else { "DISABLE_ADAPTIVE_FEED" });
    }

    pub(super) fn feed_stop(&mut self, switch: Switch) {
        let on = switch == Switch::On;
        self.call(if on { "ENABLE_FEED_HOLD" } else { "DISABLE_FEED_HOLD" });
    }

    /// The beginning of feed that follows a spindle.
    pub(super) fn synchronised(&mut self, pitch: f64) {
        self.begin("START_SPEED_FEED_SYNC(").six(pitch).text(",0)").end();
    }
}
