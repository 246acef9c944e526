//! Fingerprints: which refusals are evidence of an option, and which edition is the nearest.

use gaugeblock_adapter::{Adapter, HarnessError};
use gaugeblock_compare::Capabilities;
use gaugeblock_runner::fingerprint::{
    Agreement, ObservedOption, fingerprint, nearest, observe_choice, undecided,
};
use gaugeblock_suite::{Choice, Suite};
use gaugeblock_vocabulary::{BlockLocation, End, Fault, Outcome, Program, Scenario};

fn suite() -> Suite {
    Suite::read(&gaugeblock_embedded_suite::files().expect("the suite"))
        .unwrap_or_else(|errors| panic!("{}", errors.join("\n")))
}

/// The model without kinds of faults and without some words: it refuses each block with one of them.
#[derive(Debug)]
struct WithoutKinds {
    capabilities: Capabilities,
    lacks: Vec<&'static str>,
}

impl WithoutKinds {
    fn new(lacks: &[&'static str]) -> Self {
        let everything = Capabilities::everything("without kinds", "1");
        let capabilities = Capabilities { faults_have_kinds: false, ..everything };
        Self { capabilities, lacks: lacks.to_vec() }
    }
}

impl Adapter for WithoutKinds {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn supports(&self, _scenario: &Scenario) -> Result<(), String> {
        Ok(())
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        let mut outcome = gaugeblock_reference::run(scenario).0;
        let mut lines = scenario.program.main.lines().zip(1..);
        let lacks = |line: &str| self.lacks.iter().any(|word| line.contains(word));
        if let Some((_, line)) = lines.find(|(line, _)| lacks(line)) {
            outcome.steps.retain(|step| step.block.line < line);
            let block = Some(BlockLocation::new(Program::MAIN, line));
            outcome.end =
                End::Fault(Fault { kind: None, block, message: "error:20".to_owned(), span: None });
        } else if let End::Fault(fault) = &mut outcome.end {
            fault.kind = None;
        }
        Ok(outcome)
    }
}

fn choice<'a>(suite: &'a Suite, id: &str) -> &'a Choice {
    suite.choices.iter().find(|choice| choice.id == id).expect("a choice of the suite")
}

fn observed(id: &str, option: &str, lacks: &[&'static str]) -> ObservedOption {
    let suite = suite();
    let edition = suite.edition("linuxcnc-2.9").expect("an edition of the suite");
    let mut options = suite.options(edition);
    options.0.insert(id.to_owned(), option.to_owned());
    observe_choice(choice(&suite, id), &options, None, &WithoutKinds::new(lacks), false)
}

#[test]
fn refusal_for_another_reason_is_no_option() {
    let of_the_option = observed("arcs.zero-radius", "refused", &[]);
    assert_eq!(of_the_option, ObservedOption::Option("refused".to_owned()));
    for lacks in ["i0", "g2 ", "z1"] {
        let found = observed("arcs.zero-radius", "accepted", &[lacks]);
        let lacks_all = lacks == "i0";
        // Without `i0` alone, other numbers after I are accepted, as a controller does that refuses this arc.
        assert_eq!(matches!(found, ObservedOption::Option(_)), lacks_all, "{lacks}: {found}");
    }
    let found = observed("arcs.zero-radius", "accepted", &["i"]).to_string();
    assert!(found.starts_with("undecided: refused for another reason"), "{found}");
}

#[test]
fn control_programs_confirm_most_refusals_of_a_controller_without_kinds() {
    let suite = suite();
    let edition = suite.edition("linuxcnc-2.9").expect("an edition of the suite");
    let controller = WithoutKinds::new(&[]);
    let (mut confirmed, mut others) = (0, Vec::new());
    for choice in suite.choices.iter().filter(|choice| choice.language == edition.language) {
        for option in &choice.options {
            let refuses = option.assertions.iter().any(|text| text.starts_with("refused"));
            if !refuses {
                continue;
            }
            let mut options = suite.options(edition);
            options.0.insert(choice.id.clone(), option.name.clone());
            options.0.extend(choice.under.clone());
            let found = observe_choice(choice, &options, None, &controller, false);
            if found == ObservedOption::Option(option.name.clone()) {
                confirmed += 1;
            } else {
                others.push(format!("{} = {}: {found}", choice.id, option.name));
            }
        }
    }
    let wrong: Vec<_> =
        others.iter().filter(|found| !found.contains("the reason is not known")).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(confirmed > 2 * others.len(), "{confirmed} confirmed, not {others:#?}");
}

#[test]
fn editions_that_agree_equally_have_one_rank() {
    let suite = suite();
    let edition = |id| suite.options(suite.edition(id).expect("an edition of the suite"));
    let (older, newer) = (edition("linuxcnc-2.8"), edition("linuxcnc-2.9"));
    let model = WithoutKinds::new(&[]);
    let mut all = fingerprint(&suite, &newer, None, &model);
    for (choice, observed) in &mut all {
        if older.get(&choice.id) != newer.get(&choice.id) {
            *observed = ObservedOption::NotRun("not reached".to_owned());
        }
    }
    let ranked = nearest(&suite, &all);
    let first: Vec<&Agreement> = ranked.iter().filter(|agreement| agreement.rank == 1).collect();
    let names: Vec<&str> = first.iter().map(|agreement| agreement.edition.as_str()).collect();
    assert!(names.contains(&"linuxcnc-2.8") && names.contains(&"linuxcnc-2.9"), "{ranked:?}");
    assert!(ranked.iter().all(|it| it.rank > 1 || it.agree == ranked[0].agree), "{ranked:?}");
    let open = undecided(&suite, &all, &ranked);
    assert!(!open.is_empty());
    let differs = |id: &&str| older.get(id) != newer.get(id);
    assert!(names.len() > 2 || open.iter().all(differs), "{open:?}");
}
