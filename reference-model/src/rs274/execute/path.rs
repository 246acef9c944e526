//! G61, G61.1, G64.

use gaugeblock_vocabulary::{FaultKind, PathControlMode};

use super::word;
use crate::ids::{choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// Operations on the path control mode that a dialect can replace.
pub(crate) trait PathRules {
    /// Selects the path control mode.
    ///
    /// Rules path-control.exact-path, path-control.exact-stop, path-control.continuous. A mode may be programmed while
    /// it is active (path-control.repeated).
    fn select_path(&self, words: &Words, state: &mut State) -> Result<(), StepError> {
        let before = state.modes.path;
        let (path, rule) = if words.g_tenths.contains(&610) {
            (PathControlMode::ExactPath, rule::path_control::EXACT_PATH)
        } else if words.g_tenths.contains(&611) {
            (PathControlMode::ExactStop, rule::path_control::EXACT_STOP)
        } else {
            (PathControlMode::Continuous, rule::path_control::CONTINUOUS)
        };
        state.coverage.accepted(rule);
        if path == before {
            state.coverage.accepted(rule::path_control::REPEATED);
        }
        state.modes.path = path;
        if path == PathControlMode::Continuous {
            tolerances(words, state)?;
        }
        Ok(())
    }
}

/// The tolerances of G64, in the active length unit.
///
/// Rule path-control.tolerance. P is the blend tolerance; without P there is none, whatever was set before
/// (path-control.without-tolerance).
/// Rule path-control.naive-cam. Q is the tolerance of the naive CAM detector and zero turns it off; without Q it is P
/// (path-control.naive-cam-default).
fn tolerances(words: &Words, state: &mut State) -> Result<(), StepError> {
    let (blend, naive_cam) = (tolerance('p', words, state)?, tolerance('q', words, state)?);
    state.coverage.accepted(match blend {
        Some(_) => rule::path_control::TOLERANCE,
        None => rule::path_control::WITHOUT_TOLERANCE,
    });
    if blend.is_some() {
        state.coverage.accepted(match naive_cam {
            Some(_) => rule::path_control::NAIVE_CAM,
            None => rule::path_control::NAIVE_CAM_DEFAULT,
        });
    }
    state.modes.blend_tolerance = blend.unwrap_or(0.0);
    state.modes.naive_cam_tolerance = naive_cam.or(blend).unwrap_or(0.0);
    Ok(())
}

/// Rule path-control.negative-tolerance. Whether a tolerance below zero is refused, or counts as no tolerance, is a
/// choice.
fn tolerance(letter: char, words: &Words, state: &mut State) -> Result<Option<f64>, StepError> {
    let rule = rule::path_control::NEGATIVE_TOLERANCE;
    match word(words, letter) {
        Some(value) if value < 0.0 => {
            if state.choices.is(choice::path_control::NegativeTolerance::Refused) {
                let message = format!("a tolerance of {value}");
                return Err(refuse(rule, FaultKind::WordOutOfRange, message));
            }
            state.coverage.accepted(rule);
            Ok(None)
        }
        value => Ok(value),
    }
}
