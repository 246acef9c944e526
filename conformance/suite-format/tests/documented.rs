//! Editions of documented rules have no rule that their documents do not state.

use std::path::Path;

use gaugeblock_suite::files::of_folder;
use gaugeblock_suite::{Edition, Suite};

fn suite() -> Suite {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    Suite::read(&of_folder(&root.join("../suite")).expect("the folder of the suite"))
        .unwrap_or_else(|errors| panic!("{}", errors.join("\n")))
}

fn edition<'a>(suite: &'a Suite, id: &str) -> &'a Edition {
    suite.edition(id).expect("an edition of the suite")
}

#[test]
fn edition_of_documented_rules_has_no_rule_without_a_source_in_its_documents() {
    let suite = suite();
    let documented = suite.editions.iter().filter(|edition| edition.documented_only);
    assert!(documented.clone().count() > 0, "no edition has documented rules only");
    for edition in documented {
        let (exist, others): (Vec<_>, Vec<_>) =
            suite.rules.iter().partition(|rule| rule.exists_in(edition));
        let undocumented: Vec<_> = exist
            .iter()
            .filter(|rule| !edition.cites(&rule.sources))
            .map(|rule| &rule.id)
            .collect();
        assert!(undocumented.is_empty(), "{}: {undocumented:?}", edition.id);
        assert!(exist.len() > 100, "{} has {} rules", edition.id, exist.len());
        let of_language = others.iter().filter(|rule| rule.language == edition.language);
        let unexplained: Vec<_> = of_language
            .filter(|rule| !rule.void.contains_key(&edition.id))
            .map(|rule| &rule.id)
            .collect();
        assert!(unexplained.is_empty(), "{}: {unexplained:?}", edition.id);
    }
}

#[test]
fn edition_of_documented_rules_does_not_close_a_choice_for_others() {
    let suite = suite();
    for (choice, edition_id, is_open) in [
        // Grbl decides it; LinuxCNC's manual does not.
        ("motion.without-axis-words", "linuxcnc-2.9", true),
        ("motion.without-axis-words", "grbl-1.1", false),
        // Grbl's documents are silent, and no rule of the edition depends on it.
        ("control.do-label", "linuxcnc-2.9", true),
        ("control.do-label", "grbl-1.1", false),
        // Each of them decides it, in its own way.
        ("text.comments-removed", "linuxcnc-2.9", false),
        ("text.comments-removed", "grbl-1.1", false),
        // The older documents of LinuxCNC read it in another way.
        ("tool.selected-by", "linuxcnc-2.9", false),
    ] {
        let choice = suite.choices.iter().find(|it| it.id == choice).expect(choice);
        let edition = edition(&suite, edition_id);
        assert_eq!(suite.is_open(choice, edition), is_open, "{} in {edition_id}", choice.id);
    }
}
