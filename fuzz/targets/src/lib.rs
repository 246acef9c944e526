//! The fuzzing targets: each passes its bytes to a generator of `gaugeblock-fuzz` and the program to an oracle.
//!
//! The binaries in `fuzz_targets` are glue for libFuzzer. A test replays the corpus on stable Rust, so that each
//! finding stays covered.

use gaugeblock_adapter::{Adapter, HarnessError};
use gaugeblock_compare::compare;
use gaugeblock_compare::observe::Observed;
use gaugeblock_controllers::{Production, Reference};
use gaugeblock_fuzz::generate::{self, Entropy, malformed, metamorphic};
use gaugeblock_fuzz::oracle;
use gaugeblock_runner::fuzz::{comparable, is_fragile};
use gaugeblock_vocabulary::{End, Outcome, Scenario};

/// A target by name.
pub type Target = (&'static str, fn(&[u8]));

/// Every target.
pub const TARGETS: &[Target] = &[
    ("any_bytes", any_bytes),
    ("malformed_program", malformed_program),
    ("program", program),
    ("metamorphic", metamorphic),
    ("text_forms", text_forms),
];

/// Any bytes as a program: model and production end, do the same, and neither panics.
///
/// # Panics
/// A property does not hold.
pub fn any_bytes(bytes: &[u8]) {
    agree(&generate::raw(bytes));
}

/// The model keeps its invariants for a malformed program.
///
/// # Panics
/// A property does not hold.
pub fn malformed_program(bytes: &[u8]) {
    kept(oracle::model_invariants(&malformed::scenario(bytes)).map(drop));
}

/// A generated program does the same in model and production, however its text is chunked; and a run whose budget ran
/// out is the beginning of a longer one, in both.
///
/// # Panics
/// A property does not hold.
pub fn program(bytes: &[u8]) {
    let mut entropy = Entropy::from_bytes(bytes);
    let scenario = generate::scenario(&mut entropy, &generate::GeneratorConfig::default());
    agree(&scenario);
    kept(oracle::chunked_input(&scenario, &mut entropy));
    kept(oracle::budget_prefix(&scenario, &mut |scenario| of(&Reference::default(), scenario)));
    kept(oracle::budget_prefix(&scenario, &mut |scenario| of(&Production::default(), scenario)));
}

/// The programs of a metamorphic pair have equal effects, in model and production.
///
/// # Panics
/// They do not.
pub fn metamorphic(bytes: &[u8]) {
    let pair = metamorphic::pair(&mut Entropy::from_bytes(bytes));
    kept(oracle::metamorphic(&pair, &mut |scenario| of(&Reference::default(), scenario)));
    kept(oracle::metamorphic(&pair, &mut |scenario| of(&Production::default(), scenario)));
}

/// Bytes as the text form of a scenario or an outcome: what is read is written so that it is read again.
///
/// # Panics
/// It is not.
pub fn text_forms(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    if let Ok(scenario) = Scenario::from_text(text) {
        let again = scenario.to_text().and_then(|text| Scenario::from_text(&text));
        assert_eq!(again, Ok(scenario), "a scenario that is written is read equal");
    }
    if let Ok(outcome) = Outcome::from_text(text) {
        assert_eq!(Outcome::from_text(&outcome.to_text()), Ok(outcome), "so is an outcome");
    }
}

#[track_caller]
fn kept(promise: Result<(), String>) {
    if let Err(broken) = promise {
        panic!("{broken}");
    }
}

/// What a controller does, where it says anything of the scenario.
fn of(controller: &dyn Adapter, scenario: &Scenario) -> Option<Outcome> {
    controller.supports(scenario).ok()?;
    match controller.run(scenario) {
        Ok(outcome) => Some(outcome),
        Err(HarnessError::Crashed { status, stderr }) => panic!("{status}: {stderr}"),
        Err(_) => None,
    }
}

/// What is known of a scenario when both sides have run it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Agreement {
    /// They do the same.
    Same,
    /// One of them does not say what it does to the end, or the last bit of a function or of a point decides.
    Open,
}

/// Model and production do the same with a scenario, where both say what that is.
///
/// # Panics
/// They differ, or one of them crashes.
#[track_caller]
pub fn agree(scenario: &Scenario) -> Agreement {
    agree_with(&Production::default(), scenario)
}

/// The model and a controller do the same with a scenario, where both say what that is. Of one that is not ours no
/// more is asked than by `fuzz`.
///
/// # Panics
/// They differ, or one of them crashes.
#[track_caller]
pub fn agree_with(controller: &dyn Adapter, scenario: &Scenario) -> Agreement {
    let reference = Reference::default();
    let sides = (of(&reference, scenario), of(controller, scenario));
    let (Some(expected), Some(found)) = sides else { return Agreement::Open };
    let silent = |outcome: &Outcome| {
        matches!(outcome.end, End::Unsupported { .. } | End::Unspecified { .. })
    };
    if silent(&expected) || silent(&found) {
        return Agreement::Open;
    }
    let (expected, found) =
        if controller.is_in_process() { (expected, found) } else { comparable(expected, found) };
    let observables = reference.observables(scenario).and(&controller.observables(scenario));
    let comparison = compare(&Observed::of(&expected), &Observed::of(&found), &observables);
    match comparison.divergence {
        None => Agreement::Same,
        Some(_) if is_fragile(scenario) => Agreement::Open,
        Some(divergence) => panic!("{divergence}\n{}", scenario.to_text().unwrap_or_default()),
    }
}
