//! Encoding of scenarios: members with their default are left out, and the rest decodes to the same scenario.

use std::path::Path;

use gaugeblock_adapter::protocol::{Operation, Request};
use gaugeblock_suite::Suite;
use gaugeblock_vocabulary::Scenario;
use gaugeblock_vocabulary::scenario::{Budget, Environment};

use crate::command::gaugeblock;

/// The scenarios that a controller is asked to run, as it reads them.
fn asked(edition: &str, only: &str) -> Vec<(Scenario, usize)> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("told");
    std::fs::create_dir_all(&folder).expect("a folder for the test");
    let wire = folder.join(edition);
    let _fresh = std::fs::remove_file(&wire);
    // Several sessions write it, each line at once.
    let controller = format!(
        "exec:tee -a {} | {} serve --controller reference",
        wire.display(),
        env!("CARGO_BIN_EXE_gaugeblock")
    );
    let output = gaugeblock(&[
        "certify",
        "--controller",
        &controller,
        "--edition",
        edition,
        "--only",
        only,
        "--jobs",
        "1",
    ]);
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}{}", String::from_utf8_lossy(&output.stderr));
    let wire = std::fs::read_to_string(&wire).expect("what was told");
    let read = |line: &str| match serde_json::from_str(line).expect(line) {
        Request { operation: Operation::Run { scenario, .. }, .. } => Some((*scenario, line.len())),
        Request { .. } => None,
    };
    wire.lines().filter_map(read).collect()
}

#[test]
fn defaults_are_left_out() {
    let suite =
        Suite::read(&gaugeblock_embedded_suite::files().expect("the suite")).expect("the suite");
    let defaults = suite.defaults();
    for edition in ["linuxcnc-2.8", "emc2-2.5"] {
        let held_to = suite.options(suite.edition(edition).expect("the edition"));
        let differs = held_to.0.iter().filter(|(id, option)| defaults.get(id) != Some(option));
        let differs: Vec<_> = differs.collect();
        let asked = asked(edition, "saved-state");
        assert!(asked.len() > 50, "{} runs", asked.len());
        let mut sizes: Vec<_> = asked.iter().map(|(_, size)| *size).collect();
        sizes.sort_unstable();
        let usual = sizes[sizes.len() / 2];
        assert!(usual < 1200 + 60 * differs.len(), "{edition}: {usual} bytes");
        for (scenario, _) in &asked {
            assert!(scenario.options.0.iter().all(|(id, option)| defaults.get(id) != Some(option)));
        }
        let all = |(id, option): &(&String, &String)| {
            asked.iter().any(|(scenario, _)| scenario.options.is(id, option))
        };
        assert!(differs.iter().all(all), "{edition}: {differs:?}");
        let plain = asked.iter().filter(|(scenario, _)| scenario.budget == Budget::default());
        assert!(
            plain.filter(|(scenario, _)| scenario.environment == Environment::default()).count()
                > 10
        );
    }
}
