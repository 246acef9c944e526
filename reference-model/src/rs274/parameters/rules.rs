//! Which rules the use of a parameter reaches.

use super::{Name, State, exists, ini, is_global, numbered, predefined};

/// The rules that a value read or a setting made reaches.
pub fn rules_of(name: &Name, state: &State) -> Vec<&'static str> {
    match name {
        Name::Numbered(number) => of_number(*number, state),
        Name::Named(name) => {
            if let Some(rule) = predefined::rule(name, state) {
                return vec![rule];
            }
            if ini::is_hal(name) {
                return vec!["parameters.hal", "parameters.hal-time", "parameters.ini-absent"];
            }
            if ini::is_outside(name) {
                return vec!["parameters.ini", "parameters.ini-absent"];
            }
            if is_global(name) {
                return vec![
                    "parameters.named",
                    "parameters.named-global",
                    "subroutines.global-named",
                ];
            }
            vec!["parameters.named", "parameters.named-local", "subroutines.local-named"]
        }
    }
}

fn of_number(number: u32, state: &State) -> Vec<&'static str> {
    let mut rules = Vec::with_capacity(8);
    rules.push("parameters.assignment");
    rules.push(match number {
        1..=31 => "parameters.local-numbers",
        5220 => "parameters.active-system",
        5221..=5390 => "parameters.system-origins",
        5400..=5413 => "parameters.tool",
        5420..=5428 => "parameters.position",
        5599 => "parameters.debug-switch",
        _ => "parameters.assignment",
    });
    if (5420..=5428).contains(&number) {
        rules.extend(["parameters.position-units", "offsets.position-parameters"]);
    }
    if number > 30 {
        rules.push("subroutines.global-numbered");
    }
    if state.machine.parameters.0.contains_key(&number) || (5161..=5390).contains(&number) {
        rules.push("parameters.stored");
    }
    if numbered::value(number, state).is_ok_and(|value| value.abs() <= 0.0) {
        rules.push("parameters.unset-numbered");
    }
    rules
}

/// The rules that EXISTS reaches besides its own.
pub fn rules_of_existence(name: &Name, state: &State) -> Vec<&'static str> {
    let Name::Named(text) = name else { return Vec::new() };
    if ini::is_outside(text) {
        let mut rules = vec!["parameters.ini-absent"];
        if !ini::is_enabled(text, state) {
            rules.push("parameters.ini-disabled");
        }
        return rules;
    }
    let mut rules = Vec::new();
    if !exists(name, state) && state.frames.iter().any(|frame| frame.locals.contains_key(text)) {
        rules.extend(["parameters.named-local", "subroutines.caller-locals"]);
    }
    if !exists(name, state) && state.parameters.local_names.contains(text) {
        rules.push("parameters.local-deleted");
    }
    rules
}

/// The rules that the refusal of an absent parameter reaches besides the one that it names.
pub fn refused_too(name: &Name, state: &State) -> Vec<&'static str> {
    let Name::Named(name) = name else { return Vec::new() };
    if ini::is_outside(name) {
        return ini::refused_too(name, state);
    }
    let mut rules = vec!["parameters.named-absent"];
    if state.frames.iter().any(|frame| frame.locals.contains_key(name)) {
        rules.push("subroutines.caller-locals");
        if state.frame().shares_parameters() {
            rules.push("fanuc-subs.named-locals");
        }
    } else if state.parameters.local_names.contains(name) {
        rules.push("subroutines.local-named-deleted");
    }
    rules
}
