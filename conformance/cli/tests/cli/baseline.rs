//! A baseline: which report can be one.

use std::num::NonZero;

use gaugeblock_compare::Accuracy;
use gaugeblock_controllers::Reference;
use gaugeblock_report::merge::Stored;
use gaugeblock_report::{Header, Report, json};
use gaugeblock_runner::certify::{Plan, Scope, certify};
use gaugeblock_runner::shard::Shard;
use gaugeblock_suite::Suite;

#[test]
fn a_baseline_is_of_the_same_controller_and_edition_in_any_version() {
    let suite =
        Suite::read(&gaugeblock_embedded_suite::files().expect("the suite")).expect("the suite");
    let edition = suite.edition("linuxcnc-2.9").expect("an edition of the suite");
    let only = ["coolant.off".to_owned()];
    let plan = Plan {
        suite: &suite,
        edition,
        only: &only,
        jobs: NonZero::<usize>::MIN,
        scope: Scope::Full,
    };
    let model = Reference::default();
    let run = certify(plan, &model, &|| {});
    let header = Header::of(plan, &model, Shard::WHOLE);
    let report = Report::of(&suite, &run, header.clone());
    let stored = Stored::read(&json::json(&report).to_string()).expect("a report");
    assert_eq!(stored.check_header(&header), Ok(Vec::new()));
    let newer = Header { version: "2".to_owned(), only: Vec::new(), ..header.clone() };
    let notes = stored.check_header(&newer).expect("what a baseline is for");
    assert!(matches!(&notes[..], [note] if note.ends_with("this is version 2")), "{notes:?}");
    let accuracy = Accuracy { absolute: 0.01, ..Accuracy::default() };
    let notes = stored.check_header(&Header { accuracy, ..header.clone() });
    let note = "the declared accuracy of the baseline is exact, this one is numbers within 0.01";
    assert_eq!(notes, Ok(vec![note.to_owned()]));
    for other in [
        Header { controller: "mill".to_owned(), ..header.clone() },
        Header { edition: "emc2-2.5".to_owned(), ..header.clone() },
    ] {
        let why = stored.check_header(&other).expect_err("it is of something else");
        let (now, then) = (&other, &header);
        for name in [&now.controller, &now.edition, &then.controller, &then.edition] {
            assert!(why.contains(name.as_str()), "{name} is not in: {why}");
        }
    }
}
