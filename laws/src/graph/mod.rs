//! Which file uses which: an edge for each name that a file writes and another file defines.
//!
//! Names are followed through imports and re-exports to the file that defines them. What counts:
//!
//! * A private `use`, a path in code, a name inside a macro call. The edge goes to the file that defines the item; an
//!   item that a macro generates is defined where the macro is called.
//! * A child that uses an item of its parent, and a parent that uses an item of its child.
//!
//! What does not count: a `mod` declaration; a module's own name in a path; a re-export of a child's item, which is a
//! table of contents; methods and fields, which need the types of expressions; code under `#[cfg(test)]`.

mod circles;
mod cut;
mod modules;
mod names;
mod resolve;

use std::collections::{BTreeMap, BTreeSet};

pub use circles::circles;
pub use cut::cut;
pub(crate) use names::{attributes, is_test};

use crate::workspace::Crate;

/// Edges between files: for each file and each other file that it uses, the names that it uses of it.
pub type Edges = BTreeMap<(String, String), BTreeSet<String>>;

/// Files of one crate and the edges between them.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct FileGraph {
    /// Paths of the files, from the root of the repository.
    pub files: BTreeSet<String>,
    /// Which of them uses which, and by what names.
    pub edges: Edges,
    /// Lines of all files.
    pub lines: usize,
}

/// Graph of the files of each crate, by name of the package; of its library and its programs.
///
/// # Panics
///
/// When a source file cannot be read or is not Rust.
#[must_use]
pub fn of_files(crates: &BTreeMap<String, Crate>) -> BTreeMap<String, FileGraph> {
    let tree = names::read(crates);
    let mut graphs: BTreeMap<String, FileGraph> = BTreeMap::new();
    for file in &tree.files {
        let graph = graphs.entry(file.package.clone()).or_default();
        if graph.files.insert(file.path.clone()) {
            graph.lines += file.lines;
        }
    }
    for (from, to, name) in resolve::edges(&tree) {
        let (from, to) = (&tree.files[from], &tree.files[to]);
        if from.package == to.package && from.path != to.path {
            let graph = graphs.entry(from.package.clone()).or_default();
            graph.edges.entry((from.path.clone(), to.path.clone())).or_default().insert(name);
        }
    }
    graphs
}

/// Which crate of the workspace builds on which; tests left out.
#[must_use]
pub fn of_crates(crates: &BTreeMap<String, Crate>) -> BTreeMap<String, BTreeSet<String>> {
    let ours = |found: &Crate| {
        let ours = found.dependencies.iter().filter(|name| crates.contains_key(*name));
        (found.name.clone(), ours.cloned().collect())
    };
    crates.values().map(ours).collect()
}
