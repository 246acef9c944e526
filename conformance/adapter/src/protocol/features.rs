//! Features: what a scenario requires of a controller in addition to its program. They select the cases.

use std::collections::BTreeSet;

use gaugeblock_vocabulary::scenario::{Environment, Start, ToolChange};
use gaugeblock_vocabulary::{Machine, Program, Scenario};

/// Every feature, and what a controller that declares it can do.
pub const FEATURES: &[(&str, &str)] = &[
    ("another-environment", "its inputs and signals behave like those of a named environment"),
    ("axes", "its axes can be others than X Y Z A B C"),
    ("block-delete", "blocks that begin with a slash can be skipped"),
    ("fanuc-subs-off", "M98 and M99 can be switched off"),
    ("files", "subroutines can be in files of their own"),
    ("ini", "programs can read entries of an INI file"),
    ("inputs", "inputs can be wired to outputs, and change while a program runs"),
    ("io-counts", "the number of inputs and outputs can differ from 4 of each kind"),
    ("limits", "axes can have limits"),
    ("manual-tool-change", "a person changes tools when the controller requests it"),
    ("mdi", "blocks can be entered by hand"),
    ("operator", "a person can act while a program runs: pause, resume, abort, overrides"),
    ("orient", "a spindle's encoder can answer late, never, or with a fault"),
    ("orient-offset", "an offset can be added to R of M19"),
    ("parameters", "parameters can be stored before a run"),
    ("probe", "a probe can make contact"),
    ("random-tool-changer", "tools change places in the changer"),
    ("spindles", "there can be more than one spindle"),
    ("tool-change-settings", "a tool change can move, retract, or leave the spindle on"),
    ("tool-change-time", "a tool change takes a time that can be set"),
    ("tools", "a tool table can be loaded before a run"),
    ("user-programs", "user-defined M codes can run programs"),
];

/// The features that a scenario requires.
pub fn needed(scenario: &Scenario) -> BTreeSet<&'static str> {
    let Scenario { program, options: _, machine, environment, operator, budget: _ } = scenario;
    let mut needed = BTreeSet::new();
    let mut needs = |name, is_needed: bool| {
        if is_needed {
            needed.insert(name);
        }
    };
    needs("operator", !operator.is_empty());
    of_program(program, &mut needs);
    of_machine(machine, &mut needs);
    of_environment(environment, &mut needs);
    needed
}

fn of_program(program: &Program, needs: &mut impl FnMut(&'static str, bool)) {
    let Program { language: _, main: _, files, block_delete, start } = program;
    needs("files", !files.is_empty());
    needs("block-delete", *block_delete);
    needs("mdi", *start == Start::Mdi);
}

fn of_machine(machine: &Machine, needs: &mut impl FnMut(&'static str, bool)) {
    let usual = Machine::default();
    let Machine {
        length_unit: _,
        axes,
        limits,
        spindles,
        digital_io,
        analog_io,
        orient_offset,
        tool_change,
        random_tool_changer,
        fanuc_subs,
        tools,
        parameters,
        ini,
    } = machine;
    needs("axes", *axes != usual.axes);
    needs("limits", !limits.is_empty());
    needs("spindles", *spindles != usual.spindles);
    needs("io-counts", (*digital_io, *analog_io) != (usual.digital_io, usual.analog_io));
    needs("orient-offset", *orient_offset != 0.0);
    needs("tool-change-settings", *tool_change != ToolChange::default());
    needs("random-tool-changer", *random_tool_changer);
    needs("fanuc-subs-off", !fanuc_subs);
    needs("tools", !tools.is_empty());
    needs("parameters", !parameters.0.is_empty());
    needs("ini", !ini.is_empty());
}

fn of_environment(environment: &Environment, needs: &mut impl FnMut(&'static str, bool)) {
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
    needs("another-environment", name.is_some());
    needs("inputs", !wires.is_empty() || !inputs.is_empty());
    needs("orient", !orient.is_empty());
    needs("probe", probe.is_some());
    needs("tool-change-time", *tool_change_time != 0.0);
    needs("manual-tool-change", *manual_tool_change);
    needs("user-programs", !user_programs.is_empty());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_program_needs_no_features() {
        assert!(needed(&Scenario::of("g0 x1\n")).is_empty());
        let mut scenario = Scenario::of("g0 x1\n");
        scenario.machine.spindles = 2;
        scenario.program.start = Start::Mdi;
        assert_eq!(needed(&scenario), BTreeSet::from(["mdi", "spindles"]));
    }

    #[test]
    fn features_are_sorted_and_unique() {
        assert!(FEATURES.is_sorted_by(|a, b| a.0 < b.0));
    }
}
