//! Encodes scenarios for the protocol, without members that have their default. Most of a scenario is options, and most
//! options are the first of their choice.

use std::collections::BTreeMap;
use std::ops::Not;

use gaugeblock_vocabulary::scenario::{
    Budget, Environment, InputChange, OperatorEvent, OrientAnswer, ProbeContact, RunPoint, Start,
    UserProgram,
};
use gaugeblock_vocabulary::{Language, Machine, Options, Program, Scenario};
use serde::Serialize;
use serde_json::value::RawValue;

use crate::HarnessError;
use crate::protocol::{RunModes, Stream};

/// Bytes that hold most requests.
const REQUEST_BYTES_USUAL: usize = 4 << 10;

/// Encodes scenarios. It keeps the encoded options, which many scenarios share.
#[derive(Clone, Debug, Default)]
pub(super) struct ScenarioEncoder {
    /// Options that requests leave out.
    assumed: Options,
    /// The last options, and their encoded form.
    last: (Options, Option<Box<RawValue>>),
    /// The machine that requests leave out.
    usual: Machine,
}

impl ScenarioEncoder {
    /// An encoder that leaves these options out.
    pub(super) fn new(assumed: Options) -> Self {
        Self { assumed, ..Self::default() }
    }

    /// Encodes a request to run a scenario; `operator` replaces the scenario's own events.
    pub(super) fn encode_run(
        &mut self,
        id: u64,
        (scenario, operator): (&Scenario, &[OperatorEvent]),
        modes: &RunModes,
    ) -> Result<Vec<u8>, HarnessError> {
        let not_told = |error: serde_json::Error| HarnessError::NotRun(error.to_string());
        let Scenario { program, options, machine, environment, operator: _, budget } = scenario;
        self.encode_options(options).map_err(not_told)?;
        let RunModes { stream, digest, live } = modes;
        let encoded = WireScenario {
            program: WireProgram::of(program),
            options: self.last.1.as_deref(),
            machine: (*machine != self.usual).then_some(machine),
            environment: (*environment != Environment::default())
                .then(|| WireEnvironment::of(environment)),
            operator,
            budget: (*budget != Budget::default()).then_some(budget),
        };
        let mut line = Vec::with_capacity(REQUEST_BYTES_USUAL);
        let request =
            Line { id, op: "run", scenario: encoded, stream: *stream, digest: *digest, live };
        serde_json::to_writer(&mut line, &request).map_err(not_told)?;
        line.push(b'\n');
        Ok(line)
    }

    /// Encodes these options.
    fn encode_options(&mut self, options: &Options) -> serde_json::Result<()> {
        if std::ptr::eq(&*options.0, &*self.last.0.0) {
            return Ok(());
        }
        let differs = |(id, option): &(&String, &String)| self.assumed.get(id) != Some(option);
        let encoded: BTreeMap<_, _> = options.0.iter().filter(differs).collect();
        let text =
            (!encoded.is_empty()).then(|| serde_json::value::to_raw_value(&encoded)).transpose()?;
        self.last = (options.clone(), text);
        Ok(())
    }
}

#[derive(Serialize)]
struct Line<'a> {
    id: u64,
    op: &'static str,
    scenario: WireScenario<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stream: Option<Stream>,
    #[serde(skip_serializing_if = "Not::not")]
    digest: bool,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    live: &'a [RunPoint],
}

#[derive(Serialize)]
struct WireScenario<'a> {
    program: WireProgram<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    options: Option<&'a RawValue>,
    #[serde(skip_serializing_if = "Option::is_none")]
    machine: Option<&'a Machine>,
    #[serde(skip_serializing_if = "Option::is_none")]
    environment: Option<WireEnvironment<'a>>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    operator: &'a [OperatorEvent],
    #[serde(skip_serializing_if = "Option::is_none")]
    budget: Option<&'a Budget>,
}

/// A program; its language and its text are always written.
#[derive(Serialize)]
struct WireProgram<'a> {
    language: Language,
    main: &'a str,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    files: &'a BTreeMap<String, String>,
    #[serde(skip_serializing_if = "Not::not")]
    block_delete: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    start: Option<Start>,
}

impl<'a> WireProgram<'a> {
    fn of(program: &'a Program) -> Self {
        let Program { language, main, files, block_delete, start } = program;
        let start = (*start != Start::default()).then_some(*start);
        Self { language: *language, main, files, block_delete: *block_delete, start }
    }
}

#[derive(Serialize)]
struct WireEnvironment<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<&'a str>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    wires: &'a BTreeMap<String, u16>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    inputs: &'a [InputChange],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    orient: &'a [OrientAnswer],
    #[serde(skip_serializing_if = "Option::is_none")]
    probe: Option<ProbeContact>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tool_change_time: Option<f64>,
    #[serde(skip_serializing_if = "Not::not")]
    manual_tool_change: bool,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    user_programs: &'a [UserProgram],
}

impl<'a> WireEnvironment<'a> {
    fn of(environment: &'a Environment) -> Self {
        let Environment {
            name,
            wires,
            inputs,
            orient,
            probe,
            tool_change_time,
            manual_tool_change,
            user_programs,
        } = environment;
        Self {
            name: name.as_deref(),
            wires,
            inputs,
            orient,
            probe: *probe,
            tool_change_time: (tool_change_time.to_bits() != 0).then_some(*tool_change_time),
            manual_tool_change: *manual_tool_change,
            user_programs,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::protocol::{Operation, Request};

    fn round_trip(scenario: &Scenario, encoder: &mut ScenarioEncoder) -> (String, Scenario) {
        let line =
            encoder.encode_run(7, (scenario, &scenario.operator), &RunModes::default()).unwrap();
        let Request { operation, .. } = serde_json::from_slice(&line).unwrap();
        let Operation::Run { scenario, .. } = operation else { panic!("{operation:?}") };
        (String::from_utf8(line).unwrap(), *scenario)
    }

    #[test]
    fn defaults_are_not_encoded() {
        let (line, _) = round_trip(&Scenario::of("m2\n"), &mut ScenarioEncoder::default());
        let run =
            r#"{"id":7,"op":"run","scenario":{"program":{"language":"rs274","main":"m2\n"}}}"#;
        assert_eq!(line, format!("{run}\n"));
    }

    #[test]
    fn encoded_scenario_round_trips() {
        let mut scenario = Scenario::of("m2\n");
        scenario.program.block_delete = true;
        scenario.program.start = Start::Mdi;
        scenario.program.files.insert("a.ngc".to_owned(), "m2".to_owned());
        scenario.options = Options([("a".to_owned(), "b".to_owned())].into());
        scenario.machine.spindles = 3;
        scenario.environment.probe = Some(ProbeContact::Never);
        scenario.environment.tool_change_time = 2.5;
        scenario.environment.manual_tool_change = true;
        scenario.environment.orient = vec![OrientAnswer::Never];
        scenario.environment.wires.insert("1".to_owned(), 2);
        scenario.environment.user_programs = vec![UserProgram::default()];
        scenario.budget.steps = 5;
        let mut encoder = ScenarioEncoder::default();
        for name in [None, Some("another")] {
            scenario.environment.name = name.map(str::to_owned);
            assert_eq!(round_trip(&scenario, &mut encoder).1, scenario);
        }
    }
}
