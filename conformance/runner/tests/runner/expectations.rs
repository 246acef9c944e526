//! Files of expectations: they are read and written, and keep their reasons.

use gaugeblock_runner::certify::EXPECTATIONS;
use gaugeblock_runner::expectations::Expectations;

const FILE: &str = r#"controller = "mill"
version = "1"
edition = "linuxcnc-2.9"

[reasons]
no-arc-checks = """
The controller checks neither the radius of an arc nor its centre, because its vendor leaves both to the program that \
makes the paths; the manual of the mill says so under \"Arcs\"."""

[[known]]
rule = "arcs.radius"
case = "too small"
found = "program end"
reason = "no-arc-checks"

[[known]]
rule = "coolant.mist"
case = "alone"
found = "mist = off"
reason = "There is no mist."

[[known]]
rule = "feed.rate"
case = "none"
found = "program end"
"#;

#[test]
fn file_with_reasons_is_written_as_it_was_read() {
    let read = Expectations::read(FILE).expect("a file of expectations");
    assert_eq!(read.to_text().expect("a text"), FILE);
    let arcs = read.reason("arcs.radius", "too small").expect("its reason");
    assert!(arcs.starts_with("The controller checks ") && arcs.ends_with("under \"Arcs\"."));
    assert_eq!(read.reason("coolant.mist", "alone"), Some("There is no mist."));
    assert_eq!(read.reason("feed.rate", "none"), None);
    assert_eq!(read.source("feed.rate", "none"), EXPECTATIONS);
}

#[test]
fn reasons_are_kept_by_rule_and_case() {
    let earlier = Expectations::read(FILE).expect("a file of expectations");
    let mut now = earlier.clone();
    now.reasons.clear();
    now.known.iter_mut().for_each(|known| known.reason = None);
    now.known[1].found = "mist = on".to_owned();
    let notes = now.keep_reasons(&earlier);
    assert_eq!(notes, ["the difference of coolant.mist / alone has changed: check its reason"]);
    now.known[1].found = "mist = off".to_owned();
    assert_eq!(now, earlier);
    // A shared reason goes with the last divergence that has it.
    now.known.remove(0);
    now.known.iter_mut().for_each(|known| known.reason = None);
    now.reasons.clear();
    assert!(now.keep_reasons(&earlier).is_empty() && now.reasons.is_empty());
}

#[test]
fn invalid_reason_is_an_error() {
    for (old, new, message) in [
        ("= \"no-arc-checks\"", "= \"no-checks\"", "expected a sentence, or a name in [reasons]"),
        ("There is no mist.", "", "expected a sentence, or a name in [reasons]"),
        ("reason = \"no-arc-checks\"\n", "", "unused reason: no-arc-checks"),
        ("reason = \"There", "why = \"There", "unknown field `why`"),
    ] {
        assert!(FILE.contains(old), "{old}");
        let error = Expectations::read(&FILE.replacen(old, new, 1)).expect_err(message);
        assert!(error.contains(message), "{error}");
    }
}
