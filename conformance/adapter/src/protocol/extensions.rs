//! Extensions: what an adapter can do in addition to the required operations. Only declared extensions are used.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An extension that an adapter can declare.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[cfg_attr(any(feature = "clap", test), derive(clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum Extension {
    /// `cancel` ends a run that takes too long, and the session goes on
    Cancel,
    /// a run can be answered with a digest of its outcome
    Digest,
    /// answers can lie in files of a folder that `hello` names
    Files,
    /// each run begins as after power-on by itself: no `reset` comes between runs
    Fresh,
    /// the referee sends each operator event when the controller reaches its place
    LiveOperator,
    /// `move` answers with servo samples
    Motion,
    /// `shows` lists what is observable in one scenario, if that is less than declared
    Shows,
    /// `state` reports what is in force between runs
    State,
    /// the steps of a run can come in batches
    Stream,
}

/// Every extension, its name, and what an adapter that declares it does.
pub const EXTENSIONS: &[(Extension, &str, &str)] = &[
    (
        Extension::Cancel,
        "cancel",
        "`cancel` ends a run that takes too long, and the session goes on",
    ),
    (Extension::Digest, "digest", "a run can be answered with a digest of its outcome"),
    (Extension::Files, "files", "answers can lie in files of a folder that `hello` names"),
    (
        Extension::Fresh,
        "fresh",
        "each run begins as after power-on by itself: no `reset` comes between runs",
    ),
    (
        Extension::LiveOperator,
        "live-operator",
        "the referee sends each operator event when the controller reaches its place",
    ),
    (Extension::Motion, "motion", "`move` answers with servo samples"),
    (
        Extension::Shows,
        "shows",
        "`shows` lists what is observable in one scenario, if that is less than declared",
    ),
    (Extension::State, "state", "`state` reports what is in force between runs"),
    (Extension::Stream, "stream", "the steps of a run can come in batches"),
];

#[cfg(test)]
mod tests {
    use clap::ValueEnum as _;

    use super::*;

    #[test]
    fn each_extension_is_listed_by_its_name_in_declarations() {
        let listed: Vec<Extension> = EXTENSIONS.iter().map(|(extension, ..)| *extension).collect();
        assert_eq!(listed, Extension::value_variants());
        for (extension, name, _) in EXTENSIONS {
            assert_eq!(serde_json::to_value(extension).unwrap(), *name);
        }
    }
}
