//! Whether a parameter exists.

use super::State;
use super::name::Name;
use super::{ini, predefined};

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
