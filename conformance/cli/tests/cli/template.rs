//! Adapters in Python for tests: the template, with some of its text replaced, and the verdicts that it gets.

use std::num::NonZero;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Duration;

use gaugeblock_adapter::exec::{Exec, Limits};
use gaugeblock_runner::certify::{
    CaseResult, Plan, RepeatSampling, RunOptions, Scope, Verdict, run_plan,
};
use gaugeblock_runner::shard::Shard;
use gaugeblock_suite::Suite;
use gaugeblock_vocabulary::Options;

pub(crate) const TEMPLATE: &str = include_str!("../../../adapter/templates/template.py");

/// Where the template begins to read requests.
pub(crate) const LOOP: &str = "for request in map(json.loads, sys.stdin):\n";

pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A file for a test.
pub(crate) fn file(name: &str, content: &str) -> String {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("protocol");
    let path = folder.join(name);
    std::fs::create_dir_all(path.parent().unwrap_or(&folder)).expect("a folder for the test");
    std::fs::write(&path, content).expect("a file for the test");
    path.to_str().expect("a path in UTF-8").to_owned()
}

/// The template with some of its text replaced.
pub(crate) fn changed(name: &str, changes: &[(&str, &str)]) -> String {
    let mut adapter = TEMPLATE.to_owned();
    for (old, new) in changes {
        assert!(adapter.contains(old), "the template has no {old:?}");
        adapter = adapter.replace(old, new);
    }
    format!("python3 {}", file(name, &adapter))
}

/// Limits under which tests do not take long. Python may start as slowly as a busy machine lets it.
pub(crate) fn limits() -> Limits {
    let (time, start) = (Duration::from_secs(1), Duration::from_secs(60));
    Limits { time, start, bytes: 1 << 20, whole: 1 << 20, objects: 100_000, ..Limits::default() }
}

/// The verdicts of one rule's cases: that of the case that is meddled with and whether it was judged alone, and the
/// others.
pub(crate) fn verdicts_on(
    controller: &Exec,
    suite: &Suite,
    twice: RepeatSampling,
) -> ((Verdict, bool), Vec<Verdict>) {
    let edition = suite.edition("linuxcnc-2.9").expect("the edition");
    let only = ["modal-groups.g-code-out-of-range".to_owned()];
    let plan =
        Plan { suite, edition, only: &only, jobs: NonZero::<usize>::MIN, scope: Scope::Full };
    let mut each = |_: &CaseResult<'_>| ControlFlow::Continue(());
    let course = RunOptions {
        shard: Shard::WHOLE,
        options: Options::default(),
        finished: Vec::new(),
        repeat: twice,
        shrink_attempts: 0,
        model: None,
        on_result: &mut each,
    };
    let run = run_plan(plan, controller, course);
    let (it, others): (Vec<_>, Vec<_>) =
        run.cases.into_iter().partition(|case| case.name == "g101");
    let it = it.into_iter().next().expect("the case");
    let others = others.into_iter().map(|case| case.verdict).collect();
    ((it.verdict, it.rerun), others)
}
