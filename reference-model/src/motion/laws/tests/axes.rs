//! Velocity, acceleration, jerk.

use super::*;

fn straight() -> (ProgrammedPath, Vec<AxisVector>) {
    let path = path(within(0.01), Feed::PerSecond(200.0), vec![line(30.0, 20.0)]);
    (path, Motion::default().line(xy(30.0, 20.0), (0.0, 200.0, 0.0), 2400.0).samples())
}

#[test]
fn a_line_at_its_limits_is_lawful() {
    let (path, points) = straight();
    let judgement = judged(&points, &path);
    lawful(&judgement);
    let Some(Verdict::Satisfied { share: Some(share) }) = judgement.of(Law::Acceleration) else {
        panic!("the acceleration is judged");
    };
    assert!((0.99..=1.0).contains(share), "{share}");
}

/// Fault 1: an acceleration 1 % over its limit for one cycle.
#[test]
fn one_cycle_of_acceleration_beyond_the_limit() {
    let (path, mut points) = straight();
    for point in &mut points[41..] {
        point[0] += 0.0235 * PERIOD * PERIOD * 1000.0;
    }
    let message = broken(&judged(&points, &path), Law::Acceleration);
    assert!(message.contains("cycle 40: x has 2020."), "{message}");
}

/// Fault 2: an acceleration that is 1 % too high throughout.
#[test]
fn an_acceleration_that_is_too_high() {
    let path = path(within(0.01), Feed::PerSecond(200.0), vec![line(30.0, 0.0)]);
    let points = Motion::default().line(xy(30.0, 0.0), (0.0, 200.0, 0.0), 2020.0).samples();
    let message = broken(&judged(&points, &path), Law::Acceleration);
    assert!(message.contains("x has 20") && message.contains("mm/s² where 2000"), "{message}");
}

/// Fault 3: a velocity 1 % over its limit.
#[test]
fn a_velocity_beyond_the_limit() {
    let rapid = path(within(0.01), Feed::Rapid, vec![line(60.0, 0.0)]);
    let points = |speed| Motion::default().line(xy(60.0, 0.0), (0.0, speed, 0.0), 2000.0).samples();
    lawful(&judged(&points(250.0), &rapid));
    broken(&judged(&points(252.5), &rapid), Law::Velocity);
}

/// Fault 4: a velocity beyond the limit for one cycle.
#[test]
fn one_cycle_of_velocity_beyond_the_limit() {
    let rapid = path(within(0.01), Feed::Rapid, vec![line(60.0, 0.0)]);
    let mut points = Motion::default().line(xy(60.0, 0.0), (0.0, 250.0, 0.0), 2000.0).samples();
    let middle = points.len() / 2;
    points[middle][0] += 0.01 * 250.0 * PERIOD;
    let message = broken(&judged(&points, &rapid), Law::Velocity);
    assert!(message.contains("x has 252."), "{message}");
}

fn jerk_limited(jerk: f64) -> MotionLimits {
    let mut limits = limits();
    for limit in limits.axes.values_mut() {
        limit.jerk = Some(jerk);
    }
    limits
}

/// Faults 5 and 6: an acceleration that steps, and a jerk 1 % over its limit.
#[test]
fn a_jerk_beyond_the_limit() {
    let path = path(within(0.01), Feed::PerSecond(200.0), vec![line(8.0, 0.0)]);
    let judged = |points: &[AxisVector], jerk| {
        judge(&record(points, &[]), &path, &jerk_limited(jerk), &MotionScript::default())
    };
    let stepping = Motion::default().line(xy(8.0, 0.0), (0.0, 200.0, 0.0), 1000.0).samples();
    broken(&judged(&stepping, 1e5), Law::Jerk);
    // Four parts of 0.1 s with a jerk of 4000 up, down, down, up make 8 mm.
    let place = |second: f64| {
        let part = |t: f64| 4000.0 * t * t * t / 6.0;
        let from = |start: f64| part((second - start).max(0.0));
        let x = from(0.0) - 2.0 * from(0.1) + 2.0 * from(0.3) - from(0.4);
        [x, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    };
    let mut smooth: Vec<AxisVector> =
        (0..400_u32).map(|sample| place(f64::from(sample) * PERIOD)).collect();
    smooth.extend([xy(8.0, 0.0).to_array(); 3]);
    // The sum of four cubes loses more than a position does.
    lawful(&judged(&smooth, 4000.001));
    broken(&judged(&smooth, 3960.0), Law::Jerk);
}

#[test]
fn what_is_not_stated_or_not_recorded_is_not_judged() {
    let (path, points) = straight();
    let mut unstated = limits();
    unstated.axes.remove(&Axis::Y);
    let judgement = judge(&record(&points, &[]), &path, &unstated, &MotionScript::default());
    assert!(
        matches!(judgement.of(Law::Velocity), Some(Verdict::NotJudged(why)) if why.starts_with('y'))
    );
    let mut samples = Samples::new(PERIOD, 0.0, vec![Column::Position(Axis::X)]).unwrap();
    for point in &points {
        samples.push(&point[..1]).unwrap();
    }
    let judgement = judge(&samples, &path, &limits(), &MotionScript::default());
    assert!(
        matches!(judgement.of(Law::Acceleration), Some(Verdict::NotJudged(why)) if why.contains("not recorded"))
    );
}

#[test]
fn what_a_record_rounds_away_is_granted() {
    let path = path(within(0.01), Feed::PerSecond(200.0), vec![line(30.0, 0.0)]);
    let mut points = Motion::default().line(xy(30.0, 0.0), (0.0, 200.0, 0.0), 1999.9).samples();
    for point in &mut points {
        for value in &mut point[..3] {
            *value = (*value * 1e6).round() / 1e6;
        }
    }
    let axes = [Axis::X, Axis::Y, Axis::Z].map(Column::Position).to_vec();
    let written = |resolution: f64| {
        let mut samples = Samples::new(PERIOD, resolution, axes.clone()).unwrap();
        points.iter().for_each(|point| samples.push(&point[..3]).unwrap());
        judge(&samples, &path, &limits(), &MotionScript::default())
    };
    lawful(&written(0.5e-6));
    broken(&written(0.0), Law::Acceleration);
}

/// If the resolution of samples hides a limit, its law can be broken, but not satisfied.
#[test]
fn coarse_samples_hide_limits() {
    let (path, points) = straight();
    let laws = [Law::Velocity, Law::Acceleration, Law::Feed];
    let open = |resolution: f64| {
        let judgement = judge_coarse(&points, &path, resolution);
        laws.map(|law| matches!(judgement.of(law), Some(Verdict::NotJudged(_))))
    };
    assert_eq!(open(0.0004), [false, false, false]);
    assert_eq!(open(0.0006), [false, true, false], "2400 mm/s² where 2000 are allowed");
    assert_eq!(open(0.06), [false, true, true], "240 mm/s where 200 are programmed");
    assert_eq!(open(0.1), [false, true, true]);
    let mut jumps = points.clone();
    for point in &mut jumps[41..] {
        point[0] += 1.0;
    }
    let judgement = judge_coarse(&jumps, &path, 0.0006);
    broken(&judgement, Law::Acceleration);
}
