//! The forms of a path, of limits, of a script, and of samples.

use gaugeblock_vocabulary::motion::{
    Column, Controls, Feed, MotionAction, MotionEvent, MotionLimits, MotionScript, OutputChange,
    PathElement, PathMode, ProgrammedPath, Samples, Shape,
};
use gaugeblock_vocabulary::scenario::AxisLimits;
use gaugeblock_vocabulary::{Axis, BlockLocation, Pin, Position};
use proptest::prelude::*;

fn element(shape: Shape, feed: Feed, mode: PathMode) -> PathElement {
    let block = BlockLocation::new("main.ngc", 3);
    PathElement { block, shape, feed, mode, controls: Controls::default(), switches: Vec::new() }
}

fn path() -> ProgrammedPath {
    let end = Position { x: 1.0, c: 90.0, ..Position::default() };
    let output = OutputChange { pin: Pin::DigitalOut(2), value: 1.0 };
    let within = PathMode::Within { tolerance: 0.01, merge: 0.0 };
    let arc = Shape::Arc { end, centre: [0.5, 0.0, 0.0], normal: [0.0, 0.0, 1.0], angle: -180.0 };
    let turn = Feed::PerTurn { spindle: 0, length: 0.1 };
    let wait = Shape::Wait { for_what: "tool change".to_owned() };
    let mut elements = vec![
        element(Shape::Straight { end }, Feed::PerSecond(0.1), within),
        element(arc, turn, PathMode::ExactPath),
        element(Shape::Probe { end, contact: Some(end) }, Feed::InTime(30.0), PathMode::ExactStop),
        element(Shape::Curve { end }, Feed::Rapid, PathMode::BetweenMidpoints),
        element(Shape::Dwell { seconds: 0.5 }, Feed::Rapid, within),
        element(wait, Feed::Rapid, within),
        element(Shape::AtOnce(output), Feed::Rapid, within),
    ];
    elements[0].switches.push(output);
    ProgrammedPath { start: Position::default(), elements, never: vec![output] }
}

#[test]
fn a_path_comes_back_equal_in_toml_and_json() {
    let path = path();
    assert_eq!(ProgrammedPath::from_text(&path.to_text().unwrap()).unwrap(), path);
    let json = serde_json::to_string(&path).unwrap();
    assert_eq!(serde_json::from_str::<ProgrammedPath>(&json).unwrap(), path);
}

#[test]
fn limits_come_back_equal() {
    let limit =
        AxisLimits { velocity: Some(250.0), acceleration: Some(2000.0), ..AxisLimits::default() };
    let limits = MotionLimits { period: 0.001, axes: [(Axis::X, limit)].into() };
    assert_eq!(MotionLimits::from_text(&limits.to_text().unwrap()).unwrap(), limits);
}

#[test]
fn a_script_comes_back_equal() {
    let actions = [
        MotionAction::FeedOverride(0.5),
        MotionAction::RapidOverride(0.1),
        MotionAction::AdaptiveFeed(-1.0),
        MotionAction::FeedStop(true),
        MotionAction::Hold(false),
        MotionAction::SpindleSpeed { spindle: 0, turns: 20.0 },
        MotionAction::Abort,
    ];
    let events =
        (0..).step_by(10).zip(actions).map(|(cycle, action)| MotionEvent { cycle, action });
    let script = MotionScript { events: events.collect() };
    assert_eq!(MotionScript::from_text(&script.to_text().unwrap()).unwrap(), script);
}

#[test]
fn what_no_limits_or_script_can_be_is_refused() {
    let limits = |text: &str| MotionLimits::from_text(text).unwrap_err().to_string();
    assert!(limits("period = 0.0\naxes = {}").contains("period"));
    assert!(limits("period = inf\naxes = {}").contains("finite"));
    assert!(limits("period = 0.001\naxes = { x = { velocity = -1.0 } }").contains("velocity of x"));
    assert!(limits("period = 0.001\naxes = { q = {} }").contains("line"));
    let events =
        "[[events]]\ncycle = 5\naction = \"abort\"\n[[events]]\ncycle = 4\naction = \"abort\"\n";
    let script = |text: &str| MotionScript::from_text(text).unwrap_err().to_string();
    assert!(script(events).contains("event 2"));
    let single = |action: &str| script(&format!("events = [{{ cycle = 5, action = {action} }}]"));
    assert!(single("{ feed_override = -3.0 }").contains("event 1: an override of -3"));
    assert!(single("{ rapid_override = -0.1 }").contains("event 1"));
    assert!(single("{ feed_override = nan }").contains("finite"));
}

fn columns() -> Vec<Column> {
    vec![
        Column::Position(Axis::X),
        Column::Position(Axis::W),
        Column::Element,
        Column::Line,
        Column::Queued,
        Column::Output(Pin::AnalogOut(3)),
        Column::SpindleSpeed(1),
    ]
}

fn samples(rows: &[[f64; 4]]) -> Samples {
    let mut samples = Samples::new(0.001, 1e-9, columns()).expect("columns differ");
    for [x, w, out, turns] in rows {
        let row = [*x, *w, 4.0, 17.0, 20.0, *out, *turns];
        samples.push(&row).expect("there is a value for each column");
    }
    samples
}

proptest! {
    #[test]
    fn samples_come_back_bit_by_bit(rows in prop::collection::vec(prop::array::uniform4(-1e12..1e12), 0..20)) {
        let samples = samples(&rows);
        prop_assert_eq!(&Samples::from_csv(&samples.to_csv()).unwrap(), &samples);
        prop_assert_eq!(&Samples::from_bytes(&samples.to_bytes()).unwrap(), &samples);
    }

    #[test]
    fn a_byte_that_changed_is_noticed(place in 0_usize..300, change in 1_u8..) {
        let mut bytes = samples(&[[0.5, 1.0, 0.0, 20.0]; 3]).to_bytes();
        let place = place % bytes.len();
        bytes[place] ^= change;
        prop_assert!(Samples::from_bytes(&bytes).is_err());
    }

    #[test]
    fn no_bytes_and_no_text_are_a_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        prop_assert!(Samples::from_bytes(&bytes).is_err());
        prop_assert!(Samples::from_csv(&String::from_utf8_lossy(&bytes)).is_err());
    }
}

#[test]
fn unrecorded_axis_keeps_its_given_position() {
    let elsewhere = Position { x: 9.0, y: 7.0, ..Position::default() };
    let position = samples(&[[1.0, 2.0, 0.0, 0.0]]).positions(elsewhere)[0];
    assert_eq!(position, Position { x: 1.0, y: 7.0, w: 2.0, ..Position::default() });
}

#[test]
fn a_table_that_is_none_says_where() {
    let head = "# gaugeblock samples 0 period=0.001 resolution=0\n";
    let refused = [
        (String::new(), "end of file: "),
        ("x,y\n".to_owned(), "line 1: "),
        (head.replace("0.001", "0") + "x\n", "line 1: a period of 0"),
        (head.to_owned(), "end of file: the line of the columns"),
        (format!("{head}x,q\n"), "line 2: there is no column named q"),
        (format!("{head}x,x\n"), "line 2: the column x occurs twice"),
        (format!("{head}x\n1\nnan\n"), "line 4: x is NaN"),
        (format!("{head}x\n1\n\n"), "line 4: not a number"),
        (format!("{head}x,y\n1\n"), "line 3: 1 values for 2 columns"),
        (format!("{head}element\n0.5\n"), "line 3: element is 0.5"),
        (format!("{head}digital_out[01]\n"), "line 2: "),
    ];
    for (text, wanted) in refused {
        let error = Samples::from_csv(&text).unwrap_err().to_string();
        assert!(error.starts_with(wanted), "{text}: {error}");
    }
}

#[test]
fn bytes_that_are_cut_short_say_where() {
    let bytes = samples(&[[1.0, 2.0, 0.0, 0.0]; 2]).to_bytes();
    for length in 0..bytes.len() {
        let error = Samples::from_bytes(&bytes[..length]).unwrap_err();
        assert!(error.place.starts_with("byte "), "{error}");
    }
}
