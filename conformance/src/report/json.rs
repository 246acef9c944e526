//! The report as one JSON document; its form is version 0 until the adapter protocol is frozen.

use serde_json::{Value, json};

use super::{Report, RuleVerdict};
use crate::certify::Verdict;

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
    let cases: Vec<Value> = report
        .run
        .cases
        .iter()
        .map(|result| {
            let mut case = json!({
                "rule": result.rule.id,
                "case": result.name,
                "compared": result.compared,
                "masked": result.masked,
                "repeated": result.repeated,
            });
            let (verdict, more) = match &result.verdict {
                Verdict::Pass => ("pass", json!(null)),
                Verdict::Diverges(departure) => (
                    "diverges",
                    json!({
                        "found": departure.line(),
                        "divergence": departure.divergence,
                        "explanation": departure.explanation,
                        "program": result.program,
                    }),
                ),
                Verdict::ChargedElsewhere(departure) => (
                    "charged elsewhere",
                    json!({ "found": departure.line(), "explanation": departure.explanation }),
                ),
                Verdict::Unsupported(why) => ("unsupported", json!({ "reason": why })),
                Verdict::Inconclusive(why) => ("inconclusive", json!({ "reason": why })),
                Verdict::NotJudged(why) => ("not judged", json!({ "reason": why })),
            };
            case["verdict"] = json!(verdict);
            if !more.is_null() {
                case["why"] = more;
            }
            case
        })
        .collect();
    let void: Vec<Value> =
        report.run.void.iter().map(|(rule, why)| json!({ "rule": rule.id, "why": why })).collect();
    json!({
        "gaugeblock": "report",
        "schema": gaugeblock_trace::schema::VERSION,
        "tolerances": crate::compare::tolerance::VERSION,
        "controller": report.controller.name,
        "version": report.controller.version,
        "notes": report.notes,
        "edition": report.run.edition.id,
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
