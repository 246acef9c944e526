//! Options of choices in a file, as `gaugeblock fingerprint --format json` writes it.

use std::path::Path;

use gaugeblock_suite::Suite;
use gaugeblock_vocabulary::Options;

use super::user_files;
use crate::error::CliError;

/// Takes over the options that a fingerprint determined.
pub(crate) fn read_into(file: &Path, suite: &Suite, options: &mut Options) -> Result<(), CliError> {
    let name = file.display();
    let hint = "`gaugeblock fingerprint --controller CONTROLLER --format json` writes such a file";
    let text = user_files::read_text(file, "fingerprint (--options)")?;
    let document: serde_json::Value = serde_json::from_str(&text)
        .map_err(|error| CliError::usage(format!("{name}: {error}"), hint))?;
    let shown = document["options"]
        .as_object()
        .ok_or_else(|| CliError::usage(format!("{name}: it has no member `options`"), hint))?;
    for (id, shown) in shown {
        if let Some(option) = shown["option"].as_str() {
            let choice = suite.choices.iter().find(|choice| choice.id == *id);
            let known =
                choice.is_some_and(|choice| choice.options.iter().any(|o| o.name == option));
            if !known {
                return Err(CliError::usage(
                    format!("{name}: unknown option `{option}` for choice `{id}`"),
                    "run `gaugeblock fingerprint` again with this version",
                ));
            }
            options.0.insert(id.clone(), option.to_owned());
        }
    }
    Ok(())
}
