//! Which rules the use of a parameter reaches.

use super::existence::exists;
use super::name::{Name, is_global};
use super::{State, ini, numbered, predefined};
use crate::ids::{Rule, rule};

/// The rules that a value read or a setting made reaches.
pub fn rules_of(name: &Name, state: &State) -> Vec<Rule> {
    match name {
        Name::Numbered(number) => of_number(*number, state),
        Name::Named(name) => {
            if let Some(rule) = predefined::rule(name, state) {
                return vec![rule];
            }
            if ini::is_hal(name) {
                return vec![
                    rule::parameters::HAL,
                    rule::parameters::HAL_TIME,
                    rule::parameters::INI_ABSENT,
                ];
            }
            if ini::is_outside(name) {
                return vec![rule::parameters::INI, rule::parameters::INI_ABSENT];
            }
            if is_global(name) {
                return vec![
                    rule::parameters::NAMED,
                    rule::parameters::NAMED_GLOBAL,
                    rule::subroutines::GLOBAL_NAMED,
                ];
            }
            vec![
                rule::parameters::NAMED,
                rule::parameters::NAMED_LOCAL,
                rule::subroutines::LOCAL_NAMED,
            ]
        }
    }
}

fn of_number(number: u32, state: &State) -> Vec<Rule> {
    let mut rules = Vec::with_capacity(8);
    rules.push(rule::parameters::ASSIGNMENT);
    rules.push(match number {
        1..=31 => rule::parameters::LOCAL_NUMBERS,
        5220 => rule::parameters::ACTIVE_SYSTEM,
        5221..=5390 => rule::parameters::SYSTEM_ORIGINS,
        5400..=5413 => rule::parameters::TOOL,
        5420..=5428 => rule::parameters::POSITION,
        5599 => rule::parameters::DEBUG_SWITCH,
        _ => rule::parameters::ASSIGNMENT,
    });
    if (5420..=5428).contains(&number) {
        rules.extend([rule::parameters::POSITION_UNITS, rule::offsets::POSITION_PARAMETERS]);
    }
    if number > 30 {
        rules.push(rule::subroutines::GLOBAL_NUMBERED);
    }
    if state.machine.parameters.0.contains_key(&number) || (5161..=5390).contains(&number) {
        rules.push(rule::parameters::STORED);
    }
    if numbered::value(number, state).is_ok_and(|value| value.abs() <= 0.0) {
        rules.push(rule::parameters::UNSET_NUMBERED);
    }
    rules
}

/// The rules that EXISTS reaches besides its own.
pub fn rules_of_existence(name: &Name, state: &State) -> Vec<Rule> {
    let Name::Named(text) = name else { return Vec::new() };
    if ini::is_outside(text) {
        let mut rules = vec![rule::parameters::INI_ABSENT];
        if !ini::is_enabled(text, state) {
            rules.push(rule::parameters::INI_DISABLED);
        }
        return rules;
    }
    let mut rules = Vec::new();
    if !exists(name, state) && state.frames.iter().any(|frame| frame.locals.contains_key(text)) {
        rules.extend([rule::parameters::NAMED_LOCAL, rule::subroutines::CALLER_LOCALS]);
    }
    if !exists(name, state) && state.parameters.local_names.contains(text) {
        rules.push(rule::parameters::LOCAL_DELETED);
    }
    rules
}

/// The rules that the refusal of an absent parameter reaches besides the one that it names.
pub fn refused_too(name: &Name, state: &State) -> Vec<Rule> {
    let Name::Named(name) = name else { return Vec::new() };
    if ini::is_outside(name) {
        return ini::refused_too(name, state);
    }
    let mut rules = vec![rule::parameters::NAMED_ABSENT];
    if state.frames.iter().any(|frame| frame.locals.contains_key(name)) {
        rules.push(rule::subroutines::CALLER_LOCALS);
        if state.frame().shares_parameters() {
            rules.push(rule::fanuc_subs::NAMED_LOCALS);
        }
    } else if state.parameters.local_names.contains(name) {
        rules.push(rule::subroutines::LOCAL_NAMED_DELETED);
    }
    rules
}
