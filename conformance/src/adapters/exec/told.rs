//! A scenario as it is told: what has its default is left out, as the protocol allows. Most of a scenario is options, and most of those
//! are the first of their choice.

use std::collections::BTreeMap;

use gaugeblock_trace::scenario::{Bench, Budget, OperatorEvent};
use gaugeblock_trace::{Machine, Options, Program, Scenario};
use serde::Serialize;

use super::super::HarnessError;
use crate::protocol::Ways;

/// Tells scenarios, and keeps what it told of options: scenarios share them.
#[derive(Clone, Debug, Default)]
pub(super) struct Teller {
    /// Options that need not be told.
    assumed: Options,
    /// Options that were to be told last, and what of them was.
    last: (Options, BTreeMap<String, String>),
}

impl Teller {
    /// One that leaves these options out.
    pub(super) fn new(assumed: Options) -> Self {
        Self { assumed, ..Self::default() }
    }

    /// A request to run a scenario, as a line; `operator` takes the place of its own.
    pub(super) fn run(
        &mut self,
        id: u64,
        (scenario, operator): (&Scenario, &[OperatorEvent]),
        ways: &Ways,
    ) -> Result<Vec<u8>, HarnessError> {
        let Scenario { program, options, machine, bench, operator: _, budget } = scenario;
        let told = Told {
            program,
            options: self.options(options),
            machine,
            bench: (*bench != Bench::default()).then_some(bench),
            operator,
            budget: (*budget != Budget::default()).then_some(budget),
        };
        let mut line = serde_json::to_vec(&Line { id, op: "run", scenario: told, ways })
            .map_err(|error| HarnessError::NotRun(error.to_string()))?;
        line.push(b'\n');
        Ok(line)
    }

    fn options(&mut self, options: &Options) -> &BTreeMap<String, String> {
        let is_last = std::ptr::eq(&*options.0, &*self.last.0.0);
        if !is_last {
            let differs = |(id, option): &(&String, &String)| self.assumed.get(id) != Some(option);
            let told = options.0.iter().filter(differs);
            let told = told.map(|(id, option)| (id.clone(), option.clone())).collect();
            self.last = (options.clone(), told);
        }
        &self.last.1
    }
}

#[derive(Serialize)]
struct Line<'a> {
    id: u64,
    op: &'static str,
    scenario: Told<'a>,
    #[serde(flatten)]
    ways: &'a Ways,
}

#[derive(Serialize)]
struct Told<'a> {
    program: &'a Program,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    options: &'a BTreeMap<String, String>,
    machine: &'a Machine,
    #[serde(skip_serializing_if = "Option::is_none")]
    bench: Option<&'a Bench>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    operator: &'a [OperatorEvent],
    #[serde(skip_serializing_if = "Option::is_none")]
    budget: Option<&'a Budget>,
}
