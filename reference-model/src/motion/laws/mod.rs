//! The laws of motion: what every trajectory must satisfy, whatever planner computed it.
//!
//! Samples of any controller are held against the programmed path, the limits of the machine, and what an operator
//! did. Each law is a section with the id of its rule; it answers with what is broken, where and by how much, or with
//! why it cannot be judged. A law accuses only where every reading of the documents does.
//!
//! | read | laws |
//! | --- | --- |
//! | `axes` | velocity, acceleration, jerk |
//! | `feed` | how fast the path is passed |
//! | `following` | deviation, corners, middles, order, progress |
//! | `rest` | exact stops, ends, dwells |
//! | `outputs` | when outputs switch |
//! | `operator` | hold, abort, and what is left to stop on |
//! | `granted`, `easing` | how far a motion may go on that is requested to stop, also with limits of jerk |
//! | `record`, `backwards` | what is judged; where the motion runs back |
//! | `matching`, `corner_passes` | which point of the path a sample is; when corners are passed |
//! | `choices` | which reading holds where the documents leave something open |

mod axes;
mod backwards;
mod corner_passes;
mod easing;
mod feed;
mod following;
mod granted;
mod matching;
mod operator;
mod outputs;
mod record;
mod rest;
mod verdict;

use gaugeblock_vocabulary::motion::{MotionLimits, MotionScript, ProgrammedPath, Samples};

use super::recording::{Recording, RecordingError};
use crate::Choices;
pub(in crate::motion) use matching::follows;
use record::Record;
pub use verdict::{Judgement, Law, Verdict, Violation};

/// Holds samples to all laws, under the default reading of what the documents leave open.
///
/// The work is linear in samples times pieces of path that lie within tolerance of one.
pub fn judge(
    samples: &Samples,
    path: &ProgrammedPath,
    limits: &MotionLimits,
    script: &MotionScript,
) -> Judgement {
    judge_under(Choices::default(), samples, path, limits, script)
}

/// Holds samples to all laws under some readings.
pub fn judge_under(
    choices: Choices,
    samples: &Samples,
    path: &ProgrammedPath,
    limits: &MotionLimits,
    script: &MotionScript,
) -> Judgement {
    record_verdicts(choices, &Recording::of(samples, path.start), path, limits, script)
}

/// Holds a recording to all laws under some readings. Memory depends on the path, and not on the number of samples, if
/// the recording has a store.
///
/// # Errors
/// The store of the recording cannot be read or written.
pub fn judge_recording(
    choices: Choices,
    recording: &Recording,
    path: &ProgrammedPath,
    limits: &MotionLimits,
    script: &MotionScript,
) -> Result<Judgement, RecordingError> {
    let judgement = record_verdicts(choices, recording, path, limits, script);
    recording.check().map(|()| judgement)
}

fn record_verdicts(
    choices: Choices,
    recording: &Recording,
    path: &ProgrammedPath,
    limits: &MotionLimits,
    script: &MotionScript,
) -> Judgement {
    if recording.is_empty() {
        let why = || Verdict::NotJudged("there is no sample".to_owned());
        return Judgement(Law::ALL.iter().map(|law| (*law, why())).collect());
    }
    let record = Record::new(choices, recording, path, limits, script);
    let verdict = |law: &Law| match law {
        Law::Velocity => axes::velocity(&record),
        Law::Acceleration => axes::acceleration(&record),
        Law::Jerk => axes::jerk(&record),
        Law::Feed => feed::feed(&record),
        Law::Deviation => following::deviation(&record),
        Law::Vertex => following::vertex(&record),
        Law::Midpoints => following::midpoints(&record),
        Law::Stop => rest::stop(&record),
        Law::Ends => rest::ends(&record),
        Law::Order => following::order(&record),
        Law::Progress => following::progress(&record),
        Law::Outputs => outputs::outputs(&record),
        Law::Dwell => rest::dwell(&record),
        Law::Hold => operator::hold(&record),
        Law::Abort => operator::abort(&record),
        Law::StoppingDistance => operator::stopping_distance(&record),
    };
    Judgement(Law::ALL.iter().map(|law| (*law, verdict(law))).collect())
}

/// Calls a function with how far each sample is off the programmed path (millimetres, and degrees of rotary axes): off
/// the nearest point of the legs that it can belong to. Calls nothing where samples cannot be matched to a path.
///
/// # Errors
/// The store of the recording cannot be read or written.
pub fn for_each_deviation(
    recording: &Recording,
    path: &ProgrammedPath,
    limits: &MotionLimits,
    script: &MotionScript,
    each: impl FnMut(f64),
) -> Result<(), RecordingError> {
    if !recording.is_empty() {
        let record = Record::new(Choices::default(), recording, path, limits, script);
        following::for_each_deviation(&record, each);
    }
    recording.check()
}

#[cfg(test)]
mod tests;
