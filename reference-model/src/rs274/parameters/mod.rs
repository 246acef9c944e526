//! Numbered and named parameters, scopes, the predefined ones.

mod existence;
mod ini;
mod name;
mod numbered;
mod predefined;
mod rules;
mod store;
#[cfg(test)]
mod tests;

use gaugeblock_vocabulary::FaultKind;

use super::refusal::{StepError, refuse};
use super::state::State;
use crate::ids::{choice, rule};
pub use existence::exists;
pub use name::Name;
use name::is_global;
pub use numbered::{changed_persistent, computed_numbers, last};
pub(crate) use predefined::ParameterRules;
pub use rules::{refused_too, rules_of, rules_of_existence};
pub use store::{DEBUG_SWITCH, Parameters};

/// The value of a parameter.
///
/// Rule parameters.unset-numbered. A numbered parameter that was never set is zero.
/// Rule parameters.named-absent. A named parameter that does not exist is refused.
/// Rule parameters.named-local. A local named parameter belongs to the scope that assigned it.
/// Choice parameters.absent-global: whether a global one that was never set is refused or zero.
///
/// # Errors
/// It does not exist, or its value is not specified.
pub fn value(name: &Name, state: &State) -> Result<f64, StepError> {
    let name = match name {
        Name::Numbered(number) => return numbered::value(*number, state),
        Name::Named(name) => name,
    };
    if let Some(value) = predefined::value(name, state) {
        return value;
    }
    let set = if is_global(name) { &*state.parameters.named } else { &state.frame().locals };
    if let Some(value) = set.get(name) {
        return Ok(*value);
    }
    if ini::is_outside(name) {
        return ini::value(name, state);
    }
    if is_global(name) && state.choices.is(choice::parameters::AbsentGlobal::Zero) {
        return Ok(0.0);
    }
    let (rule, message) = if state.frames.iter().any(|frame| frame.locals.contains_key(name)) {
        (rule::parameters::NAMED_LOCAL, "belongs to another scope")
    } else if state.parameters.local_names.contains(name) {
        (rule::parameters::LOCAL_DELETED, "was deleted when its subroutine returned")
    } else {
        (rule::parameters::NAMED_ABSENT, "does not exist")
    };
    Err(refuse(rule, FaultKind::NoSuchParameter, format!("the parameter #<{name}> {message}")))
}

/// Gives a parameter a value.
///
/// Rule parameters.named. A named parameter comes into existence when it is assigned for the first time.
/// Rule parameters.named-global. A name that begins with an underscore is global: subs see and set it.
/// Rule parameters.local-numbers. Parameters 1 to 30 are local to a subroutine; 31 and up are global.
///
/// # Errors
/// It is read-only.
pub fn assign(name: &Name, value: f64, state: &mut State) -> Result<(), StepError> {
    writable(name, state)?;
    rules_of(name, state).into_iter().for_each(|rule| state.coverage.accepted(rule));
    state.parameters.written.insert(name.clone());
    match name {
        Name::Numbered(number) => numbered::assign(*number, value, state),
        Name::Named(name) if is_global(name) => {
            state.parameters.named.insert(name.clone(), value);
        }
        Name::Named(name) => {
            if !state.parameters.local_names.contains(name) {
                state.parameters.local_names.insert(name.clone());
            }
            state.frame_mut().locals.insert(name.clone(), value);
        }
    }
    Ok(())
}

/// Rule parameters.read-only. Assigning to a predefined named parameter is refused. Rule parameters.ini-read-only.
/// Assigning to an INI or HAL parameter is refused. Choice parameters.read-only-numbered: whether 5400 to 5428 can be
/// set.
///
/// # Errors
/// It is read-only.
pub fn writable(name: &Name, state: &State) -> Result<(), StepError> {
    let (rule, name) = match name {
        Name::Numbered(number) if numbered::is_computed(*number) => {
            if state.choices.is(choice::parameters::ReadOnlyNumbered::Written) {
                return Ok(());
            }
            (rule::parameters::READ_ONLY, number.to_string())
        }
        Name::Named(name) if predefined::is_predefined(name) => {
            (rule::parameters::READ_ONLY, format!("<{name}>"))
        }
        Name::Named(name)
            if ini::is_outside(name)
                && ini::entry(name, state).is_none()
                && state.dialect().may_assign_outside(name, state) =>
        {
            return Ok(());
        }
        Name::Named(name) if ini::is_outside(name) => {
            (rule::parameters::INI_READ_ONLY, format!("<{name}>"))
        }
        Name::Numbered(_) | Name::Named(_) => return Ok(()),
    };
    Err(refuse(rule, FaultKind::ReadOnlyParameter, format!("the parameter #{name} is read-only")))
}

/// Whether a parameter always reports the machine, whatever a program assigns to it.
pub fn is_told(name: &Name) -> bool {
    matches!(name, Name::Numbered(number) if numbered::is_computed(*number))
}
