//! Modes, offsets and the path.

use gaugeblock_adapter::HarnessError;
use gaugeblock_vocabulary::{
    Compensation, Distance, FeedMode, Lathe, LengthUnit, PathControlMode, Plane, Position,
    ReturnMode, Settings,
};

use super::{Call, Canon, Done, Mark, whole};
use crate::instrumentation::state;

impl Canon {
    pub(super) fn setting(&mut self, call: &Call, numbers: &[f64]) -> Done {
        let change = match (call.name.as_str(), numbers) {
            ("USE_LENGTH_UNITS", _) => {
                let unit = unit(call)?;
                let rescaled = self.lengths.use_unit(unit);
                Settings { units: Some(unit), ..rescaled }
            }
            ("SELECT_PLANE", _) => Settings { plane: self.plane(call), ..Settings::default() },
            ("SET_G5X_OFFSET", &[index, x, y, z, a, b, c]) => Settings {
                work_offset: Some(index_number(call, index)?),
                ..self.lengths.g5x(position([x, y, z, a, b, c]))
            },
            ("SET_G92_OFFSET", &[x, y, z, a, b, c]) => {
                self.lengths.g92(position([x, y, z, a, b, c]))
            }
            ("SET_XY_ROTATION", &[angle]) => {
                Settings { rotation: Some(angle), ..Settings::default() }
            }
            ("USE_TOOL_LENGTH_OFFSET", &[x, y, z, a, b, c, u, v, w]) => {
                self.lengths.tool(Position::from([x, y, z, a, b, c, u, v, w]))
            }
            ("SET_MOTION_CONTROL_MODE", _) => self.path(call)?,
            ("SET_NAIVECAM_TOLERANCE", &[tolerance]) => self.lengths.naive_cam(tolerance),
            ("SET_FEED_MODE", &[_, mode]) => feed_mode_call(self.now.feed_mode, mode),
            ("COMMENT", _) => self.comment(call.text()),
            _ => return self.spindle(call, numbers),
        };
        self.set(change);
        Ok(Mark::None)
    }

    /// Comments report modes that no call prints. A comment of the program may say the same; the checkpoint after the
    /// block corrects that.
    fn comment(&mut self, text: &str) -> Settings {
        let none = Settings::default();
        let Some(text) = text.strip_prefix("interpreter: ") else { return none };
        match text {
            "distance mode changed to absolute" => {
                Settings { distance: Some(Distance::Absolute), ..none }
            }
            "distance mode changed to incremental" => {
                Settings { distance: Some(Distance::Incremental), ..none }
            }
            "IJK distance mode changed to absolute" => {
                Settings { arc_distance: Some(Distance::Absolute), ..none }
            }
            "IJK distance mode changed to incremental" => {
                Settings { arc_distance: Some(Distance::Incremental), ..none }
            }
            "feed mode set to inverse time" => {
                self.lengths.feed_is_no_length();
                Settings { feed_mode: Some(FeedMode::InverseTime), ..none }
            }
            "feed mode set to units per minute" => {
                Settings { feed_mode: Some(FeedMode::PerMinute), ..none }
            }
            "feed mode set to units per revolution" => {
                Settings { feed_mode: Some(FeedMode::PerRevolution), ..none }
            }
            "retract mode set to old_z" => Settings { retract: Some(ReturnMode::OldZ), ..none },
            "retract mode set to r_plane" => Settings { retract: Some(ReturnMode::RPlane), ..none },
            "Lathe diameter mode changed to diameter" => {
                Settings { lathe: Some(Lathe::Diameter), ..none }
            }
            "Lathe diameter mode changed to radius" => {
                Settings { lathe: Some(Lathe::Radius), ..none }
            }
            "cutter radius compensation off" => {
                Settings { compensation: Some(Compensation::Off), ..none }
            }
            "cutter radius compensation on left" => self.compensation(Compensation::Left),
            "cutter radius compensation on right" => self.compensation(Compensation::Right),
            _ => none,
        }
    }

    /// Compensation on a side, as the comment names it.
    fn compensation(&self, side: Compensation) -> Settings {
        let compensation = state::compensation(side, self.now.compensation, &self.block);
        Settings { compensation: Some(compensation), ..Settings::default() }
    }

    fn plane(&self, call: &Call) -> Option<Plane> {
        let has = |code: &str| self.block.contains(code);
        match call.arguments.as_str() {
            "CANON_PLANE_XY" => Some(Plane::Xy),
            "CANON_PLANE_XZ" => Some(Plane::Zx),
            "CANON_PLANE_YZ" => Some(Plane::Yz),
            _ if has("g17.1") => Some(Plane::Uv),
            _ if has("g18.1") => Some(Plane::Wu),
            _ if has("g19.1") => Some(Plane::Vw),
            // The checkpoint after the block shows it.
            _ => None,
        }
    }

    fn path(&mut self, call: &Call) -> Result<Settings, HarnessError> {
        let path = |path| Settings { path: Some(path), ..Settings::default() };
        match call.arguments.split(',').next().unwrap_or_default() {
            "CANON_EXACT_PATH" => Ok(path(PathControlMode::ExactPath)),
            "CANON_EXACT_STOP" => Ok(path(PathControlMode::ExactStop)),
            "CANON_CONTINUOUS" => {
                let tolerance = call.numbers().first().copied().unwrap_or(0.0);
                Ok(Settings {
                    path: Some(PathControlMode::Continuous),
                    ..self.lengths.blend(tolerance)
                })
            }
            _ => Err(call.unreadable("path control mode")),
        }
    }
}

fn unit(call: &Call) -> Result<LengthUnit, HarnessError> {
    match call.arguments.as_str() {
        "CANON_UNITS_INCHES" => Ok(LengthUnit::Inch),
        "CANON_UNITS_MM" => Ok(LengthUnit::Millimetre),
        _ => Err(call.unreadable("length unit")),
    }
}

/// The call distinguishes per revolution from the rest; comments distinguish inverse time from per minute.
fn feed_mode_call(now: Option<FeedMode>, mode: f64) -> Settings {
    let feed_mode = if mode > 0.0 { Some(FeedMode::PerRevolution) } else { now };
    Settings { feed_mode, ..Settings::default() }
}

fn position([x, y, z, a, b, c]: [f64; 6]) -> Position {
    Position { x, y, z, a, b, c, ..Position::default() }
}

fn index_number(call: &Call, number: f64) -> Result<u32, HarnessError> {
    u32::try_from(whole(call, number)?).map_err(|_| call.unreadable("index"))
}
