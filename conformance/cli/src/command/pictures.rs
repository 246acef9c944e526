//! Pictures of servo samples.

use std::path::Path;

use gaugeblock_motion::{Picture, Thinned, polyline};
use gaugeblock_reference::motion::laws::for_each_deviation;
use gaugeblock_reference::motion::recording::{Recording, RecordingError};
use gaugeblock_vocabulary::motion::{MotionLimits, MotionScript, ProgrammedPath};
use gaugeblock_vocabulary::{Axis, Position};

use super::{scratch, user_files};
use crate::error::CliError;

/// What is drawn. Of a long motion few of the samples are.
#[derive(Debug)]
pub(crate) struct Drawing<'a> {
    /// Lines of text above.
    pub(crate) title: [String; 2],
    pub(crate) recording: &'a Recording,
    pub(crate) path: &'a ProgrammedPath,
    pub(crate) limits: &'a MotionLimits,
    pub(crate) script: &'a MotionScript,
    /// Speed along the path and requested feed, by sample, if the planner reports them.
    pub(crate) feeds: Option<(Thinned, Thinned)>,
}

impl Drawing<'_> {
    /// Writes it as SVG.
    pub(crate) fn write(self, file: &Path) -> Result<(), CliError> {
        let recording = self.recording;
        let step = Thinned::step_of(recording.len());
        let commanded: Vec<_> =
            (0..recording.len()).step_by(step).map(|sample| place(recording, sample)).collect();
        let (speed, requested) = self.feeds.unwrap_or_else(|| (speeds(recording), Thinned::new()));
        let deviation = deviations(recording, self.path, self.limits, self.script, step);
        let deviation = deviation.map_err(|error| scratch::failed(&error))?;
        let acceleration = accelerations(recording, self.limits);
        let picture = Picture {
            title: &self.title,
            programmed: &polyline(self.path),
            commanded: &commanded,
            deviation: &deviation,
            period: recording.period() * periods(step),
            speed: &speed.into_numbers(),
            requested: &requested.into_numbers(),
            acceleration: &acceleration,
        };
        let svg = picture
            .svg()
            .map_err(|error| CliError::failure(error.to_string(), "leave --svg out"))?;
        user_files::write_whole(file, &svg)
    }
}

fn periods(step: usize) -> f64 {
    f64::from(u32::try_from(step).unwrap_or(u32::MAX))
}

/// X, Y and Z of a sample.
fn place(recording: &Recording, sample: usize) -> [f64; 3] {
    let Position { x, y, z, .. } = recording.position(sample);
    [x, y, z]
}

/// How far the samples are off the path: the farthest of each step.
fn deviations(
    recording: &Recording,
    path: &ProgrammedPath,
    limits: &MotionLimits,
    script: &MotionScript,
    step: usize,
) -> Result<Vec<f64>, RecordingError> {
    let (mut farthest, mut seen): (Vec<f64>, usize) = (Vec::new(), 0);
    let each = |off: f64| {
        match farthest.last_mut() {
            Some(last) if seen % step > 0 => *last = last.max(off),
            _ => farthest.push(off),
        }
        seen += 1;
    };
    for_each_deviation(recording, path, limits, script, each)?;
    Ok(farthest)
}

/// From each sample to the next one, millimetres per second.
fn speeds(recording: &Recording) -> Thinned {
    let mut speeds = Thinned::with_samples(recording.len());
    speeds.extend((1..recording.len()).map(|sample| {
        let (before, now) = (place(recording, sample - 1), place(recording, sample));
        let [x, y, z] = [0, 1, 2].map(|axis| now[axis] - before[axis]);
        libm::sqrt(x * x + y * y + z * z) / recording.period()
    }));
    speeds
}

/// The acceleration of each axis that moves, as a share of what it can do.
fn accelerations(recording: &Recording, limits: &MotionLimits) -> Vec<(char, Vec<f64>)> {
    let square = recording.period() * recording.period();
    let mut all = Vec::new();
    for (axis, limit) in &limits.axes {
        let Some(limit) = limit.acceleration else { continue };
        let at = |sample: usize| recording.position(sample).get(*axis);
        let mut shares = Thinned::with_samples(recording.len());
        let share =
            |sample: usize| (at(sample) - 2.0 * at(sample - 1) + at(sample - 2)) / square / limit;
        shares.extend((2..recording.len()).map(share));
        let shares = shares.into_numbers();
        if shares.iter().any(|share| share.abs() > 0.0) {
            all.push((letter(*axis), shares));
        }
    }
    all
}

fn letter(axis: Axis) -> char {
    axis.to_string().to_uppercase().chars().next().unwrap_or('?')
}
