//! Files of the repository, by path from its root.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Text of each file, by path from the root of the repository.
pub type Files = BTreeMap<String, String>;

/// Folders with a leading dot that belong to the repository.
const DOTTED: &[&str] = &[".ci", ".github", ".clusterfuzzlite"];

/// Root of the repository.
///
/// # Panics
///
/// When this crate is not one folder below the root.
#[must_use]
pub fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().expect("the crate of the laws is one folder below the root").to_owned()
}

/// All text files below a folder; build products and version control are left out.
///
/// # Panics
///
/// When a folder cannot be read, or has no text file: a law over no file would check nothing.
#[must_use]
pub fn below(folder: &str) -> Files {
    let mut found = Files::new();
    let mut open = vec![root().join(folder)];
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(&folder).expect("a folder can be listed") {
            let entry = entry.expect("an entry can be read");
            let path = entry.path();
            let kind = entry.file_type().expect("an entry has a type");
            // A link leads to a file that is found where it is.
            if kind.is_symlink() {
                continue;
            }
            if kind.is_dir() {
                if is_of_the_repository(&path) {
                    open.push(path);
                }
            } else if path.ends_with(".git") {
                // A second working tree has a file here, with the place of its history on this machine.
            } else if let Ok(text) = fs::read_to_string(&path) {
                found.insert(from_root(&path), text);
            }
        }
    }
    assert!(!found.is_empty(), "{folder} has no text file");
    found
}

fn is_of_the_repository(folder: &Path) -> bool {
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    name != "target" && (!name.starts_with('.') || DOTTED.contains(&name.as_ref()))
}

/// Path from the root, with `/` between its parts.
///
/// # Panics
///
/// When the path is not below the root.
#[must_use]
pub fn from_root(path: &Path) -> String {
    let path = path.strip_prefix(root()).expect("the path is below the root");
    path.to_string_lossy().replace('\\', "/")
}

/// Rust sources below a folder.
#[must_use]
pub fn sources(folder: &str) -> Files {
    below(folder).into_iter().filter(|(path, _)| path.ends_with(".rs")).collect()
}

/// Lines (`path:line: text`) that contain one of these pieces of text.
#[must_use]
pub fn lines_with(files: &Files, pieces: &[&str]) -> Vec<String> {
    let mut found = Vec::new();
    for (path, text) in files {
        for (number, line) in text.lines().enumerate() {
            if pieces.iter().any(|piece| line.contains(piece)) {
                found.push(format!("{path}:{}: {}", number + 1, line.trim()));
            }
        }
    }
    found
}
