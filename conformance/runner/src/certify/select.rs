//! Which cases a plan runs, in which order they are told.

use gaugeblock_suite::{Case, MotionCase, Rule};

use super::plan::Plan;
use crate::shard::Shard;

/// Rule and name of each case that a plan runs, in order, on a controller that has laws of motion, or that moves.
pub fn cases<'a>(plan: Plan<'a>, laws: bool, shard: Shard) -> Vec<(&'a str, &'a str)> {
    let cases = select(plan, laws).of(shard).cases.into_iter();
    cases.map(|(rule, subject)| (rule.id.as_str(), subject.name())).collect()
}

/// Rules that do not exist in the edition of a plan, and why.
pub fn void(plan: Plan<'_>) -> Vec<(&Rule, &str)> {
    select(plan, false).void
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
    pub(super) void: Vec<(&'a Rule, &'a str)>,
    pub(super) cases: Vec<(&'a Rule, Subject<'a>)>,
}

impl Selected<'_> {
    /// A part of the cases.
    pub(super) fn of(mut self, shard: Shard) -> Self {
        let mut places = 0..;
        self.cases.retain(|_| places.next().is_some_and(|place| shard.has(place)));
        self
    }
}

/// What is run. Samples of a case are for who has laws, its program alone is for who moves.
pub(super) fn select<'a>(plan: Plan<'a>, laws: bool) -> Selected<'a> {
    let edition = &plan.edition.id;
    let mut void = Vec::new();
    let mut cases = Vec::new();
    let wanted = |rule: &&Rule| {
        plan.only.is_empty() || plan.only.iter().any(|p| rule.id.starts_with(p.as_str()))
    };
    let speaks = |rule: &&Rule| rule.language == plan.edition.language;
    for rule in plan.suite.rules.iter().filter(wanted).filter(speaks) {
        if let Some(why) = rule.void.get(edition) {
            void.push((rule, why.as_str()));
            continue;
        }
        let runs = |case: &&Case| case.editions.is_empty() || case.editions.contains(edition);
        cases.extend(rule.cases.iter().filter(runs).map(|case| (rule, Subject::Run(case))));
        let concerns = |case: &&MotionCase| case.is_recorded() == laws;
        let motion = rule.motion.iter().filter(concerns);
        cases.extend(motion.map(|case| (rule, Subject::Motion(case))));
    }
    Selected { void, cases }
}
