//! The generator does not idle: most programs are accepted, every statement can be, and every kind is common.

use std::collections::BTreeMap;

use gaugeblock_fuzz::generate::{
    Entropy, GeneratorConfig, StatementKind, TABLE, from_seed, scenario_and_kinds,
};
use gaugeblock_reference::run;
use gaugeblock_vocabulary::{End, Scenario};

/// Programs that are run.
const PROGRAMS: u64 = 600;

/// Programs whose statements are counted.
const KIND_PROGRAMS: u32 = 4_000;

/// Percentage of programs in which each kind of statement is at least.
const LEAST_KIND_PERCENT: u32 = 10;

/// The same for kinds that end a run as unsupported.
const LEAST_UNSUPPORTED_PERCENT: u32 = 1;

/// Percentage of programs that end as unsupported at most.
const MOST_UNSUPPORTED_PERCENT: usize = 3;

fn accepted(end: &End) -> bool {
    matches!(end, End::ProgramEnd | End::PercentEnd | End::Endless | End::Paused)
}

#[test]
fn most_programs_are_accepted_and_long() {
    let config = GeneratorConfig::default();
    let (mut accepted, mut unsupported, mut unspecified, mut blocks) = (0, 0, 0, 0);
    let mut faults: BTreeMap<String, u32> = BTreeMap::new();
    for number in 0..PROGRAMS {
        let outcome = run(&from_seed(1, number, &config)).0;
        blocks += outcome.steps.len();
        match &outcome.end {
            End::Unsupported { .. } => unsupported += 1,
            End::Unspecified { .. } => unspecified += 1,
            End::Fault(fault) => *faults.entry(format!("{:?}", fault.kind)).or_default() += 1,
            End::ProgramEnd
            | End::PercentEnd
            | End::StreamEnd
            | End::Endless
            | End::Paused
            | End::Aborted
            | End::BudgetExhausted { .. } => accepted += 1,
        }
    }
    println!(
        "{accepted} accepted, {unsupported} unsupported, {unspecified} unspecified; {faults:?}"
    );
    let programs = usize::try_from(PROGRAMS).unwrap();
    let compared = programs - unsupported - unspecified;
    assert!(accepted * 100 >= compared * 70, "{accepted} of {compared} are accepted: {faults:?}");
    assert!(unsupported * 100 <= programs * MOST_UNSUPPORTED_PERCENT, "{unsupported} unsupported");
    assert!(compared * 100 >= programs * 90, "{compared} of {programs} can be compared");
    assert!(blocks >= programs * 15, "{blocks} blocks in {programs} programs");
}

/// A statement that is always refused, or that is allowed in no state, tests nothing.
#[test]
fn every_statement_can_be_accepted() {
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
        // Some statements need another one before them, and one needs an option that is not a default.
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
    assert!(idle.is_empty(), "statements that are never accepted: {idle:?}");
}

/// A kind that few programs use is hardly tested.
#[test]
fn every_kind_is_in_a_share_of_programs() {
    let config = GeneratorConfig::default();
    let mut programs_with: BTreeMap<StatementKind, u32> = BTreeMap::new();
    for number in 0..KIND_PROGRAMS {
        let mut entropy = Entropy::from_seed(1, u64::from(number));
        for kind in scenario_and_kinds(&mut entropy, &config).1 {
            *programs_with.entry(kind).or_default() += 1;
        }
    }
    println!("{programs_with:?}");
    for kind in StatementKind::ALL {
        let least =
            if kind.is_unsupported() { LEAST_UNSUPPORTED_PERCENT } else { LEAST_KIND_PERCENT };
        let programs = programs_with.get(kind).copied().unwrap_or_default();
        assert!(
            programs * 100 >= least * KIND_PROGRAMS,
            "{kind:?}: {programs} of {KIND_PROGRAMS} programs"
        );
    }
}
