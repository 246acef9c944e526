//! Bounds of the programs that were measured on LinuxCNC: XYZ 250 mm/s and 2000 mm/s², F6000.

use gaugeblock_vocabulary::motion::{
    Controls, Feed, MotionLimits, PathElement, PathMode, ProgrammedPath, Shape,
};
use gaugeblock_vocabulary::scenario::AxisLimits;
use gaugeblock_vocabulary::{Axis, BlockLocation, Position};

use super::smooth::Smooth;
use super::{Kind, TimeBound, least_time, reach};
use crate::math;
use crate::motion::curve::Bounds;
use crate::motion::envelope::Envelope;
use crate::motion::vector::{AxisVector, length};

fn limits() -> MotionLimits {
    let limit =
        AxisLimits { velocity: Some(250.0), acceleration: Some(2000.0), ..AxisLimits::default() };
    let axes = [Axis::X, Axis::Y, Axis::Z].map(|axis| (axis, limit));
    MotionLimits { period: 0.001, axes: axes.into() }
}

fn path(mode: PathMode, shapes: Vec<Shape>) -> ProgrammedPath {
    let element = |(line, shape): (u32, Shape)| PathElement {
        block: BlockLocation::new("main.ngc", line),
        shape,
        feed: Feed::PerSecond(100.0),
        mode,
        controls: Controls::default(),
        switches: Vec::new(),
    };
    let elements = (1..).zip(shapes).map(element).collect();
    ProgrammedPath { elements, ..ProgrammedPath::default() }
}

fn line(x: f64, y: f64) -> Shape {
    Shape::Straight { end: Position { x, y, ..Position::default() } }
}

fn bound(mode: PathMode, shapes: Vec<Shape>) -> TimeBound {
    least_time(&path(mode, shapes), &limits(), 1.0).expect("limits are stated")
}

fn within(tolerance: f64) -> PathMode {
    PathMode::Within { tolerance, merge: tolerance }
}

fn teeth() -> Vec<Shape> {
    (1..=200_u32).map(|i| line(0.5 * f64::from(i), 0.5 * f64::from(i % 2))).collect()
}

#[track_caller]
fn close(bound: &TimeBound, least: f64, kind: Kind) {
    assert!((bound.least - least).abs() < 5e-4 * least, "{} is not {least}", bound.least);
    assert!(bound.achieved >= bound.least * (1.0 - 1e-12), "{bound:?}");
    assert!(bound.stretches.iter().all(|stretch| stretch.kind == kind), "{bound:?}");
}

#[test]
fn exact_stops_have_a_closed_form() {
    close(&bound(PathMode::ExactStop, teeth()), 6.325, Kind::ExactStop);
    close(&bound(PathMode::ExactPath, teeth()), 6.325, Kind::ExactStop);
    close(&bound(PathMode::ExactPath, vec![line(100.0, 0.0)]), 1.05, Kind::ExactStop);
    let square = vec![line(40.0, 0.0), line(40.0, 40.0), line(0.0, 40.0), line(0.0, 0.0)];
    let square = bound(PathMode::ExactStop, square);
    close(&square, 1.8, Kind::ExactStop);
    assert!((square.achieved - square.least).abs() < 1e-9);
    assert!((square.least - 1.8).abs() < 1e-9, "{}", square.least);
}

/// The first and the last tooth start and end at rest in their corners, and not within P of them: a little more than
/// 200 times the way between two rounded teeth, which is 6.197 s and 4.899 s.
#[test]
fn teeth_are_bounded_by_the_axis_that_turns() {
    let leg = |way: f64| 2.0 * (way / 2000.0_f64).sqrt();
    for tolerance in [0.01, 0.1] {
        let wanted = 198.0 * leg(0.5 - 2.0 * tolerance) + 2.0 * leg(0.5 - tolerance);
        let found = bound(within(tolerance), teeth());
        assert!((found.least - wanted).abs() < 1e-9, "{} is not {wanted}", found.least);
        assert!(found.least > 200.0 * leg(0.5 - 2.0 * tolerance));
        close(&found, wanted, Kind::Axis);
    }
}

#[test]
fn a_line_that_may_be_rounded_is_a_line() {
    close(&bound(within(0.01), vec![line(100.0, 0.0)]), 1.05, Kind::Axis);
}

#[test]
fn a_helix_is_bracketed() {
    let end = Position { z: -10.0, ..Position::default() };
    let shape =
        Shape::Arc { end, centre: [5.0, 0.0, 0.0], normal: [0.0, 0.0, 1.0], angle: -3600.0 };
    let helix = bound(PathMode::ExactPath, vec![shape]);
    close(&helix, 3.193, Kind::Reachability);
    assert!(helix.achieved <= helix.least * 1.001, "{helix:?}");
}

/// A small circle is bounded by its acceleration and not by its feed: v² = a·r where one axis has it all.
#[test]
fn a_small_circle_is_bounded_by_what_turning_leaves() {
    let shape = Shape::Arc {
        end: Position::default(),
        centre: [1.0, 0.0, 0.0],
        normal: [0.0, 0.0, 1.0],
        angle: 360.0,
    };
    let circle = bound(PathMode::ExactPath, vec![shape]);
    let steady = 2.0 * std::f64::consts::PI / (2000.0_f64).sqrt();
    assert!(circle.least > steady * 1.05 && circle.achieved <= circle.least * 1.001, "{circle:?}");
}

/// (15 sin 2t, 10 sin 3t, 2 sin 5t) over a range of t.
struct Figure {
    until: f64,
}

impl Figure {
    const TERMS: [(f64, f64); 3] = [(15.0, 2.0), (10.0, 3.0), (2.0, 5.0)];
}

impl Smooth for Figure {
    fn derivatives(&self, part: f64) -> [AxisVector; 3] {
        let t = part * self.until;
        let mut all = [[0.0; 9]; 3];
        for (axis, (size, rate)) in Self::TERMS.iter().enumerate() {
            let rate_here = rate * self.until;
            all[0][axis] = size * rate_here * math::cosine(rate * t);
            all[1][axis] = -size * rate_here * rate_here * math::sine(rate * t);
            all[2][axis] = -size * rate_here * rate_here * rate_here * math::cosine(rate * t);
        }
        all
    }

    fn bounds(&self) -> Bounds {
        let mut bounds = Bounds { third: [0.0; 9], fourth: [0.0; 9] };
        for (axis, (size, rate)) in Self::TERMS.iter().enumerate() {
            let rate = rate * self.until;
            bounds.third[axis] = size * rate * rate * rate;
            bounds.fourth[axis] = size * rate * rate * rate * rate;
        }
        bounds
    }

    fn counted(&self, vector: &AxisVector) -> f64 {
        length(vector)
    }

    fn steady(&self, _first: &AxisVector) -> Option<f64> {
        None
    }

    fn cells(&self, per_radian: f64) -> f64 {
        (self.until * 5.0 * per_radian).ceil()
    }
}

/// The smooth curve of the dense program, 200 mm of it.
#[test]
fn a_curve_with_analytic_derivatives_is_bracketed() {
    let way = |until: f64| {
        let figure = Figure { until };
        let parts = 4000_u32;
        (0..parts)
            .map(|part| {
                length(&figure.derivatives((f64::from(part) + 0.5) / f64::from(parts))[0])
                    / f64::from(parts)
            })
            .sum::<f64>()
    };
    let (mut low, mut high) = (0.0, 20.0);
    for _ in 0..40 {
        let middle = (low + high) / 2.0;
        if way(middle) < 200.0 { low = middle } else { high = middle }
    }
    let figure = Figure { until: low };
    let bracket = reach::bracket(&[(&figure as &dyn Smooth, 100.0)], &Envelope::of(&limits()));
    assert!((bracket.least - 2.075).abs() < 5e-3, "{bracket:?}");
    assert!(bracket.achieved <= bracket.least * 1.001, "{bracket:?}");
}

#[test]
fn tangent_curves_go_on_into_each_other() {
    let arc = Shape::Arc {
        end: Position { x: 25.0, y: 5.0, ..Position::default() },
        centre: [20.0, 5.0, 0.0],
        normal: [0.0, 0.0, 1.0],
        angle: 90.0,
    };
    let shapes = vec![line(20.0, 0.0), arc, line(25.0, 25.0)];
    let bound = bound(PathMode::ExactPath, shapes);
    assert_eq!(bound.stretches.len(), 1);
    assert!(bound.achieved <= bound.least * 1.001, "{bound:?}");
    // The whole way at the feed, and speeding up and braking.
    let way = 40.0 + 5.0 * std::f64::consts::FRAC_PI_2;
    assert!(bound.least >= way / 100.0 + 0.05 - 1e-6, "{bound:?}");
}

#[test]
fn dwells_add_up_and_what_is_not_known_is_said() {
    let dwelling =
        bound(PathMode::ExactPath, vec![line(100.0, 0.0), Shape::Dwell { seconds: 0.5 }]);
    assert!((dwelling.least - 1.55).abs() < 1e-9);
    let spline = path(PathMode::ExactPath, vec![Shape::Curve { end: Position::default() }]);
    assert!(least_time(&spline, &limits(), 1.0).unwrap_err().contains("only the end"));
    let turning = path(
        PathMode::ExactPath,
        vec![Shape::Straight { end: Position { a: 1.0, ..Position::default() } }],
    );
    assert!(least_time(&turning, &limits(), 1.0).unwrap_err().starts_with('a'));
}

#[test]
fn more_never_costs_time() {
    let looser = bound(within(0.1), teeth()).least;
    assert!(looser < bound(within(0.01), teeth()).least);
    let faster =
        least_time(&path(PathMode::ExactStop, vec![line(100.0, 0.0)]), &limits(), 2.0).unwrap();
    assert!((faster.least - 0.6).abs() < 1e-9);
}

/// A rapid on either side does not make the feed between them free.
#[test]
fn each_leg_counts_with_its_own_feed() {
    let shapes = vec![line(10.0, 0.0), line(110.0, 0.0), line(210.0, 0.0), line(210.0, 10.0)];
    let mut path = path(within(0.05), shapes);
    for place in [0, 3] {
        path.elements[place].feed = Feed::Rapid;
    }
    path.elements[2].feed = Feed::PerSecond(50.0);
    let found = least_time(&path, &limits(), 1.0).expect("limits are stated");
    let rapid = 20.0 / (250.0 * 2.0_f64.sqrt());
    let feeds = 100.0 / 100.0 + 100.0 / 50.0;
    assert!((found.least - (rapid + feeds)).abs() < 0.015, "{}", found.least);
    assert!(found.least < rapid + feeds, "near a rapid a feed may be as fast: {}", found.least);
}
