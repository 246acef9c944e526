//! The numbers of a lathe cycle's block.

use gaugeblock_vocabulary::{Compensation, FaultKind, Lathe, Plane, Position};

use crate::ids::rule;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::target::end_point;
use crate::rs274::execute::{whole, word};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// How a roughing cycle cuts pockets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pockets {
    /// G71 and G72: with everything else.
    Cut,
    /// G71.1 and G72.1: not.
    Left,
    /// G71.2 and G72.2: them alone.
    Only,
}

/// What a cycle does along its profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// G70.
    Finishing,
    /// G71, and G72 across.
    Roughing { across: bool, pockets: Pockets },
}

/// Each lathe cycle by its code, in tenths.
const KINDS: &[(u32, Kind)] = &[
    (700, Kind::Finishing),
    (710, Kind::Roughing { across: false, pockets: Pockets::Cut }),
    (711, Kind::Roughing { across: false, pockets: Pockets::Left }),
    (712, Kind::Roughing { across: false, pockets: Pockets::Only }),
    (720, Kind::Roughing { across: true, pockets: Pockets::Cut }),
    (721, Kind::Roughing { across: true, pockets: Pockets::Left }),
    (722, Kind::Roughing { across: true, pockets: Pockets::Only }),
];

fn kind_of(words: &Words) -> Option<Kind> {
    let kind = |code: &u32| KINDS.iter().find(|(number, _)| number == code).map(|(_, kind)| *kind);
    words.g_tenths.iter().find_map(kind)
}

/// Whether a block programs a lathe cycle.
pub(crate) fn is_programmed(words: &Words) -> bool {
    kind_of(words).is_some()
}

/// A lathe cycle. Lengths are in the active length unit, and radial.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cycle {
    kind: Kind,
    /// D: the first distance of G70, or the distance that all others leave.
    pub(super) distance: f64,
    /// E of G70: the last distance.
    pub(super) last_distance: f64,
    /// P of G70: the number of passes.
    pub(super) passes: f64,
    /// I: the distance between two layers; positive.
    pub(super) increment: f64,
    /// R: the distance by which the tool retracts after a layer.
    pub(super) retract: f64,
}

impl Cycle {
    /// Whether it is G70.
    pub(super) fn is_finishing(&self) -> bool {
        self.kind == Kind::Finishing
    }

    /// Whether X is the travel axis of a roughing cycle.
    pub(super) fn is_across(&self) -> bool {
        matches!(self.kind, Kind::Roughing { across: true, .. })
    }

    /// What a roughing cycle does with pockets.
    pub(super) fn pockets(&self) -> Pockets {
        match self.kind {
            Kind::Roughing { pockets, .. } => pockets,
            Kind::Finishing => Pockets::Left,
        }
    }
}

/// The number of the subroutine with the profile, as a label.
///
/// Rule turning.profile-needed. A cycle needs Q. Rule turning.profile-number. It is an integer.
pub(crate) fn called_label(words: &Words) -> Result<String, StepError> {
    let Some(number) = word(words, 'q') else {
        let message = "a lathe cycle without Q, the subroutine of its profile";
        return Err(refuse(rule::turning::PROFILE_NEEDED, FaultKind::MissingWord, message));
    };
    let label = whole(number).ok_or_else(|| {
        let message = format!("Q{number} is not the number of a subroutine");
        refuse(rule::turning::PROFILE_NUMBER, FaultKind::NotAnInteger, message)
    })?;
    Ok(label.to_string())
}

/// Checks what a cycle is refused for before its first motion, and returns where it starts: at its axis words.
pub(super) fn start_of(words: &Words, state: &mut State) -> Result<Position, StepError> {
    check(words, state)?;
    end_point(words, state)
}

/// Rule turning.plane. A lathe cycle is in the ZX plane. Rule turning.under-compensation. G71, G72 and their variants
/// are refused while cutter compensation is on. Rule offsets.machine-needs-motion. G53 has no place in the block.
fn check(words: &Words, state: &mut State) -> Result<(), StepError> {
    if words.g_tenths.contains(&530) {
        let rule = rule::offsets::MACHINE_NEEDS_MOTION;
        return Err(refuse(rule, FaultKind::ModalConflict, "G53 needs G0 or G1"));
    }
    if kind_of(words) != Some(Kind::Finishing) {
        if state.modes.compensation != Compensation::Off {
            let message = "a roughing cycle while cutter compensation is on";
            let rule = rule::turning::UNDER_COMPENSATION;
            return Err(refuse(rule, FaultKind::CompensationActive, message));
        }
        state.coverage.accepted(rule::turning::UNDER_COMPENSATION);
    }
    if state.modes.plane != Plane::Zx {
        let message = "a lathe cycle in another plane than ZX";
        return Err(refuse(rule::turning::PLANE, FaultKind::ModalConflict, message));
    }
    state.coverage.accepted(rule::turning::PLANE);
    Ok(())
}

/// The numbers of a block. D, E, I and R are radial, also in diameter mode, and in the active length unit.
///
/// Rule turning.roughing-increment. I is greater than zero.
pub(super) fn find(words: &Words) -> Result<Cycle, StepError> {
    let kind = kind_of(words).expect("motion: the block programs a lathe cycle");
    let value = |letter, default| word(words, letter).unwrap_or(default);
    let cycle = Cycle {
        kind,
        distance: value('d', 0.0),
        last_distance: value('e', 0.0),
        passes: value('p', 1.0),
        increment: value('i', 1.0),
        retract: value('r', 0.5),
    };
    if !cycle.is_finishing() && cycle.increment <= 0.0 {
        let message = "a distance between layers that is not greater than zero";
        let rule = rule::turning::ROUGHING_INCREMENT;
        return Err(refuse(rule, FaultKind::WordOutOfRange, message));
    }
    Ok(cycle)
}

/// A radial coordinate of a word along X: half of it in diameter mode.
pub(super) fn radial(value: f64, state: &State) -> f64 {
    if state.modes.lathe == Lathe::Diameter { value / 2.0 } else { value }
}
