//! Makes the statement of a report.

use gaugeblock_report::{ControllerFile, Header, ProfileResult, Report, json};
use gaugeblock_runner::certify::CaseResult;

use super::case::CertifiedCase;
use super::digest::sha256;
use super::statement::{
    AcceptanceList, CertifiedProfile, CertifiedRule, CertifiedShard, Coverage, Digest, Host,
    PREDICATE_TYPE, Predicate, RunResult, STATEMENT_TYPE, Seeds, Statement, Subject,
    SubjectAnnotations, Tool,
};

/// What a report does not say about its run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Circumstances {
    /// What judged the controller.
    pub tool: Tool,
    /// The machine on which the statement is made.
    pub host: Host,
    /// Lists that the run was compared with.
    pub lists: Vec<AcceptanceList>,
    /// The shards that were merged.
    pub shards: Vec<CertifiedShard>,
    /// When the run began; none for a merged run.
    pub started: Option<String>,
    /// When the statement is made.
    pub made: String,
}

impl Statement {
    /// The statement of a report.
    ///
    /// # Errors
    /// The report names no file of the controller, or a case failed only after other programs: such a run is not a
    /// certificate.
    pub fn of(report: &Report<'_>, circumstances: Circumstances) -> Result<Self, String> {
        let header = report.header.clone();
        if header.controller_files.is_empty() {
            return Err("the report names no file of the controller".to_owned());
        }
        if let Some((case, _)) = report.leaks().first() {
            return Err(format!(
                "{} / {} fails only after other programs: such a run is not a certificate",
                case.rule.id, case.name
            ));
        }
        let Circumstances { tool, host, lists, shards, started, made } = circumstances;
        Ok(Self {
            statement_type: STATEMENT_TYPE.to_owned(),
            subject: subjects(&header),
            predicate_type: PREDICATE_TYPE.to_owned(),
            predicate: Predicate {
                coverage: coverage(&header),
                suite_sha256: report.suite.sha256.clone(),
                tolerances: gaugeblock_compare::tolerance::VERSION,
                tool,
                result: result(report),
                counts: report.counts(),
                profiles: profiles(&report.profiles),
                lists,
                mismatches: report.mismatches.clone(),
                notes: report.notes.clone(),
                seeds: Seeds::default(),
                report_sha256: sha256(json::text(report)),
                shards,
                host,
                started,
                made,
                rules: rules(report),
                run: header,
            },
        })
    }
}

/// The files of the controller of a run.
pub(crate) fn subjects(header: &Header) -> Vec<Subject> {
    let subject = |file: &ControllerFile| Subject {
        name: file.name.clone(),
        digest: Digest { sha256: file.sha256.clone() },
        annotations: SubjectAnnotations {
            controller: header.controller.clone(),
            version: header.version.clone(),
        },
    };
    header.controller_files.iter().map(subject).collect()
}

pub(crate) fn coverage(header: &Header) -> Coverage {
    if header.only.is_empty() { Coverage::Complete } else { Coverage::Partial }
}

pub(crate) fn result(report: &Report<'_>) -> RunResult {
    match report.exit_status() {
        0 => RunResult::Passes,
        1 => RunResult::Fails,
        _ => RunResult::Unfinished,
    }
}

/// The profiles that were claimed, and those that passed.
pub(crate) fn profiles(results: &[ProfileResult<'_>]) -> Vec<CertifiedProfile> {
    let named = results.iter().filter(|result| result.claimed || result.passes());
    let profile = |result: &ProfileResult<'_>| CertifiedProfile {
        profile: result.profile.id.clone(),
        version: result.profile.version,
        claimed: result.claimed,
        passes: result.passes(),
    };
    named.map(profile).collect()
}

/// Each rule with its cases, in the order of the run.
fn rules(report: &Report<'_>) -> Vec<CertifiedRule> {
    let results = report.rules().into_iter();
    let rule = results.map(|result| {
        let is_its = |case: &&CaseResult<'_>| case.rule.id == result.rule.id;
        CertifiedRule {
            rule: result.rule.id.clone(),
            verdict: result.verdict,
            cases: report.run.cases.iter().filter(is_its).map(CertifiedCase::of).collect(),
        }
    });
    rule.collect()
}
