//! Pictures of servo samples.

use std::path::Path;

use gaugeblock_motion::{Picture, polyline};
use gaugeblock_reference::motion::laws::deviations;
use gaugeblock_vocabulary::Position;
use gaugeblock_vocabulary::motion::{Column, MotionLimits, MotionScript, ProgrammedPath, Samples};

use super::user_files;
use crate::error::CliError;

/// What is drawn.
#[derive(Debug)]
pub(crate) struct Drawing<'a> {
    /// Lines of text above.
    pub(crate) title: [String; 2],
    pub(crate) samples: &'a Samples,
    pub(crate) path: &'a ProgrammedPath,
    pub(crate) limits: &'a MotionLimits,
    pub(crate) script: &'a MotionScript,
    /// Speed along the path and requested feed, by sample, if the planner reports them.
    pub(crate) feeds: Option<(&'a [f64], &'a [f64])>,
}

impl Drawing<'_> {
    /// Writes it as SVG.
    pub(crate) fn write(&self, file: &Path) -> Result<(), CliError> {
        let positions = self.samples.positions(Position::default());
        let commanded: Vec<_> = positions.iter().map(|at| [at.x, at.y, at.z]).collect();
        let passed = speeds(&commanded, self.samples.period());
        let (speed, requested) = self.feeds.unwrap_or((&passed, &[]));
        let deviation = deviations(self.samples, self.path, self.limits, self.script);
        let acceleration = accelerations(self.samples, self.limits);
        let picture = Picture {
            title: &self.title,
            programmed: &polyline(self.path),
            commanded: &commanded,
            deviation: &deviation,
            period: self.samples.period(),
            speed,
            requested,
            acceleration: &acceleration,
        };
        let svg = picture
            .svg()
            .map_err(|error| CliError::failure(error.to_string(), "leave --svg out"))?;
        user_files::write_whole(file, &svg)
    }
}

/// From each sample to the next one, millimetres per second.
fn speeds(commanded: &[[f64; 3]], period: f64) -> Vec<f64> {
    let way = |pair: &[[f64; 3]]| {
        let [x, y, z] = [0, 1, 2].map(|axis| pair[1][axis] - pair[0][axis]);
        libm::sqrt(x * x + y * y + z * z) / period
    };
    commanded.windows(2).map(way).collect()
}

/// The acceleration of each axis that moves, as a share of what it can do.
fn accelerations(samples: &Samples, limits: &MotionLimits) -> Vec<(char, Vec<f64>)> {
    let square = samples.period() * samples.period();
    let mut all = Vec::new();
    for (axis, limit) in &limits.axes {
        let (Some(positions), Some(limit)) =
            (samples.column(Column::Position(*axis)), limit.acceleration)
        else {
            continue;
        };
        let shares: Vec<f64> = positions
            .windows(3)
            .map(|three| (three[2] - 2.0 * three[1] + three[0]) / square / limit)
            .collect();
        if shares.iter().any(|share| share.abs() > 0.0) {
            let letter = axis.to_string().to_uppercase().chars().next().unwrap_or('?');
            all.push((letter, shares));
        }
    }
    all
}
