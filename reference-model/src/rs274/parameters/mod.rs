//! Numbered and named parameters, scopes, the predefined ones.

mod ini;
mod numbered;
mod predefined;
mod rules;
#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use gaugeblock_vocabulary::{FaultKind, Indexed, Machine, Shared};

use super::refusal::{StepError, refuse};
use super::state::State;
use crate::Choices;
use crate::ids::{choice, rule};
pub use numbered::{DEBUG_SWITCH, changed_persistent, computed_numbers, last};
pub(crate) use predefined::ParameterRules;
pub use rules::{refused_too, rules_of, rules_of_existence};

/// A parameter by number or by name.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Name {
    /// `#31`: 1 to 5602.
    Numbered(u32),
    /// `#<name>`: lower case, without blanks; global when it begins with an underscore.
    Named(String),
}

impl Name {
    /// Whether it names a parameter that belongs to one call: it is no number and begins without an underscore.
    pub fn is_local_name(&self) -> bool {
        matches!(self, Self::Named(name) if !is_global(name))
    }
}

impl fmt::Display for Name {
    /// As it stands behind `#`, a name without its marks.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Numbered(number) => number.fmt(f),
            Self::Named(name) => name.fmt(f),
        }
    }
}

/// Global parameters. The local ones are in the frames.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parameters {
    /// Numbers 31 and up that were stored or set; coordinate systems in the machine's length unit.
    numbered: Shared<BTreeMap<u32, f64>>,
    /// Global named parameters that the program has set.
    named: Shared<BTreeMap<String, f64>>,
    /// Names that were local parameters somewhere: tells a deleted one from one that never was.
    local_names: Shared<BTreeSet<String>>,
    /// Settings of the block that is being executed, which take effect at its end.
    announced: Vec<(Name, f64)>,
    /// Parameters that were given a value since somebody asked last, the same one or another.
    written: BTreeSet<Name>,
    /// `#<_value>`: what the last return gave; zero when nothing.
    pub returned: f64,
    /// `#<_value_returned>`: whether the last return gave a value.
    pub has_returned: bool,
}

impl Parameters {
    /// The parameters when a program starts: the stored ones, and 0 for all others except #5220 and #5599.
    pub fn new(machine: &Machine, _readings: &Choices) -> Self {
        Self { numbered: numbered::at_start(machine).into(), ..Self::default() }
    }

    /// A numbered parameter as it is stored (coordinate systems: machine unit); zero when never set.
    pub fn stored(&self, number: u32) -> f64 {
        self.numbered.get(&number).copied().unwrap_or(0.0)
    }

    /// Stores a numbered parameter without any check.
    pub fn store(&mut self, number: u32, value: f64) {
        self.written.insert(Name::Numbered(number));
        self.numbered.insert(number, value);
    }

    /// The parameters that were given a value since this was asked last.
    pub fn take_written(&mut self) -> Vec<Name> {
        if self.written.is_empty() {
            // Most blocks set none.
            return Vec::new();
        }
        std::mem::take(&mut self.written).into_iter().collect()
    }

    /// All stored numbered parameters that are not zero. The local ones are not among them: they are in the
    /// frames.
    pub fn nonzero(&self) -> Indexed<u32, f64> {
        self.numbered
            .iter()
            .filter(|(_, value)| value.abs() > 0.0)
            .map(|(number, value)| (*number, *value))
            .collect()
    }

    /// The settings of the block that is to be executed.
    pub fn announce(&mut self, settings: &[(Name, f64)]) {
        self.announced = settings.to_vec();
    }

    /// What the block that is being executed sets a parameter to, if it does.
    pub fn announced(&self, name: &Name) -> Option<f64> {
        self.announced
            .iter()
            .rev()
            .find(|(announced, _)| announced == name)
            .map(|(_, value)| *value)
    }
}

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

/// Whether a parameter tells what the machine is, whatever a program sets it to.
pub fn is_told(name: &Name) -> bool {
    matches!(name, Name::Numbered(number) if numbered::is_computed(*number))
}

/// Whether a parameter exists. Numbered ones always do.
pub fn exists(name: &Name, state: &State) -> bool {
    match name {
        Name::Numbered(_) => true,
        Name::Named(name) => {
            predefined::is_predefined(name)
                || state.parameters.named.contains_key(name)
                || state.frame().locals.contains_key(name)
                || ini::entry(name, state).is_some()
        }
    }
}

/// Rule parameters.named-global. A name that begins with an underscore is global.
fn is_global(name: &str) -> bool {
    name.starts_with('_')
}
