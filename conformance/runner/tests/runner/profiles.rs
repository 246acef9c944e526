//! Profiles: the shared core is what every lineage requires, and each rule counts once.

use std::collections::BTreeSet;
use std::path::Path;

use gaugeblock_runner::language::read_suite;
use gaugeblock_suite::{Edition, Profile, Suite};

fn suite() -> Suite {
    read_suite(&gaugeblock_embedded_suite::files().expect("the suite"))
        .unwrap_or_else(|errors| panic!("{}", errors.join("\n")))
}

fn core(suite: &Suite) -> &Profile {
    suite.profile("rs274-core").expect("the core")
}

fn lineages<'a>(suite: &'a Suite, profile: &Profile) -> Vec<&'a Edition> {
    let edition = |id: &String| suite.edition(id).expect("an edition of the suite");
    profile.lineages.iter().map(edition).collect()
}

#[test]
fn every_lineage_has_every_rule_of_the_core_in_force() {
    let suite = suite();
    let core = core(&suite);
    let rules = suite.rules_of(core);
    assert!(rules.len() > 60, "{} rules", rules.len());
    for edition in lineages(&suite, core) {
        for rule in &rules {
            assert!(!rule.void.contains_key(&edition.id), "{}: {} is void", edition.id, rule.id);
            let is_cited =
                |document: &String| rule.sources.iter().any(|source| source.document == *document);
            assert!(edition.documents.iter().any(is_cited), "{}: {}", edition.id, rule.id);
            let runs = rule.cases.iter().filter(|case| case.runs_in(edition)).count();
            assert!(runs > 0, "{}: {} has no case", edition.id, rule.id);
        }
    }
}

#[test]
fn core_has_no_choice_on_which_the_lineages_differ() {
    let suite = suite();
    let core = core(&suite);
    let editions = lineages(&suite, core);
    let rules = suite.rules_of(core);
    for choice in suite.choices.iter().filter(|it| rules.iter().any(|rule| rule.id == it.id)) {
        let options: BTreeSet<Option<String>> = editions
            .iter()
            .map(|edition| suite.options(edition).get(&choice.id).map(str::to_owned))
            .collect();
        assert_eq!(options.len(), 1, "{}: {options:?}", choice.id);
    }
    let is_of_core = |id: &str| rules.iter().any(|rule| rule.id == id);
    assert!(is_of_core("feed.rate") && is_of_core("arcs.centre"));
    // The lineages read this one differently.
    assert!(!is_of_core("offsets.systems"));
}

#[test]
fn core_is_drawn_from_topics_and_leaves_the_additions_alone() {
    let suite = suite();
    let core = core(&suite);
    for rule in suite.rules_of(core) {
        assert!(core.drawn_from.contains(&rule.profile), "{}: {}", rule.id, rule.profile);
    }
    for id in ["arcs-radius", "cycles", "probing", "expressions", "o-words", "modal-save"] {
        let addition = suite.profile(id).expect("an addition");
        let of_pages = suite.rules.iter().filter(|rule| rule.profile == id).count();
        assert_eq!(suite.rules_of(addition).len(), of_pages, "{id} loses no rule to the core");
    }
}

#[test]
fn each_rule_counts_for_one_profile_and_the_page_has_the_counts() {
    let suite = suite();
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/profiles.md");
    let page = std::fs::read_to_string(page).expect("the page on profiles");
    let mut counted = 0;
    for profile in &suite.profiles {
        let rules = suite.rules_of(profile).len();
        assert!(rules > 0, "{} has no rule", profile.id);
        counted += rules;
        let row = format!("| `{}` | {rules} | {} |\n", profile.id, profile.sentence);
        assert!(page.contains(&row), "docs/profiles.md lacks this row:\n{row}");
    }
    assert_eq!(counted, suite.rules.len());
    assert_eq!(page.matches("\n| `").count(), suite.profiles.len(), "rows of other profiles");
}
