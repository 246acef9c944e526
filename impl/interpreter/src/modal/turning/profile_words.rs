//! The blocks of a profile's sub: their words become moves.

use gaugeblock_vocabulary::{Axis, Distance, FaultKind, Lathe, Motion};

use crate::faults::{PlantedFault, planted};
use crate::limits::Limit;
use crate::math;
use crate::words::Words;

use super::super::Modal;
use super::super::codes::{MOTION, g_code};
use super::super::letters::{A, C, E, I, K, U, W, X, Z};
use super::super::motion_codes::mode_of;
use super::super::refusal::{Refusal, refuse};
use super::super::vector::Vector;
use super::piece::{Arc, Curve, ROUNDING};
use super::reading::{Corner, ProfileMove, Reading};
use super::state::{ProfileStage, Stage, Turning};

impl Modal {
    /// What the cycle in progress needs from the control side; none where that is nothing.
    pub(crate) fn profile_stage(&self) -> Option<ProfileStage> {
        match self.turning.as_deref() {
            Some(Turning { stage: Stage::Profile(stage), .. }) => Some(*stage),
            Some(_) | None => None,
        }
    }

    /// The sub has been called.
    pub(crate) fn begin_profile(&mut self) {
        self.set_stage(Stage::Profile(ProfileStage::Blocks));
    }

    /// The sub has ended.
    pub(crate) fn end_profile(&mut self) {
        self.set_stage(Stage::Read);
        if let Some(tool) = self.turning.as_deref().and_then(|turning| turning.reading.tool) {
            self.position = tool;
        }
    }

    fn set_stage(&mut self, stage: Stage) {
        if let Some(turning) = &mut self.turning {
            turning.stage = stage;
        }
    }

    /// A block of the sub.
    pub(crate) fn add_to_profile(&mut self, words: &Words) -> Result<(), Refusal> {
        let Some(mut turning) = self.turning.take() else { return Ok(()) };
        let added = self.read_profile_block(words, &mut turning.reading);
        self.turning = Some(turning);
        added
    }

    fn read_profile_block(&mut self, words: &Words, reading: &mut Reading) -> Result<(), Refusal> {
        if words.is_polar() {
            return refuse(FaultKind::ModalConflict, "polar words in the ZX plane");
        }
        let code = self.profile_code(words, reading)?;
        if let Some(feed) = words.get(b'F').filter(|_| planted(PlantedFault::FeedOfProfile)) {
            self.active.set_feed_rate(feed);
        }
        if let Some(code) = code.filter(|code| !matches!(code, 700..=722)) {
            reading.motion = mode_of(code);
        }
        let takes_axes =
            |code: &u16| g_code(*code).is_some_and(|code| code.group != MOTION && code.uses_axes());
        let is_move = matches!(
            reading.motion,
            Motion::Traverse | Motion::Feed | Motion::ArcClockwise | Motion::ArcCounterclockwise
        );
        let has_point = words.present & (X | Z | U | W) != 0;
        let is_foreign = code.is_some_and(|code| code > 30)
            || !self.emulates_rs274 && words.g_words().iter().any(takes_axes);
        if !is_move || !has_point || is_foreign {
            return Ok(());
        }
        let to = self.profile_point(words, reading.here)?;
        let curve = if reading.motion == Motion::ArcClockwise {
            self.profile_arc(words, reading.here, to, -1.0)?
        } else if reading.motion == Motion::ArcCounterclockwise {
            self.profile_arc(words, reading.here, to, 1.0)?
        } else if reading.motion == Motion::Traverse && planted(PlantedFault::TraverseInProfile) {
            Curve::Traverse
        } else {
            Curve::Line
        };
        let corner = corner_of(words)?;
        if to == reading.here {
            return Ok(());
        }
        if reading.moves.len() >= usize::try_from(self.profile_moves).unwrap_or(usize::MAX) {
            return Err(Refusal::LimitExceeded(Limit::ProfileMoves));
        }
        reading.here = to;
        if self.emulates_rs274 {
            // Quirk rs274.turning-profile-position.
            reading.tool.get_or_insert(self.position);
            self.position = self.in_plane(to);
        }
        reading.moves.push(ProfileMove { to, curve, corner });
        Ok(())
    }

    /// The motion code of a block. Quirk rs274.turning-profile-codes: its words are checked.
    fn profile_code(&mut self, words: &Words, reading: &Reading) -> Result<Option<u16>, Refusal> {
        if self.emulates_rs274 {
            let mode = core::mem::replace(&mut self.motion, reading.motion);
            let present = words.present & !(A | C | U | W);
            let checked = self.check_read(&Words { present, ..words.clone() });
            self.motion = mode;
            checked?;
        } else if words.present & E != 0 && !takes_e(words) {
            // Table 11.3 does not have it among the letters that begin a word.
            return refuse(FaultKind::UnusedWord, "no code of the block takes the letter E");
        }
        let is_motion = |code: &&u16| g_code(**code).is_some_and(|code| code.group == MOTION);
        let mut motions = words.g_words().iter().filter(is_motion);
        let first = motions.next().copied();
        if first.is_some_and(|code| code <= 30) && motions.any(|code| *code <= 30) {
            return refuse(FaultKind::ModalConflict, "two motions in one block of a profile");
        }
        Ok(first)
    }

    /// The point of a block: absolute or incremental as before the cycle; U and W are increments of X and Z.
    fn profile_point(&self, words: &Words, here: Vector) -> Result<Vector, Refusal> {
        let (present, is_incremental) = (words.present, self.is_incremental());
        let twice = present & (X | U) == X | U || present & (Z | W) == Z | W;
        if twice || is_incremental && present & (U | W) != 0 {
            return refuse(FaultKind::AxisWords, "U or W together with X, Z or G91");
        }
        let half = if self.active.now().lathe == Lathe::Diameter { 0.5 } else { 1.0 };
        let coordinate = |[here, base]: [f64; 2], absolute: u8, increment: u8, scale: f64| match (
            words.get(absolute),
            words.get(increment),
        ) {
            (Some(word), _) if is_incremental => here + word * scale,
            (Some(word), _) => word * scale,
            (None, Some(word)) => base + word * scale,
            (None, None) => here,
        };
        let mut base = here;
        if !is_incremental && planted(PlantedFault::DisplacementFromStart) {
            let start = [Axis::Z, Axis::X].map(|axis| self.position.coordinate_of(axis));
            base = Vector { p: start[0], q: start[1] };
        }
        Ok(Vector {
            p: coordinate([here.p, base.p], b'Z', b'W', 1.0),
            q: coordinate([here.q, base.q], b'X', b'U', half),
        })
    }

    /// The circle of an arc. Its radius is checked when it is cut.
    fn profile_arc(
        &self,
        words: &Words,
        from: Vector,
        to: Vector,
        sense: f64,
    ) -> Result<Curve, Refusal> {
        if let Some(radius) = words.get(b'R') {
            if words.present & (I | K) != 0 {
                return refuse(FaultKind::UnusedWord, "offsets of an arc with R");
            }
            return Ok(radius_arc(radius.abs(), from, to, sense));
        }
        if words.present & (I | K) == 0 {
            return refuse(FaultKind::MissingWord, "an arc without offsets and without R");
        }
        let offset =
            Vector { p: words.get(b'K').unwrap_or(0.0), q: words.get(b'I').unwrap_or(0.0) };
        let centre = match self.active.now().arc_distance {
            Distance::Absolute => offset,
            Distance::Incremental => from.plus(offset),
        };
        Ok(Curve::Arc(Arc { centre, sense }))
    }
}

/// The arc of a radius, at most half a circle. Where the radius does not reach the centre is not a number, and the arc
/// is refused when it is cut.
fn radius_arc(radius: f64, from: Vector, to: Vector, sense: f64) -> Curve {
    let chord = to.minus(from);
    let half = chord.length() / 2.0;
    let square = (radius - half) * (radius + half);
    let is_half_circle = (radius - half).abs() <= ROUNDING;
    let height = math::sqrt(if is_half_circle { square.max(0.0) } else { square });
    let middle = from.plus(chord.times(0.5));
    let centre = middle.plus(chord.unit().quarter(sense).times(height));
    Curve::Arc(Arc { centre, sense })
}

/// A and C of a block.
fn corner_of(words: &Words) -> Result<Corner, Refusal> {
    let corner = match (words.get(b'A'), words.get(b'C')) {
        (Some(_), Some(_)) => {
            return refuse(FaultKind::ModalConflict, "a fillet and a chamfer at one corner");
        }
        (Some(radius), None) => Corner::Fillet(radius),
        (None, Some(radius)) => Corner::Chamfer(radius),
        (None, None) => Corner::Sharp,
    };
    Ok(corner)
}

/// Whether a code of a block takes an E word (11.5.38, 11.5.42, 11.6.15 to 11.6.18).
fn takes_e(words: &Words) -> bool {
    words.g_words().iter().any(|code| matches!(code, 700 | 760))
        || words.m_words().iter().any(|code| matches!(code, 66..=68))
}
