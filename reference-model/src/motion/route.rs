//! Legs and corners: a path as its moving elements and the points between them.
//!
//! Elements without motion are not legs; their requests belong to the corner at which they are.

use gaugeblock_vocabulary::Position;
use gaugeblock_vocabulary::motion::{
    Feed, OutputChange, PathElement, PathMode, ProgrammedPath, Shape,
};

use super::curve::Curve;
use super::vector::{AxisVector, direction, dot, from_segment};
use crate::ids::choice::trajectory::ToleranceAtChange;

/// A moving element.
#[derive(Clone, Debug)]
pub(super) struct Leg<'a> {
    /// Its place among the elements of the path.
    pub(super) place: usize,
    /// What the program says of it.
    pub(super) element: &'a PathElement,
    /// Where it leads.
    pub(super) curve: Curve,
    /// How far a commanded point may be from it, millimetres; zero where it is exact.
    pub(super) tolerance: f64,
}

/// How a corner may be passed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum CornerTolerance {
    /// At rest, and exactly.
    Rest,
    /// Exactly.
    Exact,
    /// At a distance, millimetres.
    Within(f64),
    /// Between the middles of the two legs.
    BetweenMidpoints,
}

/// What is done at a corner before the next leg starts, in order.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Task {
    /// Rest for so many seconds.
    Dwell(f64),
    /// Rest until something is done.
    Wait(String),
    /// An output at once.
    AtOnce(OutputChange),
    /// Outputs with the start of a motion.
    WithMotion(Vec<OutputChange>),
    /// Outputs with a motion that leads nowhere.
    InPlace(Vec<OutputChange>),
}

/// The point where a leg ends or the first one starts.
#[derive(Clone, Debug)]
pub(super) struct Corner {
    /// Where it is.
    pub(super) at: AxisVector,
    /// How it may be passed.
    pub(super) tolerance: CornerTolerance,
    /// What is done there.
    pub(super) tasks: Vec<Task>,
}

/// A path as legs and corners; there is one corner more than legs.
#[derive(Clone, Debug)]
pub(super) struct Route<'a> {
    pub(super) legs: Vec<Leg<'a>>,
    pub(super) corners: Vec<Corner>,
}

impl<'a> Route<'a> {
    /// The route of a path.
    ///
    /// # Errors
    /// Why it is not known: an element of which only the end is.
    pub(super) fn of(path: &'a ProgrammedPath) -> Result<Self, String> {
        Self::under(ToleranceAtChange::Larger, path)
    }

    /// The route of a path, under a reading of which tolerance holds where it changes.
    ///
    /// # Errors
    /// Why it is not known: an element of which only the end is.
    pub(super) fn under(
        change: ToleranceAtChange,
        path: &'a ProgrammedPath,
    ) -> Result<Self, String> {
        let mut here = path.start;
        let start =
            Corner { at: here.to_array(), tolerance: CornerTolerance::Rest, tasks: Vec::new() };
        let mut route = Self { legs: Vec::new(), corners: vec![start] };
        for (place, element) in path.elements.iter().enumerate() {
            here = route.add(place, element, here)?;
        }
        for corner in 1..route.legs.len() {
            if route.corners[corner].tolerance != CornerTolerance::Rest {
                route.corners[corner].tolerance = route.corner_tolerance(change, corner);
            }
        }
        route.last_corner().tolerance = CornerTolerance::Rest;
        for leg in 0..route.legs.len() {
            route.legs[leg].tolerance = route.leg_tolerance(leg);
        }
        Ok(route)
    }

    fn last_corner(&mut self) -> &mut Corner {
        self.corners.last_mut().expect("route: there is a first corner")
    }

    fn add(
        &mut self,
        place: usize,
        element: &'a PathElement,
        here: Position,
    ) -> Result<Position, String> {
        let corner = self.last_corner();
        match &element.shape {
            Shape::Dwell { seconds } => corner.tasks.push(Task::Dwell(*seconds)),
            Shape::Wait { for_what } => corner.tasks.push(Task::Wait(for_what.clone())),
            Shape::AtOnce(switching) => corner.tasks.push(Task::AtOnce(*switching)),
            Shape::Straight { .. }
            | Shape::Arc { .. }
            | Shape::Probe { .. }
            | Shape::Curve { .. } => {
                let Some(curve) = Curve::of(here, &element.shape) else {
                    let what = "an element of which only the end is known";
                    return Err(format!("{what} at {}", element.block));
                };
                if !element.switches.is_empty() {
                    let switches = element.switches.clone();
                    let here = curve.is_empty();
                    let task = if here { Task::InPlace } else { Task::WithMotion };
                    corner.tasks.push(task(switches));
                }
                let rests = matches!(element.shape, Shape::Probe { .. });
                if rests || element.mode == PathMode::ExactStop && curve.is_empty() {
                    corner.tolerance = CornerTolerance::Rest;
                }
                if !curve.is_empty() {
                    let exact = rests || element.mode == PathMode::ExactStop;
                    let tolerance =
                        if exact { CornerTolerance::Rest } else { CornerTolerance::Exact };
                    self.legs.push(Leg { place, element, curve, tolerance: 0.0 });
                    self.corners.push(Corner { at: curve.end(), tolerance, tasks: Vec::new() });
                }
                return Ok(element.end().unwrap_or(here));
            }
        }
        corner.tolerance = CornerTolerance::Rest;
        Ok(here)
    }

    /// How the corner between two legs may be passed if no element requires a rest there.
    ///
    /// A corner is exact if either leg is: exact path requires each programmed point, and the next leg must follow its
    /// own path from the start. Which of two tolerances counts is the choice trajectory.tolerance-at-change: no
    /// sentence says it.
    fn corner_tolerance(&self, change: ToleranceAtChange, corner: usize) -> CornerTolerance {
        let (before, after) = (&self.legs[corner - 1], &self.legs[corner]);
        match (before.element.mode, after.element.mode) {
            (PathMode::ExactPath | PathMode::ExactStop, _)
            | (_, PathMode::ExactPath | PathMode::ExactStop) => CornerTolerance::Exact,
            (PathMode::BetweenMidpoints, _) | (_, PathMode::BetweenMidpoints) => {
                CornerTolerance::BetweenMidpoints
            }
            (
                PathMode::Within { tolerance: one, merge },
                PathMode::Within { tolerance: other, merge: other_merge },
            ) => {
                let merged = merge.min(other_merge);
                let merged = if self.can_be_merged(corner, merged) { merged } else { 0.0 };
                let tolerance = match change {
                    ToleranceAtChange::Larger => one.max(other),
                    ToleranceAtChange::Before => one,
                    ToleranceAtChange::After => other,
                };
                CornerTolerance::Within(tolerance + merged)
            }
        }
    }

    /// How far a commanded point may be from a leg.
    ///
    /// Rule trajectory.deviation. By P; where the leg may be part of a merged row, which is Q away itself, by P + Q.
    fn leg_tolerance(&self, leg: usize) -> f64 {
        match self.legs[leg].element.mode {
            PathMode::ExactStop | PathMode::ExactPath => 0.0,
            PathMode::BetweenMidpoints => self.legs[leg].curve.length(),
            PathMode::Within { tolerance, merge } => {
                let inner = |corner: &usize| (1..self.legs.len()).contains(corner);
                let merged = [leg, leg + 1]
                    .iter()
                    .filter(|corner| inner(corner))
                    .any(|corner| self.can_be_merged(*corner, merge));
                tolerance + if merged { merge } else { 0.0 }
            }
        }
    }

    /// Whether a row of lines that is merged into one line can have this corner inside.
    ///
    /// Rule trajectory.merging. Lines at one feed that move X, Y, Z alone are merged where they are less than Q away
    /// from one line; so are the halves of an arc in XY that is less than Q from a line, or less than P: two sections
    /// differ, and the wider one is granted. Whatever row it is, the neighbours of the corner are within Q of its line,
    /// so that the corner is within 2 Q of the line between them. A corner that is farther away is not in a merged row.
    fn can_be_merged(&self, corner: usize, merge: f64) -> bool {
        let (before, after) = (&self.legs[corner - 1], &self.legs[corner]);
        let bow = |leg: &Leg<'_>| match leg.element.mode {
            PathMode::Within { tolerance, .. } => merge.max(tolerance),
            PathMode::ExactStop | PathMode::ExactPath | PathMode::BetweenMidpoints => merge,
        };
        let plain = |leg: &Leg<'_>| {
            let (start, end) = (leg.curve.start(), leg.curve.end());
            let spatial = (3..9).all(|axis| start[axis].to_bits() == end[axis].to_bits());
            spatial && leg.curve.rise_over_chord() <= bow(leg) && leg.element.feed != Feed::Rapid
        };
        let away = from_segment(&before.curve.start(), &after.curve.end(), &after.curve.start());
        let level = away <= 2.0 * merge;
        merge > 0.0
            && plain(before)
            && plain(after)
            && before.element.feed == after.element.feed
            && level
    }

    /// Whether the direction of the path breaks at a corner, so that it can be passed exactly at rest alone.
    pub(super) fn breaks(&self, corner: usize) -> bool {
        if corner == 0 || corner == self.legs.len() {
            return true;
        }
        let before = direction(&self.legs[corner - 1].curve.derivatives(1.0).0);
        let after = direction(&self.legs[corner].curve.derivatives(0.0).0);
        match (before, after) {
            (Some(before), Some(after)) => dot(&before, &after) < 1.0 - 1e-12,
            _ => true,
        }
    }
}
