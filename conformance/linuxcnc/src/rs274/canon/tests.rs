//! Calls as the program prints them, and what they come to.

use gaugeblock_vocabulary::{Effect, Event, Machine, Position, Tool};

use super::super::output::Call;
use super::{Canon, Mark};

/// A canon whose machine has the tools 4 and 9.
fn canon() -> Canon {
    let tool = |number| Tool { number, ..Tool::default() };
    Canon::new(&Machine { tools: vec![tool(4), tool(9)], ..Machine::default() })
}

/// What calls come to, in the text form of outcomes.
fn events(canon: &mut Canon, calls: &[&str]) -> Vec<String> {
    for call in calls {
        let (name, arguments) =
            call.strip_suffix(')').and_then(|call| call.split_once('(')).unwrap();
        let call = Call { name: name.to_owned(), arguments: arguments.to_owned() };
        assert_eq!(canon.call(&call), Ok(Mark::None), "{name}");
    }
    let text = |event: &Event| match event {
        Event::Unknown(fields) => fields.join(" "),
        Event::Set(settings) => {
            let entries = settings.entries();
            let texts: Vec<_> =
                entries.iter().map(|e| format!("{}={}", e.name(), e.value)).collect();
            texts.join(" ")
        }
        Event::Do(effect) => {
            let arguments = effect.arguments();
            let texts = arguments.iter().map(|(name, value)| format!(" {name}={value}"));
            effect.name().to_owned() + &texts.collect::<String>()
        }
    };
    canon.take_events().iter().map(text).collect()
}

#[test]
fn each_call_is_a_setting_or_an_effect() {
    for (call, expected) in [
        ("SET_FEED_RATE(12.5000)", "feed_rate=12.5"),
        ("SELECT_PLANE(CANON_PLANE_XZ)", "plane=zx"),
        (
            "SET_G5X_OFFSET(2, 1.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)",
            "work_offset=2 g5x_offset=(x1)",
        ),
        ("SET_XY_ROTATION(45.0000)", "rotation=45"),
        (
            "SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, 0.100000)",
            "path=continuous blend_tolerance=0.1",
        ),
        ("SET_MOTION_CONTROL_MODE(CANON_EXACT_STOP)", "path=exact_stop"),
        (
            "USE_TOOL_LENGTH_OFFSET(0.0000 0.0000 2.0000, 0.0000 0.0000 0.0000, 0.0000 0.0000 1.0000)",
            "tool_offset=(z2 w1)",
        ),
        ("SET_SPINDLE_SPEED(1, 300.0000)", "spindle_speed[1]=300"),
        ("SET_SPINDLE_MODE(0 200.0000)", "spindle_mode[0]=surface_speed spindle_limit[0]=200"),
        (
            "SET_SPINDLE_MODE(2 1000000000000000019884624838656.0000)",
            "spindle_mode[2]=surface_speed spindle_limit[2]=none",
        ),
        ("START_SPINDLE_COUNTERCLOCKWISE(0)", "spindle[0]=counterclockwise"),
        ("DISABLE_SPEED_OVERRIDE(2)", "speed_override[2]=off"),
        ("DISABLE_FEED_HOLD()", "feed_stop=off"),
        ("MIST_ON()", "mist=on"),
        (
            "COMMENT(\"interpreter: IJK distance mode changed to absolute\")",
            "arc_distance=absolute",
        ),
        ("COMMENT(\"interpreter: feed mode set to inverse time\")", "feed_mode=inverse_time"),
        (
            "SET_TOOL_TABLE_ENTRY(1, 4, 0.1000 0.0000 2.0000 0.0000 0.0000 0.0000 0.0000 0.0000 0.0000, 10.0000, 20.0000, 3)",
            "set_tool_entry tool=4 offset=(x0.1 z2) diameter=0 front_angle=10 back_angle=20 orientation=3",
        ),
        ("DWELL(0.5000)", "dwell seconds=0.5"),
        ("MESSAGE(\"a \"b\"\")", "message channel=display text=\"a \\\"b\\\"\""),
        ("LOGAPPEND(\"a.txt\")", "log_open file=\"a.txt\" append=yes"),
        ("SELECT_TOOL(9)", "prepare_tool tool=9"),
        ("CHANGE_TOOL(2)", "change_tool tool=9"),
        ("CHANGE_TOOL(0)", "change_tool tool=0"),
        ("OPTIONAL_PROGRAM_STOP()", "stop optional=yes"),
        ("CLEAR_AUX_OUTPUT_BIT(2)", "set_digital_output output=2 on=no timing=at_once"),
        (
            "SET_MOTION_OUTPUT_VALUE(1,2.500000)",
            "set_analog_output output=1 to=2.5 timing=with_motion",
        ),
        ("SPINDLE.1.WAIT_ORIENT_COMPLETE(3.0000)", "wait_orient spindle=1 timeout=3"),
    ] {
        assert_eq!(events(&mut canon(), &[call]), [expected], "{call}");
    }
}

#[test]
fn unrelated_calls_are_ignored() {
    let calls = [
        "ON_RESET()",
        "START_CHANGE()",
        "SET_FEED_REFERENCE(CANON_XYZ)",
        "SET_TOOL_TABLE_ENTRY(0, 4, 0.1 0 2 0 0 0 0 0 0, 0, 0, 0)",
        "COMMENT(\"hello\")",
        "TURN_PROBE_OFF()",
    ];
    assert!(events(&mut canon(), &calls).is_empty());
}

#[test]
fn repeated_setting_is_not_an_event() {
    assert_eq!(
        events(&mut canon(), &["MIST_ON()", "MIST_ON()", "DWELL(1.0000)", "MIST_ON()"]).len(),
        2
    );
}

#[test]
fn arcs_lie_in_their_plane() {
    let arc = "ARC_FEED(1.0000, 2.0000, 3.0000, 4.0000, -1, 5.0000, 0.0000, 0.0000, 0.0000)";
    for (plane, end) in [("XY", "(x1 y2 z5)"), ("XZ", "(x2 y5 z1)"), ("YZ", "(x5 y1 z2)")] {
        let select = format!("SELECT_PLANE(CANON_PLANE_{plane})");
        let events = events(&mut canon(), &[&select, arc]);
        assert_eq!(
            events[1],
            format!("arc_feed end={end} first_centre=3 second_centre=4 turns=-1")
        );
    }
}

#[test]
fn what_is_unknown_is_an_error() {
    let call = |name: &str, arguments: &str| {
        canon().call(&Call { name: name.to_owned(), arguments: arguments.to_owned() })
    };
    assert!(call("SOMETHING_NEW", "1").is_err());
    assert!(call("DWELL", "soon").is_err());
    assert!(call("CHANGE_TOOL", "3").is_err());
    assert!(call("ARC_FEED", "1, 2").is_err());
    assert_eq!(call("PROGRAM_END", ""), Ok(Mark::ProgramEnd));
    assert!(call("SET_TOOL_TABLE_ENTRY", "1, 1").is_err());
}

#[test]
fn a_spline_ends_where_its_block_does() {
    let mut canon = Canon::new(&Machine::default());
    let call = Call { name: "NURBS_FEED".to_owned(), arguments: "4, ...".to_owned() };
    assert_eq!(canon.call(&call).unwrap(), Mark::None);
    let end = Position { x: 1.0, y: 2.0, ..Position::default() };
    canon.arrived(end);
    assert_eq!(canon.take_events(), [Event::Do(Effect::NurbsFeed { points: 4, end })]);
}
