//! Paths of whole programs, run by the model.

use gaugeblock_vocabulary::motion::{
    Feed, OutputChange, PathElement, PathMode, ProgrammedPath, Shape,
};
use gaugeblock_vocabulary::{Axis, Pin, Position, Scenario};

use super::{differ, programmed};
use crate::math;

fn path_of(program: &str) -> ProgrammedPath {
    let mut scenario = Scenario::of(program);
    scenario.machine.axes = Axis::ALL.to_vec();
    let (outcome, _) = crate::run(&scenario);
    assert_eq!(outcome.end, gaugeblock_vocabulary::End::ProgramEnd, "{program}");
    programmed(&outcome, Position::default())
}

fn ends(path: &ProgrammedPath) -> Vec<Position> {
    path.elements.iter().filter_map(PathElement::end).collect()
}

#[track_caller]
fn close(a: Position, b: Position) {
    let apart =
        a.to_array().iter().zip(b.to_array()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(apart < 1e-9, "{a} is not {b}");
}

fn at(x: f64, y: f64, z: f64) -> Position {
    Position { x, y, z, ..Position::default() }
}

#[test]
fn offsets_rotation_and_units_are_resolved() {
    let path = path_of(
        "g21 g10 l2 p1 x10 y20 r90\ng92 x0 y0\ng92.1\ng43.1 z5\ng0 x1 y2\ng20\ng1 x1 y0 z-1 a90 f60\nm2\n",
    );
    let ends = ends(&path);
    close(ends[0], at(8.0, 21.0, 0.0));
    close(ends[1], Position { a: 90.0, ..at(10.0, 45.4, -25.4 + 5.0) });
    assert_eq!(path.elements[0].feed, Feed::Rapid);
    assert_eq!(path.elements[1].feed, Feed::PerSecond(25.4));
}

#[test]
fn an_axis_without_a_word_does_not_move() {
    let path = path_of("g21 g52 x0.1 y0.7\ng10 l2 p1 r33\ng1 f60 x1 y0.3\ng52 x0.3 y0.1\nz1\nm2\n");
    let ends = ends(&path);
    assert_eq!((ends[0].z.to_bits(), ends[1].c.to_bits()), (0.0_f64.to_bits(), 0.0_f64.to_bits()));
}

#[test]
fn feeds_are_per_second_in_time_and_per_turn() {
    let path = path_of(
        "g21 m3 s100 g93 g1 x1 f2\ng94 f120 x2\nf360 a1\ng95 f0.5 x3\ng94 g33 x4 k1.5\ng20\ng1 f60 b9\nm2\n",
    );
    let feeds: Vec<Feed> = path
        .elements
        .iter()
        .filter(|element| element.end().is_some())
        .map(|element| element.feed)
        .collect();
    assert_eq!(
        feeds,
        [
            Feed::InTime(30.0),
            Feed::PerSecond(2.0),
            Feed::PerSecond(6.0),
            Feed::PerTurn { spindle: 0, length: 0.5 },
            Feed::PerTurn { spindle: 0, length: 1.5 },
            Feed::PerSecond(1.0),
        ]
    );
}

#[test]
fn modes_carry_their_tolerances() {
    let path =
        path_of("g20 g1 f60 x1\ng61 x2\ng61.1 x3\ng64 p0.1 x4\ng64 p0.1 q0 x5\ng64 p0 x6\nm2\n");
    let modes: Vec<PathMode> = path
        .elements
        .iter()
        .filter(|element| element.end().is_some())
        .map(|element| element.mode)
        .collect();
    let within = |merge| PathMode::Within { tolerance: 0.1 * 25.4, merge };
    assert_eq!(
        modes,
        [
            PathMode::BetweenMidpoints,
            PathMode::ExactPath,
            PathMode::ExactStop,
            within(0.1 * 25.4),
            within(0.0),
            PathMode::BetweenMidpoints,
        ]
    );
}

fn arc(program: &str) -> (Position, [f64; 3], [f64; 3], f64) {
    let path = path_of(program);
    let found = path.elements.iter().find_map(|element| {
        let Shape::Arc { end, centre, normal, angle } = element.shape else { return None };
        Some((end, centre, normal, angle))
    });
    found.unwrap_or_else(|| panic!("no arc: {:?}", path.elements))
}

#[test]
fn arcs_lie_in_their_plane_and_turn_with_the_system() {
    let (end, centre, normal, angle) = arc("g21 g10 l2 p1 x1 r90\ng0 x0 y0\ng3 x5 y5 i5 f60\nm2\n");
    close(end, at(-4.0, 5.0, 0.0));
    assert!((normal[2] - 1.0).abs() < 1e-12, "{normal:?}");
    assert!((centre[1] - 5.0).abs() < 1e-12 && (centre[0] - 1.0).abs() < 1e-12, "{centre:?}");
    assert!((angle - 270.0).abs() < 1e-9, "{angle}");
    let (_, _, normal, angle) = arc("g21 g18 g2 x5 z-5 k-5 f60\nm2\n");
    assert!((normal[1] - 1.0).abs() < 1e-12, "{normal:?}");
    assert!((angle + 270.0).abs() < 1e-9, "{angle}");
    let (_, _, normal, _) = arc("g21 g19 g10 l2 p1 r90\ng2 y5 z-5 k-5 f60\nm2\n");
    assert!((normal[1] - 1.0).abs() < 1e-12, "{normal:?}");
}

#[test]
fn turns_and_full_circles_count() {
    for (program, wanted) in [
        ("g2 i5 f60", -360.0),
        ("g3 i5 f60", 360.0),
        ("g3 i5 p3 f60", 1080.0),
        ("g3 x5 y-5 i5 f60", 90.0),
        ("g3 x5 y-5 i5 p2 f60", 450.0),
        ("g2 x5 y-5 z9 i5 p2 f60", -630.0),
        ("g3 x10 i5 f60", 180.0),
    ] {
        let (_, _, _, angle) = arc(&format!("g21\n{program}\nm2\n"));
        assert!((angle - wanted).abs() < 1e-9, "{program}: {angle}");
    }
}

#[test]
fn outputs_wait_for_motion_and_the_latest_setting_counts() {
    let path = path_of("g21 g1 f60 x1\nm62 p0\nm63 p0\nm67 e1 q5\nx2\nm64 p2\nx3\nm62 p0\nm2\n");
    let pin = |pin, value| OutputChange { pin, value };
    assert_eq!(
        path.elements[1].switches,
        [pin(Pin::DigitalOut(0), 0.0), pin(Pin::AnalogOut(1), 5.0)]
    );
    assert_eq!(path.elements[2].shape, Shape::AtOnce(pin(Pin::DigitalOut(2), 1.0)));
    assert_eq!(path.never, [pin(Pin::DigitalOut(0), 1.0)]);
}

#[test]
fn what_breaks_the_path_is_an_element() {
    let path = path_of("g21 g1 f60 x1\ng4 p0.5\nx2\nm66 p0 l0\nx3\nm2\n");
    let names: Vec<String> = path
        .elements
        .iter()
        .filter(|element| element.end().is_none())
        .map(|element| format!("{:?}", element.shape))
        .collect();
    assert!(names[0].contains("Dwell") && names[1].contains("wait_input"), "{names:?}");
}

#[track_caller]
fn same(one: &str, other: &str) {
    assert_eq!(differ(&path_of(one), &path_of(other), 1e-3), None, "{one}\n{other}");
}

#[track_caller]
fn different(one: &str, other: &str, words: &str) {
    let difference = differ(&path_of(one), &path_of(other), 1e-3).expect("they are different");
    assert!(difference.words.contains(words), "{difference:?}");
}

#[test]
fn a_split_move_is_the_same_path() {
    same("g21 g64 p1 g1 f60 x10\nm2\n", "g21 g64 p1 g1 f60 x3\nx3\nx10\nm2\n");
    same("g21 g1 f60 x25.4\nm2\n", "g20\ng1 f[60/25.4] x1\nm2\n");
    same("g21 g10 l2 p1 x5\ng1 f60 x0\nm2\n", "g21 g1 f60 x5\nm2\n");
}

#[test]
fn chords_within_the_tolerance_are_the_arc() {
    let mut chords = "g21 g61 g1 f60\n".to_owned();
    for part in 1..=400_u32 {
        let angle = f64::from(part) / 400.0 * 270.0;
        chords += &format!(
            "x{:.9} y{:.9}\n",
            5.0 - 5.0 * math::cosine_of_degrees(angle),
            -5.0 * math::sine_of_degrees(angle)
        );
    }
    same("g21 g61 g3 x5 y5 i5 f60\nm2\n", &format!("{chords}m2\n"));
    different(
        "g21 g61 g3 x5 y5 i5.05 r-5.02 f60\nm2\n".replace(" i5.05", "").as_str(),
        &format!("{chords}m2\n"),
        "elsewhere",
    );
}

#[test]
fn what_is_not_the_same_path_says_where() {
    let base = "g21 g1 f60 x10\ng4 p1\nx20 y1\nm2\n";
    different(base, "g21 g1 f60 x10\ng4 p1\nx20 y2\nm2\n", "elsewhere");
    different(base, "g21 g1 f60 x10\ng4 p2\nx20 y1\nm2\n", "Dwell");
    different(base, "g21 g1 f60 x10\nx20 y1\nm2\n", "elsewhere");
    different(base, "g21 g1 f90 x10\ng4 p1\nx20 y1\nm2\n", "PerSecond");
    different(base, "g21 g61 g1 f60 x10\ng4 p1\nx20 y1\nm2\n", "ExactPath");
    different(base, "g21 m62 p1 g1 f60 x10\ng4 p1\nx20 y1\nm2\n", "outputs");
    different(base, "g21 g1 f60 x10\ng4 p1\nm2\n", "is not");
    different("g21 g61.1 g1 f60 x10\nm2\n", "g21 g61.1 g1 f60 x5\nx10\nm2\n", "");
    // A loop is no shorter way.
    different("g21 g61 g1 f60 x10\ny5\nx0\ny0\nx5\nm2\n", "g21 g61 g1 f60 x5\nm2\n", "elsewhere");
}
