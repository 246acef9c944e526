//! Deviation, corners, middles, order, progress.

use super::*;
use crate::math;

/// A right corner at (10, 0), rounded by a parabola from `reach` before it to `reach` behind it.
fn rounded(reach: f64) -> Vec<AxisVector> {
    let mut motion = Motion::default();
    let speed = (2.0 * reach * 1900.0_f64 / 2.0).sqrt().min(50.0);
    motion.line(xy(10.0 - reach, 0.0), (0.0, 50.0, speed), 1900.0);
    let seconds = 2.0 * reach / speed;
    let turn = speed / seconds;
    motion.push(seconds, [-turn, turn, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    motion.velocity = [0.0, speed, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    motion.line(xy(10.0, 10.0), (speed, 50.0, 0.0), 1900.0);
    motion.samples()
}

fn corner(mode: PathMode) -> ProgrammedPath {
    path(mode, Feed::PerSecond(50.0), vec![line(10.0, 0.0), line(10.0, 10.0)])
}

/// The parabola passes the corner at `reach · √2 / 4`.
fn missing(distance: f64) -> Vec<AxisVector> {
    rounded(distance * 4.0 / std::f64::consts::SQRT_2)
}

/// Fault 12: a corner that is missed by 1.1 P.
#[test]
fn a_corner_that_is_missed() {
    lawful(&judged(&missing(0.1), &corner(within(0.1))));
    let message = broken(&judged(&missing(0.11), &corner(within(0.1))), Law::Vertex);
    assert!(message.contains("the end of main.ngc:1"), "{message}");
}

/// Fault 13: a corner that is rounded where the path is exact.
#[test]
fn an_exact_corner_that_is_rounded() {
    for mode in [PathMode::ExactPath, PathMode::ExactStop] {
        let judgement = judged(&missing(0.01), &corner(mode));
        let found = |law| judgement.violations().any(|violation| violation.law == law);
        assert!(found(Law::Vertex) || found(Law::Deviation));
    }
}

#[test]
fn a_row_that_is_merged_may_be_missed_by_more() {
    let shapes = vec![line(10.0, 0.0), line(20.0, 0.05), line(30.0, 0.0)];
    let points = Motion::default().to(30.0, 0.0, 50.0).samples();
    let of = |merge| {
        path(PathMode::Within { tolerance: 0.01, merge }, Feed::PerSecond(50.0), shapes.clone())
    };
    lawful(&judged(&points, &of(0.05)));
    broken(&judged(&points, &of(0.0)), Law::Deviation);
}

/// Fault 14: one sample beside the path.
#[test]
fn a_sample_beside_the_path() {
    let path = path(within(0.01), Feed::PerSecond(50.0), vec![line(10.0, 0.0)]);
    let mut points = Motion::default().to(10.0, 0.0, 50.0).samples();
    points[100][1] = 0.011;
    let message = broken(&judged(&points, &path), Law::Deviation);
    assert!(message.contains("cycle 100") && message.contains("0.011"), "{message}");
}

/// An arc of radius 5 from the origin about (5, 0), a quarter of a turn of each second.
fn arc(radius: f64) -> (ProgrammedPath, Vec<AxisVector>) {
    let shape = Shape::Arc {
        end: xy(5.0, 5.0),
        centre: [5.0, 0.0, 0.0],
        normal: [0.0, 0.0, 1.0],
        angle: -90.0,
    };
    let path = path(PathMode::ExactPath, Feed::PerSecond(50.0), vec![shape]);
    let mut motion = Motion::default();
    motion.line(xy(90.0, 0.0), (0.0, 200.0, 0.0), 1000.0);
    let point = |[angle, ..]: AxisVector| {
        let (sine, cosine) = (math::sine_of_degrees(angle), math::cosine_of_degrees(angle));
        [5.0 - radius * cosine, radius * sine, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    };
    (path, motion.samples().into_iter().map(point).collect())
}

/// Fault 15: an arc of another radius.
#[test]
fn an_arc_is_followed_on_its_circle() {
    let (path, points) = arc(5.0);
    lawful(&judged(&points, &path));
    let (path, points) = arc(5.0001);
    broken(&judged(&points, &path), Law::Deviation);
}

/// Fault 16: a block that is left out.
#[test]
fn a_block_that_is_lost() {
    let shapes = vec![line(10.0, 0.0), line(10.0, 5.0), line(10.0, 0.0), line(20.0, 0.0)];
    let path = path(within(0.01), Feed::PerSecond(50.0), shapes);
    let mut motion = Motion::default();
    motion.to(10.0, 0.0, 50.0).to(10.0, 5.0, 50.0).to(10.0, 0.0, 50.0).to(20.0, 0.0, 50.0);
    lawful(&judged(&motion.samples(), &path));
    let points = Motion::default().to(10.0, 0.0, 50.0).to(20.0, 0.0, 50.0).samples();
    let message = broken(&judged(&points, &path), Law::Order);
    assert!(message.contains("main.ngc:2 is not passed"), "{message}");
}

/// Fault 17: the last block is never reached.
#[test]
fn a_last_block_that_is_lost() {
    let path = path(within(0.01), Feed::PerSecond(50.0), vec![line(10.0, 0.0), line(20.0, 0.0)]);
    let points = Motion::default().to(10.0, 0.0, 50.0).samples();
    let message = broken(&judged(&points, &path), Law::Order);
    assert!(message.contains("main.ngc:2 is not passed"), "{message}");
    broken(&judged(&points, &path), Law::Ends);
}

/// Fault 18: elements that are named out of order.
#[test]
fn elements_are_named_in_order() {
    let path = path(within(0.01), Feed::PerSecond(50.0), vec![line(10.0, 0.0), line(20.0, 0.0)]);
    let points = Motion::default().to(20.0, 0.0, 50.0).samples();
    let judged = |at: usize| {
        let mut elements = vec![0.0; points.len()];
        elements[points.len() / 2..].fill(1.0);
        elements[at] = 0.0;
        let column = (Column::Element, elements);
        judge(&record(&points, &[column]), &path, &limits(), &MotionScript::default())
    };
    lawful(&judged(0));
    broken(&judged(points.len() - 2), Law::Order);
}

/// Fault 19: a reversal on the path that nobody asked for.
#[test]
fn a_reversal() {
    let path = path(PathMode::ExactPath, Feed::PerSecond(50.0), vec![line(20.0, 0.0)]);
    let mut motion = Motion::default();
    motion.to(15.0, 0.0, 50.0).to(5.0, 0.0, 50.0).to(20.0, 0.0, 50.0);
    broken(&judged(&motion.samples(), &path), Law::Progress);
    let mut path = path;
    path.elements[0].controls.adaptive_feed = true;
    let asked =
        script(&[(300, MotionAction::AdaptiveFeed(-1.0)), (528, MotionAction::AdaptiveFeed(1.0))]);
    lawful(&judge(&record(&motion.samples(), &[]), &path, &limits(), &asked));
}

/// Fault 20: a reversal that leaves the path.
#[test]
fn a_reversal_off_the_path() {
    let mut path = path(PathMode::ExactPath, Feed::PerSecond(50.0), vec![line(20.0, 0.0)]);
    path.elements[0].controls.adaptive_feed = true;
    let mut motion = Motion::default();
    motion.to(15.0, 0.0, 50.0).to(5.0, 0.3, 50.0).to(15.0, 0.0, 50.0).to(20.0, 0.0, 50.0);
    let asked =
        script(&[(300, MotionAction::AdaptiveFeed(-1.0)), (528, MotionAction::AdaptiveFeed(1.0))]);
    broken(&judge(&record(&motion.samples(), &[]), &path, &limits(), &asked), Law::Deviation);
}

/// Faults 21 and 22: a corner that is rounded beyond the middles, and to the wrong side.
#[test]
fn without_a_tolerance_corners_are_rounded_between_the_middles() {
    lawful(&judged(&rounded(4.9), &corner(PathMode::BetweenMidpoints)));
    broken(&judged(&rounded(6.0), &corner(PathMode::BetweenMidpoints)), Law::Midpoints);
    let mut outside = rounded(4.9);
    let place = outside.iter().position(|point| point[1] > 1.0).unwrap();
    outside[place][0] = 10.01;
    broken(&judged(&outside, &corner(PathMode::BetweenMidpoints)), Law::Midpoints);
}

#[test]
fn a_path_that_crosses_itself_is_followed_by_progress() {
    let shapes = vec![line(10.0, 0.0), line(10.0, 10.0), line(5.0, 10.0), line(5.0, -10.0)];
    let path = path(PathMode::ExactStop, Feed::PerSecond(50.0), shapes);
    let mut motion = Motion::default();
    motion.to(10.0, 0.0, 50.0).to(10.0, 10.0, 50.0).to(5.0, 10.0, 50.0).to(5.0, -10.0, 50.0);
    lawful(&judged(&motion.samples(), &path));
    // From the crossing it takes the way that comes later: the loop is left out.
    let points = Motion::default().to(5.0, 0.0, 50.0).to(5.0, -10.0, 50.0).samples();
    broken(&judged(&points, &path), Law::Order);
}

#[test]
fn a_block_that_leads_nowhere_is_harmless() {
    let path = path(
        within(0.1),
        Feed::PerSecond(50.0),
        vec![line(10.0, 0.0), line(10.0, 0.0), line(10.0, 10.0)],
    );
    lawful(&judged(&missing(0.1), &path));
}
