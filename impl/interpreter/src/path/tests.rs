//! Tests the resolver: settings and effects become path segments in machine coordinates.

use gaugeblock_vocabulary::Position;

use super::*;

/// A resolver under settings, at the machine's origin.
fn under(settings: &Settings) -> Resolver {
    let mut resolver = Resolver::new([0.0; 9]);
    resolver.set(settings);
    resolver
}

fn at(x: f64, y: f64, z: f64) -> Position {
    Position { x, y, z, ..Position::default() }
}

/// The segment that an effect asks for.
fn segment(resolver: &mut Resolver, effect: &Effect) -> Segment {
    let asked = resolver.resolve(1, effect);
    let MotionRequest::Move(segment) = asked else { panic!("{effect:?} asks {asked:?}") };
    segment
}

fn near(left: &[f64], right: &[f64]) {
    let apart = left.iter().zip(right).any(|(left, right)| (left - right).abs() > 1e-12);
    assert!(!apart && left.len() == right.len(), "{left:?} is not {right:?}");
}

#[test]
fn offsets_turn_and_add_in_the_order_of_the_coordinate_systems() {
    let mut resolver = under(&Settings {
        g92_offset: Some(at(1.0, 0.0, 0.0)),
        rotation: Some(90.0),
        g5x_offset: Some(at(10.0, 20.0, 30.0)),
        tool_offset: Some(at(0.0, 0.0, 5.0)),
        ..Settings::default()
    });
    let moved = segment(&mut resolver, &Effect::StraightTraverse { end: at(2.0, 0.0, 0.0) });
    let Path::Straight { end } = moved.path else { panic!("{moved:?}") };
    near(&end[..3], &[10.0, 23.0, 35.0]);
    assert_eq!(moved.feed, Feed::Rapid);
    near(&resolver.position(), &end);
}

#[test]
fn degrees_are_degrees_in_inches_too() {
    let mut resolver = under(&Settings {
        units: Some(LengthUnit::Inch),
        feed_rate: Some(60.0),
        ..Settings::default()
    });
    let turned = Position { a: 90.0, ..Position::default() };
    assert_eq!(
        segment(&mut resolver, &Effect::StraightFeed { end: turned }).feed,
        Feed::PerSecond(1.0)
    );
    let moved = Position { u: 1.0, ..turned };
    assert_eq!(
        segment(&mut resolver, &Effect::StraightFeed { end: moved }).feed,
        Feed::PerSecond(25.4)
    );
}

#[test]
fn feeds_are_by_minute_time_or_turn() {
    let end = at(1.0, 0.0, 0.0);
    let feed = |mode, rate| {
        let settings =
            Settings { feed_mode: Some(mode), feed_rate: Some(rate), ..Settings::default() };
        segment(&mut under(&settings), &Effect::StraightFeed { end }).feed
    };
    assert_eq!(feed(FeedMode::PerMinute, 30.0), Feed::PerSecond(0.5));
    assert_eq!(feed(FeedMode::InverseTime, 2.0), Feed::InTime(30.0));
    assert_eq!(feed(FeedMode::PerRevolution, 0.2), Feed::PerTurn(0.2));
}

#[test]
fn a_thread_follows_the_spindle_until_it_ends() {
    let mut resolver = under(&Settings { feed_rate: Some(60.0), ..Settings::default() });
    let start = Effect::StartSpindleSynchronisation { spindle: 0, pitch: 1.5 };
    assert_eq!(resolver.resolve(1, &start), MotionRequest::Rest);
    let cut = segment(&mut resolver, &Effect::StraightFeed { end: at(0.0, 0.0, -9.0) });
    assert_eq!(cut.feed, Feed::PerTurn(1.5));
    resolver.resolve(1, &Effect::StopSpindleSynchronisation {});
    let back = segment(&mut resolver, &Effect::StraightFeed { end: at(0.0, 0.0, 0.0) });
    assert_eq!(back.feed, Feed::PerSecond(1.0));
}

/// An arc from the origin: plane, end, centre along the first and the second axis, turns; its centre, the axis of its
/// normal, its angle.
struct Bend(Plane, [f64; 3], [f64; 2], i32, [f64; 3], usize, f64);

#[test]
fn arcs_lie_in_the_plane_and_go_the_way_of_their_sign() {
    use core::f64::consts::{FRAC_PI_2, PI, TAU};
    let cases = [
        Bend(Plane::Xy, [1.0, 1.0, 0.0], [1.0, 0.0], -1, [1.0, 0.0, 0.0], 2, -FRAC_PI_2),
        Bend(Plane::Xy, [1.0, 1.0, 0.0], [1.0, 0.0], 1, [1.0, 0.0, 0.0], 2, 1.5 * PI),
        Bend(Plane::Xy, [0.0, 0.0, -4.0], [5.0, 0.0], -3, [5.0, 0.0, -4.0], 2, -3.0 * TAU),
        Bend(Plane::Xy, [10.0, 0.0, 0.0], [5.0, 0.0], 2, [5.0, 0.0, 0.0], 2, 3.0 * PI),
        // First axis Z, second axis X.
        Bend(Plane::Zx, [1.0, 0.0, 1.0], [0.0, 1.0], 1, [1.0, 0.0, 0.0], 1, FRAC_PI_2),
        Bend(Plane::Yz, [0.0, 1.0, 1.0], [1.0, 0.0], -1, [0.0, 1.0, 0.0], 0, -FRAC_PI_2),
    ];
    for Bend(plane, [x, y, z], [first_centre, second_centre], turns, centre, normal, angle) in cases
    {
        let mut resolver = under(&Settings { plane: Some(plane), ..Settings::default() });
        let effect = Effect::ArcFeed { end: at(x, y, z), first_centre, second_centre, turns };
        let path = segment(&mut resolver, &effect).path;
        let Path::Arc { centre: is_centre, normal: is_normal, angle: is_angle, .. } = path else {
            panic!("{effect:?} is no arc");
        };
        near(&is_centre, &centre);
        let mut unit = [0.0; 3];
        unit[normal] = 1.0;
        near(&is_normal, &unit);
        near(&[is_angle], &[angle]);
    }
}

#[test]
fn a_turned_system_turns_the_axis_of_an_arc() {
    let mut resolver = under(&Settings {
        plane: Some(Plane::Zx),
        rotation: Some(90.0),
        feed_rate: Some(60.0),
        ..Settings::default()
    });
    let effect =
        Effect::ArcFeed { end: at(1.0, 0.0, 1.0), first_centre: 0.0, second_centre: 1.0, turns: 1 };
    let Path::Arc { centre, normal, angle, .. } = segment(&mut resolver, &effect).path else {
        panic!()
    };
    near(&centre, &[0.0, 1.0, 0.0]);
    near(&normal, &[-1.0, 0.0, 0.0]);
    near(&[angle], &[core::f64::consts::FRAC_PI_2]);
}

#[test]
fn outputs_wait_for_the_next_move_or_for_rest() {
    let mut resolver = Resolver::new([0.0; 9]);
    let output = |timing| Effect::SetDigitalOutput { output: 2, on: true, timing };
    let switch = OutputSwitch { output: 2, value: 1.0 };
    assert_eq!(
        resolver.resolve(1, &output(OutputTiming::WithMotion)),
        MotionRequest::WithNextMove(switch)
    );
    assert_eq!(resolver.resolve(1, &output(OutputTiming::AtOnce)), MotionRequest::Rest);
}

#[test]
fn point_after_a_probe_is_its_contact() {
    let mut resolver = under(&Settings { feed_rate: Some(60.0), ..Settings::default() });
    let effect =
        Effect::StraightProbe { end: at(0.0, 0.0, -9.0), contact: Some(at(0.0, 0.0, -3.0)) };
    assert!(segment(&mut resolver, &effect).probing);
    near(&resolver.position()[..3], &[0.0, 0.0, -3.0]);
}
