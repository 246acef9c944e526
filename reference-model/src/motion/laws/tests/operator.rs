//! Hold, abort, reserve.

use super::*;

fn along() -> ProgrammedPath {
    path(PathMode::ExactPath, Feed::PerSecond(100.0), vec![line(60.0, 0.0)])
}

/// Speeds up to 100 mm/s, brakes in cycle 200 with an acceleration, rests, goes on.
fn stopping(acceleration: f64) -> Vec<AxisVector> {
    let mut motion = Motion::default();
    let up = 100.0 / 1900.0;
    let x = |value: f64| [value, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    motion.push(up, x(1900.0)).push(0.2 - up, x(0.0));
    motion.push(100.0 / acceleration, x(-acceleration));
    motion.rest(0.1).to(60.0, 0.0, 100.0);
    motion.samples()
}

fn judged_hold(points: &[AxisVector], from: u32, until: u32) -> Judgement {
    let script = script(&[(from, MotionAction::Hold(true)), (until, MotionAction::Hold(false))]);
    judge(&record(points, &[]), &along(), &limits(), &script)
}

/// Faults 39 to 41: a hold that stops too late, brakes too softly, or does not last.
#[test]
fn a_hold_stops_within_what_braking_takes() {
    lawful(&judged_hold(&stopping(2000.0), 200, 300));
    lawful(&judged_hold(&stopping(2000.0), 198, 300));
    broken(&judged_hold(&stopping(2000.0), 190, 300), Law::Hold);
    let message = broken(&judged_hold(&stopping(1700.0), 200, 300), Law::Hold);
    assert!(message.contains("where 2.5 mm suffice"), "{message}");
    broken(&judged_hold(&stopping(2000.0), 200, 400), Law::Hold);
}

/// With a limit of jerk a hold may brake more softly; it must last all the same.
#[test]
fn a_hold_with_a_limit_of_jerk_may_take_longer_and_lasts() {
    let mut limits = limits();
    limits.axes.values_mut().for_each(|limit| limit.jerk = Some(1e5));
    let held = |acceleration: f64, until: u32| {
        let hold = [(200, MotionAction::Hold(true)), (until, MotionAction::Hold(false))];
        let points = record(&stopping(acceleration), &[]);
        let judgement = judge(&points, &along(), &limits, &script(&hold));
        judgement.of(Law::Hold).cloned()
    };
    assert_eq!(held(2000.0, 300), Some(Verdict::Satisfied { share: None }));
    assert_eq!(held(500.0, 450), Some(Verdict::Satisfied { share: None }));
    assert!(matches!(held(2000.0, 400), Some(Verdict::Violated(_))));
}

#[test]
fn a_feed_stop_counts_where_it_is_enabled() {
    let points = Motion::default().to(60.0, 0.0, 100.0).samples();
    let mut path = along();
    let script = script(&[(200, MotionAction::FeedStop(true))]);
    broken(&judge(&record(&points, &[]), &path, &limits(), &script), Law::Hold);
    path.elements[0].controls.feed_stop = false;
    lawful(&judge(&record(&points, &[]), &path, &limits(), &script));
}

/// Faults 42 and 43: an abort that stops too late, and one after which the motion goes on.
#[test]
fn an_abort_stops_for_good() {
    let script = |cycle| script(&[(cycle, MotionAction::Abort)]);
    let aborted = |points: &[AxisVector], cycle| {
        judge(&record(points, &[]), &along(), &limits(), &script(cycle))
    };
    let points = stopping(2000.0);
    let stopped = &points[..300];
    lawful(&aborted(stopped, 200));
    broken(&aborted(stopped, 190), Law::Abort);
    broken(&aborted(&points, 200), Law::Abort);
}

/// Faults 44 and 45: a motion that needs more than what was queued, and one beyond it.
#[test]
fn what_is_queued_suffices_to_stop() {
    let shapes = vec![line(20.0, 0.0), line(40.0, 0.0), line(60.0, 0.0)];
    let path = path(PathMode::ExactPath, Feed::PerSecond(100.0), shapes);
    let points = Motion::default().to(60.0, 0.0, 100.0).samples();
    let judged = |ahead: f64| {
        let queued = points.iter().map(|point| ((point[0] + ahead) / 20.0).floor().min(2.0) + 1.0);
        let column = (Column::Queued, queued.collect());
        judge(&record(&points, &[column]), &path, &limits(), &MotionScript::default())
    };
    lawful(&judged(5.0));
    broken(&judged(1.0), Law::StoppingDistance);
    broken(&judged(-1.0), Law::StoppingDistance);
    let unknown = super::judged(&points, &path);
    assert!(matches!(unknown.of(Law::StoppingDistance), Some(Verdict::NotJudged(_))));
}
