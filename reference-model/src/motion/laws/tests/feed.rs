//! How fast the path is passed.

use super::*;

fn along(feed: Feed, speed: f64) -> (ProgrammedPath, Vec<AxisVector>) {
    let path = path(within(0.01), feed, vec![line(30.0, 0.0)]);
    (path, Motion::default().to(30.0, 0.0, speed).samples())
}

/// Fault 7: a path speed 1 % over its feed.
#[test]
fn a_feed_that_is_too_high() {
    let (path, points) = along(Feed::PerSecond(50.0), 50.0);
    lawful(&judged(&points, &path));
    let (path, points) = along(Feed::PerSecond(50.0), 50.5);
    let message = broken(&judged(&points, &path), Law::Feed);
    assert!(message.contains("where 50 are"), "{message}");
}

/// Fault 8: a leg under inverse time that takes less than its time.
#[test]
fn inverse_time_is_the_least_time() {
    let (path, points) = along(Feed::InTime(0.5), 60.0);
    lawful(&judged(&points, &path));
    let (path, points) = along(Feed::InTime(0.5), 61.0);
    broken(&judged(&points, &path), Law::Feed);
}

/// Fault 9: a feed per turn that is faster than its spindle.
#[test]
fn a_feed_per_turn_follows_the_spindle() {
    let feed = Feed::PerTurn { spindle: 0, length: 2.0 };
    let (path, points) = along(feed, 40.0);
    let judged = |turns: f64| {
        let spindle = (Column::SpindleSpeed(0), vec![turns; points.len()]);
        judge(&record(&points, &[spindle]), &path, &limits(), &MotionScript::default())
    };
    lawful(&judged(20.0));
    broken(&judged(19.0), Law::Feed);
    let unknown = super::judged(&points, &path);
    assert!(matches!(unknown.of(Law::Feed), Some(Verdict::NotJudged(_))));
}

/// Fault 10: a feed override that is not followed.
#[test]
fn an_override_is_followed_within_what_braking_takes() {
    let (path, _) = along(Feed::PerSecond(100.0), 100.0);
    let lowered = script(&[(100, MotionAction::FeedOverride(0.5))]);
    let judged = |speed: f64| {
        let mut motion = Motion::default();
        motion.line(xy(9.0, 0.0), (0.0, 100.0, speed), 1900.0);
        motion.line(xy(30.0, 0.0), (speed, speed, 0.0), 1900.0);
        judge(&record(&motion.samples(), &[]), &path, &limits(), &lowered)
    };
    lawful(&judged(50.0));
    broken(&judged(51.0), Law::Feed);
}

#[test]
fn an_override_that_is_disabled_has_no_influence() {
    let (mut path, points) = along(Feed::PerSecond(50.0), 50.0);
    path.elements[0].controls.feed_override = false;
    let lowered = script(&[(0, MotionAction::FeedOverride(0.5))]);
    lawful(&judge(&record(&points, &[]), &path, &limits(), &lowered));
    path.elements[0].controls.feed_override = true;
    broken(&judge(&record(&points, &[]), &path, &limits(), &lowered), Law::Feed);
}

/// Fault 11: a rapid that does not follow the rapid override.
#[test]
fn a_rapid_follows_its_own_override() {
    let (path, points) = along(Feed::Rapid, 125.0);
    let judged = |factor| {
        let lowered = script(&[(0, MotionAction::RapidOverride(factor))]);
        judge(&record(&points, &[]), &path, &limits(), &lowered)
    };
    lawful(&judged(0.5));
    broken(&judged(0.4), Law::Feed);
}
