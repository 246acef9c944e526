//! The names of the predefined parameters whose values are the modes (11.4.3.4, 11.4.3.5).

use gaugeblock_vocabulary::Axis;

macro_rules! predefined {
    ($($name:literal => $variant:ident $(($axis:ident))?,)*) => {
        impl Predefined {
            /// The name in lower case, without blanks.
            pub(crate) fn from_name(name: &str) -> Option<Self> {
                Some(match name {
                    $($name => Self::$variant $((Axis::$axis))?,)*
                    _ => return None,
                })
            }

            /// Every one with its name.
            #[cfg(test)]
            pub(crate) const ALL: &'static [(&'static str, Self)] =
                &[$(($name, Self::$variant $((Axis::$axis))?)),*];
        }
    };
}

/// A predefined name that the modes answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Predefined {
    MotionMode,
    Plane,
    Compensation,
    Metric,
    Imperial,
    Absolute,
    Incremental,
    InverseTime,
    UnitsPerMinute,
    UnitsPerRevolution,
    CoordinateSystem,
    ToolOffset,
    RetractRPlane,
    RetractOldZ,
    SpindleRpmMode,
    SpindleSurfaceSpeedMode,
    ArcAbsolute,
    LatheDiameter,
    LatheRadius,
    SpindleOn,
    SpindleClockwise,
    Mist,
    Flood,
    SpeedOverride,
    FeedOverride,
    AdaptiveFeed,
    FeedHold,
    Feed,
    Rpm,
    /// Program coordinates.
    Position(Axis),
    /// Machine coordinates.
    MachinePosition(Axis),
    CurrentTool,
    CurrentPocket,
    SelectedTool,
    SelectedPocket,
}

predefined! {
    "_motion_mode" => MotionMode, "_plane" => Plane, "_ccomp" => Compensation, "_metric" => Metric,
    "_imperial" => Imperial, "_absolute" => Absolute, "_incremental" => Incremental,
    "_inverse_time" => InverseTime, "_units_per_minute" => UnitsPerMinute,
    "_units_per_rev" => UnitsPerRevolution, "_coord_system" => CoordinateSystem,
    "_tool_offset" => ToolOffset, "_retract_r_plane" => RetractRPlane,
    "_retract_old_z" => RetractOldZ, "_spindle_rpm_mode" => SpindleRpmMode,
    "_spindle_css_mode" => SpindleSurfaceSpeedMode, "_ijk_absolute_mode" => ArcAbsolute,
    "_lathe_diameter_mode" => LatheDiameter, "_lathe_radius_mode" => LatheRadius,
    "_spindle_on" => SpindleOn, "_spindle_cw" => SpindleClockwise, "_mist" => Mist,
    "_flood" => Flood, "_speed_override" => SpeedOverride, "_feed_override" => FeedOverride,
    "_adaptive_feed" => AdaptiveFeed, "_feed_hold" => FeedHold, "_feed" => Feed, "_rpm" => Rpm,
    "_x" => Position(X), "_y" => Position(Y), "_z" => Position(Z), "_a" => Position(A),
    "_b" => Position(B), "_c" => Position(C), "_u" => Position(U), "_v" => Position(V),
    "_w" => Position(W), "_abs_x" => MachinePosition(X), "_abs_y" => MachinePosition(Y),
    "_abs_z" => MachinePosition(Z), "_abs_a" => MachinePosition(A),
    "_abs_b" => MachinePosition(B), "_abs_c" => MachinePosition(C),
    "_current_tool" => CurrentTool, "_current_pocket" => CurrentPocket,
    "_selected_tool" => SelectedTool, "_selected_pocket" => SelectedPocket,
}
