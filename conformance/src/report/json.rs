//! The report as one JSON document; its form is version 0 until the adapter protocol is frozen.

use serde_json::{Value, json};

use super::stored::StoredCase;
use super::{Report, RuleVerdict};

/// The report as JSON.
pub fn json(report: &Report<'_>) -> Value {
    let counts = report.counts();
    let rules: Vec<Value> = report
        .rules()
        .into_iter()
        .map(|result| {
            json!({
                "rule": result.rule.id,
                "sentence": result.rule.sentence,
                "profile": result.rule.profile,
                "sources": result.rule.sources,
                "verdict": result.verdict,
                "cases": result.counts.all(),
                "compared": result.compared,
            })
        })
        .collect();
    let cases: Vec<StoredCase> = report.run.cases.iter().map(StoredCase::of).collect();
    let void: Vec<Value> =
        report.run.void.iter().map(|(rule, why)| json!({ "rule": rule.id, "why": why })).collect();
    json!({
        "gaugeblock": "report",
        "schema": gaugeblock_trace::schema::VERSION,
        "tolerances": crate::compare::tolerance::VERSION,
        "controller": report.header.controller,
        "version": report.header.version,
        "notes": report.notes,
        "edition": report.header.edition,
        "options": report.header.options,
        "suite": report.header.suite,
        "gaugeblock_version": report.header.gaugeblock_version,
        "only": report.header.only,
        "laws": report.header.laws,
        "shard": report.header.shard,
        "exit_status": report.exit_status(),
        "counts": {
            "cases": counts.all(),
            "pass": counts.pass,
            "diverges": counts.diverges,
            "charged_elsewhere": counts.charged_elsewhere,
            "unsupported": counts.unsupported,
            "not_judged": counts.not_judged,
        },
        "profiles": profiles(report),
        "rules": rules,
        "void": void,
        "cases": cases,
        "expectations": report.troubles,
    })
}

/// Each profile: claimed or not, passed or not, and how many rules came to what.
fn profiles(report: &Report<'_>) -> Vec<Value> {
    report
        .profiles
        .iter()
        .map(|result| {
            json!({
                "profile": result.profile.id,
                "version": result.profile.version,
                "claimed": result.claimed,
                "passes": result.passes(),
                "rules": result.rules(),
                "pass": result.count(RuleVerdict::Pass),
                "diverges": result.count(RuleVerdict::Diverges),
                "unsupported": result.count(RuleVerdict::Unsupported),
                "not_judged": result.count(RuleVerdict::NotJudged),
                "not_run": result.not_run,
            })
        })
        .collect()
}
