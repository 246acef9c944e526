//! When outputs switch.

use super::*;

/// Two lines; an output is switched with the second one, or at once between them.
fn lines(at_once: bool, value: f64) -> ProgrammedPath {
    let mut shapes = vec![line(10.0, 0.0), line(20.0, 0.0)];
    if at_once {
        shapes.insert(1, Shape::AtOnce(digital(value)));
    }
    let mut path = path(within(0.01), Feed::PerSecond(50.0), shapes);
    if !at_once {
        path.elements[1].switches = vec![digital(value)];
    }
    path
}

fn judged(points: &[AxisVector], path: &ProgrammedPath, at: Option<usize>) -> Judgement {
    let mut values = vec![0.0; points.len()];
    if let Some(at) = at {
        values[at..].fill(1.0);
    }
    let column = (Column::Output(Pin::DigitalOut(0)), values);
    judge(&record(points, &[column]), path, &limits(), &MotionScript::default())
}

/// Faults 32 to 35: an output two cycles late, two cycles early, never, and into the wrong value.
#[test]
fn an_output_switches_with_its_motion() {
    let points = Motion::default().to(20.0, 0.0, 50.0).samples();
    let nearest = points.iter().position(|point| point[0] >= 10.0 - 0.025).unwrap();
    let path = lines(false, 1.0);
    for good in nearest - 1..=nearest + 1 {
        lawful(&judged(&points, &path, Some(good)));
    }
    let message = broken(&judged(&points, &path, Some(nearest + 2)), Law::Outputs);
    assert!(message.contains("1 cycle too late"), "{message}");
    broken(&judged(&points, &path, Some(nearest - 2)), Law::Outputs);
    broken(&judged(&points, &path, None), Law::Outputs);
    broken(&judged(&points, &lines(false, 0.0), Some(nearest)), Law::Outputs);
}

/// Faults 36 and 37: an output at once that comes before the motion rests, or after it goes on.
#[test]
fn an_output_at_once_switches_at_rest() {
    let mut motion = Motion::default();
    motion.to(10.0, 0.0, 50.0).rest(0.005).to(20.0, 0.0, 50.0);
    let points = motion.samples();
    let at = |point: &AxisVector| (point[0] - 10.0).abs() < 1e-9;
    let first = points.iter().position(at).unwrap();
    let last = points.iter().rposition(at).unwrap();
    let path = lines(true, 1.0);
    for good in first..=last {
        lawful(&judged(&points, &path, Some(good)));
    }
    broken(&judged(&points, &path, Some(first - 2)), Law::Outputs);
    broken(&judged(&points, &path, Some(last + 2)), Law::Outputs);
    let through = Motion::default().to(20.0, 0.0, 50.0).samples();
    broken(&judged(&through, &path, Some(first)), Law::Stop);
}

/// Fault 38: a trailing output that switches.
#[test]
fn a_trailing_output_never_switches() {
    let mut path = path(within(0.01), Feed::PerSecond(50.0), vec![line(10.0, 0.0)]);
    path.never = vec![digital(1.0)];
    let points = Motion::default().to(10.0, 0.0, 50.0).samples();
    lawful(&judged(&points, &path, None));
    broken(&judged(&points, &path, Some(points.len() - 1)), Law::Outputs);
}

#[test]
fn an_output_that_is_not_recorded_is_not_judged() {
    let points = Motion::default().to(20.0, 0.0, 50.0).samples();
    let judgement = super::judged(&points, &lines(false, 1.0));
    assert!(
        matches!(judgement.of(Law::Outputs), Some(Verdict::NotJudged(why)) if why.contains("digital_out[0]"))
    );
}

#[test]
fn at_a_rounded_corner_the_nearest_sample_counts() {
    let mut path =
        path(within(0.5), Feed::PerSecond(50.0), vec![line(10.0, 0.0), line(10.0, 10.0)]);
    path.elements[1].switches = vec![digital(1.0)];
    let mut motion = Motion::default();
    let (reach, speed) = (1.0, 40.0);
    motion.line(xy(10.0 - reach, 0.0), (0.0, 50.0, speed), 1900.0);
    let seconds = 2.0 * reach / speed;
    motion.push(seconds, [-speed / seconds, speed / seconds, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    motion.line(xy(10.0, 10.0), (speed, 50.0, 0.0), 1900.0);
    let points = motion.samples();
    let corner = xy(10.0, 0.0).to_array();
    let away = |sample: &usize| distance(&points[*sample], &corner);
    let nearest = (0..points.len()).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap();
    lawful(&judged(&points, &path, Some(nearest)));
    broken(&judged(&points, &path, Some(nearest + 2)), Law::Outputs);
}

/// The rest may be over with the sample that shows it, where the motion is asked to run back.
#[test]
fn an_output_at_once_is_seen_when_the_motion_runs_back() {
    let mut motion = Motion::default();
    motion.to(10.0, 0.0, 50.0);
    motion.seconds = (motion.seconds / PERIOD).ceil() * PERIOD;
    motion.to(5.0, 0.0, 50.0).to(20.0, 0.0, 50.0);
    let points = motion.samples();
    let corner = points.iter().position(|point| (point[0] - 10.0).abs() < 1e-9).unwrap();
    let turned = points.iter().rposition(|point| (point[0] - 5.0).abs() < 0.01).unwrap();
    let mut path = lines(true, 1.0);
    path.elements[0].controls.adaptive_feed = true;
    let asked =
        |cycle: usize, feed| (u32::try_from(cycle).unwrap(), MotionAction::AdaptiveFeed(feed));
    let script = script(&[asked(corner, -1.0), asked(turned, 1.0)]);
    let verdict = |at: usize| {
        let mut values = vec![0.0; points.len()];
        values[at..].fill(1.0);
        let record = record(&points, &[(Column::Output(Pin::DigitalOut(0)), values)]);
        judge(&record, &path, &limits(), &script)
    };
    lawful(&verdict(corner + 1));
    broken(&verdict(corner + 3), Law::Outputs);
}
