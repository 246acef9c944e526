//! The suite that a call names, and an edition of it with its options.

use std::path::Path;

use gaugeblock_suite::{Edition, Suite, files};
use gaugeblock_vocabulary::Options;

use crate::error::CliError;

/// Reads the pages of a folder, or else those of this program.
pub(crate) fn read_suite(folder: Option<&Path>) -> Result<Suite, CliError> {
    let files = match folder {
        Some(folder) => files::of_folder(folder).map_err(|error| {
            CliError::usage(error, "--suite expects a folder like conformance/suite; without it the built-in suite is used")
        })?,
        None => gaugeblock_embedded_suite::files().map_err(|error| {
            CliError::usage(error, "--suite expects a folder like conformance/suite")
        })?,
    };
    if let Some(folder) = folder
        && !files.contains_key("editions.toml")
    {
        return Err(CliError::usage(
            format!("{} is not a suite: it has no editions.toml", folder.display()),
            "--suite expects a folder like conformance/suite; without it the built-in suite is used",
        ));
    }
    gaugeblock_runner::language::read_suite(&files).map_err(|errors| {
        let count = errors.len();
        let shown: Vec<_> = errors.into_iter().take(20).collect();
        let more = if count > shown.len() {
            format!("\n… {} more", count - shown.len())
        } else {
            String::new()
        };
        CliError::usage(
            format!(
                "{count} {} in the suite:\n{}{more}",
                if count == 1 { "error" } else { "errors" },
                shown.join("\n")
            ),
            "the suite's README.md describes the form of a page",
        )
    })
}

/// The edition of an id, one whose options the model of this build has.
pub(crate) fn edition<'a>(suite: &'a Suite, id: &str) -> Result<&'a Edition, CliError> {
    let edition = any_edition(suite, id)?;
    in_this_build(&suite.options(edition))?;
    Ok(edition)
}

/// Refuses options that the model of this build does not have.
fn in_this_build(options: &Options) -> Result<(), CliError> {
    gaugeblock_reference::accepts_options(options).map_err(|why| {
        CliError::usage(
            format!("the reference model of this build does not support this: {why}"),
            "build gaugeblock with its default features, or choose an edition of documents",
        )
    })
}

/// The edition of an id, whether the model of this build has its options or not.
pub(crate) fn any_edition<'a>(suite: &'a Suite, id: &str) -> Result<&'a Edition, CliError> {
    suite.edition(id).ok_or_else(|| {
        let known: Vec<_> = suite.editions.iter().map(|edition| edition.id.as_str()).collect();
        CliError::usage(
            format!("unknown edition `{id}`"),
            format!("expected one of: {}", known.join(", ")),
        )
    })
}

/// Options of an edition with `id=option` changes on top.
pub(crate) fn options_with(
    suite: &Suite,
    edition: &Edition,
    changes: &[String],
) -> Result<Options, CliError> {
    let mut options = suite.options(edition);
    for change in changes {
        let (id, option) = change.split_once('=').ok_or_else(|| {
            CliError::usage(
                format!("invalid `--option {change}`: expected CHOICE=OPTION"),
                "for example --option saved-state.motion-mode=restored",
            )
        })?;
        let choice = suite.choices.iter().find(|choice| choice.id == id).ok_or_else(|| {
            CliError::usage(
                format!("unknown choice or quirk `{id}`"),
                "`gaugeblock choices` lists them",
            )
        })?;
        if !choice.options.iter().any(|known| known.name == option) {
            let known: Vec<_> = choice.options.iter().map(|known| known.name.as_str()).collect();
            return Err(CliError::usage(
                format!("unknown option `{option}` for `{id}`"),
                format!("expected one of: {}", known.join(", ")),
            ));
        }
        options.0.insert(id.to_owned(), option.to_owned());
    }
    in_this_build(&options)?;
    Ok(options)
}
