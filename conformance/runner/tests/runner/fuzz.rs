//! Fuzzing finds a planted fault, shrinks it, covers every program once, and tells the same however it was interrupted.

use std::collections::BTreeSet;
use std::num::NonZero;
use std::sync::atomic::AtomicBool;

use gaugeblock_adapter::protocol::DeclaredLanguage;
use gaugeblock_adapter::{Adapter, HarnessError};
use gaugeblock_compare::Capabilities;
use gaugeblock_controllers::{Production, Reference};
use gaugeblock_fuzz::generate::nct::{Counted, Pair, count, locals};
use gaugeblock_fuzz::generate::{Entropy, GeneratorConfig, Setups};
use gaugeblock_reference::RuleOutcome;
use gaugeblock_runner::fuzz::groups::{Finding, Groups, merged, shrunk};
use gaugeblock_runner::fuzz::journal::Chunk;
use gaugeblock_runner::fuzz::statistics::Statistics;
use gaugeblock_runner::fuzz::{Extent, FuzzResult, Plan, Shard, run};
use gaugeblock_runner::language::check_program;
use gaugeblock_vocabulary::{
    Effect, Event, Language, LengthUnit, Options, Outcome, Program, Scenario, SpindleTurn,
};

/// Few enough for a debug build, and several chunks.
const PROGRAMS: u64 = 300;

/// The model, run in another way.
#[derive(Debug)]
struct Model {
    capabilities: Capabilities,
    run: fn(&Scenario) -> Result<Outcome, HarnessError>,
}

impl Model {
    fn new(name: &str, run: fn(&Scenario) -> Result<Outcome, HarnessError>) -> Self {
        Self { capabilities: Capabilities::everything(name, "1"), run }
    }
}

impl Adapter for Model {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn supports(&self, _scenario: &Scenario) -> Result<(), String> {
        Ok(())
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        (self.run)(scenario)
    }
}

/// Dwells take twice as long.
fn slow_dwell() -> Model {
    Model::new("slow dwell", |scenario| {
        let mut outcome = gaugeblock_reference::run(scenario).0;
        for event in outcome.steps.iter_mut().flat_map(|step| &mut step.events) {
            if let Event::Do(Effect::Dwell { seconds }) = event {
                *seconds *= 2.0;
            }
        }
        Ok(outcome)
    })
}

fn plan<'a>(iut: &'a dyn Adapter, against: &'a dyn Adapter) -> Plan<'a> {
    Plan {
        config: GeneratorConfig { setups: Setups::Any, ..GeneratorConfig::default() },
        seed: 1,
        ..Plan::new(iut, against, Options::default())
    }
}

#[test]
fn what_does_not_come_again_has_no_option_as_its_cause() {
    let (production, reference) = (Production::default(), Reference::default());
    let plan = plan(&production, &reference);
    let suite = gaugeblock_embedded_suite::files().expect("the suite");
    let suite = gaugeblock_suite::Suite::read(&suite).expect("the suite");
    let choices: Vec<_> = suite.choices.iter().collect();
    let causes = plan.causes(&Scenario::of("g0 x1\nm2\n"), &choices);
    assert_eq!(causes, ["chance, or what an earlier program left: run again, it agrees"]);
}

/// Runs chunks of a shard; those in `done` were done before.
fn chunks(plan: &Plan<'_>, shard: Shard, done: &BTreeSet<u64>) -> Vec<Chunk> {
    let stop = AtomicBool::new(false);
    let jobs = NonZero::new(3).expect("three");
    let mut all = Vec::new();
    run(plan, &Extent { shard, programs: PROGRAMS, jobs, done, stop: &stop }, &mut |chunk| {
        all.push(chunk);
        true
    });
    all.sort_by_key(|chunk| chunk.chunk);
    all
}

fn together(chunks: Vec<Chunk>) -> (Statistics, Vec<Finding>) {
    let (mut statistics, mut groups) = (Statistics::default(), Groups::default());
    for chunk in chunks {
        statistics.add(&chunk.statistics);
        chunk.found.into_iter().for_each(|finding| groups.add(finding));
    }
    (statistics, merged(groups.findings()))
}

const WHOLE: Shard = Shard { index: 1, of: 1 };

#[test]
fn a_planted_fault_is_found_and_shrunk() {
    let faulty = slow_dwell();
    let reference = Reference::default();
    let plan = plan(&faulty, &reference);
    let (statistics, findings) = together(chunks(&plan, WHOLE, &BTreeSet::new()));
    assert_eq!(statistics.programs, PROGRAMS);
    assert!(statistics.diverging > 5, "{statistics:?}");
    // Cycles dwell, too, and are another kind: those of G4 become its smallest program.
    let of_dwell = |finding: &Finding| finding.shape.split(' ').any(|word| word == "g4");
    let findings: Vec<Finding> = findings.into_iter().filter(of_dwell).take(3).collect();
    assert!(!findings.is_empty());
    for finding in findings {
        let small = shrunk(&plan, &finding, 2_000, &|| false);
        assert_eq!(small.scenario.program.main.trim_end(), "g4 p1", "{finding:?}");
        assert_eq!(small.scenario.machine, gaugeblock_vocabulary::Machine::default());
        assert!(small.shrunk);
        assert!(small.rules.iter().any(|rule| rule.starts_with("dwell.")), "{:?}", small.rules);
    }
}

#[test]
fn post_processors_are_fuzzed_too() {
    let (production, reference) = (Production::default(), Reference::default());
    let config = GeneratorConfig {
        language: Language::Gpp,
        mutated_programs: 0,
        ..GeneratorConfig::default()
    };
    let plan = Plan { config, ..plan(&production, &reference) };
    let (statistics, findings) =
        together(chunks(&plan, Shard { index: 1, of: 1 }, &BTreeSet::new()));
    assert_eq!(findings, []);
    assert!(statistics.accepted * 2 > PROGRAMS, "{} of {PROGRAMS}", statistics.accepted);
}

#[test]
fn custom_macros_are_fuzzed_too() {
    let (production, reference) = (Production::default(), Reference::default());
    let config = GeneratorConfig { language: Language::Nct, ..GeneratorConfig::default() };
    let plan = Plan { config, ..plan(&production, &reference) };
    let (statistics, findings) = together(chunks(&plan, WHOLE, &BTreeSet::new()));
    assert_eq!(findings, []);
    assert!(statistics.accepted * 2 > PROGRAMS, "{} of {PROGRAMS}", statistics.accepted);
}

#[test]
fn production_interpolates_as_often_as_the_closed_form_says() {
    for number in 0..PROGRAMS {
        let Counted { scenario, interpolations } = count(&mut Entropy::from_seed(3, number));
        let outcome = Production::default().run(&scenario).unwrap();
        assert_eq!(Counted::made(&outcome), interpolations, "{}", scenario.program.main);
    }
}

#[test]
fn production_preserves_the_callers_parameters() {
    for number in 0..PROGRAMS {
        let pair = locals(&mut Entropy::from_seed(4, number));
        let [one, other] =
            [&pair.one, &pair.other].map(|one| Production::default().run(one).unwrap());
        if Pair::returns(&pair.other, &other) {
            assert_eq!(Pair::left(&one), Pair::left(&other), "{}", pair.other.program.main);
        }
    }
}

#[test]
fn shards_cover_every_program_once() {
    let (one, other) = (Reference::default(), Reference::default());
    let plan = plan(&one, &other);
    let whole = together(chunks(&plan, WHOLE, &BTreeSet::new()));
    let of = 3;
    let shards = (1..=of).flat_map(|index| chunks(&plan, Shard { index, of }, &BTreeSet::new()));
    assert_eq!(together(shards.collect()), whole);
    assert!(whole.1.is_empty(), "the model is equal to itself");
}

#[test]
fn an_interrupted_run_tells_the_same() {
    let faulty = slow_dwell();
    let reference = Reference::default();
    let plan = plan(&faulty, &reference);
    let whole = chunks(&plan, WHOLE, &BTreeSet::new());
    let before: Vec<Chunk> = whole.iter().step_by(2).cloned().collect();
    let done = before.iter().map(|chunk| chunk.chunk).collect();
    let rest = chunks(&plan, WHOLE, &done);
    assert_eq!(rest.len() + before.len(), whole.len());
    assert_eq!(together([before, rest].concat()), together(whole));
}

#[test]
fn where_the_rounding_of_a_position_decides_nothing_is_said() {
    let (production, reference) = (Production::default(), Reference::default());
    let plan = plan(&production, &reference);
    // An arc to where the point stands, a turn about it, half of a number: each but for the last bit of a position.
    for (unit, text) in [
        (LengthUnit::Millimetre, "g0 x2\ng20 f1\ng21 g10 l2 p0 x1\ng2 x1 r0\nm2\n"),
        (LengthUnit::Inch, "g0 x3 y4\ng10 l2 p0 x3 y4\ng91 ^0\nm2\n"),
        (LengthUnit::Millimetre, "f1\ng1 @1 ^90\ng91 ^90\ng28 x0\n^0\nm2\n"),
        (LengthUnit::Inch, "f1\ng10 l2 p0 x1\ng1 zround[[#<_x> + .5]]\nm2\n"),
    ] {
        let mut scenario = Scenario::of(text);
        scenario.machine.length_unit = unit;
        let (choice, option) = ("arcs.radius-just-too-small", "half-circle");
        scenario.options.0.insert(choice.to_owned(), option.to_owned());
        let result = plan.judge(&scenario, &mut Statistics::default());
        assert!(matches!(result, FuzzResult::Fragile | FuzzResult::Same), "{text}: {result:?}");
    }
}

/// What no case can show, since no edition has both options.
#[test]
fn a_tap_does_not_turn_a_spindle_back_to_its_angle() {
    let (production, reference) = (Production::default(), Reference::default());
    let plan = plan(&production, &reference);
    let mut scenario = Scenario::of("s100 f100\nm19 r90 q1\ng84 z-1 r2 p0.5\nm2\n");
    for (choice, option) in [("cycles.tap-direction", "any"), ("cycles.tap-return", "as-before")] {
        scenario.options.0.insert(choice.to_owned(), option.to_owned());
    }
    let result = plan.judge(&scenario, &mut Statistics::default());
    assert_eq!(result, FuzzResult::Same);
    let outcome = gaugeblock_reference::run(&scenario).0;
    let turns = outcome.steps.iter().flat_map(|step| &step.events).filter_map(|event| {
        let Event::Set(changed) = event else { return None };
        changed.spindle.as_ref()?.0.get(&0).copied()
    });
    let turns: Vec<SpindleTurn> = turns.collect();
    let stands = SpindleTurn::Stopped;
    assert_eq!(turns, [SpindleTurn::Oriented, SpindleTurn::Counterclockwise, stands]);
}

#[test]
fn a_coverage_pass_finds_the_seeds_of_rare_outcomes() {
    let (production, reference) = (Production::default(), Reference::default());
    let mut plan = plan(&production, &reference);
    let rare = "g91 g4 p1\nm2";
    plan.seeds.all = ["g0 x1\nm2", rare].map(Scenario::of).into();
    let outcomes = ["motion.traverse", "order.dwell-before-distance"]
        .map(|rule| (rule, RuleOutcome::Accepted));
    plan.spliced = plan.coverage_pass(outcomes, Some(PROGRAMS));
    assert!(plan.spliced > 0);
    assert!(!plan.seeds.rare.is_empty());
    assert!(
        plan.seeds.rare.iter().all(|rare| rare.does == [1] && rare.others == 8),
        "{:?}",
        plan.seeds.rare
    );
    assert!(plan.seeds.before.iter().all(|place| *place == 1), "{:?}", plan.seeds.before);
    let does_it =
        (0..PROGRAMS).filter(|number| plan.scenario(*number).program.main.ends_with(rare)).count();
    assert!(does_it > 5, "{does_it} of {PROGRAMS}");
}

/// The model, but for programs that dwell.
#[derive(Debug)]
struct WithoutDwell(Capabilities);

impl Adapter for WithoutDwell {
    fn capabilities(&self) -> &Capabilities {
        &self.0
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        let dwells = scenario.program.main.contains("g4");
        if dwells { Err("it does not dwell".to_owned()) } else { Ok(()) }
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        Ok(gaugeblock_reference::run(scenario).0)
    }
}

#[test]
fn the_first_programs_that_are_not_judged_are_kept() {
    let unreadable = Model::new("unreadable", |scenario| {
        if scenario.program.main.contains("g4") {
            return Err(HarnessError::NotRun("nobody knows".to_owned()));
        }
        Ok(gaugeblock_reference::run(scenario).0)
    });
    let reference = Reference::default();
    let plan = plan(&unreadable, &reference);
    let chunks = chunks(&plan, WHOLE, &BTreeSet::new());
    let count: u64 = chunks.iter().flat_map(|chunk| chunk.statistics.not_judged.values()).sum();
    let kept: Vec<_> = chunks.into_iter().flat_map(|chunk| chunk.not_judged).collect();
    assert!(!kept.is_empty() && kept.len() < usize::try_from(count).unwrap(), "{}", kept.len());
    for kept in kept {
        assert_eq!(plan.scenario(kept.number), kept.scenario);
        assert!(kept.scenario.program.main.contains("g4"), "{}", kept.scenario.program.main);
        assert!(kept.why.contains("nobody knows"), "{}", kept.why);
    }
}

#[test]
fn incomparable_outcomes_follow_from_declarations() {
    let restless = WithoutDwell(Capabilities::everything("restless", "1"));
    let reference = Reference::default();
    let plan = plan(&restless, &reference);
    let cases = ["g0 x1\nm2", "g91 g4 p1\nm2", "g41 d1\ng1 x1 f1\nm2"].map(Scenario::of);
    let outcomes = ["motion.traverse", "order.dwell-before-distance", "compensation.none"]
        .map(|rule| (rule, RuleOutcome::Accepted));
    let not_shown: Vec<_> = plan.not_comparable(outcomes, cases).into_iter().collect();
    let of = |name: &str, why: &str| (name.to_owned(), why.to_owned());
    assert_eq!(
        not_shown,
        [
            of("compensation.none", "no case reaches them as these options read the documents"),
            of("order.dwell-before-distance", "restless: it does not dwell"),
        ]
    );
}

/// The model with a declared language.
#[derive(Debug)]
struct Lathe(Capabilities, DeclaredLanguage);

impl Adapter for Lathe {
    fn capabilities(&self) -> &Capabilities {
        &self.0
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        check_program(&self.1, scenario)
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        Ok(gaugeblock_reference::run(scenario).0)
    }
}

#[test]
fn programs_are_drawn_from_the_language_that_a_controller_declares() {
    let language = r#"{"g":["0","1","2","3","4","18","20","21","90","91"],"m":["2","3","5","30"],"axes":"XZ",
        "letters":"FS","parameters":[],"expressions":false,"o_words":false,"comments":["parentheses"]}"#;
    let language = serde_json::from_str(language).expect("a language");
    let lathe = Lathe(Capabilities::everything("lathe", "1"), language);
    let reference = Reference::default();
    let mut plan = plan(&lathe, &reference);
    let supported = |plan: &Plan<'_>| {
        let programs = (0..200).map(|number| plan.scenario(number));
        let supported = programs.filter(|program| lathe.supports(program).is_ok());
        let texts: Vec<String> = supported.map(|scenario| scenario.program.main).collect();
        (texts.len(), texts.iter().map(|text| text.lines().count()).sum::<usize>())
    };
    let before = supported(&plan);
    plan.leave_out_unreadable();
    let (programs, lines) = supported(&plan);
    assert!(programs > 170 && programs > 3 * before.0, "{programs} of 200, {} before", before.0);
    assert!(lines > 10 * before.1, "{lines} lines, {} before", before.1);
    for code in ["g2", "g18", "g4", "m3", "x", "z", "(a comment)"] {
        let has = |number| plan.scenario(number).program.main.to_lowercase().contains(code);
        assert!((0..200).any(has), "{code}");
    }
}

#[test]
fn a_rule_that_the_documents_do_not_have_charges_nobody() {
    let accepts = Model::new("second sign", |scenario| {
        let main = scenario.program.main.replace("/ /", "/");
        let program = Program { main, ..scenario.program.clone() };
        Ok(gaugeblock_reference::run(&Scenario { program, ..scenario.clone() }).0)
    });
    let reference = Reference::default();
    let scenario = Scenario::of("g0 x1\n/ / g0 x2\nm2\n");
    let judged = |void: &[&str]| {
        let void = void.iter().map(|rule| (*rule).to_owned()).collect();
        let plan = Plan { void, ..plan(&accepts, &reference) };
        plan.judge(&scenario, &mut Statistics::default())
    };
    assert!(matches!(judged(&[]), FuzzResult::Differs(_)));
    assert!(matches!(judged(&["motion.by-turns"]), FuzzResult::Differs(_)));
    assert_eq!(judged(&["text.block-delete-place"]), FuzzResult::Unsupported);
}

#[test]
fn programs_are_drawn_from_the_language_of_the_edition() {
    let language = r#"{"axes":"XYZABC","parameters":["numbered"],"o_words":false}"#;
    let language: DeclaredLanguage = serde_json::from_str(language).expect("a language");
    let (production, reference) = (Production::default(), Reference::default());
    let mut plan = Plan { language: Some(language.clone()), ..plan(&production, &reference) };
    plan.leave_out_unreadable();
    let is_beyond = |number: &u64| check_program(&language, &plan.scenario(*number)).is_err();
    let beyond = (0..200).filter(is_beyond).count();
    assert!(beyond < 30, "{beyond} of 200 need more than the language has");
}
