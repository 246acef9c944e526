//! Selection of the cases that a plan runs, in the order of a report.

use gaugeblock_suite::{Case, MotionCase, Rule, Selection};

use super::plan::Plan;
use crate::shard::Shard;

/// Rule and name of each case of a plan, in order. `laws` selects cases of motion with recorded samples, for a
/// controller that judges them; without it, those that a controller plans.
pub fn cases<'a>(plan: Plan<'a>, laws: bool, shard: Shard) -> Vec<(&'a str, &'a str)> {
    let cases = select(plan, laws).shard(shard).cases.into_iter();
    cases.map(|(rule, subject)| (rule.id.as_str(), subject.name())).collect()
}

/// Rules that do not exist in the edition of a plan, and why.
pub fn not_applicable(plan: Plan<'_>) -> Vec<(&Rule, &str)> {
    select(plan, false).not_applicable
}

/// A case of either kind.
#[derive(Clone, Copy, Debug)]
pub(super) enum Subject<'a> {
    Run(&'a Case),
    Motion(&'a MotionCase),
}

impl<'a> Subject<'a> {
    pub(super) fn name(self) -> &'a str {
        match self {
            Self::Run(case) => &case.name,
            Self::Motion(case) => &case.name,
        }
    }
}

#[derive(Clone, Debug)]
pub(super) struct Selected<'a> {
    pub(super) not_applicable: Vec<(&'a Rule, &'a str)>,
    pub(super) cases: Vec<(&'a Rule, Subject<'a>)>,
}

impl Selected<'_> {
    /// Keeps the cases of a shard.
    pub(super) fn shard(mut self, shard: Shard) -> Self {
        let mut places = 0..;
        self.cases.retain(|_| places.next().is_some_and(|place| shard.has(place)));
        self
    }
}

/// Selects the cases of a plan. Cases with recorded samples are for controllers with laws of motion (`laws`), the other
/// cases of motion for controllers that plan.
pub(super) fn select<'a>(plan: Plan<'a>, laws: bool) -> Selected<'a> {
    let edition = &plan.edition.id;
    let mut not_applicable = Vec::new();
    let mut cases = Vec::new();
    let selection = Selection::of(plan.only);
    let wanted = |rule: &&Rule| selection.has_rule(rule, plan.edition);
    let speaks = |rule: &&Rule| rule.language == plan.edition.language;
    for rule in plan.suite.rules.iter().filter(wanted).filter(speaks) {
        if let Some(why) = rule.void.get(edition) {
            not_applicable.push((rule, why.as_str()));
            continue;
        }
        let runs = |case: &&Case| case.runs_in(plan.edition);
        cases.extend(rule.cases.iter().filter(runs).map(|case| (rule, Subject::Run(case))));
        let concerns = |case: &&MotionCase| case.is_recorded() == laws;
        let motion = rule.motion.iter().filter(concerns);
        cases.extend(motion.map(|case| (rule, Subject::Motion(case))));
    }
    cases.retain(|(rule, subject)| selection.has_case(rule, subject.name(), plan.edition));
    Selected { not_applicable, cases }
}
