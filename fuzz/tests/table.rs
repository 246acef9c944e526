//! The generator does not idle: most programs are accepted, and every row can be.

use std::collections::BTreeMap;

use gaugeblock_fuzz::generate::{GeneratorConfig, TABLE, from_seed};
use gaugeblock_reference::run;
use gaugeblock_vocabulary::{End, Scenario};

fn accepted(end: &End) -> bool {
    matches!(end, End::ProgramEnd | End::PercentEnd | End::Endless | End::Paused)
}

#[test]
fn most_programs_are_accepted_and_long() {
    let config = GeneratorConfig { later_programs: 0, ..GeneratorConfig::default() };
    let (mut good, mut judged, mut blocks) = (0, 0, 0);
    let mut faults: BTreeMap<String, u32> = BTreeMap::new();
    for number in 0..600 {
        let outcome = run(&from_seed(1, number, &config)).0;
        blocks += outcome.steps.len();
        if matches!(outcome.end, End::Unsupported { .. } | End::Unspecified { .. }) {
            continue;
        }
        if let End::Fault(fault) = &outcome.end {
            *faults.entry(format!("{:?}", fault.kind)).or_default() += 1;
        } else {
            good += 1;
        }
        judged += 1;
    }
    assert!(good * 100 >= judged * 70, "{good} of {judged} are accepted; faults {faults:?}");
    assert!(judged >= 500, "{judged} of 600 are judged");
    assert!(blocks >= 600 * 15, "{blocks} blocks in 600 programs");
}

/// A row that is always refused would test nothing, and one that is never possible even less.
#[test]
fn every_row_can_be_accepted() {
    let mut idle = Vec::new();
    for row in TABLE.iter().copied().flatten().filter(|row| row.name != "text.malformed") {
        let only = vec![row.name.to_owned()];
        let alone = GeneratorConfig {
            only,
            blocks: (1, 6),
            mutated_programs: 0,
            ..GeneratorConfig::default()
        };
        let mut runs = (0..60).map(|number| from_seed(2, number, &alone));
        let fits = |scenario: Scenario| {
            let outcome = run(&scenario).0;
            let wrote = scenario.program.main.lines().count() > 2;
            wrote && (accepted(&outcome.end) || matches!(outcome.end, End::Unsupported { .. }))
        };
        // Some rows need another one before them, and one an option that no default is.
        let needs = [
            "saved.restore",
            "saved.invalidate",
            "control.break",
            "sub.call-again",
            "sub.own-label",
            "tool.change",
        ];
        let needs_too = ["synchronised", "saved.autorestore"];
        let waits = needs.contains(&row.name) || needs_too.iter().any(|n| row.name.starts_with(n));
        if !waits && !runs.any(fits) {
            idle.push(row.name);
        }
    }
    assert!(idle.is_empty(), "rows that are never accepted: {idle:?}");
}
