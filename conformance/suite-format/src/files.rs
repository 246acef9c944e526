//! The suite's pages as files of a folder.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use sha2::{Digest as _, Sha256};

/// The text of every TOML file of the suite, by path within it, with `/` between folders.
pub type Files = BTreeMap<String, String>;

/// A folder of pages.
///
/// # Errors
/// It is missing, unreadable, or a file of it is not UTF-8; the message names the path.
pub fn of_folder(root: &Path) -> Result<Files, String> {
    let mut files = Files::new();
    let mut folders = vec![root.to_path_buf()];
    while let Some(folder) = folders.pop() {
        let entries =
            std::fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        for entry in entries {
            let path = entry.map_err(|error| format!("{}: {error}", folder.display()))?.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "toml") {
                files.insert(name_within(root, &path), read(&path)?);
            }
        }
    }
    if files.is_empty() {
        return Err(format!("{}: no TOML file in this folder", root.display()));
    }
    Ok(files)
}

/// How many digits of the SHA-256 of a suite name it in reports.
const DIGEST_DIGITS: usize = 16;

/// A digest of names and texts: that of another suite is another one. It is the beginning of [`sha256`].
pub fn digest(files: &Files) -> String {
    sha256(files).chars().take(DIGEST_DIGITS).collect()
}

/// The SHA-256 of names and texts, in hexadecimal.
pub fn sha256(files: &Files) -> String {
    let mut digest = Sha256::new();
    for (name, text) in files {
        for part in [name, text] {
            digest.update(part.len().to_le_bytes());
            digest.update(part);
        }
    }
    digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

fn read(path: &PathBuf) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

fn name_within(root: &Path, path: &Path) -> String {
    path.strip_prefix(root).unwrap_or(path).to_string_lossy().replace('\\', "/")
}
