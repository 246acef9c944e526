//! Programs of a post-processor: most are accepted, and modality changes nothing but printed text.

use gaugeblock_fuzz::generate::gpp::{Pair, modality};
use gaugeblock_fuzz::generate::{Entropy, GeneratorConfig, from_seed};
use gaugeblock_vocabulary::{End, Language, Outcome, Scenario};

const PROGRAMS: u64 = 3000;

fn run(scenario: &Scenario) -> Outcome {
    gaugeblock_reference::run(scenario).0
}

#[test]
fn most_programs_are_accepted() {
    let config = GeneratorConfig { language: Language::Gpp, ..GeneratorConfig::default() };
    let ends = (0..PROGRAMS).map(|number| run(&from_seed(1, number, &config)).end);
    let accepted = ends.filter(|end| !matches!(end, End::Fault(_))).count();
    let percent = accepted * 100 / usize::try_from(PROGRAMS).unwrap();
    assert!((60..97).contains(&percent), "{percent} of a hundred are accepted");
}

#[test]
fn modality_changes_printed_text_only() {
    for number in 0..PROGRAMS {
        let pair = modality(&mut Entropy::from_seed(2, number));
        let (one, other) = (run(&pair.one), run(&pair.other));
        assert!(
            Pair::agrees(&one, &other),
            "{}\n---\n{}\n---\n{}\n---\n{}",
            pair.one.program.main,
            pair.other.program.main,
            one.to_text(),
            other.to_text()
        );
    }
}
