//! Entries of the INI file and HAL items.

use gaugeblock_vocabulary::FaultKind;

use super::State;
use crate::ids::{Rule, rule};
use crate::rs274::environment::Item;
use crate::rs274::refusal::{StepError, refuse};

/// Whether a name has the form of a HAL item: `_hal[item]`.
pub(super) fn is_hal(name: &str) -> bool {
    hal_item(name).is_some()
}

/// Whether a name has the form of an INI entry, `_ini[section]name`, or of a HAL item.
pub(super) fn is_outside(name: &str) -> bool {
    is_hal(name) || ini_key(name).is_some()
}

/// Rule parameters.ini. `#<_ini[section]name>` is the value of that entry of the INI file; case does not count.
/// Rule parameters.hal. `#<_hal[item]>` is the value of that HAL item, its name in lower case.
/// Rule parameters.ini-disabled. Where the INI file disables one of them, none of it is there.
pub(super) fn entry(name: &str, state: &State) -> Option<f64> {
    if !is_enabled(name, state) {
        return None;
    }
    if let Some(item) = hal_item(name) {
        // The interpreter program `rs274` has no HAL.
        let machine = Some(&state.machine).filter(|_| !state.environment.is_stand_alone())?;
        return Item::of(item, machine).map(|item| state.environment.item(item));
    }
    ini_value(ini_key(name)?, state)
}

/// Rule parameters.ini-absent. Reading an absent INI entry or HAL item is refused.
pub(super) fn value(name: &str, state: &State) -> Result<f64, StepError> {
    entry(name, state).ok_or_else(|| {
        let message = format!("there is no #<{name}>");
        refuse(rule::parameters::INI_ABSENT, FaultKind::NoSuchParameter, message)
    })
}

/// The rules that the refusal of an absent one reaches besides its own.
pub(super) fn refused_too(name: &str, state: &State) -> Vec<Rule> {
    let mut rules = Vec::new();
    if !is_enabled(name, state) {
        rules.push(rule::parameters::INI_DISABLED);
    } else if is_hal(name) {
        rules.push(rule::parameters::HAL);
    }
    rules
}

/// Whether the INI file lets programs read what this is one of; unless it says otherwise it does.
pub(super) fn is_enabled(name: &str, state: &State) -> bool {
    let key = if is_hal(name) { "[RS274NGC]HAL_PIN_VARS" } else { "[RS274NGC]INI_VARS" };
    ini_value(key, state) != Some(0.0)
}

/// Of letters only those of ASCII have a case, as everywhere in the language.
fn ini_value(key: &str, state: &State) -> Option<f64> {
    let entries = &state.machine.ini;
    let value = entries.iter().find(|(entry, _)| entry.eq_ignore_ascii_case(key));
    value.map(|(_, value)| *value).filter(|value| value.is_finite())
}

/// The item of a name `_hal[item]`.
fn hal_item(name: &str) -> Option<&str> {
    name.strip_prefix("_hal[")?.strip_suffix(']')
}

/// The key of an entry, `[section]name`.
fn ini_key(name: &str) -> Option<&str> {
    name.strip_prefix("_ini").filter(|key| key.starts_with('[') && key.contains(']'))
}
