//! The generator does not idle: most programs are accepted, every statement can be, and every kind is common.

use std::collections::{BTreeMap, BTreeSet};

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

/// Percentage of the programs of its kind that have a code at least.
const LEAST_CODE_PERCENT: f64 = 5.0;

/// Every code that the documents describe, but those that no document describes far enough (G87, G88), and user-defined
/// codes, whose files are drawn.
const DOCUMENTED: &str = "
g0 g1 g2 g3 g4 g5 g5.1 g5.2 g5.3 g7 g8 g10 g17 g17.1 g18 g18.1 g19 g19.1 g20 g21 g28 g28.1 g30 g30.1 g33 g33.1 g38.2
g38.3 g38.4 g38.5 g40 g41 g41.1 g42 g42.1 g43 g43.1 g43.2 g49 g52 g53 g54 g55 g56 g57 g58 g59 g59.1 g59.2 g59.3 g61
g61.1 g64 g70 g71 g71.1 g71.2 g72 g72.1 g72.2 g73 g74 g76 g80 g81 g82 g83 g84 g85 g86 g89 g90 g90.1 g91 g91.1 g92
g92.1 g92.2 g92.3 g93 g94 g95 g96 g97 g98 g99 m0 m1 m2 m3 m4 m5 m6 m7 m8 m9 m19 m30 m48 m49 m50 m51 m52 m53 m60 m61 m62
m63 m64 m65 m66 m67 m68 m70 m71 m72 m73 m98 m99";

/// The same for kinds that few programs use.
const LEAST_RARE_PERCENT: u32 = 1;

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
        for kind in scenario_and_kinds(&mut entropy, &config, None).1 {
            *programs_with.entry(kind).or_default() += 1;
        }
    }
    println!("{programs_with:?}");
    for kind in StatementKind::ALL {
        let least = if kind.is_rare() { LEAST_RARE_PERCENT } else { LEAST_KIND_PERCENT };
        let programs = programs_with.get(kind).copied().unwrap_or_default();
        assert!(
            programs * 100 >= least * KIND_PROGRAMS,
            "{kind:?}: {programs} of {KIND_PROGRAMS} programs"
        );
    }
}

/// Codes that a program has, such as `g38.2`, by what is written.
fn codes(program: &str) -> BTreeSet<String> {
    let mut codes = BTreeSet::new();
    for line in program.lines() {
        let line = line.to_ascii_lowercase();
        let bytes = line.as_bytes();
        for (start, letter) in line.char_indices().filter(|(_, letter)| matches!(letter, 'g' | 'm'))
        {
            let is_word = start == 0 || !bytes[start - 1].is_ascii_alphanumeric();
            let number: String =
                line[start + 1..].chars().take_while(|c| c.is_ascii_digit() || *c == '.').collect();
            if is_word && !number.is_empty() {
                codes.insert(format!("{letter}{number}"));
            }
        }
    }
    codes
}

/// A code that few programs of its kind have is hardly tested. Its kind is the one in whose programs it is most common.
#[test]
fn every_code_is_in_a_share_of_the_programs_of_its_kind() {
    let config = GeneratorConfig::default();
    let mut programs_with: BTreeMap<StatementKind, u32> = BTreeMap::new();
    let mut with_code: BTreeMap<(String, StatementKind), u32> = BTreeMap::new();
    for number in 0..KIND_PROGRAMS {
        let mut entropy = Entropy::from_seed(1, u64::from(number));
        let (scenario, kinds) = scenario_and_kinds(&mut entropy, &config, None);
        let codes = codes(&scenario.program.main);
        for kind in kinds {
            *programs_with.entry(kind).or_default() += 1;
            for code in &codes {
                *with_code.entry((code.clone(), kind)).or_default() += 1;
            }
        }
    }
    let share = |code: &str, kind: StatementKind| {
        let found = with_code.get(&(code.to_owned(), kind)).copied().unwrap_or_default();
        f64::from(found) * 100.0 / f64::from(programs_with.get(&kind).copied().unwrap_or(1))
    };
    for code in DOCUMENTED.split_whitespace() {
        let best = StatementKind::ALL.iter().map(|kind| (share(code, *kind), *kind));
        let (most, kind) = best.max_by(|one, other| one.0.total_cmp(&other.0)).expect("a kind");
        assert!(most >= LEAST_CODE_PERCENT, "{code}: {most:.1} % of the programs of {kind:?}");
    }
}
