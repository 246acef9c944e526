//! Objects that name their variant in a member: wherever it stands, the same is read.

use gaugeblock_vocabulary::{Effect, End, Position, State};
use serde::de::DeserializeOwned;

fn read<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    serde_json::from_str(text).map_err(|error| error.to_string())
}

#[test]
fn name_may_be_anywhere() {
    let end = Position { x: 1.5, ..Position::default() };
    let expected = Ok(Effect::ArcFeed { end, first_centre: 0.1, second_centre: -2.0, turns: -1 });
    for text in [
        r#"{"effect":"arc_feed","end":{"x":1.5},"first_centre":0.1,"second_centre":-2,"turns":-1}"#,
        r#"{"end":{"x":1.5},"first_centre":0.1,"effect":"arc_feed","second_centre":-2,"turns":-1}"#,
        r#"{"turns":-1,"end":{"x":1.5},"first_centre":0.1,"second_centre":-2,"effect":"arc\u005ffeed"}"#,
    ] {
        assert_eq!(read(text), expected, "{text}");
    }
    assert_eq!(
        read(r#"{"bound":"steps","end":"budget_exhausted"}"#),
        read::<End>(r#"{"end":"budget_exhausted","bound":"steps"}"#)
    );
    assert_eq!(
        read(r#"{"tool":5,"language":"rs274"}"#),
        read::<State>(r#"{"language":"rs274","tool":5}"#)
    );
    assert_eq!(read(r#"{"end":"paused"}"#), Ok(End::Paused));
}

#[test]
fn invalid_input_is_reported() {
    for (text, why) in [
        (r#"{"effect":"dance"}"#, "unknown variant `dance`"),
        (r#"{"seconds":1,"effect":"dance"}"#, "unknown variant `dance`"),
        (r#"{"effect":"dwell"}"#, "missing field `seconds`"),
        (r#"{"effect":"dwell","seconds":1,"more":2}"#, "unknown field `more`"),
        (r#"{"more":2,"effect":"dwell","seconds":1}"#, "unknown field `more`"),
        (r#"{"effect":"dwell","seconds":1,"effect":"dwell"}"#, "unknown field `effect`"),
        (r#"{"seconds":1,"effect":"dwell","effect":"dwell"}"#, "duplicate field `effect`"),
        (r#"{"effect":"dwell","seconds":1,"seconds":1}"#, "duplicate field `seconds`"),
        (r#"{"seconds":1}"#, "missing field `effect`"),
        (r#"{"effect":5,"seconds":1}"#, "invalid type: integer `5`"),
        (r#"{}"#, "missing field `effect`"),
        (r#"["dwell",1]"#, "an object with `effect`"),
    ] {
        let error = read::<Effect>(text).expect_err(text);
        assert!(error.contains(why), "{text}: {error}");
    }
    for text in [r#"{"end":"paused","more":1}"#, r#"{"more":1,"end":"paused"}"#] {
        assert!(read::<End>(text).is_err(), "{text}");
    }
}
