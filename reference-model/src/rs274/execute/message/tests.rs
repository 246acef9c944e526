//! Tests active comments: their keywords, and the messages that they print.

use gaugeblock_vocabulary::{End, Event, Span};

use super::*;
use crate::rs274::refusal::Refusal;

/// The messages of a comment.
fn messages(comment: &str, state: &mut State) -> Vec<String> {
    let mut record = Record::new(state);
    let comment =
        Comment { text: comment.to_owned(), semicolon: false, span: Span { start: 0, end: 0 } };
    perform(&comment, state, &mut record).expect("no error");
    record.step_without_state(gaugeblock_vocabulary::BlockLocation::new("main.ngc", 1), state);
    let outcome =
        record.finish(End::ProgramEnd, gaugeblock_vocabulary::Indexed::default(), Vec::new());
    let events = outcome.steps.into_iter().flat_map(|step| step.events);
    events
        .filter_map(|event| match event {
            Event::Do(Effect::Message { text, .. }) => Some(text),
            Event::Do(_) | Event::Set(_) | Event::Unknown(_) => None,
        })
        .collect()
}

fn check_under(options: &[(&str, &str)], comment: &str, expect: &[&str]) {
    let mut state = State::under(options);
    state.parameters.store(31, 2.75);
    state.parameters.store(32, -0.3);
    assert_eq!(messages(comment, &mut state), expect, "{comment}");
}

fn check(comment: &str, expect: &[&str]) {
    check_under(&[], comment, expect);
}

#[test]
fn keywords_make_comments_active() {
    check("msg,a #31 %d", &["a #31 %d"]);
    check(" m\tS g , a", &[" a"]);
    check("a msg,b", &[]);
    check("message,a", &[]);
    check("msg a", &[]);
    check("debug,a", &["a"]);
    check("Print,a", &["a"]);
    check("log,a", &[]);
    check("", &[]);
    check(",", &[]);
    check_under(&[("active-comments.msg-without-comma", "message")], "msg a", &[" a"]);
    check_under(&[("rs274.message-blanks", "observed")], "m s g,a", &[]);
    check_under(&[("rs274.message-blanks", "observed")], " msg,a", &["a"]);
    check_under(&[("rs274.log-closed", "observed")], "log,a", &["a"]);
}

#[test]
fn parameters_are_shown() {
    check("print,#31/#32", &["2.750000/-0.300000"]);
    check("print,%d#31 %.1f#31 %f#31", &["3 2.8 2.7500"]);
    check("print,%d#32", &["0"]);
    check("print,#31a #[1] # ## #<", &["2.750000a #[1] # ## #<"]);
    check("print,#< _ Feed > #<a>!", &["0.000000 #!"]);
    check("print,#99999 #0", &["# #"]);
    check("print,%x %.10f % %", &["%x %.10f % %"]);
    check("print,é#31é", &["é2.750000é"]);
    check_under(&[("rs274.wrong-format-sign", "observed")], "print,%.10f %x", &[".10f %x"]);
    check_under(&[("active-comments.absent-name", "six-number-signs")], "print,#<a>", &["######"]);
    check_under(&[("active-comments.default-format", "four-decimals")], "print,#31", &["2.7500"]);
}

#[test]
fn a_log_file_is_opened_and_closed() {
    let mut state = State::under(&[]);
    assert!(messages("logopen, a.txt ", &mut state).is_empty());
    assert_eq!(messages("log,a #31", &mut state), ["a 0.000000"]);
    assert!(messages("log close", &mut state).is_empty());
    assert!(messages("log,a", &mut state).is_empty());
}

#[test]
fn debug_can_be_switched_off() {
    let mut state = State::under(&[]);
    state.parameters.store(parameters::DEBUG_SWITCH, 0.0);
    assert!(messages("debug,a", &mut state).is_empty());
    assert_eq!(messages("print,a", &mut state), ["a"]);
}

#[test]
fn settings_of_the_block_are_shown_new_or_old() {
    for (option, expect) in [("new", "7"), ("old", "0")] {
        let mut state = State::under(&[("active-comments.same-block-setting", option)]);
        state.parameters.announce(&[(Name::Numbered(31), 5.0), (Name::Numbered(31), 7.0)]);
        assert_eq!(messages("debug,%d#31", &mut state), [expect]);
    }
}

#[test]
fn abort_is_an_error_with_values() {
    let mut state = State::under(&[]);
    let mut record = Record::new(&state);
    let comment = Comment {
        text: "abort,a %d#5".to_owned(),
        semicolon: false,
        span: Span { start: 0, end: 0 },
    };
    let Err(StepError::Refused(Refusal { message, kind, .. })) =
        perform(&comment, &mut state, &mut record)
    else {
        panic!("it is refused");
    };
    assert_eq!((message.as_str(), kind), ("a 0", FaultKind::AbortedByProgram));
}

proptest::proptest! {
    #[test]
    fn no_comment_panics(text in "(print|msg|log|logopen|probeopen|m s g)?,?[-#<>%.dfl0-9a-z_\\[\\] \t\\PC]{0,40}") {
        let mut state = State::under(&[("active-comments.msg-without-comma", "message")]);
        drop(messages(&text, &mut state));
    }
}
