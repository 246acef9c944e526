//! A home for the Python within the controller: the start files of the standard library, and no site packages.
//!
//! The binary starts Python before it reads a program. Installed packages could hook into that start, and the search
//! for them would take a noticeable part of a short run.

use std::fs;
use std::io;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};

use crate::instrumentation::workspace::Workspace;

/// Where Debian keeps the libraries of its Pythons.
const LIBRARIES: &str = "/usr/lib";

/// What Python needs of its library to start.
const NEEDED: [&str; 2] = ["encodings", "os.py"];

/// A private home of Python, removed when it is dropped.
#[derive(Debug)]
pub(super) struct Home {
    workspace: Workspace,
}

impl Home {
    /// A home for each Python 3 of this machine; only a start finds out whether it fits the one in the controller.
    pub(super) fn candidates() -> Vec<Self> {
        let Ok(entries) = fs::read_dir(LIBRARIES) else { return Vec::new() };
        let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
        let mut pythons: Vec<_> = names.filter(|name| name.starts_with("python3.")).collect();
        pythons.sort();
        pythons.iter().rev().filter_map(|python| Self::new(python).ok()).collect()
    }

    /// Where it is.
    pub(super) fn path(&self) -> &Path {
        self.workspace.path()
    }

    fn new(python: &str) -> io::Result<Self> {
        let library = Path::new(LIBRARIES).join(python);
        let workspace =
            Workspace::new("rs274").map_err(|error| io::Error::other(error.to_string()))?;
        let own: PathBuf = workspace.path().join("lib").join(python);
        fs::create_dir_all(own.join("lib-dynload"))?;
        for name in NEEDED {
            let original = library.join(name);
            fs::metadata(&original)?;
            symlink(original, own.join(name))?;
        }
        Ok(Self { workspace })
    }
}
