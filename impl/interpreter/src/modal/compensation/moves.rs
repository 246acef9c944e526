//! Moves under compensation.

use gaugeblock_vocabulary::{ControllerMode, Effect, FaultKind, FeedMode, Motion, Plane};

use crate::canon::Sink;
use crate::faults::{PlantedFault, planted};
use crate::words::Words;

use super::super::Modal;
use super::super::check::Block;
use super::super::coordinates::Coordinates;
use super::super::letters::{U, V, W};
use super::super::refusal::{Refusal, refuse};
use super::super::vector::Vector;
use super::corner::{Corner, intersection};
use super::entry::{check_entry, entry_circle};
use super::normal_of;
use super::path::LastMove;
use super::plane::{Curve, Cutter, Segment};

/// A move of a block before compensation.
struct Programmed {
    line: u32,
    motion: Motion,
    /// The controlled point before the block, which is compensated.
    before: Coordinates,
    /// The programmed end.
    end: Coordinates,
    segment: Segment,
    /// Turns of an arc with their sign.
    turns: i32,
}

impl Modal {
    /// Makes a straight move or an arc at a distance of R from its programmed curve.
    pub(in super::super) fn compensated_move<K: Sink>(
        &mut self,
        block: &Block<'_>,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        self.check_defined_move(block.words)?;
        let plane = self.active.now().plane;
        let before = self.position;
        let from = match &self.compensation.path.last {
            Some(last) => last.segment.to,
            None => before.in_plane(plane),
        };
        self.position = before.with_in_plane(plane, from);
        let start = self.position;
        self.move_to_end_point(block)?;
        let is_arc = !matches!(self.motion, Motion::Traverse | Motion::Feed);
        if is_arc && planted(PlantedFault::DepthLostOnArcs) {
            let normal = normal_of(plane);
            self.position = self.position.with_axis(normal, start.coordinate_of(normal));
        }
        let end = self.position;
        let to = end.in_plane(plane);
        if !is_arc && to.minus(from).is_zero() {
            return self.move_out_of_plane(block.words.line, before, sink);
        }
        let (segment, turns) = if is_arc {
            let Effect::ArcFeed { first_centre, second_centre, turns, .. } =
                self.arc(block.words, self.motion, &start)?
            else {
                return Ok(());
            };
            let centre = Vector { p: first_centre, q: second_centre };
            let sense = if turns > 0 { 1.0 } else { -1.0 };
            (Segment::arc(from, to, centre, sense), turns)
        } else {
            (Segment::line(from, to), 0)
        };
        let (line, motion) = (block.words.line, self.motion);
        let programmed = Programmed { line, motion, before, end, segment, turns };
        if self.compensation.has_path() {
            self.follow_path(&programmed, sink)
        } else if motion == Motion::Traverse && planted(PlantedFault::RapidEntryOnPath) {
            self.perform_move(line, before, &straight(motion, end), sink)
        } else {
            self.enter_path(&programmed, sink)
        }
    }

    /// The shift of the cutter's orientation in the plane.
    pub(super) fn plane_shift(&self) -> Vector {
        if self.active.now().plane == Plane::Zx { self.cutter.shift() } else { Vector::default() }
    }

    /// Ends the run where the documents leave open what a move does.
    fn check_defined_move(&self, words: &Words) -> Result<(), Refusal> {
        let plane = self.active.now().plane;
        let other = self.compensation.path.last.is_some_and(|last| last.plane != plane);
        let why = if let Some(why) = self.compensation.path.undefined {
            why
        } else if words.present & (U | V | W) != 0 {
            "U, V or W under cutter compensation"
        } else if other || !matches!(plane, Plane::Xy | Plane::Zx) {
            "another plane under cutter compensation"
        } else if self.controller_mode == ControllerMode::Mdi {
            "moves under cutter compensation that are entered by hand"
        } else {
            return Ok(());
        };
        Err(Refusal::Unspecified(why.into()))
    }

    /// A move that displaces nothing in the plane; what waits before it decides where it is.
    fn move_out_of_plane<K: Sink>(
        &mut self,
        line: u32,
        before: Coordinates,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        if !self.compensation.has_path() {
            return refuse(
                FaultKind::Gouging,
                "an entry that is too short for the cutter's radius",
            );
        }
        let plane = self.active.now().plane;
        let point = before.in_plane(plane);
        self.position = self.position.with_in_plane(plane, point);
        let end = self.position.with_in_plane(plane, point.plus(self.plane_shift()));
        let effect = straight(self.motion, end);
        if self.compensation.waits() {
            self.hold(line, before, effect, sink);
            return Ok(());
        }
        self.perform_move(line, before, &effect, sink)
    }

    /// The first compensated move.
    fn enter_path<K: Sink>(&mut self, to: &Programmed, sink: &mut K) -> Result<(), Refusal> {
        check_entry(&to.segment, &self.cutter, self.emulates_rs274)?;
        let end = finite(to.segment.offset_end(&self.cutter))?;
        let (effect, circle) = match &to.segment.curve {
            Curve::Line { .. } => (straight(to.motion, self.move_end(to, end)), None),
            Curve::Arc(_) if !self.plane_shift().is_zero() => {
                let why = "an entry by an arc with the orientation of a lathe tool";
                return Err(Refusal::Unspecified(why.into()));
            }
            Curve::Arc(arc) => {
                let circle = entry_circle(&to.segment, arc, end, &self.cutter)?;
                (arc_effect(self.move_end(to, end), circle.centre, to.turns), Some(circle))
            }
        };
        let (plane, start) = (self.active.now().plane, to.segment.from);
        let segment = to.segment;
        let last =
            LastMove { plane, segment, circle, is_entry: true, has_to_fit: false, start, end };
        self.wait_with(to, last, effect, sink);
        Ok(())
    }

    /// A compensated move after another one: the corner between them.
    fn follow_path<K: Sink>(&mut self, to: &Programmed, sink: &mut K) -> Result<(), Refusal> {
        let Some(last) = self.compensation.path.last else { return Ok(()) };
        let cutter = self.cutter;
        check_radius(&to.segment, &cutter)?;
        let own_start = to.segment.offset_start(&cutter);
        let end = finite(to.segment.offset_end(&cutter))?;
        finite(own_start)?;
        let waits = self.compensation.waits();
        let corner = Corner::between(&last.segment, &to.segment, &cutter);
        let has_to_fit = waits || corner != Corner::Inner;
        let start = match corner {
            Corner::Tangent => {
                self.put_out(None, sink)?;
                last.end
            }
            Corner::Inner if last.is_turned_over() => {
                let why = "an inner corner after an entry by an arc that is turned over";
                return Err(Refusal::Unspecified(why.into()));
            }
            Corner::Inner if waits => {
                let crossing = intersection(&last, &to.segment, &cutter)?;
                last.check_fit(crossing)?;
                self.put_out(Some(crossing), sink)?;
                crossing
            }
            Corner::Inner if last.segment.as_arc().is_some() || to.segment.as_arc().is_some() => {
                let why = "a stop before an inner corner at an arc under cutter compensation";
                return Err(Refusal::Unspecified(why.into()));
            }
            // After a stop the move starts where the tool is.
            Corner::Inner => last.end,
            Corner::Outer => {
                if waits && to.segment.as_arc().is_none() {
                    last.check_fit(last.end)?;
                }
                self.put_out(None, sink)?;
                self.join(to, own_start, sink)?;
                own_start
            }
        };
        let effect = match &to.segment.curve {
            Curve::Line { .. } => straight(to.motion, self.move_end(to, end)),
            Curve::Arc(arc) => {
                arc_effect(self.move_end(to, end), arc.centre.plus(self.plane_shift()), to.turns)
            }
        };
        let (plane, segment) = (self.active.now().plane, to.segment);
        let circle = segment.circle(&cutter);
        let last = LastMove { plane, segment, circle, is_entry: false, has_to_fit, start, end };
        self.wait_with(to, last, effect, sink);
        Ok(())
    }

    /// The joining move round an outer corner. The third axis is where it was, rotary axes are where the next move
    /// takes them.
    fn join<K: Sink>(&mut self, to: &Programmed, end: Vector, sink: &mut K) -> Result<(), Refusal> {
        let plane = self.active.now().plane;
        let shift = self.plane_shift();
        let normal = normal_of(plane);
        let point = to
            .end
            .with_axis(normal, to.before.coordinate_of(normal))
            .with_in_plane(plane, end.plus(shift));
        let in_rapid = to.motion == Motion::Traverse;
        let effect = if in_rapid && !self.choices.arc_before_traverse {
            Effect::StraightTraverse { end: point.position() }
        } else {
            let now = self.active.now();
            if in_rapid && (now.feed_rate <= 0.0 || now.feed_mode == FeedMode::InverseTime) {
                let why = "an arc round a corner in front of G0 that has no feed rate";
                return Err(Refusal::Unspecified(why.into()));
            }
            let turns = if self.cutter.side > 0.0 { -1 } else { 1 };
            arc_effect(point, to.segment.from.plus(shift), turns)
        };
        self.position = point;
        self.perform_move(to.line, to.before, &effect, sink)
    }

    /// Where a move ends, with its end in the plane.
    fn move_end(&self, to: &Programmed, end: Vector) -> Coordinates {
        to.end.with_in_plane(self.active.now().plane, end.plus(self.plane_shift()))
    }

    /// Makes a move the last one, which waits until the next one is known.
    fn wait_with<K: Sink>(
        &mut self,
        to: &Programmed,
        last: LastMove,
        effect: Effect,
        sink: &mut K,
    ) {
        let from = if last.is_entry {
            to.before
        } else {
            to.before.with_in_plane(last.plane, last.start.plus(self.plane_shift()))
        };
        self.hold(to.line, from, effect, sink);
        // The shift of an orientation is in effects alone.
        self.position = to.end.with_in_plane(last.plane, last.end);
        self.compensation.path_mut().last = Some(last);
    }
}

/// An arc that bends towards the cutter needs a radius greater than R.
fn check_radius(segment: &Segment, cutter: &Cutter) -> Result<(), Refusal> {
    if planted(PlantedFault::TightArcAccepted) {
        return Ok(());
    }
    if segment.as_arc().is_some_and(|arc| arc.offset_radius(cutter) <= 0.0) {
        return refuse(FaultKind::Gouging, "an arc whose radius is not greater than the cutter's");
    }
    Ok(())
}

/// A point that can be reached.
fn finite(point: Vector) -> Result<Vector, Refusal> {
    if point.is_finite() {
        return Ok(point);
    }
    refuse(FaultKind::Gouging, "a compensated move beyond the largest number")
}

/// A straight move to a point.
fn straight(motion: Motion, end: Coordinates) -> Effect {
    let end = end.position();
    if motion == Motion::Traverse {
        Effect::StraightTraverse { end }
    } else {
        Effect::StraightFeed { end }
    }
}

/// An arc to a point.
fn arc_effect(end: Coordinates, centre: Vector, turns: i32) -> Effect {
    Effect::ArcFeed { end: end.position(), first_centre: centre.p, second_centre: centre.q, turns }
}
