//! What `run` remarks about a run that a person may have expected to go on in another way.

use std::collections::BTreeSet;
use std::path::Path;

use gaugeblock_vocabulary::{BlockLocation, End, Language, Outcome, Scenario};

use super::called_files::{code, without_names};
use super::own_name::location_name;

/// Remarks, each with its place and a hint.
pub(crate) fn remarks(outcome: &Outcome, scenario: &Scenario, file: &Path) -> Vec<String> {
    let mut remarks = unknown_tools(outcome, scenario, file);
    remarks.extend(pause(outcome, file));
    remarks
}

/// A program that pauses waits for an operator.
fn pause(outcome: &Outcome, file: &Path) -> Option<String> {
    let block = &outcome.steps.last().filter(|_| outcome.end == End::Paused)?.block;
    let BlockLocation { file: named, line } = block;
    Some(format!(
        "{}: the program pauses here, and the scenario has no operator event that resumes it\n\
         hint: add to the file of --scenario: operator = [{{ when = {{ block = {{ file = \"{named}\", line = {line} }}, \
         offset = 1 }}, action = \"resume\" }}]",
        place(block, file)
    ))
}

/// Tools that the program selects and the tool table does not have: without a fault the run goes on with no tool.
fn unknown_tools(outcome: &Outcome, scenario: &Scenario, file: &Path) -> Vec<String> {
    if scenario.program.language != Language::Rs274 {
        return Vec::new();
    }
    let mut unknown: Vec<(u32, &BlockLocation)> = Vec::new();
    let mut seen = BTreeSet::new();
    let lines = scenario.program.lines();
    let known: BTreeSet<u32> = scenario.machine.tools.iter().map(|known| known.number).collect();
    for step in outcome.steps.iter().filter(|step| step.state.is_some()) {
        let Some(tool) = lines.line(&step.block).and_then(selected_tool) else {
            continue;
        };
        if tool != 0 && !known.contains(&tool) && seen.insert(tool) {
            unknown.push((tool, &step.block));
        }
    }
    let remarks = unknown.iter().map(|(tool, block)| {
        format!(
            "{}: tool {tool} is not in the tool table, and this edition does not refuse it: the run has no such tool\n\
             hint: --tools FILE reads a tool table; `gaugeblock explain tool.select-unknown` has the options",
            place(block, file)
        )
    });
    remarks.collect()
}

/// The tool that a block selects by a plain number.
fn selected_tool(line: &str) -> Option<u32> {
    if !line.contains(['t', 'T']) {
        return None;
    }
    let words = without_names(&code(line));
    let digits = |rest: &str| {
        let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
        rest[..end].parse().ok()
    };
    words.split('t').skip(1).find_map(digits).filter(|_| !words.starts_with('o'))
}

fn place(block: &BlockLocation, file: &Path) -> String {
    format!("{}:{}", location_name(block, file), block.line)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn selected_tool_is_a_plain_number() {
        for (line, tool) in [
            ("T99 M6", Some(99)),
            ("g0 x1 t 5", Some(5)),
            ("x[sqrt[4]] (t5)", None),
            ("t#1", None),
            ("#<t1> = 5", None),
        ] {
            assert_eq!(selected_tool(line), tool, "{line}");
        }
    }
}
