//! The predefined named parameters that report modes (11.4.3.4, 11.4.3.5).

use gaugeblock_vocabulary::{
    Axis, Compensation, Distance, FeedMode, Lathe, LengthUnit, Plane, ReturnMode, SpindleMode,
    SpindleTurn, Switch,
};

use crate::faults::{PlantedFault, planted};
use crate::parameters::Predefined;

use super::Modal;
use super::coordinates::Coordinates;
use super::modes::Modes;
use super::motion_codes::code_of;
use super::state::NO_TOOL;

/// 1 or 0.
fn flag(set: bool) -> f64 {
    f64::from(u8::from(set))
}

impl Modal {
    /// The value of a predefined parameter.
    pub(crate) fn predefined(&self, name: Predefined) -> f64 {
        let now = self.active.now();
        let [spindle, ..] = &now.spindles;
        match name {
            Predefined::MotionMode => f64::from(code_of(self.motion)),
            Predefined::Plane => plane_value(now.plane),
            Predefined::Compensation => compensation_value(now.compensation),
            Predefined::Metric if planted(PlantedFault::MetricInverted) => {
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
            Predefined::SpindleClockwise if planted(PlantedFault::ClockwiseInverted) => {
                flag(spindle.turn == SpindleTurn::Counterclockwise)
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
            Predefined::Position(Axis::X)
                if now.lathe == Lathe::Diameter && planted(PlantedFault::PositionDiameter) =>
            {
                self.position.coordinate_of(Axis::X) * 2.0
            }
            Predefined::Position(axis) => self.position.coordinate_of(axis),
            Predefined::MachinePosition(axis) if planted(PlantedFault::AbsoluteWithTool) => {
                let without = Modes { tool_offset: Coordinates::default(), ..*now };
                without.machine_of(self.position).coordinate_of(axis)
            }
            Predefined::MachinePosition(axis) => now.machine_of(self.position).coordinate_of(axis),
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
        (self.active.now().retract == ReturnMode::OldZ) != self.choices.retract_names_as_written
    }

    /// Whether a name of the lathe modes is 1.
    fn names_lathe(&self, mode: Lathe) -> bool {
        !self.choices.lathe_flags_zero && self.active.now().lathe == mode
    }

    /// Whether a name of the overrides is 1: the list gives each the other one's code.
    fn names_override(&self, speed: bool) -> bool {
        let now = self.active.now();
        let [spindle, ..] = &now.spindles;
        let switch = if speed == self.choices.override_names_as_written {
            now.feed_override
        } else {
            spindle.speed_override
        };
        switch == Switch::On
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
