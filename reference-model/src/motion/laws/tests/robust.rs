//! Whatever is recorded, there is an answer.

use proptest::prelude::*;

use super::*;

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_record_is_a_panic(
        points in prop::collection::vec((-20.0..20.0, -20.0..20.0), 0..60),
        ends in prop::collection::vec((-20_i32..20, -20_i32..20, 0_u8..5), 0..8),
        mode in 0_u8..4,
    ) {
        let modes = [PathMode::ExactStop, PathMode::ExactPath, within(1.0), PathMode::BetweenMidpoints];
        let shape = |(x, y, kind): (i32, i32, u8)| {
            let end = xy(f64::from(x), f64::from(y));
            match kind {
                0 => Shape::Dwell { seconds: 0.1 },
                1 => Shape::AtOnce(digital(1.0)),
                2 => Shape::Arc { end, centre: [0.5, 0.5, 0.0], normal: [0.0, 0.0, 1.0], angle: 500.0 },
                _ => Shape::Straight { end },
            }
        };
        let path = path(modes[usize::from(mode)], Feed::PerSecond(10.0), ends.into_iter().map(shape).collect());
        let points: Vec<AxisVector> = points.into_iter().map(|(x, y)| xy(x, y).to_array()).collect();
        let judgement = judged(&points, &path);
        prop_assert_eq!(judgement.0.len(), Law::ALL.len());
    }

    #[test]
    fn one_sample_beside_the_path_is_no_panic(y in 0.1..2.0, mode in 0_u8..4) {
        let modes = [PathMode::ExactStop, PathMode::ExactPath, within(1.0), PathMode::BetweenMidpoints];
        let shapes = vec![Shape::AtOnce(digital(1.0)), line(1.0, 0.0)];
        let path = path(modes[usize::from(mode)], Feed::PerSecond(10.0), shapes);
        let judgement = judged(&[xy(0.0, y).to_array()], &path);
        prop_assert!(judgement.violations().count() > 0);
    }

    /// Lines to and fro over a small grid cross and cover each other, and some lead nowhere.
    #[test]
    fn who_stops_at_every_corner_is_lawful_in_every_mode(
        ends in prop::collection::vec((-3_i32..4, -3_i32..4), 1..12),
        mode in 0_u8..4,
        speed in 5.0..50.0,
    ) {
        let modes = [PathMode::ExactStop, PathMode::ExactPath, within(0.1), PathMode::BetweenMidpoints];
        let ends: Vec<(f64, f64)> = ends.into_iter().map(|(x, y)| (f64::from(x), f64::from(y))).collect();
        let shapes = ends.iter().map(|(x, y)| line(*x, *y)).collect();
        let path = path(modes[usize::from(mode)], Feed::PerSecond(50.0), shapes);
        let mut motion = Motion::default();
        for (x, y) in &ends {
            if distance(&motion.at, &xy(*x, *y).to_array()) > 0.0 {
                motion.to(*x, *y, speed);
            }
        }
        let judgement = judged(&motion.samples(), &path);
        let broken: Vec<_> = judgement.violations().map(ToString::to_string).collect();
        prop_assert!(broken.is_empty(), "{}", broken.join("\n"));
    }

    /// Parabolas that miss each corner by all of P, or use half of the shorter leg, with or without a tolerance.
    #[test]
    fn who_rounds_corners_as_far_as_allowed_is_lawful(
        ends in prop::collection::vec((-3_i32..4, -3_i32..4), 2..12),
        tolerance in 0.001..0.5,
        between in any::<bool>(),
    ) {
        let ends: Vec<AxisVector> =
            ends.into_iter().map(|(x, y)| xy(f64::from(x), f64::from(y)).to_array()).collect();
        let mode = if between { PathMode::BetweenMidpoints } else { within(tolerance) };
        let tolerance = if between { f64::INFINITY } else { tolerance };
        let (shapes, points) = rounded(&ends, tolerance);
        let judgement = judged(&points, &path(mode, Feed::PerSecond(50.0), shapes));
        let broken: Vec<_> = judgement.violations().map(ToString::to_string).collect();
        prop_assert!(broken.is_empty(), "{}", broken.join("\n"));
    }

    /// A point beside the path is found wherever it is.
    #[test]
    fn a_point_beside_the_path_is_found(place in 2_usize..200, away in 0.011..0.1) {
        let path = path(within(0.01), Feed::PerSecond(50.0), vec![line(10.0, 0.0)]);
        let mut points = Motion::default().to(10.0, 0.0, 50.0).samples();
        points[place][2] += away;
        let judgement = judged(&points, &path);
        prop_assert!(judgement.violations().any(|violation| violation.law == Law::Deviation));
    }
}

#[test]
fn a_long_record_is_judged() {
    let teeth: Vec<Shape> = (1..=700_u32)
        .map(|tooth| line(f64::from(tooth) * 0.5, if tooth % 2 == 0 { 0.0 } else { 0.5 }))
        .collect();
    let mut motion = Motion::default();
    for shape in &teeth {
        let Shape::Straight { end } = shape else { continue };
        motion.to(end.x, end.y, 50.0);
    }
    let path = path(within(0.1), Feed::PerSecond(50.0), teeth);
    let points = motion.samples();
    assert!(points.len() > 20_000, "{}", points.len());
    lawful(&judged(&points, &path));
}

/// Lines from the origin through points, and a motion along them that rounds corners by constant acceleration.
fn rounded(ends: &[AxisVector], tolerance: f64) -> (Vec<Shape>, Vec<AxisVector>) {
    let mut corners = vec![[0.0; 9]];
    corners.extend(ends);
    let shapes = ends.iter().map(|end| line(end[0], end[1])).collect();
    corners.dedup_by(|later, earlier| distance(later, earlier) == 0.0);
    let legs: Vec<(AxisVector, f64)> = corners
        .windows(2)
        .map(|pair| {
            let way = distance(&pair[1], &pair[0]);
            (minus(&pair[1], &pair[0]).map(|part| part / way), way)
        })
        .collect();
    // How far from each corner its blend starts, and the speed at which the sharpest one uses all of the acceleration.
    let turn = |pair: &[(AxisVector, f64)]| distance(&pair[1].0, &pair[0].0);
    let reach = |pair: &[(AxisVector, f64)]| {
        (4.0 * tolerance / turn(pair)).min(pair[0].1 / 2.0).min(pair[1].1 / 2.0)
    };
    let fastest = |pair: &[(AxisVector, f64)]| (2.0 * reach(pair) * 1900.0 / turn(pair)).sqrt();
    let speed = legs.windows(2).map(fastest).fold(40.0, f64::min);
    let mut motion = Motion::default();
    for (number, (unit, _)) in legs.iter().enumerate() {
        let next = legs.get(number..number + 2);
        let before = next.map_or(0.0, reach);
        let end = plus(&corners[number + 1], unit, -before);
        let speeds = (
            if number == 0 { 0.0 } else { speed },
            speed,
            if next.is_none() { 0.0 } else { speed },
        );
        if distance(&end, &motion.at) > 1e-9 {
            motion.line(Position::from(end), speeds, 1900.0);
        }
        if let Some(pair) = next {
            motion.velocity = unit.map(|part| part * speed);
            let seconds = 2.0 * before / speed;
            motion.push(seconds, minus(&pair[1].0, unit).map(|part| part * speed / seconds));
        }
    }
    (shapes, motion.samples())
}
