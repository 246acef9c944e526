//! Known issues: each file of `conformance/known-issues` states a program and what each side does with it today.
//!
//! A behaviour that changes fails this test, also where the change fixes the issue: then the file is deleted or becomes
//! a case of the suite. LinuxCNC's `rs274` runs where it is installed. The issues of the folder `motion` are programs
//! of `gaugeblock motion fuzz`, and the law that each breaks.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use gaugeblock_adapter::Adapter;
use gaugeblock_controllers::{Production, Reference};
use gaugeblock_fuzz::motion::MotionProgram;
use gaugeblock_fuzz::motion::transformation::Transformation;
use gaugeblock_linuxcnc::Rs274;
use gaugeblock_runner::motion_programs::{judge_program, motion_program, time_breach_id};
use gaugeblock_suite::Suite;
use gaugeblock_vocabulary::scenario::{Budget, Environment, Machine, OperatorEvent};
use gaugeblock_vocabulary::{Axis, Options, Program, Scenario};
use serde::Deserialize;

/// A known issue.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Issue {
    title: String,
    /// Sections of the documents that the issue concerns.
    sections: Vec<String>,
    /// Why it is open, and what would close it.
    status: String,
    edition: String,
    program: String,
    /// Options beside those of the edition.
    #[serde(default)]
    options: Options,
    #[serde(default)]
    files: BTreeMap<String, String>,
    #[serde(default)]
    machine: Machine,
    #[serde(default)]
    environment: Environment,
    #[serde(default)]
    operator: Vec<OperatorEvent>,
    #[serde(default)]
    budget: Budget,
    reference: Option<Observation>,
    production: Option<Observation>,
    rs274: Option<Observation>,
    printed: Option<Printed>,
    /// Options of the command `rs274`.
    #[serde(default)]
    printed_options: Vec<String>,
}

/// Random motion programs that break a law.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct MotionIssue {
    title: String,
    status: String,
    program: Vec<BreachOf>,
}

/// A motion program, by seed and number, and the law that it breaks.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct BreachOf {
    seed: u64,
    number: u64,
    breaks: String,
}

/// What `rs274` and `gaugeblock rs274` print.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Printed {
    rs274: Observation,
    gaugeblock: Observation,
}

/// Parts of an outcome's text form, or of a printed text.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Observation {
    /// It contains each of these.
    #[serde(default)]
    has: Vec<String>,
    /// It contains none of these.
    #[serde(default)]
    lacks: Vec<String>,
}

impl Observation {
    /// What is not as stated.
    fn contradictions(&self, text: &str) -> Vec<String> {
        assert!(!self.has.is_empty(), "an observation states something that is there");
        let absent = self.has.iter().filter(|part| !text.contains(part.as_str()));
        let present = self.lacks.iter().filter(|part| text.contains(part.as_str()));
        absent
            .map(|part| format!("lacks {part:?}"))
            .chain(present.map(|part| format!("has {part:?}")))
            .collect()
    }
}

impl Issue {
    fn scenario(&self, suite: &Suite) -> Scenario {
        let edition = suite.editions.iter().find(|edition| edition.id == self.edition);
        let edition = edition.unwrap_or_else(|| panic!("no edition `{}`", self.edition));
        let mut options = suite.options(edition);
        for (id, option) in &self.options.0 {
            options.0.insert(id.clone(), option.clone());
        }
        let mut environment = self.environment.clone();
        if environment == Environment::default() {
            environment.name.clone_from(&edition.environment);
        }
        let program = Program {
            language: edition.language,
            main: self.program.clone(),
            files: self.files.clone(),
            ..Program::default()
        };
        Scenario {
            program,
            options,
            machine: self.machine.clone(),
            environment,
            operator: self.operator.clone(),
            budget: self.budget,
        }
    }
}

/// What a controller does, in text form.
fn outcome(controller: &dyn Adapter, scenario: &Scenario) -> String {
    match controller.run(scenario) {
        Ok(outcome) => outcome.to_text(),
        Err(error) => error.to_string(),
    }
}

/// What a command prints of the issue's program, to standard output and then to standard error.
fn printed(mut command: Command, issue: &Issue, folder: &Path) -> String {
    command.current_dir(folder).env("HOME", folder).env("LC_ALL", "C").stdin(Stdio::null());
    let output = command.args(&issue.printed_options).args(["-g", "main.ngc"]).output();
    let output = output.expect("the command runs");
    [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned()).concat()
}

#[test]
fn known_issues_are_as_stated() {
    let pages = gaugeblock_embedded_suite::files().expect("the pages of the suite");
    let suite = Suite::read(&pages).expect("the suite");
    let rs274 = Rs274::find(None).ok();
    let scratch = Path::new(env!("CARGO_TARGET_TMPDIR")).join("known-issues");
    fs::create_dir_all(&scratch).expect("a folder for the test");
    let mut changed = Vec::new();
    let mut count = 0;
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../known-issues");
    for entry in fs::read_dir(folder).expect("the folder of known issues") {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        let text = fs::read_to_string(&path).expect("a known issue");
        let issue: Issue =
            toml::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let told = [&issue.title, &issue.status].into_iter().chain(&issue.sections);
        assert!(
            !issue.sections.is_empty() && told.into_iter().all(|text| !text.is_empty()),
            "{name}"
        );
        let scenario = issue.scenario(&suite);
        let mut check =
            |side: &str, observation: Option<&Observation>, text: &dyn Fn() -> String| {
                let Some(observation) = observation else { return };
                let text = text();
                count += 1;
                for contradiction in observation.contradictions(&text) {
                    changed.push(format!("{name}: {side} {contradiction}\n{text}"));
                }
            };
        check("the model", issue.reference.as_ref(), &|| outcome(&Reference::default(), &scenario));
        check("production", issue.production.as_ref(), &|| {
            outcome(&Production::default(), &scenario)
        });
        if let Some(rs274) = &rs274 {
            check("rs274", issue.rs274.as_ref(), &|| outcome(rs274, &scenario));
        }
        if let Some(Printed { rs274: theirs, gaugeblock: ours }) = issue.printed.as_ref() {
            fs::write(scratch.join("main.ngc"), &issue.program).expect("the program");
            let mut check = |side: &str, observation: &Observation, command: Command| {
                let text = printed(command, &issue, &scratch);
                for contradiction in observation.contradictions(&text) {
                    changed.push(format!("{name}: {side} {contradiction}\n{text}"));
                }
            };
            let mut command = Command::new(env!("CARGO_BIN_EXE_gaugeblock"));
            command.arg("rs274");
            check("gaugeblock rs274", ours, command);
            if rs274.is_some() {
                check("rs274", theirs, Command::new("rs274"));
            }
        }
    }
    assert!(count > 0, "no known issue is checked");
    assert!(
        changed.is_empty(),
        "known issues have changed; if one is fixed, delete its file in conformance/known-issues \
         or turn it into a case:\n{}",
        changed.join("\n")
    );
}

#[test]
fn known_motion_issues_are_as_stated() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../known-issues/motion/time.toml");
    let text = fs::read_to_string(path).expect("the known issues of motion");
    let issue: MotionIssue = toml::from_str(&text).expect("a known issue of motion");
    assert!(!issue.title.is_empty() && !issue.status.is_empty());
    let production = Production::default();
    let runs = |program: &MotionProgram| {
        let mut scenario = Scenario::of(program.text());
        scenario.machine.axes = Axis::ALL.to_vec();
        production.run(&scenario).expect("production runs it")
    };
    let mut fixed = Vec::new();
    for BreachOf { seed, number, breaks } in issue.program {
        let (program, _) = motion_program(seed, number);
        let change =
            Transformation::ALL.into_iter().find(|change| breaks == time_breach_id(*change));
        let change = change.expect("a law of time");
        let result = judge_program((seed, number), (&program, &[change]), &runs);
        if result.broken.iter().all(|breach| breach.what != breaks) {
            fixed.push(format!(
                "seed {seed}, program {number}: {breaks} is kept: {:?}",
                result.broken
            ));
        }
    }
    assert!(
        fixed.is_empty(),
        "known issues have changed; delete these programs in conformance/known-issues/motion:\n{}",
        fixed.join("\n")
    );
}
