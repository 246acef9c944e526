//! How far the motion is from a corner that G64 P lets it round, from recorded servo samples.

use std::collections::BTreeMap;

use gaugeblock_adapter::{Adapter, MotionRequest, NoSamples};
use gaugeblock_vocabulary::motion::{MotionLimits, MotionScript};
use gaugeblock_vocabulary::scenario::AxisLimits;
use gaugeblock_vocabulary::{Axis, Options, Position};

use super::bench::Bench;
use super::measurement::{Measured, Measurement};

/// P of G64, millimetres.
pub(super) const TOLERANCES: &[f64] = &[0.01, 0.1, 1.0];

/// The name of a measurement.
pub(super) fn id(tolerance: f64) -> String {
    format!("blend-{tolerance}")
}

/// Measures a square corner of two moves of 20 mm at F3000.
pub(super) fn deviation(
    tolerance: f64,
    controller: &dyn Adapter,
    options: &Options,
) -> Measurement {
    let bench = Bench::new(controller, options);
    let program = format!("g21 g90 g94 g64 p{tolerance} f3000\ng1 x20\ng1 y20\nm2\n");
    let limit = AxisLimits {
        minimum: None,
        maximum: None,
        velocity: Some(100.0),
        acceleration: Some(1000.0),
        jerk: None,
    };
    let axes: BTreeMap<_, _> = [Axis::X, Axis::Y, Axis::Z].map(|axis| (axis, limit)).into();
    let limits = MotionLimits { period: 0.001, axes };
    let scenario = bench.scenario(&program);
    let request = MotionRequest {
        scenario: &scenario,
        limits: &limits,
        script: &MotionScript::default(),
        feed_interval: None,
    };
    let measured = match controller.record_motion(&request) {
        Ok(samples) if samples.is_empty() => Measured::Nothing("no sample".to_owned()),
        Ok(samples) => {
            let positions = samples.positions(Position::default());
            let distances = positions.windows(2).map(from_corner);
            Measured::Value(distances.fold(f64::INFINITY, f64::min))
        }
        Err(NoSamples::Unsupported(why)) => Measured::Nothing(why),
        Err(NoSamples::Failed(error)) => Measured::Nothing(error.to_string()),
    };
    Measurement {
        id: id(tolerance),
        title: format!("distance of the motion from a square corner, G64 P{tolerance}"),
        unit: "mm".to_owned(),
        measured,
        runs: 1,
        program,
    }
}

/// The distance of the corner from the way between two samples, which is taken as straight.
fn from_corner(samples: &[Position]) -> f64 {
    let &[from, to] = samples else { return f64::INFINITY };
    let (along, across) = (to.x - from.x, to.y - from.y);
    let length = along * along + across * across;
    let part = ((20.0 - from.x) * along - from.y * across) / length;
    let part = if length > 0.0 { part.clamp(0.0, 1.0) } else { 0.0 };
    libm::hypot(from.x + part * along - 20.0, from.y + part * across)
}
