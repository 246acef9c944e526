//! Entries of the INI file and HAL items.

use gaugeblock_trace::FaultKind;

use super::State;
use crate::rs274::refusal::{Halt, refuse};

/// Whether a name has the form of a HAL item: `_hal[item]`.
pub(super) fn is_hal(name: &str) -> bool {
    name.starts_with("_hal[") && name.ends_with(']')
}

/// Whether a name has the form of an INI entry, `_ini[section]name`, or of a HAL item.
pub(super) fn is_outside(name: &str) -> bool {
    is_hal(name) || ini_key(name).is_some()
}

/// Rule parameters.ini. `#<_ini[section]name>` is the value of that entry of the INI file; case does not count.
/// There is no HAL in a scenario, so no HAL item exists.
pub(super) fn entry(name: &str, state: &State) -> Option<f64> {
    let key = ini_key(name)?;
    let value = state
        .machine
        .ini
        .iter()
        .find(|(entry, _)| entry.to_uppercase() == key)
        .map(|(_, value)| *value);
    value.filter(|value| value.is_finite())
}

/// Rule parameters.ini-absent. Reading an absent INI entry or HAL item is refused.
pub(super) fn value(name: &str, state: &State) -> Result<f64, Halt> {
    entry(name, state).ok_or_else(|| {
        let message = format!("there is no #<{name}>");
        refuse("parameters.ini-absent", FaultKind::NoSuchParameter, message)
    })
}

/// The key of an entry, `[SECTION]NAME`.
fn ini_key(name: &str) -> Option<String> {
    let key = name.strip_prefix("_ini")?;
    (key.starts_with('[') && key.contains(']')).then(|| key.to_uppercase())
}
