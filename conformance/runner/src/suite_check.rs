//! What the suite itself must satisfy: every declared outcome is reached, and every golden is current.

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_compare::alignment::changed_lines;
use gaugeblock_suite::{
    Case, Edition, MotionCase, MotionChoice, MotionChoiceOption, Rule, RuleOutcome, Setup, Suite,
};
use gaugeblock_vocabulary::Undetermined;

pub use crate::model_run::{editions_of, model_run};
use crate::orphans::orphans;

/// The outcomes of a rule that its own cases reach in the model, in any edition.
pub fn reached(suite: &Suite, rule: &Rule) -> BTreeSet<RuleOutcome> {
    let mut reached = BTreeSet::new();
    for case in &rule.cases {
        for edition in editions_of(suite, rule, case) {
            let (_, coverage) = model_run(suite, case, edition);
            reached.extend(coverage.into_iter().filter(|(id, _)| *id == rule.id).map(|(_, o)| o));
            if rule.outcomes.iter().all(|outcome| reached.contains(outcome)) {
                return reached;
            }
        }
    }
    reached
}

/// Every fault of the suite, as a sentence.
pub fn faults(suite: &Suite) -> Vec<String> {
    let mut faults = Vec::new();
    for rule in &suite.rules {
        let reached = reached(suite, rule);
        for outcome in rule.outcomes.iter().filter(|outcome| !reached.contains(outcome)) {
            faults.push(format!("{}: no case of its own reaches the outcome {outcome:?}", rule.id));
        }
        let recorded = rule.motion.iter().filter(|case| case.is_recorded());
        faults.extend(recorded.filter_map(|case| motion_fault(suite, rule, case)));
        if rule.cases.first().is_some_and(|case| case.golden.is_none()) {
            faults.push(format!("{}: its first case has no golden", rule.id));
        }
        for case in &rule.cases {
            faults.extend(golden_fault(suite, rule, case));
        }
    }
    faults.extend(orphans(suite));
    for choice in &suite.motion_choices {
        for option in &choice.options {
            let found = options_shown(suite, choice, &option.name);
            if found != [option.name.as_str()] {
                let id = &choice.id;
                faults.push(format!("{id} = {}: its samples match {found:?}", option.name));
            }
        }
    }
    faults
}

/// Why the laws do not decide a recorded case as its page asserts.
fn motion_fault(suite: &Suite, rule: &Rule, case: &MotionCase) -> Option<String> {
    let edition = suite.edition(gaugeblock_suite::DEFAULT_EDITION)?;
    let readings = suite.motion_options(edition);
    let found = judged(suite, edition, &rule.id, case, &readings).err()?;
    Some(format!("{} / {}: {found}", rule.id, case.name))
}

/// The options of a choice of motion whose assertions hold if the laws use one of them.
fn options_shown<'a>(suite: &Suite, choice: &'a MotionChoice, under: &str) -> Vec<&'a str> {
    let Some(edition) = suite.edition(gaugeblock_suite::DEFAULT_EDITION) else { return Vec::new() };
    let mut readings = suite.motion_options(edition);
    readings.insert(choice.id.clone(), under.to_owned());
    let holds = |option: &&MotionChoiceOption| {
        let case = MotionCase { assertions: option.assertions.clone(), ..choice.motion.clone() };
        judged(suite, edition, &choice.id, &case, &readings).is_ok()
    };
    choice.options.iter().filter(holds).map(|option| option.name.as_str()).collect()
}

fn judged(
    suite: &Suite,
    edition: &Edition,
    rule: &str,
    case: &MotionCase,
    readings: &BTreeMap<String, String>,
) -> Result<(), String> {
    let samples = gaugeblock_motion::synthesize(case)?;
    let (_, path) = gaugeblock_motion::scenario_and_path(
        case,
        &suite.options(edition),
        edition.environment.as_ref(),
    )?;
    gaugeblock_motion::check_assertions(case, rule, readings, (&samples, &path))
        .map_err(|(assertion, found)| format!("{assertion}, but: {found}"))
}

/// Why the model leaves a case open: it does not support it, or the documents do not decide it.
pub fn undetermined(suite: &Suite, rule: &Rule, case: &Case) -> Option<String> {
    let edition = editions_of(suite, rule, case).into_iter().next()?;
    let end = model_run(suite, case, edition).0.end;
    end.undetermined().map(|undetermined| match undetermined {
        Undetermined::Unsupported(why) | Undetermined::Unspecified(why) => why.to_owned(),
    })
}

/// The text that a case's golden must be: the model's outcome without what is at its default.
pub fn golden(suite: &Suite, rule: &Rule, case: &Case) -> Option<String> {
    let edition = editions_of(suite, rule, case).into_iter().next()?;
    let idle = Case { program: IDLE_PROGRAM.to_owned(), setup: Setup::default(), ..case.clone() };
    let defaults = model_run(suite, &idle, edition).0.to_text();
    Some(without_defaults(&model_run(suite, case, edition).0.to_text(), &defaults))
}

/// A program that changes nothing: its outcome has every setting and every state at its default.
const IDLE_PROGRAM: &str = "n1\n";

/// An outcome in text form without its first two lines, which the page itself says, and without each word of the
/// lines `start`, `parameters` and the first `state` that the outcome `defaults` has as well. A line that is left
/// without words is left out.
fn without_defaults(outcome: &str, defaults: &str) -> String {
    let mut is_first_state = true;
    let mut text = String::new();
    for line in outcome.lines().skip(2) {
        let keyword = line.split_whitespace().next().unwrap_or_default();
        let has_defaults = match keyword {
            "start" | "parameters" => true,
            "state" => std::mem::take(&mut is_first_state),
            _ => false,
        };
        let line = if has_defaults {
            let same_line = |other: &&str| other.split_whitespace().next() == Some(keyword);
            let default_line = defaults.lines().find(same_line).unwrap_or_default();
            let default_words: BTreeSet<_> = default_line.trim_start().split(' ').skip(1).collect();
            let kept: Vec<_> =
                line.split(' ').filter(|word| !default_words.contains(word)).collect();
            kept.join(" ")
        } else {
            line.to_owned()
        };
        let is_empty = matches!(line.trim(), "start" | "state" | "parameters");
        if !is_empty {
            text.push_str(&line);
            text.push('\n');
        }
    }
    text
}

fn golden_fault(suite: &Suite, rule: &Rule, case: &Case) -> Option<String> {
    let golden_text = case.golden.as_ref()?;
    let expected = golden(suite, rule, case)?;
    (expected != *golden_text).then(|| {
        let changed = changed_lines(golden_text, &expected);
        let changed = changed.lines().map(|line| format!("\n    {line}"));
        format!(
            "{} / {}: its golden is not current; - golden, + model:{}",
            rule.id,
            case.name,
            changed.collect::<String>()
        )
    })
}

#[cfg(test)]
mod tests {
    use super::without_defaults;

    #[test]
    fn a_golden_leaves_out_what_is_at_its_default() {
        let defaults = "gaugeblock outcome 0\nlanguage rs274\nstart units=mm plane=xy\nblock main.ngc:1\n  \
                        state motion=none position=()\nend fault\nparameters 5220=1\n";
        let outcome = "gaugeblock outcome 0\nlanguage rs274\nstart units=inch plane=xy\nblock main.ngc:1\n  \
                       set plane=xz\n  state motion=none position=(x1)\nblock main.ngc:2\n  state\n\
                       block main.ngc:3\n  state motion=none\nend program_end\nparameters 5220=1\n";
        let golden = "start units=inch\nblock main.ngc:1\n  set plane=xz\n  state position=(x1)\nblock main.ngc:2\n\
                      block main.ngc:3\n  state motion=none\nend program_end\n";
        assert_eq!(without_defaults(outcome, defaults), golden);
    }
}
