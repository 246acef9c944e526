//! The examples do what they say.

use std::process::Command;

use gaugeblock_adapter::clock::now;
use gaugeblock_adapter::exec::{Exec, Limits};
use gaugeblock_runner::check::{CheckResult, checks};
use gaugeblock_suite::Suite;

/// What a program prints. It must end with status 0.
fn output_of(program: &str) -> String {
    let output = Command::new(program).output().expect("the example runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("UTF-8")
}

#[test]
fn interpreter_executes_the_loop_and_ends() {
    let output = output_of(env!("CARGO_BIN_EXE_interpreter"));
    let moves = output.lines().filter(|line| line.contains("straight_feed")).count();
    assert_eq!(moves, 3, "{output}");
    assert!(output.contains("straight_feed end=(x30)"), "{output}");
    assert_eq!(output.lines().last(), Some("program_end: x=30"));
}

#[test]
fn planner_returns_to_the_origin() {
    let output = output_of(env!("CARGO_BIN_EXE_planner"));
    let last = output.lines().last().expect("samples");
    let numbers: Vec<f64> =
        last.split(',').map(|number| number.parse().expect("a number")).collect();
    let [time, x, y, speed] = numbers[..] else { panic!("{last}") };
    assert!(x.abs() < 1e-9 && y.abs() < 1e-9 && speed.abs() < 1e-9, "{last}");
    assert!((0.8..2.0).contains(&time), "80 mm at 100 mm/s, with 0.2 s at half the feed: {last}");
}

#[test]
fn adapter_passes_every_check() {
    let command = env!("CARGO_BIN_EXE_adapter");
    let adapter = Exec::start(command, Limits::default()).expect("the adapter answers");
    let suite = Suite::read(&gaugeblock_embedded_suite::files().expect("the suite"));
    let start = now();
    let found = checks(&adapter, &suite.expect("a valid suite"), &|| start.elapsed().as_secs_f64());
    assert!(found.len() > 5, "{found:?}");
    for check in found {
        assert!(!matches!(check.result, CheckResult::Failed(_)), "{check:?}");
    }
}
