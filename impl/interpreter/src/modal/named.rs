//! The predefined named parameters that tell modes (11.4.3.4, 11.4.3.5).

use gaugeblock_vocabulary::{
    Axis, Compensation, Distance, FeedMode, Lathe, LengthUnit, Motion, Plane, ReturnMode,
    SpindleMode, SpindleTurn, Switch,
};

use crate::faults::{Fault, planted};

use super::Modal;
use super::tool::NO_TOOL;

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

/// 1 or 0.
fn flag(set: bool) -> f64 {
    f64::from(u8::from(set))
}

impl Modal {
    /// The value of a predefined parameter.
    pub(crate) fn named(&self, name: Predefined) -> f64 {
        let now = self.in_force.now();
        let [spindle, ..] = &now.spindles;
        match name {
            Predefined::MotionMode => f64::from(code_of(self.motion)),
            Predefined::Plane => plane_value(now.plane),
            Predefined::Compensation => compensation_value(now.compensation),
            Predefined::Metric if planted(Fault::MetricInverted) => {
                flag(now.units == LengthUnit::Inch)
            }
            Predefined::Metric => flag(now.units == LengthUnit::Millimetre),
            Predefined::Imperial => flag(now.units == LengthUnit::Inch),
            Predefined::Absolute => flag(now.distance == Distance::Absolute),
            Predefined::Incremental => flag(now.distance == Distance::Incremental),
            Predefined::InverseTime => flag(now.feed_mode == FeedMode::InverseTime),
            Predefined::UnitsPerMinute => flag(now.feed_mode == FeedMode::PerMinute),
            Predefined::UnitsPerRevolution => flag(now.feed_mode == FeedMode::PerRevolution),
            Predefined::CoordinateSystem => system_value(now.work_offset),
            Predefined::ToolOffset => flag(now.tool_length == Switch::On),
            Predefined::RetractOldZ => flag(self.names_old_z()),
            Predefined::RetractRPlane => flag(!self.names_old_z()),
            Predefined::SpindleRpmMode => flag(spindle.mode == SpindleMode::Rpm),
            Predefined::SpindleSurfaceSpeedMode => flag(spindle.mode == SpindleMode::SurfaceSpeed),
            Predefined::ArcAbsolute => flag(now.arc_distance == Distance::Absolute),
            Predefined::LatheDiameter => flag(self.names_lathe(Lathe::Diameter)),
            Predefined::LatheRadius => flag(self.names_lathe(Lathe::Radius)),
            Predefined::SpindleOn => {
                flag(spindle.turns() && (spindle.speed > 0.0 || !self.choices.spindle_on_turning))
            }
            Predefined::SpindleClockwise => flag(spindle.turn == SpindleTurn::Clockwise),
            Predefined::Mist => flag(now.mist == Switch::On),
            Predefined::Flood => flag(now.flood == Switch::On),
            Predefined::SpeedOverride => flag(self.names_override(true)),
            Predefined::FeedOverride => flag(self.names_override(false)),
            Predefined::AdaptiveFeed => flag(now.adaptive_feed == Switch::On),
            Predefined::FeedHold => flag(now.feed_stop == Switch::On),
            Predefined::Feed => now.feed_rate,
            Predefined::Rpm => spindle.speed,
            Predefined::Position(axis) => self.position.of_axis(axis),
            Predefined::MachinePosition(axis) => now.machine_of(self.position).of_axis(axis),
            Predefined::CurrentTool => f64::from(self.tool),
            Predefined::CurrentPocket => f64::from(self.tool_index(self.tool)),
            Predefined::SelectedTool => {
                f64::from(self.selected.map_or(NO_TOOL, |tool| tool.max(0)))
            }
            Predefined::SelectedPocket => {
                f64::from(self.prepared.map_or(-1, |tool| self.tool_index(tool)))
            }
        }
    }

    /// Whether the name of the old Z is 1: the table gives it the code of the R plane, or it is called after it.
    fn names_old_z(&self) -> bool {
        (self.in_force.now().retract == ReturnMode::OldZ) != self.choices.retract_names_as_written
    }

    /// Whether a name of the lathe modes is 1.
    fn names_lathe(&self, mode: Lathe) -> bool {
        !self.choices.lathe_flags_zero && self.in_force.now().lathe == mode
    }

    /// Whether a name of the overrides is 1: the list gives each the other one's code.
    fn names_override(&self, speed: bool) -> bool {
        let now = self.in_force.now();
        let [spindle, ..] = &now.spindles;
        let switch = if speed == self.choices.override_names_as_written {
            now.feed_override
        } else {
            spindle.speed_override
        };
        switch == Switch::On
    }
}

/// The code of a motion mode in tenths.
pub(super) fn code_of(motion: Motion) -> u16 {
    match motion {
        Motion::Traverse => 0,
        Motion::Feed => 10,
        Motion::ArcClockwise => 20,
        Motion::ArcCounterclockwise => 30,
        Motion::CubicSpline => 50,
        Motion::QuadraticSpline => 51,
        Motion::Nurbs => 52,
        Motion::SpindleSynchronised => 330,
        Motion::RigidTap => 331,
        Motion::ProbeTowardError => 382,
        Motion::ProbeToward => 383,
        Motion::ProbeAwayError => 384,
        Motion::ProbeAway => 385,
        Motion::Cycle73 => 730,
        Motion::Cycle74 => 740,
        Motion::Thread76 => 760,
        Motion::None => 800,
        Motion::Cycle81 => 810,
        Motion::Cycle82 => 820,
        Motion::Cycle83 => 830,
        Motion::Cycle84 => 840,
        Motion::Cycle85 => 850,
        Motion::Cycle86 => 860,
        Motion::Cycle87 => 870,
        Motion::Cycle88 => 880,
        Motion::Cycle89 => 890,
    }
}

fn plane_value(plane: Plane) -> f64 {
    match plane {
        Plane::Xy => 170.0,
        Plane::Zx => 180.0,
        Plane::Yz => 190.0,
        Plane::Uv => 171.0,
        Plane::Wu => 181.0,
        Plane::Vw => 191.0,
    }
}

fn compensation_value(compensation: Compensation) -> f64 {
    match compensation {
        Compensation::Off => 400.0,
        Compensation::Left => 410.0,
        Compensation::DynamicLeft => 411.0,
        Compensation::Right => 420.0,
        Compensation::DynamicRight => 421.0,
    }
}

fn system_value(system: u32) -> f64 {
    match system {
        1..=6 => f64::from(system) * 10.0 + 530.0,
        _ => f64::from(system) + 584.0,
    }
}
