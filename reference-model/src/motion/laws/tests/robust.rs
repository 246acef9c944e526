//! Whatever is recorded, there is an answer.

use proptest::prelude::*;

use super::*;

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

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
        let points: Vec<Nine> = points.into_iter().map(|(x, y)| xy(x, y).to_array()).collect();
        let judgement = judged(&points, &path);
        prop_assert_eq!(judgement.0.len(), Law::ALL.len());
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
