//! The modules of all crates: where each is written, what it defines, what it imports, which names it writes.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

/// Modules of all crates; they refer to each other by their place in `modules`.
#[derive(Debug, Default)]
pub(super) struct Tree {
    pub(super) files: Vec<File>,
    pub(super) modules: Vec<Module>,
    /// First module of each library, by the name that Rust code uses.
    pub(super) libraries: BTreeMap<String, usize>,
}

/// A source file, once for each target that includes it.
#[derive(Debug)]
pub(super) struct File {
    pub(super) path: String,
    pub(super) package: String,
    pub(super) lines: usize,
}

/// A module, in a file of its own or not.
#[derive(Debug, Default)]
pub(super) struct Module {
    pub(super) file: usize,
    /// First module of its target.
    pub(super) root: usize,
    pub(super) parent: Option<usize>,
    pub(super) children: BTreeMap<String, usize>,
    /// Names of what it defines.
    pub(super) items: BTreeSet<String>,
    /// Names of its `macro_rules!`.
    pub(super) macros: BTreeSet<String>,
    pub(super) imports: Vec<Import>,
    /// Paths that its code writes, imports included; that of a macro that is called ends with `!`.
    pub(super) mentions: BTreeSet<Vec<String>>,
    /// Folder in which the files of its children are.
    pub(super) folder: PathBuf,
}

/// A name that a `use` brings into a module.
#[derive(Debug)]
pub(super) struct Import {
    /// Absent for `*`.
    pub(super) name: Option<String>,
    pub(super) path: Vec<String>,
}

impl Tree {
    /// Adds an empty module.
    pub(super) fn add(&mut self, file: usize, parent: Option<usize>, folder: PathBuf) -> usize {
        let module = self.modules.len();
        let root = parent.map_or(module, |parent| self.modules[parent].root);
        self.modules.push(Module { file, root, parent, folder, ..Module::default() });
        module
    }
}
