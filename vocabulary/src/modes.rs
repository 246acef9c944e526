//! The words for modes: one closed list per modal group, in the field's English, with the code in its doc.

use crate::words::words;

words! {
    /// Length unit of program coordinates and feeds (group 6).
    pub enum LengthUnit {
        /// G20.
        Inch = "inch",
        /// G21.
        Millimetre = "mm",
    }
}
words! {
    /// Motion mode (group 1).
    pub enum Motion {
        /// G0.
        Traverse = "traverse",
        /// G1.
        Feed = "feed",
        /// G2.
        ArcClockwise = "arc_cw",
        /// G3.
        ArcCounterclockwise = "arc_ccw",
        /// G5.
        CubicSpline = "cubic_spline",
        /// G5.1.
        QuadraticSpline = "quadratic_spline",
        /// G5.2.
        Nurbs = "nurbs",
        /// G33.
        SpindleSynchronised = "spindle_synchronised",
        /// G33.1.
        RigidTap = "rigid_tap",
        /// G38.2.
        ProbeTowardError = "probe_toward_error",
        /// G38.3.
        ProbeToward = "probe_toward",
        /// G38.4.
        ProbeAwayError = "probe_away_error",
        /// G38.5.
        ProbeAway = "probe_away",
        /// G73.
        Cycle73 = "cycle_73",
        /// G74.
        Cycle74 = "cycle_74",
        /// G76.
        Thread76 = "thread_76",
        /// G80: no motion mode.
        None = "none",
        /// G81.
        Cycle81 = "cycle_81",
        /// G82.
        Cycle82 = "cycle_82",
        /// G83.
        Cycle83 = "cycle_83",
        /// G84.
        Cycle84 = "cycle_84",
        /// G85.
        Cycle85 = "cycle_85",
        /// G86.
        Cycle86 = "cycle_86",
        /// G87.
        Cycle87 = "cycle_87",
        /// G88.
        Cycle88 = "cycle_88",
        /// G89.
        Cycle89 = "cycle_89",
    }
}
words! {
    /// Selected plane (group 2).
    pub enum Plane {
        /// G17.
        Xy = "xy",
        /// G18.
        Zx = "zx",
        /// G19.
        Yz = "yz",
        /// G17.1.
        Uv = "uv",
        /// G18.1.
        Wu = "wu",
        /// G19.1.
        Vw = "vw",
    }
}
words! {
    /// Distance mode of axis words (group 3) and of arc offsets (group 4).
    pub enum Distance {
        /// G90, G90.1.
        Absolute = "absolute",
        /// G91, G91.1.
        Incremental = "incremental",
    }
}
words! {
    /// Feed mode (group 5).
    pub enum FeedMode {
        /// G93: F is the inverse of a time in minutes.
        InverseTime = "inverse_time",
        /// G94: F is length units per minute.
        PerMinute = "per_minute",
        /// G95: F is length units per revolution.
        PerRevolution = "per_revolution",
    }
}
words! {
    /// Cutter compensation (group 7).
    pub enum Compensation {
        /// G40.
        Off = "off",
        /// G41.
        Left = "left",
        /// G42.
        Right = "right",
        /// G41.1.
        DynamicLeft = "dynamic_left",
        /// G42.1.
        DynamicRight = "dynamic_right",
    }
}
words! {
    /// Whether a control, a coolant or a tool length offset is on.
    pub enum Switch {
        /// Off, disabled.
        Off = "off",
        /// On, enabled.
        On = "on",
    }
}
words! {
    /// Where a canned cycle returns to (group 10).
    pub enum ReturnMode {
        /// G98: to where the axis was.
        OldZ = "old_z",
        /// G99: to the R plane.
        RPlane = "r_plane",
    }
}
words! {
    /// Path control mode (group 13).
    pub enum PathControlMode {
        /// G61.
        ExactPath = "exact_path",
        /// G61.1.
        ExactStop = "exact_stop",
        /// G64.
        Continuous = "continuous",
    }
}
words! {
    /// What an S word means (group 14).
    pub enum SpindleMode {
        /// G97: revolutions per minute.
        Rpm = "rpm",
        /// G96: constant surface speed.
        SurfaceSpeed = "surface_speed",
    }
}
words! {
    /// Whether X words on a lathe are diameters (group 15).
    pub enum Lathe {
        /// G7.
        Diameter = "diameter",
        /// G8.
        Radius = "radius",
    }
}
words! {
    /// What a spindle was commanded to do (group 7 of the M codes).
    pub enum SpindleTurn {
        /// M5.
        Stopped = "stopped",
        /// M3.
        Clockwise = "clockwise",
        /// M4.
        Counterclockwise = "counterclockwise",
        /// M19.
        Oriented = "oriented",
    }
}
words! {
    /// Mode of the controller.
    pub enum ControllerMode {
        /// A program runs or can be run.
        Auto = "auto",
        /// Manual data input: single blocks.
        Mdi = "mdi",
        /// Jogging by hand.
        Manual = "manual",
    }
}
