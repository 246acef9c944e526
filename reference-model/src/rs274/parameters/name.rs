//! Names of parameters.

use std::fmt;

/// A parameter by number or by name.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Name {
    /// `#31`: 1 to 5602.
    Numbered(u32),
    /// `#<name>`: lower case, without blanks; global when it begins with an underscore.
    Named(String),
}

impl Name {
    /// Whether it names a parameter that belongs to one call: a name that begins without an underscore.
    pub fn is_local_name(&self) -> bool {
        matches!(self, Self::Named(name) if !is_global(name))
    }
}

impl fmt::Display for Name {
    /// As it is written after `#`, a name without its marks.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Numbered(number) => number.fmt(f),
            Self::Named(name) => name.fmt(f),
        }
    }
}

/// Rule parameters.named-global. A name that begins with an underscore is global.
pub(super) fn is_global(name: &str) -> bool {
    name.starts_with('_')
}
