//! What a verification prints.

use std::fmt::Write as _;

use gaugeblock_certificate::{Coverage, PREDICATE_TYPE, Predicate, RunResult};
use gaugeblock_report::{Counts, escape_line};
use gaugeblock_runner::certify::Scope;
use serde_json::{Value, json};

use super::rerun::Rerun;
use super::verification::{Signed, Verification};

/// Version of the JSON form.
const VERSION: u32 = 1;

/// A verification for people.
pub(super) fn text(found: &Verification) -> String {
    let mut text = String::new();
    for signed in &found.certificates {
        text.push_str(&certificate(signed));
    }
    for note in &found.notes {
        line(&mut text, "note", note);
    }
    if let Some(rerun) = &found.rerun {
        line(&mut text, "rerun", &rerun_in_words(rerun));
        for change in &rerun.changes {
            let (rule, case) = (&change.rule, &change.case);
            let (certified, found) = (&change.certified, &change.found);
            line(&mut text, "", &format!("{rule} / {case}: certified {certified}; now {found}"));
        }
    }
    for problem in &found.problems {
        line(&mut text, "problem", problem);
    }
    let verdict = match (found.is_verified(), found.result()) {
        (false, _) => "NOT VERIFIED",
        (true, RunResult::Passes) => "verified; the run passes",
        (true, RunResult::Fails) => "verified; the run FAILS",
        (true, RunResult::Unfinished) => "verified; the run is UNFINISHED",
    };
    let _infallible = writeln!(text, "{verdict}");
    text
}

fn line(text: &mut String, key: &str, value: &str) {
    let _infallible = writeln!(text, "{key:<11} {}", escape_line(value));
}

/// A certificate, a line for each thing that it says.
fn certificate(signed: &Signed) -> String {
    let predicate = &signed.statement.predicate;
    let run = &predicate.run;
    let mut text = String::new();
    line(&mut text, "certificate", &signed.file);
    line(&mut text, "signed", &format!("key {}, {}", signed.key, signed.comment));
    line(&mut text, "controller", &format!("{} {}", run.controller, run.version));
    if !run.accuracy.is_exact() {
        line(&mut text, "accuracy", &run.accuracy.to_string());
    }
    for file in &run.controller_files {
        line(&mut text, "", &format!("{} sha256:{}", file.name, file.sha256));
    }
    line(&mut text, "suite", &format!("{} sha256:{}", run.suite, predicate.suite_sha256));
    line(&mut text, "edition", &edition(predicate));
    line(&mut text, "coverage", &coverage(signed));
    line(&mut text, "cases", &counts(predicate.counts));
    for profile in &predicate.profiles {
        let claimed = if profile.claimed { "claimed" } else { "not claimed" };
        let passes = if profile.passes { "passed" } else { "NOT passed" };
        let words = format!("{} {}: {claimed}, {passes}", profile.profile, profile.version);
        line(&mut text, "profile", &words);
    }
    for list in &predicate.lists {
        let words = format!("{} {} sha256:{}", list.kind.word(), list.file, list.sha256);
        line(&mut text, "list", &words);
    }
    for mismatch in predicate.mismatches.iter().flatten() {
        line(&mut text, "mismatch", &mismatch.to_string());
    }
    for note in &predicate.notes {
        line(&mut text, "run note", note);
    }
    line(&mut text, "made", &made(predicate));
    text
}

fn edition(predicate: &Predicate) -> String {
    let run = &predicate.run;
    let options = run.options.0.iter().map(|(id, option)| format!("{id} = {option}"));
    let scope = match run.scope {
        Scope::Full => None,
        Scope::AssertionsOnly => {
            Some("ASSERTIONS ONLY: outcomes were not compared with the model's".to_owned())
        }
    };
    let parts = std::iter::once(run.edition.clone()).chain(scope).chain(options);
    parts.collect::<Vec<_>>().join(", ")
}

fn coverage(signed: &Signed) -> String {
    let predicate = &signed.statement.predicate;
    let (run, count) = (&predicate.run, signed.statement.case_count());
    let shards = match predicate.shards.len() {
        0 => String::new(),
        count => format!(", merged of {count} shards"),
    };
    match predicate.coverage {
        Coverage::Complete => format!("complete, shard {}: {count} cases{shards}", run.shard),
        Coverage::Partial => format!(
            "PARTIAL, shard {}: {count} cases{shards} of --only {}",
            run.shard,
            run.only.join(" --only ")
        ),
    }
}

fn counts(counts: Counts) -> String {
    let all = [
        (counts.pass, "pass"),
        (counts.diverges, "diverge"),
        (counts.side_difference, "differ aside"),
        (counts.known, "known"),
        (counts.waived, "waived"),
        (counts.unsupported, "unsupported"),
        (counts.not_judged(), "not judged"),
    ];
    let named = all.into_iter().filter(|(count, _)| *count > 0);
    named.map(|(count, word)| format!("{count} {word}")).collect::<Vec<_>>().join(", ")
}

fn made(predicate: &Predicate) -> String {
    let (tool, host) = (&predicate.tool, &predicate.host);
    format!(
        "{} with {} {} on {} {}",
        predicate.made, tool.name, tool.version, host.system, host.architecture
    )
}

fn rerun_in_words(rerun: &Rerun) -> String {
    if let Some(other) = &rerun.other_controller {
        return format!("not run: another controller: {other}");
    }
    let Rerun { percent, seed, cases, .. } = rerun;
    let result = match rerun.changes.len() {
        0 => "every verdict is the same".to_owned(),
        1 => "1 verdict is another one".to_owned(),
        count => format!("{count} verdicts are other ones"),
    };
    format!("{percent} % of the cases, {cases}, chosen by seed {seed}: {result}")
}

/// A verification for programs: what the certificates say without their cases.
pub(super) fn json(found: &Verification) -> String {
    let rerun = found.rerun.as_ref().map(|rerun| {
        let changes = rerun.changes.iter().map(|change| {
            let (rule, case) = (&change.rule, &change.case);
            json!({ "rule": rule, "case": case, "certified": change.certified, "found": change.found })
        });
        json!({
            "percent": rerun.percent, "seed": rerun.seed, "cases": rerun.cases,
            "other_controller": rerun.other_controller, "changes": changes.collect::<Vec<_>>(),
        })
    });
    let result = if found.is_verified() { json!(found.result()) } else { Value::Null };
    let document = json!({
        "gaugeblock": "verification", "schema": VERSION, "predicate_type": PREDICATE_TYPE,
        "verified": found.is_verified(), "result": result,
        "certificates": found.certificates.iter().map(in_short).collect::<Vec<_>>(),
        "problems": found.problems, "notes": found.notes, "rerun": rerun,
    });
    format!("{document:#}\n")
}

fn in_short(signed: &Signed) -> Value {
    let mut predicate = serde_json::to_value(&signed.statement.predicate).unwrap_or_default();
    if let Some(fields) = predicate.as_object_mut() {
        fields.remove("rules");
    }
    json!({
        "file": signed.file, "key": signed.key, "comment": signed.comment,
        "subject": signed.statement.subject, "predicate": predicate,
    })
}
