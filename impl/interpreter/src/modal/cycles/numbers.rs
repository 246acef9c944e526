//! The numbers of a canned cycle's block, those among them that are sticky, and their ranges (11.5.43.1 to 11.5.43.5).

use gaugeblock_vocabulary::{Axis, FaultKind};

use crate::faults::{PlantedFault, narrowed, planted};
use crate::math;
use crate::words::Words;

use super::super::choices::{Choices, TapWithoutDwell};
use super::super::refusal::{Refusal, refuse};
use super::super::values::not_negative;

/// The words of a cycle's block, as numbers and not yet as positions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Numbers {
    /// R.
    pub(super) retract: f64,
    /// Z, or what the plane has in its place.
    pub(super) bottom: f64,
    /// P, seconds; zero where the cycle does not dwell.
    pub(super) dwell: f64,
    /// Whether the cycle has a P.
    pub(super) has_dwell: bool,
    /// Q; zero where the cycle does not peck.
    pub(super) increment: f64,
    /// L.
    pub(super) repeats: u64,
}

/// The value of an axis word.
pub(super) fn axis_word(words: &Words, axis: Axis) -> Option<f64> {
    words.get(match axis {
        Axis::X => b'X',
        Axis::Y => b'Y',
        Axis::Z => b'Z',
        Axis::A => b'A',
        Axis::B => b'B',
        Axis::C => b'C',
        Axis::U => b'U',
        Axis::V => b'V',
        Axis::W => b'W',
    })
}

impl Numbers {
    /// Reads the words of a cycle; `sticky` are those of the block before, where it was of the same cycle. `tap` is
    /// the P of a tap that has none; the depth of another cycle only as a planted fault.
    pub(super) fn read(
        words: &Words,
        code: u16,
        normal: Axis,
        sticky: Option<Self>,
        (choices, tap, foreign_depth): (&Choices, f64, Option<f64>),
    ) -> Result<Self, Refusal> {
        let word = |here: Option<f64>, kept: Option<f64>, missing: &str| match here.or(kept) {
            Some(number) => Ok(number),
            None => refuse(FaultKind::MissingWord, missing),
        };
        let retract = word(
            words.get(b'R'),
            sticky.map(|kept| kept.retract),
            "a cycle without R, and none to keep",
        )?;
        let bottom = word(
            axis_word(words, normal),
            sticky.map(|kept| kept.bottom).or(foreign_depth),
            "a cycle without its depth, and none to keep",
        )?;
        let kept = sticky.filter(|_| !choices.arguments_each_block);
        let needs_dwell = choices.tap_without_dwell == TapWithoutDwell::Refused;
        let taps_at_once = matches!(code, 740 | 840) && !needs_dwell;
        let kept_dwell = kept.filter(|kept| kept.has_dwell).map(|kept| kept.dwell);
        let has_dwell = words.get(b'P').or(kept_dwell).is_some();
        let dwell = if dwells(code) {
            let seconds = word(
                words.get(b'P'),
                kept_dwell.or(taps_at_once.then_some(tap)),
                "a cycle that dwells without P",
            )?;
            not_negative(seconds, "P")?
        } else {
            0.0
        };
        let increment = if pecks(code) {
            let kept = kept.map(|kept| kept.increment);
            let increment = word(words.get(b'Q'), kept, "a cycle that pecks without Q")?;
            if increment <= 0.0 {
                return refuse(FaultKind::WordOutOfRange, "Q is negative or zero");
            }
            increment
        } else {
            0.0
        };
        let once = match sticky {
            Some(kept) if planted(PlantedFault::RepeatsSticky) => kept.repeats,
            Some(_) | None => 1,
        };
        let repeats = words.get(b'L').map_or(Ok(once), repeats)?;
        Ok(Self { retract, bottom, dwell, has_dwell, increment, repeats })
    }
}

/// Whether a cycle has a P.
pub(super) const fn dwells(code: u16) -> bool {
    matches!(code, 740 | 820 | 840 | 860 | 890)
}

/// Whether a cycle has a Q.
const fn pecks(code: u16) -> bool {
    matches!(code, 730 | 830)
}

/// L: a positive integer (11.5.43.5).
fn repeats(value: f64) -> Result<u64, Refusal> {
    let value = narrowed(PlantedFault::RepeatWraps, value, 256.0);
    let Some(number) = math::near_integer(value) else {
        return refuse(FaultKind::NotAnInteger, "L is not an integer");
    };
    match u64::try_from(number) {
        Ok(number @ 1..) => Ok(number),
        Ok(0) | Err(_) => refuse(FaultKind::WordOutOfRange, "L is not positive"),
    }
}
