//! The rules that the program of each case uses, by the model.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use gaugeblock_suite::{Case, Edition, Rule, Suite};

use super::spectrum::{SpectrumCase, WHOLE};
use crate::certify::CaseResult;
use crate::model_run::model_run;

/// What the cases of a suite use under an edition; each case is run by the model once, when it is first needed.
#[derive(Debug)]
pub struct Coverage<'a> {
    suite: &'a Suite,
    edition: &'a Edition,
    /// Ids of the suite's rules.
    ids: BTreeSet<&'a str>,
    /// By rule and name of the case.
    cases: BTreeMap<(&'a str, &'a str), Rc<SpectrumCase<'a>>>,
}

impl<'a> Coverage<'a> {
    /// Of no case yet.
    pub fn new(suite: &'a Suite, edition: &'a Edition) -> Self {
        let ids = suite.rules.iter().map(|rule| rule.id.as_str()).collect();
        Self { suite, edition, ids, cases: BTreeMap::new() }
    }

    /// What a case uses.
    pub(super) fn case(&mut self, result: &CaseResult<'a>) -> Rc<SpectrumCase<'a>> {
        let Self { suite, edition, ids, cases } = self;
        let used = cases.entry((result.rule.id.as_str(), result.name)).or_insert_with(|| {
            let case = result.case();
            let reached = case.map(|case| model_run(suite, case, edition).1).unwrap_or_default();
            let known = reached
                .iter()
                .filter_map(|(id, outcome)| ids.get(id.as_str()).map(|id| (*id, *outcome)));
            Rc::new(SpectrumCase::new(&result.rule.id, known, share(result.rule, case)))
        });
        Rc::clone(used)
    }
}

/// The share of a case in its grid.
fn share(rule: &Rule, case: Option<&Case>) -> u64 {
    let Some(grid) = case.and_then(|case| case.grid) else { return WHOLE };
    let cells = rule.cases.iter().filter(|case| case.grid == Some(grid)).count();
    u64::try_from(cells).map_or(WHOLE, |cells| WHOLE / cells.max(1))
}
