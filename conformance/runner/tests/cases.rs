//! The model runs the cases of each rule under one edition of each language: a test per rule. The gate runs it under
//! every edition.

use gaugeblock_controllers::Reference;
use gaugeblock_runner::certify::{Plan, Scope, Verdict, certify};
use gaugeblock_runner::language::read_suite;
use gaugeblock_suite::Suite;
use libtest_mimic::{Arguments, Failed, Trial};

/// The newest edition of the documents of each language.
const EDITIONS: [&str; 3] = ["linuxcnc-2.9", "gpp2", "nct-99m"];

fn main() {
    let arguments = Arguments::from_args();
    let suite: &'static Suite =
        match read_suite(&gaugeblock_embedded_suite::files().expect("the suite")) {
            Ok(suite) => Box::leak(Box::new(suite)),
            Err(errors) => panic!("{}", errors.join("\n")),
        };
    let trials = EDITIONS
        .iter()
        .map(|id| suite.edition(id).expect("an edition of the suite"))
        .flat_map(|edition| suite.rules.iter().map(move |rule| (edition, rule)))
        .filter(|(edition, rule)| edition.language == rule.language)
        .map(|(edition, rule)| {
            let name = format!("{}::{}", edition.id, rule.id);
            Trial::test(name, move || holds(suite, &edition.id, &rule.id))
        })
        .collect();
    libtest_mimic::run(&arguments, trials).exit();
}

/// Cases hold as a whole, and by their assertions only.
fn holds(suite: &Suite, edition: &str, rule: &str) -> Result<(), Failed> {
    let scopes = [Scope::Full, Scope::AssertionsOnly];
    scopes.into_iter().try_for_each(|scope| holds_in_scope(suite, edition, rule, scope))
}

fn holds_in_scope(suite: &Suite, edition: &str, rule: &str, scope: Scope) -> Result<(), Failed> {
    let only = [rule.to_owned()];
    let plan = Plan {
        suite,
        edition: suite.edition(edition).expect("an edition of the suite"),
        only: &only,
        jobs: std::num::NonZero::<usize>::MIN,
        scope,
    };
    let run = certify(plan, &Reference::default(), &|| {});
    let wrong: Vec<_> = run
        .cases
        .iter()
        .filter(|result| result.rule.id == rule)
        .filter_map(|result| {
            let passes = result.verdict == Verdict::Pass || result.verdict.is_without_assertion();
            // An assertion about what not even the model shows would test nothing.
            let shown = format!("not shown: {:?}", result.masked);
            let said = if passes { shown } else { result.verdict.to_string() };
            (!passes || !result.masked.is_empty()).then(|| format!("{}: {said}", result.name))
        })
        .collect();
    if wrong.is_empty() {
        Ok(())
    } else {
        Err(format!("scope {}: {}", scope.words(), wrong.join("\n")).into())
    }
}
