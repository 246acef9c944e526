//! The files of a controller, with their digests.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use gaugeblock_adapter::Adapter;
use gaugeblock_certificate::sha256_of_file;
use gaugeblock_report::ControllerFile;

use crate::error::CliError;

/// The files that identify a controller: those that the call names, or else those that the adapter knows of and can
/// read.
pub(crate) fn controller_files(
    controller: &dyn Adapter,
    named: &[PathBuf],
) -> Result<Vec<ControllerFile>, CliError> {
    let mut files = Vec::new();
    if named.is_empty() {
        let readable = controller.files();
        let digested = readable.iter().filter_map(|path| Some((path, sha256_of_file(path).ok()?)));
        files.extend(digested.map(|(path, sha256)| (path.clone(), sha256)));
    }
    for path in named {
        files.push((path.clone(), digest_of(path, "file of the controller (--subject)")?));
    }
    let mut names = BTreeSet::new();
    let files = files.into_iter().map(|(path, sha256)| {
        let name = unique_name(&path, &mut names);
        ControllerFile { name, sha256 }
    });
    Ok(files.collect())
}

/// The SHA-256 of a file; `role` says what it is in this call.
pub(super) fn digest_of(path: &Path, role: &str) -> Result<String, CliError> {
    sha256_of_file(path).map_err(|error| {
        CliError::usage(
            format!("{}: {error}", path.display()),
            format!("check the path of the {role}"),
        )
    })
}

/// The name of a file without its folder; numbered if another file of this name was named before.
fn unique_name(path: &Path, names: &mut BTreeSet<String>) -> String {
    let plain = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    let numbered = (2..).map(|number| format!("{plain} ({number})"));
    let mut free = std::iter::once(plain.clone()).chain(numbered);
    let name = free.find(|name| !names.contains(name)).unwrap_or(plain);
    names.insert(name.clone());
    name
}
