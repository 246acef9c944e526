//! Inputs that are small and whose result is not: each ends with an error that names the place and the bound.

use std::fs;
use std::path::Path;

use gaugeblock_adapter::clock::now;

use super::command::gaugeblock;

/// A file in the folder of the tests.
fn file(name: &str, text: &str) -> String {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::write(&path, text).expect("it is written");
    path.to_str().expect("a path in text").to_owned()
}

/// Runs a call that is refused with exit status 2 and a message that has these parts.
fn refused(arguments: &[&str], parts: &[&str]) {
    let output = gaugeblock(arguments);
    let message = String::from_utf8_lossy(&output.stderr);
    let missing = parts.iter().find(|part| !message.contains(**part));
    assert_eq!((output.status.code(), missing), (Some(2), None), "{arguments:?}: {message:.2000}");
}

#[test]
fn block_of_too_many_effects_ends_the_printer() {
    for (name, block) in
        [("repeats", "g81 x1 z-1 r0 f1 l1000000000"), ("pecks", "g83 x1 z-1 r0 q1e-9 f1")]
    {
        let block = block.replace("1e-9", "0.000000001");
        let program = file(&format!("bounds-{name}.ngc"), &format!("g0 x0\n{block}\nm2\n"));
        let parts = [".ngc:2: more than 1000000 effects in one block", "hint: "];
        refused(&["rs274", "-g", &program], &parts);
    }
}

#[test]
fn motion_of_too_many_servo_cycles_is_not_planned() {
    let machine =
        file("bounds-mill.toml", "period = 1.0\naxes.x = { velocity = 1, acceleration = 1 }\n");
    let program = file("bounds-far.ngc", "g21 g0 x1\nx1000000000000\nm2\n");
    let parts = ["bounds-far.ngc:2: the motion takes more than 10000000 servo cycles", "hint: "];
    refused(&["plan", &program, "--machine", &machine], &parts);
}

#[test]
fn time_of_a_run_is_not_quadratic_in_its_named_parameters() {
    let lines: String = (0..25_000).map(|at| format!("#<_a{at}>=1\n")).collect();
    let program = file("bounds-names.ngc", &(lines + "m2\n"));
    let begun = now();
    let output = gaugeblock(&["run", &program, "--controller", "production"]);
    let seconds = begun.elapsed().as_secs_f64();
    assert_eq!(output.status.code(), Some(0));
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains(":25000  # #<_a24999>=1"));
    // Comparing all of them after each block takes minutes without optimisation.
    assert!(seconds < 60.0, "{seconds} s");
}
