//! Machine, environment, operator and options back to their defaults.

use gaugeblock_vocabulary::scenario::{Environment, Machine};
use gaugeblock_vocabulary::{Options, Scenario};

use super::search::Search;

/// Leaves out subroutine files.
pub(super) fn files(search: &mut Search<'_>) {
    let names: Vec<String> = search.best.program.files.keys().cloned().collect();
    for name in names {
        attempt(search, |scenario| {
            scenario.program.files.remove(&name);
        });
    }
}

/// Everything that is not the program.
pub(super) fn setup(search: &mut Search<'_>, options: &Options) {
    attempt(search, |scenario| scenario.program.block_delete = false);
    attempt(search, |scenario| scenario.operator.clear());
    for place in (0..search.best.operator.len()).rev() {
        attempt(search, |scenario| {
            scenario.operator.remove(place);
        });
    }
    machine(search);
    environment(search);
    attempt(search, |scenario| scenario.options.clone_from(options));
    let ids: Vec<String> = search.best.options.0.keys().cloned().collect();
    for id in ids {
        if search.best.options.get(&id) != options.get(&id) {
            attempt(search, |scenario| {
                match options.get(&id) {
                    Some(option) => scenario.options.0.insert(id.clone(), option.to_owned()),
                    None => scenario.options.0.remove(&id),
                };
            });
        }
    }
}

fn machine(search: &mut Search<'_>) {
    let default = Machine::default;
    attempt(search, |scenario| scenario.machine = default());
    attempt(search, |scenario| scenario.machine.length_unit = default().length_unit);
    attempt(search, |scenario| scenario.machine.axes = default().axes);
    attempt(search, |scenario| scenario.machine.limits.clear());
    attempt(search, |scenario| scenario.machine.spindles = default().spindles);
    attempt(search, |scenario| scenario.machine.digital_io = default().digital_io);
    attempt(search, |scenario| scenario.machine.analog_io = default().analog_io);
    attempt(search, |scenario| scenario.machine.orient_offset = default().orient_offset);
    attempt(search, |scenario| scenario.machine.tool_change = default().tool_change);
    attempt(search, |scenario| {
        scenario.machine.random_tool_changer = default().random_tool_changer;
    });
    attempt(search, |scenario| scenario.machine.fanuc_subs = default().fanuc_subs);
    attempt(search, |scenario| scenario.machine.ini.clear());
    for place in (0..search.best.machine.tools.len()).rev() {
        attempt(search, |scenario| {
            scenario.machine.tools.remove(place);
        });
    }
    let numbers: Vec<u32> = search.best.machine.parameters.0.keys().copied().collect();
    for number in numbers {
        attempt(search, |scenario| {
            scenario.machine.parameters.0.remove(&number);
        });
    }
}

fn environment(search: &mut Search<'_>) {
    let name = search.best.environment.name.clone();
    attempt(search, |scenario| {
        scenario.environment = Environment { name: name.clone(), ..Environment::default() }
    });
    attempt(search, |scenario| scenario.environment.wires.clear());
    attempt(search, |scenario| scenario.environment.orient.clear());
    attempt(search, |scenario| scenario.environment.probe = None);
    attempt(search, |scenario| scenario.environment.tool_change_time = 0.0);
    for place in (0..search.best.environment.inputs.len()).rev() {
        attempt(search, |scenario| {
            scenario.environment.inputs.remove(place);
        });
    }
    for place in (0..search.best.environment.user_programs.len()).rev() {
        attempt(search, |scenario| {
            scenario.environment.user_programs.remove(place);
        });
    }
}

fn attempt(search: &mut Search<'_>, change: impl FnOnce(&mut Scenario)) {
    let mut smaller = search.best.clone();
    change(&mut smaller);
    search.attempt(smaller);
}
